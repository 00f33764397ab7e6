//! What was written, before anything is known of its meaning.

pub mod net;

use crate::source::Span;
use crate::symbol::Symbol;
use crate::types::Real;

/// A name and its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Name {
    /// The interned text.
    pub symbol: Symbol,
    /// The place.
    pub span: Span,
}

/// A number as written, sign included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Number {
    /// Digits.
    Int(i32),
    /// With a dot or an exponent.
    Real(Real),
}

/// One statement: `[number] [outputs] = code ( inputs : parameters )`, or `[number] [outputs] = expression`.
#[derive(Clone, Debug, PartialEq)]
pub struct Statement {
    /// The block number, if written.
    pub number: Option<(u32, Span)>,
    /// The outputs.
    pub outputs: Box<[Output]>,
    /// The function code; of an expression a name without letters, at the place of the expression.
    pub code: Name,
    /// What an expression does with its operands.
    pub formula: Option<Box<Formula>>,
    /// The input list, then the parameter list.
    items: Box<[Item]>,
    /// How many items are inputs.
    inputs: u32,
    /// Where the `:` stands; of an expression its last character.
    pub colon: Span,
    /// From the first token to the closing parenthesis.
    pub span: Span,
    /// In a net the counters of the FOR lines around it, and their values.
    pub counters: Box<[(Name, i32)]>,
}

impl Statement {
    /// A statement whose first `inputs` items are the input list.
    pub(crate) fn new(
        number: Option<(u32, Span)>,
        outputs: Box<[Output]>,
        code: Name,
        (items, inputs): (Box<[Item]>, u32),
        (colon, span): (Span, Span),
    ) -> Statement {
        Statement { number, outputs, code, formula: None, items, inputs, colon, span, counters: Box::default() }
    }

    /// A call with operands by position and without parameters.
    pub fn call(outputs: Box<[Output]>, code: Name, inputs: Vec<Operand>) -> Statement {
        let span = code.span;
        let empty = [Operand::Empty];
        let count = inputs.len().max(1) as u32;
        let inputs = if inputs.is_empty() { vec![Operand::Empty] } else { inputs };
        let items = inputs.into_iter().chain(empty).map(|value| Item { label: None, value, span }).collect();
        Statement::new(Some((1, span)), outputs, code, (items, count), (span, span))
    }

    /// A statement with one operand as its expression: a value that is asked for.
    pub fn value(value: Operand, code: Name) -> Statement {
        let span = code.span;
        let items = Box::new([Item { label: None, value, span }]);
        let mut statement = Statement::new(None, Box::new([]), code, (items, 1), (span, span));
        statement.formula = Some(Box::new(Formula(vec![Term::Operand])));
        statement
    }

    /// The input list; an empty list has one empty item. Of an expression the operands in order.
    pub fn inputs(&self) -> &[Item] {
        &self.items[..self.inputs as usize]
    }

    /// The same, to be changed.
    pub fn inputs_mut(&mut self) -> &mut [Item] {
        &mut self.items[..self.inputs as usize]
    }

    /// The parameter list; an empty list has one empty item. An expression has none.
    pub fn params(&self) -> &[Item] {
        &self.items[self.inputs as usize..]
    }
}

/// An expression in the order in which it is computed, operands before what is done with them.
/// Without a term: it nests too deep, which was reported.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Formula(pub Vec<Term>);

/// A part of an expression.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Term {
    /// The next operand.
    Operand,
    /// An operator's sign or a function's name, and how many of the results before it are used up.
    Apply(Name, u32),
}

/// One output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Output {
    /// A variable.
    Name(Name),
    /// `box.attribute`: in nets only.
    Member(Name, Name),
    /// `_`: discarded.
    Discard(Span),
}

impl Output {
    /// Its place.
    pub fn span(self) -> Span {
        match self {
            Output::Name(name) => name.span,
            Output::Member(name, member) => name.span.to(member.span),
            Output::Discard(span) => span,
        }
    }
}

/// One place of an input or parameter list.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// `K = ..`; boxed, as most items have none.
    pub(crate) label: Option<Box<Name>>,
    /// What is in it.
    pub value: Operand,
    /// The place of the value; for an empty one, where the comma, colon or parenthesis after it stands.
    pub span: Span,
}

impl Item {
    /// Whether nothing stands in it.
    pub fn is_empty(&self) -> bool {
        self.value == Operand::Empty
    }

    /// `K = ..`
    pub fn label(&self) -> Option<Name> {
        self.label.as_deref().copied()
    }
}

/// What stands in a place.
#[derive(Clone, Debug, PartialEq)]
pub enum Operand {
    /// Nothing.
    Empty,
    /// A variable, an enumeration's name, a constant of a composite.
    Name(Name),
    /// `a[1]`, `m[1,2]`
    Element(Box<(Name, Vec<(i32, Span)>)>),
    /// `TAG.output`
    Member(Box<(Name, Name)>),
    /// A number.
    Number(Number),
    /// A string: a parameter file or a text.
    Text(Span),
}

/// A line of a `.cfg` file.
#[derive(Clone, Debug, PartialEq)]
pub enum Line {
    /// A block.
    Block(Box<Statement>),
    /// `INITIALIZE`
    Initialize(Span),
    /// `PLANT`
    Plant(Span),
    /// `CONTROL [n [offset]]`
    Control(Span, Box<Vec<(u32, Span)>>),
    /// A section word whose line is not understood; what stands wrong there was reported.
    UnknownSection(Span),
    /// `END`
    End(Span),
}
