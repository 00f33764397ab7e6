//! What a condition asks of the marking: presence of tokens, joined by AND, becomes read and inhibitor arcs.

use super::scopes::Scope;
use super::{inhibit, read};
use crate::pt::{Arc, PlaceId, Transition};
use pcl2_lang::ast::{Number, Operand, Statement, Term};
use pcl2_lang::net::{CAUSE, READY, StatementId};
use pcl2_lang::symbol::Symbols;

/// What must hold, all of it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Needs {
    /// At least so many tokens.
    least: Vec<Arc>,
    /// Fewer tokens.
    below: Vec<Arc>,
    /// And something else, which the marking does not tell.
    pub(super) open: bool,
}

/// When a condition is true, and when it is not.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Test {
    pub(super) yes: Needs,
    pub(super) no: Needs,
}

impl Needs {
    fn open() -> Needs {
        Needs { open: true, ..Needs::default() }
    }

    fn and(mut self, other: Needs) -> Needs {
        self.least.extend(other.least);
        self.below.extend(other.below);
        self.open |= other.open;
        self
    }

    /// Gives a transition the arcs.
    pub(super) fn restrict(&self, transition: &mut Transition) {
        self.least.iter().for_each(|arc| read(transition, *arc));
        self.below.iter().for_each(|arc| inhibit(transition, *arc));
    }
}

impl Test {
    /// A rule without a condition.
    pub(super) fn always() -> Test {
        Test::constant(true)
    }

    fn open() -> Test {
        Test { yes: Needs::open(), no: Needs::open() }
    }

    fn constant(holds: bool) -> Test {
        let test = Test { yes: Needs::default(), no: Needs::open() };
        if holds { test } else { test.not() }
    }

    fn at_least(place: PlaceId, tokens: i64) -> Test {
        match u64::try_from(tokens) {
            Ok(weight @ 1..) => {
                let arc = vec![Arc { place, weight }];
                let yes = Needs { least: arc.clone(), ..Needs::default() };
                Test { yes, no: Needs { below: arc, ..Needs::default() } }
            }
            Ok(0) | Err(_) => Test::constant(true),
        }
    }

    fn not(self) -> Test {
        Test { yes: self.no, no: self.yes }
    }

    /// Of what does not hold, one side is enough: nothing is known of either, unless one always holds.
    fn and(self, other: Test) -> Test {
        let always = |test: &Test| test.yes == Needs::default();
        let no = match (always(&self), always(&other)) {
            (true, _) => other.no,
            (false, true) => self.no,
            (false, false) => Needs::open(),
        };
        Test { yes: self.yes.and(other.yes), no }
    }
}

/// A result on the way.
#[derive(Clone, Debug)]
enum Value {
    Tokens(PlaceId),
    Number(i64),
    Test(Test),
    Other,
}

impl Value {
    fn test(self) -> Test {
        match self {
            Value::Tokens(place) => Test::at_least(place, 1),
            Value::Number(value) => Test::constant(value != 0),
            Value::Test(test) => test,
            Value::Other => Test::open(),
        }
    }
}

/// Reads a condition of a scope.
pub(super) fn test(scopes: &[Scope<'_>], scope: usize, id: StatementId, symbols: &Symbols) -> Test {
    let statement = scopes[scope].statement(id);
    let reader = Reader { scopes, scope: &scopes[scope], symbols };
    reader.value(statement).map_or_else(Test::open, Value::test)
}

struct Reader<'r, 'a> {
    scopes: &'r [Scope<'a>],
    scope: &'r Scope<'a>,
    symbols: &'r Symbols,
}

impl Reader<'_, '_> {
    fn value(&self, statement: &Statement) -> Option<Value> {
        let mut operands = statement.inputs().iter();
        let mut values = Vec::new();
        for term in &statement.formula.as_ref()?.0 {
            match term {
                Term::Operand => values.push(self.operand(&operands.next()?.value)),
                Term::Apply(name, count) => {
                    let rest = values.len().checked_sub(*count as usize)?;
                    let value = applied(self.symbols.text(name.symbol), values.split_off(rest));
                    values.push(value);
                }
            }
        }
        values.pop()
    }

    fn operand(&self, operand: &Operand) -> Value {
        let own = |name: &str| self.scope.find(name).map(|id| self.scope.place(id));
        let place = match operand {
            Operand::Number(Number::Int(value)) => return Value::Number(i64::from(*value)),
            Operand::Name(name) => own(self.symbols.text(name.symbol)),
            Operand::Element(element) => match element.1.as_slice() {
                [(index, _)] => own(&format!("{}[{index}]", self.symbols.text(element.0.symbol))),
                _ => None,
            },
            Operand::Member(member) => {
                self.inner(self.symbols.text(member.0.symbol), self.symbols.text(member.1.symbol))
            }
            Operand::Empty | Operand::Number(Number::Real(_)) | Operand::Text(_) => None,
        };
        place.map_or(Value::Other, Value::Tokens)
    }

    /// A box of a part, unless it is an attribute.
    fn inner(&self, owner: &str, member: &str) -> Option<PlaceId> {
        if let Some(place) = self.scope.find(owner).map(|id| self.scope.net.place(id)) {
            let attributes = self.scope.net.attributes(place);
            let own = place.asks() && [CAUSE, READY].contains(&member);
            if own || attributes.iter().any(|attribute| attribute.name == member) {
                return None;
            }
        }
        let part = self.scope.part(owner)?;
        let inner = &self.scopes[self.scope.parts[part.0 as usize]];
        inner.find(member).map(|id| inner.place(id))
    }
}

fn applied(sign: &str, operands: Vec<Value>) -> Value {
    let mut operands = operands.into_iter();
    // NOT is an operator; AND and OR stand there in small letters.
    let small = !sign.bytes().any(|letter| letter.is_ascii_uppercase());
    let word = if small || sign == "NOT" { &sign.to_ascii_uppercase() } else { "" };
    match (word, operands.next(), operands.next()) {
        ("NOT", Some(one), None) => Value::Test(one.test().not()),
        ("AND", Some(one), Some(other)) => Value::Test(one.test().and(other.test())),
        ("OR", Some(one), Some(other)) => Value::Test(one.test().not().and(other.test().not()).not()),
        (_, Some(Value::Tokens(place)), Some(Value::Number(number))) => compared(sign, place, number),
        (_, Some(Value::Number(number)), Some(Value::Tokens(place))) => compared(turned(sign), place, number),
        _ => Value::Other,
    }
}

/// The comparison with its sides changed.
fn turned(sign: &str) -> &str {
    match sign {
        "<" => ">",
        "<=" => ">=",
        ">" => "<",
        ">=" => "<=",
        _ => sign,
    }
}

fn compared(sign: &str, place: PlaceId, number: i64) -> Value {
    let at_least = |tokens| Test::at_least(place, tokens);
    Value::Test(match sign {
        ">=" => at_least(number),
        ">" => at_least(number + 1),
        "<" => at_least(number).not(),
        "<=" => at_least(number + 1).not(),
        "==" => at_least(number).and(at_least(number + 1).not()),
        "<>" => at_least(number).and(at_least(number + 1).not()).not(),
        _ => return Value::Other,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLACE: PlaceId = PlaceId(3);

    fn needs(least: &[u64], below: &[u64], open: bool) -> Needs {
        let arcs = |weights: &[u64]| weights.iter().map(|weight| Arc { place: PLACE, weight: *weight }).collect();
        Needs { least: arcs(least), below: arcs(below), open }
    }

    fn asked(sign: &str, number: i64) -> (Needs, Needs) {
        let test = applied(sign, vec![Value::Tokens(PLACE), Value::Number(number)]).test();
        (test.yes, test.no)
    }

    #[test]
    fn comparisons_with_numbers_ask_for_tokens() {
        assert_eq!(asked(">=", 2), (needs(&[2], &[], false), needs(&[], &[2], false)));
        assert_eq!(asked(">", 2), (needs(&[3], &[], false), needs(&[], &[3], false)));
        assert_eq!(asked("<", 2), (needs(&[], &[2], false), needs(&[2], &[], false)));
        assert_eq!(asked("<=", 0), (needs(&[], &[1], false), needs(&[1], &[], false)));
        assert_eq!(asked("==", 2), (needs(&[2], &[3], false), needs(&[], &[], true)));
        assert_eq!(asked("==", 0), (needs(&[], &[1], false), needs(&[1], &[], false)));
        assert_eq!(asked("<>", 0), (needs(&[1], &[], false), needs(&[], &[1], false)));
        assert_eq!(asked("+", 1), (needs(&[], &[], true), needs(&[], &[], true)));
    }

    #[test]
    fn alternatives_are_open_and_their_opposite_is_not() {
        let test = applied("or", vec![Value::Tokens(PLACE), Value::Tokens(PLACE)]).test();
        assert_eq!((test.yes, test.no), (needs(&[], &[], true), needs(&[], &[1, 1], false)));
        let test = applied("and", vec![Value::Tokens(PLACE), Value::Other]).test();
        assert_eq!((test.yes, test.no), (needs(&[1], &[], true), needs(&[], &[], true)));
        let test = applied("and", vec![Value::Number(1), Value::Tokens(PLACE)]).test();
        assert_eq!((test.yes, test.no), (needs(&[1], &[], false), needs(&[], &[1], false)));
    }
}
