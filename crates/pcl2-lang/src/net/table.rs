//! A net as the table that the player of the runtime walks (`runtime-c/src/net`).

use super::{
    Arc, BoxId, Drive, Gate, Kind, Level, Move, Net, NetBox, Order, Part, PartId, Rule, StatementId, Tested, WordId,
};
use crate::types::{Real, Scalar, Value};

/// A net as a table, and what an instance keeps beside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// The words.
    pub words: Vec<i32>,
    /// The attributes that are ints, place by place, at the start.
    pub ints: Vec<i32>,
    /// Those that are reals.
    pub reals: Vec<Real>,
    /// How many attributes of tokens in hand there are.
    pub hands: usize,
}

/// How many words stand at the start: the player's `PCL2_NET_HEAD`.
const HEAD: usize = 12;

/// The entries of the head that are no counts, in order.
#[derive(Clone, Copy)]
enum List {
    Boxes = 3,
    Gates,
    Scripts,
    Classes,
    Words,
    Levels,
    Actives,
    Parts,
    Operated,
}

/// Makes the table of a net. `inner` gives the net of each part, and of how many nets it is made, itself included.
pub fn table<'a>(net: &Net, inner: &dyn Fn(PartId) -> Option<(&'a Net, usize)>) -> Table {
    let mut builder = Builder { net, table: Table::default() };
    builder.table.words = vec![0; HEAD];
    builder.table.words[..3].copy_from_slice(&[count(net.boxes.len()), count(net.gates.len()), count(net.words.len())]);
    builder.records(List::Classes, net.classes.len(), |builder, i| builder.class(i));
    builder.records(List::Boxes, net.boxes.len(), |builder, i| builder.place(&net.boxes[i]));
    builder.records(List::Gates, net.gates.len(), |builder, i| builder.gate(&net.gates[i]));
    builder.records(List::Scripts, net.touched.len(), |builder, i| builder.script(i));
    builder.kept_words();
    builder.levels();
    builder.actives();
    if net.operation.is_some() || net.blocked.is_some() {
        builder.operated();
    }
    builder.start(List::Parts);
    builder.push([count(net.parts.len())]);
    let first = builder.reserve(net.parts.len());
    let mut distance = 1;
    for (i, part) in net.parts.iter().enumerate() {
        builder.table.words[first + i] = count(builder.table.words.len());
        let (inner, nets) = inner(PartId(i as u32)).unzip();
        builder.part(part, inner, distance);
        distance += nets.unwrap_or(0);
    }
    builder.table
}

/// Counts of a net are bounded by [`super::MAX_COUNT`] each.
fn count(length: usize) -> i32 {
    i32::try_from(length).unwrap_or(i32::MAX)
}

struct Builder<'n> {
    net: &'n Net,
    table: Table,
}

impl Builder<'_> {
    fn push<const N: usize>(&mut self, words: [i32; N]) {
        self.table.words.extend(words);
    }

    fn start(&mut self, list: List) {
        self.table.words[list as usize] = count(self.table.words.len());
    }

    fn reserve(&mut self, words: usize) -> usize {
        let first = self.table.words.len();
        self.table.words.resize(first + words, 0);
        first
    }

    /// A list of offsets, then the records.
    fn records(&mut self, list: List, length: usize, record: impl Fn(&mut Self, usize)) {
        self.start(list);
        let first = self.reserve(length);
        for i in 0..length {
            self.table.words[first + i] = count(self.table.words.len());
            record(self, i);
        }
    }

    fn class(&mut self, index: usize) {
        let attributes = &self.net.classes[index].attributes;
        self.push([count(attributes.len())]);
        self.table.words.extend(attributes.iter().map(|attribute| i32::from(attribute.scalar == Scalar::Real)));
    }

    fn place(&mut self, place: &NetBox) {
        let (order, attribute) = match place.order {
            Order::Fifo => (0, 0),
            Order::Lifo => (1, 0),
            Order::Least(attribute) => (2, attribute as i32),
            Order::Most(attribute) => (3, attribute as i32),
        };
        let kind = match place.kind {
            Kind::State | Kind::Capacity => 0,
            Kind::Time(_) => 1,
            Kind::Count => 2,
            Kind::Action(_) => 3,
            Kind::Process(_) => 4,
            Kind::Generation(_) => 5,
            Kind::Macro(_) => 6,
        };
        let class = place.class.map_or(0, |class| class.0 as i32 + 1);
        let capacity = place.capacity.map_or(0, |capacity| capacity as i32);
        let (ints, reals) = (count(self.table.ints.len()), count(self.table.reals.len()));
        self.push([kind, class, capacity, order, attribute, ints, reals, count(self.table.hands)]);
        self.tokens(place);
        let first_answer = self.table.hands;
        if place.asks() {
            self.table.hands += 2;
        }
        self.kind(place, count(first_answer));
    }

    /// The places of a box's tokens, and one more for what a new token has.
    fn tokens(&mut self, place: &NetBox) {
        let attributes = self.net.attributes(place);
        self.table.hands += attributes.len();
        if place.class.is_none() {
            return;
        }
        let places = place.capacity.unwrap_or(1);
        for i in 0..=places {
            for (attribute, preset) in attributes.iter().zip(&place.presets) {
                match if i < place.initial { preset } else { &attribute.initial } {
                    Value::Int(value) => self.table.ints.push(*value),
                    Value::Real(value) => self.table.reals.push(*value),
                    Value::Ints(_) | Value::Reals(_) | Value::Text(_) => {}
                }
            }
        }
    }

    fn kind(&mut self, place: &NetBox, answer: i32) {
        match &place.kind {
            Kind::State | Kind::Capacity | Kind::Count => {}
            Kind::Time(time) => self.push([time.0 as i32]),
            Kind::Action(statements) => self.statements(statements),
            Kind::Process(process) => {
                self.push([optional(process.until), optional(process.within)]);
                self.statements(&process.enter);
                self.statements(&process.after);
                self.push([answer]);
            }
            Kind::Generation(generation) => {
                self.push([generation.when.0 as i32]);
                self.statements(&generation.enter);
            }
            Kind::Macro(part) => self.push([part.0 as i32]),
        }
    }

    fn statements(&mut self, statements: &[StatementId]) {
        self.push([count(statements.len())]);
        self.table.words.extend(statements.iter().map(|statement| statement.0 as i32));
    }

    fn boxes(&mut self, boxes: &[BoxId]) {
        self.push([count(boxes.len())]);
        self.table.words.extend(boxes.iter().map(|place| place.0 as i32));
    }

    fn gate(&mut self, gate: &Gate) {
        let lengths = [gate.before.len(), gate.after.len(), gate.reads.len(), gate.inhibits.len()];
        self.push(lengths.map(count));
        self.push([count(gate.permits.len()), count(gate.rules.len())]);
        for arc in gate.before.iter().chain(&gate.after) {
            self.arc(arc);
        }
        for tested in gate.reads.iter().chain(&gate.inhibits) {
            self.tested(tested);
        }
        self.table.words.extend(gate.permits.iter().map(|permit| permit.condition.0 as i32));
        for rule in &gate.rules {
            self.rule(rule);
        }
    }

    fn arc(&mut self, arc: &Arc) {
        self.push([arc.place.0 as i32, weight(arc.weight)]);
    }

    fn tested(&mut self, tested: &Tested) {
        let part = tested.part.map_or(0, |part| part.0 as i32 + 1);
        self.push([part, tested.place.0 as i32, weight(tested.weight)]);
    }

    fn rule(&mut self, rule: &Rule) {
        self.push([optional(rule.condition)]);
        self.boxes(&rule.looks);
        self.push([count(rule.clears.len())]);
        self.table.words.extend(rule.clears.iter().map(|word| word.0 as i32));
        self.push([count(rule.moves.len())]);
        for Move { from, to } in &rule.moves {
            self.push([from.map_or(0, |from| from as i32 + 1), count(to.len())]);
            self.table.words.extend(to.iter().map(|index| *index as i32));
        }
        self.statements(&rule.actions);
    }

    fn script(&mut self, index: usize) {
        let touched = &self.net.touched[index];
        self.push([count(touched.writes.len())]);
        self.table.words.extend(touched.writes.iter().map(|word| word.0 as i32));
        self.push([count(touched.counts.len())]);
        self.table.words.extend(touched.counts.iter().map(|word| word.0 as i32));
        self.boxes(&touched.looks);
    }

    fn kept_words(&mut self) {
        self.start(List::Words);
        for word in &self.net.words {
            self.push([i32::from(word.scalar == Scalar::Real)]);
        }
        let first = self.table.words[List::Words as usize] as usize;
        for (word, _) in self.net.operation.iter().flat_map(|operation| &operation.stops) {
            self.table.words[first + word.0 as usize] |= 2;
        }
    }

    /// Modes, commands, and the numbers of permissive terms. What a word is while the net is stopped stands behind the
    /// attributes of tokens.
    fn operated(&mut self) {
        self.start(List::Operated);
        let optional = |word: Option<WordId>| word.map_or(0, |word| word.0 as i32 + 1);
        self.push([optional(self.net.blocked)]);
        let operation = self.net.operation.as_ref();
        self.push([optional(operation.map(|operation| operation.mode.1))]);
        self.push(operation.map_or([None; 4], |operation| operation.commands).map(optional));
        let stops = operation.map_or(&[][..], |operation| &operation.stops);
        self.push([count(stops.len())]);
        for (word, value) in stops {
            let place = match (value, self.net.words[word.0 as usize].scalar) {
                (Some(Value::Int(value)), _) => pushed(&mut self.table.ints, *value),
                (Some(Value::Real(value)), _) => pushed(&mut self.table.reals, *value),
                (_, Scalar::Int) => pushed(&mut self.table.ints, 0),
                (_, Scalar::Real) => pushed(&mut self.table.reals, Real::ZERO),
            };
            self.push([word.0 as i32, place, i32::from(value.is_none())]);
        }
        self.table.words.extend(self.net.numbered.iter().map(|gate| gate.0 as i32));
        self.table.words.extend(self.net.first_terms().iter().map(|term| *term as i32));
    }

    fn levels(&mut self) {
        self.start(List::Levels);
        let levels = |net: &Net| {
            let words = net.words.iter().enumerate();
            words
                .filter_map(|(i, word)| match &word.drive {
                    Drive::Level(levels) => Some((i, levels.clone())),
                    Drive::Written => None,
                })
                .collect::<Vec<(usize, Vec<Level>)>>()
        };
        let levels = levels(self.net);
        self.push([count(levels.len())]);
        for (word, levels) in levels {
            self.push([count(word)]);
            let boxes: Vec<BoxId> = levels
                .iter()
                .filter_map(|level| match level {
                    Level::Box(place) => Some(*place),
                    Level::Part(..) => None,
                })
                .collect();
            self.boxes(&boxes);
            let parts: Vec<[i32; 2]> = levels
                .iter()
                .filter_map(|level| match level {
                    Level::Box(_) => None,
                    Level::Part(part, output) => Some([part.0 as i32, *output as i32]),
                })
                .collect();
            self.push([count(parts.len())]);
            self.table.words.extend(parts.into_iter().flatten());
        }
    }

    fn actives(&mut self) {
        self.start(List::Actives);
        self.push([count(self.net.actives.len())]);
        for active in &self.net.actives {
            self.push([active.step.0 as i32, active.time.map_or(0, |word| word.0 as i32 + 1)]);
            self.boxes(&active.boxes);
        }
    }

    fn part(&mut self, part: &Part, inner: Option<&Net>, distance: usize) {
        let end = |place: Option<BoxId>| place.map_or(0, |place| place.0 as i32);
        let (entry, exit) = inner.map_or((0, 0), |net| (end(net.entry), end(net.exit)));
        self.push([entry, exit, count(distance), part.place.map_or(0, |place| place.0 as i32 + 1)]);
        match &part.abort {
            Some(abort) => {
                self.push([abort.condition.0 as i32 + 1, abort.to.0 as i32]);
                self.statements(&abort.actions);
                self.push([count(abort.clears.len())]);
                self.table.words.extend(abort.clears.iter().map(|word| word.0 as i32));
            }
            None => self.push([0, 0, 0, 0]),
        }
        self.push([count(part.writes.len())]);
        self.table.words.extend(part.writes.iter().flat_map(|(output, word)| [*output as i32, word.0 as i32]));
    }
}

/// Adds a value to a list, and tells its place there.
fn pushed<T>(list: &mut Vec<T>, value: T) -> i32 {
    list.push(value);
    count(list.len() - 1)
}

fn optional(statement: Option<StatementId>) -> i32 {
    statement.map_or(0, |statement| statement.0 as i32 + 1)
}

/// A weight beyond what a box can ever hold is never there.
fn weight(weight: u32) -> i32 {
    i32::try_from(weight).unwrap_or(i32::MAX)
}
