//! The statements of a net: conditions and times as values, the others as what they do.

use super::NetBody;
use crate::args::{Call, Caller};
use crate::bodies::Body;
use crate::calls::{self, Telling};
use crate::expr::{self, Kind, Scope};
use crate::formula;
use crate::statics::Statics;
use crate::text;
use pcl2_lang::net::{Kind as BoxKind, StatementId};
use pcl2_lang::program::{BlockId, Role, SignalId, Source};
use pcl2_lang::types::{Scalar, Type};

/// What a statement is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Use {
    /// The player asks whether it is true.
    Condition,
    /// The player asks for its value, in seconds.
    Time,
    /// It takes in the inputs of a net inside, by the place among the parts.
    Inputs(usize),
    /// It is run.
    Action,
}

/// By statement: what it is for.
pub(super) fn uses(net: &NetBody<'_, '_, '_>) -> Vec<Use> {
    let mut uses = vec![Use::Action; net.body.unit.blocks.len()];
    for statement in net.net.conditions() {
        uses[statement.0 as usize] = Use::Condition;
    }
    for place in &net.net.boxes {
        match &place.kind {
            BoxKind::Time(time) => uses[time.0 as usize] = Use::Time,
            BoxKind::Process(process) => {
                if let Some(within) = process.within {
                    uses[within.0 as usize] = Use::Time;
                }
            }
            BoxKind::State | BoxKind::Capacity | BoxKind::Count | BoxKind::Action(_) => {}
            BoxKind::Generation(_) | BoxKind::Macro(_) => {}
        }
    }
    for (i, part) in net.net.parts.iter().enumerate() {
        uses[part.statement.0 as usize] = Use::Inputs(i);
    }
    uses
}

/// The call that a statement is.
pub(super) fn call<'c, 'a>(net: &NetBody<'_, 'c, 'a>, statement: StatementId) -> Call<'c, 'a> {
    let caller = Caller::Step(Scope::of(net.body.id));
    Call::new(net.body.cx, net.body.id, BlockId(statement.0), caller, None)
}

/// A statement as it stands in the source.
pub(super) fn source<'a>(net: &NetBody<'_, '_, 'a>, statement: StatementId) -> &'a str {
    let block = net.body.unit.block(BlockId(statement.0));
    net.body.cx.sources.text(block.span)
}

/// Writes what a condition computes on its way, and returns the condition: true only where no operand and no result on
/// the way is bad.
pub(super) fn condition(
    out: &mut String,
    statics: &mut Statics,
    net: &NetBody<'_, '_, '_>,
    statement: StatementId,
    indent: &str,
) -> String {
    let call = call(net, statement);
    let (reals, value) = value(out, statics, &call, indent);
    let mut tests: Vec<String> = real_operands(net, &call).into_iter().chain(reals).collect();
    tests.iter_mut().for_each(|real| *real = format!("!pcl2_is_bad({real})"));
    tests.push(format!("{value} != 0"));
    tests.join(" && ")
}

/// Writes what a time computes on its way, and returns it in nanoseconds.
pub(super) fn time(
    out: &mut String,
    statics: &mut Statics,
    net: &NetBody<'_, '_, '_>,
    statement: StatementId,
    indent: &str,
) -> String {
    let call = call(net, statement);
    let (_, value) = value(out, statics, &call, indent);
    let signal = call.block().outputs[0];
    match call.body().signal(signal).ty.scalar {
        Scalar::Real => format!("pcl2_net_time({value})"),
        Scalar::Int => format!("pcl2_net_seconds({value})"),
    }
}

/// The value of a statement without an output of its own, and the reals that it computes on its way.
fn value(out: &mut String, statics: &mut Statics, call: &Call<'_, '_>, indent: &str) -> (Vec<String>, String) {
    match &call.code().decl.formula {
        Some(formula) => formula::value_in_steps(out, statics, call, formula, indent),
        None => {
            let mut text = String::new();
            call.kernel(&mut text, statics, pcl2_lang::kernel::Entry::Step);
            (Vec::new(), text)
        }
    }
}

/// The reals that a statement reads, constants left out.
fn real_operands(net: &NetBody<'_, '_, '_>, call: &Call<'_, '_>) -> Vec<String> {
    let mut operands = Vec::new();
    for source in &call.block().ports {
        let real = match source {
            Source::Signal(id) | Source::Copied(id) | Source::Element(id, _) => {
                call.body().signal(*id).ty.scalar == Scalar::Real
            }
            Source::Own(_, scalar) => *scalar == Scalar::Real,
            Source::Cell(_) | Source::Constant(_) => false,
        };
        let mut text = String::new();
        expr::source_value(&mut text, net.body.cx, net.scope(), source, Scalar::Real);
        if real && !operands.contains(&text) {
            operands.push(text);
        }
    }
    operands
}

/// Writes what a statement does.
pub(super) fn action(
    out: &mut String,
    statics: &mut Statics,
    net: &NetBody<'_, '_, '_>,
    statement: StatementId,
    indent: &str,
) {
    let (cx, id) = (net.body.cx, BlockId(statement.0));
    let mut text = String::new();
    calls::step(&mut text, cx, statics, net.scope(), id, "self->status = self->status != 0 ? self->status : 1;");
    if calls::telling(cx, net.body.id, id) == Telling::Status {
        text.push_str("    self->status = self->status != 0 ? self->status : ");
        calls::status(&mut text, cx, net.scope(), id);
        text.push_str(";\n");
    }
    indented(out, &text, indent);
}

/// Writes lines that are indented once with another indent.
fn indented(out: &mut String, text: &str, indent: &str) {
    for line in text.lines() {
        out.extend([indent, line.strip_prefix("    ").unwrap_or(line), "\n"]);
    }
}

/// What an input of a net inside takes.
pub(super) struct Input {
    /// Where it stands.
    pub(super) to: String,
    /// What it takes: a value, or of a vector a pointer.
    pub(super) from: String,
    /// Its type.
    pub(super) ty: Type,
    /// The signal and the port of an input; none of a command.
    pub(super) port: Option<(SignalId, u32)>,
}

impl Input {
    /// One without elements never changes.
    pub(super) fn may_change(&self) -> bool {
        self.ty.elements() > 0
    }

    /// A number that is not 0 where it changes.
    pub(super) fn change(&self) -> Option<String> {
        match (self.ty.is_scalar(), self.ty.scalar) {
            (true, Scalar::Int) => Some(format!("({} ^ {})", self.to, self.from)),
            (true, Scalar::Real) => self.differs(),
            (false, _) => self.differs().map(|differs| format!("({differs})")),
        }
    }

    /// The condition that it changes.
    pub(super) fn differs(&self) -> Option<String> {
        let Input { to, from, ty, .. } = self;
        let differs = match (ty.is_scalar(), ty.scalar) {
            (true, Scalar::Int) => format!("{to} != {from}"),
            (true, Scalar::Real) => format!("pcl2_net_differ({to}, {from})"),
            (false, scalar) => {
                let size = pcl2_lang::kernel::c_scalar(scalar);
                format!("memcmp({to}, {from}, {} * sizeof({size})) != 0", ty.elements())
            }
        };
        self.may_change().then_some(differs)
    }
}

/// The inputs of a net inside, then its commands.
pub(super) fn part_inputs(statics: &mut Statics, net: &NetBody<'_, '_, '_>, part: usize) -> Vec<Input> {
    inputs_of(statics, &call(net, net.net.parts[part].statement), &instance(net, part))
}

/// The inputs of a net that is called, then its commands.
pub(super) fn inputs_of(statics: &mut Statics, call: &Call<'_, '_>, instance: &str) -> Vec<Input> {
    let cx = call.cx;
    let Some(inner) = call.block().unit.and_then(|inner| Body::new(cx, inner)) else {
        return Vec::new();
    };
    let Some(inside) = NetBody::of(&inner) else {
        return Vec::new();
    };
    let root = format!("{instance}.");
    let scope = Scope { unit: inner.id, root: &root, part: crate::layout::WHOLE };
    let place = |signal: SignalId| {
        let mut text = String::new();
        expr::signal_base(&mut text, cx, scope, signal);
        text
    };
    let mut inputs = Vec::new();
    for (i, signal) in inner.unit.signals.iter().enumerate() {
        let Role::Port(port) = signal.role else {
            continue;
        };
        let mut from = String::new();
        call.source(&mut from, statics, port as usize, signal.ty);
        let id = SignalId(i as u32);
        inputs.push(Input { to: place(id), from, ty: signal.ty, port: Some((id, port)) });
    }
    for (port, word) in inside.net.latched() {
        let to = inside.word(word.0 as usize, scope);
        inputs.push(Input { to, from: place(SignalId(port)), ty: Type::INT, port: None });
    }
    inputs
}

/// Writes how the inputs of a net inside are taken in.
pub(super) fn inputs(out: &mut String, statics: &mut Statics, net: &NetBody<'_, '_, '_>, part: usize, indent: &str) {
    for input in part_inputs(statics, net, part) {
        let kind = if input.ty.is_scalar() { Kind::Scalar } else { Kind::Array(0) };
        let write = |out: &mut String, text: &str| {
            out.push_str(text);
            kind
        };
        calls::assign(out, indent, input.ty, |out| write(out, &input.to), |out| write(out, &input.from));
    }
}

/// The member that is the instance of a net inside.
pub(super) fn instance(net: &NetBody<'_, '_, '_>, part: usize) -> String {
    let mut text = String::new();
    expr::block(&mut text, net.body.cx, net.scope(), BlockId(net.net.parts[part].statement.0));
    text
}

/// `/* text */` at an indent.
pub(super) fn comment(out: &mut String, indent: &str, source: &str) {
    if !source.is_empty() {
        text::comment(out, indent, source);
    }
}
