//! What the lines of a net say, in the words of the language.

use super::WrittenNet;
use crate::decl::Tail;
use crate::manual::value_text;
use crate::net::{Abort, Arc, Attribute, Drive, Gate, Kind, Level, Move, NetBox, Order, Rule, StatementId, Tested};
use crate::types::Value;

impl WrittenNet<'_> {
    /// A statement as written.
    pub fn statement(&self, id: StatementId) -> &str {
        self.statements.get(id.0 as usize).map_or("", String::as_str)
    }

    /// What a box's lines say beside its kind, its name and its room.
    pub fn clauses(&self, place: &NetBox) -> Vec<String> {
        let class = place.class.map(|class| format!("OF {}", self.net.classes[class.0 as usize].name));
        let mut clauses: Vec<String> = class.into_iter().chain(self.order(place)).chain(self.presets(place)).collect();
        match &place.kind {
            Kind::State | Kind::Capacity | Kind::Count => {}
            Kind::Time(time) => clauses.push(format!("TIME {}", self.statement(*time))),
            Kind::Action(statements) => clauses.extend(self.each("DO", statements)),
            Kind::Process(process) => {
                clauses.extend(self.each("DO", &process.enter));
                clauses.extend(self.each("UNTIL", process.until.as_slice()));
                clauses.extend(self.each("WITHIN", process.within.as_slice()));
                clauses.extend(self.each("AFTER", &process.after));
            }
            Kind::Generation(generation) => {
                clauses.push(format!("WHEN {}", self.statement(generation.when)));
                clauses.extend(self.each("DO", &generation.enter));
            }
            Kind::Macro(part) => {
                let part = &self.net.parts[part.0 as usize];
                let call = self.statement(part.statement).split_once(" : ").map_or("", |(_, call)| call);
                clauses.push(call.to_owned());
            }
        }
        clauses
    }

    fn each(&self, word: &str, statements: &[StatementId]) -> Vec<String> {
        statements.iter().map(|statement| format!("{word} {}", self.statement(*statement))).collect()
    }

    fn order(&self, place: &NetBox) -> Option<String> {
        let attribute = |index: u32| self.net.attributes(place).get(index as usize).map_or("", |found| &found.name);
        match place.order {
            Order::Fifo => None,
            Order::Lifo => Some("ORDER lifo".to_owned()),
            Order::Least(index) => Some(format!("ORDER least {}", attribute(index))),
            Order::Most(index) => Some(format!("ORDER most {}", attribute(index))),
        }
    }

    fn presets(&self, place: &NetBox) -> Option<String> {
        let preset = |(attribute, value): (&Attribute, &Value)| {
            format!("{} = {}", attribute.name, value_text(value, &Tail::default()))
        };
        let presets: Vec<String> = self.net.attributes(place).iter().zip(&place.presets).map(preset).collect();
        (place.initial > 0 && !presets.is_empty()).then(|| format!("MARKED ( {} )", presets.join(", ")))
    }

    /// The outputs and locals that are 1 while a box is marked.
    pub fn drives(&self, index: usize) -> Vec<&str> {
        let drives = |level: &Level| matches!(level, Level::Box(place) if place.0 as usize == index);
        let words = self.net.words.iter().filter(|word| match &word.drive {
            Drive::Level(levels) => levels.iter().any(drives),
            Drive::Written => false,
        });
        words.map(|word| word.name.as_str()).collect()
    }

    /// `a, 2*b`
    pub fn arcs(&self, arcs: &[Arc]) -> String {
        let arc = |arc: &Arc| weighted(arc.weight, &self.net.place(arc.place).name);
        arcs.iter().map(arc).collect::<Vec<_>>().join(", ")
    }

    /// `a, 2*part.b`. The nets inside are those of the whole.
    pub fn tested(&self, nets: &[WrittenNet<'_>], tested: &[Tested]) -> String {
        tested.iter().map(|test| self.test(nets, test)).collect::<Vec<_>>().join(", ")
    }

    /// `2*part.b`
    pub fn test(&self, nets: &[WrittenNet<'_>], test: &Tested) -> String {
        let name = match test.part {
            None => self.net.place(test.place).name.clone(),
            Some(part) => {
                let inner = self.parts.get(part.0 as usize).and_then(|inner| nets.get(*inner));
                let place = inner.map_or("", |inner| &inner.net.place(test.place).name);
                format!("{}.{place}", self.net.parts[part.0 as usize].name)
            }
        };
        weighted(test.weight, &name)
    }

    /// What stands below a gate: permissives, conditions, and where tokens go unless it goes without saying.
    pub fn rules(&self, gate: &Gate) -> Vec<String> {
        let permits: Vec<&str> = gate.permits.iter().map(|permit| self.statement(permit.condition)).collect();
        let mut lines = Vec::new();
        if !permits.is_empty() {
            lines.push(format!("PERMIT {}", permits.join(", ")));
        }
        for rule in &gate.rules {
            match rule.condition {
                Some(condition) => lines.push(format!("IF {}", self.statement(condition))),
                None if gate.rules.len() > 1 => lines.push("ELSE".to_owned()),
                None => {}
            }
            lines.extend(self.routes(gate, rule));
            lines.extend(self.each("DO", &rule.actions));
        }
        lines
    }

    /// What ABORT says.
    pub fn abort(&self, abort: &Abort) -> Vec<String> {
        let mut lines = vec![format!("IF {}", self.statement(abort.condition))];
        lines.extend(self.each("DO", &abort.actions));
        lines
    }

    fn routes(&self, gate: &Gate, rule: &Rule) -> Vec<String> {
        let all = |way: &Move| way.to.len() == gate.after.len();
        let plain = rule.moves.iter().enumerate().all(|(i, way)| if i == 0 { all(way) } else { way.to.is_empty() });
        if plain || gate.before.is_empty() {
            return Vec::new();
        }
        let name = |arc: &Arc| self.net.place(arc.place).name.as_str();
        let route = |way: &Move| {
            let from = way.from.map_or("NEW", |from| name(&gate.before[from as usize]));
            let to: Vec<&str> = way.to.iter().map(|to| name(&gate.after[*to as usize])).collect();
            let to = if to.is_empty() { "nothing".to_owned() } else { to.join(", ") };
            format!("THEN {from} -> {to}")
        };
        rule.moves.iter().map(route).collect()
    }
}

/// `3*name`, or the name alone.
pub fn weighted(weight: u32, name: &str) -> String {
    if weight == 1 { name.to_owned() } else { format!("{weight}*{name}") }
}
