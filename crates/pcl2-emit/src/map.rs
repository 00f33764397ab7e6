//! `NAME_map.c`: every point with its place.

use crate::args::{Home, parameter_home};
use crate::context::Context;
use crate::expr::{self, Kind, Scope};
use crate::layout::WHOLE;
use crate::tags;
use crate::text;
use pcl2_lang::kernel;
use pcl2_lang::model::{Access, Place, Point};
use pcl2_lang::program::{BlockId, UnitId};
use pcl2_lang::types::{Real, Scalar};
use std::fmt::Write;

/// Writes the map.
pub(crate) fn map(cx: &Context<'_>, points: &[Point], layout_hash: u64) -> String {
    let name = &cx.name;
    let mut out = String::with_capacity(points.len() * 96);
    let _ = writeln!(out, "/* Names, places, types and ranges of everything in an instance of {name}. */");
    let _ = writeln!(out, "#include \"{name}.h\"\n\n#include <stddef.h>\n");
    let _ = writeln!(out, "static const struct pcl2_point {name}_points[{}] = {{", points.len().max(1));
    for point in points {
        row(&mut out, cx, point);
    }
    if points.is_empty() {
        out.push_str("    {\"\", \"\", 0, 0, 0, 0, 0, PCL2_REAL, PCL2_SIGNAL, 0},\n");
    }
    let period = cx.program.period.unwrap_or(0);
    let _ = writeln!(
        out,
        "}};\n\nconst struct pcl2_map {name}_map = {{\n    \"{name}\", UINT64_C(0x{layout_hash:016x}), INT64_C({period}), sizeof({name}), {}, {name}_points,\n}};",
        points.len()
    );
    out
}

fn row(out: &mut String, cx: &Context<'_>, point: &Point) {
    out.push_str("    {");
    text::string(out, &point.name);
    out.push_str(", ");
    text::string(out, point.unit.as_deref().unwrap_or(""));
    out.push_str(", ");
    let elements = point.ty.elements();
    if elements == 0 {
        out.push_str("0, 0, 0");
    } else {
        let _ = write!(out, "offsetof({}, ", cx.name);
        place(out, cx, point);
        let (rows, columns) = point.ty.rows_columns();
        let _ = write!(out, "), {rows}, {columns}");
    }
    let tag = tags::tag(cx, point);
    let (low, high) = tags::range(&tag);
    limit(out, cx, low, "-PCL2_REAL_MAX");
    limit(out, cx, high, "PCL2_REAL_MAX");
    let ty = match (point.time, point.ty.scalar) {
        (true, _) => "TIME",
        (false, Scalar::Int) => "INT",
        (false, Scalar::Real) => "REAL",
    };
    let access = match point.access {
        Access::Signal => "SIGNAL",
        Access::Input => "INPUT",
        Access::Image => "IMAGE",
        Access::Tunable => "TUNABLE",
        Access::Operator => "OPERATOR",
        Access::State => "STATE",
    };
    let _ = writeln!(out, ", PCL2_{ty}, PCL2_{access}, {}}},", i32::from(tag.retain));
}

fn limit(out: &mut String, cx: &Context<'_>, value: Option<f64>, open: &str) {
    out.push_str(", ");
    match value.filter(|value| value.is_finite() && (*value as f32).is_finite()) {
        Some(value) => text::real(out, Real { wide: value, narrow: value as f32 }, cx.program.width),
        None => out.push_str(open),
    }
}

/// The member designator of a point's first element.
fn place(out: &mut String, cx: &Context<'_>, point: &Point) {
    let scope = Scope::MEMBERS;
    let kind = match point.place {
        Place::Signal(id) => expr::signal_base(out, cx, scope, id),
        Place::Param(block, param) => {
            parameter(out, cx, block, param as usize);
            Kind::Scalar
        }
        Place::Cell(cell) => {
            expr::cell(out, cx, scope, cell);
            Kind::Scalar
        }
        Place::Image(image) => {
            let border = &cx.layout.border;
            let index = border.images[image.0 as usize] as usize;
            let _ = match point.access {
                Access::Image => write!(out, "in.{}", border.inputs[index].0),
                _ => write!(out, "out.{}", border.outputs[index].0),
            };
            Kind::Scalar
        }
        Place::Memory(field) => {
            memory(out, cx, &point.path, field as usize);
            Kind::Scalar
        }
    };
    if let Kind::Array(first @ 1..) = kind {
        let _ = write!(out, "[{first}]");
    } else if let (Kind::Array(0), true) = (kind, point.ty.is_scalar()) {
        out.push_str("[0]");
    }
}

fn parameter(out: &mut String, cx: &Context<'_>, id: BlockId, param: usize) {
    match parameter_home(cx, UnitId(0), id, param) {
        Home::Hot(name) => {
            expr::block(out, cx, Scope::MEMBERS, id);
            let _ = write!(out, ".{name}");
        }
        Home::Cold(name) => {
            let cold = cx.layout.cold_names[id.0 as usize].as_deref().unwrap_or_default();
            let _ = write!(out, "cold.{cold}.{name}");
        }
        Home::Literal => {}
    }
}

fn memory(out: &mut String, cx: &Context<'_>, path: &[BlockId], field: usize) {
    let mut scope = Scope::MEMBERS;
    let Some((last, outer)) = path.split_last() else {
        return;
    };
    for id in outer {
        expr::block(out, cx, scope, *id);
        out.push('.');
        if let Some(unit) = cx.program.unit(scope.unit).block(*id).unit {
            scope = Scope { unit, root: "", part: WHOLE };
        }
    }
    let code = cx.code(cx.program.unit(scope.unit).block(*last).decl);
    match cx.shape_of(scope.unit, *last).memory.get(field).copied().flatten() {
        Some(index) => {
            expr::field(out, cx, scope, *last, index);
        }
        None => {
            expr::state(out, cx, scope, *last);
            let _ = write!(out, ".{}", code.decl.memory[field].name);
        }
    }
}

/// FNV-1a over name, type and access of every point, in order, and the width of reals.
pub(crate) fn layout_hash(cx: &Context<'_>, points: &[Point]) -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut add = |text: &str| {
        for byte in text.bytes().chain([0]) {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    };
    add(kernel::c_scalar(Scalar::Real));
    add(if cx.program.width.bytes() == 4 { "32" } else { "64" });
    let mut ty = String::new();
    for point in points {
        add(&point.name);
        ty.clear();
        let _ = write!(ty, "{}{}{:?}", point.ty, if point.time { "t" } else { "" }, point.access);
        add(&ty);
    }
    hash
}
