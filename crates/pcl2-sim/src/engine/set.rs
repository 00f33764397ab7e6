//! What the outside writes before a scan: inputs at once, parameters and operator cells as one set or not at all.

use super::place::{Node, Store};
use super::wire::{self, Ranges, Shared};
use super::{Machine, Probe};
use crate::ffi::{Bound, Tape};
use crate::health::{self, Health};
use crate::names::Names;
use crate::number::Number;
use crate::stimulus::Event;
use pcl2_lang::bounds;
use pcl2_lang::kernel;
use pcl2_lang::model::{Access, Place};
use pcl2_lang::program::{Block, BlockId, DeclId, Program, UnitId};
use pcl2_lang::types::{Scalar, Type, Value, Width};
use pcl2_lang::verify::Verified;
use std::fmt;

/// Why a set of parameters is refused.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// The block of the program's own unit that refuses.
    pub block: BlockId,
    /// The block as messages name it.
    pub title: String,
    /// What it expects, or the text of its check.
    pub message: String,
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.title, self.message)
    }
}

impl Machine<'_> {
    /// Writes what the outside changes before the next scan. A refused set leaves every old value.
    pub fn apply(&mut self, names: &Names, events: &[Event]) -> Result<(), Refusal> {
        let mut old = Vec::new();
        let mut blocks = Vec::new();
        let mut cells = Vec::new();
        for event in events {
            let point = names.point(event.element);
            let probe = self.probe(names, event.element);
            match (point.access, point.place) {
                (Access::Input | Access::Image, _) => self.write(probe, event.value),
                (Access::Tunable | Access::Operator, place) => {
                    old.push((probe, self.read(probe)));
                    self.write(probe, event.value);
                    match place {
                        Place::Param(block, _) => blocks.push(block),
                        _ => cells.push(event),
                    }
                }
                (Access::Signal | Access::State, _) => {}
            }
        }
        blocks.sort();
        blocks.dedup();
        cells.sort_by_key(|event| event.element);
        let refusal = blocks.iter().find_map(|block| self.judge(*block));
        let refusal = refusal.or_else(|| cells.iter().find_map(|event| cell_refusal(names, event)));
        match refusal {
            None => self.derive(&blocks),
            Some(_) => self.restore(&old, &blocks),
        }
        refusal.map_or(Ok(()), |refusal| {
            self.health.refuse();
            Err(refusal)
        })
    }

    /// The parameters that their blocks refuse as they stand, at most one complaint a block.
    pub fn refusals(&mut self) -> Vec<Refusal> {
        let blocks = 0..self.body.nodes.len() as u32;
        blocks.filter_map(|block| self.judge(BlockId(block))).collect()
    }

    fn derive(&mut self, blocks: &[BlockId]) {
        for block in blocks {
            let range = self.ranges[block.0 as usize].tune.clone();
            self.run_tape(Tape::Tune, range);
        }
    }

    fn restore(&mut self, old: &[(Probe, Number)], blocks: &[BlockId]) {
        for (probe, value) in old.iter().rev() {
            self.write(*probe, *value);
        }
        for block in blocks {
            let range = self.ranges[block.0 as usize].convert.clone();
            self.run_tape(Tape::Convert, range);
        }
    }

    /// Declared ranges first, then what only the kernel can judge.
    fn judge(&mut self, id: BlockId) -> Option<Refusal> {
        let ranges = self.ranges[id.0 as usize].clone();
        self.run_tape(Tape::Convert, ranges.convert);
        let block = self.program.main().block(id);
        let message = match self.out_of_range(block, &self.body.nodes[id.0 as usize]) {
            Some(message) => Some(message),
            None => ranges.check.into_iter().find_map(|check| self.check(check)),
        };
        message.map(|message| Refusal { block: id, title: health::block_title(self.program, id), message })
    }

    fn out_of_range(&self, block: &Block, node: &Node) -> Option<String> {
        let decl = self.program.decl(node.decl);
        let values: Vec<Value> = (0..decl.params.len()).map(|i| self.value(block, node, i)).collect();
        if let Err(found) = bounds::check(decl, &block.sizes, &values, self.program.width) {
            let param = &decl.params[found.param];
            let suffix = kernel::resolve(&param.ty, &block.sizes)
                .map_or_else(String::new, |ty| crate::names::suffix(ty, found.element as u32));
            return Some(format!("{}{suffix} must be {}, not {}", param.name, found.expected, found.found));
        }
        let body = node.inner.as_ref()?;
        let inner = self.program.unit(body.unit);
        inner.blocks.iter().zip(&body.nodes).find_map(|(block, node)| self.out_of_range(block, node))
    }

    fn value(&self, block: &Block, node: &Node, param: usize) -> Value {
        let Some(ty) = kernel::resolve(&self.program.decl(node.decl).params[param].ty, &block.sizes) else {
            return Value::Text("".into());
        };
        let kind = match ty.scalar {
            Scalar::Int => super::Kind::Int,
            Scalar::Real => super::real_kind(self.program.width),
        };
        let bytes = super::place::width_of(ty.scalar, self.program.width);
        let read = |i: usize| self.read(Probe { at: node.params[param] + i * bytes, kind });
        let int = |i: usize| match read(i) {
            Number::Int(value) => value,
            _ => 0,
        };
        match (ty.scalar, ty) {
            (Scalar::Int, Type::INT) => Value::Int(int(0)),
            (Scalar::Int, _) => Value::Ints((0..ty.elements()).map(int).collect()),
            (Scalar::Real, Type::REAL) => Value::Real(read(0).to_real()),
            (Scalar::Real, _) => Value::Reals((0..ty.elements()).map(|i| read(i).to_real()).collect()),
        }
    }

    fn check(&self, check: usize) -> Option<String> {
        verdict(self.program, &self.bound, self.shared, *self.checks.get(check)?, check)
    }
}

/// What one check on the tape says: the text of its fault, with the numbers that it left.
fn verdict(program: &Program, bound: &Bound, shared: Shared, decl: DeclId, check: usize) -> Option<String> {
    let bytes = program.width.bytes();
    for i in 0..bytes / 4 * 2 {
        bound.write4(shared.left + i * 4, [0; 4]);
    }
    bound.run(Tape::Check, check..check + 1, 0, &mut Health::default());
    let status = i32::from_ne_bytes(bound.read4(shared.verdict));
    let index = usize::try_from(status).ok()?.checked_sub(1)?;
    let text = program.decl(decl).faults.get(index).map_or("refused", |fault| fault.text.as_str());
    let left = [shared.left, shared.left + bytes].map(|at| match program.width {
        Width::F64 => f64::from_ne_bytes(bound.read8(at)),
        Width::F32 => f64::from(f32::from_ne_bytes(bound.read4(at))),
    });
    Some(health::with_reals(text, left, program.width))
}

/// What the kernels' checks refuse of a program as it is written, at most one complaint a block. C of the user's own
/// is not asked, and neither is what depends on a period that is not known.
pub fn judge(program: &Verified) -> Vec<Refusal> {
    let program = program.program();
    let mut judges: Vec<bool> = vec![false; program.units.len()];
    for (u, unit) in program.units.iter().enumerate().rev() {
        judges[u] = unit.blocks.iter().any(|block| is_judged(program, block, &judges));
    }
    let mut store = Store::params_only(program);
    let mut nodes = Vec::new();
    for (i, block) in program.main().blocks.iter().enumerate().filter(|(_, block)| is_judged(program, block, &judges)) {
        let Ok(params) = store.params(UnitId(0), block, &[]) else {
            return Vec::new();
        };
        match store.node(UnitId(0), block, params, &[], 0) {
            Ok(node) => nodes.push((BlockId(i as u32), node)),
            Err(_) => return Vec::new(),
        }
    }
    ask(program, &mut store, &mut nodes).unwrap_or_default()
}

fn is_judged(program: &Program, block: &Block, judges: &[bool]) -> bool {
    match block.unit {
        Some(unit) => judges[unit.0 as usize],
        None => program.decl(block.decl).check,
    }
}

fn ask(program: &Program, store: &mut Store<'_>, nodes: &mut [(BlockId, Node)]) -> Option<Vec<Refusal>> {
    if nodes.is_empty() {
        return None;
    }
    let wired = wire::wire_checks(store, nodes).ok()?;
    let bound = Bound::new(&wired.plan, program.width).ok()?;
    for (at, fill) in &store.fills {
        super::fill(&bound, program.width, *at, *fill);
    }
    let mut health = Health::default();
    bound.run(Tape::Convert, 0..bound.len(Tape::Convert), 0, &mut health);
    let refusal = |((id, _), ranges): (&(BlockId, Node), &Ranges)| {
        let check = |check| verdict(program, &bound, wired.shared, *wired.checks.get(check)?, check);
        let message = ranges.check.clone().find_map(check)?;
        Some(Refusal { block: *id, title: health::block_title(program, *id), message })
    };
    Some(nodes.iter().zip(&wired.ranges).filter_map(refusal).collect())
}

/// Whether an operator cell refuses a value: it must be finite and in the port's declared range.
pub fn cell_refusal(names: &Names, event: &Event) -> Option<Refusal> {
    let point = names.point(event.element);
    let Place::Cell(id) = point.place else {
        return None;
    };
    let program = names.program;
    let cell = &program.main().cells[id.0 as usize];
    let block = program.main().block(cell.block);
    let port = port_of(program.decl(block.decl), &block.sizes, cell.port as usize)?;
    let value = match program.width {
        Width::F64 => event.value.to_f64(),
        Width::F32 => f64::from(event.value.to_real().narrow),
    };
    let expected = bounds::check_value(&port.tail, value, &block.sizes)?;
    let message = format!("{} must be {expected}, not {}", names.label(event.element), event.value);
    Some(Refusal { block: cell.block, title: health::block_title(program, cell.block), message })
}

fn port_of<'d>(
    decl: &'d pcl2_lang::decl::Decl,
    sizes: &[i32],
    expanded: usize,
) -> Option<&'d pcl2_lang::decl::PortDecl> {
    let mut first = 0;
    decl.ports().find(|port| {
        first += kernel::count(port.group.as_ref(), sizes).unwrap_or(0);
        expanded < first
    })
}
