//! The embedded engine: a program over one block of storage, its kernels called through tables of pointers.

mod net;
mod place;
mod set;
mod wire;

pub use set::{Refusal, cell_refusal, judge};

use crate::ffi::{Bound, NoRoom, Tape};
use crate::health::Health;
use crate::names::{Element, Names};
use crate::number::Number;
use pcl2_lang::model::{Place, Point};
use pcl2_lang::program::{BlockId, DeclId, Program, SectionKind, UnitId};
use pcl2_lang::types::{Real, Scalar, Value, Width};
use pcl2_lang::verify::Verified;
use place::{Body, Fill, NOWHERE, Node, Store};
use std::fmt;
use std::ops::Range;
use wire::{Ranges, Shared};

/// Why the embedded engine does not take a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unsupported {
    /// A function code's C is not in this binary: it is the user's own.
    OwnC(String),
    /// A function code depends on the period, and none is given.
    NeedsPeriod(String),
    /// Composites are nested too deep.
    TooDeep,
    /// Too many instances or bytes.
    TooLarge,
}

impl fmt::Display for Unsupported {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Unsupported::OwnC(code) => {
                write!(f, "`{code}` is C of the project's own: this program runs through the C compiler (--engine cc)")
            }
            Unsupported::NeedsPeriod(code) => write!(f, "`{code}` needs a period (--period)"),
            Unsupported::TooDeep => write!(f, "composites are nested too deep"),
            Unsupported::TooLarge => write!(f, "the program is too large for the embedded engine (--engine cc)"),
        }
    }
}

impl std::error::Error for Unsupported {}

/// A program that runs.
#[derive(Debug)]
pub struct Machine<'a> {
    program: &'a Program,
    bound: Bound,
    body: Body,
    shared: Shared,
    cells: Vec<usize>,
    images: Vec<usize>,
    ranges: Vec<Ranges>,
    checks: Vec<DeclId>,
    loops: Vec<Loop>,
    scan: u64,
    health: Health,
}

/// What runs in a scan.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Loop {
    steps: Range<usize>,
    /// How many times.
    repeat: u32,
    /// Every so many scans.
    every: u32,
    /// So many scans to go.
    countdown: u32,
}

/// A place that can be read again and again.
#[derive(Clone, Copy, Debug)]
pub struct Probe {
    at: usize,
    kind: Kind,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    Int,
    Time,
    Double,
    Single,
}

impl<'a> Machine<'a> {
    /// Lays out a program and starts it: everything up to the first scan.
    pub fn new(program: &'a Verified) -> Result<Machine<'a>, Unsupported> {
        let program = program.program();
        let mut store = Store::new(program)?;
        let mut body = store.body(UnitId(0), &[], &[], 0)?;
        let wired = wire::wire(&mut store, &mut body)?;
        let bound = Bound::new(&wired.plan, program.width).map_err(|reason| match reason {
            NoRoom::Memory | NoRoom::Outside => Unsupported::TooLarge,
        })?;
        let wire::Wired { shared, cells, images, ranges, checks, .. } = wired;
        let loops = loops(program, &ranges);
        let health = Health::default();
        let mut machine =
            Machine { program, bound, body, shared, cells, images, ranges, checks, loops, scan: 0, health };
        for (at, first) in &store.fills {
            fill(&machine.bound, program.width, *at, *first);
        }
        machine.start();
        Ok(machine)
    }

    fn start(&mut self) {
        for tape in [Tape::Convert, Tape::Tune, Tape::Init, Tape::Publish] {
            self.run_tape(tape, 0..self.bound.len(tape));
        }
        for section in &self.program.sections {
            if section.kind == SectionKind::Initialize {
                self.run_tape(Tape::Step, steps(&self.ranges, section.first, section.end));
            }
        }
    }

    fn run_tape(&mut self, tape: Tape, range: Range<usize>) {
        self.bound.run(tape, range, self.scan as u32, &mut self.health);
    }

    /// Runs so many scans.
    pub fn run(&mut self, scans: u64) {
        for _ in 0..scans {
            let scan = self.scan as u32;
            for run in &mut self.loops {
                if run.countdown == 0 {
                    run.countdown = run.every;
                    for _ in 0..run.repeat {
                        self.bound.run(Tape::Step, run.steps.clone(), scan, &mut self.health);
                    }
                }
                run.countdown -= 1;
            }
            self.scan += 1;
        }
    }

    /// The number of scans that have run.
    pub fn scan(&self) -> u64 {
        self.scan
    }

    /// What went wrong so far.
    pub fn health(&self) -> Health {
        self.health
    }

    /// The place of an element.
    pub fn probe(&self, names: &Names, element: Element) -> Probe {
        let point = names.point(element);
        let kind = match (point.time, point.ty.scalar, self.program.width) {
            (true, ..) => Kind::Time,
            (false, Scalar::Int, _) => Kind::Int,
            (false, Scalar::Real, Width::F64) => Kind::Double,
            (false, Scalar::Real, Width::F32) => Kind::Single,
        };
        let bytes = match kind {
            Kind::Int | Kind::Single => 4,
            Kind::Time | Kind::Double => 8,
        };
        Probe { at: self.locate(point).saturating_add(element.element as usize * bytes), kind }
    }

    /// What stands at a place now.
    pub fn read(&self, probe: Probe) -> Number {
        match probe.kind {
            Kind::Int => Number::Int(i32::from_ne_bytes(self.bound.read4(probe.at))),
            Kind::Single => Number::Single(f32::from_ne_bytes(self.bound.read4(probe.at))),
            Kind::Time => Number::Time(i64::from_ne_bytes(self.bound.read8(probe.at))),
            Kind::Double => Number::Double(f64::from_ne_bytes(self.bound.read8(probe.at))),
        }
    }

    fn write(&self, probe: Probe, value: Number) {
        write(&self.bound, probe, value);
    }

    fn locate(&self, point: &Point) -> usize {
        match point.place {
            Place::Signal(id) => self.body.signals[id.0 as usize],
            Place::Cell(id) => self.cells[id.0 as usize],
            Place::Image(id) => self.images[id.0 as usize],
            Place::Param(block, param) => self.body.nodes[block.0 as usize].params[param as usize],
            Place::Inside(id) => {
                let body = self.inside(&point.path).and_then(|node| node.inner.as_ref());
                body.and_then(|body| body.signals.get(id.0 as usize).copied()).unwrap_or(NOWHERE)
            }
            Place::Memory(field) => {
                let node = self.inside(&point.path);
                node.and_then(|node| node.memory.get(field as usize).copied()).unwrap_or(NOWHERE)
            }
        }
    }

    /// The instance at the end of a path.
    fn inside(&self, path: &[BlockId]) -> Option<&Node> {
        let (first, rest) = path.split_first()?;
        let first = self.body.nodes.get(first.0 as usize)?;
        rest.iter().try_fold(first, |node, block| node.inner.as_ref()?.nodes.get(block.0 as usize))
    }
}

fn real_kind(width: Width) -> Kind {
    match width {
        Width::F64 => Kind::Double,
        Width::F32 => Kind::Single,
    }
}

/// Writes a number where a number of this kind stands.
fn write(bound: &Bound, probe: Probe, value: Number) {
    match (probe.kind, value) {
        (Kind::Int, Number::Int(value)) => bound.write4(probe.at, value.to_ne_bytes()),
        (Kind::Time, Number::Time(value)) => bound.write8(probe.at, value.to_ne_bytes()),
        (Kind::Double, value) => bound.write8(probe.at, value.to_real().wide.to_ne_bytes()),
        (Kind::Single, value) => bound.write4(probe.at, value.to_real().narrow.to_ne_bytes()),
        (Kind::Int | Kind::Time, _) => {}
    }
}

/// Writes what stands in the storage before the first scan.
fn fill(bound: &Bound, width: Width, at: usize, fill: Fill<'_>) {
    match fill {
        Fill::Int(value) => bound.write4(at, value.to_ne_bytes()),
        Fill::Time(value) => bound.write8(at, value.to_ne_bytes()),
        Fill::Real(value) => write(bound, Probe { at, kind: real_kind(width) }, Number::of_real(value, width)),
        Fill::Text(text) => {
            let bytes: Vec<u8> = text.bytes().chain([0]).collect();
            for (i, chunk) in bytes.chunks(8).enumerate() {
                let mut word = [0; 8];
                word[..chunk.len()].copy_from_slice(chunk);
                bound.write8(at + i * 8, word);
            }
        }
        Fill::Value(scalar, elements, value) => {
            let (kind, bytes) = match scalar {
                Scalar::Int => (Kind::Int, 4),
                Scalar::Real => (real_kind(width), width.bytes()),
            };
            for i in 0..elements {
                write(bound, Probe { at: at + i * bytes, kind }, element(value, i, width));
            }
        }
    }
}

/// One element of a value; a single value stands for each.
fn element(value: &Value, i: usize, width: Width) -> Number {
    match value {
        Value::Int(value) => Number::Int(*value),
        Value::Real(real) => Number::of_real(*real, width),
        Value::Ints(values) => Number::Int(values.get(i).copied().unwrap_or(0)),
        Value::Reals(values) => Number::of_real(values.get(i).copied().unwrap_or(Real::ZERO), width),
        Value::Text(_) => Number::Int(0),
    }
}

fn steps(ranges: &[Ranges], first: u32, end: u32) -> Range<usize> {
    match ranges.get(first as usize..end as usize) {
        Some([first, .., last]) => first.step.start..last.step.end,
        Some([only]) => only.step.clone(),
        _ => 0..0,
    }
}

/// The sections that run in scans. Neighbours that run in every scan become one.
fn loops(program: &Program, ranges: &[Ranges]) -> Vec<Loop> {
    let mut loops: Vec<Loop> = Vec::new();
    for section in &program.sections {
        let (repeat, every, countdown) = match section.kind {
            SectionKind::Initialize => continue,
            SectionKind::Plant => (program.substeps, 1, 0),
            SectionKind::Control { every, offset } => (1, every, offset),
        };
        let steps = steps(ranges, section.first, section.end);
        match loops.last_mut() {
            Some(last)
                if last.repeat == 1
                    && last.every == 1
                    && (repeat, every) == (1, 1)
                    && last.steps.end == steps.start =>
            {
                last.steps.end = steps.end;
            }
            _ => loops.push(Loop { steps, repeat, every, countdown }),
        }
    }
    loops.retain(|run| !run.steps.is_empty());
    loops
}
