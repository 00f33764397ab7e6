//! What is written into and beside a box.

use pcl2_lang::decl::Decl;
use pcl2_lang::kernel;
use pcl2_lang::program::{Block, Param, Program};
use pcl2_lang::types::{Shape, Type, Value};
use std::fmt::Write;

/// So many characters of parameters stand in a box.
const NOTE: usize = 22;
/// So many elements of a parameter stand in its tooltip.
const ELEMENTS: usize = 16;

/// A port, groups expanded.
pub(crate) struct Port<'d> {
    pub(crate) name: String,
    /// The names of its values.
    pub(crate) names: &'d [String],
}

/// A block's ports.
pub(crate) fn ports<'d>(decl: &'d Decl, block: &Block) -> Vec<Port<'d>> {
    let mut ports = Vec::new();
    for port in decl.ports() {
        let names = expand(&port.name, kernel::count(port.group.as_ref(), &block.sizes), port.group.is_some());
        ports.extend(names.into_iter().map(|name| Port { name, names: &port.tail.names }));
    }
    ports
}

/// A block's outputs: the declared name, and the variable's where box and name do not tell it.
pub(crate) fn outputs(program: &Program, block: &Block) -> Vec<String> {
    let decl = program.decl(block.decl);
    let mut labels = Vec::new();
    for output in &decl.outputs {
        labels.extend(expand(&output.name, kernel::count(output.group.as_ref(), &block.sizes), output.group.is_some()));
    }
    let variables = block.outputs.iter().map(|id| program.main().signal(*id).name.as_str());
    let named = labels.into_iter().zip(variables).map(|(label, variable)| {
        let own = format!("{}.{label}", block.name);
        let told = variable.is_empty() || variable == own || block.name.split('#').next() == Some(variable);
        if told || variable == label { label } else { format!("{label}: {variable}") }
    });
    named.collect()
}

fn expand(name: &str, count: Option<usize>, group: bool) -> Vec<String> {
    if group { (1..=count.unwrap_or(0)).map(|i| format!("{name}{i}")).collect() } else { vec![name.to_owned()] }
}

/// `[3]` or `[2,1]`.
pub(crate) fn suffix(ty: Type, element: u32) -> String {
    match ty.shape {
        Shape::Scalar => String::new(),
        Shape::Vector(_) => format!("[{}]", element + 1),
        Shape::Matrix(_, columns) => format!("[{},{}]", element / columns.max(1) + 1, element % columns.max(1) + 1),
    }
}

/// Whether a port's default stands for "nothing there".
pub(crate) fn is_bad(value: &Value) -> bool {
    match value {
        Value::Real(real) => real.wide.is_nan(),
        Value::Reals(values) => values.iter().all(|real| real.wide.is_nan()),
        Value::Int(_) | Value::Ints(_) | Value::Text(_) => false,
    }
}

/// A value in a few characters; an int by its name.
pub(crate) fn value(value: &Value, names: &[String]) -> String {
    match value {
        Value::Int(value) => {
            let name = usize::try_from(*value).ok().and_then(|value| names.get(value));
            name.cloned().unwrap_or_else(|| value.to_string())
        }
        Value::Real(real) => number(real.wide),
        Value::Ints(values) => list(values.iter().map(i32::to_string), values.len(), 4),
        Value::Reals(values) => list(values.iter().map(|real| number(real.wide)), values.len(), 4),
        Value::Text(text) => text.to_string(),
    }
}

fn list(values: impl Iterator<Item = String> + Clone, count: usize, limit: usize) -> String {
    let first = values.clone().next().unwrap_or_default();
    if count > 1 && values.clone().all(|value| value == first) {
        return first;
    }
    let more = if count > limit { ", .." } else { "" };
    format!("[{}{more}]", values.take(limit).collect::<Vec<_>>().join(", "))
}

/// Six digits are enough to look at.
pub(crate) fn number(value: f64) -> String {
    if value.is_nan() {
        return "bad".to_owned();
    }
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    let size = rounded.abs();
    if rounded != 0.0 && !(1e-4..1e7).contains(&size) { format!("{rounded:e}") } else { format!("{rounded}") }
}

/// The first scalar parameters that are not at their defaults, as many as a line takes.
pub(crate) fn note(decl: &Decl, block: &Block) -> String {
    let mut note = String::new();
    for (param, found) in
        decl.params.iter().zip(&block.params).filter(|(param, _)| decl.image.is_none() || !param.fixed)
    {
        let Param::Value(found) = found else {
            continue;
        };
        if !matches!(found, Value::Int(_) | Value::Real(_)) || param.default.as_ref() == Some(found) {
            continue;
        }
        let piece = format!("{}={}", param.name, value(found, &param.tail.names));
        if note.len() + 1 + piece.len() > NOTE {
            note.push_str(" ..");
            break;
        }
        if !note.is_empty() {
            note.push(' ');
        }
        note.push_str(&piece);
    }
    if note.is_empty() { only(decl, block).unwrap_or_default() } else { note.trim_start().to_owned() }
}

/// A code's one scalar parameter, if it has one only.
fn only(decl: &Decl, block: &Block) -> Option<String> {
    match (decl.params.as_slice(), block.params.as_slice()) {
        ([param], [Param::Value(found @ (Value::Int(_) | Value::Real(_)))]) => {
            Some(format!("{}={}", param.name, value(found, &param.tail.names)))
        }
        _ => None,
    }
}

/// Number, tag and code, the code's summary, sizes, all parameters.
pub(crate) fn tip(decl: &Decl, block: &Block) -> String {
    let mut tip = format!("{} {} = {}", block.number, block.name, decl.name);
    if let Some(summary) = decl.doc.lines().next().filter(|line| !line.trim().is_empty()) {
        let _ = write!(tip, "\n{}", summary.trim());
    }
    for (size, found) in decl.sizes.iter().zip(&block.sizes).filter(|(size, _)| size.constant.is_some()) {
        let _ = write!(tip, "\n{} = {found}", size.name);
    }
    for (param, found) in decl.params.iter().zip(&block.params) {
        let Param::Value(found) = found else {
            continue;
        };
        let shown = match found {
            Value::Ints(values) => list(values.iter().map(i32::to_string), values.len(), ELEMENTS),
            Value::Reals(values) => list(values.iter().map(|real| number(real.wide)), values.len(), ELEMENTS),
            Value::Int(_) | Value::Real(_) | Value::Text(_) => value(found, &param.tail.names),
        };
        let unit = param.tail.unit.as_deref().map_or_else(String::new, |unit| format!(" {unit}"));
        let _ = write!(tip, "\n{} = {shown}{unit}", param.name);
    }
    tip
}
