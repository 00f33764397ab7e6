//! `NAME_init`: the image, derived coefficients, initial outputs, INITIALIZE.

use crate::args::{Call, Caller};
use crate::bodies;
use crate::calls;
use crate::context::Context;
use crate::expr::Scope;
use crate::layout::{PART, Store};
use crate::rows::Rows;
use crate::statics::Statics;
use crate::step;
use pcl2_lang::kernel::Entry;
use pcl2_lang::program::{BlockId, SectionKind, UnitId};
use std::fmt::Write;

/// Writes `NAME_init` and the functions that it is made of.
pub(crate) fn function(out: &mut String, cx: &Context<'_>, statics: &mut Statics, rows: &Rows, image: bool) {
    let name = &cx.name;
    let mut body = String::new();
    let _ = match image {
        true => writeln!(body, "    memcpy(self, &{name}_initial, sizeof *self);"),
        false => writeln!(body, "    memset(self, 0, sizeof *self);"),
    };
    if rows.any() {
        let _ = writeln!(body, "    pcl2_derive(self, &{name}_table);");
    }
    straight(out, &mut body, cx, statics, &rows.tunes, Entry::Tune);
    straight(out, &mut body, cx, statics, &rows.inits, Entry::Init);
    start_values(&mut body, cx, UnitId(0));
    for (index, section) in cx.program.sections.iter().enumerate() {
        if section.kind == SectionKind::Initialize && section.end > section.first {
            step::section(out, &mut body, cx, statics, index, "    ");
        }
    }
    step::outputs(&mut body, cx);
    let _ = writeln!(out, "void {name}_init({name} *self)\n{{\n{body}}}\n");
}

/// Calls for blocks that the table of parameters does not hold, in functions of limited length.
fn straight(
    out: &mut String,
    body: &mut String,
    cx: &Context<'_>,
    statics: &mut Statics,
    blocks: &[(BlockId, Option<i64>)],
    entry: Entry,
) {
    let long = blocks.len() > PART as usize;
    for chunk in blocks.chunks(PART as usize) {
        let mut calls = String::new();
        for (id, period) in chunk {
            let call = Call::new(cx, UnitId(0), *id, Caller::Init(Scope::of(UnitId(0))), *period);
            calls.push_str("    ");
            bodies::function_call(&mut calls, statics, &call, call.block().unit, entry);
            calls.push_str(";\n");
        }
        if long {
            let function = statics.name(if entry == Entry::Tune { "derive" } else { "start" });
            let _ = writeln!(out, "static void {function}({} *self)\n{{\n{calls}}}\n", cx.name);
            let _ = writeln!(body, "    {function}(self);");
        } else {
            body.push_str(&calls);
        }
    }
}

/// Copies declared initial outputs of blocks among several writers to their signals' slots.
pub(crate) fn start_values(out: &mut String, cx: &Context<'_>, unit: UnitId) {
    let (body, layout) = (cx.program.unit(unit), cx.unit_layout(unit));
    for slot in &layout.slots {
        let writers = &body.signal(slot.signal).writers;
        let starting = writers.iter().find(|writer| {
            !writer.inout && !is_initialize(cx, unit, writer.block) && starts(cx, unit, writer.block, writer.output)
        });
        if let Some(writer) = starting {
            let call = Call::new(cx, unit, writer.block, Caller::Init(Scope::of(unit)), None);
            calls::publish(out, &call, "    ", |output| output == writer.output as usize);
        }
    }
}

fn is_initialize(cx: &Context<'_>, unit: UnitId, block: BlockId) -> bool {
    let holds = |section: &pcl2_lang::program::Section| (section.first..section.end).contains(&block.0);
    let initialize = |section: &pcl2_lang::program::Section| section.kind == SectionKind::Initialize;
    unit.0 == 0 && cx.program.sections.iter().any(|section| initialize(section) && holds(section))
}

/// Whether init sets this output of a block.
fn starts(cx: &Context<'_>, unit: UnitId, block: BlockId, output: u32) -> bool {
    let called = cx.program.unit(unit).block(block);
    let code = cx.code(called.decl);
    let Some(inner) = called.unit else {
        return code.decl.start.contains(&code.output(output as usize, &called.sizes).0);
    };
    let signal = cx.program.unit(inner).outputs[output as usize];
    match cx.unit_layout(inner).stores[signal.0 as usize] {
        Store::Own(block, output) => starts(cx, inner, BlockId(block), output),
        Store::Slot(_) => true,
        Store::Input(_) | Store::Port(_) | Store::Local(_) => false,
    }
}
