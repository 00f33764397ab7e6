//! The fast form of nets with modes, and of those inside them: what an operator says, and what outputs are meanwhile.

use super::fast;
use super::layout::{MODE_COUNTERS, STOOD};
use super::{INDENT, NetBody};
use crate::shape::Field;
use pcl2_lang::kernel::c_scalar;
use pcl2_lang::net::{Net, Operation, WordId};
use std::fmt::Write;

/// A command of an operator: its place among those of a net.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Command {
    /// One gate phase.
    Go,
    /// Fires a gate.
    Fire,
    /// Puts a token into a box.
    Put,
    /// Takes a token from a box.
    Take,
}

/// The commands that are obeyed in manual mode, in order.
pub(super) const MANUAL: [Command; 3] = [Command::Fire, Command::Put, Command::Take];

/// The word of a command, if the net has it.
pub(super) fn command(net: &Net, command: Command) -> Option<WordId> {
    net.operation.as_ref().and_then(|operation| operation.commands[command as usize])
}

/// The member with the value that an output has while the net is stopped, and else while it is not.
fn aside(index: usize) -> String {
    format!("aside{}", index + 1)
}

/// The members that a net with modes keeps, or one inside such a net.
pub(super) fn fields(net: &Net, clocked: bool, moded: bool) -> Vec<Field> {
    let field = |name: &str, element: &'static str| Field { name: name.to_owned(), element, count: None };
    let mut fields = Vec::new();
    fields.extend(clocked.then(|| field("clock", "int64_t")));
    fields.extend(moded.then(|| field("mode", "int32_t")));
    fields.extend(net.blocked.map(|_| field("blocked", "int32_t")));
    let Some(operation) = &net.operation else {
        return fields;
    };
    fields.extend(clocked.then(|| field(STOOD, "int64_t")));
    fields.extend(MODE_COUNTERS.map(|name| field(name, "int32_t")));
    fields.extend((!operation.stops.is_empty()).then(|| field("switched", "int32_t")));
    for (i, (word, _)) in operation.stops.iter().enumerate() {
        fields.push(field(&aside(i), c_scalar(net.words[word.0 as usize].scalar)));
    }
    let moves = command(net, Command::Put).is_some() || command(net, Command::Take).is_some();
    fields.extend((moves && net.exit.is_some()).then(|| field("within", "int32_t")));
    fields
}

/// Writes what outputs are while the net is stopped.
pub(super) fn start(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let stops = net.net.operation.iter().flat_map(|operation| &operation.stops).enumerate();
    for (i, (word, value)) in stops.filter_map(|(i, (word, value))| Some((i, (word, value.as_ref()?)))) {
        if !crate::text::number(value, 0).is_zero() {
            let mut text = String::new();
            let scalar = net.net.words[word.0 as usize].scalar;
            crate::text::element(&mut text, value, 0, scalar, net.body.cx.program.width);
            let _ = writeln!(out, "    self->net.{} = {text};", aside(i));
        }
    }
}

/// Writes the functions that say how a scan begins under an operator.
pub(super) fn functions(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let Some(operation) = &net.net.operation else {
        return;
    };
    if operation.commands.iter().any(Option::is_some) {
        record(out, net);
    }
    mode(out, net, operation);
    if !operation.stops.is_empty() {
        swap(out, net, operation);
    }
}

fn record(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let tag = net.tag();
    let _ = write!(
        out,
        "/* Records a command, if one came: it was obeyed or is refused. */
static void {tag}_record(struct {tag} *self, int32_t command, int32_t obeyed)
{{
    if (command != 0) {{
        pcl2_net_fault(&self->status, obeyed ? PCL2_NET_FORCED : PCL2_NET_REFUSED);
        pcl2_net_count(obeyed ? &self->net.forced : &self->net.refused);
    }}
}}

"
    );
}

fn mode(out: &mut String, net: &NetBody<'_, '_, '_>, operation: &Operation) {
    let (tag, scope) = (net.tag(), net.scope());
    let word = |word: WordId| net.word(word.0 as usize, scope);
    let _ = writeln!(out, "/* The mode of a scan; commands of other modes are refused. */");
    let _ = writeln!(out, "static int32_t {tag}_mode(struct {tag} *self)\n{{");
    let _ = writeln!(out, "    const int32_t mode = {};", word(operation.mode.1));
    match command(net.net, Command::Go).map(word) {
        Some(go) => {
            let _ = writeln!(out, "    const int32_t go = pcl2_net_command(&{go});");
            out.push_str("    if (mode != PCL2_NET_STEP) {\n");
            let _ = writeln!(out, "        {tag}_record(self, go, 0);\n    }}");
        }
        None => out.push_str("    const int32_t go = 0;\n"),
    }
    let manual: Vec<String> = MANUAL.iter().filter_map(|item| command(net.net, *item)).map(word).collect();
    if !manual.is_empty() {
        out.push_str("    if (mode != PCL2_NET_MANUAL) {\n");
        for command in manual {
            let _ = writeln!(out, "        {tag}_record(self, pcl2_net_command(&{command}), 0);");
        }
        out.push_str("    }\n");
    }
    out.push_str(
        "    if (mode == PCL2_NET_STEP) {
        return go != 0 ? PCL2_NET_AUTOMATIC : PCL2_NET_STEP;
    }
    return mode == PCL2_NET_AUTOMATIC || mode == PCL2_NET_MANUAL ? mode : PCL2_NET_STOPPED;
}

",
    );
}

fn swap(out: &mut String, net: &NetBody<'_, '_, '_>, operation: &Operation) {
    let tag = net.tag();
    let _ = writeln!(out, "/* Outputs and what they are while the net is stopped change places. */");
    let _ = writeln!(out, "static void {tag}_swap(struct {tag} *self)\n{{");
    for (i, (word, _)) in operation.stops.iter().enumerate() {
        let (output, aside) = (net.word(word.0 as usize, net.scope()), aside(i));
        let ty = c_scalar(net.net.words[word.0 as usize].scalar);
        let _ = writeln!(out, "    const {ty} kept{} = {output};", i + 1);
        let _ = writeln!(out, "    {output} = self->net.{aside};\n    self->net.{aside} = kept{};", i + 1);
    }
    out.push_str("}\n\n");
}

/// Writes how a scan begins.
pub(super) fn begin(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let keeps = |name: &str| net.layout.keeps(name);
    if keeps("blocked") {
        out.push_str("    self->net.blocked = 0;\n");
    }
    let Some(operation) = &net.net.operation else {
        return;
    };
    let tag = net.tag();
    if keeps(STOOD) {
        let _ = writeln!(out, "    self->net.now = self->net.clock - self->net.{STOOD};");
    }
    let _ = writeln!(out, "    self->net.mode = {tag}_mode(self);");
    if operation.stops.is_empty() {
        return;
    }
    let _ =
        writeln!(out, "    self->net.switched = 0;\n    if (self->net.halted) {{\n        {tag}_swap(self);\n    }}");
    let held: Vec<_> = operation.stops.iter().enumerate().filter(|(_, (_, value))| value.is_none()).collect();
    if !held.is_empty() {
        // Outputs that hold are what they were before the stop, whatever nets inside do.
        out.push_str("    if (!self->net.halted && self->net.mode == PCL2_NET_STOPPED) {\n");
        for (i, (word, _)) in held {
            let _ = writeln!(out, "        self->net.{} = {};", aside(i), net.word(word.0 as usize, net.scope()));
        }
        out.push_str("    }\n");
    }
}

/// Writes what a net inside is told before its scan begins: the mode and the time.
pub(super) fn hand_down(out: &mut String, net: &NetBody<'_, '_, '_>, part: usize) {
    let Some(inner) = net.parts().find(|(index, ..)| *index == part).and_then(|(.., layout)| layout.net.as_ref())
    else {
        return;
    };
    let member = fast::member(net, part);
    if inner.timed {
        let _ = writeln!(out, "    self->{member}.net.now = self->net.now;");
    }
    for name in ["clock", "mode"].into_iter().filter(|name| inner.keeps(name) && net.layout.keeps(name)) {
        let _ = writeln!(out, "    self->{member}.net.{name} = self->net.{name};");
    }
}

/// What stands before what is done in some modes only.
pub(super) fn unless(net: &NetBody<'_, '_, '_>, mode: &str) -> Option<String> {
    net.layout.keeps("mode").then(|| format!("self->net.mode != {mode}"))
}

/// Writes the end of a scan: what BLOCKED tells; a stopped net shows what its outputs are meanwhile, and its time stands.
pub(super) fn end(out: &mut String, net: &NetBody<'_, '_, '_>) {
    if let Some(word) = net.net.blocked {
        let told = net.word(word.0 as usize, net.scope());
        let between = unless(net, "PCL2_NET_STEP");
        let indent = if between.is_some() { "        " } else { INDENT };
        out.extend(between.as_ref().map(|unless| format!("    if ({unless}) {{\n")));
        let _ = writeln!(out, "{indent}{told} = self->net.blocked;");
        if net.layout.facts.tracked[word.0 as usize] {
            let _ = writeln!(out, "{indent}pcl2_net_counted(&self->net.wrote[{}]);", word.0);
        }
        out.push_str(if between.is_some() { "    }\n" } else { "" });
    }
    let Some(operation) = &net.net.operation else {
        return;
    };
    let tag = net.tag();
    out.push_str("    const int32_t stopped = self->net.mode == PCL2_NET_STOPPED;\n");
    let mut meanwhile = String::new();
    if !operation.stops.is_empty() {
        let _ = writeln!(meanwhile, "        {tag}_swap(self);");
    }
    if net.layout.keeps(STOOD) {
        let _ = writeln!(meanwhile, "        self->net.{STOOD} += self->net.period;");
    }
    if !meanwhile.is_empty() {
        let _ = writeln!(out, "    if (stopped) {{\n{meanwhile}    }}");
    }
    if !operation.stops.is_empty() {
        out.push_str("    self->net.switched = self->net.halted != stopped;\n");
    }
    out.push_str("    self->net.halted = stopped;\n");
}
