//! The one intermediate form: what a checked source means.
//!
//! Front ends build a [`Program`], the verifier seals it as [`crate::verify::Verified`], back ends read that.
//! All references are typed indexes into the vectors of the same [`Unit`].

use crate::decl::{Decl, Direction};
use crate::source::Span;
use crate::types::{Real, Scalar, Type, Value, Width};

/// An index into [`Program::decls`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct DeclId(pub u32);
/// An index into [`Program::units`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct UnitId(pub u32);
/// An index into [`Unit::signals`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SignalId(pub u32);
/// An index into [`Unit::blocks`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct BlockId(pub u32);
/// An index into [`Unit::cells`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct CellId(pub u32);
/// An index into [`Program::images`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ImageId(pub u32);

/// A whole controller, with its simulated plant if it has one.
#[derive(Clone, Debug)]
pub struct Program {
    /// The C name of the program: legal and unreserved.
    pub name: String,
    /// The scan period in nanoseconds, where it is known.
    pub period: Option<i64>,
    /// The width of reals.
    pub width: Width,
    /// The declarations in use.
    pub decls: Vec<Decl>,
    /// The bodies: first the program itself, then every composite with its sizes, each before those it uses.
    pub units: Vec<Unit>,
    /// The sections of the program's own unit, in file order of their kind: INITIALIZE, PLANT, CONTROL..
    pub sections: Vec<Section>,
    /// The words of the process image, inputs and outputs, in order of first use.
    pub images: Vec<ImageWord>,
    /// PLANT runs this many times in each scan, with its period divided.
    pub substeps: u32,
    /// Reads of the previous scan's value in the program's own unit, in order of the reader.
    pub delays: Vec<Delay>,
    /// Named inputs and outputs and image words bound to physical points.
    pub bindings: Vec<Binding>,
}

/// A physical point bound to a word of the program.
#[derive(Clone, Debug, PartialEq)]
pub struct Binding {
    /// The signal or image word.
    pub name: String,
    /// The physical point.
    pub point: String,
    /// word = gain raw + bias.
    pub gain: Real,
    /// See `gain`.
    pub bias: Real,
    /// A bad sample is held instead of handed on.
    pub hold: bool,
    /// To the plant: what stands in for a bad value.
    pub fail: Option<Real>,
}

/// A block reads a signal that is written later in the scan: it gets the previous scan's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Delay {
    /// The block that reads.
    pub reader: BlockId,
    /// What it reads.
    pub signal: SignalId,
    /// Reader and writer share no loop: another number would avoid the delay.
    pub avoidable: bool,
}

/// A run of blocks over signals of its own: the program, or a composite with its sizes fixed.
#[derive(Clone, Debug, Default)]
pub struct Unit {
    /// The composite's declaration and size values; `None` for the program itself.
    pub composite: Option<(DeclId, Vec<i32>)>,
    /// The signals, in order of their first writer.
    pub signals: Vec<Signal>,
    /// The blocks in order of execution, section by section.
    pub blocks: Vec<Block>,
    /// The operator cells. (Inside a composite: none; its unconnected cells are their defaults.)
    pub cells: Vec<Cell>,
    /// For a composite: the signal behind each of its outputs, in order.
    pub outputs: Vec<SignalId>,
}

/// When a section's blocks run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SectionKind {
    /// Once, before the first scan.
    Initialize,
    /// The simulated process: every scan, before CONTROL.
    Plant,
    /// Every `every`-th scan, first at scan `offset`.
    Control {
        /// The section's period in scans, at least 1.
        every: u32,
        /// 0 to `every` - 1.
        offset: u32,
    },
}

/// A section: a range of blocks with one rate.
#[derive(Clone, Debug)]
pub struct Section {
    /// When it runs.
    pub kind: SectionKind,
    /// Its first block.
    pub first: u32,
    /// One past its last block.
    pub end: u32,
    /// Where its word stands.
    pub span: Span,
}

/// A signal: what stands on a wire.
#[derive(Clone, Debug)]
pub struct Signal {
    /// `y1`, `m`, `FIC.bk`, `3`; empty for an output that nobody can reach.
    pub name: String,
    /// Its type, the same everywhere.
    pub ty: Type,
    /// The blocks that write it, in order of execution. None: an input at the border, or a composite's own port.
    pub writers: Vec<Writer>,
    /// What the outside world sees of it.
    pub role: Role,
    /// Where the name stands first as an output.
    pub span: Span,
}

/// One block's hand on a signal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Writer {
    /// The block.
    pub block: BlockId,
    /// Which of its outputs (groups expanded).
    pub output: u32,
    /// Changed in place (`ftov`), not written whole.
    pub inout: bool,
}

/// What the outside world sees of a signal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Nothing: an internal wire.
    Wire,
    /// The border hands it in: `self->in.NAME`.
    Input,
    /// The border takes it out: `self->out.NAME`, copied after each step.
    Output,
    /// Inside a composite: its own input port with this index (groups expanded).
    Port(u32),
    /// Inside a net: a word with a place of its own, whoever writes it.
    Held,
}

/// One block: a call of a function code.
#[derive(Clone, Debug)]
pub struct Block {
    /// The number that gives its place; shown to the user.
    pub number: u32,
    /// The identity: the name of the first output, or the number; `b#2` among equals.
    pub name: String,
    /// Its function code.
    pub decl: DeclId,
    /// For a composite: its body.
    pub unit: Option<UnitId>,
    /// The values of [`Decl::sizes`].
    pub sizes: Vec<i32>,
    /// What is wired to each port, groups expanded, in order.
    pub ports: Vec<Source>,
    /// The value of each parameter, in order.
    pub params: Vec<Param>,
    /// The signal behind each output, groups expanded, in order.
    pub outputs: Vec<SignalId>,
    /// The image word, for codes with one.
    pub image: Option<ImageId>,
    /// Whether its parameters that are not fixed stay in RAM.
    pub tunable: bool,
    /// The statement, from the number to the closing parenthesis.
    pub span: Span,
}

/// What is wired to a port.
#[derive(Clone, Debug, PartialEq)]
pub enum Source {
    /// A whole signal.
    Signal(SignalId),
    /// A whole vector or matrix that one of the block's outputs also is: it must be copied before the call.
    Copied(SignalId),
    /// One element, counted from 0, row-major.
    Element(SignalId, u32),
    /// The port's default.
    Constant(Value),
    /// An operator cell.
    Cell(CellId),
    /// In a net's body: the net's own scalar parameter with this index.
    Own(u32, Scalar),
}

/// The value of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum Param {
    /// Written in the source, read from a file, or the default.
    Value(Value),
    /// In a composite's body: the composite's own parameter with this index.
    Own(u32),
}

/// An unconnected port that the operator writes.
#[derive(Clone, Debug)]
pub struct Cell {
    /// The block it belongs to.
    pub block: BlockId,
    /// Which port (groups expanded).
    pub port: u32,
    /// `TAG.port`.
    pub name: String,
    /// Its type.
    pub ty: Type,
    /// Its first value.
    pub initial: Value,
    /// What the block writes back after each scan.
    pub tracks: Option<Tracked>,
}

/// What an operator cell follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tracked {
    /// An output of the block (index, groups expanded).
    Output(u32),
    /// A memory field of the block.
    Memory(u32),
}

/// A word of the process image.
#[derive(Clone, Debug, PartialEq)]
pub struct ImageWord {
    /// As written in stimulus and trace: `ain(0,1,1)`.
    pub name: String,
    /// From or to the plant.
    pub direction: Direction,
    /// Its type.
    pub scalar: Scalar,
    /// The address parameters.
    pub address: Vec<i32>,
    /// To the plant: what stands in for a bad value; without it the last good one is held.
    pub fail: Option<Real>,
}

impl Program {
    /// The program's own unit.
    pub fn main(&self) -> &Unit {
        &self.units[0]
    }

    /// A declaration.
    pub fn decl(&self, id: DeclId) -> &Decl {
        &self.decls[id.0 as usize]
    }

    /// A body.
    pub fn unit(&self, id: UnitId) -> &Unit {
        &self.units[id.0 as usize]
    }
}

impl Source {
    /// The signal that is read, whole or an element of it.
    pub fn signal(&self) -> Option<SignalId> {
        match self {
            Source::Signal(id) | Source::Copied(id) | Source::Element(id, _) => Some(*id),
            Source::Constant(_) | Source::Cell(_) | Source::Own(..) => None,
        }
    }
}

impl Unit {
    /// A signal.
    pub fn signal(&self, id: SignalId) -> &Signal {
        &self.signals[id.0 as usize]
    }

    /// A block.
    pub fn block(&self, id: BlockId) -> &Block {
        &self.blocks[id.0 as usize]
    }
}

impl Section {
    /// The period of the section's blocks in nanoseconds, given the scan period.
    pub fn period(&self, scan: i64, substeps: u32) -> i64 {
        match self.kind {
            SectionKind::Initialize => scan,
            SectionKind::Plant => scan / i64::from(substeps.max(1)),
            SectionKind::Control { every, .. } => scan.saturating_mul(i64::from(every)),
        }
    }
}
