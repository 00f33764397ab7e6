//! Declarations as written, before their names are resolved.

use crate::ast::{Name, Number, Operand};
use crate::source::Span;
use crate::types::Scalar;

/// One line of a `.fc` file.
#[derive(Clone, Debug)]
pub enum Raw {
    /// `out, .. = NAME ( items : params )`
    Head(Vec<Output>, Call),
    /// A clause.
    Clause(Clause),
}

/// The right side of a head.
#[derive(Clone, Debug)]
pub struct Call {
    /// The function code.
    pub name: Name,
    /// Its input list.
    pub items: Vec<Item>,
    /// Its parameters.
    pub params: Vec<Param>,
}

/// An output.
#[derive(Clone, Debug)]
pub struct Output {
    /// Changed in place.
    pub inout: bool,
    /// Its type.
    pub ty: Type,
    /// Its name.
    pub name: Name,
    /// `* n`
    pub group: Option<(Expr, Option<Range>)>,
    /// Unit, range, names.
    pub tail: Tail,
}

/// An item of the input list.
#[derive(Clone, Debug)]
pub enum Item {
    /// Must be written so.
    Literal(i32),
    /// An integer constant.
    Constant(Name, Option<Range>),
    /// A port.
    Port(Box<Port>),
}

/// An input port.
#[derive(Clone, Debug)]
pub struct Port {
    /// An operator cell when left empty.
    pub cell: bool,
    /// Its type.
    pub ty: Type,
    /// Its name.
    pub name: Name,
    /// `* n`
    pub group: Option<(Expr, Option<Range>)>,
    /// `= value`
    pub default: Option<Value>,
    /// Unit, range, names.
    pub tail: Tail,
    /// `tracks NAME`
    pub tracks: Option<Name>,
}

/// A parameter.
#[derive(Clone, Debug)]
pub struct Param {
    /// Never tuned.
    pub fixed: bool,
    /// Its type.
    pub ty: Type,
    /// Its name.
    pub name: Name,
    /// `= value`
    pub default: Option<Value>,
    /// Unit, range, names.
    pub tail: Tail,
}

/// A default.
#[derive(Clone, Debug)]
pub enum Value {
    /// A number.
    Number(Number, Span),
    /// A name of an enumeration.
    Name(Name),
    /// A text, quotes excluded.
    Text(Span),
}

/// A type.
#[derive(Clone, Debug)]
#[allow(missing_docs)]
pub enum Type {
    Int,
    Real,
    Text,
    Time,
    Ivec(Expr),
    Vec(Expr),
    Imat(Expr, Expr),
    Mat(Expr, Expr),
}

/// An expression over names and numbers.
#[derive(Clone, Debug)]
pub enum Expr {
    /// A literal.
    Number(Number),
    /// A size or a parameter.
    Name(Name),
    /// `-a`
    Negate(Box<Expr>, u32),
    /// `a sign b`
    Binary(Box<Expr>, char, Box<Expr>, u32),
}

impl Expr {
    /// How many operations nest; kept in the nodes, so that asking is cheap.
    pub(crate) fn depth(&self) -> u32 {
        match self {
            Expr::Number(_) | Expr::Name(_) => 0,
            Expr::Negate(_, depth) | Expr::Binary(.., depth) => *depth,
        }
    }
}

/// Bounds.
#[derive(Clone, Debug)]
pub struct Range {
    /// `from` or `above`.
    pub lower: Option<Bound>,
    /// `to`
    pub upper: Option<Expr>,
}

/// A lower bound.
#[derive(Clone, Debug)]
pub struct Bound {
    /// The bound itself is excluded.
    pub above: bool,
    /// The bound.
    pub expr: Expr,
}

/// Unit, range, names.
#[derive(Clone, Debug)]
pub struct Tail {
    /// The unit's text, quotes excluded.
    pub unit: Option<Span>,
    /// The range.
    pub bounds: Option<Range>,
    /// The names of the values.
    pub names: Vec<Name>,
}

/// A field of memory.
#[derive(Clone, Debug)]
pub struct Field {
    /// Its type.
    pub ty: Type,
    /// Its name.
    pub name: Name,
}

/// A clause below a head.
#[derive(Clone, Debug)]
#[allow(missing_docs)]
pub enum Clause {
    Memory(Vec<Field>),
    Work(Vec<Field>),
    Tuned(Vec<Field>),
    Start(Vec<Name>),
    Retain(Vec<Name>),
    Return(Name),
    Period,
    Check,
    Image(Name, Scalar),
    Faults(Vec<(Name, Span)>),
    Bad(Name),
    Inline,
    Simulated,
    Operator(Option<Span>),
    Example(Span, Operand, Vec<Span>, Option<u64>, Option<Span>),
    Body,
    End,
}
