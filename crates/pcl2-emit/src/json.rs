//! `NAME.json`: what the map says, and more, for tools.

use crate::context::Context;
use crate::layout::Crossing;
use crate::points::{ARRAYS, Points};
use pcl2_lang::decl::Direction;
use pcl2_lang::program::{BlockId, SectionKind};
use pcl2_lang::types::{Scalar, Width};
use serde::{Serialize, Serializer};
use serde_json::ser::Formatter;
use std::io;

/// Writes the file; uses the rows up.
pub(crate) fn json(cx: &Context<'_>, points: &mut Points) -> String {
    let program = cx.program;
    let model = Model {
        name: &cx.name,
        real: if program.width == Width::F32 { "f32" } else { "f64" },
        period_ns: program.period,
        substeps: program.substeps,
        layout: format!("{:016x}", points.hash),
        size: cx.layout.extent.padded(),
        sections: sections(cx),
        blocks: Blocks(cx),
        delays: Delays(cx),
        inputs: crossings(cx, true),
        outputs: crossings(cx, false),
        images: images(cx),
    };
    let mut bytes = Vec::new();
    let mut serializer = serde_json::Serializer::with_formatter(&mut bytes, Lines { depth: 0 });
    if model.serialize(&mut serializer).is_err() {
        bytes.clear();
    }
    let mut out = String::from_utf8(bytes).unwrap_or_default();
    append(&mut out, points);
    out
}

/// Puts the points behind the last key of the object.
fn append(out: &mut String, points: &mut Points) {
    out.truncate(out.trim_end_matches(['\n', '}']).len());
    let kinds: Vec<&str> = points.kinds.iter().map(|kind| kind.json.as_str()).collect();
    let close = |rows: bool| if rows { "\n  ]" } else { "]" };
    out.push_str(",\n  \"kinds\": [");
    for (i, kind) in kinds.iter().enumerate() {
        out.push_str(if i == 0 { "\n    " } else { ",\n    " });
        out.push_str(kind);
    }
    out.push_str(close(!kinds.is_empty()));
    for (name, rows) in ARRAYS.iter().zip(&mut points.arrays) {
        let rows = std::mem::take(rows);
        out.extend([",\n  \"", name, "\": [", &rows, close(!rows.is_empty())]);
    }
    out.push_str("\n}\n");
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
