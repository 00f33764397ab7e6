//! Pass 3: the number of each block; blocks then stand in order of execution.

use crate::draft::{Draft, Scope};
use pcl2_lang::codes;
use pcl2_lang::decl::{Decl, OutputDecl};
use pcl2_lang::diagnostic::{self, Diagnostic};
use pcl2_lang::kernel;
use rustc_hash::FxHashSet;

/// The largest block number.
pub(crate) const MAX_NUMBER: u32 = i32::MAX as u32;

/// Numbers the blocks of a scope and sorts them by section and number.
pub(crate) fn number(scope: &mut Scope<'_>, diagnostics: &mut Vec<Diagnostic>) {
    let mut last: Option<u32> = None;
    for draft in &mut scope.drafts {
        draft.number = match draft.statement.number {
            Some((number, _)) => number,
            None => {
                if draft.statement.outputs.is_empty() {
                    diagnostics.push(
                        Diagnostic::new(
                            codes::UNKNOWN_NUMBER,
                            draft.statement.code.span,
                            "expected a number or an output name before `=`, found neither",
                        )
                        .help("a block without a number has a name, so that others can refer to it"),
                    );
                    draft.spoiled = true;
                }
                last.map_or(1, |last| last.saturating_add(1))
            }
        };
        let end = u64::from(draft.number) + u64::from(numbered_ports(draft).max(1)) - 1;
        if end > u64::from(MAX_NUMBER) && !draft.spoiled {
            let message = format!("expected port numbers up to {MAX_NUMBER}, found {end}");
            diagnostics.push(Diagnostic::new(codes::NUMBER_RANGE, draft.statement.span, message));
            draft.spoiled = true;
        }
        last = Some(end.min(u64::from(MAX_NUMBER)) as u32);
    }
    check_overlap(scope, diagnostics);
    scope.drafts.sort_by_key(|draft| (draft.section, draft.number));
}

/// How many numbers the block takes: a block without names takes one for each output.
pub(crate) fn numbered_ports(draft: &Draft<'_>) -> u32 {
    match draft.decl {
        Some(decl) if draft.statement.outputs.is_empty() => {
            let sizes: Vec<i32> = draft.sizes.iter().map(|size| size.unwrap_or(0)).collect();
            decl.outputs
                .iter()
                .filter(|output| takes_number(output))
                .map(|output| ports_of(output, &sizes))
                .sum::<usize>() as u32
        }
        _ => 1,
    }
}

/// A return wire is reached by name only.
pub(crate) fn takes_number(output: &OutputDecl) -> bool {
    !output.by_name
}

fn ports_of(output: &OutputDecl, sizes: &[i32]) -> usize {
    kernel::count(output.group.as_ref(), sizes).unwrap_or(0)
}

/// How many outputs a code has, groups expanded.
pub(crate) fn output_count(decl: &Decl, sizes: &[i32]) -> usize {
    decl.outputs.iter().map(|output| ports_of(output, sizes)).sum()
}

/// The names of a code's outputs, groups expanded: `y1`, `y2`, ..
pub(crate) fn output_names(decl: &Decl, sizes: &[i32]) -> Vec<String> {
    let mut names = Vec::new();
    for output in &decl.outputs {
        match &output.group {
            None => names.push(output.name.clone()),
            Some(group) => {
                let count = kernel::count(Some(group), sizes).unwrap_or(0);
                names.extend((1..=count).map(|i| format!("{}{i}", output.name)));
            }
        }
    }
    names
}

fn check_overlap(scope: &mut Scope<'_>, diagnostics: &mut Vec<Diagnostic>) {
    let mut taken: Vec<(u32, u32)> = Vec::with_capacity(scope.drafts.len());
    for (i, draft) in scope.drafts.iter().enumerate() {
        let ports = numbered_ports(draft).max(1);
        taken.extend((draft.number..=MAX_NUMBER).take(ports as usize).map(|number| (number, i as u32)));
    }
    taken.sort_unstable();
    let mut reported: FxHashSet<u32> = FxHashSet::default();
    let mut first = 0;
    for i in 1..taken.len() {
        if taken[i].0 != taken[first].0 {
            first = i;
        } else if reported.insert(taken[i].1) && !diagnostic::enough(diagnostics) {
            let (draft, other) = (&scope.drafts[taken[i].1 as usize], &scope.drafts[taken[first].1 as usize]);
            diagnostics.push(number_taken(draft, other, taken[i].0));
        }
    }
}

fn number_taken(draft: &Draft<'_>, other: &Draft<'_>, number: u32) -> Diagnostic {
    let place = |draft: &Draft<'_>| draft.statement.number.map_or(draft.statement.code.span, |(_, span)| span);
    let message = format!("expected a free block number, found {number} a second time");
    let label = if other.number == number { "the first block with it" } else { "an output of this block has it" };
    Diagnostic::new(codes::NUMBER_TAKEN, place(draft), message)
        .label(place(other), label)
        .help("give one of them another number; a number is also the place in the order of execution")
}
