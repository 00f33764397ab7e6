//! The gate between front ends and back ends.
//!
//! A [`Verified`] program keeps what back ends rely on: every index is in range, every size is filled in and
//! bounded, every port carries a type that its declaration accepts. A front end that lets something else
//! through is a defect of ours, reported as [`Defect`] and never as a panic.

use crate::decl::{Decl, Step, TypeExpr};
use crate::kernel;
use crate::net::Net;
use crate::program::{Block, Param, Program, SectionKind, SignalId, Source, Unit};
use crate::types::{Scalar, Type, Value};
use std::fmt;

/// A program's largest size in bytes.
pub const MAX_PROGRAM: u64 = 1 << 30;

/// A program that passed the verifier. Only [`verify`] makes one.
#[derive(Clone, Debug)]
pub struct Verified(Program);

impl Verified {
    /// The program.
    pub fn program(&self) -> &Program {
        &self.0
    }
}

/// What a front end let through and should not have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Defect(pub String);

impl fmt::Display for Defect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0)
    }
}

type Check = Result<(), Defect>;

/// Seals a program.
pub fn verify(program: Program) -> Result<Verified, Defect> {
    require(!program.units.is_empty(), || "a program has no body".to_owned())?;
    require(program.substeps >= 1, || "substeps must be at least 1".to_owned())?;
    for (u, unit) in program.units.iter().enumerate() {
        verify_unit(&program, unit, u)?;
    }
    for decl in &program.decls {
        verify_formula(&program, decl).map_err(|d| Defect(format!("{}: {d}", decl.name)))?;
    }
    verify_sections(&program)?;
    require(bytes(&program).is_some_and(|bytes| bytes <= MAX_PROGRAM), || "the program is too large".to_owned())?;
    Ok(Verified(program))
}

fn require(holds: bool, message: impl FnOnce() -> String) -> Check {
    if holds { Ok(()) } else { Err(Defect(message())) }
}

fn verify_sections(program: &Program) -> Check {
    let mut next = 0;
    for section in &program.sections {
        require(section.first == next && section.end >= section.first, || {
            "sections do not tile the blocks".to_owned()
        })?;
        next = section.end;
        if let SectionKind::Control { every, offset } = section.kind {
            require(every >= 1 && offset < every, || "a section's rate is out of range".to_owned())?;
        }
    }
    require(next as usize == program.main().blocks.len(), || "sections do not cover the blocks".to_owned())
}

/// An expression takes every port once and leaves one result; its codes are OPERATORs without an expression of theirs.
fn verify_formula(program: &Program, decl: &Decl) -> Check {
    let Some(formula) = &decl.formula else {
        return Ok(());
    };
    let mut ports = decl.port_scalars();
    let mut results: Vec<Scalar> = Vec::new();
    for step in formula {
        let result = match step {
            Step::Port => ports.next().ok_or_else(|| Defect("an operand is missing".to_owned()))?,
            Step::Apply(id) => {
                let code = program.decls.get(id.0 as usize).filter(|code| code.operator.is_some() && code.has_kernel());
                let Some(code) = code else {
                    return Err(Defect("an operator does not exist".to_owned()));
                };
                let wanted: Vec<Scalar> = code.port_scalars().collect();
                let rest = results.len().checked_sub(wanted.len());
                let rest = rest.ok_or_else(|| Defect("an operator has too few operands".to_owned()))?;
                let fits =
                    results.drain(rest..).zip(&wanted).all(|(found, want)| found == *want || found == Scalar::Int);
                require(fits, || format!("an operand of {} has the wrong type", code.name))?;
                result_of(code)?
            }
        };
        results.push(result);
    }
    require(ports.next().is_none(), || "an operand too many".to_owned())?;
    require(results == [result_of(decl)?], || "it has another result".to_owned())
}

fn result_of(decl: &Decl) -> Result<Scalar, Defect> {
    match decl.outputs.as_slice() {
        [output] => resolve(&output.ty, &[]).map(|ty| ty.scalar),
        _ => Err(Defect("it has not one output".to_owned())),
    }
}

fn verify_unit(program: &Program, unit: &Unit, index: usize) -> Check {
    for signal in &unit.signals {
        for writer in &signal.writers {
            let output = unit.blocks.get(writer.block.0 as usize).and_then(|b| b.outputs.get(writer.output as usize));
            require(output.is_some(), || format!("signal {} has a writer that does not exist", signal.name))?;
        }
    }
    for block in &unit.blocks {
        verify_block(program, unit, index, block).map_err(|d| Defect(format!("block {}: {d}", block.number)))?;
    }
    for cell in &unit.cells {
        require((cell.block.0 as usize) < unit.blocks.len(), || format!("cell {} has no block", cell.name))?;
    }
    Ok(())
}

fn verify_block(program: &Program, unit: &Unit, index: usize, block: &Block) -> Check {
    let Some(decl) = program.decls.get(block.decl.0 as usize) else {
        return Err(Defect("its declaration does not exist".to_owned()));
    };
    require(block.sizes.len() == decl.sizes.len(), || "a size is missing".to_owned())?;
    require(decl.is_composite() == block.unit.is_some(), || "its body is missing".to_owned())?;
    if let Some(inner) = block.unit {
        let below = inner.0 as usize > index && (inner.0 as usize) < program.units.len();
        require(below, || "its body does not come after it".to_owned())?;
    }
    require(decl.image.is_some() == block.image.is_some(), || "its image word is missing".to_owned())?;
    verify_ports(unit, block, decl)?;
    verify_own(program, unit, block)?;
    verify_params(program, unit, block, decl)?;
    verify_outputs(unit, block, decl)
}

fn verify_ports(unit: &Unit, block: &Block, decl: &Decl) -> Check {
    let mut sources = block.ports.iter();
    for port in decl.ports() {
        let count = kernel::count(port.group.as_ref(), &block.sizes).unwrap_or(usize::MAX);
        let want = resolve(&port.ty, &block.sizes)?;
        for _ in 0..count {
            let Some(source) = sources.next() else {
                return Err(Defect(format!("port {} is missing", port.name)));
            };
            let found = source_type(unit, source)?;
            require(fits(found, want), || format!("port {} needs {want}, gets {found}", port.name))?;
        }
    }
    require(sources.next().is_none(), || "a port too many".to_owned())
}

/// Own parameters on wires are scalars of the composite around.
fn verify_own(program: &Program, unit: &Unit, block: &Block) -> Check {
    let outer = unit.composite.as_ref().and_then(|(id, _)| program.decls.get(id.0 as usize));
    let known = |source: &Source| match source {
        Source::Own(own, scalar) => {
            let param = outer.and_then(|outer| outer.params.get(*own as usize));
            param.is_some_and(|param| param.ty == TypeExpr::Scalar(*scalar))
        }
        Source::Signal(_) | Source::Copied(_) | Source::Element(..) | Source::Constant(_) | Source::Cell(_) => true,
    };
    require(block.ports.iter().all(known), || "a port refers to no parameter".to_owned())
}

fn verify_params(program: &Program, unit: &Unit, block: &Block, decl: &Decl) -> Check {
    require(block.params.len() == decl.params.len(), || "a parameter is missing".to_owned())?;
    for (param, place) in block.params.iter().zip(&decl.params) {
        let value = match param {
            Param::Value(value) => value,
            Param::Own(own) => {
                let outer = unit.composite.as_ref().and_then(|(id, _)| program.decls.get(id.0 as usize));
                let known = outer.is_some_and(|outer| (*own as usize) < outer.params.len());
                require(known, || format!("parameter {} refers to nothing", place.name))?;
                continue;
            }
        };
        if place.ty == TypeExpr::Text {
            require(matches!(value, Value::Text(_)), || format!("parameter {} needs text", place.name))?;
            continue;
        }
        let want = resolve(&place.ty, &block.sizes)?;
        let elements = match value {
            Value::Int(_) | Value::Real(_) => 1,
            Value::Ints(values) => values.len(),
            Value::Reals(values) => values.len(),
            Value::Text(_) => 0,
        };
        require(elements == want.elements(), || format!("parameter {} has the wrong number of values", place.name))?;
    }
    Ok(())
}

fn verify_outputs(unit: &Unit, block: &Block, decl: &Decl) -> Check {
    let mut outputs = block.outputs.iter();
    for output in &decl.outputs {
        let want = resolve(&output.ty, &block.sizes)?;
        for _ in 0..kernel::count(output.group.as_ref(), &block.sizes).unwrap_or(usize::MAX) {
            let Some(signal) = outputs.next().and_then(|id| unit.signals.get(id.0 as usize)) else {
                return Err(Defect(format!("output {} is missing", output.name)));
            };
            require(signal.ty == want, || format!("output {} is {want}, its signal {}", output.name, signal.ty))?;
        }
    }
    require(outputs.next().is_none(), || "an output too many".to_owned())
}

fn resolve(ty: &TypeExpr, sizes: &[i32]) -> Result<Type, Defect> {
    kernel::resolve(ty, sizes).ok_or_else(|| Defect("a size is out of range".to_owned()))
}

fn source_type(unit: &Unit, source: &Source) -> Result<Type, Defect> {
    let signal = |id: &SignalId| {
        unit.signals
            .get(id.0 as usize)
            .map(|signal| signal.ty)
            .ok_or_else(|| Defect("a signal does not exist".to_owned()))
    };
    match source {
        Source::Signal(id) | Source::Copied(id) => signal(id),
        Source::Element(id, element) => {
            let ty = signal(id)?;
            require((*element as usize) < ty.elements(), || "an element does not exist".to_owned())?;
            Ok(Type { scalar: ty.scalar, shape: crate::types::Shape::Scalar })
        }
        Source::Constant(value) => Ok(value_type(value)),
        Source::Own(_, scalar) => Ok(Type { scalar: *scalar, shape: crate::types::Shape::Scalar }),
        Source::Cell(id) => {
            unit.cells.get(id.0 as usize).map(|cell| cell.ty).ok_or_else(|| Defect("a cell does not exist".to_owned()))
        }
    }
}

fn value_type(value: &Value) -> Type {
    use crate::types::Shape;
    match value {
        Value::Int(_) | Value::Text(_) => Type::INT,
        Value::Real(_) => Type::REAL,
        Value::Ints(values) => Type { scalar: Scalar::Int, shape: Shape::Vector(values.len() as u32) },
        Value::Reals(values) => Type { scalar: Scalar::Real, shape: Shape::Vector(values.len() as u32) },
    }
}

/// Whether a signal of type `found` may be wired to a port of type `want`:
/// a scalar int fits a real port, and `vec[n]` and `mat[n,1]` are the same.
pub fn fits(found: Type, want: Type) -> bool {
    let scalar_int_to_real = found == Type::INT && want == Type::REAL;
    let same = found.scalar == want.scalar && found.rows_columns() == want.rows_columns();
    let both_scalar = found.is_scalar() == want.is_scalar();
    scalar_int_to_real || (same && both_scalar)
}

/// The bytes of all variables, parameters and memory; `None` on overflow.
pub fn bytes(program: &Program) -> Option<u64> {
    let mut units: Vec<u64> = vec![0; program.units.len()];
    for u in (0..program.units.len()).rev() {
        let unit = &program.units[u];
        let net = unit.composite.as_ref().and_then(|(decl, _)| program.decls.get(decl.0 as usize)?.net.as_deref());
        let mut total: u64 = net.map_or(0, net_bytes);
        for block in &unit.blocks {
            let inner = block.unit.and_then(|inner| units.get(inner.0 as usize).copied()).unwrap_or(0);
            total = total.checked_add(inner)?.checked_add(block_bytes(program, block)?)?;
        }
        units[u] = total;
    }
    units.first().copied()
}

/// The bytes of what a net keeps: attributes, and of each box its tokens, its state and its time.
fn net_bytes(net: &Net) -> u64 {
    8 * (net.attribute_places() + 8 * net.boxes.len() as u64 + 2 * net.words.len() as u64)
}

fn block_bytes(program: &Program, block: &Block) -> Option<u64> {
    declared_bytes(program.decl(block.decl), &block.sizes)
}

/// The bytes of the variables, parameters and memory of one block; `None` on overflow.
pub fn declared_bytes(decl: &Decl, sizes: &[i32]) -> Option<u64> {
    let mut elements: u64 = 0;
    for field in decl.memory.iter().chain(&decl.tuned).chain(&decl.work) {
        elements = elements.checked_add(kernel::field_elements(field, sizes)? as u64)?;
    }
    for output in &decl.outputs {
        let count = kernel::count(output.group.as_ref(), sizes)? as u64;
        let each = kernel::resolve(&output.ty, sizes)?.elements() as u64;
        elements = elements.checked_add(count.checked_mul(each)?)?;
    }
    for param in &decl.params {
        let each = kernel::resolve(&param.ty, sizes).map_or(0, Type::elements);
        elements = elements.checked_add(each as u64)?;
    }
    elements.checked_mul(8)
}
