//! Random nets that come to rest: without a clock, a GENERATE box and an operator, and with gates that lead back.
//!
//! Where no input changes and no gate fires, such a net does nothing. Tokens go round in rings, also in the nets inside;
//! what the nets tell one another lets the next gate fire.

use super::boxes::plain;
use super::conditions::{two, word};
use super::{Maker, Wanted, input, int, real};
use crate::definition::expression::{Expression, Operator, Value};
use crate::definition::model::{Abort, Active, Class, Gate, Input, Kind, Net, Order, Part, Process, Rule};
use crate::definition::model::{Route, Statement, Target};
use crate::dice::Dice;

/// Levels of nets inside the outermost one.
const LEVELS: usize = 3;
/// Most nets inside one.
const PARTS: usize = 2;

/// What of a net inside the one around it is told: an output that boxes drive, one that is written, a step.
const TOLD: [&str; 3] = ["d", "t", "s"];
const SWITCHES: [&str; 3] = ["x0", "x1", "x2"];

/// What the gates of a net wait for.
#[derive(Clone, Copy, PartialEq)]
enum Pace {
    /// An input; then tokens run on.
    Leads,
    /// What is told by nets inside.
    Follows,
    /// Anything.
    Mixed,
}

fn number(value: i32) -> Expression {
    Expression::Number(Value::Int(value))
}

fn route((from, to): (&String, &String)) -> Route {
    Route { from: Some(from.clone()), to: vec![to.clone()] }
}

fn not(condition: Expression) -> Expression {
    Expression::Not(Box::new(condition))
}

/// A random net that comes to rest, with random nets inside.
pub(super) fn net(dice: &mut Dice, name: &str, wanted: Wanted) -> Net {
    let mut maker = Maker::new(dice, name);
    maker.calm_head();
    maker.net.inputs.push(Input { size: Some(3), ..input(int("z", 0)) });
    maker.net.inputs.push(Input { cell: true, ..input(int("cmd", 0)) });
    maker.net.momentary.push("cmd".to_owned());
    maker.ints.extend(["z[1]", "z[2]", "z[3]", "cmd"].map(str::to_owned));
    if maker.dice.once_in(8) {
        maker.net.outputs.push(int("why", 0));
        maker.net.blocked = Some("why".to_owned());
        maker.ints.push("why".to_owned());
    }
    if wanted.classes {
        let attributes = vec![int("a", 1), real("b", 0.5)];
        maker.net.classes.push(Class { name: "c".to_owned(), attributes });
    }
    let rings = maker.rings(LEVELS);
    maker.calm_parts(LEVELS);
    maker.calm_ways(&rings);
    maker.calm_ends();
    maker.net
}

impl Maker<'_> {
    fn calm_head(&mut self) {
        self.net.outputs = vec![int("y0", 0), int("w0", 0), int("w1", 0), int("step", 0)];
        self.net.inputs = ["x0", "x1", "x2"].map(|name| input(int(name, 0))).to_vec();
        self.net.inputs.push(input(real("v", 0.)));
        self.net.parameters = vec![real("par", 0.6)];
        self.net.locals = vec![int("kept", 0), real("l1", 0.5)];
        let told = (0..PARTS).flat_map(|at| TOLD.map(|what| format!("{what}{at}")));
        let told: Vec<String> = told.collect();
        self.net.locals.extend(told.iter().map(|name| int(name, 0)));
        self.ints = ["x0", "x1", "x2", "y0", "w0", "w1", "step", "kept"].map(str::to_owned).to_vec();
        self.ints.extend(told);
        self.reals = ["v", "l1", "par"].map(str::to_owned).to_vec();
        self.writable = ["w0", "kept", "t0", "t1"].map(|name| int(name, 0)).to_vec();
    }

    /// Boxes of rings, by their names; the first of each is marked.
    fn rings(&mut self, levels: usize) -> Vec<Vec<String>> {
        let mut rings = Vec::new();
        for ring in ["a", "b", "e"].into_iter().take([1, 1, 1, 2, 3][self.dice.below(5)]) {
            let class = self.net.classes.first().filter(|_| ring == "a").map(|class| class.name.clone());
            let names: Vec<String> = (0..2 + self.dice.below(3)).map(|at| format!("{ring}{at}")).collect();
            for (at, name) in names.iter().enumerate() {
                self.calm_box(name, class.clone(), at == 0);
            }
            rings.push(names);
        }
        for ring in &mut rings {
            let plain = self.net.boxes.iter().all(|place| place.name != ring[0] || place.class.is_none());
            if levels > 0 && plain && self.net.parts.len() < PARTS && self.dice.once_in(3) {
                let at = self.net.parts.len();
                let home = ring[0].clone();
                ring.push(self.calm_macro(at, levels - 1, home));
            }
        }
        rings
    }

    fn calm_box(&mut self, name: &str, class: Option<String>, marked: bool) {
        let mut place = plain(name, Kind::State);
        let described = class.as_ref().and_then(|class| self.net.class(class)).cloned();
        place.class = class;
        self.net.boxes.push(place.clone());
        let own = [name.to_owned()];
        place.kind = match self.dice.roll(16) {
            0..8 => Kind::State,
            8..11 => Kind::Operation(self.calm_statements(&own)),
            11 | 12 => Kind::Signal(self.calm_statements(&own)),
            13 if self.dice.once_in(3) => Kind::Process(Process {
                begins: self.calm_statements(&own),
                until: Some(self.calm_condition(&own)),
                within: None,
                after: Vec::new(),
            }),
            _ => Kind::Capacity(Some(1 + self.dice.below(3)), self.order(described.as_ref())),
        };
        // Where tokens wait for an input, something is written once they have come.
        let waits = name.ends_with('0') || name.ends_with('1');
        if waits && self.dice.once_in(2) {
            let value = number(if marked { 1 } else { 2 });
            place.kind = Kind::Operation(vec![Statement { target: Target::Word("w0".to_owned()), value }]);
        }
        let room = if let Kind::Capacity(Some(size), Order::Fifo | Order::Lifo) = place.kind { size } else { 1 };
        place.marked = if marked { 1 + self.dice.below(room) } else { 0 };
        if self.dice.once_in(4) {
            place.drives.push("y0".to_owned());
        }
        self.net.boxes.pop();
        self.net.boxes.push(place);
    }

    /// Statements with which values go round, too.
    fn calm_statements(&mut self, own: &[String]) -> Vec<Statement> {
        (0..1 + self.dice.below(2)).map(|_| self.calm_statement(own)).collect()
    }

    fn calm_statement(&mut self, own: &[String]) -> Statement {
        if self.dice.once_in(4) {
            return self.statement(own);
        }
        let name = self.writable[self.dice.below(self.writable.len())].name.clone();
        let value = match self.dice.roll(4) {
            0 | 1 => number(self.dice.roll(3) as i32),
            2 => two(Operator::Less, number(2), word(&name)),
            _ => word(&self.ints[self.dice.below(self.ints.len())].clone()),
        };
        Statement { target: Target::Word(name), value }
    }

    fn pace(&mut self) -> Pace {
        let leads = if self.net.parts.is_empty() { 3 } else { 1 };
        match self.dice.roll(4) {
            0 => Pace::Mixed,
            roll if roll <= leads => Pace::Leads,
            _ => Pace::Follows,
        }
    }

    /// A condition that often comes true: over inputs, and over what nets and boxes tell.
    fn calm_condition(&mut self, asked: &[String]) -> Expression {
        let first = self.calm_truth(asked);
        match self.dice.roll(6) {
            0 => two(Operator::And, first, self.calm_truth(asked)),
            1 => two(Operator::Or, first, self.calm_truth(asked)),
            2 | 3 => two(Operator::Or, first, word(self.dice.one(&SWITCHES))),
            _ => first,
        }
    }

    fn calm_truth(&mut self, asked: &[String]) -> Expression {
        match self.dice.roll(10) {
            0 => word(self.dice.one(&SWITCHES)),
            1 => not(word(self.dice.one(&SWITCHES))),
            2..6 => self.calm_told(),
            6 | 7 => self.calm_tokens(),
            8 => not(self.calm_tokens()),
            _ => self.condition(asked),
        }
    }

    fn calm_told(&mut self) -> Expression {
        let told = self.told();
        let name = told[self.dice.below(told.len())].clone();
        match self.dice.roll(if name == "step" { 2 } else { 4 }) {
            0 | 1 => two(Operator::Equal, word(&name), number(self.dice.roll(3) as i32)),
            2 => not(word(&name)),
            _ => word(&name),
        }
    }

    /// What this net and those inside it tell, the latter twice as often.
    fn told(&self) -> Vec<String> {
        let parts = self.net.parts.iter().flat_map(|part| part.outputs.iter().flatten().cloned());
        let own = ["step", "y0", "w0", "kept"].map(str::to_owned);
        own.into_iter().chain(parts.clone()).chain(parts).collect()
    }

    fn calm_tokens(&mut self) -> Expression {
        self.some_box().map_or_else(|| word("x0"), Expression::Tokens)
    }

    /// Modules beside the rings.
    fn calm_parts(&mut self, levels: usize) {
        if levels == 0 {
            return;
        }
        while self.net.parts.len() < PARTS && !self.dice.once_in(if self.net.parts.is_empty() { 5 } else { 2 }) {
            let at = self.net.parts.len();
            let name = format!("{}v{at}", self.net.name);
            let mut maker = Maker::new(self.dice, &name);
            maker.calm_head();
            let rings = maker.rings(levels - 1);
            maker.calm_parts(levels - 1);
            maker.calm_ways(&rings);
            maker.calm_ends();
            let inner = maker.net;
            self.calm_part(&format!("V{at}"), at, inner, None);
        }
    }

    /// A macro, as a box of this net; its name.
    fn calm_macro(&mut self, at: usize, levels: usize, home: String) -> String {
        let mut maker = Maker::new(self.dice, &format!("{}k{at}", self.net.name));
        maker.calm_head();
        let mut way = vec!["come".to_owned()];
        maker.net.boxes.push(plain("come", Kind::Entry));
        for name in ["p0", "p1", "p2"].into_iter().take(1 + maker.dice.below(3)) {
            maker.calm_box(name, None, false);
            way.push(name.to_owned());
        }
        if levels > 0 && maker.dice.once_in(2) {
            way.push(maker.calm_macro(0, levels - 1, "p0".to_owned()));
        }
        maker.net.boxes.push(plain("gone", Kind::Exit));
        way.push("gone".to_owned());
        maker.calm_parts(levels);
        let switch = maker.dice.one(&SWITCHES);
        let pace = maker.pace();
        let leads_back = maker.dice.once_in(2);
        for (at, pair) in way.windows(2).enumerate() {
            maker.calm_gate(&format!("way{at}"), &pair[0], &pair[1], pace);
            if at == 0 && leads_back {
                maker.only_if(word(switch));
            }
        }
        if leads_back {
            maker.calm_gate("back", "p0", "come", Pace::Mixed);
            maker.only_if(not(word(switch)));
        }
        maker.calm_ends();
        let inner = maker.net;
        let name = format!("K{at}");
        let abort = self.dice.once_in(2).then(|| {
            let (condition, acts) = (self.calm_condition(&[]), self.calm_statements(&[]));
            Abort { condition, to: home, acts }
        });
        self.net.boxes.push(plain(&name, Kind::Macro(at)));
        self.calm_part(&name, at, inner, abort);
        name
    }

    fn calm_part(&mut self, name: &str, at: usize, net: Net, abort: Option<Abort>) {
        let wire = |input: &Input| match self.dice.once_in(2) {
            true => word(&input.name),
            false => self.wire(input.first),
        };
        let inputs = net.inputs.iter().map(wire).collect();
        let mut outputs: Vec<Option<String>> = vec![None; net.outputs.len()];
        for (what, output) in TOLD.into_iter().zip(["y0", "w0", "step"]) {
            // What the net inside is told itself.
            let output = if output == "w0" && self.dice.once_in(3) { "w1" } else { output };
            let place = net.outputs.iter().position(|word| word.name == output);
            if let (Some(place), false) = (place, self.dice.once_in(8)) {
                outputs[place] = Some(format!("{what}{at}"));
            }
        }
        // What the innermost net does comes out so, level by level.
        let written = ["w0", "w1"][self.dice.below(2)];
        let onward = [(0, "y0"), (1 + self.dice.below(2), written)];
        for (place, word) in onward.into_iter().filter(|_| at == 0) {
            if self.dice.once_in(2) {
                outputs[place] = Some(word.to_owned());
            }
        }
        self.net.parts.push(Part { name: name.to_owned(), net, outputs, inputs, parameters: Vec::new(), abort });
    }

    /// Gates round each ring, and some across. On its way round a token waits for an input to come and to go.
    fn calm_ways(&mut self, rings: &[Vec<String>]) {
        let pace = self.pace();
        for ring in rings {
            let switch = self.dice.one(&SWITCHES);
            for (at, from) in ring.iter().enumerate() {
                let to = &ring[(at + 1) % ring.len()];
                self.calm_gate(&format!("g_{from}"), from, to, pace);
                match at {
                    _ if pace == Pace::Follows => {}
                    0 => self.only_if(word(switch)),
                    1 => self.only_if(not(word(switch))),
                    _ => {}
                }
            }
            if self.dice.once_in(3) {
                let from = &ring[1 + self.dice.below(ring.len() - 1)];
                self.calm_gate(&format!("h_{from}"), from, &ring[0], Pace::Mixed);
                self.only_if(not(word(switch)));
            }
        }
        if let ([a, .., b], true) = (rings, self.dice.once_in(3)) {
            self.calm_gate("both", &b[0], &b[1], Pace::Mixed);
            self.only_if(word("x0"));
            if let Some(gate) = self.net.gates.last_mut() {
                gate.before.push((a[0].clone(), 1));
                gate.rules[0].routes = [(&b[0], &b[1]), (&a[0], &a[0])].map(route).to_vec();
                gate.after.push((a[0].clone(), 1));
            }
        }
    }

    /// One more condition for the last gate; now and then it is the only one.
    fn only_if(&mut self, switch: Expression) {
        let alone = self.dice.once_in(3);
        if let Some(rule) = self.net.gates.last_mut().and_then(|gate| gate.rules.first_mut()) {
            rule.condition = Some(match rule.condition.take() {
                Some(condition) if !alone => two(Operator::And, switch, condition),
                Some(_) | None => switch,
            });
        }
    }

    fn calm_gate(&mut self, name: &str, from: &str, to: &str, pace: Pace) {
        let asked = [from.to_owned()];
        let mut gate = Gate {
            name: name.to_owned(),
            before: vec![(from.to_owned(), 1)],
            after: vec![(to.to_owned(), 1)],
            ..Gate::default()
        };
        let condition = match pace {
            Pace::Leads => None,
            Pace::Follows => Some(self.calm_told()),
            Pace::Mixed => {
                self.calm_clauses(&mut gate, from);
                (!self.dice.once_in(4)).then(|| self.calm_condition(&asked))
            }
        };
        if self.dice.once_in(4) {
            gate.priority = self.dice.roll(5) as i64 - 2;
        }
        let acts = if self.dice.once_in(3) { self.calm_statements(&asked) } else { Vec::new() };
        gate.rules = vec![Rule { condition, routes: Vec::new(), acts }];
        self.net.gates.push(gate);
    }

    fn calm_clauses(&mut self, gate: &mut Gate, from: &str) {
        let other = |maker: &mut Self, times: u64| {
            let path = if maker.dice.once_in(times) { maker.some_box() } else { None };
            path.filter(|path| path != from).map(|path| (path, 1)).into_iter().collect()
        };
        gate.reads = other(self, 5);
        gate.inhibits = other(self, 6);
        if self.dice.once_in(4) {
            gate.permits = vec![self.calm_condition(&[from.to_owned()])];
        }
    }

    /// Every output is written, driven or told; the step is without a time.
    fn calm_ends(&mut self) {
        if !self.net.is_driven("y0") {
            let first = self.dice.below(2);
            self.net.boxes[first].drives.push("y0".to_owned());
        }
        let told = self.net.parts.iter().any(|part| part.bound("w1").next().is_some());
        let writes = [("w0", word("step")), ("w1", word("d0"))];
        for (name, value) in writes.into_iter().take(if told { 1 } else { 2 }) {
            let act = Statement { target: Target::Word(name.to_owned()), value };
            let gates = self.net.gates.len();
            self.net.gates[self.dice.below(gates)].rules[0].acts.push(act);
        }
        let names = self.net.boxes.iter().map(|place| place.name.clone());
        let of: Vec<String> = names.filter(|_| self.dice.once_in(2)).collect();
        let of = if of.is_empty() { vec![self.net.boxes[0].name.clone()] } else { of };
        self.net.active.push(Active { step: "step".to_owned(), time: None, of });
    }
}
