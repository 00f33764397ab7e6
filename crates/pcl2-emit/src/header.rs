//! `NAME.h`: the instance and the three functions.

use crate::NetForm;
use crate::code::place_elements;
use crate::context::Context;
use crate::facts::element_scalar;
use crate::io;
use crate::layout::{self, Border, WHOLE};
use crate::net::classes;
use crate::shape::{self, Cold, Form, Shape};
use crate::size;
use pcl2_lang::kernel;
use pcl2_lang::program::{BlockId, UnitId};
use pcl2_lang::types::Type;
use std::fmt::Write;

/// Writes the header.
pub(crate) fn header(cx: &Context<'_>, layout_hash: u64) -> String {
    let name = &cx.name;
    let mut out = String::new();
    let guard = format!("{}_H", name.to_uppercase());
    let _ = writeln!(out, "/* {name}: one instance of the controller, and what there is to do with it. */");
    let _ = writeln!(out, "#ifndef {guard}\n#define {guard}\n\n#include \"pcl2.h\"\n#include \"pcl2_map.h\"");
    let points = io::points(cx);
    if points > 0 {
        out.push_str("#include \"pcl2_io.h\"\n");
    }
    for stem in stems(cx) {
        let _ = writeln!(out, "#include \"pcl2_{stem}.h\"");
    }
    let _ = writeln!(out, "\n#ifdef __cplusplus\nextern \"C\" {{\n#endif\n");
    let _ = writeln!(
        out,
        "/* Names and types of everything in the map; saved values of another layout are merged by name. */"
    );
    let _ = writeln!(out, "#define {name}_LAYOUT UINT64_C(0x{layout_hash:016x})\n");
    structs(&mut out, cx);
    instance(&mut out, cx);
    functions(&mut out, name);
    if points > 0 {
        let _ = writeln!(
            out,
            "/* The physical points, for pcl2_latch before a step and pcl2_deliver after it; in {name}_io.c. */\n\
             extern const struct pcl2_io_point {name}_io[{points}];\n"
        );
    }
    let _ = writeln!(out, "#ifdef __cplusplus\n}}\n#endif\n\n#endif");
    out
}

/// The stems whose headers declare structs that are members.
fn stems<'c>(cx: &'c Context<'_>) -> Vec<&'c str> {
    let mut stems = Vec::new();
    for decl in layout::used_decls(cx.program, &cx.layout) {
        let code = cx.code(decl);
        if code.state && !stems.contains(&code.decl.stem.as_str()) {
            stems.push(code.decl.stem.as_str());
        }
    }
    stems
}

fn structs(out: &mut String, cx: &Context<'_>) {
    for shape in cx.layout.shapes.iter().filter(|shape| shape.declared) {
        shape_struct(out, cx, shape);
    }
    for cold in &cx.layout.colds {
        cold_struct(out, cold);
    }
    let mut declared = Vec::new();
    for unit in layout::bodies(&cx.layout) {
        body_struct(out, cx, unit, &mut declared);
    }
    for part in 0..cx.layout.parts.len() {
        part_struct(out, cx, part);
    }
}

fn shape_struct(out: &mut String, cx: &Context<'_>, shape: &Shape) {
    let code = &cx.code(shape.decl).decl.name;
    let _ = writeln!(out, "/* {code}: parameters that the step reads, state, outputs. */\nstruct {} {{", shape.tag);
    let params = shape.params.iter().flatten().count();
    for field in &shape.fields[..params] {
        shape::field(out, "    ", field);
    }
    if let Some(state) = &shape.state {
        let _ = writeln!(out, "    struct pcl2_{code} {state};");
    }
    for field in &shape.fields[params..] {
        shape::field(out, "    ", field);
    }
    out.push_str("};\n\n");
}

fn cold_struct(out: &mut String, cold: &Cold) {
    let _ = writeln!(out, "/* Parameters from which tune derives. */\nstruct {} {{", cold.tag);
    for field in &cold.fields {
        shape::field(out, "    ", field);
    }
    out.push_str("};\n\n");
}

fn body_struct<'c>(out: &mut String, cx: &'c Context<'_>, unit: UnitId, declared: &mut Vec<&'c str>) {
    let (body, layout) = (cx.program.unit(unit), cx.unit_layout(unit));
    let Some((decl, sizes)) = &body.composite else {
        return;
    };
    let decl = cx.program.decl(*decl);
    let fast = layout.net.as_ref().filter(|_| cx.layout.net_form == NetForm::Fast);
    let classes = decl.net.as_deref().zip(fast.map(|layout| &layout.names));
    if let Some((net, names)) = classes {
        classes::structs(out, net, names, declared);
    }
    let _ = writeln!(out, "/* {}: what one instance keeps. */\nstruct {} {{", decl.name, layout.tag);
    let start = out.len();
    for (i, param) in decl.params.iter().enumerate().filter(|(i, _)| layout.facts.hot[*i]) {
        let elements = place_elements(&param.ty, sizes);
        let count = (!param.ty.is_scalar()).then_some(elements);
        let element = kernel::c_scalar(element_scalar(&param.ty));
        if count != Some(0) {
            shape::field(out, "    ", &shape::Field { name: layout.params[i].clone(), element, count });
        }
    }
    for block in 0..body.blocks.len() {
        member(out, cx, unit, block, "    ");
    }
    for slot in layout.slots.iter().filter(|slot| !slot.inside) {
        signal(out, &slot.name, body.signal(slot.signal).ty, "    ");
    }
    if let Some((net, names)) = classes {
        classes::members(out, net, names);
    }
    if let Some(net) = &layout.net {
        out.push_str("    struct {\n");
        for field in &net.fields {
            shape::field(out, "        ", field);
        }
        out.push_str("    } net; /* what the net keeps beside */\n");
    }
    if layout.facts.status || out.len() == start {
        out.push_str("    int32_t status; /* 0, or the first fault of a block inside in the last scan */\n");
    }
    out.push_str("};\n\n");
}

fn member(out: &mut String, cx: &Context<'_>, unit: UnitId, block: usize, indent: &str) {
    let member = &cx.unit_layout(unit).members[block];
    let shape = &cx.layout.shapes[member.shape as usize];
    let name = &member.name;
    let _ = match shape.form {
        Form::Nothing => Ok(()),
        Form::Kernel => {
            out.extend([indent, "struct pcl2_", &cx.code(shape.decl).decl.name, " ", name, ";\n"]);
            Ok(())
        }
        Form::Struct => {
            out.extend([indent, "struct ", &shape.tag, " ", name, ";\n"]);
            Ok(())
        }
        Form::Body(inner) => {
            out.extend([indent, "struct ", &cx.unit_layout(inner).tag, " ", name, ";\n"]);
            Ok(())
        }
        Form::Plain => {
            let field = &shape.fields[0];
            match field.count {
                None => writeln!(out, "{indent}{} {name};", field.element),
                Some(count) => writeln!(out, "{indent}{} {name}[{count}];", field.element),
            }
        }
    };
}

/// The declaration of a signal with a place of its own; one without elements has none.
fn signal(out: &mut String, name: &str, ty: Type, indent: &str) {
    let element = kernel::c_scalar(ty.scalar);
    let _ = match ty.elements() {
        _ if ty.is_scalar() => writeln!(out, "{indent}{element} {name};"),
        0 => Ok(()),
        count => writeln!(out, "{indent}{element} {name}[{count}];"),
    };
}

fn part_struct(out: &mut String, cx: &Context<'_>, index: usize) {
    let part = cx.layout.parts[index];
    let mut members = String::new();
    run(&mut members, cx, part.first, part.end, index as u32);
    if !members.is_empty() {
        let _ = writeln!(
            out,
            "/* Blocks {}. */\nstruct {} {{\n{members}}};\n",
            numbers(cx, part.first, part.end),
            cx.layout.part_tags[index]
        );
    }
}

fn numbers(cx: &Context<'_>, first: u32, end: u32) -> String {
    let number = |block: u32| cx.program.main().block(BlockId(block)).number;
    format!("{} to {}", number(first), number(end - 1))
}

/// The members of a run of blocks, and the slots that belong to it.
fn run(out: &mut String, cx: &Context<'_>, first: u32, end: u32, part: u32) {
    for block in first..end {
        member(out, cx, UnitId(0), block as usize, "    ");
    }
    let slots = &cx.layout.units[0].slots;
    let from = slots.partition_point(|slot| (slot.part != WHOLE, slot.part) < (part != WHOLE, part));
    for slot in slots[from..].iter().take_while(|slot| slot.part == part) {
        signal(out, &slot.name, cx.program.main().signal(slot.signal).ty, "    ");
    }
}

fn instance(out: &mut String, cx: &Context<'_>) {
    let name = &cx.name;
    let _ = writeln!(out, "/* One instance: plain data, owned by the caller. */\ntypedef struct {name} {{");
    border(out, cx, &cx.layout.border);
    let mut next = 0;
    for (index, part) in cx.layout.parts.iter().enumerate() {
        members(out, cx, next, part.first);
        if struct_of_part(cx, index) {
            let _ = writeln!(out, "    struct {} {};", cx.layout.part_tags[index], cx.layout.part_names[index]);
        }
        next = part.end;
    }
    members(out, cx, next, cx.program.main().blocks.len() as u32);
    for slot in cx.layout.units[0].slots.iter().filter(|slot| slot.part == WHOLE) {
        signal(out, &slot.name, cx.program.main().signal(slot.signal).ty, "    ");
    }
    cold(out, cx);
    rest(out, cx);
    let _ = writeln!(out, "}} {name};\n");
}

fn members(out: &mut String, cx: &Context<'_>, first: u32, end: u32) {
    for block in first..end {
        member(out, cx, UnitId(0), block as usize, "    ");
    }
}

fn struct_of_part(cx: &Context<'_>, index: usize) -> bool {
    let part = cx.layout.parts[index];
    let members = &cx.layout.units[0].members[part.first as usize..part.end as usize];
    let kept = members.iter().any(|member| cx.layout.shapes[member.shape as usize].form != Form::Nothing);
    kept || cx.layout.units[0].slots.iter().any(|slot| slot.part == index as u32)
}

fn border(out: &mut String, cx: &Context<'_>, border: &Border<'_>) {
    for (list, member, note) in [
        (&border.inputs, "in", "Written by the caller before a step."),
        (&border.outputs, "out", "Read by the caller after init and after each step."),
    ] {
        if list.is_empty() {
            continue;
        }
        let _ = writeln!(out, "    /* {note} */\n    struct {{");
        for (name, crossing) in list {
            signal(out, name, size::crossing_type(cx.program, *crossing), "        ");
        }
        let _ = writeln!(out, "    }} {member};\n");
    }
}

fn cold(out: &mut String, cx: &Context<'_>) {
    let unit = cx.program.main();
    let mut text = String::new();
    for (b, name) in cx.layout.cold_names.iter().enumerate().filter_map(|(b, name)| Some((b, name.as_ref()?))) {
        if let Some(cold) = cx.shape_of(UnitId(0), BlockId(b as u32)).cold {
            text.extend(["        struct ", &cx.layout.colds[cold].tag, " ", name, ";\n"]);
        }
    }
    for (cell, name) in unit.cells.iter().zip(&cx.layout.cell_names) {
        signal(&mut text, name, cell.ty, "        ");
    }
    if !text.is_empty() {
        let _ = writeln!(
            out,
            "\n    /* Parameters that only tune reads, and operator cells. */\n    struct {{\n{text}    }} cold;\n"
        );
    }
}

fn rest(out: &mut String, cx: &Context<'_>) {
    for phase in cx.layout.phases.iter().flatten() {
        let _ = writeln!(out, "    uint32_t {phase}; /* scans until the section runs */");
    }
    out.push_str("    uint32_t scan; /* scans done; wraps */\n    struct pcl2_health health;\n");
    let scratch = cx.layout.scratch;
    for (declaration, size) in
        [("pcl2_real work", scratch.real), ("int32_t iwork", scratch.int), ("int64_t twork", scratch.time)]
    {
        if size > 0 {
            let _ = writeln!(out, "    {declaration}[{size}]; /* scratch of the blocks, one after the other */");
        }
    }
}

fn functions(out: &mut String, name: &str) {
    let _ = writeln!(
        out,
        "/* Fills an instance: parameters as in the source, declared initial outputs. */
void {name}_init({name} *self);

/* One scan. */
void {name}_step({name} *self);

/* Changes parameters and operator cells between two steps, all of them or none. Each set names its place by the
 * index in the map. Done: 0, and each set holds the value that it replaced. Refused (a value out of range, or one that
 * does not go with the others): the number of the set, from 1; nothing has changed. A set that names no such place:
 * its number, negated; nothing has changed. */
int {name}_tune({name} *self, struct pcl2_set *sets, int32_t n);

/* Names and places of everything inside; in {name}_map.c, linked only when used. */
extern const struct pcl2_map {name}_map;
"
    );
}
