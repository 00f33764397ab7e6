//! Second pass: wires, calls and what follows them, as tapes over the places of the first pass.

use super::Unsupported;
use super::net::{self, NetStore};
use super::place::{Body, Fill, NOWHERE, Node, Store, has_slot, width_of};
use crate::ffi::{Function, Op, Plan, Slot, Tape};
use pcl2_lang::decl::{Decl, PortDecl, Step, TypeExpr};
use pcl2_lang::kernel::{self, Arg, Entry};
use pcl2_lang::program::{
    Block, BlockId, DeclId, Program, Role, SectionKind, Signal, Source, Tracked, Unit, UnitId, Writer,
};
use pcl2_lang::types::{Real, Scalar, Shape, Type};
use rustc_hash::FxHashMap;
use std::ops::Range;

/// Places that all blocks share.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shared {
    /// What a check returns.
    pub(crate) verdict: usize,
    /// The two reals that a check leaves.
    pub(crate) left: usize,
    /// Scratch of the block that runs.
    work: usize,
}

/// The ranges of one block of the program's own unit on the tapes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ranges {
    pub(crate) convert: Range<usize>,
    pub(crate) check: Range<usize>,
    pub(crate) tune: Range<usize>,
    pub(crate) step: Range<usize>,
}

/// Wires a program.
pub(crate) struct Wiring<'a, 'b> {
    store: &'b mut Store<'a>,
    program: &'a Program,
    plan: Plan,
    shared: Shared,
    cells: Vec<usize>,
    cells_by_block: FxHashMap<u32, Vec<usize>>,
    images: Vec<usize>,
    sizes: FxHashMap<i32, usize>,
    periods: FxHashMap<i64, usize>,
    entries: &'static [(Entry, Tape)],
    /// The reals that the latest block computed on its way, if it is an expression.
    inner_reals: Vec<usize>,
}

const ALL: &[(Entry, Tape)] =
    &[(Entry::Check, Tape::Check), (Entry::Tune, Tape::Tune), (Entry::Init, Tape::Init), (Entry::Step, Tape::Step)];
const CHECKS: &[(Entry, Tape)] = &[(Entry::Check, Tape::Check)];

/// Everything that the second pass finds out.
#[derive(Debug)]
pub(crate) struct Wired {
    pub(crate) plan: Plan,
    pub(crate) shared: Shared,
    pub(crate) cells: Vec<usize>,
    pub(crate) images: Vec<usize>,
    /// One for each block of the program's own unit.
    pub(crate) ranges: Vec<Ranges>,
    /// The function code of each check on its tape.
    pub(crate) checks: Vec<pcl2_lang::program::DeclId>,
}

/// One instance of a unit while it is wired.
struct Context<'c> {
    signals: &'c [usize],
    /// The own parameters of the composite around it.
    own: &'c [usize],
    period: Option<i64>,
    /// Whether this is the body of a composite.
    nested: bool,
    /// The status of the composite around it.
    outer_status: Option<usize>,
    /// The block of the program's own unit.
    top: u32,
}

/// Wires all blocks. Composite ports become known on the way, so the body is completed too.
pub(crate) fn wire(store: &mut Store, body: &mut Body) -> Result<Wired, Unsupported> {
    let mut wiring = Wiring::new(store, ALL)?;
    let (ranges, checks) = wiring.main(body)?;
    wiring.publish(body, true);
    Ok(wiring.finish(ranges, checks))
}

/// Wires the checks of some blocks of the program's own unit. One that needs a period which is not known has none.
pub(crate) fn wire_checks(store: &mut Store, nodes: &mut [(BlockId, Node)]) -> Result<Wired, Unsupported> {
    let mut wiring = Wiring::new(store, CHECKS)?;
    let program = wiring.program;
    let signals = vec![NOWHERE; program.main().signals.len()];
    let (mut ranges, mut checks) = (Vec::new(), Vec::new());
    for (id, node) in nodes {
        let section = program.sections.iter().find(|section| (section.first..section.end).contains(&id.0));
        let period = program.period.zip(section).map(|(scan, section)| section.period(scan, program.substeps));
        let context = Context { signals: &signals, own: &[], period, nested: false, outer_status: None, top: id.0 };
        let start = checks.len();
        match wiring.node(program.main(), *id, node, &context, &mut checks) {
            Ok(()) => ranges.push(Ranges { check: start..checks.len(), ..Ranges::default() }),
            Err(Unsupported::NeedsPeriod(_)) => ranges.push(Ranges { check: start..start, ..Ranges::default() }),
            Err(other) => return Err(other),
        }
    }
    Ok(wiring.finish(ranges, checks))
}

impl Plan {
    fn tape(&mut self, tape: Tape) -> &mut Vec<Op> {
        &mut self.tapes[tape as usize]
    }
}

type Checks = Vec<pcl2_lang::program::DeclId>;

impl<'a, 'b> Wiring<'a, 'b> {
    fn new(store: &'b mut Store<'a>, entries: &'static [(Entry, Tape)]) -> Result<Wiring<'a, 'b>, Unsupported> {
        let program = store.program;
        let left = store.take(2 * program.width.bytes())?;
        let verdict = store.take(4)?;
        let mut cells = Vec::with_capacity(program.main().cells.len());
        let mut cells_by_block: FxHashMap<u32, Vec<usize>> = FxHashMap::default();
        for (i, cell) in program.main().cells.iter().enumerate() {
            cells.push(store.constant(cell.ty, &cell.initial)?);
            cells_by_block.entry(cell.block.0).or_default().push(i);
        }
        let mut images = Vec::with_capacity(program.images.len());
        for image in &program.images {
            images.push(store.take(width_of(image.scalar, program.width))?);
        }
        let work = store.take(largest_work(store))?;
        let shared = Shared { verdict, left, work };
        let (plan, sizes, periods) = (Plan::default(), FxHashMap::default(), FxHashMap::default());
        Ok(Wiring {
            store,
            program,
            plan,
            shared,
            cells,
            cells_by_block,
            images,
            sizes,
            periods,
            entries,
            inner_reals: Vec::new(),
        })
    }

    fn finish(self, ranges: Vec<Ranges>, checks: Checks) -> Wired {
        let Wiring { mut plan, shared, cells, images, store, .. } = self;
        plan.bytes = store.bytes;
        *plan.tape(Tape::Convert) = std::mem::take(&mut store.converts);
        Wired { plan, shared, cells, images, ranges, checks }
    }

    fn main(&mut self, body: &mut Body) -> Result<(Vec<Ranges>, Checks), Unsupported> {
        let unit = self.program.main();
        let mut ranges = Vec::with_capacity(unit.blocks.len());
        let mut checks = Vec::new();
        for section in &self.program.sections {
            let period = self.program.period.map(|scan| section.period(scan, self.program.substeps));
            for top in section.first..section.end {
                let start = self.lengths();
                let context =
                    Context { signals: &body.signals, own: &[], period, nested: false, outer_status: None, top };
                let node = &mut body.nodes[top as usize];
                self.node(unit, BlockId(top), node, &context, &mut checks)?;
                let end = self.lengths();
                let range = |tape: Tape| start[tape as usize]..end[tape as usize];
                let starts = &self.store.convert_starts;
                let convert_end = starts.get(top as usize + 1).copied().unwrap_or(self.store.converts.len());
                ranges.push(Ranges {
                    convert: starts.get(top as usize).copied().unwrap_or(convert_end)..convert_end,
                    check: range(Tape::Check),
                    tune: range(Tape::Tune),
                    step: range(Tape::Step),
                });
            }
        }
        Ok((ranges, checks))
    }

    fn lengths(&self) -> [usize; crate::ffi::TAPES] {
        std::array::from_fn(|i| self.plan.tapes[i].len())
    }

    fn node(
        &mut self,
        unit: &'a Unit,
        id: BlockId,
        node: &mut Node,
        context: &Context,
        checks: &mut Checks,
    ) -> Result<(), Unsupported> {
        let block = unit.block(id);
        match (&mut node.inner, &node.net) {
            (Some(body), Some(net)) => {
                let first = self.plan.nets.len();
                self.net(unit, id, (node.status, net), body, context, checks)?;
                let count = self.plan.nets.len() - first;
                self.plan.tape(Tape::Step).push(Op::Net { first, count });
            }
            (Some(body), None) => self.composite(unit, id, node.status, body, context, checks)?,
            (None, _) => self.leaf(unit, block, node, context, checks)?,
        }
        self.after(unit, id, node, context);
        Ok(())
    }

    /// A net: its statements stand on a tape of their own, and the player says when each of them runs.
    fn net(
        &mut self,
        unit: &'a Unit,
        id: BlockId,
        (status, store): (Option<usize>, &NetStore),
        body: &mut Body,
        context: &Context,
        checks: &mut Checks,
    ) -> Result<usize, Unsupported> {
        let index = self.plan.nets.len();
        let period = context.period.unwrap_or(0);
        self.plan.nets.push(net::plan(store, status.unwrap_or(NOWHERE), period));
        let start = self.plan.tape(Tape::Step).len();
        self.latch(unit, id, body, context)?;
        self.plan.nets[index].latch = self.move_to_scripts(start);
        let inner = self.program.unit(body.unit);
        let Body { signals, nodes, own, .. } = body;
        let context =
            Context { signals, own, period: context.period, nested: true, outer_status: status, top: context.top };
        for (i, node) in nodes.iter_mut().enumerate() {
            let id = BlockId(i as u32);
            let script = match (&mut node.inner, &node.net) {
                (Some(body), Some(net)) => {
                    let part = self.net(inner, id, (node.status, net), body, &context, checks)?;
                    let plan = &mut self.plan.nets[part];
                    (plan.outer, plan.inputs) = (Some(index), i as i32);
                    let latch = plan.latch.clone();
                    net::script(latch, inner, node, i, Vec::new())
                }
                (Some(_), None) | (None, _) => {
                    let start = self.plan.tape(Tape::Step).len();
                    self.node(inner, id, node, &context, checks)?;
                    let ops = self.move_to_scripts(start);
                    net::script(ops, inner, node, i, self.reals(inner, id, &context))
                }
            };
            self.plan.nets[index].scripts.push(script);
        }
        Ok(index)
    }

    /// A net's inputs are taken in once a scan, and its commands go to the words that gates clear.
    fn latch(&mut self, unit: &'a Unit, id: BlockId, body: &mut Body, context: &Context) -> Result<(), Unsupported> {
        let block = unit.block(id);
        let inner = self.program.unit(body.unit);
        for (i, signal) in inner.signals.iter().enumerate() {
            let Role::Port(port) = signal.role else {
                continue;
            };
            if let Some(source) = block.ports.get(port as usize) {
                body.signals[i] = self.source(unit, source, signal.ty, true, context)?;
            }
        }
        let Some(net) = self.program.decl(block.decl).net.as_deref() else {
            return Ok(());
        };
        let held = inner.signals.iter().position(|signal| signal.role == Role::Held).unwrap_or(0);
        for (port, word) in net.latched() {
            let (from, to) = (body.signals[port as usize], body.signals[held + word.0 as usize]);
            self.plan.tape(Tape::Step).push(Op::Copy { from, to, bytes: 4 });
        }
        Ok(())
    }

    /// Moves what was put on the tape of steps since a place to that of a net's statements.
    fn move_to_scripts(&mut self, start: usize) -> Range<usize> {
        let ops = self.plan.tape(Tape::Step).split_off(start);
        let scripts = self.plan.tape(Tape::Script);
        let first = scripts.len();
        scripts.extend(ops);
        first..scripts.len()
    }

    /// Where the reals are that a statement reads, and those that it computes on its way.
    fn reals(&self, unit: &Unit, id: BlockId, context: &Context) -> Vec<usize> {
        let places = unit.block(id).ports.iter().map(|source| self.wired(unit, source, context));
        let real = |(at, ty): &(usize, Type)| ty.scalar == Scalar::Real && ty.is_scalar() && *at != NOWHERE;
        places.filter(real).map(|(at, _)| at).chain(self.inner_reals.iter().copied()).collect()
    }

    fn composite(
        &mut self,
        unit: &'a Unit,
        id: BlockId,
        status: Option<usize>,
        body: &mut Body,
        context: &Context,
        checks: &mut Checks,
    ) -> Result<(), Unsupported> {
        let block = unit.block(id);
        let inner = self.program.unit(body.unit);
        if let Some(at) = status {
            self.plan.tape(Tape::Step).push(Op::Clear { at });
        }
        for (i, signal) in inner.signals.iter().enumerate() {
            let Role::Port(port) = signal.role else {
                continue;
            };
            let Some(source) = block.ports.get(port as usize) else {
                continue;
            };
            if body.signals[i] == NOWHERE {
                let copy = writes(unit, source, id);
                body.signals[i] = self.source(unit, source, signal.ty, copy, context)?;
            } else {
                self.into(unit, source, signal.ty, body.signals[i], context);
            }
        }
        let Body { signals, nodes, own, .. } = body;
        let context =
            Context { signals, own, period: context.period, nested: true, outer_status: status, top: context.top };
        for (i, node) in nodes.iter_mut().enumerate() {
            self.node(inner, BlockId(i as u32), node, &context, checks)?;
        }
        Ok(())
    }

    /// What follows a block: copies to variables with several writers, operator cells, its status.
    fn after(&mut self, unit: &Unit, id: BlockId, node: &Node, context: &Context) {
        let block = unit.block(id);
        for (output, signal) in block.outputs.iter().enumerate() {
            let (from, to) = (node.outputs[output], context.signals[signal.0 as usize]);
            if from != to && from != NOWHERE && to != NOWHERE {
                let bytes = self.store.type_bytes(unit.signal(*signal).ty);
                self.plan.tape(Tape::Step).push(Op::Copy { from, to, bytes });
            }
        }
        for i in self.cells_of(id, context) {
            let cell = &unit.cells[i];
            let from = match cell.tracks {
                None => NOWHERE,
                Some(Tracked::Output(output)) => node.outputs.get(output as usize).copied().unwrap_or(NOWHERE),
                Some(Tracked::Memory(field)) => node.memory.get(field as usize).copied().unwrap_or(NOWHERE),
            };
            if from != NOWHERE {
                let bytes = self.store.type_bytes(cell.ty);
                self.plan.tape(Tape::Step).push(Op::Copy { from, to: self.cells[i], bytes });
            }
        }
        if let Some(at) = node.status {
            self.plan.tape(Tape::Step).push(match context.outer_status {
                None => Op::Fault { at, block: context.top },
                Some(to) => Op::Carry { from: at, to },
            });
        }
    }

    /// The operator cells of a block; only the program's own unit has any.
    fn cells_of(&self, id: BlockId, context: &Context) -> Vec<usize> {
        match context.nested {
            true => Vec::new(),
            false => self.cells_by_block.get(&id.0).cloned().unwrap_or_default(),
        }
    }

    fn leaf(
        &mut self,
        unit: &'a Unit,
        block: &'a Block,
        node: &Node,
        context: &Context,
        checks: &mut Checks,
    ) -> Result<(), Unsupported> {
        let decl = self.program.decl(block.decl);
        self.inner_reals.clear();
        if let Some(formula) = &decl.formula {
            return self.expression(unit, block, decl, node, formula, context);
        }
        for (entry, tape) in self.entries.iter().copied() {
            let Some(function) = node.kernel.and_then(|kernel| kernel.function(entry)) else {
                continue;
            };
            let mut slots = self.arguments(unit, block, decl, node, entry, context)?;
            match entry {
                Entry::Check => {
                    slots.push(Slot { at: self.shared.verdict, bytes: 4 });
                    checks.push(block.decl);
                }
                Entry::Step if kernel::returns_value(decl) => slots.push(self.output(block, decl, node, 0)),
                Entry::Step | Entry::Tune | Entry::Init => {}
            }
            let judged = if entry == Entry::Step { judged(decl, &slots) } else { Vec::new() };
            self.call(tape, function, slots);
            self.judge(node, judged);
        }
        Ok(())
    }

    fn call(&mut self, tape: Tape, function: Function, slots: Vec<Slot>) {
        let (first, count) = self.table(slots);
        self.plan.tape(tape).push(Op::Call { function, first, count });
    }

    /// Looks at real inputs and result of a code whose result tells of its fault.
    fn judge(&mut self, node: &Node, judged: Vec<Slot>) {
        if let (Some(at), false) = (node.status, judged.is_empty()) {
            let (first, count) = self.table(judged);
            self.plan.tape(Tape::Step).push(Op::Judge { first, count, at });
        }
    }

    /// An expression: one call for each of its codes, the last into the output.
    fn expression(
        &mut self,
        unit: &'a Unit,
        block: &'a Block,
        decl: &'a Decl,
        node: &Node,
        formula: &'a [Step],
        context: &Context,
    ) -> Result<(), Unsupported> {
        if !self.entries.iter().any(|(entry, _)| *entry == Entry::Step) {
            return Ok(());
        }
        let result = self.output(block, decl, node, 0);
        let (mut inputs, mut first) = (Vec::new(), 0);
        for port in decl.ports() {
            inputs
                .push((self.port(unit, block, port, &mut first, context)?, port.ty == TypeExpr::Scalar(Scalar::Real)));
        }
        let mut next = inputs.iter().copied();
        let mut results: Vec<(Slot, bool)> = Vec::new();
        for (i, step) in formula.iter().enumerate() {
            let last = i + 1 == formula.len();
            let done = match step {
                Step::Port => next.next().unwrap_or((result, true)),
                Step::Apply(code) => self.apply(*code, &mut results, last.then_some(result))?,
            };
            if let (true, Step::Port) = (last, step) {
                self.plan.tape(Tape::Step).push(Op::Copy { from: done.0.at, to: result.at, bytes: result.bytes });
            }
            results.push(done);
        }
        if kernel::faults_by_result(decl) {
            let judged = inputs.iter().filter(|(_, real)| *real).map(|(slot, _)| *slot).chain([result]);
            self.judge(node, judged.collect());
        }
        Ok(())
    }

    /// Calls an operator code on the latest results. What it gives, and whether that is a real.
    fn apply(
        &mut self,
        code: DeclId,
        results: &mut Vec<(Slot, bool)>,
        to: Option<Slot>,
    ) -> Result<(Slot, bool), Unsupported> {
        let program = self.program;
        let decl = program.decl(code);
        let wanted: Vec<Scalar> = decl.port_scalars().collect();
        let operands = results.split_off(results.len().saturating_sub(wanted.len()));
        let mut slots = Vec::new();
        for arg in kernel::args(decl, Entry::Step) {
            slots.push(match arg {
                Arg::Port(i) => self.as_wanted(operands[i], wanted[i])?,
                Arg::Param(i) => {
                    let param = &decl.params[i];
                    let ty = kernel::resolve(&param.ty, &[]).unwrap_or(Type::REAL);
                    let value = param.default.as_ref();
                    let at = value.map_or(Ok(NOWHERE), |value| self.store.constant(ty, value))?;
                    self.slot(at, self.store.type_bytes(ty))
                }
                _ => Slot { at: 0, bytes: 0 },
            });
        }
        let ty = kernel::resolve(&decl.outputs[0].ty, &[]).unwrap_or(Type::REAL);
        let result = match to {
            Some(slot) => slot,
            None => Slot { at: self.store.take_type(ty)?, bytes: self.store.type_bytes(ty) },
        };
        slots.push(result);
        if let Some(function) = self.store.kernels[code.0 as usize].and_then(|kernel| kernel.function(Entry::Step)) {
            self.call(Tape::Step, function, slots);
        }
        if ty.scalar == Scalar::Real {
            self.inner_reals.push(result.at);
        }
        Ok((result, ty.scalar == Scalar::Real))
    }

    /// An int where a real is wanted is converted.
    fn as_wanted(&mut self, (slot, real): (Slot, bool), wanted: Scalar) -> Result<Slot, Unsupported> {
        if real || wanted == Scalar::Int {
            return Ok(slot);
        }
        let to = self.store.take_type(Type::REAL)?;
        self.plan.tape(Tape::Step).push(Op::Convert { from: slot.at, to });
        Ok(Slot { at: to, bytes: self.store.type_bytes(Type::REAL) })
    }

    /// Adds slots to the table of arguments.
    fn table(&mut self, slots: Vec<Slot>) -> (usize, usize) {
        let (first, count) = (self.plan.arguments.len(), slots.len());
        self.plan.arguments.extend(slots);
        (first, count)
    }

    fn arguments(
        &mut self,
        unit: &'a Unit,
        block: &'a Block,
        decl: &'a Decl,
        node: &Node,
        entry: Entry,
        context: &Context,
    ) -> Result<Vec<Slot>, Unsupported> {
        let mut slots = Vec::new();
        let mut work = self.shared.work;
        let mut port_first = 0;
        for arg in kernel::args(decl, entry) {
            slots.push(match arg {
                Arg::Instance => Slot { at: node.instance, bytes: node.kernel.map_or(0, crate::ffi::Kernel::size) },
                Arg::Size(i) => self.size(block.sizes[i])?,
                Arg::Period => self.period(decl, context)?,
                Arg::Left => Slot { at: self.shared.left, bytes: 2 * self.program.width.bytes() },
                Arg::Param(i) => self.param(block, decl, node, i),
                Arg::Memory(i) => self.slot(node.memory[i], self.store.field_bytes(&decl.memory[i], &block.sizes)),
                Arg::Tuned(i) => self.slot(node.tuned[i], self.store.field_bytes(&decl.tuned[i], &block.sizes)),
                Arg::Work(i) => {
                    let bytes = self.store.field_bytes(&decl.work[i], &block.sizes);
                    let slot = self.slot(if bytes == 0 { NOWHERE } else { work }, bytes);
                    work = work.saturating_add(bytes.next_multiple_of(8));
                    slot
                }
                Arg::Output(i) => self.output(block, decl, node, i),
                Arg::Image => self.image(block),
                Arg::Fail => self.fail(block)?,
                Arg::Port(i) => match decl.ports().nth(i) {
                    Some(port) => self.port(unit, block, port, &mut port_first, context)?,
                    None => Slot { at: 0, bytes: 0 },
                },
            });
        }
        Ok(slots)
    }

    fn slot(&self, at: usize, bytes: usize) -> Slot {
        if at == NOWHERE { Slot { at: 0, bytes: 0 } } else { Slot { at, bytes } }
    }

    fn size(&mut self, value: i32) -> Result<Slot, Unsupported> {
        let at = match self.sizes.get(&value) {
            Some(at) => *at,
            None => {
                let at = self.store.take(4)?;
                self.store.fills.push((at, Fill::Int(value)));
                self.sizes.insert(value, at);
                at
            }
        };
        Ok(Slot { at, bytes: 4 })
    }

    fn period(&mut self, decl: &Decl, context: &Context) -> Result<Slot, Unsupported> {
        let period = context.period.ok_or_else(|| Unsupported::NeedsPeriod(decl.name.clone()))?;
        let at = match self.periods.get(&period) {
            Some(at) => *at,
            None => {
                let at = self.store.take(8)?;
                self.store.fills.push((at, Fill::Time(period)));
                self.periods.insert(period, at);
                at
            }
        };
        Ok(Slot { at, bytes: 8 })
    }

    fn param(&self, block: &Block, decl: &Decl, node: &Node, i: usize) -> Slot {
        let bytes = match kernel::resolve(&decl.params[i].ty, &block.sizes) {
            Some(ty) => self.store.type_bytes(ty),
            None => 1,
        };
        self.slot(node.params[i], bytes)
    }

    fn output(&self, block: &Block, decl: &Decl, node: &Node, i: usize) -> Slot {
        let count =
            |output: &pcl2_lang::decl::OutputDecl| kernel::count(output.group.as_ref(), &block.sizes).unwrap_or(0);
        let first: usize = decl.outputs[..i].iter().map(count).sum();
        let bytes = kernel::resolve(&decl.outputs[i].ty, &block.sizes).map_or(0, |ty| self.store.type_bytes(ty));
        self.slot(node.outputs.get(first).copied().unwrap_or(NOWHERE), bytes * count(&decl.outputs[i]))
    }

    fn image(&self, block: &Block) -> Slot {
        let Some(image) = block.image else {
            return Slot { at: 0, bytes: 0 };
        };
        let word = &self.program.images[image.0 as usize];
        Slot { at: self.images[image.0 as usize], bytes: width_of(word.scalar, self.program.width) }
    }

    /// The fail-safe value of a block's word.
    fn fail(&mut self, block: &Block) -> Result<Slot, Unsupported> {
        const HOLD: Real = Real { wide: f64::NAN, narrow: f32::NAN };
        let bytes = self.program.width.bytes();
        let bound = block.image.and_then(|image| self.program.images[image.0 as usize].fail);
        let at = self.store.take(bytes)?;
        self.store.fills.push((at, Fill::Real(bound.unwrap_or(HOLD))));
        Ok(Slot { at, bytes })
    }

    fn port(
        &mut self,
        unit: &'a Unit,
        block: &'a Block,
        port: &PortDecl,
        first: &mut usize,
        context: &Context,
    ) -> Result<Slot, Unsupported> {
        let ty = kernel::resolve(&port.ty, &block.sizes).unwrap_or(Type::REAL);
        let bytes = self.store.type_bytes(ty);
        let count = kernel::count(port.group.as_ref(), &block.sizes).unwrap_or(0);
        let sources = block.ports.get(*first..*first + count).unwrap_or(&[]);
        *first += count;
        if port.group.is_none() {
            let Some(source) = sources.first() else {
                return Ok(Slot { at: 0, bytes: 0 });
            };
            let overwritten =
                self.is_judged(block) && matches!(source, Source::Signal(id) if block.outputs.contains(id));
            let copy = overwritten || matches!(source, Source::Copied(_));
            let at = self.source(unit, source, ty, copy, context)?;
            return Ok(self.slot(at, bytes));
        }
        let total = bytes.checked_mul(count).ok_or(Unsupported::TooLarge)?;
        let at = self.store.take(total)?;
        for (i, source) in sources.iter().enumerate().filter(|_| bytes > 0) {
            self.into(unit, source, ty, at + i * bytes, context);
        }
        Ok(self.slot(at, total))
    }

    /// Whether the block's inputs are looked at once more when its result is there.
    fn is_judged(&self, block: &Block) -> bool {
        kernel::faults_by_result(self.program.decl(block.decl))
    }

    /// Where a kernel finds what is wired to a port.
    fn source(
        &mut self,
        unit: &'a Unit,
        source: &'a Source,
        want: Type,
        copy: bool,
        context: &Context,
    ) -> Result<usize, Unsupported> {
        let (from, found) = match source {
            Source::Constant(value) => return self.store.constant(want, value),
            wired => self.wired(unit, wired, context),
        };
        if found.scalar == want.scalar && !copy {
            return Ok(from);
        }
        let to = self.store.take_type(want)?;
        if to != NOWHERE {
            self.into(unit, source, want, to, context);
        }
        Ok(to)
    }

    /// Brings what is wired to a port to a place of its own.
    fn into(&mut self, unit: &'a Unit, source: &'a Source, want: Type, to: usize, context: &Context) {
        if let Source::Constant(value) = source {
            self.store.fills.push((to, Fill::Value(want.scalar, want.elements(), value)));
            return;
        }
        let (from, found) = self.wired(unit, source, context);
        if from == NOWHERE {
            return;
        }
        let bytes = self.store.type_bytes(want);
        self.plan.tape(Tape::Step).push(if found.scalar == want.scalar {
            Op::Copy { from, to, bytes }
        } else {
            Op::Convert { from, to }
        });
    }

    fn wired(&self, unit: &Unit, source: &Source, context: &Context) -> (usize, Type) {
        match source {
            Source::Signal(id) | Source::Copied(id) => (context.signals[id.0 as usize], unit.signal(*id).ty),
            Source::Element(id, element) => {
                let ty = Type { scalar: unit.signal(*id).ty.scalar, shape: Shape::Scalar };
                let offset = *element as usize * width_of(ty.scalar, self.program.width);
                (context.signals[id.0 as usize].saturating_add(offset), ty)
            }
            Source::Cell(id) => (self.cells[id.0 as usize], unit.cells[id.0 as usize].ty),
            Source::Own(index, scalar) => {
                let at = context.own.get(*index as usize).copied().unwrap_or(NOWHERE);
                (at, Type { scalar: *scalar, shape: Shape::Scalar })
            }
            Source::Constant(_) => (NOWHERE, Type { scalar: Scalar::Real, shape: Shape::Vector(0) }),
        }
    }

    /// Declared initial outputs reach variables with several writers: from the first that has one.
    fn publish(&mut self, body: &Body, main: bool) {
        let unit = self.program.unit(body.unit);
        for (i, signal) in unit.signals.iter().enumerate().filter(|(_, signal)| has_slot(signal)) {
            let writer = signal.writers.iter().find(|writer| {
                let started = !main || !initializes(self.program, writer.block);
                started && !writer.inout && starts(self.program, body.unit, **writer)
            });
            if let Some(writer) = writer {
                let from = body.nodes[writer.block.0 as usize].outputs[writer.output as usize];
                self.publish_one(from, body.signals[i], signal);
            }
        }
        for inner in body.nodes.iter().filter_map(|node| node.inner.as_ref()) {
            self.publish(inner, false);
        }
    }

    fn publish_one(&mut self, from: usize, to: usize, signal: &Signal) {
        if from != NOWHERE && to != NOWHERE && from != to {
            let bytes = self.store.type_bytes(signal.ty);
            self.plan.tape(Tape::Publish).push(Op::Copy { from, to, bytes });
        }
    }
}

/// The real inputs and the result of a code whose result tells of its fault.
fn judged(decl: &Decl, slots: &[Slot]) -> Vec<Slot> {
    if !kernel::faults_by_result(decl) {
        return Vec::new();
    }
    let real = |arg: &Arg| match arg {
        Arg::Port(i) => decl.ports().nth(*i).is_some_and(|port| port.ty == TypeExpr::Scalar(Scalar::Real)),
        _ => false,
    };
    let args = kernel::args(decl, Entry::Step);
    let inputs = args.iter().zip(slots).filter(|(arg, _)| real(arg)).map(|(_, slot)| *slot);
    inputs.chain(slots.last().copied()).collect()
}

fn largest_work(store: &Store) -> usize {
    let blocks = store.program.units.iter().flat_map(|unit| &unit.blocks);
    let work = blocks.map(|block| {
        let fields = &store.program.decl(block.decl).work;
        fields.iter().map(|field| store.field_bytes(field, &block.sizes).next_multiple_of(8)).sum()
    });
    work.max().unwrap_or(0)
}

fn initializes(program: &Program, block: BlockId) -> bool {
    let mut sections = program.sections.iter();
    sections.any(|section| section.kind == SectionKind::Initialize && (section.first..section.end).contains(&block.0))
}

/// Whether init sets an output of a block. A composite's stands where the block inside does, or in a slot.
fn starts(program: &Program, unit: UnitId, writer: Writer) -> bool {
    let block = program.unit(unit).block(writer.block);
    let decl = program.decl(block.decl);
    let Some(inner) = block.unit else {
        let output = pcl2_lang::model::output_decl(decl, &block.sizes, writer.output as usize);
        return output.is_some_and(|output| decl.start.contains(&output));
    };
    let Some(signal) = program.unit(inner).outputs.get(writer.output as usize) else {
        return false;
    };
    let signal = program.unit(inner).signal(*signal);
    has_slot(signal) || signal.writers.first().is_some_and(|writer| starts(program, inner, *writer))
}

/// Whether a block writes the signal that it reads, so that the read must come first.
fn writes(unit: &Unit, source: &Source, block: BlockId) -> bool {
    match source {
        Source::Signal(id) | Source::Element(id, _) => {
            unit.signal(*id).writers.iter().any(|writer| writer.block == block)
        }
        Source::Copied(_) => true,
        Source::Constant(_) | Source::Cell(_) | Source::Own(..) => false,
    }
}
