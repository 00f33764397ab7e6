//! How gates fire: tokens are taken, statements run, tokens put.

use super::tokens::{self, Hands, Held};
use super::{NetBody, fast, gates, statements};
use crate::statics::Statics;
use pcl2_lang::net::{Arc, BoxId, Gate, Kind, Rule, StatementId};
use std::collections::BTreeMap;
use std::fmt::Write;

/// A gate that fires by a rule.
pub(super) struct Way<'g> {
    /// The gate.
    pub(super) gate: &'g Gate,
    /// The rule.
    pub(super) rule: &'g Rule,
    /// Its place in the order of a scan.
    pub(super) index: usize,
    /// The tokens that its condition chose.
    pub(super) hands: &'g Hands,
}

/// Writes how a gate fires.
pub(super) fn fire(out: &mut String, statics: &mut Statics, net: &NetBody<'_, '_, '_>, way: &Way<'_>, indent: &str) {
    let (gate, rule) = (way.gate, way.rule);
    for word in &rule.clears {
        let _ = writeln!(out, "{indent}{} = 0;", net.word(word.0 as usize, net.scope()));
    }
    let mut toggled: BTreeMap<usize, u32> = BTreeMap::new();
    for arc in &gate.before {
        // What comes out of a macro is what its exit has.
        if !matches!(net.net.place(arc.place).kind, Kind::Macro(_)) {
            tokens::take(out, net, arc.place, way.hands, indent);
        }
        if net.layout.facts.takes_at_once(net.net, way.index, arc.place) {
            take_at_once(out, net, arc, &mut toggled, indent);
        } else {
            take(out, net, arc, indent);
        }
    }
    let hands = on_their_way(out, net, way, indent);
    let number = way.index.to_string();
    for statement in &rule.actions {
        run(out, statics, net, *statement, (&number, &hands), indent);
    }
    deposit(out, net, way, &mut toggled, indent);
    for (set, gates) in toggled.into_iter().filter(|(_, gates)| *gates != 0) {
        let _ = writeln!(out, "{indent}self->net.ready[{set}] ^= UINT32_C(0x{gates:08x});");
    }
    let _ = writeln!(out, "{indent}fired = 1;");
}

/// What is in hand while a gate's statements are run: tokens that it took, new ones, and those that it chose to read.
fn on_their_way(out: &mut String, net: &NetBody<'_, '_, '_>, way: &Way<'_>, indent: &str) -> Vec<(BoxId, Held)> {
    let mut hands: Vec<(BoxId, Held)> = way.gate.before.iter().map(|arc| (arc.place, Held::OnItsWay)).collect();
    for to in way.rule.moves.iter().filter(|tokens| tokens.from.is_none()).flat_map(|tokens| &tokens.to) {
        let place = way.gate.after[*to as usize].place;
        if hands.iter().all(|(known, _)| *known != place) {
            tokens::make(out, net, place, indent);
            hands.push((place, Held::OnItsWay));
        }
    }
    hands.extend(way.hands.iter().cloned());
    hands
}

/// Writes how a gate puts tokens.
fn deposit(
    out: &mut String,
    net: &NetBody<'_, '_, '_>,
    way: &Way<'_>,
    toggled: &mut BTreeMap<usize, u32>,
    indent: &str,
) {
    let (gate, moves) = (way.gate, &way.rule.moves);
    let made = |made: bool| moves.iter().filter(move |tokens| tokens.from.is_none() == made);
    let ways = made(false).chain(made(true)).flat_map(|tokens| tokens.to.iter().map(|to| (tokens.from, to)));
    for (from, to) in ways {
        let arc = &gate.after[*to as usize];
        let room = gates::weight(arc.weight).saturating_sub(gates::weight_in(&gate.before, arc.place)).max(0);
        let source = from.map_or(arc.place, |from| gate.before[from as usize].place);
        if from.is_none() && gate.before.iter().any(|before| before.place == arc.place) {
            // The hand had the token that was taken.
            tokens::make(out, net, arc.place, indent);
        }
        if net.layout.facts.puts_at_once(net.net, way.index, arc.place) {
            tokens::lay(out, net, source, arc.place, indent);
            put_at_once(out, net, arc, toggled, indent);
        } else {
            put(out, net, arc, source, (room, &way.index.to_string()), indent);
        }
    }
}

/// Gates whose first box is this one become ready, or are no more: all of them are on one side.
fn toggle(toggled: &mut BTreeMap<usize, u32>, net: &NetBody<'_, '_, '_>, place: BoxId) {
    for (set, gates) in &net.layout.facts.readied[place.0 as usize] {
        *toggled.entry(*set).or_default() ^= gates;
    }
}

/// The box of a gate whose tokens no gate after it asks for.
fn take_at_once(
    out: &mut String,
    net: &NetBody<'_, '_, '_>,
    arc: &Arc,
    toggled: &mut BTreeMap<usize, u32>,
    indent: &str,
) {
    let name = net.place(arc.place);
    if net.net.place(arc.place).capacity == Some(1) {
        let _ = writeln!(out, "{indent}self->box[{name}] = 0;");
        toggle(toggled, net, arc.place);
        shows(out, net, arc.place, "-=", indent);
    } else {
        let _ = writeln!(out, "{indent}self->box[{name}] -= {};", gates::weight(arc.weight));
        let _ = writeln!(out, "{indent}if (self->box[{name}] == 0) {{");
        let inner = format!("{indent}    ");
        unready(out, net, arc.place, &inner);
        shows(out, net, arc.place, "-=", &inner);
        let _ = writeln!(out, "{indent}}}");
    }
}

/// A box of one token, which no gate after it asks for.
fn put_at_once(
    out: &mut String,
    net: &NetBody<'_, '_, '_>,
    arc: &Arc,
    toggled: &mut BTreeMap<usize, u32>,
    indent: &str,
) {
    let _ = writeln!(out, "{indent}self->box[{}] = {};", net.place(arc.place), gates::weight(arc.weight));
    toggle(toggled, net, arc.place);
    shows(out, net, arc.place, "+=", indent);
}

/// Gates whose first box is this one are ready no more, from the next scan on.
fn unready(out: &mut String, net: &NetBody<'_, '_, '_>, place: BoxId, indent: &str) {
    for (set, gates) in &net.layout.facts.readied[place.0 as usize] {
        let _ = writeln!(out, "{indent}self->net.ready[{set}] &= ~UINT32_C(0x{gates:08x});");
    }
}

/// A box that drives outputs counts among their drivers, or no more; an output that a statement reads follows when the
/// phase ends, any other at once.
fn shows(out: &mut String, net: &NetBody<'_, '_, '_>, place: BoxId, change: &str, indent: &str) {
    let facts = &net.layout.facts;
    let driven = &facts.driven[place.0 as usize];
    if facts.counts_at_once(place.0 as usize) {
        for output in driven {
            let _ = writeln!(out, "{indent}self->net.drives[{output}] {change} 1;");
            if facts.unread[*output] {
                let word = net.word(facts.levels[*output], net.scope());
                let _ = match change {
                    "+=" => writeln!(out, "{indent}{word} = 1;"),
                    _ => writeln!(out, "{indent}{word} = self->net.drives[{output}] > 0;"),
                };
            } else {
                let _ = writeln!(out, "{indent}pcl2_net_add(self->net.outputs, {output});");
            }
        }
    } else if !driven.is_empty() {
        let _ = writeln!(out, "{indent}{}_touch(self, {});", net.tag(), net.place(place));
    }
}

fn take(out: &mut String, net: &NetBody<'_, '_, '_>, arc: &Arc, indent: &str) {
    let (tag, name, place) = (net.tag(), net.place(arc.place), net.net.place(arc.place));
    let tokens = match place.kind {
        Kind::Count => format!("self->box[{name}]"),
        Kind::State | Kind::Capacity | Kind::Generation(_) => gates::weight(arc.weight).to_string(),
        Kind::Time(_) | Kind::Action(_) | Kind::Process(_) | Kind::Macro(_) => "1".to_owned(),
    };
    let _ = writeln!(out, "{indent}{tag}_take(self, {name}, {tokens});");
    if let Kind::Macro(part) = place.kind {
        let part = part.0 as usize;
        inside(out, net, arc.place, part, false, indent);
        let _ = writeln!(out, "{indent}{}_leave(&self->{});", fast::part_tag(net, part), fast::member(net, part));
    }
}

/// Writes how tokens are put into a box from the hand of another, `room` of them into room that was free, by a gate.
pub(super) fn put(
    out: &mut String,
    net: &NetBody<'_, '_, '_>,
    arc: &Arc,
    source: BoxId,
    (room, gate): (i32, &str),
    indent: &str,
) {
    let (tag, name) = (net.tag(), net.place(arc.place));
    tokens::lay(out, net, source, arc.place, indent);
    if let Kind::Macro(part) = net.net.place(arc.place).kind {
        inside(out, net, source, part.0 as usize, true, indent);
    }
    let _ = write!(out, "{indent}{tag}_put(self, {name}, {}", gates::weight(arc.weight));
    if net.layout.keeps("used") {
        let _ = write!(out, ", {room}");
    }
    if net.layout.keeps("by") {
        let _ = write!(out, ", {gate}");
    }
    out.push_str(");\n");
    if let Kind::Macro(part) = net.net.place(arc.place).kind {
        let part = part.0 as usize;
        let _ = writeln!(out, "{indent}{}_enter(&self->{});", fast::part_tag(net, part), fast::member(net, part));
    }
}

/// What a token carries goes into a macro's entry, or out of its exit.
fn inside(out: &mut String, net: &NetBody<'_, '_, '_>, hand: BoxId, part: usize, into: bool, indent: &str) {
    let inner = fast::inner(net, part);
    let Some(inside) = inner.as_ref().and_then(NetBody::of) else {
        return;
    };
    let end = if into { inside.net.entry } else { inside.net.exit };
    if let Some(end) = end {
        let root = format!("self->{}.", fast::member(net, part));
        let way = tokens::Crossing { hand, inside: &inside, end, root: &root, into };
        tokens::cross(out, net, &way, indent);
    }
}

/// Writes a statement that is run for a gate, with what is in hand: of two that write one output, that of the higher
/// priority counts.
pub(super) fn run(
    out: &mut String,
    statics: &mut Statics,
    net: &NetBody<'_, '_, '_>,
    statement: StatementId,
    (gate, hands): (&str, &Hands),
    indent: &str,
) {
    tokens::around(out, net, statement, hands, indent, |out, indent| {
        tracked(out, statics, net, statement, gate, indent);
    });
}

/// Writes a statement, and what follows where it writes tracked outputs.
fn tracked(
    out: &mut String,
    statics: &mut Statics,
    net: &NetBody<'_, '_, '_>,
    statement: StatementId,
    gate: &str,
    indent: &str,
) {
    let facts = &net.layout.facts;
    if !facts.tracks_statement(net.net, statement) {
        statements::action(out, statics, net, statement, indent);
        return;
    }
    let touched = &net.net.touched[statement.0 as usize];
    let inner = format!("{indent}    ");
    let _ = writeln!(out, "{indent}{{");
    let tracked = |words: &[pcl2_lang::net::WordId]| -> Vec<usize> {
        words.iter().map(|word| word.0 as usize).filter(|word| facts.tracked[*word]).collect()
    };
    let writes = tracked(&touched.writes);
    for (i, word) in writes.iter().enumerate() {
        let ty = pcl2_lang::kernel::c_scalar(net.net.words[*word].scalar);
        let _ = writeln!(out, "{inner}const {ty} before{} = {};", i + 1, net.word(*word, net.scope()));
    }
    statements::action(out, statics, net, statement, &inner);
    for (i, word) in writes.iter().enumerate() {
        wrote(out, net, *word, gate, &format!("before{}", i + 1), &inner);
    }
    for word in tracked(&touched.counts) {
        let _ = writeln!(out, "{inner}pcl2_net_counted(&self->net.wrote[{word}]);");
    }
    let _ = writeln!(out, "{indent}}}");
}

/// Writes what follows a write to a tracked output.
pub(super) fn wrote(out: &mut String, net: &NetBody<'_, '_, '_>, word: usize, gate: &str, before: &str, indent: &str) {
    let function = match net.net.words[word].scalar {
        pcl2_lang::types::Scalar::Int => "pcl2_net_wrote_int",
        pcl2_lang::types::Scalar::Real => "pcl2_net_wrote_real",
    };
    let place = net.word(word, net.scope());
    let _ = writeln!(out, "{indent}{function}({}_writes(self, {word}), {gate}, &{place}, {before});", net.tag());
}
