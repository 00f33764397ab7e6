//! `NAME.json`: what the map says, and more, for tools.

use crate::context::Context;
use crate::layout::Crossing;
use crate::tags;
use crate::text::{Number, number};
use pcl2_lang::decl::{Direction, Expr};
use pcl2_lang::model::{Place, Point};
use pcl2_lang::program::{BlockId, SectionKind};
use pcl2_lang::types::{Real, Scalar, Value, Width};
use serde::{Serialize, Serializer};
use serde_json::ser::Formatter;
use std::io;

/// Writes the file.
pub(crate) fn json(cx: &Context<'_>, points: &[Point], layout_hash: u64) -> String {
    let program = cx.program;
    let of = |wanted: fn(&Place) -> bool| Points { cx, points, wanted };
    let model = Model {
        name: &cx.name,
        real: if program.width == Width::F32 { "f32" } else { "f64" },
        period_ns: program.period,
        substeps: program.substeps,
        layout: format!("{layout_hash:016x}"),
        size: cx.layout.extent.padded(),
        sections: sections(cx),
        blocks: Blocks(cx),
        delays: Delays(cx),
        inputs: crossings(cx, true),
        outputs: crossings(cx, false),
        images: images(cx),
        signals: of(|place| matches!(place, Place::Signal(_))),
        parameters: of(|place| matches!(place, Place::Param(..))),
        cells: of(|place| matches!(place, Place::Cell(_))),
        words: of(|place| matches!(place, Place::Image(_))),
        memory: of(|place| matches!(place, Place::Memory(_))),
    };
    let mut bytes = Vec::with_capacity(points.len() * 128);
    let mut serializer = serde_json::Serializer::with_formatter(&mut bytes, Lines { depth: 0 });
    if model.serialize(&mut serializer).is_err() {
        bytes.clear();
    }
    bytes.push(b'\n');
    String::from_utf8(bytes).unwrap_or_default()
}

#[derive(Serialize)]
struct Model<'c> {
    name: &'c str,
    real: &'c str,
    period_ns: Option<i64>,
    substeps: u32,
    layout: String,
    size: u64,
    sections: Vec<SectionRow>,
    blocks: Blocks<'c>,
    delays: Delays<'c>,
    inputs: Vec<CrossingRow<'c>>,
    outputs: Vec<CrossingRow<'c>>,
    images: Vec<ImageRow<'c>>,
    signals: Points<'c>,
    parameters: Points<'c>,
    cells: Points<'c>,
    words: Points<'c>,
    memory: Points<'c>,
}

#[derive(Serialize)]
struct SectionRow {
    kind: &'static str,
    every: u32,
    offset: u32,
    period_ns: Option<i64>,
    first: u32,
    blocks: u32,
}

fn sections(cx: &Context<'_>) -> Vec<SectionRow> {
    let row = |section: &pcl2_lang::program::Section| {
        let (kind, every, offset) = match section.kind {
            SectionKind::Initialize => ("INITIALIZE", 0, 0),
            SectionKind::Plant => ("PLANT", 1, 0),
            SectionKind::Control { every, offset } => ("CONTROL", every, offset),
        };
        let period_ns = cx.program.period.map(|scan| section.period(scan, cx.program.substeps));
        SectionRow { kind, every, offset, period_ns, first: section.first, blocks: section.end - section.first }
    };
    cx.program.sections.iter().map(row).collect()
}

struct Blocks<'c>(&'c Context<'c>);

#[derive(Serialize)]
struct BlockRow<'c> {
    number: u32,
    name: &'c str,
    code: &'c str,
    section: usize,
}

impl Serialize for Blocks<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let cx = self.0;
        let sections = cx.program.sections.iter().enumerate();
        serializer.collect_seq(sections.flat_map(|(section, run)| {
            (run.first..run.end).map(move |id| {
                let block = cx.program.main().block(BlockId(id));
                let code = &cx.code(block.decl).decl.name;
                BlockRow { number: block.number, name: &block.name, code, section }
            })
        }))
    }
}

struct Delays<'c>(&'c Context<'c>);

#[derive(Serialize)]
struct DelayRow<'c> {
    block: u32,
    signal: &'c str,
    avoidable: bool,
}

impl Serialize for Delays<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let main = self.0.program.main();
        serializer.collect_seq(self.0.program.delays.iter().map(|delay| DelayRow {
            block: main.block(delay.reader).number,
            signal: &main.signal(delay.signal).name,
            avoidable: delay.avoidable,
        }))
    }
}

#[derive(Serialize)]
struct CrossingRow<'c> {
    name: &'c str,
    member: &'c str,
    r#type: String,
}

fn crossings<'c>(cx: &'c Context<'_>, inputs: bool) -> Vec<CrossingRow<'c>> {
    let border = &cx.layout.border;
    let list = if inputs { &border.inputs } else { &border.outputs };
    let row = |(member, crossing): &'c (std::borrow::Cow<'_, str>, Crossing)| match crossing {
        Crossing::Signal(id) => {
            let signal = cx.program.main().signal(*id);
            CrossingRow { name: &signal.name, member, r#type: signal.ty.to_string() }
        }
        Crossing::Image(id) => {
            let image = &cx.program.images[id.0 as usize];
            CrossingRow { name: &image.name, member, r#type: scalar(image.scalar).to_owned() }
        }
    };
    list.iter().map(row).collect()
}

fn scalar(scalar: Scalar) -> &'static str {
    match scalar {
        Scalar::Int => "int",
        Scalar::Real => "real",
    }
}

#[derive(Serialize)]
struct ImageRow<'c> {
    name: &'c str,
    direction: &'static str,
    r#type: &'static str,
    address: &'c [i32],
}

fn images<'c>(cx: &'c Context<'_>) -> Vec<ImageRow<'c>> {
    let row = |image: &'c pcl2_lang::program::ImageWord| ImageRow {
        name: &image.name,
        direction: if image.direction == Direction::In { "in" } else { "out" },
        r#type: scalar(image.scalar),
        address: &image.address,
    };
    cx.program.images.iter().map(row).collect()
}

struct Points<'c> {
    cx: &'c Context<'c>,
    points: &'c [Point],
    wanted: fn(&Place) -> bool,
}

#[derive(Serialize)]
struct PointRow<'c> {
    name: &'c str,
    index: usize,
    r#type: String,
    access: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    unit: Option<&'c str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    range: Option<RangeRow>,
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    names: &'c [String],
    #[serde(skip_serializing_if = "Option::is_none")]
    default: Option<Default<'c>>,
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

impl Serialize for Points<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let points = self.points.iter().enumerate().filter(|(_, point)| (self.wanted)(&point.place));
        serializer.collect_seq(points.map(|(index, point)| row(self.cx, index, point)))
    }
}

fn row<'c>(cx: &'c Context<'_>, index: usize, point: &'c Point) -> PointRow<'c> {
    let tag = tags::tag(cx, point);
    PointRow {
        name: &point.name,
        index,
        r#type: if point.time { "time".to_owned() } else { point.ty.to_string() },
        access: access(point),
        unit: point.unit.as_deref(),
        range: range(cx, point, &tag),
        names: &point.names,
        default: default(cx, point),
        retain: tag.retain,
    }
}

fn access(point: &Point) -> &'static str {
    use pcl2_lang::model::Access;
    match point.access {
        Access::Signal => "signal",
        Access::Input => "input",
        Access::Image => "image",
        Access::Tunable => "tunable",
        Access::Operator => "operator",
        Access::State => "state",
    }
}

fn range(cx: &Context<'_>, point: &Point, tag: &tags::Tag<'_>) -> Option<RangeRow> {
    let bounds = tag.tail?.bounds.as_ref()?;
    let (low, high) = tags::range(tag);
    let limit = |bound: &Option<Expr>, number: Option<f64>| {
        bound.as_ref().map(|bound| match number.filter(|number| number.is_finite()) {
            Some(number) => Limit::Number(number),
            None => Limit::Text(spelled(cx, point, bound)),
        })
    };
    let lower = limit(&bounds.lower, low);
    let (from, above) = if bounds.above { (None, lower) } else { (lower, None) };
    Some(RangeRow { from, above, to: limit(&bounds.upper, high) })
}

/// A bound as it is declared.
fn spelled(cx: &Context<'_>, point: &Point, expr: &Expr) -> String {
    let both = |a: &Expr, sign: &str, b: &Expr| format!("({} {sign} {})", spelled(cx, point, a), spelled(cx, point, b));
    match expr {
        Expr::Int(value) => value.to_string(),
        Expr::Real(value) => format!("{:?}", value.wide),
        Expr::Size(_) => String::new(),
        Expr::Param(index) => match point.place {
            Place::Param(block, _) => {
                let block = cx.program.main().block(block);
                cx.code(block.decl).decl.params.get(*index).map(|param| param.name.clone()).unwrap_or_default()
            }
            Place::Signal(_) | Place::Cell(_) | Place::Image(_) | Place::Memory(_) => String::new(),
        },
        Expr::Negate(a) => format!("-{}", spelled(cx, point, a)),
        Expr::Add(a, b) => both(a, "+", b),
        Expr::Subtract(a, b) => both(a, "-", b),
        Expr::Multiply(a, b) => both(a, "*", b),
        Expr::Divide(a, b) => both(a, "/", b),
    }
}

fn default<'c>(cx: &'c Context<'_>, point: &Point) -> Option<Default<'c>> {
    let main = cx.program.main();
    let value = match point.place {
        Place::Param(block, param) => crate::layout::known_value(&main.block(block).params[param as usize])?,
        Place::Cell(cell) => &main.cells[cell.0 as usize].initial,
        Place::Signal(_) | Place::Image(_) | Place::Memory(_) => return None,
    };
    let count = (!point.ty.is_scalar()).then_some(point.ty.elements());
    Some(Default { value, count, scalar: point.ty.scalar, width: cx.program.width })
}

struct Default<'c> {
    value: &'c Value,
    count: Option<usize>,
    scalar: Scalar,
    width: Width,
}

impl Serialize for Default<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let element = |i: usize| Element(number(self.value, i), self.scalar, self.width);
        match self.count {
            None => element(0).serialize(serializer),
            Some(count) => serializer.collect_seq((0..count).map(element)),
        }
    }
}

struct Element(Number, Scalar, Width);

impl Serialize for Element {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let real = match (self.0, self.1) {
            (Number::Int(value), Scalar::Int) => return serializer.serialize_i32(value),
            (Number::Int(value), Scalar::Real) => Real::from_int(value),
            (Number::Real(value), _) => value,
        };
        match self.2 {
            Width::F64 => serializer.serialize_f64(real.wide),
            Width::F32 => serializer.serialize_f32(real.narrow),
        }
    }
}

/// One line for each key, and for each element of an array behind it.
struct Lines {
    depth: usize,
}

/// Deeper than this everything stands on one line.
const OPEN: usize = 2;

impl Lines {
    fn separate<W: ?Sized + io::Write>(&self, writer: &mut W, first: bool) -> io::Result<()> {
        if self.depth > OPEN {
            return if first { Ok(()) } else { writer.write_all(b", ") };
        }
        writer.write_all(if first { b"\n" } else { b",\n" })?;
        writer.write_all(if self.depth == 1 { b"  " } else { b"    " })
    }

    fn close<W: ?Sized + io::Write>(&mut self, writer: &mut W, mark: &[u8]) -> io::Result<()> {
        self.depth -= 1;
        if self.depth < OPEN {
            writer.write_all(if self.depth == 0 { b"\n" } else { b"\n  " })?;
        }
        writer.write_all(mark)
    }
}

impl Formatter for Lines {
    fn begin_array<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.depth += 1;
        writer.write_all(b"[")
    }

    fn end_array<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.close(writer, b"]")
    }

    fn begin_array_value<W: ?Sized + io::Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        self.separate(writer, first)
    }

    fn begin_object<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.depth += 1;
        writer.write_all(b"{")
    }

    fn end_object<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.close(writer, b"}")
    }

    fn begin_object_key<W: ?Sized + io::Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        self.separate(writer, first)
    }

    fn begin_object_value<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b": ")
    }
}
