//! A checked net: boxes, gates, and what they do, as indexes into one another.
//!
//! The statements of a net (conditions, times, functions, parts) are the body of its declaration, as a composite's are:
//! they have ports, outputs and parameters there, and a net says when each of them runs. What a net keeps in signals
//! (words, the attributes of the token in hand, the number of tokens of each box) stands among the signals of that
//! body, behind its ports, in the order of [`Net::signals`].

pub mod table;
pub mod written;

use crate::source::Span;
use crate::types::{Scalar, Shape, Type, Value};

/// The output of a net that has the number of tokens of each box: it is reached by the names of its boxes.
pub const BOX_OUTPUT: &str = "box";

/// Of a process box with AFTER: 0 completion, 1 timeout.
pub const CAUSE: &str = "cause";

/// Of a process box with AFTER: what AFTER answers, 0 to wait once more.
pub const READY: &str = "ready";

/// The most boxes, gates, statements, token places or words of one net.
pub const MAX_COUNT: usize = 0xffff;

/// The most outputs that one statement of a net writes.
pub const MAX_WRITES: usize = 16;

/// A checked net.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Net {
    /// Classes of tokens.
    pub classes: Vec<Class>,
    /// Boxes in order of declaration.
    pub boxes: Vec<NetBox>,
    /// Gates in the order in which a scan tries them: by priority, then by declaration.
    pub gates: Vec<Gate>,
    /// Nets inside it: macros and modules.
    pub parts: Vec<Part>,
    /// Outputs in the order of the head, then locals.
    pub words: Vec<Word>,
    /// How many words are outputs.
    pub outputs: usize,
    /// Commands that a gate clears when it fires: the port, and the word that takes its value in each scan.
    pub momentary: Vec<(u32, WordId)>,
    /// By which an operator works it.
    pub operation: Option<Operation>,
    /// The output with the number of the first permissive term that kept a gate from firing; 0: none did.
    pub blocked: Option<WordId>,
    /// The gates in the order of the file.
    pub numbered: Vec<GateId>,
    /// Where a macro's token comes in.
    pub entry: Option<BoxId>,
    /// Where a macro's token goes out.
    pub exit: Option<BoxId>,
    /// Outputs that tell which box is marked.
    pub actives: Vec<Active>,
    /// By statement: what it touches.
    pub touched: Vec<Touched>,
}

/// What a statement touches.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Touched {
    /// Outputs that it writes without reading them: two different values in one scan are a conflict.
    pub writes: Vec<WordId>,
    /// Outputs that it writes and reads.
    pub counts: Vec<WordId>,
    /// Boxes whose token it looks at or changes.
    pub looks: Vec<BoxId>,
}

/// An index into [`Net::boxes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BoxId(pub u32);

/// An index into [`Net::gates`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct GateId(pub u32);

/// An index into [`Net::parts`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PartId(pub u32);

/// An index into [`Net::words`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct WordId(pub u32);

/// An index into [`Net::classes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ClassId(pub u32);

/// A statement of the net's body: the block with this index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct StatementId(pub u32);

/// What tokens carry.
#[derive(Clone, Debug, PartialEq)]
pub struct Class {
    /// Its name.
    pub name: String,
    /// Its attributes.
    pub attributes: Vec<Attribute>,
}

/// A value that a token carries.
#[derive(Clone, Debug, PartialEq)]
pub struct Attribute {
    /// Its name.
    pub name: String,
    /// Its number type.
    pub scalar: Scalar,
    /// What a new token has.
    pub initial: Value,
    /// Its unit.
    pub unit: Option<String>,
}

/// A logical output, or a word of the net's own.
#[derive(Clone, Debug, PartialEq)]
pub struct Word {
    /// Its name.
    pub name: String,
    /// Its number type.
    pub scalar: Scalar,
    /// What it is before anybody writes it.
    pub initial: Value,
    /// Where its value comes from.
    pub drive: Drive,
    /// Where it is declared.
    pub span: Span,
}

/// Where a word's value comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum Drive {
    /// True while a box or an output of a part is.
    Level(Vec<Level>),
    /// Statements write it; what one wrote stays.
    Written,
}

/// What drives a level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// A marked box.
    Box(BoxId),
    /// An output of a part, by its index there.
    Part(PartId, u32),
}

/// A box.
#[derive(Clone, Debug, PartialEq)]
pub struct NetBox {
    /// Its name.
    pub name: String,
    /// What it does.
    pub kind: Kind,
    /// The class of its tokens; `None`: plain tokens.
    pub class: Option<ClassId>,
    /// The most tokens; `None`: any number, of plain tokens only.
    pub capacity: Option<u32>,
    /// Tokens at the start.
    pub initial: u32,
    /// The attributes of those.
    pub presets: Vec<Value>,
    /// Which token goes first.
    pub order: Order,
    /// The line.
    pub span: Span,
}

/// Which token is taken first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// The one that came first.
    #[default]
    Fifo,
    /// The one that came last.
    Lifo,
    /// The one with the least value of an attribute; of equals the one that came first.
    Least(u32),
    /// The one with the greatest value of an attribute; of equals the one that came first.
    Most(u32),
}

/// What a box does.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// A state: at most one token, excited when marked.
    State,
    /// A buffer: excited when marked.
    Capacity,
    /// Excited when this time, in seconds, has passed since the token came: a statement with one result.
    Time(StatementId),
    /// Excited when it is full; the gate takes one token, which empties it.
    Count,
    /// Runs its statements once, in the box phase after entry, and is then excited.
    Action(Vec<StatementId>),
    /// A function, a condition, a supervision time, another function.
    Process(Box<Process>),
    /// Makes tokens on the rising edge of a condition.
    Generation(Box<Generation>),
    /// Stands for a part: excited while the part's exit box is marked.
    Macro(PartId),
}

/// What a process box does.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Process {
    /// Run in the box phase after entry.
    pub enter: Vec<StatementId>,
    /// Completion; without it at the next scan.
    pub until: Option<StatementId>,
    /// The supervision time in seconds.
    pub within: Option<StatementId>,
    /// Run on completion or timeout: it sees the cause, [`CAUSE`], and answers [`READY`].
    pub after: Vec<StatementId>,
}

/// What a generation box does.
#[derive(Clone, Debug, PartialEq)]
pub struct Generation {
    /// Its condition.
    pub when: StatementId,
    /// Run on each new token.
    pub enter: Vec<StatementId>,
}

/// A gate.
#[derive(Clone, Debug, PartialEq)]
pub struct Gate {
    /// Its name.
    pub name: String,
    /// Boxes that it takes from.
    pub before: Vec<Arc>,
    /// Boxes that it puts into.
    pub after: Vec<Arc>,
    /// Boxes that must be excited; their tokens stay.
    pub reads: Vec<Tested>,
    /// Boxes that must have fewer tokens.
    pub inhibits: Vec<Tested>,
    /// Its priority.
    pub priority: i32,
    /// Permissives: each must hold.
    pub permits: Vec<Permit>,
    /// IF parts in order, the first that is true counts. At least one.
    pub rules: Vec<Rule>,
    /// The line.
    pub span: Span,
}

/// A box and a number of tokens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Arc {
    /// The box.
    pub place: BoxId,
    /// How many tokens.
    pub weight: u32,
}

/// A box, perhaps in a part, and a number of tokens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tested {
    /// The part, if it stands in one.
    pub part: Option<PartId>,
    /// The box there.
    pub place: BoxId,
    /// How many tokens.
    pub weight: u32,
}

/// A permissive.
#[derive(Clone, Debug, PartialEq)]
pub struct Permit {
    /// As written.
    pub text: String,
    /// Its condition.
    pub condition: StatementId,
}

/// An IF part with its THEN parts.
#[derive(Clone, Debug, PartialEq)]
pub struct Rule {
    /// The condition; `None`: always.
    pub condition: Option<StatementId>,
    /// Boxes before the gate, or read by it, whose tokens' attributes the condition looks at.
    pub looks: Vec<BoxId>,
    /// The commands that the condition reads.
    pub clears: Vec<WordId>,
    /// Where tokens go.
    pub moves: Vec<Move>,
    /// Run after tokens are taken and before they are put.
    pub actions: Vec<StatementId>,
    /// Where the IF stands.
    pub span: Span,
}

/// A token's way through a gate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Move {
    /// An index into [`Gate::before`]; `None`: a new token.
    pub from: Option<u32>,
    /// Indexes into [`Gate::after`]; none: the token vanishes.
    pub to: Vec<u32>,
}

/// A net inside a net.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Its name.
    pub name: String,
    /// The statement that connects it.
    pub statement: StatementId,
    /// A macro's box; `None`: a module.
    pub place: Option<BoxId>,
    /// What it writes: an output there, and the word that takes the value.
    pub writes: Vec<(u32, WordId)>,
    /// What empties it.
    pub abort: Option<Abort>,
    /// The line.
    pub span: Span,
}

/// What empties a macro.
#[derive(Clone, Debug, PartialEq)]
pub struct Abort {
    /// When.
    pub condition: StatementId,
    /// Where the token goes.
    pub to: BoxId,
    /// The commands that the condition reads.
    pub clears: Vec<WordId>,
    /// What is run then.
    pub actions: Vec<StatementId>,
}

/// Outputs that tell which box of a list is marked.
#[derive(Clone, Debug, PartialEq)]
pub struct Active {
    /// The output with the place of the first marked box in the list, from 1; 0 if none is.
    pub step: WordId,
    /// The output with the seconds since that changed.
    pub time: Option<WordId>,
    /// The boxes.
    pub boxes: Vec<BoxId>,
}

/// By which an operator works a net.
#[derive(Clone, Debug, PartialEq)]
pub struct Operation {
    /// The port with the mode, and the word that takes its value in each scan: 0 automatic, 1 step by step, 2 manual,
    /// else stopped.
    pub mode: (u32, WordId),
    /// Commands: a step, the number of a gate to fire, of a box to put a token into, of one to take a token from.
    pub commands: [Option<WordId>; 4],
    /// What outputs are while the net is stopped; `None`: what they were. The others do not change meanwhile.
    pub stops: Vec<(WordId, Option<Value>)>,
}

/// A signal that a net keeps.
#[derive(Clone, Debug, PartialEq)]
pub struct NetSignal {
    /// Its name.
    pub name: String,
    /// The box whose token in hand it belongs to: it is written `box.attribute`.
    pub owner: Option<String>,
    /// Its type.
    pub ty: Type,
}

impl NetBox {
    /// Whether it is a process box with a function that answers ready or wait.
    pub fn asks(&self) -> bool {
        match &self.kind {
            Kind::Process(process) => !process.after.is_empty(),
            Kind::State | Kind::Capacity | Kind::Time(_) | Kind::Count | Kind::Action(_) => false,
            Kind::Generation(_) | Kind::Macro(_) => false,
        }
    }
}

impl Net {
    /// A box.
    pub fn place(&self, id: BoxId) -> &NetBox {
        &self.boxes[id.0 as usize]
    }

    /// The ports whose value a word takes in each scan.
    pub fn latched(&self) -> impl Iterator<Item = (u32, WordId)> {
        self.momentary.iter().copied().chain(self.operation.iter().map(|operation| operation.mode))
    }

    /// By gate: the number of its first permissive term, counted from 1 through the gates in the order of the file.
    pub fn first_terms(&self) -> Vec<u32> {
        let mut first = vec![0; self.gates.len()];
        let mut next = 1;
        for gate in &self.numbered {
            first[gate.0 as usize] = next;
            next += self.gates[gate.0 as usize].permits.len() as u32;
        }
        first
    }

    /// The attributes of a box's tokens.
    pub fn attributes(&self, place: &NetBox) -> &[Attribute] {
        place.class.map_or(&[], |class| &self.classes[class.0 as usize].attributes)
    }

    /// The signals that stand behind the ports, in order: words, the number of tokens of each box, then of each box the
    /// attributes of the token in hand.
    pub fn signals(&self) -> Vec<NetSignal> {
        let word = |word: &Word| NetSignal {
            name: word.name.clone(),
            owner: None,
            ty: Type { scalar: word.scalar, shape: Shape::Scalar },
        };
        let mut signals: Vec<NetSignal> = self.words.iter().map(word).collect();
        let shape = Shape::Vector(self.boxes.len() as u32);
        signals.push(NetSignal { name: BOX_OUTPUT.to_owned(), owner: None, ty: Type { scalar: Scalar::Int, shape } });
        for place in &self.boxes {
            let owned = |name: &str, scalar: Scalar| NetSignal {
                name: name.to_owned(),
                owner: Some(place.name.clone()),
                ty: Type { scalar, shape: Shape::Scalar },
            };
            signals.extend(self.attributes(place).iter().map(|attribute| owned(&attribute.name, attribute.scalar)));
            if place.asks() {
                signals.extend([owned(CAUSE, Scalar::Int), owned(READY, Scalar::Int)]);
            }
        }
        signals
    }

    /// How many attributes all tokens have that its boxes can hold, and one more of each box for a new one.
    pub fn attribute_places(&self) -> u64 {
        let places =
            |place: &NetBox| (u64::from(place.capacity.unwrap_or(0)) + 1) * self.attributes(place).len() as u64;
        self.boxes.iter().map(places).sum()
    }

    /// The statements that are conditions.
    pub fn conditions(&self) -> Vec<StatementId> {
        let mut found = Vec::new();
        for place in &self.boxes {
            match &place.kind {
                Kind::Process(process) => found.extend(process.until),
                Kind::Generation(generation) => found.push(generation.when),
                Kind::State | Kind::Capacity | Kind::Time(_) | Kind::Count | Kind::Action(_) | Kind::Macro(_) => {}
            }
        }
        for gate in &self.gates {
            found.extend(gate.rules.iter().filter_map(|rule| rule.condition));
            found.extend(gate.permits.iter().map(|permit| permit.condition));
        }
        found.extend(self.parts.iter().filter_map(|part| part.abort.as_ref()).map(|abort| abort.condition));
        found
    }

    /// Whether anything in it depends on time.
    pub fn has_time(&self) -> bool {
        let timed = |place: &NetBox| match &place.kind {
            Kind::Time(_) => true,
            Kind::Process(process) => process.within.is_some(),
            Kind::State | Kind::Capacity | Kind::Count | Kind::Action(_) | Kind::Generation(_) | Kind::Macro(_) => {
                false
            }
        };
        self.boxes.iter().any(timed) || self.actives.iter().any(|active| active.time.is_some())
    }
}
