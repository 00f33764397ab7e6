//! Inputs, outputs, parameters, locals and classes of a net, and what stands behind them.

use super::document::{Cell, Section, Style, cell};
use pcl2_lang::decl::Tail;
use pcl2_lang::manual::{self, Row, value_text};
use pcl2_lang::net::written::WrittenNet;
use pcl2_lang::net::{Class, Drive, Level, Word, WordId};
use pcl2_lang::program::Binding;
use pcl2_lang::types::Scalar;

const PORTS: [(&str, Style); 9] = [
    ("name", Style::Code),
    ("type", Style::Code),
    ("unit", Style::Words),
    ("default", Style::Code),
    ("start", Style::Code),
    ("range", Style::Words),
    ("value from", Style::Words),
    ("physical", Style::Code),
    ("note", Style::Words),
];

const LOCALS: [(&str, Style); 4] =
    [("name", Style::Code), ("type", Style::Code), ("start", Style::Code), ("value from", Style::Words)];

const CLASSES: [(&str, Style); 5] = [
    ("class", Style::Code),
    ("attribute", Style::Code),
    ("type", Style::Code),
    ("first value", Style::Code),
    ("unit", Style::Words),
];

/// The tables that have rows.
pub(super) fn sections(net: &WrittenNet<'_>, bindings: &[Binding]) -> Vec<Section> {
    let tables = manual::tables(net.decl).into_iter().map(|table| {
        let hidden = |row: &Row| net.decl.outputs.iter().any(|output| output.by_name && output.name == row[0]);
        let is_output = table.title == "Outputs";
        let rows = table.rows.into_iter().filter(|row| !is_output || !hidden(row));
        Section::table(table.title, &PORTS, rows.map(|row| port(net, bindings, row)).collect())
    });
    let mut sections: Vec<Section> = tables.collect();
    let locals = net.net.words.iter().enumerate().skip(net.net.outputs);
    let commands: Vec<WordId> = net.net.momentary.iter().map(|(_, word)| *word).collect();
    let locals = locals.filter(|(i, _)| !commands.contains(&WordId(*i as u32)));
    sections.push(Section::table("Locals", &LOCALS, locals.map(|(i, word)| local(net, i, word)).collect()));
    let classes = net.net.classes.iter().flat_map(attributes).collect();
    sections.push(Section::table("Classes of tokens", &CLASSES, classes));
    sections
}

fn port(net: &WrittenNet<'_>, bindings: &[Binding], [name, ty, unit, default, range, mut note]: Row) -> Vec<Cell> {
    let is_port = net.decl.ports().any(|port| port.name == name);
    let word = net.net.words.iter().position(|word| word.name == name).filter(|_| !is_port);
    let from = word.map(|word| origin(net, word)).unwrap_or_default();
    let is_command = |(port, _): &(u32, WordId)| net.decl.ports().nth(*port as usize).is_some_and(|p| p.name == name);
    if net.net.momentary.iter().any(is_command) {
        note = "command: the gate that reads it clears it".to_owned();
    }
    let physical = bindings.iter().find(|binding| binding.name == name).map(physical).unwrap_or_default();
    let start = word.map(|word| value_text(&net.net.words[word].initial, &Tail::default())).unwrap_or_default();
    [name, ty, unit, default, start, range].into_iter().map(cell).chain([from, physical, cell(note)]).collect()
}

/// The point, and how it is scaled.
fn physical(binding: &Binding) -> Cell {
    let mut lines = vec![binding.point.clone()];
    if binding.gain.wide != 1.0 || binding.bias.wide != 0.0 {
        lines.push(format!("{:?}*raw + {:?}", binding.gain.wide, binding.bias.wide));
    }
    lines
}

fn local(net: &WrittenNet<'_>, index: usize, word: &Word) -> Vec<Cell> {
    let start = value_text(&word.initial, &Tail::default());
    vec![cell(word.name.clone()), cell(type_text(word.scalar)), cell(start), origin(net, index)]
}

fn type_text(scalar: Scalar) -> &'static str {
    match scalar {
        Scalar::Int => "int",
        Scalar::Real => "real",
    }
}

/// Where a word's value comes from.
fn origin(net: &WrittenNet<'_>, index: usize) -> Cell {
    let own = WordId(index as u32);
    for active in &net.net.actives {
        let boxes: Vec<&str> = active.boxes.iter().map(|place| net.net.place(*place).name.as_str()).collect();
        if active.step == own {
            return cell(format!("the first marked one of {}", boxes.join(", ")));
        }
        if active.time == Some(own) {
            return cell(format!("seconds since the first marked one of {} changed", boxes.join(", ")));
        }
    }
    match &net.net.words[index].drive {
        Drive::Level(levels) => cell(format!("1 while {}", drivers(net, levels).join(" or "))),
        Drive::Written => writers(net, own),
    }
}

/// What keeps a level at 1.
fn drivers(net: &WrittenNet<'_>, levels: &[Level]) -> Vec<String> {
    let boxes = levels.iter().filter_map(|level| match level {
        Level::Box(place) => Some(net.net.place(*place).name.as_str()),
        Level::Part(..) => None,
    });
    let boxes: Vec<&str> = boxes.collect();
    let parts = levels.iter().filter_map(|level| match level {
        Level::Box(_) => None,
        Level::Part(part, _) => Some(format!("an output of {} is", net.net.parts[part.0 as usize].name)),
    });
    let marked = (!boxes.is_empty()).then(|| format!("{} is marked", boxes.join(" or ")));
    marked.into_iter().chain(parts).collect()
}

/// The statements and the parts that write a word.
fn writers(net: &WrittenNet<'_>, word: WordId) -> Cell {
    let parts = net.net.parts.iter().filter(|part| part.writes.iter().any(|(_, written)| *written == word));
    let mut writers: Vec<String> = parts.map(|part| format!("the part {}", part.name)).collect();
    writers.insert(0, "statements".to_owned());
    cell(writers.join(", "))
}

fn attributes(class: &Class) -> Vec<Vec<Cell>> {
    let row = |attribute: &pcl2_lang::net::Attribute| {
        let first = value_text(&attribute.initial, &Tail::default());
        let unit = attribute.unit.clone().unwrap_or_default();
        let texts = [class.name.clone(), attribute.name.clone(), type_text(attribute.scalar).to_owned(), first, unit];
        texts.into_iter().map(cell).collect()
    };
    class.attributes.iter().map(row).collect()
}
