//! The step of one block: its source line, copies, the call, and what follows it.

use crate::args::{Call, Caller, scratch_name};
use crate::context::Context;
use crate::expr::{self, Kind, Scope};
use crate::facts::{self, Scratch, element_scalar};
use crate::formula;
use crate::layout::{Store, writes_through};
use crate::net;
use crate::statics::Statics;
use crate::text;
use pcl2_lang::kernel::{self, Entry};
use pcl2_lang::program::{BlockId, CellId, Source, Tracked, UnitId};
use pcl2_lang::types::{Scalar, Type, Value};
use std::fmt::Write;

const INDENT: &str = "    ";

/// How a block tells of a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Telling {
    /// It has none.
    Never,
    /// By the status in its struct.
    Status,
    /// By its result: it is bad although no input is.
    Result,
}

/// Writes the step of one block. `raise` stands behind it where the block's result tells of a fault.
pub(crate) fn step(
    out: &mut String,
    cx: &Context<'_>,
    statics: &mut Statics,
    scope: Scope<'_>,
    id: BlockId,
    raise: &str,
) {
    let mut call = Call::new(cx, scope.unit, id, Caller::Step(scope), None);
    let statement = cx.sources.text(call.block().span);
    let fallback = &call.block().name;
    text::comment(out, INDENT, if statement.is_empty() { fallback } else { statement });
    prepare(out, &mut call, INDENT);
    match (telling(cx, scope.unit, id), call.block().unit) {
        (Telling::Result, _) => doubtful_call(out, statics, &call, raise),
        (Telling::Never | Telling::Status, Some(inner)) if net::is_top(cx, scope.unit, inner) => {
            net::top(out, statics, cx, scope, id);
        }
        (Telling::Never | Telling::Status, inner) => {
            out.push_str(INDENT);
            match inner {
                Some(inner) => body_call(out, statics, &call, inner),
                None => kernel_call(out, statics, &call),
            }
            out.push_str(";\n");
        }
    }
    publish(out, &call, INDENT, |_| true);
    if scope.unit.0 == 0 {
        track(out, &call, INDENT);
    }
}

/// How a block tells of a fault.
pub(crate) fn telling(cx: &Context<'_>, unit: UnitId, id: BlockId) -> Telling {
    let block = cx.program.unit(unit).block(id);
    let decl = cx.code(block.decl).decl;
    match block.unit {
        Some(inner) if cx.unit_layout(inner).facts.status => Telling::Status,
        None if kernel::faults_by_result(decl) => Telling::Result,
        None if !decl.faults.is_empty() => Telling::Status,
        Some(_) | None => Telling::Never,
    }
}

/// The status of a block, without its root.
pub(crate) fn status(out: &mut String, cx: &Context<'_>, scope: Scope<'_>, id: BlockId) {
    expr::state(out, cx, scope, id);
    out.push_str(".status");
}

/// Copies of ports that the call itself overwrites, and groups that are too large for the stack.
fn prepare(out: &mut String, call: &mut Call<'_, '_>, indent: &str) {
    let mut used = Scratch::default();
    for (i, source) in call.block().ports.iter().enumerate() {
        let Source::Copied(id) = source else {
            continue;
        };
        let ty = call.body().signal(*id).ty;
        let first = place(&mut used, ty.scalar, ty.elements());
        call.copies.push((i, first));
        copy(
            out,
            indent,
            ty,
            |out| call.scratch_pointer(out, scratch_name(ty.scalar), first),
            |out| {
                expr::signal_pointer(out, call.cx, call.scope(), *id);
            },
        );
    }
    if call.block().unit.is_none() {
        gather(out, call, &mut used, indent);
    }
    call.scratch = used;
}

fn place(used: &mut Scratch, scalar: Scalar, elements: usize) -> usize {
    let first = match scalar {
        Scalar::Real => used.real,
        Scalar::Int => used.int,
    };
    used.add(scalar, elements);
    first
}

/// `memcpy` of all elements of a signal.
fn copy(out: &mut String, indent: &str, ty: Type, to: impl FnOnce(&mut String), from: impl FnOnce(&mut String)) {
    out.push_str(indent);
    out.push_str("memcpy(");
    to(out);
    out.push_str(", ");
    from(out);
    let _ = writeln!(out, ", {} * sizeof({}));", ty.elements(), kernel::c_scalar(ty.scalar));
}

fn gather(out: &mut String, call: &mut Call<'_, '_>, used: &mut Scratch, indent: &str) {
    let (block, code) = (call.block(), call.code());
    for (p, port) in code.ports.iter().enumerate().filter(|(_, port)| port.group.is_some()) {
        let Some(ty) = crate::code::place_type(&port.ty, block).filter(|_| !facts::is_literal(block, code, p)) else {
            continue;
        };
        let (first, count) = code.port_range(p, &block.sizes);
        let scalar = element_scalar(&port.ty);
        let start = place(used, scalar, count * ty.elements());
        call.gathered.push((p, start));
        for (i, source) in block.ports[first..first + count].iter().enumerate() {
            gather_one(out, call, source, ty, start + i * ty.elements(), indent);
        }
    }
}

fn gather_one(out: &mut String, call: &Call<'_, '_>, source: &Source, ty: Type, at: usize, indent: &str) {
    let name = scratch_name(ty.scalar);
    let root = call.scratch_root();
    if ty.is_scalar() {
        let _ = write!(out, "{indent}{root}{name}[{at}] = ");
        expr::source_value(out, call.cx, call.scope(), source, ty.scalar);
        out.push_str(";\n");
        return;
    }
    match source {
        Source::Signal(id) | Source::Copied(id) | Source::Element(id, _) => {
            copy(
                out,
                indent,
                ty,
                |out| call.scratch_pointer(out, name, at),
                |out| {
                    expr::signal_pointer(out, call.cx, call.scope(), *id);
                },
            );
        }
        Source::Constant(value) => {
            for element in 0..ty.elements() {
                let _ = write!(out, "{indent}{root}{name}[{}] = ", at + element);
                text::element(out, value, element, ty.scalar, call.cx.program.width);
                out.push_str(";\n");
            }
        }
        // Own parameters on wires are scalars.
        Source::Own(..) => {}
        Source::Cell(cell) => {
            copy(
                out,
                indent,
                ty,
                |out| call.scratch_pointer(out, name, at),
                |out| {
                    expr::cell(out, call.cx, call.scope(), *cell);
                },
            );
        }
    }
}

fn kernel_call(out: &mut String, statics: &mut Statics, call: &Call<'_, '_>) {
    if call.code().returns {
        destination(out, call);
        out.push_str(" = ");
    }
    match &call.code().decl.formula {
        Some(formula) => formula::value(out, statics, call, formula),
        None => call.kernel(out, statics, Entry::Step),
    }
}

/// The call of a code whose result tells of a fault, and the test of the result.
fn doubtful_call(out: &mut String, statics: &mut Statics, call: &Call<'_, '_>, raise: &str) {
    let leaves = doubtful(call);
    let signal = call.block().outputs[0];
    let overwritten = leaves.iter().any(|leaf| matches!(leaf, Source::Signal(id) if *id == signal));
    let indent = if overwritten { "        " } else { INDENT };
    if overwritten {
        out.push_str("    {\n        const int32_t bad = ");
        bad_leaf(out, call, &leaves);
        out.push_str(";\n");
    }
    out.push_str(indent);
    kernel_call(out, statics, call);
    let _ = write!(out, ";\n{indent}if (PCL2_RARELY(pcl2_is_bad(");
    expr::signal_value(out, call.cx, call.scope(), signal, 0);
    out.push(')');
    if overwritten {
        out.push_str(" && !bad");
    } else if let [leaf] = leaves.as_slice() {
        out.push_str(" && !");
        bad_leaf(out, call, std::slice::from_ref(leaf));
    } else if !leaves.is_empty() {
        out.push_str(" && !(");
        bad_leaf(out, call, &leaves);
        out.push(')');
    }
    let _ = writeln!(out, ")) {{\n{indent}    {raise}\n{indent}}}");
    if overwritten {
        out.push_str("    }\n");
    }
}

/// What a block reads that can be bad, each once.
fn doubtful<'a>(call: &Call<'_, 'a>) -> Vec<&'a Source> {
    let mut leaves: Vec<&Source> = Vec::new();
    for source in &call.block().ports {
        let real = match source {
            Source::Signal(id) | Source::Copied(id) | Source::Element(id, _) => {
                call.body().signal(*id).ty.scalar == Scalar::Real
            }
            Source::Cell(id) => call.body().cells[id.0 as usize].ty.scalar == Scalar::Real,
            Source::Constant(value) => matches!(value, Value::Real(real) if !real.wide.is_finite()),
            Source::Own(_, scalar) => *scalar == Scalar::Real,
        };
        if real && !leaves.contains(&source) {
            leaves.push(source);
        }
    }
    leaves
}

/// `pcl2_is_bad(a) || pcl2_is_bad(b)`
fn bad_leaf(out: &mut String, call: &Call<'_, '_>, leaves: &[&Source]) {
    for (i, leaf) in leaves.iter().enumerate() {
        out.push_str(if i == 0 { "pcl2_is_bad(" } else { " || pcl2_is_bad(" });
        expr::source_value(out, call.cx, call.scope(), leaf, Scalar::Real);
        out.push(')');
    }
}

/// What takes the value that an inline code returns.
fn destination(out: &mut String, call: &Call<'_, '_>) {
    let signal = call.block().outputs[0];
    let store = call.cx.unit_layout(call.unit).stores[signal.0 as usize];
    if let Store::Local(_) = store {
        let _ = write!(out, "const {} ", kernel::c_element(&call.code().decl.outputs[0].ty));
    }
    expr::signal_value(out, call.cx, call.scope(), signal, 0);
}

fn body_call(out: &mut String, statics: &mut Statics, call: &Call<'_, '_>, inner: UnitId) {
    let layout = call.cx.unit_layout(inner);
    let _ = write!(out, "{}(&", layout.tag);
    expr::block(out, call.cx, call.scope(), call.id);
    for (i, (_, ty)) in layout.ports.iter().enumerate() {
        out.push_str(", ");
        call.source(out, statics, i, *ty);
    }
    let scratch = layout.facts.scratch;
    for (name, size, first) in [
        ("work", scratch.real, call.scratch.real),
        ("iwork", scratch.int, call.scratch.int),
        ("twork", scratch.time, call.scratch.time),
    ] {
        if size > 0 {
            out.push_str(", ");
            call.scratch_pointer(out, name, first);
        }
    }
    out.push(')');
}

/// Copies the outputs of a block among several writers to their signals' own places.
pub(crate) fn publish(out: &mut String, call: &Call<'_, '_>, indent: &str, wanted: impl Fn(usize) -> bool) {
    let (block, code) = (call.block(), call.code());
    let stores = &call.cx.unit_layout(call.unit).stores;
    for (i, signal) in block.outputs.iter().enumerate() {
        let own = match stores[signal.0 as usize] {
            Store::Own(..) | Store::Local(_) | Store::Port(_) => true,
            Store::Slot(_) | Store::Input(_) => false,
        };
        if own || !wanted(i) || (block.unit.is_none() && writes_through(code, code.output(i, &block.sizes).0)) {
            continue;
        }
        let ty = call.body().signal(*signal).ty;
        let from = |out: &mut String| expr::own_output(out, call.cx, call.scope(), call.id, i as u32);
        assign(out, indent, ty, |out| expr::signal_base(out, call.cx, call.scope(), *signal), from);
    }
}

/// `to = from`, element by element or as a whole.
pub(crate) fn assign(
    out: &mut String,
    indent: &str,
    ty: Type,
    to: impl Fn(&mut String) -> Kind,
    from: impl Fn(&mut String) -> Kind,
) {
    if ty.elements() == 0 {
        return;
    }
    if !ty.is_scalar() {
        copy(out, indent, ty, |out| expr::pointer(out, to), |out| expr::pointer(out, from));
        return;
    }
    out.push_str(indent);
    let kind = to(out);
    scalar(out, kind);
    out.push_str(" = ");
    let kind = from(out);
    scalar(out, kind);
    out.push_str(";\n");
}

fn scalar(out: &mut String, kind: Kind) {
    if let Kind::Array(first) = kind {
        let _ = write!(out, "[{first}]");
    }
}

/// Operator cells that follow the block.
fn track(out: &mut String, call: &Call<'_, '_>, indent: &str) {
    let tracking = &call.cx.layout.tracking;
    let first = tracking.partition_point(|(block, _)| *block < call.id.0);
    for (_, cell) in tracking[first..].iter().take_while(|(block, _)| *block == call.id.0) {
        let known = &call.body().cells[*cell as usize];
        let Some(tracked) = known.tracks else {
            continue;
        };
        let to = |out: &mut String| {
            expr::cell(out, call.cx, call.scope(), CellId(*cell));
            if known.ty.is_scalar() { Kind::Scalar } else { Kind::Array(0) }
        };
        assign(out, indent, known.ty, to, |out| followed(out, call, tracked));
    }
}

fn followed(out: &mut String, call: &Call<'_, '_>, tracked: Tracked) -> Kind {
    match tracked {
        Tracked::Output(output) => {
            let (declared, _) = call.code().output(output as usize, &call.block().sizes);
            if call.block().unit.is_none() && writes_through(call.code(), declared) {
                expr::signal_base(out, call.cx, call.scope(), call.block().outputs[output as usize])
            } else {
                expr::own_output(out, call.cx, call.scope(), call.id, output)
            }
        }
        Tracked::Memory(field) => {
            let shape = call.cx.shape_of(call.unit, call.id);
            match shape.memory.get(field as usize).copied().flatten() {
                Some(index) => expr::field(out, call.cx, call.scope(), call.id, index),
                None => {
                    expr::state(out, call.cx, call.scope(), call.id);
                    let name = call.code().decl.memory.get(field as usize).map_or("", |field| &field.name);
                    let _ = write!(out, ".{name}");
                    Kind::Scalar
                }
            }
        }
    }
}
