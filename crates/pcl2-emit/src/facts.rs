//! What the body of a composite needs from its caller: which parameters its functions take, scratch, period.

use crate::code::{Code, place_elements};
use crate::layout::UnitLayout;
use pcl2_lang::decl::{Decl, TypeExpr};
use pcl2_lang::kernel::{Arg, Entry};
use pcl2_lang::program::{Block, Param, Program, Source, Unit};
use pcl2_lang::types::{Scalar, Type};

/// The longest group of ports that is gathered on the stack.
const MAX_LITERAL: usize = 32;

/// Elements of scratch memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Scratch {
    /// Reals.
    pub(crate) real: usize,
    /// Ints.
    pub(crate) int: usize,
    /// Times.
    pub(crate) time: usize,
}

impl Scratch {
    /// The larger of both in each type.
    pub(crate) fn max(self, other: Scratch) -> Scratch {
        Scratch { real: self.real.max(other.real), int: self.int.max(other.int), time: self.time.max(other.time) }
    }

    /// One behind the other.
    pub(crate) fn plus(self, other: Scratch) -> Scratch {
        Scratch { real: self.real + other.real, int: self.int + other.int, time: self.time + other.time }
    }

    /// Room for more of one number type.
    pub(crate) fn add(&mut self, scalar: Scalar, elements: usize) {
        match scalar {
            Scalar::Real => self.real += elements,
            Scalar::Int => self.int += elements,
        }
    }
}

/// Which of a code's own parameters a function takes, and what else there is to know of it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Facts {
    /// By parameter: the step reads it, so it stays in the instance.
    pub(crate) hot: Vec<bool>,
    /// By parameter: the tune function takes it.
    pub(crate) tune: Vec<bool>,
    /// By parameter: the init function takes it.
    pub(crate) init: Vec<bool>,
    /// By parameter: the check function takes it.
    pub(crate) check: Vec<bool>,
    /// There is a tune function.
    pub(crate) tunes: bool,
    /// There is an init function.
    pub(crate) inits: bool,
    /// There is a check function.
    pub(crate) checks: bool,
    /// The instance has a status.
    pub(crate) status: bool,
    /// Tune needs the period.
    pub(crate) tune_period: bool,
    /// Check needs the period.
    pub(crate) check_period: bool,
    /// What a step needs.
    pub(crate) scratch: Scratch,
}

impl Facts {
    /// What a net has in any case: tokens at the start, faults, the period if it depends on time, and a tune that wakes it
    /// when a parameter changes.
    pub(crate) fn of_net(&mut self, timed: bool) {
        self.status = true;
        self.inits = true;
        self.tunes |= timed || self.hot.contains(&true);
        self.tune_period |= timed;
    }
}

/// The facts of a kernel, as far as parameters go.
pub(crate) fn of_kernel(code: &Code<'_>) -> Facts {
    let takes = |entry: Entry| {
        let takes = |i: usize| code.has(entry) && code.args(entry).contains(&Arg::Param(i));
        (0..code.decl.params.len()).map(takes).collect::<Vec<bool>>()
    };
    let ranged = has_ranges(code.decl);
    Facts {
        hot: takes(Entry::Step),
        tune: takes(Entry::Tune),
        init: takes(Entry::Init),
        check: vec![code.has(Entry::Check) || ranged; code.decl.params.len()],
        tunes: code.has(Entry::Tune),
        inits: code.has(Entry::Init),
        checks: code.has(Entry::Check) || ranged,
        status: !code.decl.faults.is_empty(),
        tune_period: code.decl.period && code.has(Entry::Tune),
        check_period: code.decl.period && code.has(Entry::Check),
        scratch: Scratch::default(),
    }
}

/// Whether a parameter of the code has a declared range or names.
pub(crate) fn has_ranges(decl: &Decl) -> bool {
    decl.params.iter().any(|param| param.tail.bounds.is_some() || !param.tail.names.is_empty())
}

/// The facts of a body, given those of all declarations and of the bodies after it.
pub(crate) fn of_body(
    program: &Program,
    unit: &Unit,
    codes: &[Code<'_>],
    known: &[UnitLayout<'_>],
    kernels: &[Facts],
) -> Facts {
    let params = unit.composite.as_ref().map_or(0, |(decl, _)| program.decl(*decl).params.len());
    let none = || vec![false; params];
    let mut facts = Facts { hot: none(), tune: none(), init: none(), check: none(), ..Facts::default() };
    for block in &unit.blocks {
        let code = &codes[block.decl.0 as usize];
        match block.unit {
            Some(inner) => add_body(&mut facts, block, code, &known[inner.0 as usize].facts),
            None => add_kernel(&mut facts, block, &kernels[block.decl.0 as usize]),
        }
        for source in &block.ports {
            if let Source::Own(own, _) = source {
                facts.hot[*own as usize] = true;
            }
        }
        let inner = block.unit.map_or_else(Scratch::default, |inner| known[inner.0 as usize].facts.scratch);
        facts.scratch = facts.scratch.max(of_block(unit, block, code, inner));
    }
    facts
}

fn add_kernel(facts: &mut Facts, block: &Block, kernel: &Facts) {
    let own = own_params(block);
    mark(&mut facts.hot, &own, &kernel.hot);
    mark(&mut facts.tune, &own, &kernel.tune);
    mark(&mut facts.init, &own, &kernel.init);
    if !own.is_empty() && kernel.checks {
        mark(&mut facts.check, &own, &kernel.check);
        facts.checks = true;
        facts.check_period |= kernel.check_period;
    }
    add_functions(facts, kernel);
}

fn add_body(facts: &mut Facts, block: &Block, code: &Code<'_>, inner: &Facts) {
    let own = own_params(block);
    let copied: Vec<(usize, usize)> = own.iter().copied().filter(|(i, _)| inner.hot[*i]).collect();
    mark(&mut facts.tune, &copied, &inner.hot);
    facts.tunes |= copied.iter().any(|(i, _)| !code.decl.params[*i].fixed);
    mark(&mut facts.tune, &own, &inner.tune);
    mark(&mut facts.init, &own, &inner.init);
    if !own.is_empty() && inner.checks {
        mark(&mut facts.check, &own, &inner.check);
        facts.checks = true;
        facts.check_period |= inner.check_period;
    }
    add_functions(facts, inner);
}

fn add_functions(facts: &mut Facts, inner: &Facts) {
    facts.tunes |= inner.tunes;
    facts.tune_period |= inner.tune_period;
    facts.inits |= inner.inits;
    facts.status |= inner.status;
}

/// Pairs of a block's parameter and the composite's own parameter that it is.
fn own_params(block: &Block) -> Vec<(usize, usize)> {
    let own = |(i, param): (usize, &Param)| match param {
        Param::Own(own) => Some((i, *own as usize)),
        Param::Value(_) => None,
    };
    block.params.iter().enumerate().filter_map(own).collect()
}

fn mark(facts: &mut [bool], own: &[(usize, usize)], takes: &[bool]) {
    for (inner, outer) in own {
        if takes[*inner] {
            facts[*outer] = true;
        }
    }
}

/// The scratch of one block's step: copies and gathered groups first, then what the kernel or body uses.
pub(crate) fn of_block(unit: &Unit, block: &Block, code: &Code<'_>, inner: Scratch) -> Scratch {
    let mut own = copies(unit, block);
    if block.unit.is_none() {
        own = own.plus(gathers(block, code)).plus(work(block, code));
    }
    own.plus(inner)
}

/// The scratch for copies of aliased ports.
pub(crate) fn copies(unit: &Unit, block: &Block) -> Scratch {
    let mut scratch = Scratch::default();
    for source in &block.ports {
        if let Source::Copied(id) = source {
            let ty = unit.signal(*id).ty;
            scratch.add(ty.scalar, ty.elements());
        }
    }
    scratch
}

/// The scratch for groups of ports that are too large for the stack.
pub(crate) fn gathers(block: &Block, code: &Code<'_>) -> Scratch {
    let mut scratch = Scratch::default();
    for (p, port) in code.ports.iter().enumerate().filter(|(_, port)| port.group.is_some()) {
        let (_, count) = code.port_range(p, &block.sizes);
        if !is_literal(block, code, p) {
            let scalar = element_scalar(&port.ty);
            scratch.add(scalar, count * place_elements(&port.ty, &block.sizes));
        }
    }
    scratch
}

/// Whether a group of ports is gathered in a compound literal.
pub(crate) fn is_literal(block: &Block, code: &Code<'_>, port: usize) -> bool {
    code.ports[port].ty.is_scalar() && code.port_range(port, &block.sizes).1 <= MAX_LITERAL
}

/// The scratch of the kernel's WORK clause.
pub(crate) fn work(block: &Block, code: &Code<'_>) -> Scratch {
    let mut scratch = Scratch::default();
    for field in &code.decl.work {
        let elements = place_elements(&field.ty, &block.sizes);
        match field.ty {
            TypeExpr::Time => scratch.time += 1,
            _ => scratch.add(element_scalar(&field.ty), elements),
        }
    }
    scratch
}

/// The number type of a declared place.
pub(crate) fn element_scalar(ty: &TypeExpr) -> Scalar {
    match ty {
        TypeExpr::Scalar(scalar) | TypeExpr::Vector(scalar, _) | TypeExpr::Matrix(scalar, ..) => *scalar,
        TypeExpr::Text | TypeExpr::Time => Type::INT.scalar,
    }
}
