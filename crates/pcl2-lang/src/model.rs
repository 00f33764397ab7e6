//! The points of a program that have a name outside: what maps, monitors, stimulus and saved states speak of.

use crate::decl::{Decl, Direction, OutputDecl, PortDecl, RETURN_OUTPUT, Tail, TypeExpr};
use crate::kernel;
use crate::net::BOX_OUTPUT;
use crate::program::{Block, BlockId, CellId, DeclId, ImageId, Param, Program, Role, SignalId, Unit, UnitId};
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
    /// The tokens of the boxes of a net inside a net or a composite; the path leads there from the outside in
    /// ([`Point::path`]).
    Inside(SignalId),
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
    /// For memory and what is inside: the blocks from the program's own unit inwards; else empty.
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
    /// The names of a vector's elements, where they have some: they stand in the place of [`BOX_OUTPUT`].
    pub elements: Vec<String>,
}

/// All points of a program, in a fixed order: signals, boxes of nets inside, image, parameters, cells, memory.
pub fn points(program: &Program) -> Vec<Point> {
    let mut points = Vec::new();
    visit(program, &mut |seen| {
        let tail = seen.tail.cloned().unwrap_or_default();
        points.push(Point {
            name: seen.name.to_owned(),
            place: seen.place,
            path: seen.path.to_vec(),
            ty: seen.ty,
            time: seen.time,
            access: seen.access,
            unit: tail.unit,
            names: tail.names,
            elements: seen.elements.to_vec(),
        });
    });
    points
}

/// A point on the way past it: as [`Point`], borrowed.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'s> {
    /// As [`Point::name`].
    pub name: &'s str,
    /// What it is.
    pub place: Place,
    /// As [`Point::path`].
    pub path: &'s [BlockId],
    /// Its type; times count as one int64.
    pub ty: Type,
    /// Nanoseconds in an `int64_t`.
    pub time: bool,
    /// Who writes it.
    pub access: Access,
    /// Unit, range and names, where a declaration gives them.
    pub tail: Option<&'s Tail>,
    /// The declaration behind it, and the values of its sizes.
    pub declared: Option<(DeclId, &'s [i32])>,
    /// As [`Point::elements`].
    pub elements: &'s [String],
}

impl Point {
    /// The name of an element that has one of its own: `tank.S0`.
    pub fn element_name(&self, element: u32) -> Option<String> {
        let name = self.elements.get(element as usize)?;
        let owner = self.name.strip_suffix(BOX_OUTPUT).and_then(|owner| owner.strip_suffix('.'));
        Some(format!("{}.{name}", owner.unwrap_or(&self.name)))
    }
}

/// Shows all points in the order of [`points`], for programs with too many to keep.
pub fn visit(program: &Program, see: &mut dyn FnMut(Seen<'_>)) {
    signals(program, see);
    inside(program, UnitId(0), &mut Vec::new(), &mut String::new(), see);
    images(program, see);
    parameters(program, see);
    cells(program, see);
    memory(program, UnitId(0), &mut Vec::new(), &mut String::new(), see);
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

fn signals(program: &Program, see: &mut dyn FnMut(Seen<'_>)) {
    for (i, signal) in program.main().signals.iter().enumerate().filter(|(_, signal)| !signal.name.is_empty()) {
        let access = if signal.role == Role::Input { Access::Input } else { Access::Signal };
        let written = signal.writers.first().and_then(|writer| {
            let block = program.main().block(writer.block);
            let decl = program.decl(block.decl);
            let index = output_decl(decl, &block.sizes, writer.output as usize)?;
            Some((&decl.outputs[index], block))
        });
        see(Seen {
            name: &signal.name,
            place: Place::Signal(SignalId(i as u32)),
            path: &[],
            ty: signal.ty,
            time: false,
            access,
            tail: written.map(|(output, _)| &output.tail),
            elements: written.map_or(&[], |(output, _)| output.elements.as_slice()),
            declared: written.map(|(_, block)| (block.decl, block.sizes.as_slice())),
        });
    }
}

/// The boxes of nets in nets and composites. Those of a net of the program itself are an output, and so a signal.
fn inside(
    program: &Program,
    unit: UnitId,
    path: &mut Vec<BlockId>,
    prefix: &mut String,
    see: &mut dyn FnMut(Seen<'_>),
) {
    let length = prefix.len();
    for (b, block) in program.unit(unit).blocks.iter().enumerate() {
        let Some(inner) = block.unit else {
            continue;
        };
        path.push(BlockId(b as u32));
        prefix.extend([block.name.as_str(), "."]);
        if path.len() > 1 {
            boxes(program, block, inner, (path, prefix), see);
        }
        inside(program, inner, path, prefix, see);
        prefix.truncate(length);
        path.pop();
    }
}

/// The boxes of a net, if they are any.
fn boxes(
    program: &Program,
    block: &Block,
    inner: UnitId,
    (path, prefix): (&[BlockId], &mut String),
    see: &mut dyn FnMut(Seen<'_>),
) {
    let decl = program.decl(block.decl);
    let Some(output) = decl.outputs.iter().position(|output| output.name == BOX_OUTPUT && decl.net.is_some()) else {
        return;
    };
    let unit = program.unit(inner);
    let Some(id) = unit.outputs.get(output).copied().filter(|id| unit.signal(*id).ty.elements() > 0) else {
        return;
    };
    let length = prefix.len();
    prefix.push_str(BOX_OUTPUT);
    see(Seen {
        name: prefix,
        place: Place::Inside(id),
        path,
        ty: unit.signal(id).ty,
        time: false,
        access: Access::Signal,
        tail: Some(&decl.outputs[output].tail),
        declared: Some((block.decl, &block.sizes)),
        elements: &decl.outputs[output].elements,
    });
    prefix.truncate(length);
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

/// Whether a declared output is a return wire to which nobody listens: it has no place, and the kernel gets NULL for it.
/// The return wires of a group are always there.
pub fn is_open(unit: &Unit, block: &Block, decl: &Decl, output: usize) -> bool {
    let declared = &decl.outputs[output];
    if decl.returns.is_none() || declared.name != RETURN_OUTPUT || declared.group.is_some() || block.unit.is_some() {
        return false;
    }
    let count = |output: &OutputDecl| kernel::count(output.group.as_ref(), &block.sizes).unwrap_or(0);
    let expanded: usize = decl.outputs[..output].iter().map(count).sum();
    block.outputs.get(expanded).is_some_and(|signal| unit.signal(*signal).name.is_empty())
}

fn images(program: &Program, see: &mut dyn FnMut(Seen<'_>)) {
    for (i, image) in program.images.iter().enumerate() {
        see(Seen {
            name: &image.name,
            place: Place::Image(ImageId(i as u32)),
            path: &[],
            ty: if image.scalar == Scalar::Int { Type::INT } else { Type::REAL },
            time: false,
            access: if image.direction == Direction::In { Access::Image } else { Access::Signal },
            tail: None,
            declared: None,
            elements: &[],
        });
    }
}

fn parameters(program: &Program, see: &mut dyn FnMut(Seen<'_>)) {
    let mut name = String::new();
    for (b, block) in program.main().blocks.iter().enumerate().filter(|(_, block)| block.tunable) {
        let decl = program.decl(block.decl);
        for (p, param) in decl.params.iter().enumerate().filter(|(_, param)| !param.fixed) {
            let Some(ty) = kernel::resolve(&param.ty, &block.sizes) else {
                continue;
            };
            name.clear();
            name.extend([block.name.as_str(), ".", param.name.as_str()]);
            see(Seen {
                name: &name,
                place: Place::Param(BlockId(b as u32), p as u32),
                path: &[],
                ty,
                time: false,
                access: Access::Tunable,
                tail: Some(&param.tail),
                declared: Some((block.decl, &block.sizes)),
                elements: &[],
            });
        }
    }
}

fn cells(program: &Program, see: &mut dyn FnMut(Seen<'_>)) {
    for (i, cell) in program.main().cells.iter().enumerate() {
        let block = program.main().block(cell.block);
        let port = port_decl(program.decl(block.decl), &block.sizes, cell.port as usize);
        see(Seen {
            name: &cell.name,
            place: Place::Cell(CellId(i as u32)),
            path: &[],
            ty: cell.ty,
            time: false,
            access: Access::Operator,
            tail: port.map(|port| &port.tail),
            declared: Some((block.decl, &block.sizes)),
            elements: &[],
        });
    }
}

/// The declared port of an expanded one.
fn port_decl<'d>(decl: &'d Decl, sizes: &[i32], expanded: usize) -> Option<&'d PortDecl> {
    let mut first = 0;
    decl.ports().find(|port| {
        first += kernel::count(port.group.as_ref(), sizes).unwrap_or(0);
        expanded < first
    })
}

fn memory(
    program: &Program,
    unit: UnitId,
    path: &mut Vec<BlockId>,
    prefix: &mut String,
    see: &mut dyn FnMut(Seen<'_>),
) {
    let length = prefix.len();
    for (b, block) in program.unit(unit).blocks.iter().enumerate() {
        path.push(BlockId(b as u32));
        prefix.extend([block.name.as_str(), "."]);
        if let Some(inner) = block.unit {
            memory(program, inner, path, prefix, see);
        } else {
            fields(program.decl(block.decl), block, path, prefix, see);
        }
        prefix.truncate(length);
        path.pop();
    }
}

fn fields(decl: &Decl, block: &Block, path: &[BlockId], prefix: &mut String, see: &mut dyn FnMut(Seen<'_>)) {
    let length = prefix.len();
    for (f, field) in decl.memory.iter().enumerate() {
        let time = matches!(field.ty, TypeExpr::Time);
        let ty = if time { Some(Type::INT) } else { kernel::resolve(&field.ty, &block.sizes) };
        let Some(ty) = ty.filter(|ty| ty.elements() > 0) else {
            continue;
        };
        prefix.push_str(&field.name);
        see(Seen {
            name: prefix,
            place: Place::Memory(f as u32),
            path,
            ty,
            time,
            access: Access::State,
            tail: None,
            declared: Some((block.decl, &block.sizes)),
            elements: &[],
        });
        prefix.truncate(length);
    }
}

/// A parameter's value in a program's own unit, where every value is known.
pub fn value(param: &Param) -> Option<&Value> {
    match param {
        Param::Value(value) => Some(value),
        Param::Own(_) => None,
    }
}
