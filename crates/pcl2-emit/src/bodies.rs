//! The functions of a composite: step, tune, init and check over its struct.

use crate::args::{Call, Caller};
use crate::calls::{self, Telling};
use crate::check;
use crate::code::place_elements;
use crate::context::Context;
use crate::expr::{self, Scope};
use crate::facts::element_scalar;
use crate::layout::{Store, UnitLayout};
use crate::net::{self, NetBody};
use crate::statics::Statics;
use pcl2_lang::decl::{Decl, TypeExpr};
use pcl2_lang::kernel::{self, Entry};
use pcl2_lang::program::{Block, BlockId, Param, Source, Unit, UnitId};
use std::fmt::Write;

const INDENT: &str = "    ";
/// From so many calls on, inlining a composite is out of the question.
const MANY_CALLS: usize = 16;

/// Writes all functions of a composite.
pub(crate) fn functions(out: &mut String, cx: &Context<'_>, statics: &mut Statics, unit: UnitId) {
    let Some(body) = Body::new(cx, unit) else {
        return;
    };
    if let Some(net) = NetBody::of(&body) {
        net::enumerators(out, &net);
    }
    if body.layout.facts.checks {
        check_function(out, statics, &body);
    }
    if body.layout.facts.tunes {
        tune_function(out, statics, &body);
    }
    if body.layout.facts.inits {
        init_function(out, statics, &body);
    }
    step_function(out, statics, &body);
}

/// A composite or a net in the making.
pub(crate) struct Body<'c, 'a> {
    /// What is known.
    pub(crate) cx: &'c Context<'a>,
    /// Its unit.
    pub(crate) id: UnitId,
    /// The unit.
    pub(crate) unit: &'a Unit,
    /// Its layout.
    pub(crate) layout: &'c UnitLayout<'a>,
    /// Its declaration.
    pub(crate) decl: &'a Decl,
}

impl<'c, 'a> Body<'c, 'a> {
    /// The body of a unit; the program's own has none.
    pub(crate) fn new(cx: &'c Context<'a>, id: UnitId) -> Option<Self> {
        let unit = cx.program.unit(id);
        let (decl, _) = unit.composite.as_ref()?;
        Some(Body { cx, id, unit, layout: cx.unit_layout(id), decl: cx.program.decl(*decl) })
    }

    fn blocks(&self) -> impl Iterator<Item = (BlockId, &'a Block)> + use<'a> {
        self.unit.blocks.iter().enumerate().map(|(i, block)| (BlockId(i as u32), block))
    }

    fn call(&self, id: BlockId, caller: Caller<'c>) -> Call<'c, 'a> {
        Call::new(self.cx, self.id, id, caller, None)
    }

    fn inside(&self, id: BlockId) -> Call<'c, 'a> {
        self.call(id, Caller::Body(Scope::of(self.id)))
    }

    /// The declarations of the own parameters that a function takes.
    fn params(&self, takes: &[bool]) -> Vec<String> {
        let params = self.decl.params.iter().zip(&self.layout.params).zip(takes).filter(|(_, takes)| **takes);
        params.map(|((param, name), _)| argument(&param.ty, name)).collect()
    }

    /// Own parameters that the function takes for nothing: those without elements.
    fn unused(&self, out: &mut String, takes: &[bool], text: &str) {
        for (name, _) in self.layout.params.iter().zip(takes).filter(|(_, takes)| **takes) {
            if !mentions(text, name) {
                let _ = writeln!(out, "    (void){name};");
            }
        }
    }
}

fn argument(ty: &TypeExpr, name: &str) -> String {
    let element = kernel::c_element(ty);
    if ty.is_scalar() { format!("{element} {name}") } else { format!("const {element} *{name}") }
}

fn step_function(out: &mut String, statics: &mut Statics, body: &Body<'_, '_>) {
    if let Some(net) = NetBody::of(body) {
        net::scan(out, statics, &net, &step_head(body));
        return;
    }
    let scope = Scope::of(body.id);
    let used = used_ports(body);
    out.push_str(&step_head(body));
    out.push_str("{\n");
    for ((name, _), _) in body.layout.ports.iter().zip(&used).filter(|(_, used)| !**used) {
        let _ = writeln!(out, "    (void){name};");
    }
    step_blocks(out, statics, body, scope);
    out.push_str("}\n\n");
}

fn step_head(body: &Body<'_, '_>) -> String {
    let mut out = String::new();
    let linkage = if body.layout.calls >= MANY_CALLS { "PCL2_SHARED" } else { "static" };
    let _ = write!(out, "/* {} */\n{linkage} void {tag}(struct {tag} *self", body.decl.name, tag = body.layout.tag);
    for (name, ty) in &body.layout.ports {
        let element = kernel::c_scalar(ty.scalar);
        let _ =
            if ty.is_scalar() { write!(out, ", {element} {name}") } else { write!(out, ", const {element} *{name}") };
    }
    let scratch = body.layout.facts.scratch;
    for (declaration, size) in
        [("pcl2_real *work", scratch.real), ("int32_t *iwork", scratch.int), ("int64_t *twork", scratch.time)]
    {
        if size > 0 {
            let _ = write!(out, ", {declaration}");
        }
    }
    out.push_str(")\n");
    out
}

fn step_blocks(out: &mut String, statics: &mut Statics, body: &Body<'_, '_>, scope: Scope<'_>) {
    if body.layout.facts.status {
        out.push_str("    int32_t status = 0;\n");
    }
    for (id, _) in body.blocks() {
        calls::step(out, body.cx, statics, scope, id, "status = status != 0 ? status : 1;");
        if calls::telling(body.cx, body.id, id) == Telling::Status {
            out.push_str("    status = status != 0 ? status : ");
            calls::status(out, body.cx, scope, id);
            out.push_str(";\n");
        }
    }
    if body.layout.facts.status {
        out.push_str("    self->status = status;\n");
    }
}

fn used_ports(body: &Body<'_, '_>) -> Vec<bool> {
    let mut used = vec![false; body.layout.ports.len()];
    for (_, block) in body.blocks() {
        for id in block.ports.iter().filter_map(Source::signal) {
            if let Store::Port(port) = body.layout.stores[id.0 as usize] {
                used[port as usize] |= body.unit.signal(id).ty.elements() > 0;
            }
        }
    }
    used
}

fn tune_function(out: &mut String, statics: &mut Statics, body: &Body<'_, '_>) {
    let facts = &body.layout.facts;
    let mut args = vec![format!("struct {} *self", body.layout.tag)];
    args.extend(body.params(&facts.tune));
    if facts.tune_period {
        args.push("int64_t T".to_owned());
    }
    let mut text = String::new();
    for (id, block) in body.blocks() {
        hand_down(&mut text, statics, body, id, block);
        if body.has(block, Entry::Tune) {
            body.call_inner(&mut text, statics, id, block, Entry::Tune);
        }
    }
    if let Some(net) = NetBody::of(body) {
        net::tune(&mut text, &net);
    }
    let _ = writeln!(out, "static void {}_tune({})\n{{", body.layout.tag, args.join(", "));
    body.unused(out, &facts.tune, &text);
    unused_instance(out, &text);
    let _ = writeln!(out, "{text}}}\n");
}

/// A composite inside keeps the parameters that its step reads: the outer one's tune fills them in.
fn hand_down(out: &mut String, statics: &mut Statics, body: &Body<'_, '_>, id: BlockId, block: &Block) {
    let Some(inner) = block.unit else {
        return;
    };
    let (layout, decl) = (body.cx.unit_layout(inner), body.cx.program.decl(block.decl));
    for (i, param) in block.params.iter().enumerate().filter(|(i, _)| layout.facts.hot[*i]) {
        let elements = place_elements(&decl.params[i].ty, &block.sizes);
        if !matches!(param, Param::Own(_)) || elements == 0 {
            continue;
        }
        let mut place = String::new();
        expr::block(&mut place, body.cx, Scope::of(body.id), id);
        let mut value = String::new();
        body.inside(id).param(&mut value, statics, i);
        let (name, ty) = (&layout.params[i], &decl.params[i].ty);
        let _ = if ty.is_scalar() {
            writeln!(out, "    {place}.{name} = {value};")
        } else {
            let element = kernel::c_scalar(element_scalar(ty));
            writeln!(out, "    memcpy({place}.{name}, {value}, {elements} * sizeof({element}));")
        };
    }
}

impl Body<'_, '_> {
    /// Whether a block has this function.
    fn has(&self, block: &Block, entry: Entry) -> bool {
        match block.unit {
            None => self.cx.code(block.decl).has(entry),
            Some(inner) => has_body(&self.cx.unit_layout(inner).facts, entry),
        }
    }

    /// `name(..);` of a block's tune or init.
    fn call_inner(&self, out: &mut String, statics: &mut Statics, id: BlockId, block: &Block, entry: Entry) {
        out.push_str(INDENT);
        function_call(out, statics, &self.inside(id), block.unit, entry);
        out.push_str(";\n");
    }
}

/// Whether a composite has this function.
pub(crate) fn has_body(facts: &crate::facts::Facts, entry: Entry) -> bool {
    match entry {
        Entry::Step => true,
        Entry::Init => facts.inits,
        Entry::Tune => facts.tunes,
        Entry::Check => facts.checks,
    }
}

/// The call of a kernel's or body's tune, init or check.
pub(crate) fn function_call(
    out: &mut String,
    statics: &mut Statics,
    call: &Call<'_, '_>,
    inner: Option<UnitId>,
    entry: Entry,
) {
    let Some(inner) = inner else {
        call.kernel(out, statics, entry);
        return;
    };
    let layout = call.cx.unit_layout(inner);
    let (suffix, takes, period) = match entry {
        Entry::Step | Entry::Tune => ("tune", &layout.facts.tune, layout.facts.tune_period),
        Entry::Init => ("init", &layout.facts.init, false),
        Entry::Check => ("check", &layout.facts.check, layout.facts.check_period),
    };
    let _ = write!(out, "{}_{suffix}(", layout.tag);
    let mut args = Vec::new();
    if entry != Entry::Check {
        args.push(instance(call));
    }
    for (i, _) in takes.iter().enumerate().filter(|(_, takes)| **takes) {
        let mut arg = String::new();
        call.param(&mut arg, statics, i);
        args.push(arg);
    }
    if period {
        args.push(period_text(call));
    }
    if entry == Entry::Check {
        args.push("left".to_owned());
    }
    out.push_str(&args.join(", "));
    out.push(')');
}

fn instance(call: &Call<'_, '_>) -> String {
    match call.caller {
        Caller::Adapter => "self".to_owned(),
        Caller::Step(scope) | Caller::Init(scope) | Caller::Body(scope) => {
            let mut text = "&".to_owned();
            expr::block(&mut text, call.cx, scope, call.id);
            text
        }
    }
}

fn period_text(call: &Call<'_, '_>) -> String {
    match call.caller {
        Caller::Body(_) => "T".to_owned(),
        Caller::Adapter | Caller::Step(_) | Caller::Init(_) => format!("INT64_C({})", call.period.unwrap_or(0)),
    }
}

fn init_function(out: &mut String, statics: &mut Statics, body: &Body<'_, '_>) {
    let facts = &body.layout.facts;
    let mut args = vec![format!("struct {} *self", body.layout.tag)];
    args.extend(body.params(&facts.init));
    let mut text = String::new();
    for (id, block) in body.blocks() {
        if body.has(block, Entry::Init) {
            body.call_inner(&mut text, statics, id, block, Entry::Init);
        }
    }
    crate::init::start_values(&mut text, body.cx, body.id);
    if let Some(net) = NetBody::of(body) {
        net::start(&mut text, &net);
    }
    let _ = writeln!(out, "static void {}_init({})\n{{", body.layout.tag, args.join(", "));
    body.unused(out, &facts.init, &text);
    unused_instance(out, &text);
    let _ = writeln!(out, "{text}}}\n");
}

/// A net without tokens at the start, or without a time, has nothing to do there.
fn unused_instance(out: &mut String, text: &str) {
    if !text.contains("self->") {
        out.push_str("    (void)self;\n");
    }
}

fn check_function(out: &mut String, statics: &mut Statics, body: &Body<'_, '_>) {
    let facts = &body.layout.facts;
    let mut args = body.params(&facts.check);
    if facts.check_period {
        args.push("int64_t T".to_owned());
    }
    args.push("pcl2_real *left".to_owned());
    let mut text = String::new();
    for (id, block) in
        body.blocks().filter(|(_, block)| block.params.iter().any(|param| matches!(param, Param::Own(_))))
    {
        let call = body.inside(id);
        check::ranges(&mut text, statics, &call);
        if body.has(block, Entry::Check) {
            text.push_str("    status = status != 0 ? status : ");
            function_call(&mut text, statics, &call, block.unit, Entry::Check);
            text.push_str(";\n");
        }
    }
    let _ = writeln!(out, "static int32_t {}_check({})\n{{", body.layout.tag, args.join(", "));
    out.push_str("    int32_t status = 0;\n");
    body.unused(out, &facts.check, &text);
    let _ = writeln!(out, "    (void)left;\n{text}    return status;\n}}\n");
}

/// Whether a name occurs as a word.
fn mentions(text: &str, name: &str) -> bool {
    let part = |byte: Option<&u8>| byte.is_some_and(|byte| byte.is_ascii_alphanumeric() || *byte == b'_');
    let bytes = text.as_bytes();
    text.match_indices(name).any(|(at, _)| {
        let before = at.checked_sub(1).and_then(|at| bytes.get(at));
        !part(before) && !part(bytes.get(at + name.len()))
    })
}
