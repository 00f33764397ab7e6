//! Random conditions and statements.

use super::Maker;
use crate::definition::expression::{Expression, Operator, Value};
use crate::definition::model::{Class, Kind, Statement, Target, Word};

pub(super) fn word(name: &str) -> Expression {
    Expression::Word(name.to_owned())
}

fn number(value: i32) -> Expression {
    Expression::Number(Value::Int(value))
}

pub(super) fn two(operator: Operator, a: Expression, b: Expression) -> Expression {
    Expression::Two(operator, Box::new(a), Box::new(b))
}

fn not(a: Expression) -> Expression {
    Expression::Not(Box::new(a))
}

const COMPARISONS: [Operator; 6] =
    [Operator::Above, Operator::AtLeast, Operator::Below, Operator::AtMost, Operator::Equal, Operator::Unequal];

impl Maker<'_> {
    fn any<'l>(&mut self, list: &'l [String]) -> &'l str {
        &list[self.dice.below(list.len())]
    }

    /// A condition; of the tokens in these boxes it may ask attributes.
    pub(super) fn condition(&mut self, asked: &[String]) -> Expression {
        self.truth(2, asked)
    }

    fn truth(&mut self, depth: usize, asked: &[String]) -> Expression {
        match self.dice.roll(if depth == 0 { 5 } else { 9 }) {
            0 => {
                let name = self.any(&["x0", "x1", "x2"].map(str::to_owned)).to_owned();
                self.input_or(&name)
            }
            1 => self.int(0, asked),
            2 => two(self.comparison(), self.int(1, asked), self.int(0, asked)),
            3 => two(self.comparison(), self.real(1, asked), self.real(0, asked)),
            4 => self.attribute(asked).map_or_else(|| number(1), |a| two(self.comparison(), a, self.int(0, asked))),
            5 => not(self.truth(depth - 1, asked)),
            6 | 7 => two(Operator::Or, self.truth(depth - 1, asked), self.truth(depth - 1, asked)),
            _ => two(Operator::And, self.truth(depth - 1, asked), self.truth(depth - 1, asked)),
        }
    }

    /// An input, or in a net that has none of this name any int.
    fn input_or(&mut self, name: &str) -> Expression {
        if self.ints.iter().any(|known| known == name) { word(name) } else { self.int(0, &[]) }
    }

    fn comparison(&mut self) -> Operator {
        COMPARISONS[self.dice.below(COMPARISONS.len())]
    }

    fn int(&mut self, depth: usize, asked: &[String]) -> Expression {
        match self.dice.roll(if depth == 0 { 7 } else { 9 }) {
            0..3 => word(self.any(&self.ints.clone())),
            3 => self.tokens(),
            4 => number(self.dice.roll(4) as i32),
            5 => self.int_attribute(asked).unwrap_or_else(|| number(2)),
            6 => self.cause().unwrap_or_else(|| number(1)),
            _ => {
                let operator = [Operator::Plus, Operator::Less, Operator::Times, Operator::Over][self.dice.below(4)];
                two(operator, self.int(depth - 1, asked), self.int(depth - 1, asked))
            }
        }
    }

    fn real(&mut self, depth: usize, asked: &[String]) -> Expression {
        match self.dice.roll(if depth == 0 { 6 } else { 9 }) {
            0..3 => word(self.any(&self.reals.clone())),
            3 => Expression::Number(Value::Real([0., 0.3, 0.5, 1., 2.5][self.dice.below(5)])),
            4 => self.real_attribute(asked).unwrap_or_else(|| word("par")),
            5 => Expression::Minus(Box::new(word(self.any(&self.reals.clone())))),
            6 => two(Operator::Over, self.real(depth - 1, asked), self.real(depth - 1, asked)),
            7 => two(Operator::Times, self.real(depth - 1, asked), self.int(depth - 1, asked)),
            _ => {
                let operator = [Operator::Plus, Operator::Less][self.dice.below(2)];
                two(operator, self.real(depth - 1, asked), self.real(depth - 1, asked))
            }
        }
    }

    /// The tokens of a box, perhaps of one inside.
    fn tokens(&mut self) -> Expression {
        Expression::Tokens(self.some_box().unwrap_or_else(|| "begin".to_owned()))
    }

    /// The path of a box, perhaps of one inside.
    pub(super) fn some_box(&mut self) -> Option<String> {
        if !self.net.parts.is_empty() && self.dice.once_in(4) {
            return Some(self.box_inside());
        }
        let boxes = self.net.boxes.len();
        (boxes > 0).then(|| self.net.boxes[self.dice.below(boxes)].name.clone())
    }

    pub(super) fn box_inside(&mut self) -> String {
        let part = &self.net.parts[self.dice.below(self.net.parts.len())];
        format!("{}.{}", part.name, part.net.boxes[self.dice.below(part.net.boxes.len())].name)
    }

    fn cause(&mut self) -> Option<Expression> {
        let has = |kind: &Kind| matches!(kind, Kind::Process(process) if !process.after.is_empty());
        let found = self.net.boxes.iter().find(|place| has(&place.kind));
        found.map(|place| Expression::Cause(place.name.clone()))
    }

    pub(super) fn class_of(&self, place: &str) -> Option<&Class> {
        let place = self.net.boxes.iter().find(|known| known.name == place)?;
        self.net.class(place.class.as_ref()?)
    }

    fn attribute(&mut self, asked: &[String]) -> Option<Expression> {
        if self.dice.once_in(2) { self.int_attribute(asked) } else { self.real_attribute(asked) }
    }

    fn int_attribute(&mut self, asked: &[String]) -> Option<Expression> {
        self.attribute_that(asked, |value| matches!(value, Value::Int(_)))
    }

    fn real_attribute(&mut self, asked: &[String]) -> Option<Expression> {
        self.attribute_that(asked, |value| matches!(value, Value::Real(_)))
    }

    fn attribute_that(&mut self, asked: &[String], is: impl Fn(Value) -> bool) -> Option<Expression> {
        let with_class: Vec<String> = asked.iter().filter(|name| self.class_of(name).is_some()).cloned().collect();
        if with_class.is_empty() {
            return None;
        }
        let place = self.any(&with_class).to_owned();
        let attribute = self.class_of(&place)?.attributes.iter().find(|word| is(word.first))?.name.clone();
        Some(Expression::Attribute(place, attribute))
    }

    /// An assignment to an output or a local, or to an attribute of a token in hand.
    pub(super) fn statement(&mut self, asked: &[String]) -> Statement {
        let with_class: Vec<String> = asked.iter().filter(|name| self.class_of(name).is_some()).cloned().collect();
        if !with_class.is_empty() && self.dice.once_in(2) {
            let place = self.any(&with_class).to_owned();
            let attributes = self.class_of(&place).map_or(Vec::new(), |class| class.attributes.clone());
            let Word { name, first } = attributes[self.dice.below(attributes.len())].clone();
            let value = self.assigned(&Expression::Attribute(place.clone(), name.clone()), first, asked);
            return Statement { target: Target::Attribute(place, name), value };
        }
        let Word { name, first } = self.writable[self.dice.below(self.writable.len())].clone();
        let value = self.assigned(&word(&name), first, asked);
        Statement { target: Target::Word(name), value }
    }

    /// A value for a place; quotients of reals would be faults of their own there.
    fn assigned(&mut self, old: &Expression, first: Value, asked: &[String]) -> Expression {
        let counts = self.dice.once_in(3);
        match first {
            Value::Int(_) if counts => two(Operator::Plus, old.clone(), number(1 + self.dice.roll(3) as i32)),
            Value::Int(_) if self.dice.once_in(4) => two(self.comparison(), self.real(0, asked), self.real(0, asked)),
            Value::Int(_) => self.int(1, asked),
            Value::Real(_) if counts => two(Operator::Plus, old.clone(), self.real(0, asked)),
            Value::Real(_) if self.dice.once_in(3) => two(Operator::Times, self.real(0, asked), self.int(0, asked)),
            Value::Real(_) => self.real(0, asked),
        }
    }

    pub(super) fn statements(&mut self, most: usize, asked: &[String]) -> Vec<Statement> {
        (0..self.dice.below(most + 1)).map(|_| self.statement(asked)).collect()
    }
}
