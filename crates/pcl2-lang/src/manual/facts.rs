//! What a page has, before it is laid out.

use super::words::{bad_text, limits, list, range, type_text, value_text};
use crate::decl::{Decl, Direction, Example, Item, OutputDecl, ParamDecl, RETURN_OUTPUT, RETURN_PORT, TypeExpr};
use crate::kernel::{self, Member};
use crate::types::{Scalar, Width};

/// A table of ports or parameters.
pub struct Table {
    /// `Inputs`, `Outputs` or `Parameters`.
    pub title: &'static str,
    /// At least one.
    pub rows: Vec<Row>,
}

/// Name, type, unit, default, range, note.
pub type Row = [String; 6];

/// The heads of a table's columns.
pub const HEADS: [&str; 6] = ["", "type", "unit", "default", "range", ""];

/// `y = first ( u : a, b, x0 )`
pub fn signature(decl: &Decl) -> String {
    let group = |name: &String, is_group: bool| if is_group { format!("{name}..") } else { name.clone() };
    let outputs: Vec<String> = decl.outputs.iter().map(|o| group(&o.name, o.group.is_some())).collect();
    let items = decl.items.iter().map(|item| match item {
        Item::Literal(value) => value.to_string(),
        Item::Constant(constant) => constant.name.clone(),
        Item::Port(port) if port.group.is_some() => group(&port.name, true),
        Item::Port(port) if port.default.is_some() => format!("[{}]", port.name),
        Item::Port(port) => port.name.clone(),
    });
    let items: Vec<String> = items.collect();
    let params: Vec<&str> = decl.params.iter().map(|param| param.name.as_str()).collect();
    let padded = |list: String| if list.is_empty() { list } else { format!("{list} ") };
    let (items, params) = (padded(items.join(", ")), padded(params.join(", ")));
    format!("{} = {} ( {items}: {params})", outputs.join(", "), decl.name)
}

/// The tables that have rows.
pub fn tables(decl: &Decl) -> Vec<Table> {
    let inputs = decl.items.iter().map(|item| input(decl, item)).collect();
    let outputs = decl.outputs.iter().enumerate().map(|(i, o)| output(decl, i, o)).collect();
    let params = decl.params.iter().map(|param| parameter(decl, param)).collect();
    let tables = [("Inputs", inputs), ("Outputs", outputs), ("Parameters", params)];
    tables.into_iter().map(|(title, rows)| Table { title, rows }).filter(|table| !table.rows.is_empty()).collect()
}

fn input(decl: &Decl, item: &Item) -> Row {
    let port = match item {
        Item::Literal(value) => {
            let none = String::new;
            return [value.to_string(), "constant".to_owned(), none(), none(), none(), "written so".to_owned()];
        }
        Item::Constant(constant) => {
            let range = range(decl, constant.bounds.as_ref());
            let none = String::new;
            return [constant.name.clone(), "constant".to_owned(), none(), none(), range, none()];
        }
        Item::Port(port) => port,
    };
    let mut notes = Vec::new();
    if let Some(group) = &port.group {
        let mut note = format!("a group of {} ports", super::words::expr_text(decl, &group.count));
        let range = range(decl, group.bounds.as_ref());
        if !range.is_empty() {
            note = format!("{note}, {range}");
        }
        notes.push(note);
    }
    match (&port.tracks, port.cell) {
        (Some(tracks), _) => notes.push(format!("operator cell, follows {tracks}")),
        (None, true) => notes.push("operator cell".to_owned()),
        (None, false) if port.default.is_some() && port.name == RETURN_PORT => {
            notes.push("return wire of the block that this one drives".to_owned());
        }
        (None, false) if port.default.is_some() => notes.push("optional".to_owned()),
        (None, false) => {}
    }
    let default = port.default.as_ref().map(|value| value_text(value, &port.tail)).unwrap_or_default();
    let unit = port.tail.unit.clone().unwrap_or_default();
    [port.name.clone(), type_text(decl, &port.ty), unit, default, limits(decl, &port.tail), notes.join("; ")]
}

fn output(decl: &Decl, index: usize, output: &OutputDecl) -> Row {
    let mut notes = Vec::new();
    if let Some(group) = &output.group {
        notes.push(format!("a group of {}", super::words::expr_text(decl, &group.count)));
    }
    if output.inout {
        notes.push("changed in place".to_owned());
    }
    if let (RETURN_OUTPUT, Some(port)) = (output.name.as_str(), decl.returns.and_then(|port| decl.ports().nth(port))) {
        notes.push(format!("return wire of {}", port.name));
    }
    if decl.start.contains(&index) {
        notes.push("set before the first scan".to_owned());
    }
    if decl.retain.contains(&output.name) {
        notes.push("retained".to_owned());
    }
    let unit = output.tail.unit.clone().unwrap_or_default();
    let limits = limits(decl, &output.tail);
    [output.name.clone(), type_text(decl, &output.ty), unit, String::new(), limits, notes.join("; ")]
}

fn parameter(decl: &Decl, param: &ParamDecl) -> Row {
    let default = param.default.as_ref().map(|value| value_text(value, &param.tail)).unwrap_or_default();
    let unit = param.tail.unit.clone().unwrap_or_default();
    let note = if param.fixed { "fixed" } else { "" };
    [param.name.clone(), type_text(decl, &param.ty), unit, default, limits(decl, &param.tail), note.to_owned()]
}

/// Sentences about the code, each under a word.
pub(super) fn rules(decl: &Decl) -> Vec<(&'static str, String)> {
    let mut rules = Vec::new();
    if let Some(bad) = decl.bad {
        rules.push(("Bad signal", bad_text(bad).to_owned()));
    }
    match decl.operator.as_deref() {
        None => {}
        Some(word) if !word.starts_with(|first: char| first.is_ascii_punctuation()) => {
            let name = if word.is_empty() { &decl.name } else { word };
            let ports: Vec<&str> = decl.ports().map(|port| port.name.as_str()).collect();
            rules.push(("Expression", format!("`{name}({})`, a function.", ports.join(", "))));
        }
        Some(sign) => rules.push(("Expression", format!("`{sign}`, an operator."))),
    }
    if let Some(image) = decl.image {
        let word = if image.direction == Direction::In { "Reads" } else { "Writes" };
        rules.push(("Process image", format!("{word} the word at the address of the fixed parameters.")));
    }
    if decl.period {
        rules.push(("Period", "Needs the period of its section.".to_owned()));
    }
    if decl.simulated {
        rules.push(("Section", "PLANT only.".to_owned()));
    }
    let memory: Vec<String> = decl.retain.iter().filter(|name| !is_output(decl, name)).cloned().collect();
    if !memory.is_empty() {
        rules.push(("Retained", format!("Beside outputs: {}.", list(&memory))));
    }
    if let Some(text) = instance(decl) {
        rules.push(("Memory", text));
    }
    rules
}

fn is_output(decl: &Decl, name: &str) -> bool {
    decl.outputs.iter().any(|output| output.name == name)
}

/// Name and text of each fault.
pub(super) fn faults(decl: &Decl) -> Vec<(&str, &str)> {
    decl.faults.iter().map(|fault| (fault.name.as_str(), fault.text.as_str())).collect()
}

/// How much one instance keeps, parameters apart.
fn instance(decl: &Decl) -> Option<String> {
    if decl.is_composite() {
        return None;
    }
    let members = kernel::members(decl);
    let grows = decl.memory.iter().chain(&decl.tuned).any(|field| !field.ty.is_scalar())
        || decl.outputs.iter().any(|output| !kernel::in_instance(output) && !output.inout);
    let bytes = |width: Width| members.iter().map(|member| member_bytes(decl, *member, width)).sum::<usize>();
    let arrays = if grows { " and its arrays" } else { "" };
    Some(match (members.is_empty(), grows) {
        (true, false) => "None beside its parameters.".to_owned(),
        (true, true) => "Its outputs, beside its parameters.".to_owned(),
        (false, _) => {
            let (wide, narrow) = (bytes(Width::F64), bytes(Width::F32));
            format!("{wide} bytes an instance, {narrow} as f32, beside its parameters{arrays}.")
        }
    })
}

fn member_bytes(decl: &Decl, member: Member, width: Width) -> usize {
    let ty = match member {
        Member::Tuned(i) => &decl.tuned[i].ty,
        Member::Memory(i) => &decl.memory[i].ty,
        Member::Output(i) => &decl.outputs[i].ty,
        Member::Status => return 4,
    };
    match ty {
        TypeExpr::Time => 8,
        TypeExpr::Scalar(Scalar::Int) => 4,
        TypeExpr::Scalar(Scalar::Real) => width.bytes(),
        TypeExpr::Vector(..) | TypeExpr::Matrix(..) | TypeExpr::Text => 0,
    }
}

/// What an example shows.
pub(super) fn shows(example: &Example) -> String {
    let scans = if example.after == 1 { "scan 1".to_owned() } else { format!("{} scans", example.after) };
    let period =
        example.period.as_ref().map(|period| format!(" of {} s", period.trim_end_matches('.'))).unwrap_or_default();
    format!("after {scans}{period}: {} = {}", example.signal, example.values.join(", "))
}

/// The lines of an example's program.
pub(super) fn program(example: &Example) -> impl Iterator<Item = &str> {
    example.program.lines().map(str::trim_end).filter(|line| *line != "END" && !line.is_empty())
}
