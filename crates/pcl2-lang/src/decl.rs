//! A function code's declaration: the one place where a block is described.
//!
//! Everything that the compiler knows of a block it reads here: the binding of calls, types and sizes,
//! the C prototype ([`crate::kernel`]), ranges, tunable parameters, memory, documentation.

use crate::net::Net;
use crate::program::DeclId;
use crate::source::Span;
use crate::types::{Real, Scalar, Value};

/// The output that hands back what is really followed: it takes no number and is reached by name only.
pub const RETURN_OUTPUT: &str = "bk";

/// The optional port that takes what the block downstream hands back.
pub const RETURN_PORT: &str = "back";

/// A declared function code.
#[derive(Clone, Debug)]
pub struct Decl {
    /// The function code's name, in the paper's spelling.
    pub name: String,
    /// The comment above the declaration, `!` removed, lines joined with newlines.
    pub doc: String,
    /// Where the name stands.
    pub span: Span,
    /// The folder below `blocks/`, such as `dynamics`; empty for a user's own block.
    pub group: String,
    /// The file's stem, shared by declaration, kernel and generated header.
    pub stem: String,
    /// Whether the declaration comes from the user's project instead of the catalogue.
    pub user: bool,
    /// Output ports in order.
    pub outputs: Vec<OutputDecl>,
    /// The input list in order: literals, constants and ports.
    pub items: Vec<Item>,
    /// Parameters in order.
    pub params: Vec<ParamDecl>,
    /// The size variables, in order: the constants, then the sizes that only ports define.
    pub sizes: Vec<SizeVar>,
    /// Kept from scan to scan.
    pub memory: Vec<Field>,
    /// Scratch, shared by all blocks.
    pub work: Vec<Field>,
    /// Derived from parameters by `tune`.
    pub tuned: Vec<Field>,
    /// Indexes of the outputs that `init` sets: the declared initial outputs.
    pub start: Vec<usize>,
    /// What is kept over power loss: names of outputs or memory.
    pub retain: Vec<String>,
    /// The port, an index into [`Decl::ports`], that the output [`RETURN_OUTPUT`] answers: the return wire of its link.
    pub returns: Option<usize>,
    /// The kernel needs its section's period.
    pub period: bool,
    /// The kernel judges its parameters (`pcl2_NAME_check`).
    pub check: bool,
    /// An image word at the address given by the fixed parameters.
    pub image: Option<Image>,
    /// Statuses; the first is status 1.
    pub faults: Vec<Fault>,
    /// The bad-signal rule.
    pub bad: Option<BadRule>,
    /// One expression, compiled inline.
    pub inline: bool,
    /// Legal in PLANT only.
    pub simulated: bool,
    /// Usable in expressions under its name, and as this sign or under this name, if it is not empty.
    pub operator: Option<String>,
    /// Tested examples.
    pub examples: Vec<Example>,
    /// The statements of a composite.
    pub body: Option<Vec<crate::ast::Statement>>,
    /// Of a net: when its statements run, and where its tokens are.
    pub net: Option<Box<Net>>,
    /// Of an expression: what is done with its ports, in the order in which it is computed.
    pub formula: Option<Vec<Step>>,
}

/// A part of an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Step {
    /// The next port.
    Port,
    /// An OPERATOR code takes as many of the latest results as it has ports.
    Apply(DeclId),
}

/// The type of a declared place before its sizes are known.
#[derive(Clone, Debug, PartialEq)]
pub enum TypeExpr {
    /// One int or one real.
    Scalar(Scalar),
    /// A vector.
    Vector(Scalar, Expr),
    /// A matrix: rows, columns.
    Matrix(Scalar, Expr, Expr),
    /// Text: parameters only.
    Text,
    /// Nanoseconds in an `int64_t`: memory and work only.
    Time,
}

/// An expression over literals, size variables and (in bounds) parameters.
#[derive(Clone, Debug, PartialEq)]
pub enum Expr {
    /// An integer literal.
    Int(i32),
    /// A real literal: bounds only.
    Real(Real),
    /// A size variable, an index into [`Decl::sizes`].
    Size(usize),
    /// An earlier parameter, an index into [`Decl::params`]: bounds only.
    Param(usize),
    /// `-a`
    Negate(Box<Expr>),
    /// `a + b`
    Add(Box<Expr>, Box<Expr>),
    /// `a - b`
    Subtract(Box<Expr>, Box<Expr>),
    /// `a * b`
    Multiply(Box<Expr>, Box<Expr>),
    /// `a / b`; on integers it truncates.
    Divide(Box<Expr>, Box<Expr>),
}

/// A variable in size expressions.
#[derive(Clone, Debug)]
pub struct SizeVar {
    /// Its name.
    pub name: String,
    /// `Some(item)` for a constant of the input list, `None` for a size that ports define.
    pub constant: Option<usize>,
}

/// One output port, or a group of them.
#[derive(Clone, Debug)]
pub struct OutputDecl {
    /// The port's name.
    pub name: String,
    /// Its type.
    pub ty: TypeExpr,
    /// The kernel changes elements in place and keeps the others.
    pub inout: bool,
    /// `Some` for a group: that many ports in a row.
    pub group: Option<Group>,
    /// Unit, range or names.
    pub tail: Tail,
    /// It takes no number and no place in the list of outputs: it is reached through a tag.
    pub by_name: bool,
    /// The names of a vector's elements, where they have some.
    pub elements: Vec<String>,
}

/// The size of a group of ports.
#[derive(Clone, Debug)]
pub struct Group {
    /// How many ports.
    pub count: Expr,
    /// Bounds on the count.
    pub bounds: Option<Bounds>,
}

/// One item of the input list.
#[derive(Clone, Debug)]
pub enum Item {
    /// An integer that must be written so.
    Literal(i32),
    /// A constant: an integer known at compile time.
    Constant(ConstantDecl),
    /// An input port.
    Port(Box<PortDecl>),
}

/// An integer constant of the input list.
#[derive(Clone, Debug)]
pub struct ConstantDecl {
    /// Its name.
    pub name: String,
    /// Its index in [`Decl::sizes`].
    pub size: usize,
    /// Its range.
    pub bounds: Option<Bounds>,
}

/// An input port.
#[derive(Clone, Debug)]
pub struct PortDecl {
    /// Its name.
    pub name: String,
    /// Its type.
    pub ty: TypeExpr,
    /// Left empty it is an operator cell.
    pub cell: bool,
    /// `Some` for a group: that many ports in a row.
    pub group: Option<Group>,
    /// A default makes the port optional.
    pub default: Option<Value>,
    /// Unit, range or names.
    pub tail: Tail,
    /// The output or memory that an operator cell follows after each scan.
    pub tracks: Option<String>,
}

/// A parameter.
#[derive(Clone, Debug)]
pub struct ParamDecl {
    /// Its name.
    pub name: String,
    /// Its type.
    pub ty: TypeExpr,
    /// Known at compile time and never tuned.
    pub fixed: bool,
    /// Without a default the place must be filled. A single value for a vector stands for each element.
    pub default: Option<Value>,
    /// Unit, range or names.
    pub tail: Tail,
}

/// Unit and range, or the names of an enumeration.
#[derive(Clone, Debug, Default)]
pub struct Tail {
    /// The unit, as declared.
    pub unit: Option<String>,
    /// The range.
    pub bounds: Option<Bounds>,
    /// The names of the values 0, 1, ..
    pub names: Vec<String>,
}

/// A range.
#[derive(Clone, Debug)]
pub struct Bounds {
    /// The lower bound.
    pub lower: Option<Expr>,
    /// The lower bound itself is excluded (`above`).
    pub above: bool,
    /// The upper bound, included.
    pub upper: Option<Expr>,
}

/// A named piece of memory.
#[derive(Clone, Debug)]
pub struct Field {
    /// Its name, as in the C struct.
    pub name: String,
    /// Its type.
    pub ty: TypeExpr,
}

/// The direction of an image word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// From the plant.
    In,
    /// To the plant.
    Out,
}

/// The word of the process image that a block reads or writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Image {
    /// From or to the plant.
    pub direction: Direction,
    /// The word's type.
    pub scalar: Scalar,
}

/// A status that a kernel can leave.
#[derive(Clone, Debug)]
pub struct Fault {
    /// Its name.
    pub name: String,
    /// Its text; `{1}` and `{2}` stand for the reals that a check leaves.
    pub text: String,
}

/// What a block does with a bad signal: a letter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BadRule {
    /// A: algebraic, bad in, bad out.
    Algebraic,
    /// H: dynamic, the state is frozen and the output held.
    Hold,
    /// S: selector, bad inputs are skipped.
    Select,
    /// M: controller, freeze, then shed.
    Manual,
    /// F: adaptation frozen.
    Freeze,
    /// L: logic on ints, which are never bad.
    Logic,
    /// O: output to the plant, never non-finite.
    Output,
}

/// A tested example of a declaration.
#[derive(Clone, Debug)]
pub struct Example {
    /// The signal that is compared.
    pub signal: String,
    /// The expected values as written: half a unit of the last digit is the tolerance.
    pub values: Vec<String>,
    /// After how many scans.
    pub after: u64,
    /// The period as written, if any.
    pub period: Option<String>,
    /// The program's text.
    pub program: String,
    /// Where the EXAMPLE line stands.
    pub span: Span,
}

impl TypeExpr {
    /// Whether the place is one int, one real or one time.
    pub fn is_scalar(&self) -> bool {
        matches!(self, TypeExpr::Scalar(_) | TypeExpr::Time)
    }
}

impl Decl {
    /// A code of which nothing but its name is known.
    pub fn new(name: String, span: Span) -> Decl {
        Decl {
            name,
            doc: String::new(),
            span,
            group: String::new(),
            stem: String::new(),
            user: false,
            outputs: Vec::new(),
            items: Vec::new(),
            params: Vec::new(),
            sizes: Vec::new(),
            memory: Vec::new(),
            work: Vec::new(),
            tuned: Vec::new(),
            start: Vec::new(),
            retain: Vec::new(),
            returns: None,
            period: false,
            check: false,
            image: None,
            faults: Vec::new(),
            bad: None,
            inline: false,
            simulated: false,
            operator: None,
            examples: Vec::new(),
            body: None,
            net: None,
            formula: None,
        }
    }

    /// An expression: an INLINE code made on the spot, whose ports are its operands in order.
    pub fn expression(span: Span, operands: &[Scalar], result: Scalar, formula: Vec<Step>) -> Decl {
        let mut decl = Decl::new("expression".to_owned(), span);
        let port = |(i, scalar): (usize, &Scalar)| PortDecl {
            name: format!("x{}", i + 1),
            ty: TypeExpr::Scalar(*scalar),
            cell: false,
            group: None,
            default: None,
            tail: Tail::default(),
            tracks: None,
        };
        decl.items = operands.iter().enumerate().map(|operand| Item::Port(Box::new(port(operand)))).collect();
        let (name, ty) = ("y".to_owned(), TypeExpr::Scalar(result));
        decl.outputs.push(OutputDecl {
            name,
            ty,
            inout: false,
            group: None,
            tail: Tail::default(),
            by_name: false,
            elements: Vec::new(),
        });
        decl.inline = true;
        decl.bad = Some(BadRule::Algebraic);
        decl.formula = Some(formula);
        decl
    }

    /// The scalars of its ports, for a code whose ports are all scalar.
    pub fn port_scalars(&self) -> impl Iterator<Item = Scalar> {
        self.ports().filter_map(|port| match port.ty {
            TypeExpr::Scalar(scalar) => Some(scalar),
            TypeExpr::Vector(..) | TypeExpr::Matrix(..) | TypeExpr::Text | TypeExpr::Time => None,
        })
    }

    /// Whether its C is a kernel of its own: not PCL2 statements, nor an expression over other kernels.
    pub fn has_kernel(&self) -> bool {
        self.body.is_none() && self.formula.is_none()
    }

    /// The ports of the input list in order.
    pub fn ports(&self) -> impl Iterator<Item = &PortDecl> {
        self.items.iter().filter_map(|item| match item {
            Item::Port(port) => Some(port.as_ref()),
            Item::Constant(_) | Item::Literal(_) => None,
        })
    }

    /// The constants of the input list in order.
    pub fn constants(&self) -> impl Iterator<Item = &ConstantDecl> {
        self.items.iter().filter_map(|item| match item {
            Item::Constant(constant) => Some(constant),
            Item::Port(_) | Item::Literal(_) => None,
        })
    }

    /// Whether the code is made of PCL2 statements instead of C.
    pub fn is_composite(&self) -> bool {
        self.body.is_some()
    }
}
