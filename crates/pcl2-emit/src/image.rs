//! The const image that init copies: designated initialisers of what is not zero.

use crate::code::place_elements;
use crate::context::Context;
use crate::facts::element_scalar;
use crate::layout::WHOLE;
use crate::shape::Form;
use crate::text;
use pcl2_lang::decl::TypeExpr;
use pcl2_lang::program::{Block, BlockId, Param, SectionKind, UnitId};
use pcl2_lang::types::{Scalar, Value};
use std::fmt::Write;

/// Writes the image. Returns whether there is anything in it.
pub(crate) fn image(out: &mut String, cx: &Context<'_>) -> bool {
    let mut body = String::new();
    hot(&mut body, cx);
    let mut cold = String::new();
    parameters(&mut cold, cx);
    cells(&mut cold, cx);
    if !cold.is_empty() {
        let _ = writeln!(body, "    .cold = {{\n{cold}    }},");
    }
    for (section, phase) in cx.program.sections.iter().zip(&cx.layout.phases) {
        if let (SectionKind::Control { offset: offset @ 1.., .. }, Some(phase)) = (section.kind, phase) {
            let _ = writeln!(body, "    .{phase} = {offset},");
        }
    }
    if body.is_empty() {
        return false;
    }
    let name = &cx.name;
    let _ = writeln!(out, "static const {name} {name}_initial = {{\n{body}}};\n");
    true
}

fn hot(out: &mut String, cx: &Context<'_>) {
    let members = &cx.layout.units[0].members;
    let mut part = WHOLE;
    let mut inner = String::new();
    let mut values = String::new();
    for (b, member) in members.iter().enumerate() {
        if member.part != part {
            close_part(out, cx, part, &mut inner);
            part = member.part;
        }
        let indent = if part == WHOLE { "    " } else { "        " };
        values.clear();
        block_values(&mut values, cx, UnitId(0), BlockId(b as u32), &|_| None);
        if !values.is_empty() {
            let target = if part == WHOLE { &mut *out } else { &mut inner };
            target.extend([indent, ".", &member.name, " = {", &values, "},\n"]);
        }
    }
    close_part(out, cx, part, &mut inner);
}

fn close_part(out: &mut String, cx: &Context<'_>, part: u32, inner: &mut String) {
    if part != WHOLE && !inner.is_empty() {
        let _ = writeln!(out, "    .{} = {{\n{inner}    }},", cx.layout.part_names[part as usize]);
    }
    inner.clear();
}

/// Gives the value of a composite's own parameter.
type Own<'v> = dyn Fn(u32) -> Option<&'v Value> + 'v;

/// The initialisers of the parameters that a block's instance holds.
fn block_values<'v>(out: &mut String, cx: &'v Context<'_>, unit: UnitId, id: BlockId, own: &Own<'v>) {
    let block: &'v Block = cx.program.unit(unit).block(id);
    let shape = cx.shape_of(unit, id);
    let decl = cx.code(block.decl).decl;
    if let Form::Body(inner) = shape.form {
        let layout = cx.unit_layout(inner);
        for (i, _) in layout.facts.hot.iter().enumerate().filter(|(_, hot)| **hot) {
            value(out, cx, &layout.params[i], &decl.params[i].ty, block, resolve(&block.params[i], own));
        }
        inner_values(out, cx, inner, &|param| resolve(block.params.get(param as usize)?, own));
        return;
    }
    for (i, field) in shape.params.iter().enumerate().filter_map(|(i, field)| field.map(|field| (i, field))) {
        let name = &shape.fields[field].name;
        value(out, cx, name, &decl.params[i].ty, block, resolve(&block.params[i], own));
    }
}

fn inner_values<'v>(out: &mut String, cx: &'v Context<'_>, unit: UnitId, own: &dyn Fn(u32) -> Option<&'v Value>) {
    for (b, block) in cx.program.unit(unit).blocks.iter().enumerate().filter(|(_, block)| block.unit.is_some()) {
        let Some(inner) = block.unit else {
            continue;
        };
        let layout = cx.unit_layout(inner);
        let decl = cx.code(block.decl).decl;
        let resolved = |param: u32| match block.params.get(param as usize)? {
            Param::Value(value) => Some(value),
            Param::Own(outer) => own(*outer),
        };
        let mut values = String::new();
        for (i, _) in layout.facts.hot.iter().enumerate().filter(|(_, hot)| **hot) {
            value(&mut values, cx, &layout.params[i], &decl.params[i].ty, block, resolved(i as u32));
        }
        inner_values(&mut values, cx, inner, &resolved);
        if !values.is_empty() {
            separate(out);
            let _ = write!(out, ".{} = {{{values}}}", cx.unit_layout(unit).members[b].name);
        }
    }
}

fn resolve<'v>(param: &'v Param, own: &Own<'v>) -> Option<&'v Value> {
    match param {
        Param::Value(value) => Some(value),
        Param::Own(outer) => own(*outer),
    }
}

fn separate(out: &mut String) {
    if !out.is_empty() {
        out.push_str(", ");
    }
}

fn value(out: &mut String, cx: &Context<'_>, name: &str, ty: &TypeExpr, block: &Block, value: Option<&Value>) {
    let Some(value) = value else {
        return;
    };
    let elements = place_elements(ty, &block.sizes);
    let array = (!ty.is_scalar()).then_some(elements);
    initialiser(out, cx, name, value, array, element_scalar(ty));
}

/// `.name = value`, unless it is zero; the zeros at the end of an array are left out.
fn initialiser(out: &mut String, cx: &Context<'_>, name: &str, value: &Value, array: Option<usize>, scalar: Scalar) {
    let used = (0..array.unwrap_or(1)).rev().find(|i| !text::number(value, *i).is_zero()).map_or(0, |last| last + 1);
    if used == 0 {
        return;
    }
    separate(out);
    out.extend([".", name, " = "]);
    match array {
        None => text::element(out, value, 0, scalar, cx.program.width),
        Some(_) => {
            out.push('{');
            text::elements(out, value, used, scalar, cx.program.width);
            out.push('}');
        }
    }
}

fn parameters(out: &mut String, cx: &Context<'_>) {
    let unit = cx.program.main();
    let mut values = String::new();
    for (b, name) in cx.layout.cold_names.iter().enumerate().filter_map(|(b, name)| Some((b, name.as_ref()?))) {
        let id = BlockId(b as u32);
        let (block, shape) = (unit.block(id), cx.shape_of(UnitId(0), id));
        let Some(cold) = shape.cold.map(|cold| &cx.layout.colds[cold]) else {
            continue;
        };
        let decl = cx.code(block.decl).decl;
        values.clear();
        for (i, field) in cold.params.iter().enumerate().filter_map(|(i, field)| Some((i, (*field)?))) {
            value(
                &mut values,
                cx,
                &cold.fields[field].name,
                &decl.params[i].ty,
                block,
                resolve(&block.params[i], &|_| None),
            );
        }
        if !values.is_empty() {
            out.extend(["        .", name, " = {", &values, "},\n"]);
        }
    }
}

fn cells(out: &mut String, cx: &Context<'_>) {
    for (cell, name) in cx.program.main().cells.iter().zip(&cx.layout.cell_names) {
        let mut value = String::new();
        let array = (!cell.ty.is_scalar()).then_some(cell.ty.elements());
        initialiser(&mut value, cx, name, &cell.initial, array, cell.ty.scalar);
        if !value.is_empty() {
            let _ = writeln!(out, "        {value},");
        }
    }
}
