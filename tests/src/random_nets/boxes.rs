//! Random boxes.

use super::Maker;
use super::conditions::{two, word};
use crate::definition::expression::{Expression, Operator, Value};
use crate::definition::model::{Class, Gate, Generate, Kind, NetBox, Order, Process, Rule, Statement, Target, Word};

pub(super) fn plain(name: &str, kind: Kind) -> NetBox {
    NetBox { name: name.to_owned(), kind, class: None, marked: 0, with: Vec::new(), drives: Vec::new(), repeated: None }
}

/// `w1` is counted, other outputs get a value.
pub(super) fn first_write(name: &str, like: Value) -> Statement {
    let value = match like {
        Value::Int(_) if name == "w1" => two(Operator::Plus, word(name), Expression::Number(Value::Int(1))),
        Value::Int(_) => Expression::Number(Value::Int(1)),
        Value::Real(_) => Expression::Number(Value::Real(0.5)),
    };
    Statement { target: Target::Word(name.to_owned()), value }
}

impl Maker<'_> {
    pub(super) fn place(&mut self, name: &str) {
        let classes = self.net.classes.len();
        let class = (classes > 0 && self.dice.once_in(2)).then(|| self.net.classes[self.dice.below(classes)].clone());
        let own = [name.to_owned()];
        let mut place = plain(name, Kind::State);
        place.class = class.as_ref().map(|class| class.name.clone());
        // Statements and conditions of the box may speak of its token.
        self.net.boxes.push(place.clone());
        let size = 1 + self.dice.below(4);
        place.kind = match self.dice.roll(12) {
            0..3 => Kind::State,
            3 | 4 if class.is_none() && self.dice.once_in(4) => Kind::Capacity(None, Order::Fifo),
            3 | 4 => Kind::Capacity(Some(size), self.order(class.as_ref())),
            5 => Kind::Time(self.time()),
            6 => Kind::Count(size),
            7 => Kind::Operation(self.some_statements(&own)),
            8 => Kind::Signal(self.some_statements(&own)),
            9 | 10 => Kind::Process(self.process(name)),
            _ => Kind::Generate(self.generate(size, &own, class.as_ref())),
        };
        if matches!(place.kind, Kind::Count(_)) {
            place.class = None;
        }
        self.mark(&mut place, class.map(|class| class.attributes));
        for word in self.drivable.clone() {
            if self.dice.once_in(6) {
                place.drives.push(word);
            }
        }
        self.net.boxes.pop();
        self.net.boxes.push(place);
    }

    fn mark(&mut self, place: &mut NetBox, attributes: Option<Vec<Word>>) {
        let size = match place.kind {
            Kind::Capacity(size, _) => size.unwrap_or(5),
            Kind::Count(size) => size,
            Kind::Generate(_) => return,
            Kind::State
            | Kind::Entry
            | Kind::Exit
            | Kind::Time(_)
            | Kind::Operation(_)
            | Kind::Signal(_)
            | Kind::Process(_)
            | Kind::Macro(_) => 1,
        };
        if self.dice.once_in(2) {
            return;
        }
        place.marked = if self.dice.once_in(3) { 1 } else { 1 + self.dice.below(size) };
        if let (Some(attributes), Some(_), true) = (attributes, &place.class, self.dice.once_in(2)) {
            place.marked = 1;
            let Word { name, first } = attributes[self.dice.below(attributes.len())].clone();
            let first = match first {
                Value::Int(_) => Value::Int(2),
                Value::Real(_) => Value::Real(1.5),
            };
            place.with.push(Word { name, first });
        }
    }

    pub(super) fn order(&mut self, class: Option<&Class>) -> Order {
        let attribute = class.map(|class| class.attributes[self.dice.below(class.attributes.len())].name.clone());
        match (attribute, self.dice.roll(4)) {
            (Some(name), 0) => Order::Least(name),
            (Some(name), 1) => Order::Most(name),
            (_, roll) if roll % 2 == 0 => Order::Fifo,
            (_, _) => Order::Lifo,
        }
    }

    fn time(&mut self) -> Expression {
        match self.dice.roll(6) {
            0 => Expression::Number(Value::Real(0.3)),
            1 => Expression::Number(Value::Real(1.)),
            2 => Expression::Number(Value::Int(1)),
            3 => word(&self.ints[self.dice.below(self.ints.len())].clone()),
            _ => word(&self.reals[self.dice.below(self.reals.len())].clone()),
        }
    }

    fn some_statements(&mut self, own: &[String]) -> Vec<Statement> {
        let first = self.statement(own);
        let mut statements = vec![first];
        statements.extend(self.statements(1, own));
        statements
    }

    fn process(&mut self, name: &str) -> Process {
        let own = [name.to_owned()];
        let begins = self.statements(1, &own);
        let until = (!self.dice.once_in(3)).then(|| self.condition(&own));
        let within = self.dice.once_in(2).then(|| self.time());
        let mut after = Vec::new();
        if self.dice.once_in(2) {
            after.extend(self.statements(1, &own));
            after.push(Statement { target: Target::Ready(name.to_owned()), value: self.answer(name) });
        }
        Process { begins, until, within, after }
    }

    /// Ready, or wait.
    fn answer(&mut self, name: &str) -> Expression {
        let cause = Expression::Cause(name.to_owned());
        let x = word(&self.ints[self.dice.below(self.ints.len())].clone());
        match self.dice.roll(3) {
            0 => Expression::Not(Box::new(cause)),
            1 => x,
            _ => two(Operator::Or, cause, x),
        }
    }

    fn generate(&mut self, size: usize, own: &[String], class: Option<&Class>) -> Generate {
        let when = self.condition(&[]);
        Generate { size, order: self.order(class), when, begins: self.statements(1, own) }
    }

    /// Tokens with attributes that wait in an order, and a gate that chooses among them.
    pub(super) fn queue(&mut self) {
        let Some(class) = self.net.classes.first().cloned() else { return };
        let mut place = plain("queue", Kind::Capacity(Some(2 + self.dice.below(3)), self.order(Some(&class))));
        place.class = Some(class.name.clone());
        place.marked = self.dice.below(3);
        let mut source = plain("new", Kind::State);
        source.class = Some(class.name);
        self.net.boxes.extend([place, source]);
        let own = ["new".to_owned()];
        let mut any = || word(["x0", "x1", "z[1]", "z[2]", "w0"][self.dice.below(5)]);
        let (when, value, wanted) = (any(), any(), any());
        let due = word(["v", "u[1]", "u[2]"][self.dice.below(3)]);
        let attribute = |name: &str| Target::Attribute("new".to_owned(), name.to_owned());
        let mut begins = vec![Statement { target: attribute("a"), value }, self.statement(&own)];
        begins.push(Statement { target: attribute("b"), value: due });
        let generate = Generate { size: 1, order: Order::Fifo, when, begins };
        if let Some(source) = self.net.boxes.last_mut() {
            source.kind = Kind::Generate(generate);
        }
        let gate = |name: &str, from: &str, to: Vec<(String, usize)>, rules| Gate {
            name: name.to_owned(),
            before: vec![(from.to_owned(), 1)],
            after: to,
            rules,
            ..Gate::default()
        };
        self.net.gates.push(gate("comes", "new", vec![("queue".to_owned(), 1)], vec![Rule::default()]));
        // Seldom enough for several to wait; what has left is shown.
        let asked = || Expression::Attribute("queue".to_owned(), "a".to_owned());
        let shown = vec![Statement { target: Target::Word("w0".to_owned()), value: asked() }];
        let rule = |condition| Rule { condition: Some(condition), routes: Vec::new(), acts: shown.clone() };
        let chooses = two(Operator::And, word("x2"), two(Operator::Equal, asked(), wanted));
        let rules = vec![rule(chooses), rule(two(Operator::And, word("x1"), word("x2")))];
        self.net.gates.push(gate("goes", "queue", Vec::new(), rules));
    }

    /// A row of boxes through which tokens go, written as repeated lines.
    pub(super) fn row(&mut self) {
        self.repetitions += 1;
        // No index but the counter may stand in these lines.
        let (length, condition) = (2 + self.dice.below(2), word("x1"));
        let time = self.dice.once_in(2);
        for at in 1..=length {
            let kind = if time { Kind::Time(word("par")) } else { Kind::State };
            let mut place = plain(&format!("s[{at}]"), kind);
            place.repeated = Some(self.repetitions);
            self.net.boxes.push(place);
        }
        let mut last = plain(&format!("s[{}]", length + 1), Kind::State);
        last.marked = 1;
        self.net.boxes.push(last);
        for at in 1..=length {
            let asks = two(Operator::Or, word(&format!("z[{at}]")), condition.clone());
            let rule = Rule { condition: Some(asks), ..Rule::default() };
            self.net.gates.push(Gate {
                name: format!("h[{at}]"),
                before: vec![(format!("s[{}]", at + 1), 1)],
                after: vec![(format!("s[{at}]"), 1)],
                rules: vec![rule],
                repeated: Some(self.repetitions),
                ..Gate::default()
            });
        }
        self.net.gates.push(Gate {
            name: "round".to_owned(),
            before: vec![("s[1]".to_owned(), 1)],
            after: vec![(format!("s[{}]", length + 1), 1)],
            rules: vec![Rule::default()],
            ..Gate::default()
        });
    }
}
