//! Random gates.

use super::Maker;
use crate::definition::model::{Arc, Gate, Kind, Route, Rule};

impl Maker<'_> {
    pub(super) fn gate(&mut self, name: &str) {
        let mut gate = Gate { name: name.to_owned(), ..Gate::default() };
        gate.before = self.arcs(3);
        // What nobody sees come or go needs no gate; most gates move something.
        if gate.before.is_empty() && !self.dice.once_in(4) {
            gate.before = self.arcs(1);
        }
        gate.after = self.arcs(3);
        gate.reads = self.asked_arcs();
        gate.reads.retain(|(path, _)| gate.before.iter().all(|(name, _)| name != path));
        gate.inhibits = self.asked_arcs();
        if self.dice.once_in(3) {
            gate.priority = self.dice.roll(5) as i64 - 2;
        }
        let asked: Vec<String> = gate.before.iter().chain(&gate.reads).map(|(name, _)| name.clone()).collect();
        let asked: Vec<String> = asked.into_iter().filter(|name| !name.contains('.')).collect();
        let asked = self.with_another(asked);
        if self.dice.once_in(3) {
            gate.permits = (0..1 + self.dice.below(2)).map(|_| self.condition(&asked)).collect();
        }
        self.rules(&mut gate, &asked);
        self.net.gates.push(gate);
    }

    /// Boxes whose attributes a gate speaks of, perhaps with one from which it takes nothing.
    fn with_another(&mut self, mut asked: Vec<String>) -> Vec<String> {
        let other = self.net.boxes[self.dice.below(self.net.boxes.len())].clone();
        if other.class.is_some() && !asked.contains(&other.name) && self.dice.once_in(4) {
            asked.push(other.name);
        }
        asked
    }

    /// Boxes, each once, with weights where tokens are plain.
    fn arcs(&mut self, most: usize) -> Vec<Arc> {
        let mut arcs: Vec<Arc> = Vec::new();
        for _ in 0..self.dice.below(most + 1) {
            let place = self.net.boxes[self.dice.below(self.net.boxes.len())].clone();
            if arcs.iter().any(|(known, _)| *known == place.name) {
                continue;
            }
            let most = match place.kind {
                Kind::Capacity(size, _) if place.class.is_none() => size.unwrap_or(2).min(2),
                Kind::Capacity(..)
                | Kind::State
                | Kind::Entry
                | Kind::Exit
                | Kind::Time(_)
                | Kind::Count(_)
                | Kind::Operation(_)
                | Kind::Signal(_)
                | Kind::Process(_)
                | Kind::Generate(_)
                | Kind::Macro(_) => 1,
            };
            arcs.push((place.name, 1 + self.dice.below(most)));
        }
        arcs
    }

    /// Boxes for READ and INHIBIT, perhaps inside.
    fn asked_arcs(&mut self) -> Vec<Arc> {
        if !self.dice.once_in(4) {
            return Vec::new();
        }
        if !self.net.parts.is_empty() && self.dice.once_in(2) {
            return vec![(self.box_inside(), 1)];
        }
        let mut arcs = self.arcs(1);
        for (name, weight) in &mut arcs {
            let room = self.net.room(self.net.place(name)).unwrap_or(3);
            *weight = 1 + self.dice.below(room.min(3));
        }
        arcs
    }

    fn class_name(&self, place: &str) -> Option<String> {
        self.net.boxes.iter().find(|known| known.name == place).and_then(|known| known.class.clone())
    }

    /// Whether tokens find their way without THEN.
    fn is_simple(&self, gate: &Gate) -> bool {
        let first = gate.before.first().and_then(|(name, _)| self.class_name(name));
        gate.after.iter().all(|(name, _)| self.class_name(name).is_none_or(|class| Some(class) == first))
    }

    fn rules(&mut self, gate: &mut Gate, asked: &[String]) {
        if self.is_simple(gate) && self.dice.once_in(2) {
            let condition = self.dice.once_in(2).then(|| self.condition(asked));
            gate.rules = vec![Rule { condition, routes: Vec::new(), acts: self.statements(1, asked) }];
            return;
        }
        let rules = 1 + self.dice.below(3);
        for at in 0..rules {
            let is_else = at > 0 && at + 1 == rules && self.dice.once_in(2);
            let condition = (!is_else && (at > 0 || rules > 1 || self.dice.once_in(2))).then(|| self.condition(asked));
            let routes = self.routes(gate, at + 1 == rules);
            gate.rules.push(Rule { condition, routes, acts: self.statements(2, asked) });
        }
        self.fill(gate);
    }

    fn routes(&mut self, gate: &Gate, last: bool) -> Vec<Route> {
        let (mut routes, mut filled) = (Vec::new(), Vec::new());
        for (from, _) in &gate.before {
            let class = self.class_name(from);
            let mut to = Vec::new();
            for (name, _) in &gate.after {
                if self.class_name(name) == class && !filled.contains(name) && !self.dice.once_in(3) {
                    to.push(name.clone());
                    filled.push(name.clone());
                }
            }
            routes.push(Route { from: Some(from.clone()), to });
        }
        let rest: Vec<String> =
            gate.after.iter().map(|(name, _)| name.clone()).filter(|name| !filled.contains(name)).collect();
        if !rest.is_empty() && (last || gate.before.is_empty() || self.dice.once_in(2)) {
            routes.push(Route { from: None, to: rest });
        }
        routes
    }

    /// A box after a gate that no rule fills is an error.
    fn fill(&mut self, gate: &mut Gate) {
        let without = gate.rules.iter().any(|rule| rule.routes.is_empty());
        if without && !self.is_simple(gate) {
            gate.after.clear();
        }
    }
}
