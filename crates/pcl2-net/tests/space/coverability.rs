//! Unbounded places.

use crate::nets::{Dice, Flavour, random};
use crate::plain;
use pcl2_net::pt::{Arc, Place, PlaceId, PtNet, Transition};
use pcl2_net::space::{Semantics, cover};
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
