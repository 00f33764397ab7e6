//! Nets as C: what an instance keeps, its statements, and the scan.

pub(crate) mod facts;
mod fast;
mod gates;
pub(crate) mod layout;
mod statements;
mod table;
mod waits;

use crate::NetForm;
use crate::args::{Call, Caller};
use crate::bodies::Body;
use crate::calls;
use crate::context::Context;
use crate::expr::{self, Kind, Scope};
use crate::layout::UnitLayout;
use crate::statics::Statics;
use layout::NetLayout;
use pcl2_lang::net::{BoxId, Net, NetBox};
use pcl2_lang::program::{BlockId, Role, SignalId, UnitId};
use pcl2_lang::types::{Scalar, Value};
use std::fmt::Write;

const INDENT: &str = "    ";

/// A net in the making.
pub(crate) struct NetBody<'b, 'c, 'a> {
    /// Its unit.
    pub(crate) body: &'b Body<'c, 'a>,
    /// The net.
    pub(crate) net: &'a Net,
    /// What it keeps.
    pub(crate) layout: &'c NetLayout,
}

impl<'b, 'c, 'a> NetBody<'b, 'c, 'a> {
    /// The net of a body, if it has one.
    pub(crate) fn of(body: &'b Body<'c, 'a>) -> Option<Self> {
        Some(NetBody { body, net: body.decl.net.as_deref()?, layout: body.layout.net.as_ref()? })
    }

    fn tag(&self) -> &'c str {
        &self.body.layout.tag
    }

    fn scope(&self) -> Scope<'static> {
        Scope::of(self.body.id)
    }

    /// The signal of a word, and behind words and tokens that of an attribute in hand.
    fn held(&self, index: usize) -> SignalId {
        SignalId((self.layout.held + index) as u32)
    }

    /// The member that keeps a word.
    fn word(&self, index: usize, scope: Scope<'_>) -> String {
        let mut text = String::new();
        expr::signal_value(&mut text, self.body.cx, scope, self.held(index), 0);
        text
    }

    /// The enumerator of a box.
    fn place(&self, id: BoxId) -> &'c str {
        &self.layout.boxes[id.0 as usize]
    }

    /// The members with the cause and the answer of a process box.
    fn answers(&self, place: &NetBox) -> [String; 2] {
        let before = self.net.boxes.iter().take_while(|other| other.name != place.name);
        let hands = |other: &NetBox| self.net.attributes(other).len() + if other.asks() { 2 } else { 0 };
        let first = before.map(hands).sum::<usize>() + self.net.attributes(place).len() + self.net.words.len() + 1;
        [first, first + 1].map(|index| self.word(index, self.scope()))
    }

    /// The layouts and units of the nets inside, in order.
    fn parts(&self) -> impl Iterator<Item = (usize, UnitId, &'c UnitLayout<'a>)> + use<'_, 'b, 'c, 'a> {
        let unit = |index: usize| {
            let inner = layout::part_unit(self.body.unit, self.net, pcl2_lang::net::PartId(index as u32))?;
            Some((index, inner, self.body.cx.unit_layout(inner)))
        };
        (0..self.net.parts.len()).filter_map(unit)
    }
}

/// Writes the enumerators of a net's boxes.
pub(crate) fn enumerators(out: &mut String, net: &NetBody<'_, '_, '_>) {
    if net.net.boxes.is_empty() {
        return;
    }
    let _ = writeln!(out, "/* The boxes of {}. */\nenum {{", net.body.decl.name);
    for (place, name) in net.net.boxes.iter().zip(&net.layout.boxes) {
        let _ = write!(out, "    {name}, ");
        crate::text::comment(out, "", net.body.cx.sources.text(place.span));
    }
    out.push_str("};\n\n");
}

/// What a net's init does beside that of its blocks: first values of words, the tokens at the start.
pub(crate) fn start(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let width = net.body.cx.program.width;
    for (i, word) in net.net.words.iter().enumerate() {
        if !crate::text::number(&word.initial, 0).is_zero() {
            let mut value = String::new();
            crate::text::element(&mut value, &word.initial, 0, word.scalar, width);
            let _ = writeln!(out, "    {} = {value};", net.word(i, net.scope()));
        }
    }
    for (place, name) in net.net.boxes.iter().zip(&net.layout.boxes).filter(|(place, _)| place.initial != 0) {
        let tokens = i32::try_from(place.initial).unwrap_or(i32::MAX);
        let _ = writeln!(out, "    self->box[{name}] = {tokens};");
    }
    if net.layout.form == NetForm::Fast {
        fast::start(out, net);
    }
    let table = &net.layout.table;
    let ints = table.ints.iter().map(|value| (Value::Int(*value), Scalar::Int)).enumerate();
    let reals = table.reals.iter().map(|value| (Value::Real(*value), Scalar::Real)).enumerate();
    for (list, values) in [("ints", ints.collect::<Vec<_>>()), ("reals", reals.collect())] {
        for (i, (value, scalar)) in
            values.into_iter().filter(|(_, (value, _))| !crate::text::number(value, 0).is_zero())
        {
            let mut text = String::new();
            crate::text::element(&mut text, &value, 0, scalar, width);
            let _ = writeln!(out, "    self->net.{list}[{i}] = {text};");
        }
    }
}

/// What a net's tune does beside: it keeps the period of its scans.
pub(crate) fn tune(out: &mut String, net: &NetBody<'_, '_, '_>) {
    if net.layout.timed {
        out.push_str("    self->net.period = T;\n");
    }
    if net.layout.keeps("restless") {
        out.push_str("    self->net.restless |= 1;\n");
    }
}

/// Writes the functions of a net that make its scan. Its own inputs are arguments of the last of them.
pub(crate) fn scan(out: &mut String, statics: &mut Statics, net: &NetBody<'_, '_, '_>, head: &str) {
    match net.layout.form {
        NetForm::Table => table::functions(out, statics, net),
        NetForm::Fast => fast::functions(out, statics, net),
    }
    let (table, layout) = (net.layout.form == NetForm::Table, net.layout);
    if !table && (layout.called || layout.top) {
        fast::scan(out, net);
    }
    if layout.called || (table && layout.top) {
        let _ = writeln!(out, "{head}{{");
        if table {
            take_arguments(out, net, INDENT);
            table::scan(out, net);
        } else {
            fast::take_and_scan(out, net);
        }
        out.push_str("}\n\n");
    }
}

/// Whether a block of the program is a net whose inputs are compared where it is called.
pub(crate) fn is_top(cx: &Context<'_>, unit: UnitId, inner: UnitId) -> bool {
    unit.0 == 0 && cx.unit_layout(inner).net.as_ref().is_some_and(|net| net.form == NetForm::Fast)
}

/// Writes the functions that take the inputs of the program's nets in, each called only when one changed.
pub(crate) fn takers(out: &mut String, statics: &mut Statics, cx: &Context<'_>) {
    for (index, name) in cx.layout.takers.iter().enumerate().filter_map(|(i, name)| Some((i, name.as_ref()?))) {
        let call = top_call(cx, Scope::of(UnitId(0)), BlockId(index as u32));
        let Some(tag) = call.block().unit.map(|inner| &cx.unit_layout(inner).tag) else {
            continue;
        };
        let inputs = top_inputs(statics, &call);
        let ports = call.block().unit.map_or(0, |inner| cx.unit_layout(inner).ports.len());
        let arguments: Vec<&str> = inputs.iter().take(ports).map(|input| input.from.as_str()).collect();
        if arguments.is_empty() {
            continue;
        }
        let mut instance = String::new();
        expr::block(&mut instance, cx, call.scope(), call.id);
        let _ = writeln!(
            out,
            "PCL2_SHARED void {name}({} *self)\n{{\n    (void){tag}_inputs(&{instance}, {});\n}}\n",
            cx.name,
            arguments.join(", ")
        );
    }
}

fn top_call<'c, 'a>(cx: &'c Context<'a>, scope: Scope<'c>, id: BlockId) -> Call<'c, 'a> {
    Call::new(cx, UnitId(0), id, Caller::Step(scope), None)
}

fn top_inputs(statics: &mut Statics, call: &Call<'_, '_>) -> Vec<statements::Input> {
    let mut instance = String::new();
    expr::block(&mut instance, call.cx, call.scope(), call.id);
    statements::inputs_of(statics, call, &instance)
}

/// Writes the scan of a net that is a block of the program.
pub(crate) fn top(out: &mut String, statics: &mut Statics, cx: &Context<'_>, scope: Scope<'_>, id: BlockId) {
    let call = top_call(cx, scope, id);
    let (Some(inner), Some(taker)) = (call.block().unit, &cx.layout.takers[id.0 as usize]) else {
        return;
    };
    let tag = &cx.unit_layout(inner).tag;
    let mut instance = String::new();
    expr::block(&mut instance, cx, scope, id);
    let changes: Vec<String> = top_inputs(statics, &call).iter().filter_map(statements::Input::change).collect();
    if changes.is_empty() {
        let _ = writeln!(out, "    {tag}_scan(&{instance}, 0);");
        return;
    }
    let changes = changes.join(" |\n            ");
    let _ = write!(
        out,
        "    {{
        const int32_t changed =
            {changes};
        if (changed) {{
            {taker}(self);
        }}
        {tag}_scan(&{instance}, changed);
    }}
"
    );
}

/// Takes the arguments in: they stay until the next scan.
fn take_arguments(out: &mut String, net: &NetBody<'_, '_, '_>, indent: &str) {
    for (i, signal) in net.body.unit.signals.iter().enumerate() {
        if let Role::Port(port) = signal.role {
            take_argument(out, net, SignalId(i as u32), port, indent);
        }
    }
    commands(out, net, net.scope(), indent);
}

fn take_argument(out: &mut String, net: &NetBody<'_, '_, '_>, input: SignalId, port: u32, indent: &str) {
    let ty = net.body.unit.signal(input).ty;
    let to = |out: &mut String| expr::signal_base(out, net.body.cx, net.scope(), input);
    let argument = &net.body.layout.ports[port as usize].0;
    calls::assign(out, indent, ty, to, |out| {
        out.push_str(argument);
        if ty.is_scalar() { Kind::Scalar } else { Kind::Array(0) }
    });
}

/// Commands go to the words that gates clear, and the mode to one of its own.
fn commands(out: &mut String, net: &NetBody<'_, '_, '_>, scope: Scope<'_>, indent: &str) {
    for (port, word) in net.net.latched() {
        let mut from = String::new();
        expr::signal_value(&mut from, net.body.cx, scope, SignalId(port), 0);
        let _ = writeln!(out, "{indent}{} = {from};", net.word(word.0 as usize, scope));
    }
}
