//! `NAME.c`: kernels of small programs, composites, the table of parameters, init, step, tune.

use crate::bodies;
use crate::context::Context;
use crate::facts;
use crate::image;
use crate::init;
use crate::layout::{self, PART};
use crate::net;
use crate::points::Points;
use crate::rows;
use crate::runtime;
use crate::statics::Statics;
use crate::step;
use crate::tune;
use pcl2_lang::decl::Decl;
use pcl2_lang::program::UnitId;
use std::fmt::Write;

/// Writes the file. The second result lists the runtime's C files that it includes.
pub(crate) fn source(cx: &Context<'_>, points: &Points, has_file: &dyn Fn(&str) -> bool) -> (String, Vec<String>) {
    let mut statics = Statics::new(&cx.name, &cx.layout.tags);
    let mut body = String::new();
    for unit in layout::bodies(&cx.layout) {
        bodies::functions(&mut body, cx, &mut statics, unit);
    }
    net::net_scans(&mut body, &mut statics, cx);
    let kernels: Vec<facts::Facts> = cx.codes.iter().map(facts::of_kernel).collect();
    let table = rows::rows(cx, &mut statics, points.first_parameter, &kernels);
    body.push_str(&table.text);
    let offset = offset_type(cx, points);
    step::status_table(&mut body, cx, offset);
    step::fault_function(&mut body, cx);
    let image = image::image(&mut body, cx);
    init::function(&mut body, cx, &mut statics, &table, image);
    step::function(&mut body, cx, &mut statics);
    tune::function(&mut body, cx, &table);
    let mut head = String::new();
    let included = includes(&mut head, cx, offset, has_file);
    head.push_str(statics.text());
    body.insert_str(0, &head);
    (body, included)
}

/// The smallest type that holds every offset and every index of the map.
fn offset_type(cx: &Context<'_>, points: &Points) -> &'static str {
    let largest = cx.layout.extent.padded().max(points.count as u64 + 1);
    if largest < 1 << 16 { "uint16_t" } else { "uint32_t" }
}

/// Kernels whose blocks all stand in short sections or in composites come in as `static inline`.
fn includes(out: &mut String, cx: &Context<'_>, offset: &str, has_file: &dyn Fn(&str) -> bool) -> Vec<String> {
    let name = &cx.name;
    let extern_stems = stems_in_long_sections(cx);
    let _ = writeln!(out, "/* {name}: written by the PCL2 compiler from the program's source. */");
    let _ = writeln!(out, "#define PCL2_OFFSET {offset}\n");
    let mut included = Vec::new();
    let mut headers = Vec::new();
    for decl in layout::used_decls(cx.program, &cx.layout) {
        let decl = cx.program.decl(decl);
        if decl.is_composite() {
            continue;
        }
        let path = format!("pcl2/{}/{}.c", runtime::folder(decl), decl.stem);
        let header = format!("pcl2_{}.h", decl.stem);
        if !extern_stems.contains(&stem(decl)) && has_file(&path) {
            push_new(&mut included, path);
        } else {
            push_new(&mut headers, header);
        }
    }
    headers.extend(cx.net_header().map(str::to_owned));
    for header in &headers {
        let _ = writeln!(out, "#include \"{header}\"");
    }
    if !included.is_empty() {
        out.push_str("\n#undef PCL2_KERNEL\n#define PCL2_KERNEL static inline\n");
        for path in &included {
            let _ = writeln!(out, "#include \"{path}\"");
        }
        out.push_str("#undef PCL2_KERNEL\n#define PCL2_KERNEL\n");
    }
    let _ = writeln!(out, "\n#include \"pcl2_tune.h\"\n#include \"{name}.h\"\n");
    included
}

fn push_new(list: &mut Vec<String>, item: String) {
    if !list.contains(&item) {
        list.push(item);
    }
}

fn stem(decl: &Decl) -> (&str, &str) {
    (runtime::folder(decl), &decl.stem)
}

/// The declaration files with blocks in a section that is too long to take kernels in.
fn stems_in_long_sections<'c>(cx: &'c Context<'_>) -> Vec<(&'c str, &'c str)> {
    let mut seen = vec![false; cx.program.decls.len()];
    let mut stems = Vec::new();
    for section in cx.program.sections.iter().filter(|section| section.end - section.first > PART) {
        for block in &cx.program.unit(UnitId(0)).blocks[section.first as usize..section.end as usize] {
            if !std::mem::replace(&mut seen[block.decl.0 as usize], true) {
                let codes = layout::codes_of(cx.program, block.decl).into_iter();
                stems.extend(codes.map(|code| stem(cx.program.decl(code))));
            }
        }
    }
    stems
}
