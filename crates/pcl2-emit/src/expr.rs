//! C expressions for signals, cells, parameters and scratch.

use crate::context::Context;
use crate::layout::{Store, WHOLE};
use crate::shape::{Form, Shape};
use crate::statics::Statics;
use crate::text;
use pcl2_lang::kernel;
use pcl2_lang::program::{BlockId, CellId, Param, Role, SignalId, Source, UnitId};
use pcl2_lang::types::{Scalar, Type, Value};
use std::fmt::Write;

/// From where an expression is seen.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scope<'s> {
    /// The body whose signals and blocks are meant.
    pub(crate) unit: UnitId,
    /// What stands before a member: `self->`, or nothing in an `offsetof`.
    pub(crate) root: &'s str,
    /// The part whose pointer is at hand as `part`, or [`WHOLE`].
    pub(crate) part: u32,
}

impl Scope<'_> {
    /// The members of the program's own struct, as in `offsetof`.
    pub(crate) const MEMBERS: Scope<'static> = Scope { unit: UnitId(0), root: "", part: WHOLE };

    /// Inside a function over the whole instance.
    pub(crate) fn of(unit: UnitId) -> Scope<'static> {
        Scope { unit, root: "self->", part: WHOLE }
    }
}

/// What an expression stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// One number.
    Scalar,
    /// The array from this element on.
    Array(usize),
}

fn prefix(out: &mut String, cx: &Context<'_>, scope: Scope<'_>, part: u32) {
    if part == WHOLE {
        out.push_str(scope.root);
    } else if part == scope.part {
        out.push_str("part->");
    } else {
        out.extend([scope.root, &cx.layout.part_names[part as usize], "."]);
    }
}

/// A block's instance.
pub(crate) fn block(out: &mut String, cx: &Context<'_>, scope: Scope<'_>, block: BlockId) {
    let member = &cx.unit_layout(scope.unit).members[block.0 as usize];
    prefix(out, cx, scope, member.part);
    out.push_str(&member.name);
}

/// The kernel's struct in a block's instance.
pub(crate) fn state(out: &mut String, cx: &Context<'_>, scope: Scope<'_>, id: BlockId) {
    block(out, cx, scope, id);
    push_state(out, cx.shape_of(scope.unit, id));
}

/// `.s` behind an instance that is more than the kernel's struct.
pub(crate) fn push_state(out: &mut String, shape: &Shape) {
    if let (Form::Struct, Some(state)) = (shape.form, &shape.state) {
        out.push('.');
        out.push_str(state);
    }
}

/// A field of a block's instance.
pub(crate) fn field(out: &mut String, cx: &Context<'_>, scope: Scope<'_>, id: BlockId, index: usize) -> Kind {
    block(out, cx, scope, id);
    let shape = cx.shape_of(scope.unit, id);
    let field = &shape.fields[index];
    if shape.form == Form::Struct {
        out.push('.');
        out.push_str(&field.name);
    }
    if field.count.is_some() { Kind::Array(0) } else { Kind::Scalar }
}

/// A block's own output.
pub(crate) fn own_output(out: &mut String, cx: &Context<'_>, scope: Scope<'_>, id: BlockId, expanded: u32) -> Kind {
    let called = cx.program.unit(scope.unit).block(id);
    if let Some(inner) = called.unit {
        block(out, cx, scope, id);
        out.push('.');
        let signal = cx.program.unit(inner).outputs[expanded as usize];
        return signal_base(out, cx, Scope { unit: inner, root: "", part: WHOLE }, signal);
    }
    let code = cx.code(called.decl);
    let (declared, place) = code.output(expanded as usize, &called.sizes);
    let shape = cx.shape_of(scope.unit, id);
    let Some(index) = shape.outputs[declared] else {
        state(out, cx, scope, id);
        out.push('.');
        out.push_str(&code.decl.outputs[declared].name);
        return Kind::Scalar;
    };
    match field(out, cx, scope, id, index) {
        Kind::Scalar => Kind::Scalar,
        Kind::Array(_) => {
            let each = kernel::resolve(&code.decl.outputs[declared].ty, &called.sizes).map_or(1, Type::elements);
            Kind::Array(place * each)
        }
    }
}

/// A signal, without the index of an element.
pub(crate) fn signal_base(out: &mut String, cx: &Context<'_>, scope: Scope<'_>, signal: SignalId) -> Kind {
    let layout = cx.unit_layout(scope.unit);
    let ty = cx.program.unit(scope.unit).signal(signal).ty;
    let kind = if ty.is_scalar() { Kind::Scalar } else { Kind::Array(0) };
    match layout.stores[signal.0 as usize] {
        Store::Own(block, output) => return own_output(out, cx, scope, BlockId(block), output),
        Store::Slot(slot) => {
            let slot = &layout.slots[slot as usize];
            prefix(out, cx, scope, slot.part);
            out.push_str(&slot.name);
        }
        Store::Input(input) => {
            let _ = write!(out, "{}in.{}", scope.root, cx.layout.border.inputs[input as usize].0);
        }
        Store::Port(port) => out.push_str(&layout.ports[port as usize].0),
        Store::Local(block) => out.push_str(&layout.members[block as usize].name),
    }
    kind
}

/// The value of a scalar signal, or of one element.
pub(crate) fn signal_value(out: &mut String, cx: &Context<'_>, scope: Scope<'_>, signal: SignalId, element: u32) {
    match signal_base(out, cx, scope, signal) {
        Kind::Scalar => {}
        Kind::Array(first) => {
            let _ = write!(out, "[{}]", first + element as usize);
        }
    }
}

/// The enumerator of an element of the tokens of a net's boxes, in the net itself.
fn box_name<'c>(cx: &'c Context<'_>, scope: Scope<'_>, signal: SignalId, element: u32) -> Option<&'c str> {
    let net = cx.unit_layout(scope.unit).net.as_ref()?;
    let held = &cx.program.unit(scope.unit).signal(signal);
    let tokens = held.role == Role::Held && !held.ty.is_scalar();
    net.boxes.get(element as usize).filter(|_| tokens).map(String::as_str)
}

/// A pointer to the first element of something whose base `write` writes.
pub(crate) fn pointer(out: &mut String, write: impl FnOnce(&mut String) -> Kind) {
    let start = out.len();
    match write(out) {
        Kind::Array(0) => {}
        Kind::Scalar => out.insert(start, '&'),
        Kind::Array(first) => {
            out.insert(start, '&');
            let _ = write!(out, "[{first}]");
        }
    }
}

/// A pointer to a signal.
pub(crate) fn signal_pointer(out: &mut String, cx: &Context<'_>, scope: Scope<'_>, signal: SignalId) {
    pointer(out, |out| signal_base(out, cx, scope, signal));
}

/// An operator cell.
pub(crate) fn cell(out: &mut String, cx: &Context<'_>, scope: Scope<'_>, cell: CellId) {
    out.extend([scope.root, "cold.", &cx.layout.cell_names[cell.0 as usize]]);
}

/// The value wired to a scalar port of this number type.
pub(crate) fn source_value(out: &mut String, cx: &Context<'_>, scope: Scope<'_>, source: &Source, want: Scalar) {
    let unit = cx.program.unit(scope.unit);
    let convert = |out: &mut String, found: Scalar| {
        if (found, want) == (Scalar::Int, Scalar::Real) {
            out.push_str("(pcl2_real)");
        }
    };
    match source {
        Source::Signal(id) | Source::Copied(id) => {
            convert(out, unit.signal(*id).ty.scalar);
            signal_value(out, cx, scope, *id, 0);
        }
        Source::Element(id, element) => {
            convert(out, unit.signal(*id).ty.scalar);
            match box_name(cx, scope, *id, *element) {
                Some(name) => {
                    signal_base(out, cx, scope, *id);
                    out.extend(["[", name, "]"]);
                }
                None => signal_value(out, cx, scope, *id, *element),
            }
        }
        Source::Constant(value) => text::element(out, value, 0, want, cx.program.width),
        Source::Cell(id) => {
            convert(out, unit.cells[id.0 as usize].ty.scalar);
            cell(out, cx, scope, *id);
        }
        Source::Own(own, found) => {
            convert(out, *found);
            out.extend([scope.root, &cx.unit_layout(scope.unit).params[*own as usize]]);
        }
    }
}

/// A value as an argument: a literal, or a constant array.
pub(crate) fn constant(out: &mut String, cx: &Context<'_>, statics: &mut Statics, value: &Value, place: Place) {
    match value {
        Value::Text(text) => text::string(out, text),
        Value::Int(_) | Value::Real(_) | Value::Ints(_) | Value::Reals(_) => match place.elements {
            None => text::element(out, value, 0, place.scalar, cx.program.width),
            Some(0) => out.push_str("NULL"),
            Some(count) => out.push_str(&statics.array(value, count, place.scalar, cx.program.width)),
        },
    }
}

/// The type of the place of an argument.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// The number type.
    pub(crate) scalar: Scalar,
    /// `None` for a single number passed by value.
    pub(crate) elements: Option<usize>,
}

/// The name of a composite's own parameter that stands for a block's parameter.
pub(crate) fn own_param<'c>(cx: &'c Context<'_>, unit: UnitId, param: &Param) -> Option<&'c str> {
    match param {
        Param::Own(own) => Some(&cx.unit_layout(unit).params[*own as usize]),
        Param::Value(_) => None,
    }
}
