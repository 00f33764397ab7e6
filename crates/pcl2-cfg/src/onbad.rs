//! Pass 9: truth values made of reals that reach an output, and do not say what they are when the real is bad.

use crate::draft::{Draft, Scope};
use crate::sections::Sectioned;
use pcl2_lang::codes;
use pcl2_lang::decl::Direction;
use pcl2_lang::diagnostic::{self, Diagnostic};
use pcl2_lang::program::{SectionKind, Source};

/// The parameter that says it.
const ON_BAD: &str = "onbad";

/// Warns of each such block.
pub(crate) fn unsaid(
    sectioned: &Sectioned<'_>,
    scope: &Scope<'_>,
    symbols: &pcl2_lang::symbol::Symbols,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let silent: Vec<usize> =
        (0..scope.drafts.len()).filter(|block| is_silent(&scope.drafts[*block], symbols)).collect();
    if silent.is_empty() {
        return;
    }
    let reaching = reaching_an_output(sectioned, scope);
    for block in silent.into_iter().filter(|block| reaching[*block]) {
        let draft = &scope.drafts[block];
        let code = draft.decl.map_or("", |decl| decl.name.as_str());
        let message = format!(
            "{}: expected `{ON_BAD}` of {code} to be written, as its result reaches an output, found none",
            draft.title()
        );
        let report = Diagnostic::new(codes::ON_BAD, draft.statement.code.span, message)
            .help(format!("say what it is while its input is bad: `{ON_BAD} = zero`, `one` or `hold`"));
        diagnostic::warn(diagnostics, report);
    }
}

/// Whether a block has the parameter, and the statement does not give it.
fn is_silent(draft: &Draft<'_>, symbols: &pcl2_lang::symbol::Symbols) -> bool {
    let Some(index) = draft.decl.and_then(|decl| decl.params.iter().position(|param| param.name == ON_BAD)) else {
        return false;
    };
    let params = draft.statement.params();
    let named = params.iter().filter_map(|item| item.label()).any(|label| symbols.text(label.symbol) == ON_BAD);
    let placed = params.get(index).is_some_and(|item| item.label().is_none() && !item.is_empty());
    !named && !placed
}

/// For each block, whether what it writes reaches a word to the plant or crosses the border to the simulated plant.
fn reaching_an_output(sectioned: &Sectioned<'_>, scope: &Scope<'_>) -> Vec<bool> {
    let is_plant = |draft: &Draft<'_>| {
        sectioned.sections.get(draft.section as usize).is_some_and(|(kind, _)| *kind == SectionKind::Plant)
    };
    let is_end = |draft: &Draft<'_>| {
        let image = draft.decl.and_then(|decl| decl.image);
        is_plant(draft) || image.is_some_and(|image| image.direction == Direction::Out)
    };
    let mut reaching: Vec<bool> = scope.drafts.iter().map(is_end).collect();
    let mut open: Vec<usize> = (0..reaching.len()).filter(|block| reaching[*block]).collect();
    while let Some(block) = open.pop() {
        for signal in scope.drafts[block].sources.iter().filter_map(Source::signal) {
            for writer in &scope.wire(signal).writers {
                let from = writer.block.0 as usize;
                if !std::mem::replace(&mut reaching[from], true) {
                    open.push(from);
                }
            }
        }
    }
    reaching
}
