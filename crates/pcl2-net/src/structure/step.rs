//! The gate phase of a scan on a place/transition net: a step on the marking at its start.

use crate::pt::{Arc, PlaceId, PtNet, TransitionId};
use crate::structure::names;
use rustc_hash::FxHashMap;
use std::fmt;

/// Why a transition cannot fire.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// It takes more tokens than are left.
    Tokens {
        /// Of this place.
        place: PlaceId,
        /// What it takes.
        expected: u64,
        /// What is left.
        found: i128,
    },
    /// It reads more tokens than there are.
    Read {
        /// Of this place.
        place: PlaceId,
        /// What it reads.
        expected: u64,
        /// What is there.
        found: i128,
    },
    /// An inhibitor arc finds too many tokens.
    Inhibited {
        /// In this place.
        place: PlaceId,
        /// From so many tokens on it blocks.
        weight: u64,
        /// What is there.
        found: i128,
    },
    /// A place has too little room.
    Room {
        /// The place.
        place: PlaceId,
        /// How many tokens more it would get.
        expected: u64,
        /// How many fit.
        found: i128,
    },
    /// Its gate has fired in this scan.
    Gate {
        /// As this transition.
        fired: TransitionId,
    },
}

impl Reason {
    /// The reason in the names of the net.
    pub fn in_names(self, net: &PtNet) -> InNames<'_> {
        InNames { reason: self, net }
    }
}

/// A reason in the names of a net.
#[derive(Clone, Copy, Debug)]
pub struct InNames<'a> {
    reason: Reason,
    net: &'a PtNet,
}

impl fmt::Display for InNames<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = |place| names::place(self.net, place);
        match self.reason {
            Reason::Tokens { place, expected, found } => {
                write!(f, "expected {} to take from `{}`, found {found}", tokens(expected), name(place))
            }
            Reason::Read { place, expected, found } => {
                write!(f, "expected {} to read in `{}`, found {found}", tokens(expected), name(place))
            }
            Reason::Inhibited { place, weight, found } => {
                write!(f, "expected fewer than {} in `{}`, found {found}", tokens(weight), name(place))
            }
            Reason::Room { place, expected, found } => {
                write!(f, "expected room for {} in `{}`, found {found}", tokens(expected), name(place))
            }
            Reason::Gate { fired } => {
                let fired = names::transition(self.net, fired);
                write!(f, "expected one firing of its gate in a scan, found `{fired}` before it")
            }
        }
    }
}

fn tokens(count: u64) -> String {
    if count == 1 { "1 token".to_owned() } else { format!("{count} tokens") }
}

/// A scan's gate phase. Reads and inhibitors see the marking at its start; tokens that were put and room that was made
/// in it are not yet there.
#[derive(Clone, Debug)]
pub(crate) struct Phase<'a> {
    net: &'a PtNet,
    start: &'a [i128],
    taken: FxHashMap<PlaceId, i128>,
    filled: FxHashMap<PlaceId, i128>,
    fired: FxHashMap<u32, TransitionId>,
}

impl<'a> Phase<'a> {
    pub(crate) fn new(net: &'a PtNet, start: &'a [i128]) -> Phase<'a> {
        let (taken, filled, fired) = (FxHashMap::default(), FxHashMap::default(), FxHashMap::default());
        Phase { net, start, taken, filled, fired }
    }

    /// Why a transition cannot fire now.
    pub(crate) fn blocked(&self, id: TransitionId) -> Option<Reason> {
        let transition = &self.net.transitions[id.0 as usize];
        if let Some(fired) = self.fired.get(&transition.gate) {
            return Some(Reason::Gate { fired: *fired });
        }
        let left = |place: PlaceId| self.start[place.0 as usize] - self.taken.get(&place).copied().unwrap_or(0);
        let free = |place: PlaceId, capacity: u64| {
            i128::from(capacity) - self.start[place.0 as usize] - self.filled.get(&place).copied().unwrap_or(0)
        };
        missing(self.net, id, left, |place| self.start[place.0 as usize], free)
    }

    /// Fires a transition.
    pub(crate) fn fire(&mut self, id: TransitionId) {
        let transition = &self.net.transitions[id.0 as usize];
        self.fired.entry(transition.gate).or_insert(id);
        for arc in &transition.takes {
            *self.taken.entry(arc.place).or_default() += i128::from(arc.weight);
        }
        for arc in &transition.puts {
            *self.filled.entry(arc.place).or_default() += i128::from(growth(&transition.takes, arc));
        }
    }
}

/// How many tokens more a place holds after a firing that puts them. What is both before and after a transition needs
/// no room for what is taken from it.
fn growth(takes: &[Arc], put: &Arc) -> u64 {
    let taken = takes.iter().find(|take| take.place == put.place).map_or(0, |take| take.weight);
    put.weight.saturating_sub(taken)
}

/// The first arc of a transition that is not content with a marking: what is left to take of a place, what is seen in
/// it, what room it has.
pub(crate) fn missing(
    net: &PtNet,
    id: TransitionId,
    left: impl Fn(PlaceId) -> i128,
    seen: impl Fn(PlaceId) -> i128,
    free: impl Fn(PlaceId, u64) -> i128,
) -> Option<Reason> {
    let transition = &net.transitions[id.0 as usize];
    let takes = transition.takes.iter().map(|arc| {
        let found = left(arc.place);
        (found < i128::from(arc.weight)).then_some(Reason::Tokens { place: arc.place, expected: arc.weight, found })
    });
    let reads = transition.reads.iter().map(|arc| {
        let found = seen(arc.place);
        (found < i128::from(arc.weight)).then_some(Reason::Read { place: arc.place, expected: arc.weight, found })
    });
    let inhibits = transition.inhibits.iter().map(|arc| {
        let found = seen(arc.place);
        (found >= i128::from(arc.weight)).then_some(Reason::Inhibited { place: arc.place, weight: arc.weight, found })
    });
    let puts = transition.puts.iter().map(|arc| {
        let capacity = net.places[arc.place.0 as usize].capacity?;
        let (expected, found) = (growth(&transition.takes, arc), free(arc.place, capacity));
        (expected > 0 && found < i128::from(expected)).then_some(Reason::Room { place: arc.place, expected, found })
    });
    takes.chain(reads).chain(inhibits).chain(puts).flatten().next()
}

/// A scan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// What fired, in the order of the net.
    pub fired: Vec<TransitionId>,
    /// The marking after it.
    pub marking: Vec<u64>,
}

/// The greedy maximal step: transitions are tried in the order of the net, and each that can fire does, unless it is
/// free and `choose` says no.
pub fn maximal_step(
    net: &PtNet,
    marking: &[u64],
    mut choose: impl FnMut(TransitionId) -> bool,
) -> Result<Step, String> {
    let start: Vec<i128> = marking.iter().map(|tokens| i128::from(*tokens)).collect();
    let mut phase = Phase::new(net, &start);
    let mut fired = Vec::new();
    for id in names::transition_ids(net) {
        if phase.blocked(id).is_none() && (!net.transitions[id.0 as usize].free || choose(id)) {
            phase.fire(id);
            fired.push(id);
        }
    }
    let mut after = start.clone();
    for id in &fired {
        let transition = &net.transitions[id.0 as usize];
        transition.takes.iter().for_each(|arc| after[arc.place.0 as usize] -= i128::from(arc.weight));
        transition.puts.iter().for_each(|arc| after[arc.place.0 as usize] += i128::from(arc.weight));
    }
    let marking = after.into_iter().enumerate().map(|(i, tokens)| {
        u64::try_from(tokens).map_err(|_| format!("`{}` gets more tokens than 64 bits can count", net.places[i].name))
    });
    Ok(Step { fired, marking: marking.collect::<Result<_, _>>()? })
}
