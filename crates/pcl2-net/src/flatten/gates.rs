//! Gates of the flat net, in the order in which a scan tries them: those of a net before those of the nets inside it.

use super::Flattener;
use crate::flat::scopes::Scope;
use pcl2_lang::net::{Abort, Arc, BoxId, Gate, Kind, Move, PartId, Rule, Tested};
use std::collections::BTreeSet;
use std::fmt::Write;

/// What is tried before all gates of its net.
const ABORT: i64 = i64::MIN;

impl Flattener<'_> {
    /// The gates of all scopes.
    pub(super) fn gates(&mut self) -> Result<(), String> {
        let ranks = self.ranks();
        let flat = ranks.iter().all(|(_, priority)| *priority == 0);
        let ranks: Vec<(usize, i64)> = if flat { Vec::new() } else { ranks.into_iter().collect() };
        let mut text = String::new();
        for scope in 0..self.scopes.len() {
            let net = self.scopes[scope].net;
            for (i, part) in net.parts.iter().enumerate() {
                if let (Some(place), Some(abort)) = (part.place, &part.abort) {
                    let clause = priority(&ranks, (scope, ABORT));
                    text.push_str(&self.abort(scope, PartId(i as u32), place, abort, &clause)?);
                }
            }
            for gate in &net.gates {
                let clause = priority(&ranks, (scope, -i64::from(gate.priority)));
                text.push_str(&self.gate(scope, gate, &clause)?);
            }
        }
        self.text.push_str(&text);
        Ok(())
    }

    /// The scopes and the priorities in them, what goes first before all others.
    fn ranks(&self) -> BTreeSet<(usize, i64)> {
        let mut ranks = BTreeSet::new();
        for (i, scope) in self.scopes.iter().enumerate() {
            ranks.extend(scope.net.gates.iter().map(|gate| (i, -i64::from(gate.priority))));
            let aborts = scope.net.parts.iter().any(|part| part.abort.is_some());
            ranks.extend(aborts.then_some((i, ABORT)));
        }
        ranks
    }

    fn gate(&self, scope: usize, gate: &Gate, priority: &str) -> Result<String, String> {
        let before: Vec<String> = gate.before.iter().flat_map(|arc| self.taken(scope, arc)).collect();
        let after: Vec<String> = gate.after.iter().flat_map(|arc| self.put(scope, arc)).collect();
        let mut text =
            format!("GATE {}{} : {} -> {}", self.names.prefixes[scope], gate.name, before.join(", "), after.join(", "));
        let reads: Vec<String> = gate.reads.iter().flat_map(|tested| self.read(scope, tested)).collect();
        let mut inhibits: Vec<String> = gate.inhibits.iter().map(|tested| self.tested(scope, tested)).collect();
        inhibits.extend(self.vacant(scope, gate)?);
        for (word, list) in [(" READ ", reads), (" INHIBIT ", inhibits)] {
            if !list.is_empty() {
                text.extend([word, list.join(", ").as_str()]);
            }
        }
        text.push_str(priority);
        let permits = gate.permits.iter().map(|permit| self.condition(scope, permit.condition));
        let permits: Vec<String> = permits.collect::<Result<_, String>>()?;
        if !permits.is_empty() {
            let _ = write!(text, " PERMIT {}", permits.join(", "));
        }
        self.rules(scope, gate, &mut text)?;
        Ok(text)
    }

    fn rules(&self, scope: usize, gate: &Gate, text: &mut String) -> Result<(), String> {
        let plain = is_plain(&self.scopes[scope], gate);
        for (i, rule) in gate.rules.iter().enumerate() {
            let before = match i {
                0 if gate.rules.len() == 1 => " ",
                0 => "\n",
                _ => "",
            };
            match rule.condition {
                Some(condition) => {
                    let _ = write!(text, "{before}IF {}", self.condition(scope, condition)?);
                }
                None if i > 0 => text.push_str("ELSE"),
                None => {}
            }
            text.push('\n');
            if !plain {
                self.routes(scope, gate, rule, text);
            }
            self.actions(scope, &rule.actions, "DO", text)?;
        }
        Ok(())
    }

    /// The scope behind a macro's box.
    fn inside(&self, scope: usize, id: BoxId) -> Option<usize> {
        match self.scopes[scope].net.place(id).kind {
            Kind::Macro(part) => Some(self.scopes[scope].parts[part.0 as usize]),
            Kind::State | Kind::Capacity | Kind::Time(_) | Kind::Count | Kind::Action(_) => None,
            Kind::Process(_) | Kind::Generation(_) => None,
        }
    }

    /// The entry (or the exit) of a macro's net.
    fn end(&self, scope: usize, id: BoxId, entry: bool) -> Option<&str> {
        let inner = self.inside(scope, id)?;
        let net = self.scopes[inner].net;
        let end = if entry { net.entry } else { net.exit };
        end.map(|id| self.names.place(inner, id))
    }

    fn taken(&self, scope: usize, arc: &Arc) -> Vec<String> {
        let exit = self.end(scope, arc.place, false).map(str::to_owned);
        std::iter::once(term(self.names.place(scope, arc.place), arc.weight)).chain(exit).collect()
    }

    fn put(&self, scope: usize, arc: &Arc) -> Vec<String> {
        let entry = self.end(scope, arc.place, true).map(str::to_owned);
        std::iter::once(term(self.names.place(scope, arc.place), arc.weight)).chain(entry).collect()
    }

    fn tested(&self, scope: usize, tested: &Tested) -> String {
        let inner = tested.part.map_or(scope, |part| self.scopes[scope].parts[part.0 as usize]);
        term(self.names.place(inner, tested.place), tested.weight)
    }

    fn read(&self, scope: usize, tested: &Tested) -> Vec<String> {
        let inner = tested.part.map_or(scope, |part| self.scopes[scope].parts[part.0 as usize]);
        let exit = self.end(inner, tested.place, false).map(str::to_owned);
        std::iter::once(self.tested(scope, tested)).chain(exit).collect()
    }

    /// The nets of a macro and of the macros inside it in which tokens may stay when the macro is left.
    fn unbalanced(&self, scope: usize, place: BoxId) -> Vec<usize> {
        let Some(inner) = self.inside(scope, place) else {
            return Vec::new();
        };
        let mut found = Vec::new();
        found.extend((!self.is_balanced(inner, self.scopes[scope].place(place))).then_some(inner));
        for id in (0..self.scopes[inner].net.boxes.len() as u32).map(BoxId) {
            found.extend(self.unbalanced(inner, id));
        }
        found
    }

    /// The boxes that must be empty so that a token may enter a macro, where its own box does not say so.
    fn vacant(&self, scope: usize, gate: &Gate) -> Result<Vec<String>, String> {
        let mut boxes = Vec::new();
        for (index, arc) in gate.after.iter().enumerate() {
            let unbalanced = self.unbalanced(scope, arc.place);
            if unbalanced.is_empty() {
                continue;
            }
            let fills = |rule: &Rule| rule.moves.iter().any(|way| way.to.contains(&(index as u32)));
            let again = gate.before.iter().any(|before| before.place == arc.place);
            if again || !gate.rules.iter().all(fills) {
                return Err(format!(
                    "gate `{}{}`: expected each of its rules to put a token into `{}`, found one that does not: tokens \
                     may stay in that macro when it is left, and a flat gate cannot ask for room in one rule alone",
                    self.scopes[scope].prefix,
                    gate.name,
                    self.scopes[scope].net.place(arc.place).name
                ));
            }
            for inner in unbalanced {
                let count = self.scopes[inner].net.boxes.len() as u32;
                boxes.extend((0..count).map(|id| self.names.place(inner, BoxId(id)).to_owned()));
            }
        }
        Ok(boxes)
    }

    /// THEN lines. The token of a macro stands at its exit, and comes in at its entry; its own box gets a plain one.
    fn routes(&self, scope: usize, gate: &Gate, rule: &Rule, text: &mut String) {
        for way in &rule.moves {
            let to: Vec<&str> = way.to.iter().map(|index| self.inner_end(scope, &gate.after, *index, true)).collect();
            let to = if to.is_empty() { "nothing".to_owned() } else { to.join(", ") };
            let from = way.from.map(|index| self.inner_end(scope, &gate.before, index, false));
            let _ = writeln!(text, "THEN {} -> {to}", from.unwrap_or("NEW"));
            let left = way.from.map(|index| gate.before[index as usize].place);
            if let Some(place) = left.filter(|place| self.inside(scope, *place).is_some()) {
                let _ = writeln!(text, "THEN {} -> nothing", self.names.place(scope, place));
            }
            for place in way.to.iter().map(|index| gate.after[*index as usize].place) {
                if self.inside(scope, place).is_some() {
                    let _ = writeln!(text, "THEN NEW -> {}", self.names.place(scope, place));
                }
            }
        }
    }

    fn inner_end(&self, scope: usize, arcs: &[Arc], index: u32, entry: bool) -> &str {
        let place = arcs[index as usize].place;
        self.end(scope, place, entry).unwrap_or_else(|| self.names.place(scope, place))
    }

    /// An ABORT is a gate for each box in which the macro's token may stand.
    fn abort(&self, scope: usize, part: PartId, place: BoxId, abort: &Abort, priority: &str) -> Result<String, String> {
        let own = &self.scopes[scope];
        let inner = own.parts[part.0 as usize];
        let (net, path) = (self.scopes[inner].net, self.path(inner));
        if !self.is_balanced(inner, own.place(place)) {
            return Err(format!("`{path}`: expected one token in the macro that ABORT empties, found more or none"));
        }
        let commands = own.net.momentary.iter().map(|(_, word)| own.net.words[word.0 as usize].name.as_str());
        let read = self.read_names(own.statement(abort.condition));
        if let Some(command) = commands.into_iter().find(|command| read.contains(command)) {
            return Err(format!(
                "`{path}`: expected ABORT without the command `{command}`: a gate that reads it clears it, ABORT does not"
            ));
        }
        if own.net.place(place).class.is_some() || own.net.place(abort.to).class.is_some() {
            return Err(format!("`{path}`: expected plain tokens where ABORT takes or puts one, found a class"));
        }
        let mut text = String::new();
        for (i, inside) in net.boxes.iter().enumerate() {
            match inside.kind {
                Kind::State | Kind::Capacity | Kind::Action(_) => {}
                Kind::Time(_) | Kind::Count | Kind::Process(_) | Kind::Generation(_) | Kind::Macro(_) => {
                    return Err(format!(
                        "`{path}`: expected boxes that give their token at any time, found `{}`: ABORT empties it \
                         whatever it is doing, and a gate waits for it",
                        inside.name
                    ));
                }
            }
            let name = self.names.place(inner, BoxId(i as u32));
            let to = self.put(scope, &Arc { place: abort.to, weight: 1 }).join(", ");
            let from = self.names.place(scope, place);
            let _ = writeln!(text, "GATE abort_{name} : {from}, {name} -> {to}{priority}");
            let _ = writeln!(text, "IF {}", self.condition(scope, abort.condition)?);
            self.actions(scope, &abort.actions, "DO", &mut text)?;
        }
        Ok(text)
    }
}

/// Whether a gate needs no THEN: all tokens are plain, and each rule fills all boxes after it; or the tokens go as they do
/// without THEN.
fn is_plain(scope: &Scope<'_>, gate: &Gate) -> bool {
    let plain = |arc: &Arc| scope.net.place(arc.place).class.is_none();
    let classed = |arc: &Arc| !plain(arc) && matches!(scope.net.place(arc.place).kind, Kind::Macro(_));
    let all = gate.after.len();
    let fills = |rule: &Rule| rule.moves.iter().map(|way| way.to.len()).sum::<usize>() == all;
    let mut arcs = gate.before.iter().chain(&gate.after);
    if arcs.clone().all(plain) {
        return gate.rules.iter().all(fills);
    }
    let usual = usual_moves(scope, gate);
    !arcs.any(classed) && gate.rules.iter().all(|rule| Some(&rule.moves) == usual.as_ref())
}

/// Where tokens go without THEN, if they can.
fn usual_moves(scope: &Scope<'_>, gate: &Gate) -> Option<Vec<Move>> {
    let class = |arc: &Arc| scope.net.place(arc.place).class;
    let mut moves: Vec<Move> =
        (0..gate.before.len() as u32).map(|from| Move { from: Some(from), to: Vec::new() }).collect();
    let first = gate.before.first().map(class);
    for (i, arc) in gate.after.iter().enumerate() {
        match moves.first_mut().filter(|_| first == Some(class(arc))) {
            Some(own) => own.to.push(i as u32),
            None if class(arc).is_some() => return None,
            None => moves.push(Move { from: None, to: vec![i as u32] }),
        }
    }
    Some(moves)
}

fn term(name: &str, weight: u32) -> String {
    if weight == 1 { name.to_owned() } else { format!("{weight}*{name}") }
}

/// `PRIORITY n`, where gates have any.
fn priority(ranks: &[(usize, i64)], rank: (usize, i64)) -> String {
    match ranks.binary_search(&rank) {
        Ok(at) => format!(" PRIORITY {}", ranks.len() - 1 - at),
        Err(_) => String::new(),
    }
}
