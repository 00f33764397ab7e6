//! ABORT -> transitions: one for each marking that the macro's net can have inside.

use super::condition::test;
use super::{Flattener, inhibit};
use crate::pt::{Arc, PlaceId, Transition};
use pcl2_lang::net::{self, Abort, BoxId, PartId};
use rustc_hash::{FxHashMap, FxHashSet};
use std::fmt::Write;

/// The most markings inside a macro over which its ABORT is written out.
const MAX_MARKINGS: usize = 4096;

/// Tokens by place, of those that are emptied together.
type Inside = Vec<u64>;

impl Flattener<'_> {
    /// The transitions of a scope's ABORT lines.
    pub(super) fn aborts(&mut self, scope: usize) -> Result<Vec<Transition>, String> {
        let mut rows = Vec::new();
        let net = self.scopes[scope].net;
        for (i, part) in net.parts.iter().enumerate() {
            let macro_box = part.place.zip(part.abort.as_ref());
            if let Some((place, abort)) = macro_box.filter(|(place, abort)| abort.to != *place) {
                rows.extend(self.abort(scope, PartId(i as u32), place, abort)?);
            }
        }
        Ok(rows)
    }

    fn abort(&mut self, scope: usize, part: PartId, place: BoxId, abort: &Abort) -> Result<Vec<Transition>, String> {
        let inner = self.scopes[scope].parts[part.0 as usize];
        let emptied = self.emptied(inner);
        let markings = self.markings(scope, inner, place, &emptied)?;
        let gate = self.next_gate();
        let name = format!("abort:{}", self.scopes[inner].path().unwrap_or_default());
        let single = markings.len() == 1;
        let mut base = Transition { gate, ..Transition::default() };
        base.takes.push(Arc { place: self.scopes[scope].place(place), weight: 1 });
        let condition = test(&self.scopes, scope, abort.condition, self.symbols);
        condition.yes.restrict(&mut base);
        base.free = condition.yes.open;
        self.put(scope, &net::Arc { place: abort.to, weight: 1 }, false, &mut base);
        let mut rows = Vec::new();
        for marking in markings {
            let mut row = base.clone();
            row.name = if single { name.clone() } else { format!("{name}/{}", self.shown(inner, &emptied, &marking)) };
            self.take_all(&emptied, &marking, &mut row);
            rows.push(row);
        }
        Ok(rows)
    }

    /// The places that an ABORT empties: the macro's, and those of macros in it.
    fn emptied(&self, inner: usize) -> Vec<PlaceId> {
        let mut places = Vec::new();
        let mut open = vec![inner];
        while let Some(scope) = open.pop() {
            places.extend(self.scopes[scope].place_ids());
            open.extend(self.scopes[scope].parts.iter().copied().filter(|part| self.scopes[*part].is_macro));
        }
        places.sort_unstable();
        places
    }

    /// The markings that the macro can have inside. Read arcs, inhibitors and conditions are left out: more markings
    /// than there are do no harm.
    fn markings(&self, scope: usize, inner: usize, place: BoxId, emptied: &[PlaceId]) -> Result<Vec<Inside>, String> {
        let rows = self.moves(scope, inner, place, emptied);
        let entry = self.scopes[inner].net.entry.map(|entry| self.scopes[inner].place(entry));
        let start: Inside = emptied.iter().map(|place| u64::from(Some(*place) == entry)).collect();
        let mut seen: FxHashSet<Inside> = FxHashSet::default();
        seen.insert(start.clone());
        let mut found = vec![start];
        let mut next = 0;
        while let Some(marking) = found.get(next).cloned() {
            next += 1;
            for row in &rows {
                let after = self.fired(&marking, row, emptied).filter(|after| seen.insert(after.clone()));
                found.extend(after);
            }
            if found.len() > MAX_MARKINGS {
                let path = self.scopes[inner].path().unwrap_or_default();
                return Err(format!(
                    "macro `{path}`: expected at most {MAX_MARKINGS} markings inside it, each of which its ABORT \
                     empties, found more; give its CAPACITY boxes less room, or divide it"
                ));
            }
        }
        Ok(found)
    }

    /// What tokens do inside: places are counted among those that are emptied.
    fn moves(&self, scope: usize, inner: usize, place: BoxId, emptied: &[PlaceId]) -> Vec<Moves> {
        let index: FxHashMap<PlaceId, usize> = emptied.iter().enumerate().map(|(i, place)| (*place, i)).collect();
        let own = |arcs: &[Arc]| -> Vec<(usize, u64)> {
            arcs.iter().filter_map(|arc| Some((*index.get(&arc.place)?, arc.weight))).collect()
        };
        let place = self.scopes[scope].place(place);
        let stays = |transition: &&Transition| {
            let has = |arcs: &[Arc]| arcs.iter().any(|arc| arc.place == place);
            has(&transition.takes) && has(&transition.puts)
        };
        let outside = self.rows[scope].iter().filter(stays);
        let inside = (inner..self.scopes.len()).filter(|other| self.is_within(*other, inner));
        let inside = inside.flat_map(|other| &self.rows[other]);
        let moves = inside.chain(outside).map(|transition| (own(&transition.takes), own(&transition.puts)));
        let mut moves: Vec<Moves> = moves.filter(|(takes, puts)| takes != puts).collect();
        moves.sort_unstable();
        moves.dedup();
        moves
    }

    fn is_within(&self, mut scope: usize, outer: usize) -> bool {
        while scope > outer {
            scope = self.scopes[scope].outer;
        }
        scope == outer
    }

    fn fired(&self, marking: &Inside, (takes, puts): &Moves, emptied: &[PlaceId]) -> Option<Inside> {
        let mut after = marking.clone();
        for (place, weight) in takes {
            after[*place] = after[*place].checked_sub(*weight)?;
        }
        for (place, weight) in puts {
            after[*place] = after[*place].checked_add(*weight)?;
            let capacity = self.places[emptied[*place].0 as usize].capacity;
            if capacity.is_some_and(|capacity| after[*place] > capacity) {
                return None;
            }
        }
        Some(after)
    }

    /// Exactly this marking: no token stays.
    fn take_all(&self, emptied: &[PlaceId], marking: &Inside, row: &mut Transition) {
        for (place, tokens) in emptied.iter().zip(marking) {
            let capacity = self.places[place.0 as usize].capacity;
            if *tokens > 0 {
                row.takes.push(Arc { place: *place, weight: *tokens });
            }
            if capacity.is_none_or(|capacity| *tokens < capacity) {
                inhibit(row, Arc { place: *place, weight: tokens + 1 });
            }
        }
    }

    /// `come`, `left+2*right`, or `nothing`.
    fn shown(&self, inner: usize, emptied: &[PlaceId], marking: &Inside) -> String {
        let prefix = &self.scopes[inner].prefix;
        let mut text = String::new();
        for (place, tokens) in emptied.iter().zip(marking).filter(|(_, tokens)| **tokens > 0) {
            let name = &self.places[place.0 as usize].name;
            let name = name.strip_prefix(prefix.as_str()).unwrap_or(name);
            let plus = if text.is_empty() { "" } else { "+" };
            let _ = match tokens {
                1 => write!(text, "{plus}{name}"),
                _ => write!(text, "{plus}{tokens}*{name}"),
            };
        }
        if text.is_empty() { "nothing".to_owned() } else { text }
    }
}

/// What a transition takes and puts.
type Moves = (Vec<(usize, u64)>, Vec<(usize, u64)>);
