//! Cutting a program at the border between PLANT and CONTROL.

use crate::program::{
    Block, BlockId, CellId, Delay, ImageId, Program, Role, Section, SectionKind, Signal, SignalId, Source, Unit,
    UnitId, Writer,
};

/// Which blocks of a program are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// All of them: what a simulation runs.
    All,
    /// The controller: PLANT is left out, and INITIALIZE blocks that only PLANT reads.
    Control,
    /// The simulated process: what is left out of the controller.
    Plant,
}

/// Where a block stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Initialize,
    Plant,
    Control,
}

/// The wanted part. Signals that cross the border become inputs and outputs. A program without PLANT is its own
/// controller. The plant has a name of its own, so that both parts can stand in one C program.
pub fn cut(program: &Program, part: Part) -> Program {
    let sides = sides(program);
    let own = match part {
        Part::All => return program.clone(),
        Part::Control => Side::Control,
        Part::Plant => Side::Plant,
    };
    let border = Border::new(program, &sides, own);
    let kept = border.kept();
    let mut cutter = Cutter::new(program, &border, &kept);
    let unit = cutter.unit();
    let (units, unit_ids) = reachable_units(program, &unit);
    let mut cut = Program {
        name: if part == Part::Plant { format!("{}_plant", program.name) } else { program.name.clone() },
        units: std::iter::once(unit).chain(units).collect(),
        sections: sections(program, &kept),
        images: cutter.images.iter().map(|id| program.images[id.0 as usize].clone()).collect(),
        delays: cutter.delays(),
        period: program.period,
        width: program.width,
        decls: program.decls.clone(),
        substeps: program.substeps,
        bindings: program.bindings.clone(),
    };
    for block in cut.units.iter_mut().flat_map(|unit| &mut unit.blocks) {
        block.unit = block.unit.map(|id| unit_ids[id.0 as usize]);
    }
    cut
}

/// Whether this part is the program as it stands, so that nothing need be cut.
pub fn is_whole(program: &Program, part: Part) -> bool {
    match part {
        Part::All => true,
        Part::Control => program.sections.iter().all(|section| section.kind != SectionKind::Plant),
        Part::Plant => false,
    }
}

fn sides(program: &Program) -> Vec<Side> {
    let mut sides = Vec::with_capacity(program.main().blocks.len());
    for section in &program.sections {
        let side = match section.kind {
            SectionKind::Initialize => Side::Initialize,
            SectionKind::Plant => Side::Plant,
            SectionKind::Control { .. } => Side::Control,
        };
        sides.extend((section.first..section.end).map(|_| side));
    }
    sides
}

/// Who reads and writes each signal.
struct Border<'a> {
    program: &'a Program,
    sides: &'a [Side],
    own: Side,
    readers: Vec<Vec<u32>>,
}

impl<'a> Border<'a> {
    fn new(program: &'a Program, sides: &'a [Side], own: Side) -> Border<'a> {
        let unit = program.main();
        let mut readers = vec![Vec::new(); unit.signals.len()];
        for (b, block) in unit.blocks.iter().enumerate() {
            for id in block.ports.iter().filter_map(Source::signal) {
                readers[id.0 as usize].push(b as u32);
            }
        }
        Border { program, sides, own, readers }
    }

    fn side(&self, block: u32) -> Side {
        self.sides[block as usize]
    }

    /// Which blocks stay: the part's own, and the INITIALIZE blocks that it needs.
    fn kept(&self) -> Vec<bool> {
        let blocks = &self.program.main().blocks;
        let mut kept: Vec<bool> = self.sides.iter().map(|side| *side == self.own).collect();
        for b in (0..blocks.len()).rev().filter(|b| self.sides[*b] == Side::Initialize) {
            kept[b] = blocks[b].outputs.iter().any(|id| self.wants(*id, b as u32, &kept))
                || (self.own == Side::Control && blocks[b].outputs.iter().all(|id| self.unused(*id)));
        }
        kept
    }

    /// Whether a kept block reads the signal, or writes it too.
    fn wants(&self, id: SignalId, except: u32, kept: &[bool]) -> bool {
        let writers = self.program.main().signal(id).writers.iter().map(|writer| writer.block.0);
        let readers = self.readers[id.0 as usize].iter().copied();
        readers.chain(writers).any(|block| block != except && kept[block as usize])
    }

    fn unused(&self, id: SignalId) -> bool {
        let others = self.program.main().signal(id).writers.iter().filter(|w| self.side(w.block.0) != Side::Initialize);
        self.readers[id.0 as usize].is_empty() && others.count() == 0
    }

    fn written_by(&self, id: SignalId, side: Side) -> bool {
        self.program.main().signal(id).writers.iter().any(|writer| self.side(writer.block.0) == side)
    }

    fn read_by(&self, id: SignalId, side: Side) -> bool {
        self.readers[id.0 as usize].iter().any(|reader| self.side(*reader) == side)
    }

    fn role(&self, id: SignalId) -> Role {
        let other = if self.own == Side::Control { Side::Plant } else { Side::Control };
        let own_writes = self.written_by(id, self.own);
        if !own_writes && self.written_by(id, other) && self.read_by(id, self.own) {
            Role::Input
        } else if own_writes && self.read_by(id, other) {
            Role::Output
        } else {
            Role::Wire
        }
    }
}

/// Renumbers what stays.
struct Cutter<'a> {
    border: &'a Border<'a>,
    kept: &'a [bool],
    block_ids: Vec<Option<BlockId>>,
    signal_ids: Vec<Option<SignalId>>,
    cell_ids: Vec<Option<CellId>>,
    images: Vec<ImageId>,
    signals: Vec<Signal>,
}

impl<'a> Cutter<'a> {
    fn new(program: &'a Program, border: &'a Border<'a>, kept: &'a [bool]) -> Cutter<'a> {
        let unit = program.main();
        let mut next = 0;
        let mut number = |kept: bool| {
            next += u32::from(kept);
            kept.then(|| next - 1)
        };
        let block_ids: Vec<Option<BlockId>> = kept.iter().map(|kept| number(*kept).map(BlockId)).collect();
        let mut next_cell = 0;
        let cell_ids = unit.cells.iter().map(|cell| {
            let kept = block_ids[cell.block.0 as usize].is_some();
            next_cell += u32::from(kept);
            kept.then(|| CellId(next_cell - 1))
        });
        let cell_ids = cell_ids.collect();
        let signal_ids = vec![None; unit.signals.len()];
        Cutter { border, kept, block_ids, signal_ids, cell_ids, images: Vec::new(), signals: Vec::new() }
    }

    fn unit(&mut self) -> Unit {
        let unit = self.border.program.main();
        self.keep_signals(unit);
        let mut blocks = Vec::new();
        for (b, block) in unit.blocks.iter().enumerate().filter(|(b, _)| self.kept[*b]) {
            let id = BlockId(blocks.len() as u32);
            debug_assert_eq!(self.block_ids[b], Some(id));
            blocks.push(self.block(block, id));
        }
        let cells = unit.cells.iter().filter_map(|cell| {
            let block = self.block_ids[cell.block.0 as usize]?;
            Some(crate::program::Cell { block, ..cell.clone() })
        });
        let cells = cells.collect();
        Unit { composite: None, signals: std::mem::take(&mut self.signals), blocks, cells, outputs: Vec::new() }
    }

    /// Signals that a kept block reads or writes, in their order.
    fn keep_signals(&mut self, unit: &Unit) {
        for (s, signal) in unit.signals.iter().enumerate() {
            let id = SignalId(s as u32);
            let read = self.border.readers[s].iter().any(|block| self.kept[*block as usize]);
            let written = signal.writers.iter().any(|writer| self.kept[writer.block.0 as usize]);
            let role = self.border.role(id);
            let only_initialized = role == Role::Input && !read;
            if !(read || written) || only_initialized {
                continue;
            }
            let writers = if role == Role::Input { Vec::new() } else { self.writers(signal) };
            self.signal_ids[s] = Some(SignalId(self.signals.len() as u32));
            self.signals.push(Signal { writers, role, ..signal.clone() });
        }
    }

    fn writers(&self, signal: &Signal) -> Vec<Writer> {
        let writers = signal.writers.iter();
        writers.filter_map(|w| self.block_ids[w.block.0 as usize].map(|block| Writer { block, ..*w })).collect()
    }

    fn block(&mut self, block: &Block, id: BlockId) -> Block {
        let outputs: Vec<SignalId> =
            (0u32..).zip(&block.outputs).map(|(o, signal)| self.output(*signal, id, o)).collect();
        let ports = block.ports.iter().map(|port| self.port(port)).collect();
        let image = block.image.map(|image| self.image(image));
        Block { outputs, ports, image, ..block.clone() }
    }

    /// The signal of an output. What INITIALIZE writes where an input comes in leads nowhere.
    fn output(&mut self, signal: SignalId, block: BlockId, output: u32) -> SignalId {
        let new = self.signal_ids[signal.0 as usize];
        if let Some(new) = new.filter(|new| self.signals[new.0 as usize].role != Role::Input) {
            return new;
        }
        let old = self.border.program.main().signal(signal);
        self.signals.push(Signal {
            name: String::new(),
            ty: old.ty,
            writers: vec![Writer { block, output, inout: false }],
            role: Role::Wire,
            span: old.span,
        });
        SignalId(self.signals.len() as u32 - 1)
    }

    fn port(&mut self, port: &Source) -> Source {
        let signal = |id: &SignalId| self.signal_ids[id.0 as usize];
        let moved = match port {
            Source::Signal(id) => signal(id).map(Source::Signal),
            Source::Copied(id) => signal(id).map(Source::Copied),
            Source::Element(id, element) => signal(id).map(|id| Source::Element(id, *element)),
            Source::Cell(id) => self.cell_ids[id.0 as usize].map(Source::Cell),
            Source::Constant(_) | Source::Own(..) => None,
        };
        moved.unwrap_or_else(|| port.clone())
    }

    fn image(&mut self, image: ImageId) -> ImageId {
        let known = self.images.iter().position(|known| *known == image);
        let index = known.unwrap_or_else(|| {
            self.images.push(image);
            self.images.len() - 1
        });
        ImageId(index as u32)
    }

    fn delays(&self) -> Vec<Delay> {
        let delays = self.border.program.delays.iter();
        let moved = delays.filter_map(|delay| {
            let reader = self.block_ids[delay.reader.0 as usize]?;
            let signal = self.signal_ids[delay.signal.0 as usize]?;
            let inside = self.border.role(delay.signal) != Role::Input;
            inside.then_some(Delay { reader, signal, avoidable: delay.avoidable })
        });
        moved.collect()
    }
}

/// The sections that still have blocks, and CONTROL sections in any case.
fn sections(program: &Program, kept: &[bool]) -> Vec<Section> {
    let mut sections = Vec::new();
    let mut first = 0;
    for section in &program.sections {
        let count = (section.first..section.end).filter(|block| kept[*block as usize]).count() as u32;
        if count > 0 {
            sections.push(Section { first, end: first + count, ..section.clone() });
            first += count;
        }
    }
    sections
}

/// The composites that kept blocks use, and where each one went.
fn reachable_units(program: &Program, main: &Unit) -> (Vec<Unit>, Vec<UnitId>) {
    let mut used = vec![false; program.units.len()];
    for block in &main.blocks {
        if let Some(UnitId(inner)) = block.unit {
            used[inner as usize] = true;
        }
    }
    for u in 1..program.units.len() {
        if used[u] {
            for UnitId(inner) in program.units[u].blocks.iter().filter_map(|block| block.unit) {
                used[inner as usize] = true;
            }
        }
    }
    let mut ids = vec![UnitId(0); program.units.len()];
    let mut units = Vec::new();
    for u in (1..program.units.len()).filter(|u| used[*u]) {
        ids[u] = UnitId(units.len() as u32 + 1);
        units.push(program.units[u].clone());
    }
    (units, ids)
}
