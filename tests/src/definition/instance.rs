//! A net that runs: its values, its tokens, and the parts of a scan one after the other.

use super::Fault;
use super::arrivals;
use super::expression::{Expression, Found, Value};
use super::model::{Input, Net, Part, Word};
use super::tokens::{Token, World};
use super::{boxes, gates, hands, outputs};
use std::collections::{BTreeMap, BTreeSet};

/// A run of a net.
pub struct Run<'n> {
    root: Instance<'n>,
    world: World,
    /// What the inputs are until they are written again.
    inputs: BTreeMap<String, Value>,
}

/// How a net is worked in a scan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mode {
    Automatic,
    /// Whether there is a step in this scan.
    Step(bool),
    Manual,
    Stopped,
}

/// The gate to which a statement belongs, by priority, then by its place in the file; the value of the higher one stays.
pub(super) type Rank = (i64, i64);

/// A statement of an ABORT, or of a token that no gate has put.
///
/// It counts as one of the gate that is tried first of all.
pub(super) const NOBODY: Rank = (i64::MAX, 0);

/// Tokens that go to a box at the end of the phase.
pub(super) struct Arrival {
    pub(super) place: usize,
    pub(super) token: Token,
    pub(super) rank: Rank,
}

/// A box that runs.
#[derive(Default)]
pub(super) struct BoxState {
    /// In the order in which they came.
    pub(super) tokens: Vec<Token>,
    /// The time at which the last token came.
    pub(super) since: i64,
    /// The gate that put it.
    pub(super) rank: Rank,
    /// Whether a gate may take tokens in this scan.
    pub(super) excited: bool,
    /// OPERATION, SIGNAL, PROCESS: statements have run.
    pub(super) begun: bool,
    /// PROCESS: complete.
    pub(super) complete: bool,
    /// PROCESS: when the timer started.
    pub(super) timer: i64,
    pub(super) cause: i32,
    pub(super) ready: bool,
    /// GENERATE: what the condition was.
    pub(super) held: bool,
    /// GENERATE: an edge waits for room.
    pub(super) waits: bool,
}

/// A net that runs.
pub(super) struct Instance<'n> {
    pub(super) net: &'n Net,
    pub(super) parts: Vec<Instance<'n>>,
    /// Inputs, parameters, outputs, locals.
    pub(super) words: BTreeMap<String, Value>,
    /// Outputs as they are seen from outside.
    pub(super) shown: BTreeMap<String, Value>,
    pub(super) boxes: Vec<BoxState>,
    pub(super) mode: Mode,
    /// The mode in the scan before.
    pub(super) before: Mode,
    /// Nanoseconds that it has run.
    pub(super) now: i64,
    /// The marking at the start of the phase.
    pub(super) start: Vec<Vec<Token>>,
    /// What was taken since.
    pub(super) taken: BTreeSet<Token>,
    /// How much room was filled since.
    pub(super) filled: Vec<usize>,
    pub(super) arriving: Vec<Arrival>,
    /// Outputs that statements wrote in this scan: the value, and whose it is.
    pub(super) written: BTreeMap<String, (Value, Rank)>,
    /// Outputs and locals that were written in this scan.
    pub(super) touched: BTreeSet<String>,
    /// Commands that were given in this scan, or read by a gate that fired: they become 0.
    pub(super) cleared: Vec<String>,
    /// For each ACTIVE the box, and since when.
    pub(super) active: Vec<(i32, i64)>,
    /// The first permissive that held a gate back in this scan.
    pub(super) held_back: i32,
}

/// Tokens in hand, by the box from which they came.
pub(super) type Hand = Vec<(String, Token)>;

impl<'n> Run<'n> {
    /// A run that begins; the period is in nanoseconds.
    pub fn new(net: &'n Net, period: i64) -> Run<'n> {
        let mut world = World::new(period);
        let inputs = net.inputs.iter().flat_map(|input| elements(input, !input.cell)).collect();
        Run { root: Instance::new(net, &[], &mut world), world, inputs }
    }

    /// A scan: what is written to inputs before it; what outputs, commands and boxes are after it; its faults.
    pub fn scan(&mut self, writes: &BTreeMap<String, Value>) -> (BTreeMap<String, Value>, Vec<Fault>) {
        self.inputs.extend(writes.iter().map(|(name, value)| (name.clone(), *value)));
        self.world.faults.clear();
        let (root, world) = (&mut self.root, &mut self.world);
        root.begin();
        root.latch(self.inputs.clone(), Mode::Automatic, world);
        boxes::phase(root, world);
        root.snapshot();
        gates::aborts(root, world);
        gates::gates(root, true, world);
        arrivals::arrive(root, world);
        outputs::follow(root, world);
        root.tick(world);
        for name in &root.cleared {
            self.inputs.insert(name.clone(), Value::Int(0));
        }
        (self.row(), self.world.faults.clone())
    }

    /// How often what happened so far.
    pub fn happened(&self) -> BTreeMap<&'static str, usize> {
        self.world.happened.borrow().clone()
    }

    fn row(&self) -> BTreeMap<String, Value> {
        let net = self.root.net;
        let cells = net.momentary.iter().chain(net.mode.iter().skip(1));
        let cells = cells.map(|name| (format!("{}.{name}", net.name), self.inputs[name]));
        let tokens = |(place, state): (&super::model::NetBox, &BoxState)| {
            (format!("{}.{}", net.name, place.name), Value::Int(i32::try_from(state.tokens.len()).unwrap_or(i32::MAX)))
        };
        let boxes = net.boxes.iter().zip(&self.root.boxes).map(tokens);
        self.root.shown.clone().into_iter().chain(cells).chain(boxes).collect()
    }
}

/// The elements of an input with their first values, or 0.
fn elements(input: &Input, zero: bool) -> Vec<(String, Value)> {
    let first = if zero { input.first.zero() } else { input.first };
    match input.size {
        None => vec![(input.name.clone(), first)],
        Some(size) => (1..=size).map(|at| (format!("{}[{at}]", input.name), first)).collect(),
    }
}

impl<'n> Instance<'n> {
    fn new(net: &'n Net, parameters: &[Word], world: &mut World) -> Instance<'n> {
        let words = net.parameters.iter().chain(parameters).chain(&net.outputs).chain(&net.locals);
        let mut instance = Instance {
            net,
            parts: net.parts.iter().map(|part| Instance::new(&part.net, &part.parameters, world)).collect(),
            words: words.map(|word| (word.name.clone(), word.first)).collect(),
            shown: net.outputs.iter().map(|word| (word.name.clone(), word.first)).collect(),
            boxes: net.boxes.iter().map(|_| BoxState { rank: NOBODY, ready: true, ..BoxState::default() }).collect(),
            mode: Mode::Automatic,
            before: Mode::Automatic,
            now: 0,
            start: Vec::new(),
            taken: BTreeSet::new(),
            filled: vec![0; net.boxes.len()],
            arriving: Vec::new(),
            written: BTreeMap::new(),
            touched: BTreeSet::new(),
            cleared: Vec::new(),
            active: Vec::new(),
            held_back: 0,
        };
        instance.mark(world);
        instance.active = net.active.iter().map(|active| (instance.first_marked(&active.of), 0)).collect();
        instance
    }

    /// Tokens at the start.
    fn mark(&mut self, world: &mut World) {
        for (place, state) in self.net.boxes.iter().zip(&mut self.boxes) {
            let class = place.class.as_ref().and_then(|class| self.net.class(class));
            for _ in 0..place.marked {
                let token = world.new_token(class);
                place.with.iter().for_each(|word| world.set_attribute(token, &word.name, word.first));
                state.tokens.push(token);
            }
        }
    }

    /// The place in a list of the first box that is marked, from 1; else 0.
    pub(super) fn first_marked(&self, list: &[String]) -> i32 {
        let marked = |name: &String| !self.boxes[self.net.place(name)].tokens.is_empty();
        list.iter().position(marked).map_or(0, |at| i32::try_from(at).unwrap_or(i32::MAX) + 1)
    }

    /// A scan begins, for all nets inside too.
    fn begin(&mut self) {
        self.written.clear();
        self.touched.clear();
        self.cleared.clear();
        self.held_back = 0;
        self.parts.iter_mut().for_each(Instance::begin);
        self.snapshot();
    }

    /// A phase begins, for all nets inside too.
    pub(super) fn snapshot(&mut self) {
        self.start = self.boxes.iter().map(|state| state.tokens.clone()).collect();
        self.taken.clear();
        self.filled.iter_mut().for_each(|filled| *filled = 0);
        self.parts.iter_mut().for_each(Instance::snapshot);
    }

    /// Takes inputs, and with them the mode.
    pub(super) fn latch(&mut self, inputs: BTreeMap<String, Value>, around: Mode, world: &mut World) {
        self.before = self.mode;
        self.words.extend(inputs);
        self.mode = hands::mode(self, around);
        hands::refuse_those_of_other_modes(self, world);
    }

    /// What the inputs of a part are.
    pub(super) fn inputs_of(&self, part: &Part, world: &World) -> BTreeMap<String, Value> {
        let mut inputs: BTreeMap<String, Value> =
            part.net.inputs.iter().flat_map(|input| elements(input, false)).collect();
        for (input, wired) in part.net.inputs.iter().zip(&part.inputs) {
            let value = wired.value(&|operand| self.find(operand, &[], world)).value;
            inputs.insert(input.name.clone(), value.like(input.first));
        }
        inputs
    }

    /// A scan ends: the time goes on where the net does.
    fn tick(&mut self, world: &World) {
        if self.mode != Mode::Stopped {
            self.now += world.period;
        }
        self.parts.iter_mut().for_each(|part| part.tick(world));
    }

    /// What an operand is.
    pub(super) fn find(&self, operand: &Expression, hand: &[(String, Token)], world: &World) -> Found {
        match operand {
            Expression::Word(name) => Found::from(self.words[name]),
            Expression::Tokens(path) => {
                let (instance, place) = self.at(path);
                Found::from(Value::Int(i32::try_from(instance.boxes[place].tokens.len()).unwrap_or(i32::MAX)))
            }
            Expression::Attribute(name, attribute) => match self.token_called(name, hand, world) {
                Some(token) => Found::from(world.attribute(token, attribute)),
                None => Found::from(self.attribute_of_a_new_token(name, attribute)),
            },
            Expression::Cause(name) => Found::from(Value::Int(self.boxes[self.net.place(name)].cause)),
            Expression::Number(_) | Expression::Not(_) | Expression::Minus(_) | Expression::Two(..) => {
                panic!("{operand:?} is no operand")
            }
        }
    }

    /// Whether a condition holds.
    pub(super) fn holds(&self, condition: &Expression, hand: &[(String, Token)], world: &World) -> bool {
        let found = condition.value(&|operand| self.find(operand, hand, world));
        !found.bad && found.value.int() != 0
    }

    /// A box of this net or, `part.box`, of one inside.
    pub(super) fn at(&self, path: &str) -> (&Instance<'n>, usize) {
        match path.split_once('.') {
            None => (self, self.net.place(path)),
            Some((part, rest)) => {
                let found = self.net.parts.iter().position(|known| known.name == part);
                self.parts[found.unwrap_or_else(|| panic!("no part {part}"))].at(rest)
            }
        }
    }

    /// The token in hand, else the first one of the box that no gate has taken.
    pub(super) fn token_called(&self, name: &str, hand: &[(String, Token)], world: &World) -> Option<Token> {
        let in_hand = hand.iter().find(|(from, _)| from == name).map(|(_, token)| *token);
        in_hand.or_else(|| self.first_left(self.net.place(name), world))
    }

    /// The first token of a box that no gate has taken; a macro's is the one in its exit while that is marked.
    pub(super) fn first_left(&self, place: usize, world: &World) -> Option<Token> {
        let tokens = world.in_order(self.net, place, &self.boxes[place].tokens);
        let own = tokens.into_iter().find(|token| !self.taken.contains(token))?;
        let inside = self.net.part_of(place).map(|part| &self.parts[part]);
        let at_the_exit = inside.and_then(|inside| inside.boxes[inside.net.exit()?].tokens.first());
        Some(at_the_exit.copied().unwrap_or(own))
    }

    /// What an attribute of a box without tokens is.
    fn attribute_of_a_new_token(&self, name: &str, attribute: &str) -> Value {
        let class = self.net.boxes[self.net.place(name)].class.as_ref().and_then(|class| self.net.class(class));
        let word = class.and_then(|class| class.attributes.iter().find(|word| word.name == attribute));
        word.map_or(Value::Int(0), |word| word.first)
    }
}
