//! Which rule a gate goes by, and which tokens it takes.

use super::instance::{Hand, Instance};
use super::model::{Gate, Kind, Rule};
use super::tokens::{Token, World};

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

    /// The first rule that holds, with the tokens that satisfy it.
    pub(super) fn rule_that_holds<'g>(&self, gate: &'g Gate, world: &World) -> Option<(&'g Rule, Hand)> {
        gate.rules.iter().find_map(|rule| {
            let mut hands = self.hands(gate, rule, world).into_iter();
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
        // Tokens that a gate has taken in this scan are not looked at.
        let reads = reads.map(|(name, _)| (name, self.to_take(self.net.place(name), world)));
        for (name, tokens) in before.chain(reads) {
            let tried = rule.condition.as_ref().is_some_and(|condition| condition.asks(name));
            if tokens.is_empty() && !tried {
                continue;
            }
            let tokens = if tried { &tokens[..] } else { &tokens[..1] };
            let with = |hand: &Hand, token: Token| hand.iter().cloned().chain([(name.clone(), token)]).collect();
            hands = hands.iter().flat_map(|hand| tokens.iter().map(move |token| with(hand, *token))).collect();
        }
        hands
    }
}
