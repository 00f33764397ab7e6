//! Siphons and traps against hand-made lists, all sets tried, and all markings reached.

use crate::nets::{Dice, net, philosophers, tank};
use pcl2_net::pt::{Arc, PlaceId, PtNet, TransitionId};
use pcl2_net::structure::fire::{OnBlocked, Rule, fire, initial};
use pcl2_net::structure::invariants::{p_invariants, place_bounds};
use pcl2_net::structure::siphons::{
    Member, Siphon, is_ordinary, minimal_siphons, minimal_traps, siphons_that_can_empty,
};
use std::collections::BTreeSet;

const LIMIT: usize = 100_000;

fn shown(net: &PtNet, siphons: Option<Vec<Siphon>>) -> Vec<String> {
    let member = |member: &Member| match member {
        Member::Tokens(place) => net.places[place.0 as usize].name.clone(),
        Member::Room(place) => format!("room({})", net.places[place.0 as usize].name),
    };
    let siphons = siphons.unwrap();
    siphons.iter().map(|siphon| siphon.iter().map(member).collect::<Vec<_>>().join(" ")).collect()
}

#[test]
fn philosophers_starve_by_an_empty_table() {
    let net = philosophers(4, false);
    let table = "eat0 fork0 eat1 fork1 eat2 fork2 eat3 fork3";
    assert_eq!(shown(&net, siphons_that_can_empty(&net, LIMIT)), [table]);
    assert!(is_ordinary(&net));
    let net = philosophers(4, true);
    assert_eq!(shown(&net, siphons_that_can_empty(&net, LIMIT)), Vec::<String>::new());
}

#[test]
fn the_tank_can_lose_what_its_steps_wait_for() {
    let net = tank();
    let siphons = shown(&net, minimal_siphons(&net, LIMIT));
    let traps = shown(&net, minimal_traps(&net, LIMIT));
    for module in ["P0 P1", "L1 L0", "V11 V10", "V21 V20", "Z12 Z11 Z10", "D11 D10", "D21 D20"] {
        assert!(siphons.iter().any(|siphon| siphon == module), "{module}");
        assert!(traps.iter().any(|trap| trap == module), "{module}");
    }
    let expected = [
        "S0 S1 S2 S3 S4 S6 V21 Z10 D21",
        "S0 S1 S3 S4 S5 S6 V11 Z12 D11",
        "S0 S1 S3 S4 S6 V11 V21 Z12 Z10 D11 D21",
        "S0 S1 S5 S6 V11 Z12 Z11 D10",
        "S2 S3 S4 V21 Z11 Z10 D20",
    ];
    assert_eq!(shown(&net, siphons_that_can_empty(&net, LIMIT)), expected);
}

#[test]
fn a_capacity_is_a_place_of_its_own_unless_it_is_kept_anyway() {
    let net = net("a=1/1 b=0/1 c=0/1", "t: a -> b\nu: b -> a c\nv: c ->");
    // a and b keep one token, but nothing else keeps c at 1.
    assert_eq!(shown(&net, minimal_siphons(&net, LIMIT)), ["a b", "c room(c)"]);
}

#[test]
fn two_belts_that_fill_each_other_get_stuck() {
    let net = net("a=1/1 b=1/1", "t: a -> b\nu: b -> a");
    assert_eq!(shown(&net, siphons_that_can_empty(&net, LIMIT)), ["room(a) room(b)"]);
}

#[test]
fn too_many_sets_are_not_known() {
    let places: Vec<String> = (0..60).map(|i| format!("p{i}")).collect();
    let lines: String =
        (0..30).map(|i| format!("t{i}: p{i} p{} -> p{} p{}\n", i + 30, (i + 1) % 30, (i + 1) % 30 + 30)).collect();
    assert_eq!(minimal_siphons(&net(&places.join(" "), &lines), 10_000), None);
}

/// A net's nodes as sets of bits: places, then the rooms that the library speaks of.
struct Nodes {
    members: Vec<Member>,
    /// Of each transition what it needs and what it leaves.
    ends: Vec<(u32, u32)>,
    marked: u32,
}

impl Nodes {
    fn new(net: &PtNet, members: Vec<Member>) -> Nodes {
        let bit = |member: Member| members.iter().position(|other| *other == member).map_or(0, |at| 1 << at);
        let weight = |arcs: &[Arc], place| arcs.iter().find(|arc| arc.place == place).map_or(0, |arc| arc.weight);
        let mut ends = Vec::new();
        for transition in &net.transitions {
            let (mut needs, mut leaves) = (0, 0);
            for place in (0..net.places.len() as u32).map(PlaceId) {
                let (tokens, room) = (bit(Member::Tokens(place)), bit(Member::Room(place)));
                let (taken, put) = (weight(&transition.takes, place), weight(&transition.puts, place));
                let read = weight(&transition.reads, place);
                needs |= if taken > 0 || read > 0 { tokens } else { 0 } | if put > taken { room } else { 0 };
                leaves |= if put > 0 || read > taken { tokens } else { 0 } | if taken > put { room } else { 0 };
            }
            ends.push((needs, leaves));
        }
        let marked = members.iter().map(|member| match member {
            Member::Tokens(place) => net.places[place.0 as usize].initial > 0,
            Member::Room(place) => Some(net.places[place.0 as usize].initial) < net.places[place.0 as usize].capacity,
        });
        let marked = marked.enumerate().map(|(at, marked)| u32::from(marked) << at).sum();
        Nodes { members, ends, marked }
    }

    fn is_siphon(&self, set: u32) -> bool {
        self.ends.iter().all(|(needs, leaves)| leaves & set == 0 || needs & set != 0)
    }

    fn is_trap(&self, set: u32) -> bool {
        self.ends.iter().all(|(needs, leaves)| needs & set == 0 || leaves & set != 0)
    }

    fn subsets(set: u32) -> impl Iterator<Item = u32> {
        std::iter::successors(Some(set), move |subset| Some((subset.checked_sub(1)?) & set))
            .take_while(|subset| *subset > 0)
    }

    fn minimal(&self, is: impl Fn(u32) -> bool) -> Vec<Siphon> {
        let all = (1..1_u32 << self.members.len()).filter(|set| is(*set));
        let minimal = all.filter(|set| Nodes::subsets(*set).skip(1).all(|smaller| !is(smaller)));
        let mut minimal: Vec<Siphon> = minimal.map(|set| self.named(set)).collect();
        minimal.sort();
        minimal
    }

    fn named(&self, set: u32) -> Siphon {
        (0..self.members.len()).filter(|at| set >> at & 1 == 1).map(|at| self.members[at]).collect()
    }

    fn can_empty(&self) -> Vec<Siphon> {
        let protected = |set: u32| Nodes::subsets(set).any(|subset| self.is_trap(subset) && subset & self.marked != 0);
        let set = |siphon: &Siphon| -> u32 {
            siphon.iter().map(|member| 1 << self.members.iter().position(|other| other == member).unwrap()).sum()
        };
        self.minimal(|set| self.is_siphon(set)).into_iter().filter(|siphon| !protected(set(siphon))).collect()
    }
}

fn with_capacities(dice: &mut Dice, mut net: PtNet) -> PtNet {
    for place in &mut net.places {
        place.capacity = (dice.roll(2) == 0).then(|| place.initial.max(1 + dice.roll(2)));
    }
    net
}

/// The rooms that may matter: of all capacities that P-invariants do not keep.
fn members(net: &PtNet) -> Vec<Member> {
    let places = (0..net.places.len() as u32).map(PlaceId);
    let mut uncapped = net.clone();
    uncapped.places.iter_mut().for_each(|place| place.capacity = None);
    let bounds = place_bounds(&uncapped, &p_invariants(net, LIMIT).unwrap());
    let is_kept = |place: &PlaceId| {
        let capacity = net.places[place.0 as usize].capacity;
        capacity.is_none() || bounds[place.0 as usize].is_some_and(|bound| Some(bound) <= capacity)
    };
    let rooms = places.clone().filter(|place| !is_kept(place)).map(Member::Room);
    places.map(Member::Tokens).chain(rooms).collect()
}

#[test]
fn all_sets_tried_give_the_same_siphons_and_traps() {
    let mut dice = Dice(2);
    let (mut siphons, mut can_empty) = (0, 0);
    for round in 0..300 {
        let mut net = dice.net(2 + round % 6, 2 + round % 7, 1 + round % 2, true);
        if round % 3 == 0 {
            net = with_capacities(&mut dice, net);
        }
        let nodes = Nodes::new(&net, members(&net));
        let found = minimal_siphons(&net, LIMIT).unwrap();
        assert_eq!(found, nodes.minimal(|set| nodes.is_siphon(set)), "round {round}");
        assert_eq!(minimal_traps(&net, LIMIT).unwrap(), nodes.minimal(|set| nodes.is_trap(set)), "round {round}");
        let unprotected = siphons_that_can_empty(&net, LIMIT).unwrap();
        assert_eq!(unprotected, nodes.can_empty(), "round {round}");
        siphons += found.len();
        can_empty += unprotected.len();
    }
    assert!(siphons > 300 && can_empty > 100, "only {siphons} and {can_empty}");
}

/// Some markings that are reached one firing after the other, and whether each is dead.
fn reached(net: &PtNet) -> Vec<(Vec<i128>, bool)> {
    let mut seen = BTreeSet::from([initial(net)]);
    let mut open = vec![initial(net)];
    let mut reached = Vec::new();
    while let Some(marking) = open.pop() {
        let mut dead = true;
        for id in (0..net.transitions.len() as u32).map(TransitionId) {
            let run = fire(net, &marking, &[vec![(id, 1)]], Rule::Interleaving, OnBlocked::Refuse).unwrap();
            if let Some(next) = run.markings.get(1) {
                dead = false;
                if seen.len() < 300 && seen.insert(next.clone()) {
                    open.push(next.clone());
                }
            }
        }
        reached.push((marking, dead));
    }
    reached
}

#[test]
fn protected_siphons_stay_marked_and_dead_markings_have_an_empty_one() {
    let mut dice = Dice(3);
    let (mut protected, mut dead_markings) = (0, 0);
    for round in 0..300 {
        let weights = 1 + round % 2;
        let net = dice.net(2 + round % 6, 2 + round % 6, weights, true);
        let net = if round % 3 == 0 { with_capacities(&mut dice, net) } else { net };
        let siphons = minimal_siphons(&net, LIMIT).unwrap();
        let can_empty = siphons_that_can_empty(&net, LIMIT).unwrap();
        for (marking, dead) in reached(&net) {
            let tokens = |member: &Member| match member {
                Member::Tokens(place) => marking[place.0 as usize],
                Member::Room(place) => {
                    i128::from(net.places[place.0 as usize].capacity.unwrap()) - marking[place.0 as usize]
                }
            };
            let is_empty = |siphon: &&Siphon| siphon.iter().all(|member| tokens(member) == 0);
            let empty: Vec<&Siphon> = siphons.iter().filter(is_empty).collect();
            assert!(empty.iter().all(|siphon| can_empty.contains(siphon)), "round {round}: {marking:?}");
            protected += siphons.len() - can_empty.len();
            if dead && is_ordinary(&net) {
                assert!(!empty.is_empty(), "round {round}: {marking:?}");
                dead_markings += 1;
            }
        }
    }
    assert!(protected > 1000 && dead_markings > 50, "only {protected} and {dead_markings}");
}
