//! The points of a program that have a name outside: what maps, monitors, stimulus and saved states speak of.

use crate::decl::Direction;
use crate::kernel;
use crate::program::{BlockId, CellId, ImageId, Param, Program, Role, SignalId, UnitId};
use crate::types::{Scalar, Type, Value};
use rustc_hash::FxHashMap;

/// Who writes a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    /// A wire: blocks write it.
    Signal,
    /// A named input of the controller.
    Input,
    /// A word of the process image.
    Image,
    /// A parameter that stays in RAM.
    Tunable,
    /// An operator cell.
    Operator,
    /// Memory of a block.
    State,
}

/// What a point is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// A signal of the program's own unit.
    Signal(SignalId),
    /// A parameter of a block of the program's own unit.
    Param(BlockId, u32),
    /// An operator cell.
    Cell(CellId),
    /// A word of the process image.
    Image(ImageId),
    /// A memory field of a block; the path leads through composites from the outside in ([`Point::path`]).
    Memory(u32),
}

/// One named point.
#[derive(Clone, Debug)]
pub struct Point {
    /// `y1`, `w.value`, `ain(0,1,1)`, `T1.f.P`.
    pub name: String,
    /// What it is.
    pub place: Place,
    /// For memory: the blocks from the program's own unit inwards; else empty.
    pub path: Vec<BlockId>,
    /// Its type; times count as one int64.
    pub ty: Type,
    /// Nanoseconds in an `int64_t`.
    pub time: bool,
    /// Who writes it.
    pub access: Access,
    /// The declared unit.
    pub unit: Option<String>,
    /// The names of an enumeration's values.
    pub names: Vec<String>,
}

/// All points of a program, in a fixed order: signals, image, parameters, cells, memory.
pub fn points(program: &Program) -> Vec<Point> {
    let mut points = Vec::new();
    signals(program, &mut points);
    images(program, &mut points);
    parameters(program, &mut points);
    cells(program, &mut points);
    memory(program, UnitId(0), &mut Vec::new(), "", &mut points);
    points
}

/// Finds points by name: by their own, a block's number (`4.value`), or a written variable
/// (`w.value`) when exactly one of its writers has that parameter.
pub struct Index {
    by_name: FxHashMap<String, Option<usize>>,
}

impl Index {
    /// Builds the index over [`points`].
    pub fn new(program: &Program, points: &[Point]) -> Index {
        let mut by_name = FxHashMap::default();
        for (i, point) in points.iter().enumerate() {
            by_name.insert(point.name.clone(), Some(i));
        }
        let mut aliases: FxHashMap<String, Option<usize>> = FxHashMap::default();
        for (i, point) in points.iter().enumerate() {
            for alias in aliases_of(program, point) {
                let ambiguous = aliases.get(&alias).is_some_and(|known| *known != Some(i));
                aliases.insert(alias, (!ambiguous).then_some(i));
            }
        }
        let mut names: Vec<(String, Option<usize>)> = aliases.into_iter().collect();
        names.sort();
        for (alias, point) in names {
            by_name.entry(alias).or_insert(point);
        }
        Index { by_name }
    }

    /// The point with this name; `None` if there is none, `Some(None)` if several would fit.
    pub fn find(&self, name: &str) -> Option<Option<usize>> {
        self.by_name.get(name).copied()
    }
}

fn aliases_of(program: &Program, point: &Point) -> Vec<String> {
    let Place::Param(block, param) = point.place else {
        return Vec::new();
    };
    let unit = program.main();
    let block = unit.block(block);
    let param = &program.decl(block.decl).params[param as usize].name;
    let mut aliases = vec![format!("{}.{param}", block.number)];
    let signals = block.outputs.iter().map(|id| unit.signal(*id)).filter(|signal| !signal.name.is_empty());
    aliases.extend(signals.map(|signal| format!("{}.{param}", signal.name)));
    aliases
}

fn signals(program: &Program, points: &mut Vec<Point>) {
    for (i, signal) in program.main().signals.iter().enumerate() {
        if signal.name.is_empty() {
            continue;
        }
        let access = if signal.role == Role::Input { Access::Input } else { Access::Signal };
        let tail = signal.writers.first().and_then(|writer| {
            let block = program.main().block(writer.block);
            let decl = program.decl(block.decl);
            let index = output_decl(decl, &block.sizes, writer.output as usize)?;
            Some(decl.outputs[index].tail.clone())
        });
        let tail = tail.unwrap_or_default();
        points.push(Point {
            name: signal.name.clone(),
            place: Place::Signal(SignalId(i as u32)),
            path: Vec::new(),
            ty: signal.ty,
            time: false,
            access,
            unit: tail.unit,
            names: tail.names,
        });
    }
}

/// Which declared output an expanded output index belongs to.
pub fn output_decl(decl: &crate::decl::Decl, sizes: &[i32], expanded: usize) -> Option<usize> {
    let mut first = 0;
    for (i, output) in decl.outputs.iter().enumerate() {
        first += kernel::count(output.group.as_ref(), sizes)?;
        if expanded < first {
            return Some(i);
        }
    }
    None
}

fn images(program: &Program, points: &mut Vec<Point>) {
    for (i, image) in program.images.iter().enumerate() {
        let ty = if image.scalar == Scalar::Int { Type::INT } else { Type::REAL };
        points.push(Point {
            name: image.name.clone(),
            place: Place::Image(ImageId(i as u32)),
            path: Vec::new(),
            ty,
            time: false,
            access: if image.direction == Direction::In { Access::Image } else { Access::Signal },
            unit: None,
            names: Vec::new(),
        });
    }
}

fn parameters(program: &Program, points: &mut Vec<Point>) {
    for (b, block) in program.main().blocks.iter().enumerate().filter(|(_, block)| block.tunable) {
        let decl = program.decl(block.decl);
        for (p, param) in decl.params.iter().enumerate().filter(|(_, param)| !param.fixed) {
            let Some(ty) = kernel::resolve(&param.ty, &block.sizes) else {
                continue;
            };
            points.push(Point {
                name: format!("{}.{}", block.name, param.name),
                place: Place::Param(BlockId(b as u32), p as u32),
                path: Vec::new(),
                ty,
                time: false,
                access: Access::Tunable,
                unit: param.tail.unit.clone(),
                names: param.tail.names.clone(),
            });
        }
    }
}

fn cells(program: &Program, points: &mut Vec<Point>) {
    for (i, cell) in program.main().cells.iter().enumerate() {
        let block = program.main().block(cell.block);
        let tail = program.decl(block.decl).ports().nth(cell.port as usize).map(|port| port.tail.clone());
        let tail = tail.unwrap_or_default();
        points.push(Point {
            name: cell.name.clone(),
            place: Place::Cell(CellId(i as u32)),
            path: Vec::new(),
            ty: cell.ty,
            time: false,
            access: Access::Operator,
            unit: tail.unit,
            names: tail.names,
        });
    }
}

fn memory(program: &Program, unit: UnitId, path: &mut Vec<BlockId>, prefix: &str, points: &mut Vec<Point>) {
    for (b, block) in program.unit(unit).blocks.iter().enumerate() {
        let name = format!("{prefix}{}", block.name);
        path.push(BlockId(b as u32));
        if let Some(inner) = block.unit {
            memory(program, inner, path, &format!("{name}."), points);
        } else {
            let decl = program.decl(block.decl);
            for (f, field) in decl.memory.iter().enumerate() {
                let time = matches!(field.ty, crate::decl::TypeExpr::Time);
                let ty = if time { Some(Type::INT) } else { kernel::resolve(&field.ty, &block.sizes) };
                let Some(ty) = ty.filter(|ty| ty.elements() > 0) else {
                    continue;
                };
                points.push(Point {
                    name: format!("{name}.{}", field.name),
                    place: Place::Memory(f as u32),
                    path: path.clone(),
                    ty,
                    time,
                    access: Access::State,
                    unit: None,
                    names: Vec::new(),
                });
            }
        }
        path.pop();
    }
}

/// A parameter's value in a program's own unit, where every value is known.
pub fn value(param: &Param) -> Option<&Value> {
    match param {
        Param::Value(value) => Some(value),
        Param::Own(_) => None,
    }
}
