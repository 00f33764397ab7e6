//! The structure of a net.

use super::expression::{Expression, Value};

/// A net: what one file says.
#[derive(Clone, Debug, Default)]
pub struct Net {
    /// The function code, and the name of the file.
    pub name: String,
    /// Outputs, with their values before the first scan.
    pub outputs: Vec<Word>,
    /// Inputs, in the order of the head.
    pub inputs: Vec<Input>,
    /// Parameters, with their defaults.
    pub parameters: Vec<Word>,
    /// Values of the net's own.
    pub locals: Vec<Word>,
    /// What outputs are while the net is stopped.
    pub stops: Vec<(String, Stop)>,
    /// Inputs that are commands.
    pub momentary: Vec<String>,
    /// The inputs of MODE: the mode, go, fire, put, take.
    pub mode: Vec<String>,
    /// Classes of tokens.
    pub classes: Vec<Class>,
    /// Boxes, macros among them, in the order of the file.
    pub boxes: Vec<NetBox>,
    /// Nets inside, in the order of the file.
    pub parts: Vec<Part>,
    /// Gates, in the order of the file.
    pub gates: Vec<Gate>,
    /// Outputs that tell which box is marked.
    pub active: Vec<Active>,
    /// The output that tells which permissive holds a gate back.
    pub blocked: Option<String>,
}

/// A name with a first value; the type of the value is its type.
#[derive(Clone, Debug)]
pub struct Word {
    /// Its name.
    pub name: String,
    /// Its first value.
    pub first: Value,
}

/// An input.
#[derive(Clone, Debug)]
pub struct Input {
    /// Its name.
    pub name: String,
    /// Its type, and its value where nothing is wired.
    pub first: Value,
    /// A vector's number of elements.
    pub size: Option<usize>,
    /// Whether an operator writes it where nothing is wired.
    pub cell: bool,
}

/// What an output is while the net is stopped.
#[derive(Clone, Copy, Debug)]
pub enum Stop {
    /// What it was.
    Hold,
    /// This value.
    Is(Value),
}

/// A class of tokens.
#[derive(Clone, Debug)]
pub struct Class {
    /// Its name.
    pub name: String,
    /// Attributes, with their first values.
    pub attributes: Vec<Word>,
}

/// A box.
#[derive(Clone, Debug)]
pub struct NetBox {
    /// Its name.
    pub name: String,
    /// What it does.
    pub kind: Kind,
    /// The class of its tokens.
    pub class: Option<String>,
    /// How many tokens it has at the start.
    pub marked: usize,
    /// Attributes of the token at the start that are not their class's first values.
    pub with: Vec<Word>,
    /// Outputs that are 1 while it is marked.
    pub drives: Vec<String>,
    /// The repetition, by number, in which it stands in the file.
    pub repeated: Option<usize>,
}

/// Kinds of boxes.
#[derive(Clone, Debug)]
pub enum Kind {
    /// One token.
    State,
    /// One token: where that of a macro comes in.
    Entry,
    /// One token: where that of a macro goes out.
    Exit,
    /// Many tokens; without a size any number.
    Capacity(Option<usize>, Order),
    /// One token, for a time.
    Time(Expression),
    /// So many tokens, then one.
    Count(usize),
    /// Statements on entry.
    Operation(Vec<Statement>),
    /// The same, by another name.
    Signal(Vec<Statement>),
    /// A function that takes its time.
    Process(Process),
    /// Tokens from nowhere.
    Generate(Generate),
    /// The box of a net inside, by its number among the parts.
    Macro(usize),
}

/// Which token goes first.
#[derive(Clone, Debug)]
pub enum Order {
    /// The one that came first.
    Fifo,
    /// The one that came last.
    Lifo,
    /// The one with the least attribute.
    Least(String),
    /// The one with the greatest attribute.
    Most(String),
}

/// What a PROCESS box does.
#[derive(Clone, Debug)]
pub struct Process {
    /// Run when the token has come.
    pub begins: Vec<Statement>,
    /// When it is complete.
    pub until: Option<Expression>,
    /// The supervision time.
    pub within: Option<Expression>,
    /// Run on completion and on a timeout.
    pub after: Vec<Statement>,
}

/// What a GENERATE box does.
#[derive(Clone, Debug)]
pub struct Generate {
    /// Its room.
    pub size: usize,
    /// Which token goes first.
    pub order: Order,
    /// Its condition.
    pub when: Expression,
    /// Run on the new token.
    pub begins: Vec<Statement>,
}

/// An assignment.
#[derive(Clone, Debug)]
pub struct Statement {
    /// What is written.
    pub target: Target,
    /// The value.
    pub value: Expression,
}

/// What a statement writes.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// An output or a local.
    Word(String),
    /// An attribute of a box's token.
    Attribute(String, String),
    /// `ready` of a PROCESS box.
    Ready(String),
}

/// A net inside this one.
#[derive(Clone, Debug)]
pub struct Part {
    /// Its name.
    pub name: String,
    /// The net.
    pub net: Net,
    /// Where its outputs go.
    pub outputs: Vec<Option<String>>,
    /// What its first inputs are.
    pub inputs: Vec<Expression>,
    /// Parameters that are not their defaults.
    pub parameters: Vec<Word>,
    /// What empties the macro.
    pub abort: Option<Abort>,
}

/// What empties a macro.
#[derive(Clone, Debug)]
pub struct Abort {
    /// When.
    pub condition: Expression,
    /// Where its token goes.
    pub to: String,
    /// What is run.
    pub acts: Vec<Statement>,
}

/// A box's name and a number of tokens.
pub type Arc = (String, usize);

/// A gate.
#[derive(Clone, Debug, Default)]
pub struct Gate {
    /// Its name.
    pub name: String,
    /// What it takes.
    pub before: Vec<Arc>,
    /// What it puts.
    pub after: Vec<Arc>,
    /// What must be there.
    pub reads: Vec<Arc>,
    /// What must not be there.
    pub inhibits: Vec<Arc>,
    /// The higher goes first.
    pub priority: i64,
    /// What must hold.
    pub permits: Vec<Expression>,
    /// Which way tokens go; at least one.
    pub rules: Vec<Rule>,
    /// The repetition, by number, in which it stands in the file.
    pub repeated: Option<usize>,
}

/// A rule of a gate.
#[derive(Clone, Debug, Default)]
pub struct Rule {
    /// When it holds; always if there is none.
    pub condition: Option<Expression>,
    /// Which way tokens go; none: to every box after the gate that of the first box before it.
    pub routes: Vec<Route>,
    /// What is run.
    pub acts: Vec<Statement>,
}

/// A THEN.
#[derive(Clone, Debug)]
pub struct Route {
    /// The box before the gate; none: new tokens.
    pub from: Option<String>,
    /// Boxes after the gate; none: the token vanishes.
    pub to: Vec<String>,
}

/// An ACTIVE line.
#[derive(Clone, Debug)]
pub struct Active {
    /// Filled with the place of the first marked box in the list.
    pub step: String,
    /// Filled with the seconds since that changed.
    pub time: Option<String>,
    /// The list.
    pub of: Vec<String>,
}

impl Net {
    /// The number of a box.
    ///
    /// # Panics
    /// When there is none of this name.
    pub fn place(&self, name: &str) -> usize {
        let found = self.boxes.iter().position(|place| place.name == name);
        found.unwrap_or_else(|| panic!("no box {name} in {}", self.name))
    }

    /// The class of a name.
    pub fn class(&self, name: &str) -> Option<&Class> {
        self.classes.iter().find(|class| class.name == name)
    }

    /// The part whose box this is.
    pub fn part_of(&self, place: usize) -> Option<usize> {
        match self.boxes[place].kind {
            Kind::Macro(part) => Some(part),
            Kind::State
            | Kind::Entry
            | Kind::Exit
            | Kind::Capacity(..)
            | Kind::Time(_)
            | Kind::Count(_)
            | Kind::Operation(_)
            | Kind::Signal(_)
            | Kind::Process(_)
            | Kind::Generate(_) => None,
        }
    }

    /// How many tokens a box holds; none: any number.
    pub fn room(&self, place: usize) -> Option<usize> {
        match &self.boxes[place].kind {
            Kind::Capacity(size, _) => *size,
            Kind::Count(size) => Some(*size),
            Kind::Generate(generate) => Some(generate.size),
            Kind::State
            | Kind::Entry
            | Kind::Exit
            | Kind::Time(_)
            | Kind::Operation(_)
            | Kind::Signal(_)
            | Kind::Process(_)
            | Kind::Macro(_) => Some(1),
        }
    }

    /// The box where a macro's token comes in.
    pub fn entry(&self) -> Option<usize> {
        self.boxes.iter().position(|place| matches!(place.kind, Kind::Entry))
    }

    /// The box where a macro's token goes out.
    pub fn exit(&self) -> Option<usize> {
        self.boxes.iter().position(|place| matches!(place.kind, Kind::Exit))
    }

    /// Whether an output follows boxes, those of parts too.
    pub fn is_driven(&self, word: &str) -> bool {
        self.boxes.iter().any(|place| place.drives.iter().any(|driven| driven == word))
            || self.parts.iter().any(|part| part.bound(word).any(|output| part.net.is_driven(output)))
    }
}

impl Active {
    /// Whether it fills an output.
    pub fn fills(&self, output: &str) -> bool {
        self.step == output || self.time.as_deref() == Some(output)
    }
}

impl Part {
    /// The outputs of the net inside that go to a word.
    pub fn bound<'p>(&'p self, word: &'p str) -> impl Iterator<Item = &'p str> {
        let pairs = self.net.outputs.iter().zip(&self.outputs);
        pairs.filter(move |(_, to)| to.as_deref() == Some(word)).map(|(output, _)| output.name.as_str())
    }
}
