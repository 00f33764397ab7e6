//! Structural conflicts: transitions that want the same tokens or the same room, so that their order decides.

use crate::pt::{Arc, PlaceId, PtNet, Transition, TransitionId};
use crate::structure::invariants::{Invariant, weighted_tokens};
use crate::structure::names;
use std::collections::BTreeMap;

/// Transitions that may be enabled together and of which the first one tried may leave nothing for the others.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Conflict {
    /// Where they meet.
    pub place: PlaceId,
    /// What they want of it.
    pub over: Over,
    /// The transitions, in the order in which a scan tries them.
    pub transitions: Vec<TransitionId>,
}

/// What a conflict is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Over {
    /// The tokens of the place.
    Tokens,
    /// The room in it.
    Room,
}

/// All conflicts, by place. A transition is left out when P-invariants, inhibitors or capacities say that it is never
/// enabled together with any of the others. After `limit` pairs no pair is looked at so closely any more.
pub fn conflicts(net: &PtNet, invariants: &[Invariant<PlaceId>], limit: usize) -> Vec<Conflict> {
    let mut users = vec![[Vec::new(), Vec::new()]; net.places.len()];
    for id in names::transition_ids(net) {
        let transition = &net.transitions[id.0 as usize];
        for arc in &transition.takes {
            users[arc.place.0 as usize][0].push(id);
        }
        for arc in transition.puts.iter().filter(|arc| wants_room(net, transition, arc)) {
            users[arc.place.0 as usize][1].push(id);
        }
    }
    let mut exclusion = Exclusion::new(net, invariants, limit);
    let mut conflicts = Vec::new();
    for (place, users) in names::place_ids(net).zip(users) {
        for (over, transitions) in [Over::Tokens, Over::Room].into_iter().zip(users) {
            let transitions = exclusion.rivals(&transitions);
            if !transitions.is_empty() {
                conflicts.push(Conflict { place, over, transitions });
            }
        }
    }
    conflicts
}

fn wants_room(net: &PtNet, transition: &Transition, put: &Arc) -> bool {
    net.places[put.place.0 as usize].capacity.is_some() && put.weight > weight(&transition.takes, put.place)
}

fn weight(arcs: &[Arc], place: PlaceId) -> u64 {
    arcs.iter().find(|arc| arc.place == place).map_or(0, |arc| arc.weight)
}

/// Which transitions are never enabled together.
struct Exclusion<'a> {
    net: &'a PtNet,
    invariants: &'a [Invariant<PlaceId>],
    /// Of each place the invariants that it is in, and its weight there.
    of_place: Vec<Vec<(usize, u64)>>,
    left: usize,
}

impl<'a> Exclusion<'a> {
    fn new(net: &'a PtNet, invariants: &'a [Invariant<PlaceId>], limit: usize) -> Exclusion<'a> {
        let mut of_place = vec![Vec::new(); net.places.len()];
        for (i, invariant) in invariants.iter().enumerate() {
            for (place, weight) in invariant {
                of_place[place.0 as usize].push((i, *weight));
            }
        }
        Exclusion { net, invariants, of_place, left: limit }
    }

    /// Those of some transitions that may be enabled together with another one of them.
    fn rivals(&mut self, transitions: &[TransitionId]) -> Vec<TransitionId> {
        let mut is_rival = vec![false; transitions.len()];
        for a in 0..transitions.len() {
            for b in a + 1..transitions.len() {
                if self.left == 0 {
                    return transitions.to_vec();
                }
                self.left -= 1;
                let settled = is_rival[a] && is_rival[b];
                if !settled && !self.excludes(transitions[a], transitions[b]) {
                    (is_rival[a], is_rival[b]) = (true, true);
                }
            }
        }
        transitions.iter().zip(is_rival).filter(|(_, is_rival)| *is_rival).map(|(id, _)| *id).collect()
    }

    fn excludes(&self, a: TransitionId, b: TransitionId) -> bool {
        let both = [a, b].map(|id| &self.net.transitions[id.0 as usize]);
        let mut least: BTreeMap<PlaceId, u64> = BTreeMap::new();
        for arc in both.iter().flat_map(|transition| transition.takes.iter().chain(&transition.reads)) {
            let tokens = least.entry(arc.place).or_default();
            *tokens = arc.weight.max(*tokens);
        }
        let too_many = |transition: &&Transition| {
            let most = most(self.net, transition);
            most.into_iter().any(|(place, most)| least.get(&place).is_some_and(|least| *least > most))
        };
        both.iter().any(too_many) || self.keeps_below(&least)
    }

    /// Whether an invariant has fewer tokens than a marking with at least so many would have.
    fn keeps_below(&self, least: &BTreeMap<PlaceId, u64>) -> bool {
        let mut sums: BTreeMap<usize, u128> = BTreeMap::new();
        for (place, tokens) in least {
            for (invariant, weight) in &self.of_place[place.0 as usize] {
                let sum = sums.entry(*invariant).or_default();
                *sum = sum.saturating_add(u128::from(*tokens) * u128::from(*weight));
            }
        }
        let kept = |invariant: usize| weighted_tokens(self.net, &self.invariants[invariant]);
        sums.into_iter().any(|(invariant, sum)| kept(invariant).is_some_and(|kept| sum > kept))
    }
}

/// The most tokens with which a transition is enabled, of the places where that is limited.
fn most(net: &PtNet, transition: &Transition) -> Vec<(PlaceId, u64)> {
    let inhibits = transition.inhibits.iter().map(|arc| (arc.place, arc.weight.saturating_sub(1)));
    let puts = transition.puts.iter().filter(|arc| wants_room(net, transition, arc)).filter_map(|arc| {
        let grows = arc.weight - weight(&transition.takes, arc.place);
        Some((arc.place, net.places[arc.place.0 as usize].capacity?.saturating_sub(grows)))
    });
    inhibits.chain(puts).collect()
}
