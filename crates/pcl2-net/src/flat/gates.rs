//! Gates -> transitions: one for each rule, and what boxes make by themselves.

use super::condition::{Test, test};
use super::{Flattener, inhibit, read};
use crate::pt::{Arc, PlaceId, Transition};
use pcl2_lang::net::{self, BoxId, Gate, Kind, Rule, Tested};

/// Room that a rule needs: indexes into the boxes after its gate.
type Room = Vec<u32>;

impl Flattener<'_> {
    /// The transitions of a scope's gates, then its sources.
    pub(super) fn gates(&mut self, scope: usize) -> Vec<Transition> {
        let net = self.scopes[scope].net;
        let mut rows = Vec::new();
        for gate in &net.gates {
            let number = self.next_gate();
            rows.extend(self.gate(scope, gate).into_iter().map(|row| Transition { gate: number, ..row }));
        }
        for place in self.scopes[scope].generations() {
            rows.push(self.source(place));
        }
        rows
    }

    /// A token comes into a GENERATE box.
    fn source(&mut self, place: PlaceId) -> Transition {
        let name = format!("+{}", self.places[place.0 as usize].name);
        let gate = self.next_gate();
        Transition { name, puts: vec![Arc { place, weight: 1 }], free: true, gate, ..Transition::default() }
    }

    fn gate(&self, scope: usize, gate: &Gate) -> Vec<Transition> {
        let base = self.base(scope, gate);
        let tests: Vec<Test> = gate.rules.iter().map(|rule| self.rule_test(scope, rule)).collect();
        let rooms: Vec<Room> = gate.rules.iter().map(|rule| self.room(scope, gate, rule)).collect();
        let mut rows = Vec::new();
        for (i, rule) in gate.rules.iter().enumerate() {
            let mut transition = base.clone();
            if gate.rules.len() > 1 {
                transition.name = format!("{}/{}", base.name, i + 1);
            }
            tests[i].yes.restrict(&mut transition);
            transition.free |= tests[i].yes.open;
            for (earlier, room) in tests.iter().zip(&rooms).take(i) {
                earlier.no.restrict(&mut transition);
                // Where an earlier rule needs no other room, one of the two fires; else it may hold the gate back.
                transition.free |= earlier.no.open && room.iter().any(|index| !rooms[i].contains(index));
            }
            self.puts(scope, gate, rule, &mut transition);
            rows.push(transition);
        }
        rows
    }

    fn rule_test(&self, scope: usize, rule: &Rule) -> Test {
        rule.condition.map_or_else(Test::always, |id| test(&self.scopes, scope, id, self.symbols))
    }

    /// What all rules of a gate have in common.
    fn base(&self, scope: usize, gate: &Gate) -> Transition {
        let own = &self.scopes[scope];
        let mut transition = Transition { name: format!("{}{}", own.prefix, gate.name), ..Transition::default() };
        for arc in &gate.before {
            self.takes(scope, arc, &mut transition);
        }
        for tested in &gate.reads {
            self.reads(scope, tested, &mut transition);
        }
        for tested in &gate.inhibits {
            let place = self.tested_scope(scope, tested).1;
            inhibit(&mut transition, Arc { place, weight: u64::from(tested.weight) });
        }
        for permit in &gate.permits {
            let test = test(&self.scopes, scope, permit.condition, self.symbols);
            test.yes.restrict(&mut transition);
            transition.free |= test.yes.open;
        }
        transition
    }

    fn takes(&self, scope: usize, arc: &net::Arc, transition: &mut Transition) {
        let own = &self.scopes[scope];
        let place = own.net.place(arc.place);
        // A gate takes one token of a counting box, which empties it.
        let weight = if place.kind == Kind::Count { place.capacity.unwrap_or(1) } else { arc.weight };
        transition.takes.push(Arc { place: own.place(arc.place), weight: u64::from(weight) });
        transition.takes.extend(self.exit(scope, arc.place).map(|place| Arc { place, weight: 1 }));
        transition.free |= is_timed(&place.kind);
    }

    fn reads(&self, scope: usize, tested: &Tested, transition: &mut Transition) {
        let (scope, place) = self.tested_scope(scope, tested);
        let looked_at = self.scopes[scope].net.place(tested.place);
        let full = if looked_at.kind == Kind::Count { looked_at.capacity } else { None };
        let weight = u64::from(full.map_or(tested.weight, |full| full.max(tested.weight)));
        read(transition, Arc { place, weight });
        if let Some(place) = self.exit(scope, tested.place) {
            read(transition, Arc { place, weight: 1 });
        }
        transition.free |= is_timed(&looked_at.kind);
    }

    /// The scope in which a box is looked at, and its place.
    fn tested_scope(&self, scope: usize, tested: &Tested) -> (usize, PlaceId) {
        let inner = tested.part.map_or(scope, |part| self.scopes[scope].parts[part.0 as usize]);
        (inner, self.scopes[inner].place(tested.place))
    }

    /// The scope behind a macro's box.
    pub(super) fn inside(&self, scope: usize, id: BoxId) -> Option<usize> {
        match self.scopes[scope].net.place(id).kind {
            Kind::Macro(part) => Some(self.scopes[scope].parts[part.0 as usize]),
            Kind::State | Kind::Capacity | Kind::Time(_) | Kind::Count | Kind::Action(_) => None,
            Kind::Process(_) | Kind::Generation(_) => None,
        }
    }

    fn exit(&self, scope: usize, id: BoxId) -> Option<PlaceId> {
        let inner = &self.scopes[self.inside(scope, id)?];
        inner.net.exit.map(|exit| inner.place(exit))
    }

    fn puts(&self, scope: usize, gate: &Gate, rule: &Rule, transition: &mut Transition) {
        for arc in after(gate, rule) {
            let is_before = gate.before.iter().any(|before| before.place == arc.place);
            self.put(scope, arc, is_before, transition);
        }
    }

    /// A token comes into a box. No token enters a macro while anything in it is marked.
    pub(super) fn put(&self, scope: usize, arc: &net::Arc, is_before: bool, transition: &mut Transition) {
        let own = &self.scopes[scope];
        transition.puts.push(Arc { place: own.place(arc.place), weight: u64::from(arc.weight) });
        // A counting box that a gate empties and fills again has less room than its change tells.
        transition.free |= is_before && arc.weight > 1 && own.net.place(arc.place).kind == Kind::Count;
        let Some(inner) = self.inside(scope, arc.place).map(|inner| &self.scopes[inner]) else {
            return;
        };
        transition.puts.extend(inner.net.entry.map(|entry| Arc { place: inner.place(entry), weight: 1 }));
        // What the gate itself takes stands in the exit.
        let exit = inner.net.exit.map(|exit| inner.place(exit)).filter(|_| is_before);
        let detail = self.inside(scope, arc.place).map_or(Vec::new(), |inner| self.detail(inner));
        let others = detail.into_iter().filter(|place| Some(*place) != exit);
        others.for_each(|place| inhibit(transition, Arc { place, weight: 1 }));
    }

    /// The places of a macro's net and of the macros inside it.
    fn detail(&self, scope: usize) -> Vec<PlaceId> {
        let net = self.scopes[scope].net;
        let mut places: Vec<PlaceId> = self.scopes[scope].place_ids().collect();
        for id in (0..net.boxes.len() as u32).map(BoxId) {
            places.extend(self.inside(scope, id).into_iter().flat_map(|inner| self.detail(inner)));
        }
        places
    }

    fn room(&self, scope: usize, gate: &Gate, rule: &Rule) -> Room {
        let net = self.scopes[scope].net;
        let needs = |index: &u32| {
            let arc = &gate.after[*index as usize];
            let taken = gate.before.iter().find(|before| before.place == arc.place).map_or(0, |before| before.weight);
            arc.weight > taken && net.place(arc.place).capacity.is_some()
        };
        rule.moves.iter().flat_map(|way| &way.to).copied().filter(needs).collect()
    }
}

/// Whether time, or what a function says, decides when the box is excited.
fn is_timed(kind: &Kind) -> bool {
    match kind {
        Kind::Time(_) | Kind::Process(_) => true,
        Kind::State | Kind::Capacity | Kind::Count | Kind::Action(_) | Kind::Generation(_) | Kind::Macro(_) => false,
    }
}

/// The boxes that get tokens by a rule.
fn after<'g>(gate: &'g Gate, rule: &'g Rule) -> impl Iterator<Item = &'g net::Arc> {
    rule.moves.iter().flat_map(|way| &way.to).map(|index| &gate.after[*index as usize])
}
