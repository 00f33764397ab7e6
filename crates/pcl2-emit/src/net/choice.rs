//! Gates whose conditions look at what tokens carry: the first tokens that satisfy one are those that are taken.

use super::firing::{self, Way};
use super::gates::{self, INDENT};
use super::tokens::{self, Held};
use super::{NetBody, classes, commands, statements};
use crate::statics::Statics;
use pcl2_lang::net::{BoxId, Gate, Rule, StatementId};
use std::fmt::Write;

/// Indent of what stands in the block of a rule.
const INNER: &str = "                ";
/// Indent of what follows where a rule holds.
const HELD: &str = "                    ";

/// Whether a gate has to look at what tokens carry, or to tell which permissive holds it back, before it fires.
pub(super) fn looks(net: &NetBody<'_, '_, '_>, gate: &Gate) -> bool {
    let mut conditions = gate.rules.iter().filter_map(|rule| rule.condition);
    let mut permits = gate.permits.iter().map(|permit| permit.condition);
    let sees = |condition: StatementId| !net.looks(condition).is_empty();
    let told = net.net.blocked.is_some() && !gate.permits.is_empty();
    told || conditions.any(sees) || permits.any(sees)
}

/// Writes a gate.
pub(super) fn gate(out: &mut String, statics: &mut Statics, net: &NetBody<'_, '_, '_>, gate: &Gate, index: usize) {
    let enabled = gates::enabled(net, gate);
    if !enabled.is_empty() {
        let _ = writeln!(out, "{INDENT}if (!({})) {{\n{INDENT}    break;\n{INDENT}}}", enabled.join(" && "));
    }
    for rule in &gate.rules {
        if gate.rules.len() > 1 {
            statements::comment(out, INDENT, net.body.cx.sources.text(rule.span));
        }
        let chosen = chosen(net, rule);
        let place = |id: BoxId| if net.is_single(id) { "0".to_owned() } else { tokens::at(net, id) };
        let hands: Vec<(BoxId, Held)> = chosen.iter().map(|id| (*id, Held::At(place(*id)))).collect();
        let _ = writeln!(out, "{INDENT}{{");
        self::rule(out, statics, net, &Way { gate, rule, index, hands: &hands }, &chosen);
        let _ = writeln!(out, "{INDENT}}}");
        if rule.condition.is_none() {
            return;
        }
    }
    if let Some(rule) = gate.rules.first().filter(|_| commands::fires(net)) {
        commands::first_rule(out, statics, net, &Way { gate, rule, index, hands: &[] }, INDENT);
    }
}

/// The boxes whose tokens a rule's condition chooses.
fn chosen(net: &NetBody<'_, '_, '_>, rule: &Rule) -> Vec<BoxId> {
    match rule.condition {
        Some(_) => rule.looks.iter().copied().filter(|place| net.carries(*place)).collect(),
        None => Vec::new(),
    }
}

fn rule(out: &mut String, statics: &mut Statics, net: &NetBody<'_, '_, '_>, way: &Way<'_>, chosen: &[BoxId]) {
    let Some(condition) = way.rule.condition else {
        fits(out, statics, net, way, INNER);
        return;
    };
    // The token of a box with one is there, and no other is to be tried.
    let sole = |id: &BoxId| net.is_single(*id) && way.gate.before.iter().any(|arc| arc.place == *id);
    if chosen.iter().all(sole) {
        for id in chosen {
            let _ = writeln!(out, "{INNER}{} = {};", net.hand(*id), net.sole_token(*id));
        }
        let text = tokens::condition(out, statics, net, condition, way.hands, INNER);
        let _ = writeln!(out, "{INNER}if ({text}) {{");
    } else {
        let _ = writeln!(out, "{INNER}int32_t holds = 0;");
        for id in chosen.iter().filter(|id| !net.is_single(**id)) {
            let _ = writeln!(out, "{INNER}int32_t {} = -1;", tokens::at(net, *id));
        }
        choose(out, statics, net, way, chosen, INNER);
        let _ = writeln!(out, "{INNER}if (holds) {{");
    }
    fits(out, statics, net, way, HELD);
    if way.gate.rules.len() > 1 || commands::fires(net) {
        let _ = writeln!(out, "{HELD}break;");
    }
    let _ = writeln!(out, "{INNER}}}");
}

/// Writes loops over the tokens of boxes in the order in which they give them out, the last box's change quickest.
fn choose(
    out: &mut String,
    statics: &mut Statics,
    net: &NetBody<'_, '_, '_>,
    way: &Way<'_>,
    chosen: &[BoxId],
    indent: &str,
) {
    let [id, rest @ ..] = chosen else {
        if let Some(condition) = way.rule.condition {
            let text = tokens::condition(out, statics, net, condition, way.hands, indent);
            let _ = writeln!(out, "{indent}holds = {text};");
        }
        return;
    };
    let (hand, all, left) = (net.hand(*id), net.tokens(*id), net.left(*id));
    let inner = format!("{indent}    ");
    if net.is_single(*id) {
        let _ = writeln!(out, "{indent}if ({left} > 0) {{\n{inner}{hand} = {};", net.sole_token(*id));
        choose(out, statics, net, way, rest, &inner);
        let _ = writeln!(out, "{indent}}}");
        return;
    }
    let at = tokens::at(net, *id);
    let _ = match &net.layout.names.next[id.0 as usize] {
        Some(next) => writeln!(out, "{indent}for ({at} = {next}(self, -1); {at} >= 0; {at} = {next}(self, {at})) {{"),
        None if classes::is_lifo(net.net, *id) => {
            writeln!(out, "{indent}for ({at} = {left} - 1; {at} >= 0; {at}--) {{")
        }
        None => writeln!(out, "{indent}for ({at} = 0; {at} < {left}; {at}++) {{"),
    };
    let _ = writeln!(out, "{inner}{hand} = {all}[{at}];");
    choose(out, statics, net, way, rest, &inner);
    let _ = writeln!(out, "{inner}if (holds) {{\n{inner}    break;\n{inner}}}\n{indent}}}");
}

/// Writes what follows where a rule holds: room, then permissives, then the gate fires.
fn fits(out: &mut String, statics: &mut Statics, net: &NetBody<'_, '_, '_>, way: &Way<'_>, indent: &str) {
    let mut inner = indent.to_owned();
    let mut open = 0;
    let room = gates::room(net, way.gate, way.rule);
    if !room.is_empty() {
        let _ = writeln!(out, "{inner}if ({}) {{", room.join(" && "));
        inner.push_str("    ");
        open += 1;
    }
    for (term, permit) in way.gate.permits.iter().enumerate() {
        let text = tokens::condition(out, statics, net, permit.condition, way.hands, &inner);
        let text = commands::or_forced(net, text);
        if net.layout.keeps("blocked") {
            let number = net.net.first_terms()[way.index] as usize + term;
            let _ = writeln!(
                out,
                "{inner}if (!({text})) {{\n{inner}    {}_hold(self, {number});\n{inner}}} else {{",
                net.tag()
            );
        } else {
            let _ = writeln!(out, "{inner}if ({text}) {{");
        }
        inner.push_str("    ");
        open += 1;
    }
    firing::fire(out, statics, net, way, &inner);
    for _ in 0..open {
        inner.truncate(inner.len() - 4);
        let _ = writeln!(out, "{inner}}}");
    }
}
