//! Blocks as nodes with pins, outputs that are read as nets.

use super::text;
use pcl2_lang::decl::{Direction, RETURN_OUTPUT, RETURN_PORT};
use pcl2_lang::model::output_decl;
use pcl2_lang::program::{Block, BlockId, ImageWord, Program, SectionKind, SignalId, Source};
use pcl2_lang::types::Type;
use std::collections::BTreeSet;

/// So many open ports are shown at the end of a list.
const OPEN: usize = 3;

/// A program as nodes and nets.
pub(crate) struct Netlist {
    /// One for each block, in order of execution.
    pub(crate) nodes: Vec<Node>,
    /// In order of their writers.
    pub(crate) nets: Vec<Net>,
}

/// A block to be drawn.
pub(crate) struct Node {
    /// Index into [`Program::sections`].
    pub(crate) section: usize,
    pub(crate) number: u32,
    pub(crate) tag: String,
    pub(crate) code: String,
    /// A few parameters.
    pub(crate) note: String,
    /// All that there is to say.
    pub(crate) tip: String,
    /// Its body is PCL2.
    pub(crate) composite: bool,
    pub(crate) pins: Vec<Pin>,
}

/// The side of a box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Left,
    Right,
}

/// What stands at a pin instead of a wire.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Note {
    Nothing,
    /// A constant.
    Constant(String),
    /// An operator cell and its first value.
    Cell(String),
    /// A word of the process image.
    Word(String),
}

/// A port or an output.
pub(crate) struct Pin {
    pub(crate) side: Side,
    /// Counted from 0 on its side.
    pub(crate) row: usize,
    pub(crate) label: String,
    pub(crate) note: Note,
    pub(crate) net: Option<usize>,
    /// It reads the previous scan's value.
    pub(crate) delayed: bool,
    /// It belongs to a return wire.
    pub(crate) back: bool,
    /// It is joined to its net by name.
    pub(crate) flag: bool,
    /// `[2]`: the element that is read.
    pub(crate) element: String,
}

/// A node's pin.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct PinAt {
    pub(crate) node: usize,
    pub(crate) pin: usize,
}

/// An output and its readers.
pub(crate) struct Net {
    pub(crate) name: String,
    pub(crate) ty: Type,
    pub(crate) source: PinAt,
    pub(crate) sinks: Vec<PinAt>,
    /// It runs against the flow, from a `bk` to a `back`.
    pub(crate) is_return: bool,
}

/// Reads a program's own unit.
pub(crate) fn read(program: &Program) -> Netlist {
    let delays = program.delays.iter().map(|delay| (delay.reader, delay.signal.0)).collect();
    let once = program.sections.iter().filter(|section| section.kind == SectionKind::Initialize);
    let once = once.map(|section| section.end as usize).max().unwrap_or(0);
    let list = Netlist { nodes: Vec::new(), nets: Vec::new() };
    let mut reader = Reader { program, delays, once, reads: Vec::new(), list };
    for (i, section) in program.sections.iter().enumerate() {
        for block in section.first..section.end {
            reader.node(i, BlockId(block));
        }
    }
    reader.reads.sort_by_key(|read| read.from);
    let reads = std::mem::take(&mut reader.reads);
    for block in 0..reader.list.nodes.len() {
        reader.outputs(block, &reads);
    }
    for node in &mut reader.list.nodes {
        number_rows(node);
    }
    reader.list
}

impl Netlist {
    /// A pin.
    pub(crate) fn pin(&self, at: PinAt) -> &Pin {
        &self.nodes[at.node].pins[at.pin]
    }

    /// Whether a net's output or any reader of it goes by name.
    pub(crate) fn has_flags(&self, net: usize) -> bool {
        self.nets[net].sinks.iter().any(|sink| self.pin(*sink).flag)
    }

    /// The readers that a net reaches by wire.
    pub(crate) fn wired(&self, net: usize) -> impl Iterator<Item = PinAt> {
        self.nets[net].sinks.iter().copied().filter(|sink| !self.pin(*sink).flag)
    }
}

impl Node {
    /// How many rows of pins it has.
    pub(crate) fn rows(&self) -> usize {
        self.pins.iter().map(|pin| pin.row + 1).max().unwrap_or(0)
    }
}

struct Reader<'p> {
    program: &'p Program,
    /// Reader and signal of all reads of the previous scan's value.
    delays: BTreeSet<(BlockId, u32)>,
    /// One past the last block that runs once.
    once: usize,
    reads: Vec<Read>,
    list: Netlist,
}

/// A pin that reads an output of a block.
struct Read {
    /// Block and output (groups expanded).
    from: (usize, usize),
    at: PinAt,
}

impl Reader<'_> {
    /// A block with the pins that read.
    fn node(&mut self, section: usize, id: BlockId) {
        let program = self.program;
        let block = program.main().block(id);
        let decl = program.decl(block.decl);
        let index = self.list.nodes.len();
        self.list.nodes.push(Node {
            section,
            number: block.number,
            tag: block.name.clone(),
            code: decl.name.clone(),
            note: text::note(decl, block),
            tip: text::tip(decl, block),
            composite: decl.is_composite(),
            pins: Vec::new(),
        });
        if let Some(word) = word(program, block, Direction::In) {
            self.pin(index, Side::Left, String::new(), Note::Word(word.name.clone()));
        }
        let labels = text::ports(decl, block);
        for (port, source) in block.ports.iter().enumerate() {
            let Some(label) = labels.get(port) else {
                continue;
            };
            self.port(index, label, source);
        }
        self.shorten(index);
        for (output, signal) in block.outputs.iter().enumerate() {
            let declared = output_decl(decl, &block.sizes, output).map(|declared| &decl.outputs[declared]);
            if let Some(declared) = declared.filter(|declared| declared.inout) {
                self.changed(index, *signal, &declared.name);
            }
        }
    }

    /// Many open ports in a row at the end of a list are left out: they say nothing.
    fn shorten(&mut self, block: usize) {
        let pins = &mut self.list.nodes[block].pins;
        let is_open = |pin: &&Pin| matches!(pin.note, Note::Constant(_));
        let open = pins.iter().rev().take_while(is_open).count();
        if open > OPEN {
            pins.truncate(pins.len() - open);
        }
    }

    fn pin(&mut self, block: usize, side: Side, label: String, note: Note) -> PinAt {
        let pins = &mut self.list.nodes[block].pins;
        pins.push(Pin {
            side,
            row: 0,
            label,
            note,
            net: None,
            delayed: false,
            back: false,
            flag: false,
            element: String::new(),
        });
        PinAt { node: block, pin: pins.len() - 1 }
    }

    fn port(&mut self, block: usize, label: &text::Port<'_>, source: &Source) {
        let unit = self.program.main();
        let (signal, element) = match source {
            Source::Signal(signal) | Source::Copied(signal) => (*signal, String::new()),
            Source::Element(signal, element) => (*signal, self.element(*signal, *element)),
            Source::Constant(value) => {
                // An open return port means "following": nothing to look at.
                if label.name != RETURN_PORT {
                    let constant = Note::Constant(text::value(value, label.names));
                    let note = if text::is_bad(value) { Note::Nothing } else { constant };
                    self.pin(block, Side::Left, label.name.clone(), note);
                }
                return;
            }
            // Own parameters stand on wires inside nets only, which are drawn as nets.
            Source::Own(..) => return,
            Source::Cell(cell) => {
                let initial = text::value(&unit.cells[cell.0 as usize].initial, label.names);
                self.pin(block, Side::Left, label.name.clone(), Note::Cell(initial));
                return;
            }
        };
        let delayed = self.delays.contains(&(BlockId(block as u32), signal.0));
        match self.writer(signal, block, delayed) {
            Some(from) => self.read(block, &label.name, from, delayed, element),
            None => {
                self.pin(block, Side::Left, label.name.clone(), Note::Word(unit.signal(signal).name.clone()));
            }
        }
    }

    /// `[3]`, or the name of an element that has one.
    fn element(&self, signal: SignalId, element: u32) -> String {
        let unit = self.program.main();
        let signal = unit.signal(signal);
        let name = signal.writers.first().and_then(|writer| {
            let block = unit.block(writer.block);
            let decl = self.program.decl(block.decl);
            let output = output_decl(decl, &block.sizes, writer.output as usize)?;
            decl.outputs[output].elements.get(element as usize).cloned()
        });
        name.unwrap_or_else(|| text::suffix(signal.ty, element))
    }

    /// A signal that a block changes in place comes in too, from whoever wrote it last.
    fn changed(&mut self, block: usize, signal: SignalId, label: &str) {
        let before = self.writer(signal, block, false);
        let found = before.or_else(|| self.writer(signal, block, true));
        if let Some(from) = found.filter(|(writer, _)| *writer != block) {
            self.read(block, label, from, before.is_none(), String::new());
        }
    }

    fn read(&mut self, block: usize, label: &str, from: (usize, usize), delayed: bool, element: String) {
        let side = if self.is_return(from) { Side::Right } else { Side::Left };
        let at = self.pin(block, side, label.to_owned(), Note::Nothing);
        let pin = &mut self.list.nodes[at.node].pins[at.pin];
        pin.delayed = delayed;
        pin.element = element;
        self.reads.push(Read { from, at });
    }

    /// Who wrote the value that a block reads: the last writer before it, for the previous scan's value the last one.
    fn writer(&self, signal: SignalId, reader: usize, delayed: bool) -> Option<(usize, usize)> {
        let writers = self.program.main().signal(signal).writers.iter();
        let writers = writers.map(|writer| (writer.block.0 as usize, writer.output as usize));
        if delayed {
            return writers.clone().filter(|(block, _)| *block >= self.once).max().or_else(|| writers.max());
        }
        writers.filter(|(block, _)| *block < reader).max()
    }

    fn is_return(&self, (block, output): (usize, usize)) -> bool {
        let block = &self.program.main().blocks[block];
        let decl = self.program.decl(block.decl);
        output_decl(decl, &block.sizes, output).is_some_and(|declared| decl.outputs[declared].name == RETURN_OUTPUT)
    }

    /// A block's outputs, with the nets of those that are read.
    fn outputs(&mut self, index: usize, reads: &[Read]) {
        let program = self.program;
        let block = &program.main().blocks[index];
        let labels = text::outputs(program, block);
        for (output, label) in labels.into_iter().enumerate() {
            let start = reads.partition_point(|read| read.from < (index, output));
            let end = reads.partition_point(|read| read.from <= (index, output));
            let is_return = self.is_return((index, output));
            if is_return && start == end {
                continue;
            }
            let source = self.pin(index, if is_return { Side::Left } else { Side::Right }, label, Note::Nothing);
            if start < end {
                let signal = program.main().signal(block.outputs[output]);
                let sinks = reads[start..end].iter().map(|read| read.at).collect();
                self.net(Net { name: signal.name.clone(), ty: signal.ty, source, sinks, is_return });
            }
        }
        if let Some(word) = word(program, block, Direction::Out) {
            self.pin(index, Side::Right, String::new(), Note::Word(word.name.clone()));
        }
    }

    fn net(&mut self, net: Net) {
        for at in net.sinks.iter().chain([&net.source]) {
            let pin = &mut self.list.nodes[at.node].pins[at.pin];
            pin.net = Some(self.list.nets.len());
            pin.back = net.is_return;
        }
        self.list.nets.push(net);
    }
}

fn word<'p>(program: &'p Program, block: &Block, direction: Direction) -> Option<&'p ImageWord> {
    block.image.map(|id| &program.images[id.0 as usize]).filter(|word| word.direction == direction)
}

/// Pins stand in their order, those of return wires below the others: outputs among inputs, inputs among outputs.
fn number_rows(node: &mut Node) {
    for side in [Side::Left, Side::Right] {
        let mut row = 0;
        for last in [false, true] {
            for pin in node.pins.iter_mut().filter(|pin| pin.side == side && pin.back == last) {
                pin.row = row;
                row += 1;
            }
        }
    }
}
