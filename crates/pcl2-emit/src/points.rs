//! The named points: rows of the map and of the JSON file, written in one pass, and what they have in common.

use crate::args::{Home, parameter_home};
use crate::context::Context;
use crate::expr::{self, Kind as Base, Scope};
use crate::layout::{WHOLE, known_value};
use crate::text::{self, Number, number};
use pcl2_lang::bounds;
use pcl2_lang::decl::{Bounds, Decl, Expr, Tail};
use pcl2_lang::kernel;
use pcl2_lang::model::{self, Access, Place, Seen};
use pcl2_lang::program::{BlockId, DeclId, UnitId};
use pcl2_lang::types::{Real, Scalar, Value, Width};
use rustc_hash::FxHashMap;
use serde::Serialize;
use std::fmt::Write;

/// Signals, words, parameters, cells, memory: the arrays of the JSON file.
pub(crate) const ARRAYS: [&str; 5] = ["signals", "words", "parameters", "cells", "memory"];

/// What is written of all points.
#[derive(Debug, Default)]
pub(crate) struct Points {
    /// The rows of the map.
    pub(crate) rows: String,
    /// The rows of each of [`ARRAYS`].
    pub(crate) arrays: [String; 5],
    /// What points have in common.
    pub(crate) kinds: Vec<Kind>,
    /// How many points there are.
    pub(crate) count: usize,
    /// The index of the first parameter.
    pub(crate) first_parameter: usize,
    /// FNV-1a over name, type and access of every point, in order, and the width of reals.
    pub(crate) hash: u64,
}

/// What points have in common, as a row of the map and of the JSON file.
#[derive(Debug)]
pub(crate) struct Kind {
    /// In C.
    pub(crate) c: String,
    /// In JSON.
    pub(crate) json: String,
    /// Its index as the end of a row.
    row_end: String,
    /// Its index in a row of the JSON file.
    json_row: String,
    /// FNV-1a over type and access.
    hash: u64,
}

/// Visits all points.
pub(crate) fn points(cx: &Context<'_>) -> Points {
    let mut writer = Writer { cx, points: Points::default(), known: FxHashMap::default(), equal: FxHashMap::default() };
    writer.points.hash = fnv(FNV_START, kernel::c_scalar(Scalar::Real));
    writer.points.hash = fnv(writer.points.hash, if cx.program.width == Width::F32 { "32" } else { "64" });
    model::visit(cx.program, &mut |seen| writer.add(&seen));
    writer.points
}

const FNV_START: u64 = 0xcbf2_9ce4_8422_2325;
const FNV_PRIME: u64 = 0x0000_0100_0000_01b3;

fn fnv(hash: u64, text: &str) -> u64 {
    text.bytes().chain([0]).fold(hash, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(FNV_PRIME))
}

/// Points with the same key have the same kind.
#[derive(Debug, PartialEq, Eq, Hash)]
struct Key {
    decl: DeclId,
    sizes: Vec<i32>,
    array: usize,
    place: u32,
    input: bool,
}

struct Writer<'c, 'a> {
    cx: &'c Context<'a>,
    points: Points,
    known: FxHashMap<Key, usize>,
    equal: FxHashMap<String, usize>,
}

impl Writer<'_, '_> {
    fn add(&mut self, seen: &Seen<'_>) {
        let array = array_of(seen.place);
        let kind = self.kind(seen, array);
        let kind = &self.points.kinds[kind];
        self.points.hash = (fnv(self.points.hash, seen.name) ^ kind.hash).wrapping_mul(FNV_PRIME);
        map_row(&mut self.points.rows, self.cx, seen, kind);
        json_row(&mut self.points.arrays[array], self.cx, seen, kind);
        if array < 2 {
            self.points.first_parameter += 1;
        }
        self.points.count += 1;
    }

    fn kind(&mut self, seen: &Seen<'_>, array: usize) -> usize {
        let Some((decl, sizes)) = seen.declared else {
            return self.new_kind(seen);
        };
        let place = match seen.place {
            Place::Signal(id) => {
                let writer = self.cx.program.main().signal(id).writers.first();
                writer.map_or(0, |writer| writer.output)
            }
            Place::Param(_, param) => param,
            Place::Cell(id) => self.cx.program.main().cells[id.0 as usize].port,
            Place::Inside(_) => self.cx.program.decl(decl).outputs.len() as u32 - 1,
            Place::Memory(field) => field,
            Place::Image(_) => 0,
        };
        let input = seen.access == Access::Input;
        let key = Key { decl, sizes: sizes.to_vec(), array, place, input };
        if let Some(kind) = self.known.get(&key) {
            return *kind;
        }
        let kind = self.new_kind(seen);
        self.known.insert(key, kind);
        kind
    }

    fn new_kind(&mut self, seen: &Seen<'_>) -> usize {
        let decl = seen.declared.map(|(decl, _)| self.cx.program.decl(decl));
        let next = self.points.kinds.len();
        let hashed = format!("{}{}{}", seen.ty, if seen.time { "t" } else { "" }, access(seen.access));
        let kind = Kind {
            c: kind_in_c(self.cx, seen, decl),
            json: serde_json::to_string(&kind_row(seen, decl)).unwrap_or_default(),
            row_end: format!("), {next}}},\n"),
            json_row: format!(", \"kind\": {next}"),
            hash: fnv(FNV_START, &hashed),
        };
        let index = *self.equal.entry(format!("{}{}", kind.c, kind.json)).or_insert(next);
        if index == next {
            self.points.kinds.push(kind);
        }
        index
    }
}

fn array_of(place: Place) -> usize {
    match place {
        Place::Signal(_) | Place::Inside(_) => 0,
        Place::Image(_) => 1,
        Place::Param(..) => 2,
        Place::Cell(_) => 3,
        Place::Memory(_) => 4,
    }
}

fn kind_in_c(cx: &Context<'_>, seen: &Seen<'_>, decl: Option<&Decl>) -> String {
    let mut out = String::from("{");
    text::string(&mut out, seen.tail.and_then(|tail| tail.unit.as_deref()).unwrap_or(""));
    let (low, high) = range(seen);
    limit(&mut out, cx.program.width, low, "-PCL2_REAL_MAX");
    limit(&mut out, cx.program.width, high, "PCL2_REAL_MAX");
    let (rows, columns) = if seen.ty.elements() == 0 { (0, 0) } else { seen.ty.rows_columns() };
    let ty = match (seen.time, seen.ty.scalar) {
        (true, _) => "TIME",
        (false, Scalar::Int) => "INT",
        (false, Scalar::Real) => "REAL",
    };
    let retain = i32::from(retained(seen, decl));
    let access = access(seen.access).to_uppercase();
    let _ = write!(out, ", {rows}, {columns}, PCL2_{ty}, PCL2_{access}, {retain}}}");
    out
}

fn limit(out: &mut String, width: Width, value: Option<f64>, open: &str) {
    out.push_str(", ");
    match value.filter(|value| value.is_finite() && (*value as f32).is_finite()) {
        Some(value) => text::real(out, Real { wide: value, narrow: value as f32 }, width),
        None => out.push_str(open),
    }
}

fn access(access: Access) -> &'static str {
    match access {
        Access::Signal => "signal",
        Access::Input => "input",
        Access::Image => "image",
        Access::Tunable => "tunable",
        Access::Operator => "operator",
        Access::State => "state",
    }
}

/// The range in numbers, as far as it does not depend on parameters.
fn range(seen: &Seen<'_>) -> (Option<f64>, Option<f64>) {
    let Some(tail) = seen.tail else {
        return (None, None);
    };
    if !tail.names.is_empty() {
        return (Some(0.0), Some(tail.names.len() as f64 - 1.0));
    }
    let Some(Bounds { lower, upper, .. }) = &tail.bounds else {
        return (None, None);
    };
    let sizes = seen.declared.map_or(&[][..], |(_, sizes)| sizes);
    let number = |bound: &Option<Expr>| bound.as_ref().and_then(|bound| bounds::evaluate(bound, sizes, None));
    (number(lower), number(upper))
}

fn retained(seen: &Seen<'_>, decl: Option<&Decl>) -> bool {
    let Some(decl) = decl else {
        return false;
    };
    let name = match seen.place {
        Place::Memory(field) => decl.memory.get(field as usize).map(|field| &field.name),
        Place::Signal(_) => seen.tail.and_then(|tail| output_with(decl, tail)),
        Place::Param(..) | Place::Cell(_) | Place::Image(_) | Place::Inside(_) => None,
    };
    name.is_some_and(|name| decl.retain.contains(name))
}

/// The output whose tail this is.
fn output_with<'d>(decl: &'d Decl, tail: &Tail) -> Option<&'d String> {
    decl.outputs.iter().find(|output| std::ptr::eq(&output.tail, tail)).map(|output| &output.name)
}

#[derive(Serialize)]
struct KindRow<'s> {
    r#type: String,
    access: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    unit: Option<&'s str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    range: Option<RangeRow>,
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    names: &'s [String],
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    retain: bool,
}

#[derive(Serialize)]
struct RangeRow {
    #[serde(skip_serializing_if = "Option::is_none")]
    from: Option<Limit>,
    #[serde(skip_serializing_if = "Option::is_none")]
    above: Option<Limit>,
    #[serde(skip_serializing_if = "Option::is_none")]
    to: Option<Limit>,
}

/// A bound: a number, or a text where it depends on other parameters.
#[derive(Serialize)]
#[serde(untagged)]
enum Limit {
    Number(f64),
    Text(String),
}

fn kind_row<'s>(seen: &Seen<'s>, decl: Option<&Decl>) -> KindRow<'s> {
    KindRow {
        r#type: if seen.time { "time".to_owned() } else { seen.ty.to_string() },
        access: access(seen.access),
        unit: seen.tail.and_then(|tail| tail.unit.as_deref()),
        range: seen.tail.and_then(|tail| range_row(seen, tail, decl)),
        names: seen.tail.map_or(&[], |tail| &tail.names),
        retain: retained(seen, decl),
    }
}

fn range_row(seen: &Seen<'_>, tail: &Tail, decl: Option<&Decl>) -> Option<RangeRow> {
    let bounds = tail.bounds.as_ref()?;
    let (low, high) = range(seen);
    let limit = |bound: &Option<Expr>, number: Option<f64>| {
        bound.as_ref().map(|bound| match number.filter(|number| number.is_finite()) {
            Some(number) => Limit::Number(number),
            None => Limit::Text(spelled(decl, bound)),
        })
    };
    let lower = limit(&bounds.lower, low);
    let (from, above) = if bounds.above { (None, lower) } else { (lower, None) };
    Some(RangeRow { from, above, to: limit(&bounds.upper, high) })
}

/// A bound as it is declared.
fn spelled(decl: Option<&Decl>, expr: &Expr) -> String {
    let both = |a: &Expr, sign: &str, b: &Expr| format!("({} {sign} {})", spelled(decl, a), spelled(decl, b));
    match expr {
        Expr::Int(value) => value.to_string(),
        Expr::Real(value) => format!("{:?}", value.wide),
        Expr::Size(index) => decl.and_then(|decl| decl.sizes.get(*index)).map_or_else(String::new, |s| s.name.clone()),
        Expr::Param(index) => {
            decl.and_then(|decl| decl.params.get(*index)).map_or_else(String::new, |p| p.name.clone())
        }
        Expr::Negate(a) => format!("-{}", spelled(decl, a)),
        Expr::Add(a, b) => both(a, "+", b),
        Expr::Subtract(a, b) => both(a, "-", b),
        Expr::Multiply(a, b) => both(a, "*", b),
        Expr::Divide(a, b) => both(a, "/", b),
    }
}

fn map_row(out: &mut String, cx: &Context<'_>, seen: &Seen<'_>, kind: &Kind) {
    out.push_str("    {");
    text::string(out, seen.name);
    if seen.ty.elements() == 0 {
        out.push_str(", 0");
        out.push_str(&kind.row_end[1..]);
        return;
    }
    out.push_str(", offsetof(");
    out.push_str(&cx.name);
    out.push_str(", ");
    place(out, cx, seen);
    out.push_str(&kind.row_end);
}

/// The member designator of a point's first element.
fn place(out: &mut String, cx: &Context<'_>, seen: &Seen<'_>) {
    let scope = Scope::MEMBERS;
    match seen.place {
        Place::Signal(id) => match expr::signal_base(out, cx, scope, id) {
            Base::Array(first) if first > 0 || seen.ty.is_scalar() => {
                let _ = write!(out, "[{first}]");
            }
            Base::Array(_) | Base::Scalar => {}
        },
        Place::Param(block, param) => parameter(out, cx, block, param as usize),
        Place::Cell(cell) => expr::cell(out, cx, scope, cell),
        Place::Image(image) => {
            let border = &cx.layout.border;
            let index = border.images[image.0 as usize] as usize;
            let _ = match seen.access {
                Access::Image => write!(out, "in.{}", border.inputs[index].0),
                _ => write!(out, "out.{}", border.outputs[index].0),
            };
        }
        Place::Inside(id) => {
            let scope = enter(out, cx, seen.path);
            expr::signal_base(out, cx, scope, id);
        }
        Place::Memory(field) => memory(out, cx, seen.path, field as usize),
    }
}

fn parameter(out: &mut String, cx: &Context<'_>, id: BlockId, param: usize) {
    match parameter_home(cx, UnitId(0), id, param) {
        Home::Hot(name) => {
            expr::block(out, cx, Scope::MEMBERS, id);
            out.push('.');
            out.push_str(name);
        }
        Home::Cold(name) => {
            out.push_str("cold.");
            out.push_str(cx.layout.cold_names[id.0 as usize].as_deref().unwrap_or_default());
            out.push('.');
            out.push_str(name);
        }
        Home::Literal => {}
    }
}

/// The instances from the program's own unit inwards.
fn enter(out: &mut String, cx: &Context<'_>, path: &[BlockId]) -> Scope<'static> {
    let mut scope = Scope::MEMBERS;
    for id in path {
        expr::block(out, cx, scope, *id);
        out.push('.');
        if let Some(unit) = cx.program.unit(scope.unit).block(*id).unit {
            scope = Scope { unit, root: "", part: WHOLE };
        }
    }
    scope
}

fn memory(out: &mut String, cx: &Context<'_>, path: &[BlockId], field: usize) {
    let Some((last, outer)) = path.split_last() else {
        return;
    };
    let scope = enter(out, cx, outer);
    let code = cx.code(cx.program.unit(scope.unit).block(*last).decl);
    match cx.shape_of(scope.unit, *last).memory.get(field).copied().flatten() {
        Some(index) => {
            expr::field(out, cx, scope, *last, index);
        }
        None => {
            expr::state(out, cx, scope, *last);
            out.push('.');
            out.push_str(&code.decl.memory[field].name);
        }
    }
}

fn json_row(out: &mut String, cx: &Context<'_>, seen: &Seen<'_>, kind: &Kind) {
    out.push_str(if out.is_empty() { "\n    {\"name\": " } else { ",\n    {\"name\": " });
    json_string(out, seen.name);
    out.push_str(&kind.json_row);
    if !seen.elements.is_empty() {
        out.push_str(", \"elements\": [");
        for (i, name) in seen.elements.iter().enumerate() {
            out.push_str(if i > 0 { ", " } else { "" });
            json_string(out, name);
        }
        out.push(']');
    }
    if let Some(value) = default(cx, seen.place) {
        out.push_str(", \"default\": ");
        json_value(out, value, seen, cx.program.width);
    }
    out.push('}');
}

fn json_string(out: &mut String, text: &str) {
    if text.bytes().all(|byte| matches!(byte, b' '..=b'~') && byte != b'"' && byte != b'\\') {
        out.push('"');
        out.push_str(text);
        out.push('"');
    } else {
        out.push_str(&serde_json::to_string(text).unwrap_or_default());
    }
}

fn default<'c>(cx: &'c Context<'_>, place: Place) -> Option<&'c Value> {
    let main = cx.program.main();
    match place {
        Place::Param(block, param) => known_value(&main.block(block).params[param as usize]),
        Place::Cell(cell) => Some(&main.cells[cell.0 as usize].initial),
        Place::Signal(_) | Place::Inside(_) | Place::Image(_) | Place::Memory(_) => None,
    }
}

fn json_value(out: &mut String, value: &Value, seen: &Seen<'_>, width: Width) {
    if seen.ty.is_scalar() {
        json_number(out, number(value, 0), seen.ty.scalar, width);
        return;
    }
    out.push('[');
    for element in 0..seen.ty.elements() {
        if element > 0 {
            out.push_str(", ");
        }
        json_number(out, number(value, element), seen.ty.scalar, width);
    }
    out.push(']');
}

fn json_number(out: &mut String, value: Number, scalar: Scalar, width: Width) {
    let real = match (value, scalar) {
        (Number::Int(value), Scalar::Int) => {
            let _ = write!(out, "{value}");
            return;
        }
        (Number::Int(value), Scalar::Real) => Real::from_int(value),
        (Number::Real(value), _) => value,
    };
    if real.wide.is_nan() {
        out.push_str("null");
        return;
    }
    text::number_text(out, real, width);
}
