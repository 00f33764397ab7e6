//! The inputs of nets: taken in once a scan, in the fast form only those that changed.

use super::facts::add_gate;
use super::statements::Input;
use super::{INDENT, NetBody, fast, statements};
use crate::NetForm;
use crate::args::{Call, Caller};
use crate::bodies::Body;
use crate::calls;
use crate::context::Context;
use crate::expr::{self, Kind, Scope};
use crate::layout::Store;
use crate::statics::Statics;
use pcl2_lang::program::{BlockId, Role, SignalId, Source, UnitId};
use pcl2_lang::types::Type;
use std::fmt::Write;

/// So many ints side by side are compared in one go; fewer one by one.
const RUN: usize = 3;

/// Whether a block of the program is a net whose inputs are compared where it is called.
pub(crate) fn is_top(cx: &Context<'_>, unit: UnitId, inner: UnitId) -> bool {
    unit.0 == 0 && cx.layout.net_form == NetForm::Fast && cx.unit_layout(inner).net.is_some()
}

/// Writes the functions that make the scans of the program's nets, each called only when something may happen.
pub(crate) fn net_scans(out: &mut String, statics: &mut Statics, cx: &Context<'_>) {
    for (index, name) in cx.layout.net_scans.iter().enumerate().filter_map(|(i, name)| Some((i, name.as_ref()?))) {
        let call = top_call(cx, Scope::of(UnitId(0)), BlockId(index as u32));
        let Some(inner) = call.block().unit.and_then(|inner| Body::new(cx, inner)) else {
            continue;
        };
        let Some(net) = NetBody::of(&inner) else {
            continue;
        };
        let (instance, tag) = (instance(&call), net.tag());
        let _ = writeln!(
            out,
            "/* A scan of {}: takes its inputs in if one changed. */\n\
             PCL2_SHARED void {name}({} *self, int32_t changed)\n{{",
            instance.trim_start_matches("self->"),
            cx.name
        );
        let inputs = top_inputs(statics, &call);
        if inputs.iter().any(Input::may_change) {
            out.push_str("    if (changed) {\n");
            take_top(out, &net, &instance, &inputs);
            out.push_str("    }\n");
        }
        let _ = writeln!(out, "    {tag}_scan(&{instance}, changed != 0);\n}}\n");
    }
}

/// Takes the inputs of a net of the program in: where it is the only one of its kind, without the way of a function.
fn take_top(out: &mut String, net: &NetBody<'_, '_, '_>, instance: &str, inputs: &[Input]) {
    if net.body.layout.calls == 1 {
        let kept = format!("{instance}.net.");
        inputs.iter().for_each(|input| take_if_changed(out, net, &kept, input, "        ", ""));
        return;
    }
    let ports = inputs.iter().take(net.body.layout.ports.len());
    let arguments: Vec<&str> = ports.map(|input| input.from.as_str()).collect();
    let _ = writeln!(out, "        (void){}_inputs(&{instance}, {});", net.tag(), arguments.join(", "));
}

fn top_call<'c, 'a>(cx: &'c Context<'a>, scope: Scope<'c>, id: BlockId) -> Call<'c, 'a> {
    Call::new(cx, UnitId(0), id, Caller::Step(scope), None)
}

fn instance(call: &Call<'_, '_>) -> String {
    let mut instance = String::new();
    expr::block(&mut instance, call.cx, call.scope(), call.id);
    instance
}

fn top_inputs(statics: &mut Statics, call: &Call<'_, '_>) -> Vec<Input> {
    statements::inputs_of(statics, call, &instance(call))
}

/// Writes the scan of a net that is a block of the program: one in which nothing can happen is over at once.
pub(crate) fn top(out: &mut String, statics: &mut Statics, cx: &Context<'_>, scope: Scope<'_>, id: BlockId) {
    let call = top_call(cx, scope, id);
    let (Some(inner), Some(name)) = (call.block().unit, &cx.layout.net_scans[id.0 as usize]) else {
        return;
    };
    let layout = cx.unit_layout(inner);
    let (instance, tag) = (instance(&call), &layout.tag);
    let changes = top_changes(statics, &call);
    let mut awake = layout.net.as_ref().map_or_else(Vec::new, |net| fast::awake(net, &format!("{instance}.")));
    out.push_str("    {\n");
    let changed = if changes.is_empty() {
        "0"
    } else {
        let _ = writeln!(out, "        const int32_t changed =\n            {};", changes.join(" |\n            "));
        awake.insert(0, "changed".to_owned());
        "changed"
    };
    let _ = write!(
        out,
        "        if ({}) {{
            {name}(self, {changed});
        }} else {{
            {tag}_pass(&{instance});
        }}
    }}
",
        awake.join(" | ")
    );
}

/// What tells that an input of a net of the program changed: one comparison for ints that stand side by side.
fn top_changes(statics: &mut Statics, call: &Call<'_, '_>) -> Vec<String> {
    let inputs = top_inputs(statics, call);
    let places: Vec<Option<(u32, u32)>> = inputs.iter().map(|input| side_by_side(call, input)).collect();
    let mut changes = Vec::new();
    let mut first = 0;
    while first < inputs.len() {
        let run = run_length(&places[first..]);
        if run >= RUN {
            changes.push(run_change(statics, call, first, run));
            first += run;
        } else {
            changes.extend(inputs[first].change());
            first += 1;
        }
    }
    changes
}

/// Where an int stands in the net's instance and among the program's inputs.
fn side_by_side(call: &Call<'_, '_>, input: &Input) -> Option<(u32, u32)> {
    let (signal, port) = input.port?;
    let source = call.block().ports.get(port as usize).and_then(Source::signal)?;
    let here = call.cx.unit_layout(call.block().unit?).stores[signal.0 as usize];
    let there = call.cx.unit_layout(call.unit).stores[source.0 as usize];
    let ints = input.ty == Type::INT && call.body().signal(source).ty == Type::INT;
    match (here, there) {
        (Store::Slot(slot), Store::Input(input)) if ints => Some((slot, input)),
        _ => None,
    }
}

/// How many of the first inputs stand side by side on both sides.
fn run_length(places: &[Option<(u32, u32)>]) -> usize {
    let Some(Some((slot, input))) = places.first() else {
        return 0;
    };
    let follows = |(i, place): (u32, &Option<(u32, u32)>)| *place == Some((slot + i, input + i));
    (0..).zip(places).take_while(|(i, place)| follows((*i, place))).count()
}

fn run_change(statics: &mut Statics, call: &Call<'_, '_>, first: usize, run: usize) -> String {
    let members = top_inputs(statics, &top_call(call.cx, Scope::MEMBERS, call.id));
    let name = &call.cx.name;
    let place = |member: &str| format!("(const char *)self + offsetof({name}, {member})");
    let Input { to, from, .. } = &members[first];
    format!(
        "/* {from} to {} */\n            pcl2_net_differ_ints({},\n                {}, {run})",
        members[first + run - 1].from,
        place(to),
        place(from)
    )
}

/// Takes the arguments in: they stay until the next scan.
pub(super) fn take_arguments(out: &mut String, net: &NetBody<'_, '_, '_>) {
    for (i, signal) in net.body.unit.signals.iter().enumerate() {
        if let Role::Port(port) = signal.role {
            take_argument(out, net, SignalId(i as u32), port);
        }
    }
    commands(out, net);
}

fn take_argument(out: &mut String, net: &NetBody<'_, '_, '_>, input: SignalId, port: u32) {
    let ty = net.body.unit.signal(input).ty;
    let to = |out: &mut String| expr::signal_base(out, net.body.cx, net.scope(), input);
    let argument = &net.body.layout.ports[port as usize].0;
    calls::assign(out, INDENT, ty, to, |out| {
        out.push_str(argument);
        if ty.is_scalar() { Kind::Scalar } else { Kind::Array(0) }
    });
}

/// Commands go to the words that gates clear, and the mode to one of its own.
fn commands(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let scope = net.scope();
    for (port, word) in net.net.latched() {
        let mut from = String::new();
        expr::signal_value(&mut from, net.body.cx, scope, SignalId(port), 0);
        let _ = writeln!(out, "{INDENT}{} = {from};", net.word(word.0 as usize, scope));
    }
}

/// Writes the function that takes inputs in, for nets inside others and for all instances of one kind.
pub(super) fn function(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let inputs = arguments(net);
    let sole = net.layout.top && net.body.layout.calls == 1;
    if sole || !inputs.iter().any(Input::may_change) {
        return;
    }
    let tag = net.tag();
    let _ = write!(
        out,
        "/* Takes inputs in: they stay until the next scan. Tells whether one changed. */\n\
         static int32_t {tag}_inputs(struct {tag} *self"
    );
    for (name, ty) in &net.body.layout.ports {
        let element = pcl2_lang::kernel::c_scalar(ty.scalar);
        let _ =
            if ty.is_scalar() { write!(out, ", {element} {name}") } else { write!(out, ", const {element} *{name}") };
    }
    out.push_str(")\n{\n    int32_t changed = 0;\n");
    for (name, _) in net.body.layout.ports.iter().filter(|(_, ty)| ty.elements() == 0) {
        let _ = writeln!(out, "    (void){name};");
    }
    for input in &inputs {
        take_if_changed(out, net, "self->net.", input, INDENT, "        changed = 1;\n");
    }
    out.push_str("    return changed;\n}\n\n");
}

/// The inputs of a net as its function takes them, then its commands.
fn arguments(net: &NetBody<'_, '_, '_>) -> Vec<Input> {
    let place = |signal: SignalId| {
        let mut place = String::new();
        expr::signal_base(&mut place, net.body.cx, net.scope(), signal);
        place
    };
    let mut inputs = Vec::new();
    for (i, signal) in net.body.unit.signals.iter().enumerate() {
        if let Role::Port(port) = signal.role {
            let id = SignalId(i as u32);
            let from = net.body.layout.ports[port as usize].0.clone();
            inputs.push(Input { to: place(id), from, ty: signal.ty, port: Some((id, port)) });
        }
    }
    for (port, word) in net.net.latched() {
        let to = net.word(word.0 as usize, net.scope());
        inputs.push(Input { to, from: place(SignalId(port)), ty: Type::INT, port: None });
    }
    inputs
}

/// Takes an input in if it changed, and then says so. `kept` stands before what the net keeps beside its signals.
fn take_if_changed(out: &mut String, net: &NetBody<'_, '_, '_>, kept: &str, input: &Input, indent: &str, says: &str) {
    let Some(differs) = input.differs() else {
        return;
    };
    let inner = format!("{indent}    ");
    let _ = writeln!(out, "{indent}if ({differs}) {{");
    open(out, net, kept, input, &inner);
    let write = |out: &mut String, text: &str| {
        out.push_str(text);
        if input.ty.is_scalar() { Kind::Scalar } else { Kind::Array(0) }
    };
    calls::assign(out, &inner, input.ty, |out| write(out, &input.to), |out| write(out, &input.from));
    let _ = writeln!(out, "{says}{indent}}}");
}

/// Gates that wait for an input, or for its opposite, change sides with it.
fn open(out: &mut String, net: &NetBody<'_, '_, '_>, kept: &str, input: &Input, indent: &str) {
    let mut sets: Vec<(usize, u32)> = Vec::new();
    for gate in input.port.iter().flat_map(|(signal, _)| net.layout.facts.waiting_for(*signal)) {
        add_gate(&mut sets, gate);
    }
    if sets.is_empty() {
        return;
    }
    let _ = writeln!(out, "{indent}if ({} == 0 || {} == 0) {{", input.to, input.from);
    for (set, gates) in sets {
        let _ = writeln!(out, "{indent}    {kept}open[{set}] ^= UINT32_C(0x{gates:08x});");
    }
    let _ = writeln!(out, "{indent}}}");
}

/// Writes a scan: the arguments are the inputs.
pub(super) fn take_and_scan(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let tag = net.tag();
    let arguments: Vec<&str> = net.body.layout.ports.iter().map(|(name, _)| name.as_str()).collect();
    let _ = match self::arguments(net).iter().any(Input::may_change) {
        true => writeln!(out, "    {tag}_scan(self, {tag}_inputs(self, {}));", arguments.join(", ")),
        false => writeln!(out, "    {tag}_scan(self, 0);"),
    };
}
