//! Boxes, gates and parts of a net, as they are written.

use super::Input;
use super::document::{Cell, Section, Style, cell};
use pcl2_lang::net::written::WrittenNet;
use pcl2_lang::net::{Gate, Kind, NetBox, Part};
use pcl2_lang::source::{Sources, Span};

const BOXES: [(&str, Style); 7] = [
    ("box", Style::Code),
    ("kind", Style::Code),
    ("room", Style::Number),
    ("at the start", Style::Number),
    ("says", Style::Code),
    ("drives", Style::Code),
    ("line", Style::Number),
];

const GATES: [(&str, Style); 8] = [
    ("gate", Style::Code),
    ("before", Style::Code),
    ("after", Style::Code),
    ("reads", Style::Code),
    ("is inhibited by", Style::Code),
    ("priority", Style::Number),
    ("says", Style::Code),
    ("line", Style::Number),
];

const PARTS: [(&str, Style); 4] =
    [("part", Style::Code), ("kind", Style::Code), ("says", Style::Code), ("line", Style::Number)];

/// The tables of a net.
pub(super) fn sections(input: &Input<'_>, net: &WrittenNet<'_>) -> Vec<Section> {
    let boxes = net.net.boxes.iter().enumerate().map(|(i, place)| place_row(input.sources, net, i, place));
    let gates = net.net.gates.iter().map(|gate| gate_row(input, net, gate));
    let parts = net.net.parts.iter().map(|part| part_row(input.sources, net, part));
    vec![
        Section::table("Boxes", &BOXES, boxes.collect()),
        Section::table("Gates, in the order in which a scan tries them", &GATES, gates.collect()),
        Section::table("Macros and modules", &PARTS, parts.collect()),
    ]
}

fn line(sources: &Sources, span: Span) -> Cell {
    cell(sources.positions(span).0.line.to_string())
}

fn place_row(sources: &Sources, net: &WrittenNet<'_>, index: usize, place: &NetBox) -> Vec<Cell> {
    let room = place.capacity.map_or("any".to_owned(), |room| room.to_string());
    let start = if place.initial == 0 { String::new() } else { place.initial.to_string() };
    let kind = match place.kind {
        Kind::Macro(_) => "MACRO",
        Kind::State | Kind::Capacity | Kind::Time(_) | Kind::Count | Kind::Action(_) => &net.words[index],
        Kind::Process(_) | Kind::Generation(_) => &net.words[index],
    };
    let says = net.clauses(place);
    let drives = net.drives(index).join(", ");
    vec![cell(place.name.clone()), cell(kind), cell(room), cell(start), says, cell(drives), line(sources, place.span)]
}

fn gate_row(input: &Input<'_>, net: &WrittenNet<'_>, gate: &Gate) -> Vec<Cell> {
    let [reads, inhibits] = [&gate.reads, &gate.inhibits].map(|tested| net.tested(&input.written.nets, tested));
    let priority = if gate.priority == 0 { String::new() } else { gate.priority.to_string() };
    vec![
        cell(gate.name.clone()),
        cell(net.arcs(&gate.before)),
        cell(net.arcs(&gate.after)),
        cell(reads),
        cell(inhibits),
        cell(priority),
        net.rules(gate),
        line(input.sources, gate.span),
    ]
}

fn part_row(sources: &Sources, net: &WrittenNet<'_>, part: &Part) -> Vec<Cell> {
    let kind = if part.place.is_some() { "MACRO" } else { "MODULE" };
    let mut says = vec![net.statement(part.statement).to_owned()];
    if let Some(abort) = &part.abort {
        let to = &net.net.place(abort.to).name;
        says.push(format!("ABORT {} -> {to}", net.statement(abort.condition)));
        says.extend(abort.actions.iter().map(|action| format!("DO {}", net.statement(*action))));
    }
    vec![cell(part.name.clone()), cell(kind), says, line(sources, part.span)]
}
