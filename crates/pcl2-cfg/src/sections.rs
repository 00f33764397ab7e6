//! Pass 1: which section each statement stands in.

use crate::Input;
use crate::draft::Scope;
use pcl2_lang::ast::{Line, Statement};
use pcl2_lang::codes;
use pcl2_lang::diagnostic::Diagnostic;
use pcl2_lang::program::SectionKind;
use pcl2_lang::source::Span;
use rustc_hash::FxHashMap;

/// The sections of a source in order of execution, and its statements.
pub(crate) struct Sectioned<'a> {
    pub(crate) sections: Vec<(SectionKind, Span)>,
    /// Each statement with its section.
    pub(crate) statements: Vec<(&'a Statement, u32)>,
}

/// Reads the sections and applies `--plant`.
pub(crate) fn read<'a>(input: &Input<'a>, diagnostics: &mut Vec<Diagnostic>) -> Sectioned<'a> {
    let mut found: Vec<(SectionKind, Span)> = Vec::new();
    let mut firsts: FxHashMap<(u8, u32, u32), Span> = FxHashMap::default();
    let mut statements: Vec<(&Statement, u32)> = Vec::new();
    let mut homeless = false;
    for line in &input.tree.lines {
        let section = match line {
            Line::Block(statement) => {
                if found.is_empty() && !homeless {
                    homeless = true;
                    let start = statement.number.map_or(statement.code.span, |(_, span)| span);
                    diagnostics.push(
                        Diagnostic::new(
                            codes::SECTION,
                            start,
                            "expected INITIALIZE, PLANT or CONTROL before the first block, found a block",
                        )
                        .help("write CONTROL on a line above it"),
                    );
                }
                statements.push((statement, found.len().saturating_sub(1) as u32));
                continue;
            }
            Line::Initialize(span) => (SectionKind::Initialize, *span),
            Line::Plant(span) => (SectionKind::Plant, *span),
            Line::Control(span, rate) => match control(*span, rate, diagnostics) {
                Some(kind) => (kind, *span),
                None => {
                    found.push((EVERY_SCAN, *span));
                    continue;
                }
            },
            Line::UnknownSection(span) => {
                found.push((EVERY_SCAN, *span));
                continue;
            }
            Line::End(_) => continue,
        };
        check_repetition(&found, section, &mut firsts, diagnostics);
        found.push(section);
    }
    check_control(input, &found, diagnostics);
    let sectioned = Sectioned { sections: found, statements };
    in_order(move_plant(input, sectioned, diagnostics))
}

/// What a section is taken for whose rate is wrong.
const EVERY_SCAN: SectionKind = SectionKind::Control { every: 1, offset: 0 };

fn control(span: Span, rate: &[(u32, Span)], diagnostics: &mut Vec<Diagnostic>) -> Option<SectionKind> {
    let (every, every_span) = rate.first().copied().unwrap_or((1, span));
    let (offset, offset_span) = rate.get(1).copied().unwrap_or((0, span));
    if every == 0 {
        let message = "expected a rate of at least 1 scan, found 0";
        diagnostics.push(Diagnostic::new(codes::SECTION, every_span, message));
        return None;
    }
    if offset >= every {
        let message = format!("expected an offset from 0 to {}, found {offset}", every - 1);
        diagnostics.push(Diagnostic::new(codes::SECTION, offset_span, message));
        return None;
    }
    Some(SectionKind::Control { every, offset })
}

fn check_repetition(
    found: &[(SectionKind, Span)],
    new: (SectionKind, Span),
    firsts: &mut FxHashMap<(u8, u32, u32), Span>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let key = match new.0 {
        SectionKind::Initialize => (0, 0, 0),
        SectionKind::Plant => (1, 0, 0),
        SectionKind::Control { every, offset } => (2, every, offset),
    };
    let first = *firsts.entry(key).or_insert(new.1);
    if first != new.1 {
        let message = match new.0 {
            SectionKind::Initialize => "expected one INITIALIZE, found a second",
            SectionKind::Plant => "expected one PLANT, found a second",
            SectionKind::Control { .. } => {
                "expected one CONTROL section for each rate, found a second with the same rate"
            }
        };
        let report = Diagnostic::new(codes::SECTION, new.1, message);
        diagnostics.push(report.label(first, "the first one").help("put the blocks into the first one"));
    }
    if new.0 == SectionKind::Initialize && first == new.1 && !found.is_empty() {
        let message = "expected INITIALIZE before all other sections, found it after one";
        diagnostics.push(Diagnostic::new(codes::SECTION, new.1, message).label(found[0].1, "this section comes first"));
    }
}

fn check_control(input: &Input<'_>, found: &[(SectionKind, Span)], diagnostics: &mut Vec<Diagnostic>) {
    let has_control = found.iter().any(|(kind, _)| matches!(kind, SectionKind::Control { .. }));
    // A file without END may be cut short.
    let homeless = found.is_empty() && !input.tree.lines.is_empty();
    if let (Some(at), false) = (input.tree.end, has_control || homeless) {
        diagnostics.push(
            Diagnostic::new(codes::SECTION, at, "expected a CONTROL section, found none")
                .help("blocks that run in every scan stand after a line CONTROL"),
        );
    }
}

/// `--plant 2,3,8`: these blocks of a one-section listing are its plant.
fn move_plant<'a>(input: &Input<'a>, mut sectioned: Sectioned<'a>, diagnostics: &mut Vec<Diagnostic>) -> Sectioned<'a> {
    let plant = &input.options.plant;
    if plant.is_empty() {
        return sectioned;
    }
    let whole = Span { file: input.file, start: 0, end: 0 };
    let controls: Vec<usize> = (0..sectioned.sections.len())
        .filter(|i| matches!(sectioned.sections[*i].0, SectionKind::Control { .. }))
        .collect();
    let has_plant = sectioned.sections.iter().any(|(kind, _)| *kind == SectionKind::Plant);
    let [control] = controls[..] else {
        let message = format!("--plant cuts a source with one CONTROL section, found {}", controls.len());
        diagnostics.push(Diagnostic::new(codes::PLANT_LIST, whole, message));
        return sectioned;
    };
    if has_plant {
        let message = "--plant cuts a source without a PLANT section, found one";
        diagnostics.push(Diagnostic::new(codes::PLANT_LIST, whole, message).help("move the blocks into PLANT"));
        return sectioned;
    }
    let target = sectioned.sections.len() as u32;
    sectioned.sections.push((SectionKind::Plant, sectioned.sections[control].1));
    for number in plant {
        let written = |statement: &Statement| statement.number.is_some_and(|(n, _)| n == *number);
        let found = sectioned.statements.iter_mut().find(|(s, section)| written(s) && *section as usize == control);
        match found {
            Some((_, section)) => *section = target,
            None => {
                let message = format!("--plant names block {number}, which the CONTROL section does not have");
                diagnostics.push(Diagnostic::new(codes::PLANT_LIST, whole, message));
            }
        }
    }
    sectioned
}

/// INITIALIZE, PLANT, then the CONTROL sections in file order.
fn in_order(sectioned: Sectioned<'_>) -> Sectioned<'_> {
    let rank = |kind: SectionKind| match kind {
        SectionKind::Initialize => 0,
        SectionKind::Plant => 1,
        SectionKind::Control { .. } => 2,
    };
    let mut order: Vec<usize> = (0..sectioned.sections.len()).collect();
    order.sort_by_key(|i| rank(sectioned.sections[*i].0));
    let mut place = vec![0; order.len()];
    for (new, old) in order.iter().enumerate() {
        place[*old] = new as u32;
    }
    let statements =
        sectioned.statements.into_iter().map(|(s, section)| (s, place.get(section as usize).copied().unwrap_or(0)));
    Sectioned { sections: order.iter().map(|i| sectioned.sections[*i]).collect(), statements: statements.collect() }
}

/// A variable crosses the border in one direction: PLANT and CONTROL do not both write it.
pub(crate) fn check_border(sectioned: &Sectioned<'_>, scope: &Scope<'_>, diagnostics: &mut Vec<Diagnostic>) {
    let Some(plant) = sectioned.sections.iter().position(|(kind, _)| *kind == SectionKind::Plant) else {
        return;
    };
    let control = |section: u32| {
        let kind = sectioned.sections.get(section as usize).map(|(kind, _)| *kind);
        matches!(kind, Some(SectionKind::Control { .. }))
    };
    for wire in scope.wires.iter().filter(|wire| wire.writers.len() > 1 && !wire.spoiled) {
        let writers = || wire.writers.iter().map(|writer| &scope.drafts[writer.block.0 as usize]);
        let in_plant = writers().find(|draft| draft.section as usize == plant);
        let in_control = writers().find(|draft| control(draft.section));
        if let (Some(in_plant), Some(in_control)) = (in_plant, in_control) {
            let message = format!("expected `{}` to be written by PLANT or by CONTROL, found both", wire.name);
            diagnostics.push(
                Diagnostic::new(codes::BOTH_SIDES, in_control.first_output(), message)
                    .label(in_plant.first_output(), "PLANT writes it here")
                    .help("give the controller's part a name of its own: a measurement and a command are two signals"),
            );
        }
    }
}

/// Blocks that may not stand where they do.
pub(crate) fn check_contents(sectioned: &Sectioned<'_>, scope: &Scope<'_>, diagnostics: &mut Vec<Diagnostic>) {
    for draft in &scope.drafts {
        let Some(decl) = draft.decl else {
            continue;
        };
        let Some((kind, _)) = sectioned.sections.get(draft.section as usize) else {
            continue;
        };
        let simulated = decl.simulated && *kind != SectionKind::Plant;
        let image = decl.image.is_some() && !matches!(kind, SectionKind::Control { .. });
        if simulated {
            let message =
                format!("expected {} in PLANT, where the process is simulated, found it elsewhere", decl.name);
            diagnostics.push(Diagnostic::new(codes::WRONG_SECTION, draft.statement.code.span, message));
        } else if image {
            let message = format!(
                "expected {} in CONTROL, which reads and writes the process image, found it elsewhere",
                decl.name
            );
            diagnostics.push(Diagnostic::new(codes::WRONG_SECTION, draft.statement.code.span, message));
        }
    }
}
