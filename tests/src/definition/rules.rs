//! Which rule a gate goes by, and which tokens it takes.

use super::instance::{Hand, Instance};
use super::model::{Gate, Kind, Rule};
use super::tokens::{Token, World};
use super::unsettled::Unsettled;

impl Instance<'_> {
    /// Tokens that a gate may take from a box, in the order in which the box gives them out.
    pub(super) fn to_take(&self, place: usize, world: &World) -> Vec<Token> {
        let there = |instance: &Instance, place: usize| -> Vec<Token> {
            let tokens = world.in_order(instance.net, place, &instance.start[place]);
            tokens.into_iter().filter(|token| !instance.taken.contains(token)).collect()
        };
        if !self.boxes[place].excited {
            return Vec::new();
        }
        let own = there(self, place);
        match self.net.boxes[place].kind {
            Kind::Macro(part) if own.is_empty() || self.parts[part].net.exit().is_none() => Vec::new(),
            Kind::Macro(part) => self.parts[part].net.exit().map_or(Vec::new(), |exit| there(&self.parts[part], exit)),
            // It gives one, when it is full.
            Kind::Count(size) if own.len() < size => Vec::new(),
            Kind::Count(_) => own[..1].to_vec(),
            Kind::State
            | Kind::Entry
            | Kind::Exit
            | Kind::Capacity(..)
            | Kind::Time(_)
            | Kind::Operation(_)
            | Kind::Signal(_)
            | Kind::Process(_)
            | Kind::Generate(_) => own,
        }
    }

    /// Whether tokens before a gate, its READ and its INHIBIT let it.
    pub(super) fn is_enabled(&self, gate: &Gate, world: &World) -> bool {
        gate.before.iter().all(|(name, weight)| self.to_take(self.net.place(name), world).len() >= *weight)
            && gate.reads.iter().all(|(path, weight)| {
                let (instance, place) = self.at(path);
                instance.boxes[place].excited && instance.start[place].len() >= *weight
            })
            && gate.inhibits.iter().all(|(path, weight)| {
                let (instance, place) = self.at(path);
                instance.start[place].len() < *weight
            })
    }

    /// What is read must have been there at the start of the phase.
    pub(super) fn mind_reads(&self, gate: &Gate, world: &World) {
        for (name, _) in gate.reads.iter().filter(|(name, _)| !name.contains('.')) {
            let place = self.net.place(name);
            let taken = self.start[place].iter().any(|token| self.taken.contains(token));
            if taken && self.net.boxes[place].class.is_some() {
                world.mind(Unsettled::ReadOfTaken);
            }
        }
    }

    /// The token of a macro that is taken is the one at its exit.
    pub(super) fn mind_macros(&self, gate: &Gate, rule: &Rule, hand: &[(String, Token)], world: &World) {
        for (name, token) in hand {
            let place = self.net.place(name);
            let asked = rule.condition.iter().chain(&gate.permits).any(|condition| condition.asks(name));
            let other = self.start[place].first().is_some_and(|own| !world.are_alike(*own, *token));
            if self.net.part_of(place).is_some() && asked && other {
                world.mind(Unsettled::TokenOfMacro);
            }
        }
    }

    /// The first rule that holds, with the tokens that satisfy it.
    pub(super) fn rule_that_holds<'g>(&self, gate: &'g Gate, world: &World) -> Option<(&'g Rule, Hand)> {
        gate.rules.iter().find_map(|rule| {
            let mut hands = self.hands(gate, rule, world).into_iter();
            hands.as_slice().iter().for_each(|hand| self.mind_macros(gate, rule, hand, world));
            let found =
                hands.find(|hand| rule.condition.as_ref().is_none_or(|condition| self.holds(condition, hand, world)));
            found.map(|hand| (rule, hand))
        })
    }

    /// The tokens that a gate has in hand, each way in which the rule's condition may try them; the last box changes
    /// first.
    pub(super) fn hands(&self, gate: &Gate, rule: &Rule, world: &World) -> Vec<Hand> {
        let mut hands: Vec<Hand> = vec![Vec::new()];
        let before = gate.before.iter().map(|(name, _)| (name, self.to_take(self.net.place(name), world)));
        let reads = gate.reads.iter().filter(|(name, _)| !name.contains('.'));
        let reads = reads.map(|(name, _)| {
            let place = self.net.place(name);
            (name, world.in_order(self.net, place, &self.start[place]))
        });
        for (name, tokens) in before.chain(reads) {
            let tried = rule.condition.as_ref().is_some_and(|condition| condition.asks(name));
            let tokens = if tried { &tokens[..] } else { &tokens[..1] };
            let with = |hand: &Hand, token: Token| hand.iter().cloned().chain([(name.clone(), token)]).collect();
            hands = hands.iter().flat_map(|hand| tokens.iter().map(move |token| with(hand, *token))).collect();
        }
        hands
    }
}
