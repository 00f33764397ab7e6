//! What each transition asks of a marking, and what it does to it.

use crate::pt::{Arc, MOST, PtNet, Transition};

/// The transitions of a net.
#[derive(Clone, Debug)]
pub(super) struct Rules {
    pub(super) list: Vec<Rule>,
    pub(super) places: usize,
    /// By place.
    pub(super) capacities: Vec<Option<u64>>,
}

/// A transition: lists of place and number, each place at most once in each.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Rule {
    /// Tokens that it takes.
    pub(super) takes: Vec<(usize, u64)>,
    /// At least so many must be there and stay.
    pub(super) reads: Vec<(usize, u64)>,
    /// At most so many may be there: inhibitors.
    pub(super) below: Vec<(usize, u64)>,
    /// At most so many may be there: room in a place with a capacity.
    pub(super) room: Vec<(usize, u64)>,
    /// The difference that firing makes, where it makes one.
    pub(super) change: Vec<(usize, i64)>,
    /// It can never fire: it puts more than a capacity.
    pub(super) never: bool,
    /// It may let a scan pass.
    pub(super) free: bool,
    /// At most one transition of a gate fires in a scan.
    pub(super) gate: usize,
}

impl Rules {
    /// The rules of a net.
    pub(super) fn new(net: &PtNet) -> Rules {
        let mut list: Vec<Rule> = net.transitions.iter().map(|transition| Rule::new(net, transition)).collect();
        number_gates(&mut list);
        Rules { list, places: net.places.len(), capacities: net.places.iter().map(|place| place.capacity).collect() }
    }
}

impl Rule {
    fn new(net: &PtNet, transition: &Transition) -> Rule {
        let mut rule = Rule {
            takes: pairs(&transition.takes),
            reads: pairs(&transition.reads),
            below: transition.inhibits.iter().map(|arc| (index(arc), arc.weight.saturating_sub(1))).collect(),
            never: transition.inhibits.iter().any(|arc| arc.weight == 0),
            free: transition.free,
            gate: transition.gate as usize,
            ..Rule::default()
        };
        for arc in &transition.puts {
            let place = index(arc);
            let excess = arc.weight.saturating_sub(find(&rule.takes, place));
            match net.places[place].capacity.map(|capacity| capacity.checked_sub(excess)) {
                Some(Some(room)) => rule.room.push((place, room)),
                Some(None) => rule.never = true,
                None => {}
            }
        }
        rule.change = changes(transition);
        rule
    }

    /// At least so many tokens must be there before it fires.
    pub(super) fn lower(&self) -> Vec<(usize, u64)> {
        merged(&self.takes, &self.reads, u64::max)
    }

    /// At most so many.
    pub(super) fn upper(&self) -> Vec<(usize, u64)> {
        merged(&self.below, &self.room, u64::min)
    }
}

/// Numbers the gates from 0 without a gap.
fn number_gates(list: &mut [Rule]) {
    let mut gates: Vec<usize> = list.iter().map(|rule| rule.gate).collect();
    gates.sort_unstable();
    gates.dedup();
    list.iter_mut().for_each(|rule| rule.gate = gates.partition_point(|gate| *gate < rule.gate));
}

fn index(arc: &Arc) -> usize {
    arc.place.0 as usize
}

fn pairs(arcs: &[Arc]) -> Vec<(usize, u64)> {
    arcs.iter().map(|arc| (index(arc), arc.weight)).collect()
}

fn find(pairs: &[(usize, u64)], place: usize) -> u64 {
    pairs.iter().find(|(at, _)| *at == place).map_or(0, |(_, number)| *number)
}

fn changes(transition: &Transition) -> Vec<(usize, i64)> {
    let signed = |weight: u64| i64::try_from(weight.min(MOST)).unwrap_or(i64::MAX);
    let mut changes: Vec<(usize, i64)> = Vec::new();
    for arc in &transition.puts {
        changes.push((index(arc), signed(arc.weight)));
    }
    for arc in &transition.takes {
        changes.push((index(arc), -signed(arc.weight)));
    }
    changes.sort_unstable_by_key(|(place, _)| *place);
    let mut sums: Vec<(usize, i64)> = Vec::new();
    for (place, change) in changes {
        match sums.last_mut() {
            Some((last, sum)) if *last == place => *sum += change,
            _ => sums.push((place, change)),
        }
    }
    sums.retain(|(_, change)| *change != 0);
    sums
}

/// Both lists, sorted by place, with what holds of both where a place is in both.
fn merged(one: &[(usize, u64)], other: &[(usize, u64)], both: fn(u64, u64) -> u64) -> Vec<(usize, u64)> {
    let mut all: Vec<(usize, u64)> = one.iter().chain(other).copied().collect();
    all.sort_unstable();
    let mut merged: Vec<(usize, u64)> = Vec::new();
    for (place, number) in all {
        match merged.last_mut() {
            Some((last, known)) if *last == place => *known = both(*known, number),
            _ => merged.push((place, number)),
        }
    }
    merged
}
