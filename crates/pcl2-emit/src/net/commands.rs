//! The fast form of commands: an operator fires a gate, puts a token into a box, takes one from it.

use super::modes::{self, Command, MANUAL};
use super::{NetBody, fast, firing, gates, tokens};
use crate::statics::Statics;
use pcl2_lang::net::{Arc, BoxId, Kind};
use std::fmt::Write;

const CASE: &str = "        ";
const FORCED: &str = "forced || ";

/// Whether a command can fire gates.
pub(super) fn fires(net: &NetBody<'_, '_, '_>) -> bool {
    modes::command(net.net, Command::Fire).is_some() && !net.net.gates.is_empty()
}

/// Whether a net obeys any command in manual mode.
pub(super) fn obeys(net: &NetBody<'_, '_, '_>) -> bool {
    MANUAL.iter().any(|command| modes::command(net.net, *command).is_some())
}

/// A condition of a gate, which a command fires whatever it says.
pub(super) fn or_forced(net: &NetBody<'_, '_, '_>, condition: String) -> String {
    if fires(net) { format!("{FORCED}({condition})") } else { condition }
}

/// All of these tests, on lines of this indent.
pub(super) fn all(tests: &[String], indent: &str) -> String {
    let within = |test: &String| if test.starts_with(FORCED) { format!("({test})") } else { test.clone() };
    match tests {
        [sole] => sole.clone(),
        _ => tests.iter().map(within).collect::<Vec<_>>().join(&format!("\n{indent}    && ")),
    }
}

/// Writes the gate phase of a net in manual mode.
pub(super) fn functions(out: &mut String, net: &NetBody<'_, '_, '_>) {
    if !obeys(net) {
        return;
    }
    let tag = net.tag();
    let mut text = format!("/* The gate phase in manual mode. */\nstatic void {tag}_obey(struct {tag} *self)\n{{\n");
    for command in MANUAL {
        let Some(word) = modes::command(net.net, command) else {
            continue;
        };
        let (name, function) = match command {
            Command::Fire => ("fire", "force"),
            Command::Put => ("put", "force_put"),
            Command::Take => ("take", "force_take"),
            Command::Go => continue,
        };
        let word = net.word(word.0 as usize, net.scope());
        let _ = writeln!(text, "    const int32_t {name} = pcl2_net_command(&{word});");
        let any = match command {
            Command::Fire => fires(net),
            Command::Put | Command::Take | Command::Go => !net.net.boxes.is_empty(),
        };
        let obeyed = if any { format!("{tag}_{function}(self, {name})") } else { "0".to_owned() };
        let _ = writeln!(text, "    {tag}_record(self, {name}, {obeyed});");
        match command {
            Command::Fire if any => force(out, net),
            Command::Put if any => put(out, net),
            Command::Take if any => take(out, net),
            Command::Go | Command::Fire | Command::Put | Command::Take => {}
        }
    }
    out.push_str(&text);
    out.push_str("}\n\n");
}

fn force(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let (tag, n) = (net.tag(), net.net.gates.len());
    let order: Vec<String> = net.net.numbered.iter().map(|gate| gate.0.to_string()).collect();
    let _ = write!(
        out,
        "/* Fires a gate, by its number in the file, whose tokens and room are there: by the rule that holds, else by the
 * first. Tells whether it did. */
static int32_t {tag}_force(struct {tag} *self, int32_t number)
{{
    static const uint16_t order[{n}] = {{{}}};
    const int32_t gate = number < 1 || number > {n} ? -1 : order[number - 1];
    if (gate < 0 || !pcl2_net_in(self->net.ready, gate)) {{
        return 0;
    }}
    switch (gate / {}) {{
",
        order.join(", "),
        gates::GATES
    );
    for word in 0..n.div_ceil(gates::GATES) {
        let _ = writeln!(
            out,
            "    case {word}:\n        return {tag}_gates_{}(self, UINT32_C(1) << (gate & 31), 1);",
            word + 1
        );
    }
    out.push_str("    default:\n        return 0;\n    }\n}\n\n");
}

/// Whether a box is where tokens of a macro come in or go out.
fn is_end(net: &NetBody<'_, '_, '_>, id: BoxId) -> bool {
    net.net.entry == Some(id) || net.net.exit == Some(id)
}

fn put(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let tag = net.tag();
    let _ = writeln!(out, "/* Puts a new token into a box that has room. Tells whether it did. */");
    let _ = writeln!(out, "static int32_t {tag}_force_put(struct {tag} *self, int32_t number)\n{{");
    if net.layout.keeps("within") {
        // A macro's own net has tokens while the macro is marked.
        out.push_str("    if (self->net.within == 1) {\n        return 0;\n    }\n");
    }
    out.push_str("    switch (number - 1) {\n");
    for (i, name) in net.layout.boxes.iter().enumerate() {
        let id = BoxId(i as u32);
        let _ = writeln!(out, "    case {name}:");
        let mut tests = gates::box_room(net, id, 1);
        tests.extend((net.layout.keeps("within") && is_end(net, id)).then(|| "self->net.within == 0".to_owned()));
        if !tests.is_empty() {
            let _ = writeln!(out, "{CASE}if (!({})) {{\n{CASE}    return 0;\n{CASE}}}", tests.join(" && "));
        }
        tokens::make(out, net, id, CASE);
        firing::put(out, net, &Arc { place: id, weight: 1 }, id, (1, "0"), CASE);
        let _ = writeln!(out, "{CASE}return 1;");
    }
    out.push_str("    default:\n        return 0;\n    }\n}\n\n");
}

fn take(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let (tag, n) = (net.tag(), net.net.boxes.len());
    let within = net.layout.keeps("within");
    let counts = within && (0..n).any(|i| !is_end(net, BoxId(i as u32)));
    let _ = writeln!(out, "/* Takes the first token of a box. Tells whether it did. */");
    let _ = writeln!(out, "static int32_t {tag}_force_take(struct {tag} *self, int32_t number)\n{{");
    if counts {
        let _ = write!(
            out,
            "    int32_t marked = 0;
    for (int32_t place = 0; place < {n}; place++) {{
        marked += self->box[place] - self->net.taken[place] != 0 || self->net.filled[place] != 0;
    }}
"
        );
    }
    out.push_str("    switch (number - 1) {\n");
    for (i, name) in net.layout.boxes.iter().enumerate() {
        let id = BoxId(i as u32);
        let left = net.left(id);
        let mut tests = vec![format!("{left} <= 0")];
        if within && is_end(net, id) {
            tests.push("self->net.within != 0".to_owned());
        } else if within {
            // It keeps its last token.
            tests.push(format!("(self->net.within != 0 && marked == 1 && {left} + self->net.filled[{name}] == 1)"));
        }
        let _ = writeln!(out, "    case {name}:\n{CASE}if ({}) {{\n{CASE}    return 0;\n{CASE}}}", tests.join(" || "));
        if let Kind::Macro(part) = net.net.place(id).kind {
            let part = part.0 as usize;
            let _ = writeln!(out, "{CASE}{}_empty(&self->{});", fast::part_tag(net, part), fast::member(net, part));
        }
        let ordered = net.carries(id) && !net.is_single(id);
        let indent = if ordered { "            " } else { CASE };
        out.push_str(if ordered { "        {\n" } else { "" });
        if ordered {
            tokens::take(out, net, id, &[], indent);
        }
        let _ = writeln!(out, "{indent}{tag}_take(self, {name}, 1);");
        out.push_str(if ordered { "        }\n" } else { "" });
        let _ = writeln!(out, "{CASE}return 1;");
    }
    out.push_str("    default:\n        return 0;\n    }\n}\n\n");
}

/// Writes, behind the rules of a gate, how a command fires it if none of them holds: by the first.
pub(super) fn first_rule(
    out: &mut String,
    statics: &mut Statics,
    net: &NetBody<'_, '_, '_>,
    way: &firing::Way<'_>,
    indent: &str,
) {
    let room = gates::room(net, way.gate, way.rule);
    let tests: Vec<String> = std::iter::once("forced".to_owned()).chain(room).collect();
    let _ = writeln!(out, "{indent}if ({}) {{", tests.join(" && "));
    firing::fire(out, statics, net, way, &format!("{indent}    "));
    let _ = writeln!(out, "{indent}}}");
}
