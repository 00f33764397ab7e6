//! Unbounded places.

use crate::nets::{Dice, Flavour, random};
use crate::plain;
use pcl2_net::analysis::analyze;
use pcl2_net::pt::{Arc, Place, PlaceId, PtNet, Transition};
use pcl2_net::space::{Limit, Semantics, cover, growing};
use std::collections::BTreeSet;

/// The plain search must find more tokens than `MANY` in each unbounded place, and no more than `FEW` in each other one:
/// so many can come of 12 tokens. Weights are at most 2, so it may have to put some times as many in other places; beyond
/// `END` it looks no further.
const MANY: u64 = 8;
const FEW: u64 = 22;
const END: u64 = 26;

/// By place, the most tokens of all markings that are reached with at most `END` in each place.
fn most_tokens(net: &PtNet) -> Option<Vec<u64>> {
    let (mut seen, mut open) = (BTreeSet::from([plain::initial(net)]), vec![plain::initial(net)]);
    let mut most = plain::initial(net);
    while let Some(marking) = open.pop() {
        for next in net.transitions.iter().filter_map(|t| plain::fired(net, &marking, t)) {
            most.iter_mut().zip(&next).for_each(|(most, tokens)| *most = (*most).max(*tokens));
            if next.iter().all(|tokens| *tokens <= END) && seen.insert(next.clone()) {
                open.push(next);
            }
        }
        if seen.len() > 4_000 {
            return None;
        }
    }
    Some(most)
}

#[test]
fn unbounded_places_are_those_that_a_plain_search_fills() {
    let (mut dice, mut seen) = (Dice(99), [0, 0]);
    for number in 0..400 {
        let net = random(&mut dice, Flavour::Open);
        let found = cover(&net, 20_000);
        let Some(most) = most_tokens(&net).filter(|_| found.complete) else { continue };
        for (place, most) in most.iter().enumerate() {
            let unbounded = found.unbounded.contains(&PlaceId(place as u32));
            assert!(if unbounded { *most > MANY } else { *most <= FEW }, "net {number}, place {place}: {net:?}");
            seen[usize::from(unbounded)] += 1;
        }
    }
    assert!(seen.iter().all(|seen| *seen > 100), "bounded and unbounded places: {seen:?}");
}

/// Where all places are bounded the tree is the graph of reachable markings, and all that fires is in it.
#[test]
fn a_bounded_net_s_tree_fires_what_fires() {
    let (mut dice, mut whole) = (Dice(17), 0);
    for number in 0..300 {
        let net = random(&mut dice, Flavour::All);
        let Some(graph) = plain::explore(&net, Semantics::Interleaving, 400) else { continue };
        let found = cover(&net, 20_000);
        assert!(found.complete && found.unbounded.is_empty(), "net {number}: {net:?}");
        let fires = |t: usize| graph.0.values().flatten().any(|(fired, _)| fired == &[t]);
        assert_eq!(found.fired, (0..net.transitions.len()).map(fires).collect::<Vec<_>>(), "net {number}");
        whole += 1;
    }
    assert!(whole > 100);
}

/// Karp and Miller's kind of net: a place that fills only after another one has been filled without end.
#[test]
fn a_place_behind_an_unbounded_one_is_unbounded() {
    let arc = |place: u32| Arc { place: PlaceId(place), weight: 1 };
    let transition = |i: u32, takes: &[u32], puts: &[u32]| Transition {
        name: format!("t{i}"),
        takes: takes.iter().map(|place| arc(*place)).collect(),
        puts: puts.iter().map(|place| arc(*place)).collect(),
        gate: i,
        ..Transition::default()
    };
    let place = |name: &str, initial: u64| Place { name: name.to_owned(), initial, capacity: None };
    let net = PtNet {
        name: "pump".to_owned(),
        places: vec![place("pump", 1), place("tank", 0), place("drain", 0), place("basin", 0), place("never", 0)],
        transitions: vec![
            transition(0, &[0], &[0, 1]),
            transition(1, &[0], &[2]),
            transition(2, &[1, 2], &[2, 3]),
            transition(3, &[4], &[0]),
        ],
    };
    let found = cover(&net, 1000);
    assert_eq!((found.complete, found.unbounded), (true, vec![PlaceId(1), PlaceId(3)]));
    assert_eq!(found.fired, [true, true, true, false]);
    let found = cover(&net, 1);
    assert!(!found.complete, "a limit of one node is kept");
}

/// With an inhibitor on a place that is not bounded the answer cannot be computed in general: the search ends, without.
#[test]
fn an_inhibitor_on_an_unbounded_place_ends_without_an_answer() {
    let one = |place: u32| vec![Arc { place: PlaceId(place), weight: 1 }];
    let fill = Transition { name: "fill".to_owned(), puts: one(0), ..Transition::default() };
    let test = Transition { name: "test".to_owned(), inhibits: one(0), gate: 1, ..Transition::default() };
    let place = Place { name: "p".to_owned(), ..Place::default() };
    let net = PtNet { name: "open".to_owned(), places: vec![place], transitions: vec![fill, test] };
    let found = cover(&net, 1000);
    assert!(!found.complete);
    assert!(found.unbounded.is_empty());
}

/// A net with all that nets have, and places without a capacity.
fn open(dice: &mut Dice) -> PtNet {
    let mut net = random(dice, Flavour::All);
    for place in &mut net.places {
        place.capacity = place.capacity.filter(|_| dice.roll(3) == 0);
    }
    net
}

/// The most tokens of a place in the markings that scans reach with at most so many in each place; `None`: too many.
fn most_by_scans(net: &PtNet, place: usize, end: u64) -> Option<u64> {
    let (mut seen, mut open) = (BTreeSet::from([plain::initial(net)]), vec![plain::initial(net)]);
    let mut most = 0;
    while let Some(marking) = open.pop() {
        for (_, next) in plain::moves(net, &marking, Semantics::Step) {
            most = most.max(next[place]);
            if most > MANY {
                return Some(most);
            }
            if next.iter().all(|tokens| *tokens <= end) && seen.insert(next.clone()) {
                open.push(next);
            }
        }
        if seen.len() > 1_000 {
            return None;
        }
    }
    Some(most)
}

/// A place that is proved to be unbounded scan by scan fills in a plain search; in a bounded net none is. Of the nets with
/// many markings most have a proof.
#[test]
fn places_that_grow_scan_by_scan_fill_in_a_plain_search() {
    let (mut dice, mut bounded, mut proved, mut many, mut places) = (Dice(7), 0, 0, 0, 0);
    for number in 0..250 {
        let net = open(&mut dice);
        let all: Vec<PlaceId> = (0..net.places.len() as u32).map(PlaceId).collect();
        let found = growing(&net, &all, 500);
        if plain::explore(&net, Semantics::Step, 300).is_some() {
            assert!(found.is_empty(), "net {number}: {found:?} of {net:?}");
            bounded += 1;
            continue;
        }
        many += 1;
        proved += usize::from(!found.is_empty());
        for place in found {
            let Some(most) = most_by_scans(&net, place.0 as usize, 40) else { continue };
            assert!(most > MANY, "net {number}, place {place:?}: {most} of {net:?}");
            places += 1;
        }
    }
    assert!(bounded > 40 && places > 100, "{bounded} bounded nets, {places} places");
    assert!(proved * 10 > many * 9, "{proved} of {many} nets with many markings");
}

/// What holds one token for each that comes is bounded by scans, not by single transitions; what waits for few tokens where
/// many come is not known, and is not said to be unbounded.
#[test]
fn what_must_fire_and_what_is_inhibited_counts() {
    let arc = |place: u32, weight: u64| Arc { place: PlaceId(place), weight };
    let place = |name: &str| Place { name: name.to_owned(), ..Place::default() };
    let come = Transition { name: "come".to_owned(), puts: vec![arc(0, 1)], free: true, ..Transition::default() };
    let go = Transition { name: "go".to_owned(), takes: vec![arc(0, 1)], gate: 1, ..Transition::default() };
    let transitions = vec![come.clone(), go];
    let net = PtNet { name: "belt".to_owned(), places: vec![place("belt")], transitions };
    let analyzed = |net: &PtNet, semantics| analyze(net, semantics, Limit::markings(1_000), &mut |_| {});
    assert_eq!(analyzed(&net, Semantics::Interleaving).unbounded, Some(vec![PlaceId(0)]));
    assert_eq!(analyzed(&net, Semantics::Step).bounded, Some(true));
    let few = Transition {
        name: "few".to_owned(),
        puts: vec![arc(1, 1)],
        inhibits: vec![arc(0, 2)],
        gate: 1,
        ..Transition::default()
    };
    let transitions = vec![Transition { free: false, ..come }, few];
    let net = PtNet { name: "few".to_owned(), places: vec![place("p"), place("q")], transitions };
    let found = analyzed(&net, Semantics::Step);
    assert_eq!((found.bounded, found.unbounded, found.proved_unbounded), (Some(false), None, vec![PlaceId(0)]));
}
