//! Pass 7: who reads the previous scan's value, and which of these delays can be avoided.

use crate::draft::Scope;
use crate::number::{MAX_NUMBER, numbered_ports};
use crate::sections::Sectioned;
use pcl2_lang::codes;
use pcl2_lang::diagnostic::{self, Diagnostic};
use pcl2_lang::program::{BlockId, Delay, SectionKind, SignalId, Writer};
use pcl2_lang::source::Span;

/// Finds the delays of the program's own scope and warns of avoidable ones and of second writers.
pub(crate) fn delays(sectioned: &Sectioned<'_>, scope: &Scope<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Delay> {
    second_writers(scope, diagnostics);
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
            let in_scan = writers.partition_point(|writer| initialize(writer.block.0 as usize));
            let in_time = writers.get(in_scan).is_some_and(|writer| (writer.block.0 as usize) < reader);
            let late = writers.last().is_some_and(|writer| writer.block.0 as usize >= reader);
            if late && !in_time {
                delays.push(Delay { reader: BlockId(reader as u32), signal, avoidable: false });
            }
        }
    }
    mark_avoidable(scope, &mut delays);
    let mut free = FreeNumbers::default();
    for delay in delays.iter().filter(|delay| delay.avoidable) {
        warn(scope, *delay, &mut free, diagnostics);
    }
    delays
}

/// The signals that a block reads, each once.
fn signals_read(scope: &Scope<'_>, block: usize) -> impl Iterator<Item = SignalId> {
    let sources = &scope.drafts[block].sources;
    let read = sources.iter().enumerate().filter_map(|(i, source)| Some((i, source.signal()?)));
    read.filter(|(i, id)| !sources[..*i].iter().any(|earlier| earlier.signal() == Some(*id))).map(|(_, id)| id)
}

fn second_writers(scope: &Scope<'_>, diagnostics: &mut Vec<Diagnostic>) {
    for wire in scope.wires.iter().filter(|wire| wire.writers.len() > 1 && !wire.name.is_empty()) {
        let mut first: Option<&Writer> = None;
        // Writers stand in order of execution, section by section.
        for writer in wire.writers.iter().filter(|writer| !writer.inout) {
            let section = |writer: &Writer| scope.drafts[writer.block.0 as usize].section;
            match first {
                Some(known) if section(known) == section(writer) => {
                    warn_second(scope, &wire.name, known, writer, diagnostics)
                }
                Some(_) | None => first = Some(writer),
            }
        }
    }
}

fn warn_second(scope: &Scope<'_>, name: &str, first: &Writer, second: &Writer, diagnostics: &mut Vec<Diagnostic>) {
    let message = format!("expected one block that writes `{name}` in a section, found a second one");
    let title = scope.drafts[first.block.0 as usize].title();
    let report = Diagnostic::new(codes::SECOND_WRITER, place_of(scope, second), message)
        .label(place_of(scope, first), format!("{title} writes it too"))
        .help("the last one wins; if a line was copied, give its output another name");
    diagnostic::warn(diagnostics, report);
}

/// Where the name that a writer writes stands.
fn place_of(scope: &Scope<'_>, writer: &Writer) -> Span {
    let statement = scope.drafts[writer.block.0 as usize].statement;
    let output = statement.outputs.get(writer.output as usize).or(statement.outputs.first());
    output.map_or(statement.code.span, |output| output.span())
}

/// A delay is avoidable when the reader does not itself feed what it reads, and both run in one section.
fn mark_avoidable(scope: &Scope<'_>, delays: &mut [Delay]) {
    let same_section = |delay: &Delay| {
        let section = |block: BlockId| scope.drafts[block.0 as usize].section;
        let writers = &scope.wire(delay.signal).writers;
        let ends = [writers.first(), writers.last()];
        ends.into_iter().flatten().all(|writer| section(writer.block) == section(delay.reader))
    };
    if !delays.iter().any(same_section) {
        return;
    }
    let loops = Loops::find(scope);
    for delay in delays {
        delay.avoidable = same_section(delay) && !loops.share(delay.reader, delay.signal);
    }
}

fn warn(scope: &Scope<'_>, delay: Delay, free: &mut FreeNumbers, diagnostics: &mut Vec<Diagnostic>) {
    let reader = &scope.drafts[delay.reader.0 as usize];
    let wire = scope.wire(delay.signal);
    let Some(last) = wire.writers.last() else {
        return;
    };
    let writer = &scope.drafts[last.block.0 as usize];
    let operand = reader.sources.iter().position(|source| source.signal() == Some(delay.signal));
    let span =
        operand.and_then(|i| reader.operands.get(i).copied().flatten()).map_or(reader.statement.span, |p| p.span);
    let message = format!(
        "expected `{}` to be written before block {} reads it, found block {} writing it later in the scan: the value is one scan old",
        wire.name, reader.number, writer.number
    );
    let help = match free.above(scope, writer.number, numbered_ports(reader)) {
        Some(number) => format!("number block {} as {number}, and the value is of the same scan", reader.number),
        None => {
            format!("give block {} a number below {}, and the value is of the same scan", writer.number, reader.number)
        }
    };
    let report = Diagnostic::new(codes::AVOIDABLE_DELAY, span, message)
        .label(place_of(scope, last), "it is written here")
        .help(help);
    diagnostic::warn(diagnostics, report);
}

/// The next free number; the last run of taken ones is kept, because warnings come in crowds.
#[derive(Default)]
struct FreeNumbers {
    taken: std::ops::Range<u32>,
}

impl FreeNumbers {
    /// The first of `count` free numbers in a row above a number.
    fn above(&mut self, scope: &Scope<'_>, number: u32, count: u32) -> Option<u32> {
        let mut from = number.checked_add(1)?;
        loop {
            if self.taken.contains(&from) {
                from = self.taken.end;
            }
            let start = from;
            while scope.by_number.get(from).is_some() {
                from += 1;
            }
            if from > start {
                self.taken = start..from;
            }
            let row = from..=from.checked_add(count.max(1) - 1).filter(|end| *end <= MAX_NUMBER)?;
            match row.into_iter().find(|number| scope.by_number.get(*number).is_some()) {
                None => return Some(from),
                Some(taken) => from = taken,
            }
        }
    }
}

/// The loops of a scope: blocks and signals of one strongly connected component share a number.
struct Loops {
    component: Vec<u32>,
    blocks: usize,
}

impl Loops {
    /// Tarjan's algorithm without recursion. Signals are nodes too: many readers of many writers stay few edges.
    fn find(scope: &Scope<'_>) -> Loops {
        let blocks = scope.drafts.len();
        let count = blocks + scope.wires.len();
        let (mut first, mut targets) = (Vec::with_capacity(count + 1), Vec::new());
        for block in 0..blocks {
            first.push(targets.len());
            targets.extend(signals_read(scope, block).map(|id| blocks as u32 + id.0));
        }
        for wire in &scope.wires {
            first.push(targets.len());
            targets.extend(wire.writers.iter().map(|writer| writer.block.0));
        }
        first.push(targets.len());
        let (index, low, component) = (vec![0; count], vec![0; count], vec![0; count]);
        let mut search = Search { first, targets, index, low, next: 1, stack: Vec::new(), component, components: 0 };
        for node in 0..count {
            if search.index[node] == 0 {
                search.visit(node as u32);
            }
        }
        Loops { component: search.component, blocks }
    }

    /// Whether a block and a signal are in one loop.
    fn share(&self, block: BlockId, signal: SignalId) -> bool {
        self.component[block.0 as usize] == self.component[self.blocks + signal.0 as usize]
    }
}

struct Search {
    /// The edges of node n: `targets[first[n]..first[n + 1]]`.
    first: Vec<usize>,
    targets: Vec<u32>,
    /// 0: not seen.
    index: Vec<u32>,
    low: Vec<u32>,
    next: u32,
    stack: Vec<u32>,
    /// 0: not assigned.
    component: Vec<u32>,
    components: u32,
}

impl Search {
    fn visit(&mut self, root: u32) {
        let mut path: Vec<(u32, usize)> = Vec::new();
        self.enter(root, &mut path);
        while let Some((block, edge)) = path.last_mut() {
            let here = *block as usize;
            let next = self.targets[self.first[here]..self.first[here + 1]].get(*edge).copied();
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
