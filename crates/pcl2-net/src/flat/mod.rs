//! A net with all nets inside it as one place/transition net, in the names of its author.
//!
//! Each box is a place, `D.come` for a box of the part `D`. Each rule of a gate is a transition; those of one gate are its
//! alternatives. What the marking does not tell (values, attributes, time) leaves a transition free, so the result has
//! every marking that the net can have, and may have more. A macro is a place that holds its token, with the places of
//! its net: a token that enters marks the entry too, one that leaves empties the exit.

mod abort;
mod condition;
mod gates;
mod renewal;
mod scopes;

use crate::pt::{Arc, PlaceId, PtNet, Transition, TransitionId};
use pcl2_lang::catalogue::Catalogue;
use pcl2_lang::decl::Decl;
use pcl2_lang::symbol::Symbols;
use scopes::{Scope, scopes};

/// The most places of a net with all nets inside it.
const MAX_PLACES: usize = 1 << 20;

/// A net with all nets inside it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Flat {
    /// As a place/transition net.
    pub net: PtNet,
    /// The net itself, then the nets inside it, outer ones first.
    pub parts: Vec<FlatPart>,
    /// The places that make tokens by themselves.
    pub generations: Vec<PlaceId>,
}

/// A net that stands in another one, or the outermost.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FlatPart {
    /// The path of names that leads to it, `D.V`; of the outermost net its own name.
    pub name: String,
    /// Tokens come in and go out: it is a macro's net.
    pub is_macro: bool,
    /// The part that it stands in; the outermost net stands in itself.
    pub outer: usize,
    /// Its own places, without those of nets inside it.
    pub places: Vec<PlaceId>,
    /// Its own transitions.
    pub transitions: Vec<TransitionId>,
}

/// Flattens a checked net. The nets of its parts stand in the catalogue. An error when it is too large to be written out.
pub fn flat(decl: &Decl, catalogue: &Catalogue, symbols: &Symbols) -> Result<Flat, String> {
    let scopes = scopes(decl, catalogue, symbols)?;
    let mut flattener =
        Flattener { symbols, places: scopes::places(&scopes), rows: vec![Vec::new(); scopes.len()], gate: 0, scopes };
    for scope in 0..flattener.scopes.len() {
        flattener.rows[scope] = flattener.gates(scope);
    }
    // A macro inside another one is emptied first: the outer one then knows all markings inside.
    for scope in (0..flattener.scopes.len()).rev() {
        let mut rows = flattener.aborts(scope)?;
        rows.append(&mut flattener.rows[scope]);
        flattener.rows[scope] = rows;
    }
    Ok(flattener.finish(&decl.name))
}

/// A flat net in the making.
struct Flattener<'a> {
    symbols: &'a Symbols,
    scopes: Vec<Scope<'a>>,
    places: Vec<crate::pt::Place>,
    /// By scope: its transitions.
    rows: Vec<Vec<Transition>>,
    /// The next number of a gate.
    gate: u32,
}

impl Flattener<'_> {
    fn next_gate(&mut self) -> u32 {
        self.gate += 1;
        self.gate - 1
    }

    fn finish(self, name: &str) -> Flat {
        let mut net = PtNet { name: name.to_owned(), places: self.places, transitions: Vec::new() };
        let (mut parts, mut generations) = (Vec::new(), Vec::new());
        for (scope, rows) in self.scopes.iter().zip(self.rows) {
            let first = net.transitions.len();
            generations.extend(scope.generations());
            net.transitions.extend(rows);
            parts.push(FlatPart {
                name: scope.path().unwrap_or(name).to_owned(),
                is_macro: scope.is_macro,
                outer: scope.outer,
                places: scope.place_ids().collect(),
                transitions: (first..net.transitions.len()).map(|i| TransitionId(i as u32)).collect(),
            });
        }
        number_gates(&mut net.transitions);
        Flat { net, parts, generations }
    }
}

/// Numbers gates in the order in which they stand.
fn number_gates(transitions: &mut [Transition]) {
    let mut numbers = rustc_hash::FxHashMap::default();
    for transition in transitions {
        let next = numbers.len() as u32;
        transition.gate = *numbers.entry(transition.gate).or_insert(next);
    }
}

/// Asks for at least so many tokens.
fn read(transition: &mut Transition, arc: Arc) {
    match transition.reads.iter_mut().find(|known| known.place == arc.place) {
        Some(known) => known.weight = known.weight.max(arc.weight),
        None => transition.reads.push(arc),
    }
}

/// Asks for fewer tokens.
fn inhibit(transition: &mut Transition, arc: Arc) {
    match transition.inhibits.iter_mut().find(|known| known.place == arc.place) {
        Some(known) => known.weight = known.weight.min(arc.weight),
        None => transition.inhibits.push(arc),
    }
}
