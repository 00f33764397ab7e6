//! Tokens: each is a list of attributes, and stays itself while it moves.

use super::Fault;
use super::expression::Value;
use super::model::{Class, Kind, Net, Order};
use std::cell::RefCell;
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// A token, by its number among all that ever were.
pub(super) type Token = usize;

/// What all nets of a run share.
pub(super) struct World {
    /// The attributes of every token that ever was.
    tokens: Vec<BTreeMap<String, Value>>,
    /// Faults of this scan.
    pub(super) faults: Vec<Fault>,
    /// How often what happened.
    pub(super) happened: RefCell<BTreeMap<&'static str, usize>>,
    /// Nanoseconds from scan to scan.
    pub(super) period: i64,
}

impl World {
    /// Without a token yet.
    pub(super) fn new(period: i64) -> World {
        World { tokens: Vec::new(), faults: Vec::new(), happened: RefCell::default(), period }
    }

    /// Counts what happens, so that a comparison can tell what it has seen.
    pub(super) fn note(&self, what: &'static str) {
        *self.happened.borrow_mut().entry(what).or_insert(0) += 1;
    }

    /// A token with the first values of its class.
    pub(super) fn new_token(&mut self, class: Option<&Class>) -> Token {
        let attributes = class.map_or(&[][..], |class| &class.attributes);
        self.tokens.push(attributes.iter().map(|word| (word.name.clone(), word.first)).collect());
        self.tokens.len() - 1
    }

    /// Another token like this one.
    pub(super) fn copy(&mut self, token: Token) -> Token {
        self.tokens.push(self.tokens[token].clone());
        self.tokens.len() - 1
    }

    pub(super) fn attribute(&self, token: Token, name: &str) -> Value {
        self.tokens[token][name]
    }

    pub(super) fn set_attribute(&mut self, token: Token, name: &str, value: Value) {
        let old = self.tokens[token][name];
        self.tokens[token].insert(name.to_owned(), value.like(old));
    }

    /// Tokens of a box in the order in which it gives them out.
    pub(super) fn in_order(&self, net: &Net, place: usize, tokens: &[Token]) -> Vec<Token> {
        let mut tokens = tokens.to_vec();
        // A bad attribute is none: its token goes last.
        let key = |token: &Token, name: &str| Some(self.attribute(*token, name).real()).filter(|real| real.is_finite());
        let by = |a: &Token, b: &Token, name: &str, first: Ordering| match (key(a, name), key(b, name)) {
            (Some(a), Some(b)) if a < b => first,
            (Some(a), Some(b)) if a > b => first.reverse(),
            (Some(_), Some(_)) | (None, None) => Ordering::Equal,
            (Some(_), None) => Ordering::Less,
            (None, Some(_)) => Ordering::Greater,
        };
        match order_of(net, place) {
            Order::Fifo => {}
            Order::Lifo => tokens.reverse(),
            Order::Least(name) => tokens.sort_by(|a, b| by(a, b, name, Ordering::Less)),
            Order::Most(name) => tokens.sort_by(|a, b| by(a, b, name, Ordering::Greater)),
        }
        tokens
    }
}

fn order_of(net: &Net, place: usize) -> &Order {
    match &net.boxes[place].kind {
        Kind::Capacity(_, order) => order,
        Kind::Generate(generate) => &generate.order,
        Kind::State
        | Kind::Entry
        | Kind::Exit
        | Kind::Time(_)
        | Kind::Count(_)
        | Kind::Operation(_)
        | Kind::Signal(_)
        | Kind::Process(_)
        | Kind::Macro(_) => &Order::Fifo,
    }
}
