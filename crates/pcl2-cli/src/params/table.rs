//! Parameters as a table, or as one JSON object a line.

use super::given::{Change, element_of};
use crate::args::Format;
use pcl2_lang::decl::{Decl, Tail};
use pcl2_lang::manual::range;
use pcl2_lang::model::Access;
use pcl2_lang::program::Program;
use pcl2_lang::types::Value;
use pcl2_sim::names::Names;
use pcl2_sim::number::Number;
use serde_json::{Map, json};
use std::fmt::Write;

/// Vectors with more elements are cut short in a table.
const SHOWN: usize = 4;

/// One row: its cells, and the same as an object.
struct Row {
    cells: [String; 5],
    object: Map<String, serde_json::Value>,
}

/// All parameters and operator cells of a program, block by block.
pub(super) fn list(program: &Program, format: Format) -> String {
    let mut rows = Vec::new();
    let mut cells = program.main().cells.iter().peekable();
    for (b, block) in program.main().blocks.iter().enumerate() {
        let decl = program.decl(block.decl);
        for (param, value) in decl.params.iter().zip(&block.params) {
            let access = if block.tunable && !param.fixed { "tunable" } else { "fixed" };
            if let Some(value) = pcl2_lang::model::value(value) {
                let name = format!("{}.{}", block.name, param.name);
                rows.push(row(program, name, value, (decl, &param.tail), access));
            }
        }
        while let Some(cell) = cells.next_if(|cell| cell.block.0 as usize == b) {
            let mut ports = decl.ports();
            let tail = ports.find(|port| cell.name.ends_with(&format!(".{}", port.name))).map(|port| &port.tail);
            let tail = tail.cloned().unwrap_or_default();
            rows.push(row(program, cell.name.clone(), &cell.initial, (decl, &tail), "operator"));
        }
    }
    text(&rows, format)
}

fn row(program: &Program, name: String, value: &Value, (decl, tail): (&Decl, &Tail), access: &str) -> Row {
    let numbers: Vec<Number> = match value {
        Value::Int(_) | Value::Real(_) => element_of(value, 0, program).into_iter().collect(),
        Value::Ints(values) => (0..values.len()).filter_map(|i| element_of(value, i, program)).collect(),
        Value::Reals(values) => (0..values.len()).filter_map(|i| element_of(value, i, program)).collect(),
        Value::Text(_) => Vec::new(),
    };
    let (shown, exact) = match value {
        Value::Text(text) => (format!("{text:?}"), json!(text.to_string())),
        Value::Int(_) | Value::Real(_) => {
            let number = numbers.first().copied().unwrap_or(Number::Int(0));
            (shown(number, &tail.names), exact(number))
        }
        Value::Ints(_) | Value::Reals(_) => (short(&numbers), numbers.iter().map(|number| exact(*number)).collect()),
    };
    let range = if tail.names.is_empty() { range(decl, tail.bounds.as_ref()) } else { tail.names.join(", ") };
    let unit = tail.unit.clone().unwrap_or_default();
    let mut object = Map::new();
    object.insert("name".into(), name.clone().into());
    object.insert("value".into(), exact);
    object.insert("unit".into(), unit.clone().into());
    object.insert("range".into(), range.clone().into());
    object.insert("access".into(), access.into());
    Row { cells: [name, shown, unit, access.to_owned(), range], object }
}

/// The elements that differ from the source.
pub(super) fn differences(names: &Names<'_>, changes: &[Change], format: Format) -> String {
    let row = |change: &Change| {
        let point = names.point(change.element);
        let label = names.label(change.element);
        let unit = point.unit.clone().unwrap_or_default();
        let access = if point.access == Access::Operator { "operator" } else { "tunable" };
        let mut object = Map::new();
        object.insert("name".into(), label.clone().into());
        object.insert("source".into(), exact(change.source));
        object.insert("value".into(), exact(change.now));
        object.insert("unit".into(), unit.clone().into());
        object.insert("access".into(), access.into());
        let (source, now) = (shown(change.source, &point.names), shown(change.now, &point.names));
        Row { cells: [label, source, format!("-> {now}"), unit, access.replace("tunable", "")], object }
    };
    let rows: Vec<Row> = changes.iter().map(row).collect();
    if rows.is_empty() && format == Format::Text {
        return "nothing differs from the source\n".to_owned();
    }
    text(&rows, format)
}

fn text(rows: &[Row], format: Format) -> String {
    let mut text = String::new();
    if format == Format::Json {
        for row in rows {
            let _ = writeln!(text, "{}", serde_json::Value::from(row.object.clone()));
        }
        return text;
    }
    let width = |column: usize| rows.iter().map(|row| row.cells[column].chars().count()).max().unwrap_or(0);
    let widths = [width(0), width(1), width(2), width(3)];
    for Row { cells: [name, a, b, c, d], .. } in rows {
        let [w0, w1, w2, w3] = widths;
        let line = format!("{name:w0$}  {a:w1$}  {b:w2$}  {c:w3$}  {d}");
        let _ = writeln!(text, "{}", line.trim_end());
    }
    text
}

fn shown(number: Number, names: &[String]) -> String {
    let name = match number {
        Number::Int(value) => usize::try_from(value).ok().and_then(|value| names.get(value)),
        Number::Time(_) | Number::Double(_) | Number::Single(_) => None,
    };
    name.map_or_else(|| number.to_string(), String::clone)
}

fn short(numbers: &[Number]) -> String {
    let first: Vec<String> = numbers.iter().take(SHOWN).map(ToString::to_string).collect();
    let dots = if numbers.len() > SHOWN { ", .." } else { "" };
    format!("{}{dots}", first.join(", "))
}

/// The shortest decimal that reads back, as a JSON number; what is not finite as text.
fn exact(number: Number) -> serde_json::Value {
    let text = number.to_string();
    serde_json::from_str(&text).unwrap_or_else(|_| text.into())
}
