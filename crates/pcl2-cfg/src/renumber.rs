//! New block numbers: 1, 2, 3 .. in order of execution, and every reference to a number changed with them.

use crate::draft::{Draft, Scope, Wire};
use crate::number::{self, numbered_ports};
use crate::signals::connect;
use crate::{Input, bind, sections};
use pcl2_lang::ast::{Number, Operand};
use pcl2_lang::diagnostic::Diagnostic;
use pcl2_lang::program::BlockId;
use pcl2_lang::source::Span;

/// A change of the source's text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// What is replaced; empty where something is put in.
    pub span: Span,
    /// By what.
    pub text: String,
}

/// A text with changes made, which stand in order of their places. The bytes that are not text stay.
pub fn edited(bytes: &[u8], edits: &[Edit]) -> Vec<u8> {
    let mut text = Vec::with_capacity(bytes.len());
    let mut done = 0;
    for edit in edits {
        let (start, end) = (edit.span.start as usize, edit.span.end as usize);
        text.extend_from_slice(bytes.get(done..start).unwrap_or_default());
        text.extend_from_slice(edit.text.as_bytes());
        done = end;
    }
    text.extend_from_slice(bytes.get(done..).unwrap_or_default());
    text
}

/// The changes that renumber a source, in order of their places. `None` when there are errors.
pub fn renumber(input: &Input<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<Vec<Edit>> {
    let mut sectioned = sections::read(input, diagnostics);
    let mut scope = Scope::program(input, std::mem::take(&mut sectioned.statements));
    bind::bind(input, &mut scope, diagnostics);
    number::number(&mut scope, diagnostics);
    connect(input, &mut scope, diagnostics);
    if diagnostics.iter().any(Diagnostic::is_error) {
        return None;
    }
    let numbers = numbers(&scope, &order(&scope));
    let mut edits = Vec::new();
    own_numbers(&scope, &numbers, &mut edits);
    for draft in &scope.drafts {
        references(&scope, draft, &numbers, &mut edits);
    }
    edits.sort_by_key(|edit| edit.span);
    Some(edits)
}

/// The blocks in order of their new numbers: that of execution. Only where blocks of several sections write one
/// variable, and their numbers tell them apart in another order, the old order stays.
fn order(scope: &Scope<'_>) -> Vec<usize> {
    let mut order: Vec<usize> = (0..scope.drafts.len()).collect();
    let number = |block: BlockId| scope.drafts[block.0 as usize].number;
    let ascends = |wire: &Wire| wire.writers.is_sorted_by_key(|writer| number(writer.block));
    if !scope.wires.iter().filter(|wire| !wire.name.is_empty()).all(ascends) {
        order.sort_by_key(|block| scope.drafts[*block].number);
    }
    order
}

/// The new number of each block.
fn numbers(scope: &Scope<'_>, order: &[usize]) -> Vec<u32> {
    let mut numbers = vec![0; order.len()];
    let mut next = 1_u32;
    for block in order {
        numbers[*block] = next;
        next = next.saturating_add(numbered_ports(&scope.drafts[*block]).max(1));
    }
    numbers
}

/// A block without a number goes without one as long as the line above gives it the right one.
fn own_numbers(scope: &Scope<'_>, numbers: &[u32], edits: &mut Vec<Edit>) {
    let mut in_file: Vec<usize> = (0..scope.drafts.len()).collect();
    in_file.sort_by_key(|block| scope.drafts[*block].statement.span);
    let mut implied = 1;
    for block in in_file {
        let draft = &scope.drafts[block];
        let number = numbers[block];
        match draft.statement.number {
            Some((_, span)) => edits.push(Edit { span, text: number.to_string() }),
            None if implied == number => {}
            None => {
                let span = draft.statement.span;
                edits.push(Edit { span: Span { end: span.start, ..span }, text: format!("{number} ") });
            }
        }
        implied = number.saturating_add(numbered_ports(draft).max(1));
    }
}

/// The numbers of other blocks at a block's ports; in an expression a number is a value.
fn references(scope: &Scope<'_>, draft: &Draft<'_>, numbers: &[u32], edits: &mut Vec<Edit>) {
    if draft.formula.is_some() {
        return;
    }
    for place in draft.operands.iter().flatten() {
        let Operand::Number(Number::Int(written)) = place.value else {
            continue;
        };
        let Some((block, _)) = u32::try_from(written).ok().and_then(|written| scope.by_number.get(written)) else {
            continue;
        };
        let (old, new) = (scope.drafts[block.0 as usize].number, numbers[block.0 as usize]);
        let moved = i64::from(written) - i64::from(old) + i64::from(new);
        edits.push(Edit { span: place.span, text: moved.to_string() });
    }
}
