//! `NAME_step`: the sections that are due, one call a block.

use crate::calls::{self, Telling};
use crate::context::Context;
use crate::expr::{self, Scope};
use crate::layout::{Crossing, PART, WHOLE};
use crate::statics::Statics;
use pcl2_lang::program::{BlockId, Section, SectionKind, UnitId};
use std::fmt::Write;

const INDENT: &str = "    ";

/// Writes `NAME_step` and the functions that it is made of.
pub(crate) fn function(out: &mut String, cx: &Context<'_>, statics: &mut Statics) {
    let mut body = String::new();
    for (index, section) in cx.program.sections.iter().enumerate() {
        if section.end > section.first && section.kind != SectionKind::Initialize {
            due(out, &mut body, cx, statics, index, section);
        }
    }
    outputs(&mut body, cx);
    body.push_str("    self->scan++;\n");
    let name = &cx.name;
    let _ = writeln!(out, "void {name}_step({name} *self)\n{{\n{body}}}\n");
}

fn due(out: &mut String, body: &mut String, cx: &Context<'_>, statics: &mut Statics, index: usize, section: &Section) {
    let substeps = cx.program.substeps;
    match (section.kind, &cx.layout.phases[index]) {
        (SectionKind::Plant, _) if substeps > 1 => {
            let _ = writeln!(body, "    for (int32_t substep = 0; substep < {substeps}; substep++) {{");
            self::section(out, body, cx, statics, index, "        ");
            body.push_str("    }\n");
        }
        (SectionKind::Control { every, .. }, Some(phase)) => {
            let _ = writeln!(body, "    if (self->{phase} == 0) {{\n        self->{phase} = {every};");
            self::section(out, body, cx, statics, index, "        ");
            let _ = writeln!(body, "    }}\n    self->{phase}--;");
        }
        (SectionKind::Initialize | SectionKind::Plant | SectionKind::Control { .. }, _) => {
            self::section(out, body, cx, statics, index, INDENT);
        }
    }
}

/// Writes one run of a section: its calls, or calls of its functions.
pub(crate) fn section(
    out: &mut String,
    body: &mut String,
    cx: &Context<'_>,
    statics: &mut Statics,
    index: usize,
    indent: &str,
) {
    let section = &cx.program.sections[index];
    if section.end - section.first > PART {
        for (p, part) in cx.layout.parts.iter().enumerate() {
            if part.first >= section.first && part.end <= section.end {
                part_function(out, cx, statics, p);
                let _ = writeln!(body, "{indent}{}(self);", cx.layout.part_tags[p]);
            }
        }
        return;
    }
    let sole = cx.program.sections.iter().filter(|other| other.end > other.first).count() == 1;
    if sole && indent == INDENT {
        blocks(body, cx, statics, section.first, section.end, WHOLE);
        return;
    }
    let function = statics.name(match section.kind {
        SectionKind::Initialize => "initialize",
        SectionKind::Plant => "plant",
        SectionKind::Control { .. } => "control",
    });
    let mut text = String::new();
    blocks(&mut text, cx, statics, section.first, section.end, WHOLE);
    let _ = writeln!(out, "static void {function}({} *self)\n{{\n{text}}}\n", cx.name);
    let _ = writeln!(body, "{indent}{function}(self);");
}

fn part_function(out: &mut String, cx: &Context<'_>, statics: &mut Statics, p: usize) {
    let (part, tag, member) = (cx.layout.parts[p], &cx.layout.part_tags[p], &cx.layout.part_names[p]);
    let _ = writeln!(out, "static void {tag}({} *self)\n{{", cx.name);
    let mut text = String::new();
    blocks(&mut text, cx, statics, part.first, part.end, p as u32);
    if text.contains("part->") {
        let _ = writeln!(out, "    struct {tag} *const part = &self->{member};");
    }
    out.push_str(&text);
    out.push_str("}\n\n");
}

/// Writes the calls of a run of blocks. In a short section statuses are gathered and looked at once; in a part of a
/// long one their table is walked: a statement a block would cost the C compiler a quarter of its time.
fn blocks(out: &mut String, cx: &Context<'_>, statics: &mut Statics, first: u32, end: u32, part: u32) {
    let scope = Scope { unit: UnitId(0), root: "self->", part };
    let (from, to) = status_range(cx, first, end);
    let gathered = to > from && part == WHOLE;
    if gathered {
        out.push_str("    int32_t faults = 0;\n");
    }
    for id in (first..end).map(BlockId) {
        calls::step(out, cx, statics, scope, id, &format!("{}_fault(self, {});", cx.name, id.0));
        if gathered && calls::telling(cx, UnitId(0), id) == Telling::Status {
            out.push_str("    faults |= ");
            calls::status(out, cx, scope, id);
            out.push_str(";\n");
        }
    }
    if to > from && !gathered {
        let _ = writeln!(out, "    {}_status(self, {from}, {to});", cx.name);
    }
    if gathered {
        let _ = writeln!(out, "    if (faults != 0) {{\n        {}_status(self, {from}, {to});\n    }}", cx.name);
    }
}

/// The rows of the table of statuses that belong to a run of blocks.
fn status_range(cx: &Context<'_>, first: u32, end: u32) -> (usize, usize) {
    let statuses = &cx.statuses;
    (statuses.partition_point(|block| *block < first), statuses.partition_point(|block| *block < end))
}

/// Writes the function that counts faults which results tell of.
pub(crate) fn fault_function(out: &mut String, cx: &Context<'_>) {
    let mut blocks = (0..cx.program.main().blocks.len() as u32).map(BlockId);
    if blocks.any(|block| calls::telling(cx, UnitId(0), block) == Telling::Result) {
        let _ = writeln!(
            out,
            "/* Counts the fault of a block whose result is bad although no input is. */
static void {name}_fault({name} *self, int32_t block)
{{
    pcl2_fault(&self->health, self->scan, block, 1);
}}
",
            name = cx.name
        );
    }
}

/// Writes the table of statuses and the function that takes them into the health record.
pub(crate) fn status_table(out: &mut String, cx: &Context<'_>, offset: &str) {
    if cx.statuses.is_empty() {
        return;
    }
    let name = &cx.name;
    let _ = writeln!(
        out,
        "/* Where each block leaves its status, and the block's index. */\nstatic const struct {{\n    {offset} at;\n    {offset} block;\n}} {name}_statuses[{}] = {{",
        cx.statuses.len()
    );
    for block in &cx.statuses {
        let _ = write!(out, "    {{offsetof({name}, ");
        calls::status(out, cx, Scope::MEMBERS, BlockId(*block));
        let _ = writeln!(out, "), {block}}},");
    }
    let _ = writeln!(
        out,
        "}};

/* Counts the faults that the blocks of rows first to end - 1 left in this scan. */
static void {name}_status({name} *self, int32_t first, int32_t end)
{{
    for (int32_t i = first; i < end; i++) {{
        int32_t status;
        memcpy(&status, (const char *)self + {name}_statuses[i].at, sizeof status);
        if (status != 0) {{
            pcl2_fault(&self->health, self->scan, (int32_t){name}_statuses[i].block, status);
        }}
    }}
}}
"
    );
}

/// Copies the outputs of the border.
pub(crate) fn outputs(out: &mut String, cx: &Context<'_>) {
    let scope = Scope::of(UnitId(0));
    for (name, crossing) in &cx.layout.border.outputs {
        let Crossing::Signal(signal) = crossing else {
            continue;
        };
        let ty = cx.program.main().signal(*signal).ty;
        let to = |out: &mut String| {
            let _ = write!(out, "self->out.{name}");
            if ty.is_scalar() { expr::Kind::Scalar } else { expr::Kind::Array(0) }
        };
        calls::assign(out, INDENT, ty, to, |out| expr::signal_base(out, cx, scope, *signal));
    }
}
