//! What depends on the scan period.

use pcl2_lang::codes;
use pcl2_lang::diagnostic::Diagnostic;
use pcl2_lang::program::{Program, SectionKind, UnitId};

/// Checks the period of a program. `required`: a program that needs one cannot go on without it.
pub fn check_period(program: &Program, required: bool, diagnostics: &mut Vec<Diagnostic>) {
    match program.period {
        Some(period) => check_sections(program, period, diagnostics),
        None if required => require(program, diagnostics),
        None => {}
    }
}

/// Every section's period is a whole number of nanoseconds.
fn check_sections(program: &Program, period: i64, diagnostics: &mut Vec<Diagnostic>) {
    for section in &program.sections {
        let message = match section.kind {
            SectionKind::Plant if period % i64::from(program.substeps) != 0 => format!(
                "expected a period that {} substeps divide into whole nanoseconds, found {period} ns",
                program.substeps
            ),
            SectionKind::Control { every, .. } if period.checked_mul(i64::from(every)).is_none() => {
                format!("expected a section's period below 292 years, found {every} times {period} ns")
            }
            _ => continue,
        };
        diagnostics.push(Diagnostic::new(codes::PERIOD, section.span, message));
    }
}

/// Reports the first block that needs a period.
fn require(program: &Program, diagnostics: &mut Vec<Diagnostic>) {
    let mut needs = vec![false; program.units.len()];
    for u in (0..program.units.len()).rev() {
        let first = program.units[u].blocks.iter().find(|block| {
            let inner = block.unit.is_some_and(|UnitId(inner)| needs[inner as usize]);
            inner || program.decl(block.decl).period
        });
        needs[u] = first.is_some();
        if let (0, Some(block)) = (u, first) {
            let code = &program.decl(block.decl).name;
            let message = format!("block {}: expected a scan period for {code}, found none", block.number);
            let help = "give it with --period S, or as `period` in [controller] of pcl2.toml";
            diagnostics.push(Diagnostic::new(codes::PERIOD, block.span, message).help(help));
        }
    }
}
