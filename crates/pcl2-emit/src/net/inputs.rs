//! The inputs of nets: taken in once a scan, in the fast form only if one changed.

use super::facts::add_gate;
use super::{INDENT, NetBody, statements};
use crate::NetForm;
use crate::args::{Call, Caller};
use crate::calls;
use crate::context::Context;
use crate::expr::{self, Kind, Scope};
use crate::statics::Statics;
use pcl2_lang::program::{BlockId, Role, SignalId, UnitId};
use pcl2_lang::types::Type;
use std::fmt::Write;

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
pub(super) fn take_arguments(out: &mut String, net: &NetBody<'_, '_, '_>) {
    for (i, signal) in net.body.unit.signals.iter().enumerate() {
        if let Role::Port(port) = signal.role {
            take_argument(out, net, SignalId(i as u32), port, INDENT);
        }
    }
    commands(out, net, net.scope(), INDENT);
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

/// Writes the function that takes inputs in.
pub(super) fn function(out: &mut String, net: &NetBody<'_, '_, '_>) {
    if changes(net).is_empty() {
        return;
    }
    let tag = net.tag();
    let _ = write!(
        out,
        "/* Takes inputs in. Tells whether one changed. */\nstatic int32_t {tag}_inputs(struct {tag} *self"
    );
    for (name, ty) in &net.body.layout.ports {
        let element = pcl2_lang::kernel::c_scalar(ty.scalar);
        let _ =
            if ty.is_scalar() { write!(out, ", {element} {name}") } else { write!(out, ", const {element} *{name}") };
    }
    out.push_str(")\n{\n");
    take_changed(out, net);
    out.push_str("    return changed != 0;\n}\n\n");
}

/// Writes how inputs are taken in if one changed: they stay until the next scan. Gates that wait for an input are open
/// or not from then on.
fn take_changed(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let _ = writeln!(out, "    const int32_t changed =\n        {};", changes(net).join(" |\n        "));
    out.push_str("    if (changed) {\n");
    for (i, signal) in net.body.unit.signals.iter().enumerate() {
        if let Role::Port(port) = signal.role {
            take_input(out, net, SignalId(i as u32), port);
        }
    }
    commands(out, net, net.scope(), "        ");
    out.push_str("    }\n");
}

fn take_input(out: &mut String, net: &NetBody<'_, '_, '_>, input: SignalId, port: u32) {
    let waiting = net.layout.facts.waiting_for(input).next().is_some();
    if !waiting {
        take_argument(out, net, input, port, "        ");
        return;
    }
    let mut place = String::new();
    expr::signal_base(&mut place, net.body.cx, net.scope(), input);
    let argument = &net.body.layout.ports[port as usize].0;
    let _ = writeln!(out, "        if ({place} != {argument}) {{");
    open(out, net, input, port);
    take_argument(out, net, input, port, "            ");
    out.push_str("        }\n");
}

/// Gates that wait for an input, or for its opposite, change sides with it.
fn open(out: &mut String, net: &NetBody<'_, '_, '_>, input: SignalId, port: u32) {
    let mut sets: Vec<(usize, u32)> = Vec::new();
    for gate in net.layout.facts.waiting_for(input) {
        add_gate(&mut sets, gate);
    }
    if sets.is_empty() {
        return;
    }
    let mut place = String::new();
    expr::signal_base(&mut place, net.body.cx, net.scope(), input);
    let argument = &net.body.layout.ports[port as usize].0;
    let _ = writeln!(out, "            if (({argument} != 0) != ({place} != 0)) {{");
    for (set, gates) in sets {
        let _ = writeln!(out, "                self->net.open[{set}] ^= UINT32_C(0x{gates:08x});");
    }
    out.push_str("            }\n");
}

/// What tells that an input differs from the last scan's.
fn changes(net: &NetBody<'_, '_, '_>) -> Vec<String> {
    let mut changes = Vec::new();
    let port_name = |port: u32| &net.body.layout.ports[port as usize].0;
    for (i, signal) in net.body.unit.signals.iter().enumerate() {
        let Role::Port(port) = signal.role else {
            continue;
        };
        if signal.ty.elements() > 0 {
            let mut place = String::new();
            expr::signal_base(&mut place, net.body.cx, net.scope(), SignalId(i as u32));
            changes.push(statements::differs(signal.ty, &place, port_name(port)));
        }
    }
    for (port, word) in &net.net.momentary {
        let Role::Port(port) = net.body.unit.signals[*port as usize].role else {
            continue;
        };
        changes.push(statements::differs(Type::INT, &net.word(word.0 as usize, net.scope()), port_name(port)));
    }
    changes
}

/// Writes a scan: the arguments are the inputs.
pub(super) fn take_and_scan(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let tag = net.tag();
    let arguments: Vec<&str> = net.body.layout.ports.iter().map(|(name, _)| name.as_str()).collect();
    let _ = match changes(net).is_empty() {
        true => writeln!(out, "    {tag}_scan(self, 0);"),
        false => writeln!(out, "    {tag}_scan(self, {tag}_inputs(self, {}));", arguments.join(", ")),
    };
}
