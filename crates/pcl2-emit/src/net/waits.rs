//! The box phase as code: boxes that do something after their token came, and those that make tokens.

use super::facts::{generates, waits};
use super::firing::run;
use super::tokens::{self, Held};
use super::{NetBody, statements};
use crate::statics::Statics;
use pcl2_lang::net::{Generation, Kind, NetBox, Process, StatementId};
use pcl2_lang::program::BlockId;
use std::fmt::Write;

const INNER: &str = "                ";

/// Writes the function of the box phase, if there is anything to do in it.
pub(super) fn function(out: &mut String, statics: &mut Statics, net: &NetBody<'_, '_, '_>) {
    if !net.layout.keeps("waiting") {
        return;
    }
    let (tag, sets) = (net.tag(), net.net.boxes.len().div_ceil(32));
    let _ = writeln!(
        out,
        "/* The box phase: the boxes that wait, in the order of the file. Tells whether anything happened. */"
    );
    let _ = writeln!(
        out,
        "static int32_t {tag}_wait(struct {tag} *self)\n{{\n    int32_t happened = 0;\n    uint32_t waiting = 0;"
    );
    let _ = writeln!(out, "    for (int32_t set = 0; set < {sets}; set++) {{");
    out.push_str("        uint32_t boxes = self->net.waiting[set];\n        while (boxes != 0) {\n");
    out.push_str(
        "            const int32_t place = 32 * set + pcl2_net_lowest(boxes);\n            boxes &= boxes - 1;\n",
    );
    out.push_str("            switch (place) {\n");
    for (i, place) in net.net.boxes.iter().enumerate().filter(|(_, place)| waits(place) || generates(place)) {
        let mut text = String::new();
        self::place(&mut text, statics, net, place, &net.layout.boxes[i]);
        let _ = write!(out, "            case {}: {{\n{}            }}\n", net.layout.boxes[i], text);
    }
    out.push_str("            default:\n                break;\n            }\n        }\n");
    out.push_str("        waiting |= self->net.waiting[set];\n    }\n");
    out.push_str("    self->net.waits = waiting != 0;\n    return happened;\n}\n\n");
}

fn place(out: &mut String, statics: &mut Statics, net: &NetBody<'_, '_, '_>, place: &NetBox, name: &str) {
    statements::comment(out, INNER, net.body.cx.sources.text(place.span));
    match &place.kind {
        Kind::Time(time) => self::time(out, statics, net, *time, name),
        Kind::Action(actions) => {
            for statement in actions {
                run(out, statics, net, *statement, (&gate_of(net, name), &[]), INNER);
            }
            excite(out, net, name, "PCL2_NET_DONE", INNER);
        }
        Kind::Process(process) => self::process(out, statics, net, process, place, name),
        Kind::Generation(generation) => self::generation(out, statics, net, generation, place, name),
        Kind::State | Kind::Capacity | Kind::Count | Kind::Macro(_) => {}
    }
    let _ = writeln!(out, "{INNER}break;");
}

/// The gate that put the token.
fn gate_of(net: &NetBody<'_, '_, '_>, name: &str) -> String {
    if net.layout.keeps("by") { format!("self->net.phase[{name}] >> 2") } else { "0".to_owned() }
}

/// The box is excited, and waits no more.
fn excite(out: &mut String, net: &NetBody<'_, '_, '_>, name: &str, phase: &str, indent: &str) {
    set_phase(out, name, phase, indent);
    let tag = net.tag();
    let _ = writeln!(out, "{indent}pcl2_net_remove(self->net.waiting, {name});\n{indent}{tag}_excite(self, {name});");
    let _ = writeln!(out, "{indent}happened = 1;");
}

fn set_phase(out: &mut String, name: &str, phase: &str, indent: &str) {
    let _ = writeln!(out, "{indent}self->net.phase[{name}] = (self->net.phase[{name}] & ~3) | {phase};");
}

/// A time begins.
fn since(out: &mut String, net: &NetBody<'_, '_, '_>, name: &str, indent: &str) {
    if net.layout.keeps("since") {
        let _ = writeln!(out, "{indent}self->net.since[{name}] = self->net.now;");
    }
}

/// Whether a statement is a number.
fn is_constant(net: &NetBody<'_, '_, '_>, statement: StatementId) -> bool {
    let block = net.body.unit.block(BlockId(statement.0));
    block.ports.iter().all(|source| matches!(source, pcl2_lang::program::Source::Constant(_)))
}

/// Whether a box has had its token for a time.
fn over(name: &str, time: &str) -> String {
    format!("pcl2_net_over(self->net.now - self->net.since[{name}], {time})")
}

fn time(out: &mut String, statics: &mut Statics, net: &NetBody<'_, '_, '_>, time: StatementId, name: &str) {
    let value = tokens::time(out, statics, net, time, INNER);
    let passed = over(name, &value);
    if is_constant(net, time) {
        let _ = writeln!(out, "{INNER}if ({passed}) {{");
        excite(out, net, name, "PCL2_NET_DONE", "                    ");
        let _ = writeln!(out, "{INNER}}}");
        return;
    }
    // The time may become longer again while the token is there.
    let (tag, inner) = (net.tag(), "                    ");
    let _ = writeln!(out, "{INNER}const int32_t done = {passed};");
    let _ = writeln!(out, "{INNER}if (done != (self->net.phase[{name}] & 3)) {{");
    set_phase(out, name, "done", inner);
    let _ = writeln!(out, "{inner}if (done) {{\n{inner}    {tag}_excite(self, {name});\n{inner}}} else {{");
    let _ = writeln!(out, "{inner}    {tag}_calm(self, {name});\n{inner}}}\n{inner}happened = 1;\n{INNER}}}");
}

fn process(
    out: &mut String,
    statics: &mut Statics,
    net: &NetBody<'_, '_, '_>,
    process: &Process,
    place: &NetBox,
    name: &str,
) {
    let gate = gate_of(net, name);
    let inner = "                    ";
    let _ = writeln!(out, "{INNER}if ((self->net.phase[{name}] & 3) == PCL2_NET_NEW) {{");
    for statement in &process.enter {
        run(out, statics, net, *statement, (&gate, &[]), inner);
    }
    since(out, net, name, inner);
    set_phase(out, name, "PCL2_NET_RUNNING", inner);
    let _ = writeln!(out, "{inner}happened = 1;\n{inner}break;\n{INNER}}}");
    let complete = match process.until {
        Some(until) => tokens::condition(out, statics, net, until, &[], INNER),
        None => "1".to_owned(),
    };
    let late = match process.within {
        Some(within) => {
            let value = tokens::time(out, statics, net, within, INNER);
            over(name, &value)
        }
        None => "0".to_owned(),
    };
    let _ = writeln!(out, "{INNER}const int32_t complete = {complete};\n{INNER}if (complete || {late}) {{");
    if process.within.is_some() {
        let _ = writeln!(
            out,
            "{inner}if (!complete) {{\n{inner}    pcl2_net_fault(&self->status, PCL2_NET_TIMEOUT);\n{inner}}}"
        );
    }
    finish(out, statics, net, process, place, name, &gate);
    let _ = writeln!(out, "{INNER}}}");
}

fn finish(
    out: &mut String,
    statics: &mut Statics,
    net: &NetBody<'_, '_, '_>,
    process: &Process,
    place: &NetBox,
    name: &str,
    gate: &str,
) {
    let inner = "                    ";
    if process.after.is_empty() {
        excite(out, net, name, "PCL2_NET_READY", inner);
        return;
    }
    let [cause, ready] = net.answers(place);
    let _ = writeln!(out, "{inner}{cause} = !complete;\n{inner}{ready} = 1;");
    for statement in &process.after {
        run(out, statics, net, *statement, (gate, &[]), inner);
    }
    since(out, net, name, inner);
    let _ = writeln!(out, "{inner}happened = 1;");
    let _ = writeln!(out, "{inner}if ({ready} != 0) {{");
    excite(out, net, name, "PCL2_NET_READY", &format!("{inner}    "));
    let _ = writeln!(out, "{inner}}}");
}

fn generation(
    out: &mut String,
    statics: &mut Statics,
    net: &NetBody<'_, '_, '_>,
    generation: &Generation,
    place: &NetBox,
    name: &str,
) {
    let inner = "                    ";
    let condition = tokens::condition(out, statics, net, generation.when, &[], INNER);
    let capacity = place.capacity.unwrap_or(1);
    let _ = write!(
        out,
        "{INNER}const int32_t now = {condition};
{INNER}const int32_t edge = now && (self->net.phase[{name}] & 1) == 0;
{INNER}int32_t wanted = ((self->net.phase[{name}] & 2) != 0) + edge;
{INNER}while (wanted > 0 && self->box[{name}] < {capacity}) {{
"
    );
    let id = net.id(place);
    tokens::make(out, net, id, inner);
    tokens::lay(out, net, id, id, inner);
    let _ = write!(
        out,
        "{inner}self->box[{name}] += 1;
{inner}{tag}_touch(self, {name});
{inner}{tag}_excite(self, {name});
",
        tag = net.tag()
    );
    let hands = [(id, Held::At(format!("self->box[{name}] - 1")))];
    for statement in &generation.enter {
        run(out, statics, net, *statement, ("0", &hands), inner);
    }
    let _ = write!(
        out,
        "{inner}wanted--;
{inner}happened = 1;
{INNER}}}
{INNER}if (wanted > 1) {{
{inner}pcl2_net_fault(&self->status, PCL2_NET_LOST);
{inner}pcl2_net_count(&self->net.lost);
{INNER}}}
{INNER}self->net.phase[{name}] = now | (wanted > 0 ? 2 : 0);
"
    );
}
