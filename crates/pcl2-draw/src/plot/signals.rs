//! What is known of a signal before it has a value: what to show it with.

use pcl2_lang::model::{Place, Point};
use pcl2_lang::program::{Block, Program, SignalId, Source};
use pcl2_lang::types::Scalar;

/// The letters that declarations give a set point, a measured value and what a controller does about them.
const LETTERS: [&str; 3] = ["w", "y", "u"];

/// A signal to be drawn.
#[derive(Clone, Debug)]
pub struct Signal {
    /// Its name.
    pub label: String,
    /// The vector or matrix that it is an element of.
    pub family: Option<String>,
    /// An int: values between two samples do not exist.
    pub whole: bool,
    /// The declared unit.
    pub unit: Option<String>,
    /// The names of an enumeration's values.
    pub names: Vec<String>,
    /// What it is to a controller.
    pub role: Role,
    /// The tokens of a box of a net.
    pub tokens: bool,
}

/// What a signal is to a controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Nothing.
    None,
    /// The set point of the loops with this number.
    SetPoint(usize),
    /// The measured value of the loops with this number.
    Measured(usize),
    /// What the controller puts out.
    Output,
}

/// The signals of these points, by name, with their roles. Loops that share a set point have one number.
pub fn signals<'p>(program: &Program, points: impl IntoIterator<Item = (&'p Point, String)>) -> Vec<Signal> {
    let loops = loops(program);
    let signal = |(point, label): (&Point, String)| {
        let role = match point.place {
            Place::Signal(id) => role(&loops, &Source::Signal(id)),
            Place::Cell(id) => role(&loops, &Source::Cell(id)),
            Place::Param(..) | Place::Image(_) | Place::Inside(_) | Place::Memory(_) => Role::None,
        };
        let whole = point.ty.scalar == Scalar::Int && !point.time;
        let family = (!point.ty.is_scalar()).then(|| point.name.clone());
        let tokens = !point.elements.is_empty();
        Signal { label, family, whole, unit: point.unit.clone(), names: point.names.clone(), role, tokens }
    };
    points.into_iter().map(signal).collect()
}

/// A controller's signals.
struct Loop {
    number: usize,
    /// A signal, or the operator's cell.
    set_point: Source,
    measured: SignalId,
    output: Option<SignalId>,
}

fn loops(program: &Program) -> Vec<Loop> {
    let mut loops: Vec<Loop> = Vec::new();
    for block in &program.main().blocks {
        let [Some(set_point), Some(Source::Signal(measured))] =
            [LETTERS[0], LETTERS[1]].map(|letter| port(program, block, letter))
        else {
            continue;
        };
        let decl = program.decl(block.decl);
        let output = decl.outputs.iter().position(|output| output.name == LETTERS[2]);
        let output = output.and_then(|output| block.outputs.get(output)).copied();
        let known = |other: &&Loop| other.set_point == set_point || other.measured == measured;
        let number = loops.iter().find(known).map_or(loops.len(), |other| other.number);
        loops.push(Loop { number, set_point, measured, output });
    }
    loops
}

/// The scalar signal or the cell at a port of this name.
fn port(program: &Program, block: &Block, name: &str) -> Option<Source> {
    let decl = program.decl(block.decl);
    if decl.ports().any(|port| port.group.is_some()) {
        return None;
    }
    let index = decl.ports().position(|port| port.name == name)?;
    let source = block.ports.get(index)?;
    let drawn = match source {
        Source::Signal(signal) => program.main().signal(*signal).ty.is_scalar(),
        Source::Cell(cell) => program.main().cells[cell.0 as usize].ty.is_scalar(),
        Source::Copied(_) | Source::Element(..) | Source::Constant(_) | Source::Own(..) => false,
    };
    drawn.then(|| source.clone())
}

fn role(loops: &[Loop], source: &Source) -> Role {
    let is = |signal: SignalId| *source == Source::Signal(signal);
    if let Some(own) = loops.iter().find(|own| is(own.measured)) {
        return Role::Measured(own.number);
    }
    if let Some(own) = loops.iter().find(|own| own.set_point == *source) {
        return Role::SetPoint(own.number);
    }
    if loops.iter().any(|own| own.output.is_some_and(is)) { Role::Output } else { Role::None }
}
