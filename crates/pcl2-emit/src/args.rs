//! The arguments of one call of a kernel.

use crate::code::{Code, place_elements};
use crate::context::Context;
use crate::expr::{self, Kind, Place, Scope};
use crate::facts::{self, Scratch, element_scalar};
use crate::layout::known_value;
use crate::shape::{Form, Shape};
use crate::statics::Statics;
use crate::text;
use pcl2_lang::decl::{Direction, ParamDecl, TypeExpr};
use pcl2_lang::kernel::{Arg, Entry};
use pcl2_lang::model;
use pcl2_lang::program::{Block, BlockId, Param, Source, Unit, UnitId};
use pcl2_lang::types::{Scalar, Type};
use std::fmt::Write;

/// From where a call sees the block's instance and parameters.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Caller<'s> {
    /// The body's step: ports and what stays in RAM.
    Step(Scope<'s>),
    /// An init function of the program: parameters have their first values.
    Init(Scope<'s>),
    /// A composite's tune, init or check: its own parameters are arguments.
    Body(Scope<'s>),
    /// An adapter: `self` points to the instance, `cold` to the parameters that only tune reads.
    Adapter,
}

/// One call in the making.
pub(crate) struct Call<'c, 'a> {
    /// What is known.
    pub(crate) cx: &'c Context<'a>,
    /// The body that the block stands in.
    pub(crate) unit: UnitId,
    /// The block.
    pub(crate) id: BlockId,
    /// Who calls.
    pub(crate) caller: Caller<'c>,
    /// The section's period.
    pub(crate) period: Option<i64>,
    /// Where copies of ports stand in scratch: expanded port and first element.
    pub(crate) copies: Vec<(usize, usize)>,
    /// Where gathered groups stand in scratch: declared port and first element.
    pub(crate) gathered: Vec<(usize, usize)>,
    /// Where the scratch of the kernel begins.
    pub(crate) scratch: Scratch,
}

impl<'c, 'a> Call<'c, 'a> {
    /// A call without copies.
    pub(crate) fn new(cx: &'c Context<'a>, unit: UnitId, id: BlockId, caller: Caller<'c>, period: Option<i64>) -> Self {
        Call { cx, unit, id, caller, period, copies: Vec::new(), gathered: Vec::new(), scratch: Scratch::default() }
    }

    /// The block.
    pub(crate) fn block(&self) -> &'a Block {
        self.cx.program.unit(self.unit).block(self.id)
    }

    /// Its body.
    pub(crate) fn body(&self) -> &'a Unit {
        self.cx.program.unit(self.unit)
    }

    /// Its function code.
    pub(crate) fn code(&self) -> &'c Code<'a> {
        self.cx.code(self.block().decl)
    }

    fn shape(&self) -> &'c Shape {
        self.cx.shape_of(self.unit, self.id)
    }

    /// The scope of the caller's expressions.
    pub(crate) fn scope(&self) -> Scope<'c> {
        match self.caller {
            Caller::Step(scope) | Caller::Init(scope) | Caller::Body(scope) => scope,
            Caller::Adapter => Scope::of(self.unit),
        }
    }

    /// `name(arguments)`
    pub(crate) fn kernel(&self, out: &mut String, statics: &mut Statics, entry: Entry) {
        out.push_str(self.code().name(entry));
        out.push('(');
        for (i, arg) in self.code().args(entry).iter().enumerate() {
            if i > 0 {
                out.push_str(", ");
            }
            self.arg(out, statics, *arg);
        }
        out.push(')');
    }

    fn arg(&self, out: &mut String, statics: &mut Statics, arg: Arg) {
        match arg {
            Arg::Instance => self.state_pointer(out),
            Arg::Size(i) => text::int(out, self.block().sizes[i]),
            Arg::Port(i) => self.port(out, statics, i),
            Arg::Param(i) => self.param(out, statics, i),
            Arg::Memory(i) => self.array_field(out, self.shape().memory[i]),
            Arg::Tuned(i) => self.array_field(out, self.shape().tuned[i]),
            Arg::Work(i) => self.work(out, i),
            Arg::Image => self.image(out),
            Arg::Fail => self.fail(out),
            Arg::Output(i) => self.output(out, i),
            Arg::Period => {
                let _ = match self.caller {
                    Caller::Body(_) => write!(out, "T"),
                    _ => write!(out, "INT64_C({})", self.period.unwrap_or(0)),
                };
            }
            Arg::Left => out.push_str("left"),
        }
    }

    /// A pointer to the kernel's struct.
    fn state_pointer(&self, out: &mut String) {
        match self.caller {
            Caller::Adapter if self.shape().form == Form::Kernel => out.push_str("self"),
            Caller::Adapter => {
                let _ = write!(out, "&self->{}", self.shape().state.as_deref().unwrap_or_default());
            }
            Caller::Step(scope) | Caller::Init(scope) | Caller::Body(scope) => {
                out.push('&');
                expr::state(out, self.cx, scope, self.id);
            }
        }
    }

    /// A field of the instance.
    fn field(&self, out: &mut String, index: usize) -> Kind {
        match self.caller {
            Caller::Adapter => {
                let field = &self.shape().fields[index];
                let _ = write!(out, "self->{}", field.name);
                if field.count.is_some() { Kind::Array(0) } else { Kind::Scalar }
            }
            Caller::Step(scope) | Caller::Init(scope) | Caller::Body(scope) => {
                expr::field(out, self.cx, scope, self.id, index)
            }
        }
    }

    fn array_field(&self, out: &mut String, index: Option<usize>) {
        match index {
            Some(index) => expr::pointer(out, |out| self.field(out, index)),
            None => out.push_str("NULL"),
        }
    }

    fn work(&self, out: &mut String, index: usize) {
        let mut at = self.scratch;
        for field in &self.code().decl.work[..index] {
            let elements = place_elements(&field.ty, &self.block().sizes);
            match field.ty {
                TypeExpr::Time => at.time += 1,
                _ => at.add(element_scalar(&field.ty), elements),
            }
        }
        let field = &self.code().decl.work[index];
        if place_elements(&field.ty, &self.block().sizes) == 0 {
            out.push_str("NULL");
            return;
        }
        match (&field.ty, element_scalar(&field.ty)) {
            (TypeExpr::Time, _) => self.scratch_pointer(out, "twork", at.time),
            (_, Scalar::Real) => self.scratch_pointer(out, "work", at.real),
            (_, Scalar::Int) => self.scratch_pointer(out, "iwork", at.int),
        }
    }

    /// What stands before the scratch arrays: a composite gets them as arguments, a net keeps them.
    pub(crate) fn scratch_root(&self) -> &'c str {
        match self.cx.unit_layout(self.unit).net {
            Some(_) => "self->net.",
            None if self.unit.0 == 0 => self.scope().root,
            None => "",
        }
    }

    /// A pointer into one of the scratch arrays.
    pub(crate) fn scratch_pointer(&self, out: &mut String, name: &str, first: usize) {
        let root = self.scratch_root();
        let _ = match first {
            0 => write!(out, "{root}{name}"),
            _ => write!(out, "&{root}{name}[{first}]"),
        };
    }

    fn image(&self, out: &mut String) {
        let (Some(image), Some(id)) = (self.code().decl.image, self.block().image) else {
            return;
        };
        let border = &self.cx.layout.border;
        let index = border.images[id.0 as usize] as usize;
        let root = self.scope().root;
        let _ = match image.direction {
            Direction::In => write!(out, "{root}in.{}", border.inputs[index].0),
            Direction::Out => write!(out, "&{root}out.{}", border.outputs[index].0),
        };
    }

    /// The fail-safe value of the block's word.
    fn fail(&self, out: &mut String) {
        let word = self.block().image.map(|id| &self.cx.program.images[id.0 as usize]);
        match word.and_then(|word| word.fail) {
            Some(value) => text::real(out, value, self.cx.program.width),
            None => out.push_str("pcl2_bad()"),
        }
    }

    /// An output that the kernel writes through a pointer.
    fn output(&self, out: &mut String, declared: usize) {
        let (code, shape) = (self.code(), self.shape());
        let open = model::is_open(self.body(), self.block(), code.decl, declared);
        if open || place_elements(&code.decl.outputs[declared].ty, &self.block().sizes) == 0 {
            out.push_str("NULL");
            return;
        }
        if let Some(index) = shape.outputs[declared] {
            expr::pointer(out, |out| self.field(out, index));
            return;
        }
        let (first, count) = code.output_range(declared, &self.block().sizes);
        match self.block().outputs.get(first).filter(|_| count > 0) {
            Some(signal) => expr::signal_pointer(out, self.cx, self.scope(), *signal),
            None => out.push_str("NULL"),
        }
    }

    pub(crate) fn port(&self, out: &mut String, statics: &mut Statics, port: usize) {
        let declared = self.code().ports[port];
        let (first, count) = self.code().port_range(port, &self.block().sizes);
        if declared.group.is_some() {
            self.group(out, port, first, count);
        } else {
            let ty = crate::code::place_type(&declared.ty, self.block()).unwrap_or(Type::REAL);
            self.source(out, statics, first, ty);
        }
    }

    /// What is wired to one port, as an argument.
    pub(crate) fn source(&self, out: &mut String, statics: &mut Statics, expanded: usize, want: Type) {
        let source = &self.block().ports[expanded];
        if want.is_scalar() {
            expr::source_value(out, self.cx, self.scope(), source, want.scalar);
            return;
        }
        if want.elements() == 0 {
            out.push_str("NULL");
            return;
        }
        match source {
            Source::Signal(id) | Source::Element(id, _) => expr::signal_pointer(out, self.cx, self.scope(), *id),
            Source::Copied(_) => self.copy_pointer(out, expanded, want.scalar),
            Source::Constant(value) => {
                let place = Place { scalar: want.scalar, elements: Some(want.elements()) };
                expr::constant(out, self.cx, statics, value, place);
            }
            Source::Cell(cell) => expr::cell(out, self.cx, self.scope(), *cell),
            // Own parameters on wires are scalars.
            Source::Own(..) => {}
        }
    }

    fn copy_pointer(&self, out: &mut String, expanded: usize, scalar: Scalar) {
        let first = self.copies.iter().find(|(port, _)| *port == expanded).map_or(0, |(_, first)| *first);
        self.scratch_pointer(out, scratch_name(scalar), first);
    }

    fn group(&self, out: &mut String, port: usize, first: usize, count: usize) {
        let scalar = element_scalar(&self.code().ports[port].ty);
        if count == 0 {
            out.push_str("NULL");
        } else if facts::is_literal(self.block(), self.code(), port) {
            let _ = write!(out, "(const {}[]){{", pcl2_lang::kernel::c_scalar(scalar));
            for (i, source) in self.block().ports[first..first + count].iter().enumerate() {
                if i > 0 {
                    out.push_str(", ");
                }
                expr::source_value(out, self.cx, self.scope(), source, scalar);
            }
            out.push('}');
        } else {
            let at = self.gathered.iter().find(|(known, _)| *known == port).map_or(0, |(_, first)| *first);
            self.scratch_pointer(out, scratch_name(scalar), at);
        }
    }

    /// A parameter as an argument of one of the kernel's or body's functions.
    pub(crate) fn param(&self, out: &mut String, statics: &mut Statics, index: usize) {
        let param = &self.block().params[index];
        let declared = &self.code().decl.params[index];
        if place_elements(&declared.ty, &self.block().sizes) == 0 && declared.ty != TypeExpr::Text {
            out.push_str("NULL");
            return;
        }
        match self.caller {
            Caller::Adapter => self.adapter_param(out, statics, index),
            Caller::Step(scope) => match (self.shape().params.get(index).copied().flatten(), param) {
                (Some(field), _) => {
                    self.field(out, field);
                }
                (None, Param::Own(_)) => {
                    let own = expr::own_param(self.cx, self.unit, param).unwrap_or_default();
                    let _ = write!(out, "{}{own}", scope.root);
                }
                (None, Param::Value(_)) => self.literal(out, statics, param, declared),
            },
            Caller::Init(_) => self.literal(out, statics, param, declared),
            Caller::Body(_) => match expr::own_param(self.cx, self.unit, param) {
                Some(own) => out.push_str(own),
                None => self.literal(out, statics, param, declared),
            },
        }
    }

    fn adapter_param(&self, out: &mut String, statics: &mut Statics, index: usize) {
        match parameter_home(self.cx, self.unit, self.id, index) {
            Home::Hot(name) => {
                let _ = write!(out, "self->{name}");
            }
            Home::Cold(name) => {
                let _ = write!(out, "cold->{name}");
            }
            Home::Literal => {
                self.literal(out, statics, &self.block().params[index], &self.code().decl.params[index]);
            }
        }
    }

    fn literal(&self, out: &mut String, statics: &mut Statics, param: &Param, declared: &ParamDecl) {
        let Some(value) = known_value(param) else {
            return;
        };
        let elements = place_elements(&declared.ty, &self.block().sizes);
        let elements = if declared.ty.is_scalar() { None } else { Some(elements) };
        expr::constant(out, self.cx, statics, value, Place { scalar: element_scalar(&declared.ty), elements });
    }
}

/// Where a parameter of a block of the program lives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Home<'c> {
    /// In the instance, in this field.
    Hot(&'c str),
    /// In the struct of cold parameters, in this field.
    Cold(&'c str),
    /// In the code.
    Literal,
}

/// Where a parameter of a block of the program lives.
pub(crate) fn parameter_home<'c>(cx: &'c Context<'_>, unit: UnitId, id: BlockId, index: usize) -> Home<'c> {
    let block = cx.program.unit(unit).block(id);
    let shape = cx.shape_of(unit, id);
    if let Some(field) = shape.params.get(index).copied().flatten() {
        return Home::Hot(&shape.fields[field].name);
    }
    let tunable = block.tunable && unit.0 == 0 && !cx.code(block.decl).decl.params[index].fixed;
    if let (Some(inner), true) = (block.unit, tunable) {
        let inner = cx.unit_layout(inner);
        if inner.facts.hot[index] {
            return Home::Hot(&inner.params[index]);
        }
    }
    let cold = shape.cold.map(|cold| &cx.layout.colds[cold]);
    match cold.and_then(|cold| cold.params[index].map(|field| &cold.fields[field])) {
        Some(field) => Home::Cold(&field.name),
        None => Home::Literal,
    }
}

/// The scratch array of a number type.
pub(crate) fn scratch_name(scalar: Scalar) -> &'static str {
    match scalar {
        Scalar::Real => "work",
        Scalar::Int => "iwork",
    }
}
