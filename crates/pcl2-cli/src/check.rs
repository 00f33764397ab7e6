//! `pcl2 check`

use crate::args::{CheckArgs, Format};
use crate::console;
use crate::outcome::Outcome;
use crate::project::{self, Project};
use pcl2_lang::border::{Part, cut};
use pcl2_lang::diagnostic::{self, Diagnostic};
use pcl2_lang::kernel;
use pcl2_lang::program::{BlockId, Program, Role, SectionKind, Unit};
use pcl2_lang::types::Type;
use std::fmt::Write;

/// Checks programs.
pub(crate) fn check(args: &CheckArgs) -> Outcome {
    let mut worst = Outcome::Done;
    for path in &args.paths {
        let project = match project::load(path, &args.common) {
            Ok(project) => project,
            Err(outcome) => return outcome,
        };
        worst = worst.max(print(&project, args.format));
        if project.diagnostics.iter().any(Diagnostic::is_error) {
            worst = worst.max(Outcome::Errors);
        }
        if let (Some(verified), true) = (&project.verified, args.verbose) {
            worst = worst.max(console::answer(&report(verified.program())));
        }
        if args.timings {
            timings(&project);
        }
    }
    worst
}

fn print(project: &Project, format: Format) -> Outcome {
    match format {
        Format::Text => {
            console::diagnostics(&project.diagnostics, &project.sources, project.left_out);
            Outcome::Done
        }
        Format::Json => {
            let line = |diagnostic| format!("{}\n", diagnostic::to_json(diagnostic, &project.sources));
            console::answer(&project.diagnostics.iter().map(line).collect::<String>())
        }
    }
}

fn timings(project: &Project) {
    let total: f64 = project.timings.iter().map(|(_, time)| time.as_secs_f64()).sum();
    for (phase, time) in &project.timings {
        console::err(&format!("{phase:8} {:9.3} ms", time.as_secs_f64() * 1e3));
    }
    let rate = project.lines as f64 / total.max(1e-9);
    console::err(&format!("total    {:9.3} ms, {} lines, {rate:.0} lines/s", total * 1e3, project.lines));
}

/// Order, rates, delays, border and memory as text.
fn report(program: &Program) -> String {
    let mut text = String::new();
    let unit = program.main();
    for section in &program.sections {
        let title = match section.kind {
            SectionKind::Initialize => "INITIALIZE, once".to_owned(),
            SectionKind::Plant if program.substeps > 1 => format!("PLANT, {} times in every scan", program.substeps),
            SectionKind::Plant => "PLANT, in every scan".to_owned(),
            SectionKind::Control { every: 1, .. } => "CONTROL, in every scan".to_owned(),
            SectionKind::Control { every, offset } => format!("CONTROL, in every {every}. scan from scan {offset}"),
        };
        let _ = writeln!(text, "{title}");
        for block in &unit.blocks[section.first as usize..section.end as usize] {
            let decl = program.decl(block.decl);
            let outputs: Vec<String> = block.outputs.iter().map(|id| signal_text(unit, id.0 as usize)).collect();
            let bytes = memory_bytes(program, block);
            let _ = writeln!(text, "  {:>6}  {:10} {}  [{bytes} bytes]", block.number, decl.name, outputs.join(", "));
        }
    }
    delays(program, &mut text);
    border(program, &mut text);
    let _ = writeln!(text, "memory\n  {} bytes at most", pcl2_lang::verify::bytes(program).unwrap_or(u64::MAX));
    text
}

fn signal_text(unit: &Unit, index: usize) -> String {
    let signal = &unit.signals[index];
    if signal.name.is_empty() { "_".to_owned() } else { format!("{} {}", signal.ty, signal.name) }
}

fn memory_bytes(program: &Program, block: &pcl2_lang::program::Block) -> usize {
    let decl = program.decl(block.decl);
    let fields = decl.memory.iter().chain(&decl.tuned);
    let elements: usize = fields.filter_map(|field| kernel::field_elements(field, &block.sizes)).sum();
    let params = decl.params.iter().filter(|param| block.tunable && !param.fixed);
    let params: usize = params.filter_map(|param| kernel::resolve(&param.ty, &block.sizes)).map(Type::elements).sum();
    let heard = |i: &usize| {
        let declared = pcl2_lang::model::output_decl(decl, &block.sizes, *i);
        !declared.is_some_and(|declared| pcl2_lang::model::is_open(program.main(), block, decl, declared))
    };
    let outputs = (0..block.outputs.len()).filter(heard);
    let outputs: usize = outputs.map(|i| program.main().signal(block.outputs[i]).ty.elements()).sum();
    (elements + params + outputs) * program.width.bytes()
}

fn delays(program: &Program, text: &mut String) {
    if program.delays.is_empty() {
        return;
    }
    let _ = writeln!(text, "values of the previous scan");
    for delay in &program.delays {
        let unit = program.main();
        let (reader, signal) = (unit.block(delay.reader), unit.signal(delay.signal));
        let same_section =
            signal.writers.iter().all(|writer| section_of(program, writer.block) == section_of(program, delay.reader));
        let why = match (delay.avoidable, same_section) {
            (true, _) => "avoidable",
            (false, true) => "in a loop",
            (false, false) => "written in another section",
        };
        let _ = writeln!(text, "  block {} reads {} ({why})", reader.number, signal.name);
    }
}

fn section_of(program: &Program, block: BlockId) -> Option<usize> {
    program.sections.iter().position(|section| (section.first..section.end).contains(&block.0))
}

/// The signals that cross between PLANT and CONTROL, as `build` cuts them.
fn border(program: &Program, text: &mut String) {
    if !program.sections.iter().any(|section| section.kind == SectionKind::Plant) {
        return;
    }
    let controller = cut(program, Part::Control);
    let names = |role: Role| {
        let signals = controller.main().signals.iter().filter(|signal| signal.role == role);
        signals.map(|signal| signal.name.as_str()).collect::<Vec<_>>().join(", ")
    };
    let _ = writeln!(text, "border\n  inputs of the controller: {}", names(Role::Input));
    let _ = writeln!(text, "  outputs of the controller: {}", names(Role::Output));
}
