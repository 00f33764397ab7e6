//! What was written in a `.net` file, below its head.

use super::{Name, Number, Statement};
use crate::source::Span;
use crate::types::Scalar;

/// A line of a net.
#[derive(Clone, Debug, PartialEq)]
pub enum NetLine {
    /// `START out = value, ..`: what outputs are before anybody writes them.
    Start(Vec<Preset>),
    /// `STOP out = value, out = HOLD, ..`: what outputs are while the net is stopped.
    Stop(Vec<Halt>),
    /// `MOMENTARY start, ..`: cells that a gate clears when it fires.
    Momentary(Vec<Name>),
    /// `MODE mode, go, fire, put, take`: inputs by which an operator works the net; later ones may be left off.
    Mode(Vec<Name>),
    /// `LOCAL int n = 0, ..`
    Local(Vec<Typed>),
    /// `CLASS order ( int kind = 1, .. )`
    Class(Name, Vec<Typed>),
    /// A box.
    Box(Box<BoxLine>),
    /// `MACRO name : outputs = net ( .. : .. )` (true), or `MODULE ..`
    Part(bool, BoxName, Box<Statement>),
    /// `ABORT condition -> box`: of the macro above.
    Abort(Box<Statement>, BoxName),
    /// A gate.
    Gate(Box<GateLine>),
    /// `IF condition`: of the gate above.
    If(Box<Statement>),
    /// `ELSE`
    Else(Span),
    /// `THEN box -> box, ..`: of the IF above.
    Then(Route),
    /// `DO statement`: of the THEN, gate or box above.
    Do(Box<Statement>),
    /// `AFTER statement`: of the process box above.
    After(Box<Statement>),
    /// `ACTIVE step, time OF box, ..`
    Active(ActiveLine),
    /// `BLOCKED why`: an output that tells which permissive holds a gate back.
    Blocked(Name),
    /// `FOR i = 1 TO n`: the lines up to NEXT, n times.
    For(Name, (u32, Span), (u32, Span)),
    /// `NEXT`
    Next(Span),
    /// `END`
    End(Span),
    /// A line that was not understood, which was reported; true: it may declare a name.
    Broken(bool),
}

/// The name of a box, an index included: `idle[3]`; of a box in a part `F.S1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BoxName {
    /// The part that it stands in.
    pub part: Option<Name>,
    /// Its name there.
    pub name: Name,
}

impl BoxName {
    /// The place of the whole.
    pub fn span(self) -> Span {
        self.part.map_or(self.name.span, |part| part.span.to(self.name.span))
    }
}

/// `name = value`
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preset {
    /// What gets the value.
    pub name: Name,
    /// The value.
    pub value: Number,
    /// Where the value stands.
    pub span: Span,
}

/// `name = value`, `name = HOLD`
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Halt {
    /// The output.
    pub name: Name,
    /// The value that it has while the net is stopped, and where that stands; `None`: it holds its own.
    pub value: Option<(Number, Span)>,
}

/// `int name = value "unit"`
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Typed {
    /// Its number type.
    pub scalar: Scalar,
    /// Its name.
    pub name: Name,
    /// Its first value and where that stands.
    pub value: Option<(Number, Span)>,
    /// Its unit, quotes excluded.
    pub unit: Option<Span>,
}

/// The kinds of boxes that have a line of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BoxKind {
    /// A state: at most one token.
    State,
    /// A buffer or a queue.
    Capacity,
    /// Excited after a time.
    Time,
    /// Excited after a number of tokens.
    Count,
    /// Computes once when it is entered.
    Operation,
    /// Writes values once when it is entered.
    Signal,
    /// A function, a condition, a supervision time, another function.
    Process,
    /// Makes tokens.
    Generation,
    /// Where a macro's token comes in.
    Entry,
    /// Where a macro's token goes out.
    Exit,
}

/// A box.
#[derive(Clone, Debug, PartialEq)]
pub struct BoxLine {
    /// Its kind.
    pub kind: BoxKind,
    /// Its name.
    pub name: BoxName,
    /// The time or the number of tokens.
    pub quantity: Option<Box<Statement>>,
    /// What else was said.
    pub clauses: Vec<BoxClause>,
    /// The line.
    pub span: Span,
}

/// A clause of a box's line.
#[derive(Clone, Debug, PartialEq)]
pub enum BoxClause {
    /// `OF class`
    Of(Name),
    /// `SIZE n`
    Size(u32, Span),
    /// `ORDER fifo`, `ORDER lifo`, `ORDER least attribute`, `ORDER most attribute`
    Order(Name, Option<Name>),
    /// `MARKED`, `MARKED 3`, `MARKED ( id = 1 )`
    Marked(Option<(u32, Span)>, Vec<Preset>, Span),
    /// `DRIVES out, ..`
    Drives(Vec<Name>),
    /// `UNTIL condition`
    Until(Box<Statement>),
    /// `WHEN condition`
    When(Box<Statement>),
    /// `WITHIN t`
    Within(Box<Statement>),
    /// `DO statement`
    Do(Box<Statement>),
}

/// A gate.
#[derive(Clone, Debug, PartialEq)]
pub struct GateLine {
    /// Its name.
    pub name: BoxName,
    /// The boxes it takes from.
    pub before: Vec<ArcTerm>,
    /// The boxes it puts into.
    pub after: Vec<ArcTerm>,
    /// What else was said.
    pub clauses: Vec<GateClause>,
    /// The line.
    pub span: Span,
}

/// A clause of a gate's line.
#[derive(Clone, Debug, PartialEq)]
pub enum GateClause {
    /// `READ box, ..`
    Read(Vec<ArcTerm>),
    /// `INHIBIT box, ..`
    Inhibit(Vec<ArcTerm>),
    /// `PRIORITY n`
    Priority(i32, Span),
    /// `PERMIT term, ..`
    Permit(Vec<Statement>),
    /// `IF condition`
    If(Box<Statement>),
}

/// `2*box`
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArcTerm {
    /// How many tokens, as written.
    pub weight: Option<(u32, Span)>,
    /// The box.
    pub place: BoxName,
}

/// Where a token goes.
#[derive(Clone, Debug, PartialEq)]
pub struct Route {
    /// The box it was taken from; `None`: a new one.
    pub from: Option<BoxName>,
    /// Where it goes; to none it vanishes.
    pub to: Vec<BoxName>,
    /// The line.
    pub span: Span,
}

/// `ACTIVE step, time OF box, ..`
#[derive(Clone, Debug, PartialEq)]
pub struct ActiveLine {
    /// The output that gets the place of the marked box in the list, from 1.
    pub step: Name,
    /// The output that gets the time in it.
    pub time: Option<Name>,
    /// The boxes.
    pub boxes: Vec<BoxName>,
}
