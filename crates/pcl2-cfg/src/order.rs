//! Pass 7: who reads the previous scan's value, and which of these delays can be avoided.

use crate::draft::Scope;
use crate::sections::Sectioned;
use pcl2_lang::codes;
use pcl2_lang::diagnostic::Diagnostic;
use pcl2_lang::program::{BlockId, Delay, SectionKind, SignalId, Source};

/// Finds the delays of the program's own scope and warns of avoidable ones and of second writers.
pub(crate) fn delays(sectioned: &Sectioned<'_>, scope: &Scope<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Delay> {
    second_writers(sectioned, scope, diagnostics);
    let initialize = |block: usize| {
        let section = scope.drafts[block].section as usize;
        sectioned.sections.get(section).is_some_and(|(kind, _)| *kind == SectionKind::Initialize)
    };
    let mut delays = Vec::new();
    for reader in 0..scope.drafts.len() {
        if initialize(reader) {
            continue;
        }
        for signal in signals_read(scope, reader) {
            let writers = &scope.wire(signal).writers;
            let in_time = writers.iter().any(|writer| (writer.block.0 as usize) < reader);
            let late = writers.iter().any(|writer| writer.block.0 as usize >= reader);
            let earlier_in_scan =
                writers.iter().any(|writer| (writer.block.0 as usize) < reader && !initialize(writer.block.0 as usize));
            if late && !(in_time && earlier_in_scan) {
                delays.push(Delay { reader: BlockId(reader as u32), signal, avoidable: false });
            }
        }
    }
    let loops = Loops::find(scope);
    for delay in &mut delays {
        delay.avoidable = is_avoidable(scope, &loops, *delay);
        if delay.avoidable {
            warn(scope, *delay, diagnostics);
        }
    }
    delays
}

/// The signals that a block reads, each once.
fn signals_read(scope: &Scope<'_>, block: usize) -> Vec<SignalId> {
    let mut signals: Vec<SignalId> = Vec::new();
    for source in &scope.drafts[block].sources {
        if let Source::Signal(id) | Source::Copied(id) | Source::Element(id, _) = source {
            if !signals.contains(id) {
                signals.push(*id);
            }
        }
    }
    signals
}

fn second_writers(sectioned: &Sectioned<'_>, scope: &Scope<'_>, diagnostics: &mut Vec<Diagnostic>) {
    for wire in scope.wires.iter().filter(|wire| wire.writers.len() > 1 && !wire.name.is_empty()) {
        let whole: Vec<usize> =
            wire.writers.iter().filter(|writer| !writer.inout).map(|writer| writer.block.0 as usize).collect();
        for (i, second) in whole.iter().enumerate() {
            let section = scope.drafts[*second].section;
            let Some(first) = whole[..i].iter().find(|first| scope.drafts[**first].section == section) else {
                continue;
            };
            let (first, second) = (&scope.drafts[*first], &scope.drafts[*second]);
            let place = |draft: &crate::draft::Draft<'_>| {
                draft.statement.outputs.first().map_or(draft.statement.code.span, |output| output.span())
            };
            let message = format!("expected one block that writes `{}` in a section, found a second one", wire.name);
            diagnostics.push(
                Diagnostic::new(codes::SECOND_WRITER, place(second), message)
                    .label(place(first), format!("{} writes it too", first.title()))
                    .help("the last one wins; if a line was copied, give its output another name"),
            );
            let _ = sectioned;
        }
    }
}

/// The delay is avoidable when the reader does not itself feed what it reads, and both run in one section.
fn is_avoidable(scope: &Scope<'_>, loops: &Loops, delay: Delay) -> bool {
    let reader = delay.reader.0 as usize;
    let writers = &scope.wire(delay.signal).writers;
    writers.iter().all(|writer| {
        let writer = writer.block.0 as usize;
        let same_section = scope.drafts[writer].section == scope.drafts[reader].section;
        same_section && loops.component[writer] != loops.component[reader]
    })
}

fn warn(scope: &Scope<'_>, delay: Delay, diagnostics: &mut Vec<Diagnostic>) {
    let reader = &scope.drafts[delay.reader.0 as usize];
    let wire = scope.wire(delay.signal);
    let Some(writer) = wire.writers.first().map(|writer| &scope.drafts[writer.block.0 as usize]) else {
        return;
    };
    let operand = reader.sources.iter().position(|source| {
        matches!(source, Source::Signal(id) | Source::Copied(id) | Source::Element(id, _) if *id == delay.signal)
    });
    let span = operand.and_then(|i| reader.operands.get(i).copied().flatten()).map_or(reader.statement.span, |p| p.span);
    let message = format!(
        "expected `{}` to be written before block {} reads it, found block {} writing it later in the scan: the value is one scan old",
        wire.name, reader.number, writer.number
    );
    let help = match free_number_after(scope, writer.number) {
        Some(number) => format!("number block {} as {number}, and the value is of the same scan", reader.number),
        None => format!("give block {} a number above {}, and the value is of the same scan", reader.number, writer.number),
    };
    diagnostics.push(
        Diagnostic::new(codes::AVOIDABLE_DELAY, span, message)
            .label(writer.statement.outputs.first().map_or(writer.statement.code.span, |o| o.span()), "it is written here")
            .help(help),
    );
}

fn free_number_after(scope: &Scope<'_>, number: u32) -> Option<u32> {
    let next = number.checked_add(1)?;
    (!scope.by_number.contains_key(&next)).then_some(next)
}

/// The loops of a scope: blocks of one strongly connected component share a number.
struct Loops {
    component: Vec<u32>,
}

impl Loops {
    /// Tarjan's algorithm without recursion.
    fn find(scope: &Scope<'_>) -> Loops {
        let count = scope.drafts.len();
        let reads: Vec<Vec<u32>> = (0..count)
            .map(|block| {
                let signals = signals_read(scope, block);
                signals.iter().flat_map(|id| scope.wire(*id).writers.iter().map(|writer| writer.block.0)).collect()
            })
            .collect();
        let mut search = Search { reads: &reads, index: vec![0; count], low: vec![0; count], next: 1, stack: Vec::new(), component: vec![0; count], components: 0 };
        for block in 0..count {
            if search.index[block] == 0 {
                search.visit(block as u32);
            }
        }
        Loops { component: search.component }
    }
}

struct Search<'a> {
    reads: &'a [Vec<u32>],
    /// 0: not seen.
    index: Vec<u32>,
    low: Vec<u32>,
    next: u32,
    stack: Vec<u32>,
    /// 0: not assigned.
    component: Vec<u32>,
    components: u32,
}

impl Search<'_> {
    fn visit(&mut self, root: u32) {
        let mut path: Vec<(u32, usize)> = Vec::new();
        self.enter(root, &mut path);
        while let Some((block, edge)) = path.last_mut() {
            let (here, next) = (*block as usize, self.reads[*block as usize].get(*edge).copied());
            *edge += 1;
            match next {
                Some(to) if self.index[to as usize] == 0 => self.enter(to, &mut path),
                Some(to) if self.component[to as usize] == 0 => {
                    self.low[here] = self.low[here].min(self.index[to as usize]);
                }
                Some(_) => {}
                None => {
                    path.pop();
                    self.leave(here);
                    if let Some((parent, _)) = path.last() {
                        let parent = *parent as usize;
                        self.low[parent] = self.low[parent].min(self.low[here]);
                    }
                }
            }
        }
    }

    fn enter(&mut self, block: u32, path: &mut Vec<(u32, usize)>) {
        self.index[block as usize] = self.next;
        self.low[block as usize] = self.next;
        self.next += 1;
        self.stack.push(block);
        path.push((block, 0));
    }

    fn leave(&mut self, block: usize) {
        if self.low[block] != self.index[block] {
            return;
        }
        self.components += 1;
        while let Some(member) = self.stack.pop() {
            self.component[member as usize] = self.components;
            if member as usize == block {
                return;
            }
        }
    }
}
