//! The tunable table: one row a block with parameters in RAM, one a cell; and the adapters behind the rows.

use crate::args::{Call, Caller, Home, parameter_home};
use crate::bodies::{self, has_body};
use crate::check::{self, Checked};
use crate::code::place_elements;
use crate::context::Context;
use crate::expr::{self, Scope};
use crate::facts::{self, Facts, element_scalar};
use crate::shape::Form;
use crate::statics::Statics;
use crate::text;
use pcl2_lang::decl::TypeExpr;
use pcl2_lang::kernel::{self, Entry};
use pcl2_lang::program::{Block, BlockId, CellId, Param, UnitId};
use pcl2_lang::types::{Scalar, Type};
use rustc_hash::FxHashMap;
use std::fmt::Write;

/// The table, and the blocks that it does not hold.
#[derive(Debug, Default)]
pub(crate) struct Rows {
    /// The adapters, their places and the table.
    pub(crate) text: String,
    /// Blocks whose tune is called directly, with the section's period.
    pub(crate) tunes: Vec<(BlockId, Option<i64>)>,
    /// Blocks whose init is called directly.
    pub(crate) inits: Vec<(BlockId, Option<i64>)>,
    count: usize,
}

impl Rows {
    /// Whether there is a table.
    pub(crate) fn any(&self) -> bool {
        self.count > 0
    }
}

/// Builds the table. `next` is the index in the map of the first parameter.
pub(crate) fn rows(cx: &Context<'_>, statics: &mut Statics, mut next: usize, kernels: &[Facts]) -> Rows {
    let mut builder = Builder {
        cx,
        kernels,
        variants: FxHashMap::default(),
        recent: FxHashMap::default(),
        rows: Rows::default(),
        table: String::new(),
        marks: String::new(),
        open_marks: Vec::new(),
        codes: String::new(),
        code_index: FxHashMap::default(),
    };
    for (section, id) in blocks_by_section(cx) {
        let period = cx.program.period.map(|scan| cx.program.sections[section].period(scan, cx.program.substeps));
        let places = tunable_places(cx, id);
        if places > 0 {
            builder.tunable(statics, id, period, next);
            next += places;
        } else {
            builder.direct(id, period);
        }
    }
    for (i, _) in cx.program.main().cells.iter().enumerate() {
        builder.cell(statics, CellId(i as u32), next);
        next += 1;
    }
    if builder.rows.count > 0 {
        builder.tables();
    }
    builder.rows
}

fn blocks_by_section<'c>(cx: &'c Context<'_>) -> impl Iterator<Item = (usize, BlockId)> + use<'c> {
    let sections = cx.program.sections.iter().enumerate();
    sections.flat_map(|(s, section)| (section.first..section.end).map(move |block| (s, BlockId(block))))
}

/// How many points of the map are parameters of this block.
fn tunable_places(cx: &Context<'_>, id: BlockId) -> usize {
    let block = cx.program.main().block(id);
    if !block.tunable {
        return 0;
    }
    let params = cx.code(block.decl).decl.params.iter();
    params.filter(|param| !param.fixed && is_point(&param.ty, block)).count()
}

fn is_point(ty: &TypeExpr, block: &Block) -> bool {
    kernel::resolve(ty, &block.sizes).is_some()
}

/// As in pcl2_tune.h.
const MARK: usize = 64;

/// Init adapters of blocks that differ in fixed parameters only; more of them are called directly.
const MAX_STARTS: usize = 4;

/// What the adapters of a row depend on.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct Key {
    shape: u32,
    period: Option<i64>,
    /// The fixed parameters that tune and check take, as literals.
    fixed: String,
}

#[derive(Clone, Debug, Default)]
struct Variant {
    /// By the fixed parameters that init takes, as literals: the index of the code.
    starts: Vec<(String, usize)>,
    /// The same without the init adapter, once there are too many of them.
    bare: Option<usize>,
}

struct Builder<'c, 'a> {
    cx: &'c Context<'a>,
    kernels: &'c [Facts],
    variants: FxHashMap<Key, Variant>,
    /// By shape: the last block with it, its period, its `struct pcl2_code`, whether its init is called directly.
    recent: FxHashMap<u32, Recent>,
    rows: Rows,
    table: String,
    /// The marks, and the index of the first parameter of each whose cold parameters are still to come.
    marks: String,
    open_marks: Vec<usize>,
    /// The rows of the table of codes, and the index of each.
    codes: String,
    code_index: FxHashMap<String, usize>,
}

struct Recent {
    block: BlockId,
    period: Option<i64>,
    code: usize,
    direct: bool,
}

impl Builder<'_, '_> {
    /// Writes the tables behind the adapters.
    fn tables(&mut self) {
        self.close_marks(None);
        let (name, count, out) = (&self.cx.name, self.rows.count, &mut self.rows.text);
        let codes = self.code_index.len();
        let _ = writeln!(
            out,
            "/* Check, derive, start; the parameters' places and their number; size and alignment of the cold ones. */"
        );
        let _ = writeln!(out, "static const struct pcl2_code {name}_codes[{codes}] = {{\n{}}};\n", self.codes);
        let _ = writeln!(out, "/* Code, instance. */");
        let _ = writeln!(out, "static const struct pcl2_row {name}_rows[{count}] = {{\n{}}};\n", self.table);
        let marks = count.div_ceil(MARK);
        let _ = writeln!(out, "/* Index of the first parameter in the map, next cold parameters. */");
        let _ = writeln!(out, "static const struct pcl2_mark {name}_marks[{marks}] = {{\n{}}};\n", self.marks);
        let parts = format!("{name}_rows, {name}_marks, {name}_codes, {count}");
        let _ = writeln!(out, "static const struct pcl2_table {name}_table = {{{parts}}};\n");
    }

    fn facts(&self, block: &Block) -> &Facts {
        match block.unit {
            Some(inner) => &self.cx.unit_layout(inner).facts,
            None => &self.kernels[block.decl.0 as usize],
        }
    }

    /// A block without parameters in RAM.
    fn direct(&mut self, id: BlockId, period: Option<i64>) {
        let facts = self.facts(self.cx.program.main().block(id));
        let (tunes, inits) = (facts.tunes, facts.inits);
        if tunes {
            self.rows.tunes.push((id, period));
        }
        if inits {
            self.rows.inits.push((id, period));
        }
    }

    fn tunable(&mut self, statics: &mut Statics, id: BlockId, period: Option<i64>, first: usize) {
        let shape = self.cx.layout.units[0].members[id.0 as usize].shape;
        let alike = |recent: &&Recent| recent.period == period && self.same_fixed(recent.block, id);
        let (code, direct) = match self.recent.get(&shape).filter(alike) {
            Some(recent) => (recent.code, recent.direct),
            None => {
                let (code, direct) = self.look_up(statics, id, period);
                self.recent.insert(shape, Recent { block: id, period, code, direct });
                (code, direct)
            }
        };
        if direct {
            self.rows.inits.push((id, period));
        }
        self.row(code, id, first);
    }

    /// Whether two blocks of one code have the same fixed parameters.
    fn same_fixed(&self, a: BlockId, b: BlockId) -> bool {
        let unit = self.cx.program.main();
        let (a, b) = (unit.block(a), unit.block(b));
        let params = self.cx.code(a.decl).decl.params.iter().zip(a.params.iter().zip(&b.params));
        params.filter(|(param, _)| param.fixed).all(|(_, (a, b))| a == b)
    }

    /// The `struct pcl2_code` of a block, and whether its init is called directly.
    fn look_up(&mut self, statics: &mut Statics, id: BlockId, period: Option<i64>) -> (usize, bool) {
        let cx = self.cx;
        let block = cx.program.main().block(id);
        let (facts, decl) = (self.facts(block), cx.code(block.decl).decl);
        let (inits, periodic) = (facts.inits, facts.tune_period || facts.check_period);
        let fixed = |takes: &dyn Fn(usize) -> bool| {
            let mut text = String::new();
            for i in (0..decl.params.len()).filter(|i| decl.params[*i].fixed && takes(*i)) {
                fixed_text(&mut text, cx, block, i);
            }
            text
        };
        let key = Key {
            shape: cx.layout.units[0].members[id.0 as usize].shape,
            period: period.filter(|_| periodic),
            fixed: fixed(&|i| facts.tune[i] || checked(cx, block, facts, i)),
        };
        let started = fixed(&|i| facts.init[i]);
        self.code_of(statics, id, key, started, inits)
    }

    fn code_of(&mut self, statics: &mut Statics, id: BlockId, key: Key, started: String, inits: bool) -> (usize, bool) {
        let known = self.variants.entry(key.clone()).or_default();
        if let Some((_, name)) = known.starts.iter().find(|(known, _)| *known == started) {
            return (*name, false);
        }
        let bare = known.starts.len() >= MAX_STARTS;
        if let Some(name) = known.bare.filter(|_| bare) {
            return (name, true);
        }
        let name = self.variant(statics, id, &key, inits && !bare);
        let known = self.variants.entry(key).or_default();
        if bare {
            known.bare = Some(name);
        } else {
            known.starts.push((started, name));
        }
        (name, bare)
    }

    fn row(&mut self, code: usize, id: BlockId, first: usize) {
        let (cx, table) = (self.cx, &mut self.table);
        let form = cx.shape_of(UnitId(0), id).form;
        table.push_str("    {");
        text::count(table, code);
        table.push_str(", ");
        if form == Form::Nothing {
            table.push('0');
        } else {
            table.extend(["offsetof(", &cx.name, ", "]);
            expr::block(table, cx, Scope::MEMBERS, id);
            table.push(')');
        }
        table.push_str("},\n");
        self.mark(first, cx.layout.cold_names[id.0 as usize].as_deref());
    }

    /// Counts a row, and writes what stands before every [`MARK`]-th.
    fn mark(&mut self, first: usize, cold: Option<&str>) {
        if self.rows.count % MARK == 0 {
            self.open_marks.push(first);
        }
        if cold.is_some() {
            self.close_marks(cold);
        }
        self.rows.count += 1;
    }

    /// A mark says where the next cold parameters are: those of the first row behind it that has some, be it behind
    /// later marks.
    fn close_marks(&mut self, cold: Option<&str>) {
        for first in std::mem::take(&mut self.open_marks) {
            let _ = match cold {
                Some(cold) => writeln!(self.marks, "    {{{first}, offsetof({}, cold.{cold})}},", self.cx.name),
                None => writeln!(self.marks, "    {{{first}, 0}},"),
            };
        }
    }

    /// The adapters and the `struct pcl2_code` of blocks like this one.
    fn variant(&mut self, statics: &mut Statics, id: BlockId, key: &Key, init: bool) -> usize {
        let cx = self.cx;
        let block = cx.program.main().block(id);
        let code_name = cx.code(block.decl).decl.name.clone();
        let call = Call::new(cx, UnitId(0), id, Caller::Adapter, key.period);
        let facts = self.facts(block).clone();
        let checks = facts.checks || facts::has_ranges(cx.code(block.decl).decl);
        let check = checks.then(|| check_adapter(&mut self.rows.text, statics, &call, &code_name));
        let tune = facts.tunes.then(|| adapter(&mut self.rows.text, statics, &call, &code_name, Entry::Tune));
        let init = init.then(|| adapter(&mut self.rows.text, statics, &call, &code_name, Entry::Init));
        let places = places(&mut self.rows.text, cx, statics, id, &code_name);
        let cold = cx.shape_of(UnitId(0), id).cold.map(|cold| &cx.layout.colds[cold]);
        let cold = cold.map_or_else(
            || "0, 0".to_owned(),
            |cold| {
                let real = cold.fields.iter().any(|field| field.element == "pcl2_real");
                format!("sizeof(struct {}), {}", cold.tag, if real { "PCL2_ALIGN_REAL" } else { "PCL2_ALIGN_INT" })
            },
        );
        self.code(&code_name, &Code { check, tune, init, places, cold })
    }

    /// The index in the table of codes.
    fn code(&mut self, name: &str, parts: &Code) -> usize {
        let or_null = |part: &Option<String>| part.clone().unwrap_or_else(|| "NULL".to_owned());
        let (check, tune, init) = (or_null(&parts.check), or_null(&parts.tune), or_null(&parts.init));
        let Code { places: (places, count), cold, .. } = parts;
        let row = format!("    {{{check}, {tune}, {init}, {places}, {count}, {cold}}}, /* {name} */\n");
        if let Some(index) = self.code_index.get(&row) {
            return *index;
        }
        let index = self.code_index.len();
        self.codes.push_str(&row);
        self.code_index.insert(row, index);
        index
    }

    /// An operator cell is a row with one place and no derivation.
    fn cell(&mut self, statics: &mut Statics, cell: CellId, first: usize) {
        let cx = self.cx;
        let known = &cx.program.main().cells[cell.0 as usize];
        let block = cx.program.main().block(known.block);
        let port = declared_port(cx, block, known.port as usize);
        let key = Key { shape: u32::MAX, period: None, fixed: format!("{} {port} {:?}", block.decl.0, block.sizes) };
        let code = match self.variants.get(&key).and_then(|variant| variant.starts.first()) {
            Some((_, code)) => *code,
            None => {
                let parts = cell_code(&mut self.rows.text, cx, statics, block, port, known.ty);
                let code = cx.code(block.decl);
                let index = self.code(&format!("{}.{}", code.decl.name, code.ports[port].name), &parts);
                self.variants.entry(key).or_default().starts.push((String::new(), index));
                index
            }
        };
        let member = &cx.layout.cell_names[cell.0 as usize];
        self.table.push_str("    {");
        text::count(&mut self.table, code);
        self.table.extend([", offsetof(", &cx.name, ", cold.", member, ")},\n"]);
        self.mark(first, None);
    }
}

/// Whether a block's check reads this fixed parameter.
fn checked(cx: &Context<'_>, block: &Block, facts: &Facts, param: usize) -> bool {
    let decl = cx.code(block.decl).decl;
    let mut referred = Vec::new();
    for other in decl.params.iter().filter(|other| !other.fixed) {
        for bound in other.tail.bounds.iter().flat_map(|bounds| [&bounds.lower, &bounds.upper]).flatten() {
            check::collect_params(bound, &mut referred);
        }
    }
    let judged = if block.unit.is_some() { facts.check[param] } else { decl.check };
    judged || referred.contains(&param)
}

fn fixed_text(out: &mut String, cx: &Context<'_>, block: &Block, index: usize) {
    let ty = &cx.code(block.decl).decl.params[index].ty;
    match &block.params[index] {
        Param::Value(pcl2_lang::types::Value::Text(value)) => text::string(out, value),
        Param::Value(value) => {
            text::elements(out, value, place_elements(ty, &block.sizes), element_scalar(ty), cx.program.width);
        }
        Param::Own(_) => {}
    }
    out.push(';');
}

fn declared_port(cx: &Context<'_>, block: &Block, expanded: usize) -> usize {
    let code = cx.code(block.decl);
    let inside = |port: &usize| {
        let (first, count) = code.port_range(*port, &block.sizes);
        (first..first + count).contains(&expanded)
    };
    (0..code.ports.len()).find(inside).unwrap_or(0)
}

/// The C type of what an adapter's first pointer points to.
fn instance_type(call: &Call<'_, '_>) -> Option<String> {
    let shape = call.cx.shape_of(call.unit, call.id);
    match shape.form {
        Form::Nothing | Form::Plain => None,
        Form::Kernel => Some(format!("struct pcl2_{}", call.code().decl.name)),
        Form::Struct => Some(format!("struct {}", shape.tag)),
        Form::Body(unit) => Some(format!("struct {}", call.cx.unit_layout(unit).tag)),
    }
}

/// The typed pointers that an adapter's body uses.
fn pointers(out: &mut String, call: &Call<'_, '_>, body: &str, constant: &str) {
    match instance_type(call).filter(|_| body.contains("self")) {
        Some(ty) => {
            let _ = writeln!(out, "    {constant}{ty} *const self = instance;");
        }
        None => out.push_str("    (void)instance;\n"),
    }
    match call.cx.shape_of(call.unit, call.id).cold.filter(|_| body.contains("cold->")) {
        Some(cold) => {
            let _ = writeln!(out, "    const struct {} *const cold = parameters;", call.cx.layout.colds[cold].tag);
        }
        None => out.push_str("    (void)parameters;\n"),
    }
}

fn adapter(out: &mut String, statics: &mut Statics, call: &Call<'_, '_>, code: &str, entry: Entry) -> String {
    let mut body = String::from("    ");
    bodies::function_call(&mut body, statics, call, call.block().unit, entry);
    body.push_str(";\n");
    let mut text = String::from("(void *instance, const void *parameters)\n{\n");
    pointers(&mut text, call, &body, "");
    let _ = writeln!(text, "{body}}}\n");
    let suffix = format!("{}_{code}", if entry == Entry::Tune { "derive" } else { "start" });
    statics.define(out, "static void ", &suffix, &text)
}

fn check_adapter(out: &mut String, statics: &mut Statics, call: &Call<'_, '_>, code: &str) -> String {
    let mut body = String::new();
    check::ranges(&mut body, statics, call);
    let judged = match call.block().unit {
        None => call.code().has(Entry::Check),
        Some(inner) => has_body(&call.cx.unit_layout(inner).facts, Entry::Check),
    };
    if judged {
        body.push_str("    return ");
        bodies::function_call(&mut body, statics, call, call.block().unit, Entry::Check);
        body.push_str(";\n");
    } else {
        body.push_str("    return 0;\n");
    }
    let mut text = String::from("(const void *instance, const void *parameters, pcl2_real *left)\n{\n");
    pointers(&mut text, call, &body, "const ");
    if !judged {
        text.push_str("    (void)left;\n");
    }
    let _ = writeln!(text, "{body}}}\n");
    statics.define(out, "static int32_t ", &format!("check_{code}"), &text)
}

/// The places of the parameters in the map's order.
fn places(out: &mut String, cx: &Context<'_>, statics: &mut Statics, id: BlockId, code: &str) -> (String, usize) {
    let block = cx.program.main().block(id);
    let call = Call::new(cx, UnitId(0), id, Caller::Adapter, None);
    let shape = cx.shape_of(UnitId(0), id);
    let instance = instance_type(&call).unwrap_or_default();
    let cold = shape.cold.map_or("", |cold| &cx.layout.colds[cold].tag);
    let params = cx.code(block.decl).decl.params.iter().enumerate();
    let mut count = 0;
    let mut text = String::new();
    for (i, param) in params.filter(|(_, param)| !param.fixed && is_point(&param.ty, block)) {
        let elements = place_elements(&param.ty, &block.sizes);
        let kind = if element_scalar(&param.ty) == Scalar::Int { "PCL2_INT" } else { "PCL2_REAL" };
        let _ = match parameter_home(cx, UnitId(0), id, i) {
            Home::Hot(name) => writeln!(text, "    {{offsetof({instance}, {name}), {elements}, {kind}, 0}},"),
            Home::Cold(name) => writeln!(text, "    {{offsetof(struct {cold}, {name}), {elements}, {kind}, 1}},"),
            Home::Literal => writeln!(text, "    {{0, 0, {kind}, 0}},"),
        };
        count += 1;
    }
    let text = format!("[{count}] = {{\n{text}}};\n\n");
    (statics.define(out, "static const struct pcl2_place ", &format!("places_{code}"), &text), count)
}

struct Code {
    check: Option<String>,
    tune: Option<String>,
    init: Option<String>,
    places: (String, usize),
    /// Size and alignment of the cold parameters.
    cold: String,
}

fn cell_code(out: &mut String, cx: &Context<'_>, statics: &mut Statics, block: &Block, port: usize, ty: Type) -> Code {
    let code = cx.code(block.decl);
    let (declared, suffix) = (code.ports[port], format!("{}_{}", code.decl.name, code.ports[port].name));
    let mut body = String::new();
    let operand = |out: &mut String, _: &mut Statics, _: usize| {
        out.push('0');
        Scalar::Int
    };
    let (value, count) = if ty.is_scalar() { ("*value", None) } else { ("value", Some(ty.elements())) };
    let place = Checked { tail: &declared.tail, scalar: facts::element_scalar(&declared.ty), number: 1 };
    check::range(&mut body, statics, &place, value, count, &block.sizes, cx.program.width, &operand);
    let check = (!body.is_empty()).then(|| {
        let element = kernel::c_scalar(ty.scalar);
        let text = format!(
            "(const void *instance, const void *parameters, pcl2_real *left)
{{
    const {element} *const value = instance;
    (void)parameters;
    (void)left;
{body}    return 0;
}}

"
        );
        statics.define(out, "static int32_t ", &format!("check_{suffix}"), &text)
    });
    let kind = if ty.scalar == Scalar::Int { "PCL2_INT" } else { "PCL2_REAL" };
    let text = format!("[1] = {{\n    {{0, {}, {kind}, 0}},\n}};\n\n", ty.elements());
    let places = statics.define(out, "static const struct pcl2_place ", &format!("places_{suffix}"), &text);
    Code { check, tune: None, init: None, places: (places, 1), cold: "0, 0".to_owned() }
}
