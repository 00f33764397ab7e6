//! Gates as code: each under its source line, tried only while its first box is ready.

use super::firing::{Way, fire};
use super::{NetBody, choice, commands, facts, fast, statements};
use crate::statics::Statics;
use pcl2_lang::net::{Arc, BoxId, Gate, Kind, Rule, StatementId, Tested};
use std::fmt::Write;

/// The gates of one function.
pub(super) const GATES: usize = 32;
/// So many gates are passed over at once when none of them is ready.
const GROUP: usize = 4;
/// Indent of what a gate does.
pub(super) const INDENT: &str = "            ";

/// Writes the functions that try gates, one for each word of the set of ready ones.
pub(super) fn functions(out: &mut String, statics: &mut Statics, net: &NetBody<'_, '_, '_>) {
    for (word, gates) in net.net.gates.chunks(GATES).enumerate() {
        let tag = net.tag();
        let _ = writeln!(
            out,
            "/* Tries those of gates {} to {} whose first box is ready and whose input is there, in the\n * order of a scan. Tells whether one fired. */",
            word * GATES + 1,
            word * GATES + gates.len()
        );
        let forced = if commands::fires(net) { ", int32_t forced" } else { "" };
        let _ =
            writeln!(out, "static int32_t {tag}_gates_{}(struct {tag} *self, uint32_t ready{forced})\n{{", word + 1);
        out.push_str("    int32_t fired = 0;\n");
        out.push_str(if commands::fires(net) { "    (void)forced;\n" } else { "" });
        for (group, members) in gates.chunks(GROUP).enumerate() {
            let set = (0..members.len()).fold(0, |set, i| set | bit(group * GROUP + i));
            let _ = writeln!(out, "    if ((ready & UINT32_C(0x{set:08x})) != 0) {{");
            for (i, gate) in members.iter().enumerate() {
                let place = group * GROUP + i;
                let _ = writeln!(out, "        if ((ready & UINT32_C(0x{:08x})) != 0) {{", bit(place));
                tried(out, statics, net, gate, word * GATES + place);
                out.push_str("        }\n");
            }
            out.push_str("    }\n");
        }
        out.push_str("    return fired;\n}\n\n");
    }
}

/// A gate in the set of its word.
fn bit(gate: usize) -> u32 {
    1 << (gate % GATES)
}

/// Writes a gate; one that is left before its end stands in a block that can be left.
fn tried(out: &mut String, statics: &mut Statics, net: &NetBody<'_, '_, '_>, gate: &Gate, index: usize) {
    let mut text = String::new();
    self::gate(&mut text, statics, net, gate, index);
    if !text.contains("break;") {
        out.push_str(&text);
        return;
    }
    let _ = writeln!(out, "{INDENT}do {{");
    for line in text.lines() {
        out.extend(["    ", line, "\n"]);
    }
    let _ = writeln!(out, "{INDENT}}} while (0);");
}

fn gate(out: &mut String, statics: &mut Statics, net: &NetBody<'_, '_, '_>, gate: &Gate, index: usize) {
    statements::comment(out, INDENT, net.body.cx.sources.text(gate.span));
    if choice::looks(net, gate) {
        choice::gate(out, statics, net, gate, index);
        return;
    }
    let enabled = enabled(net, gate);
    let sole = gate.rules.len() == 1;
    if !sole && !enabled.is_empty() {
        let _ = writeln!(out, "{INDENT}if (!({})) {{\n{INDENT}    break;\n{INDENT}}}", enabled.join(" && "));
    }
    let mut permits = None;
    for rule in &gate.rules {
        if !sole {
            statements::comment(out, INDENT, net.body.cx.sources.text(rule.span));
        }
        let mut tests = if sole { enabled.clone() } else { Vec::new() };
        // The input that a gate waits for first is looked at when it changes.
        let known = net.layout.facts.literals[index];
        let asked = |condition: &StatementId| {
            let same = facts::literal(net.body.cx.program, net.body.unit, *condition);
            same.is_none() || same != known
        };
        let condition = rule.condition.filter(|condition| !sole || asked(condition));
        let condition = condition.map(|condition| statements::condition(out, statics, net, condition, INDENT));
        tests.extend(condition.map(|text| if sole { commands::or_forced(net, text) } else { text }));
        let mut allowed = room(net, gate, rule);
        // What permissives compute on their way is there once for all rules.
        let permits = permits.get_or_insert_with(|| {
            let asked = gate.permits.iter().filter(|permit| asked(&permit.condition));
            let text = |condition| statements::condition(out, statics, net, condition, INDENT);
            let texts = asked.map(|permit| permit.condition).map(text);
            texts.map(|text| commands::or_forced(net, text)).collect::<Vec<_>>()
        });
        allowed.extend(permits.iter().cloned());
        if sole {
            tests.append(&mut allowed);
        }
        let fire = |out: &mut String, statics: &mut Statics, indent: &str| {
            fire(out, statics, net, &Way { gate, rule, index, hands: &[] }, indent);
        };
        match (tests.is_empty(), allowed.is_empty()) {
            (true, true) => fire(out, statics, INDENT),
            (false, true) => guarded(out, &tests, |out| {
                fire(out, statics, "                ");
                if !sole {
                    out.push_str("                break;\n");
                }
            }),
            (true, false) => guarded(out, &allowed, |out| fire(out, statics, "                ")),
            (false, false) => guarded(out, &tests, |out| {
                let _ = writeln!(out, "                if ({}) {{", commands::all(&allowed, "                "));
                fire(out, statics, "                    ");
                out.push_str("                }\n");
                out.push_str("                break;\n");
            }),
        }
        if !sole && rule.condition.is_none() {
            return;
        }
    }
    if let Some(rule) = gate.rules.first().filter(|_| !sole && commands::fires(net)) {
        commands::first_rule(out, statics, net, &Way { gate, rule, index, hands: &[] }, INDENT);
    }
}

fn guarded(out: &mut String, tests: &[String], body: impl FnOnce(&mut String)) {
    let _ = writeln!(out, "{INDENT}if ({}) {{", commands::all(tests, INDENT));
    body(out);
    let _ = writeln!(out, "{INDENT}}}");
}

/// What must hold of tokens.
pub(super) fn enabled(net: &NetBody<'_, '_, '_>, gate: &Gate) -> Vec<String> {
    let mut tests = Vec::new();
    for (i, arc) in gate.before.iter().enumerate() {
        before(&mut tests, net, arc, i == 0);
    }
    for read in &gate.reads {
        tests.extend(tested(net, read, true));
    }
    for inhibit in &gate.inhibits {
        tests.extend(tested(net, inhibit, false).map(|test| format!("!({test})")));
    }
    tests
}

/// The tokens of a box before a gate: they are there, nobody has taken them, and the box is excited.
fn before(tests: &mut Vec<String>, net: &NetBody<'_, '_, '_>, arc: &Arc, first: bool) {
    let (name, place) = (net.place(arc.place), net.net.place(arc.place));
    let shared = net.layout.facts.takers[arc.place.0 as usize] > 1 || fast::emptied(net, arc.place);
    let excited = excited(net, "self->", "self->net.", arc.place);
    match place.kind {
        Kind::Count => {
            tests.extend(Some(excited).filter(|_| !first));
            tests.extend(shared.then(|| format!("self->net.taken[{name}] == 0")));
        }
        Kind::State | Kind::Capacity | Kind::Generation(_) => {
            let known = first && arc.weight == 1;
            let left = if shared {
                format!("self->box[{name}] - self->net.taken[{name}]")
            } else {
                format!("self->box[{name}]")
            };
            tests.extend((!known || shared).then(|| format!("{left} >= {}", weight(arc.weight))));
        }
        Kind::Time(_) | Kind::Action(_) | Kind::Process(_) | Kind::Macro(_) => {
            let asks = !first || matches!(place.kind, Kind::Macro(_));
            tests.extend(Some(excited).filter(|_| asks));
            tests.extend(shared.then(|| format!("self->net.taken[{name}] == 0")));
            tests.extend((arc.weight > 1).then(|| "0".to_owned()));
        }
    }
}

/// A weight as an int.
pub(super) fn weight(weight: u32) -> i32 {
    i32::try_from(weight).unwrap_or(i32::MAX)
}

/// Whether a gate may take from a box. `root` and `kept` stand before its members.
fn excited(net: &NetBody<'_, '_, '_>, root: &str, kept: &str, id: BoxId) -> String {
    let (name, place) = (net.place(id), net.net.place(id));
    match place.kind {
        Kind::State | Kind::Capacity | Kind::Generation(_) => format!("{root}box[{name}] > 0"),
        Kind::Count => format!("{root}box[{name}] >= {}", weight(place.capacity.unwrap_or(1))),
        Kind::Time(_) | Kind::Action(_) => {
            format!("{root}box[{name}] > 0 && ({kept}phase[{name}] & 3) == PCL2_NET_DONE")
        }
        Kind::Process(_) => format!("{root}box[{name}] > 0 && ({kept}phase[{name}] & 3) == PCL2_NET_READY"),
        Kind::Macro(part) => {
            let exit = fast::end_of(net, part, |inner| inner.exit);
            format!("{root}box[{name}] > 0 && {root}{}.box[{exit}] > 0", fast::member(net, part.0 as usize))
        }
    }
}

/// A box that is read, or that inhibits.
fn tested(net: &NetBody<'_, '_, '_>, tested: &Tested, only_excited: bool) -> Option<String> {
    let Some(part) = tested.part else {
        return Some(test(net, "self->", "self->net.", tested, only_excited));
    };
    let inner = fast::inner(net, part.0 as usize)?;
    let inside = NetBody::of(&inner)?;
    let root = format!("self->{}.", fast::member(net, part.0 as usize));
    let kept = format!("{root}net.");
    Some(test(&inside, &root, &kept, tested, only_excited))
}

fn test(net: &NetBody<'_, '_, '_>, root: &str, kept: &str, tested: &Tested, only_excited: bool) -> String {
    let excited = excited(net, root, kept, tested.place);
    let enough = format!("{root}box[{}] >= {}", net.place(tested.place), weight(tested.weight));
    let plain = matches!(net.net.place(tested.place).kind, Kind::State | Kind::Capacity | Kind::Generation(_));
    if !only_excited || plain { enough } else { format!("{enough} && {excited}") }
}

/// How many tokens an arc moves from or to a box.
pub(super) fn weight_in(arcs: &[Arc], place: BoxId) -> i32 {
    arcs.iter().find(|arc| arc.place == place).map_or(0, |arc| weight(arc.weight))
}

/// What must hold of room where a rule puts tokens.
pub(super) fn room(net: &NetBody<'_, '_, '_>, gate: &Gate, rule: &Rule) -> Vec<String> {
    let mut tests: Vec<String> = Vec::new();
    for index in rule.moves.iter().flat_map(|tokens| &tokens.to) {
        let arc = &gate.after[*index as usize];
        let more = weight(arc.weight).saturating_sub(weight_in(&gate.before, arc.place));
        for test in gate_room(net, arc.place, more) {
            if !tests.contains(&test) {
                tests.push(test);
            }
        }
    }
    tests
}

/// What must hold so that a gate can put so many tokens more into a box: a token that a gate before it took at once
/// leaves no room in this scan.
fn gate_room(net: &NetBody<'_, '_, '_>, id: BoxId, more: i32) -> Vec<String> {
    let facts = &net.layout.facts;
    let Some((set, gate)) = facts.begun[id.0 as usize].filter(|_| more == 1) else {
        return box_room(net, id, more);
    };
    let alone = facts.putters[id.0 as usize] <= 1;
    let begun = format!("(self->net.begun[{set}] & UINT32_C(0x{gate:08x})) == 0");
    if alone { vec![begun] } else { [vec![begun], box_room(net, id, more)].concat() }
}

/// What must hold so that a box can take so many tokens more.
pub(super) fn box_room(net: &NetBody<'_, '_, '_>, id: BoxId, more: i32) -> Vec<String> {
    let (name, place) = (net.place(id), net.net.place(id));
    if let (Kind::Macro(part), true) = (&place.kind, more <= 0) {
        // The token in the exit goes, and nothing else may be marked.
        let part = part.0 as usize;
        return vec![format!("{}_vacant_but_exit(&self->{})", fast::part_tag(net, part), fast::member(net, part))];
    }
    let Some(capacity) = place.capacity.filter(|_| more > 0) else {
        return Vec::new();
    };
    let used = if net.layout.keeps("used") { "used" } else { "filled" };
    let told = net.net.entry == Some(id) || net.net.operation.is_some();
    let alone = net.layout.facts.putters[id.0 as usize] <= 1 && !told;
    let there =
        if alone { format!("self->box[{name}]") } else { format!("self->box[{name}] + self->net.{used}[{name}]") };
    let most = i64::from(weight(capacity)) - i64::from(more);
    let mut tests = vec![match most {
        0 => format!("{there} == 0"),
        most if most < 0 => "0".to_owned(),
        most => format!("{there} <= {most}"),
    }];
    if let Kind::Macro(part) = place.kind {
        let inner = fast::part_tag(net, part.0 as usize);
        tests.push(format!("{inner}_vacant(&self->{})", fast::member(net, part.0 as usize)));
    }
    tests
}
