//! The state space of small nets, against a search that is written down plainly.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use pcl2_net::pt::{Arc, Place, PlaceId, PtNet, Transition};
use pcl2_net::space::{Explorer, Limit, Semantics};
use std::collections::BTreeSet;

struct Dice(u64);

impl Dice {
    fn roll(&mut self, sides: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % sides
    }
}

/// A small net with weights, capacities, read and inhibitor arcs; each place has a capacity, so all are bounded.
fn random(dice: &mut Dice) -> PtNet {
    let count = 2 + dice.roll(5);
    let place = |(i, most): (u64, u64), initial: u64| Place {
        name: format!("p{i}"),
        initial: initial.min(most),
        capacity: Some(most),
    };
    let places = (0..count).map(|i| place((i, 1 + dice.roll(3)), dice.roll(4))).collect();
    let arcs = |dice: &mut Dice, most: u64| {
        let mut arcs: Vec<Arc> = Vec::new();
        for _ in 0..dice.roll(most) {
            let place = PlaceId(dice.roll(count) as u32);
            if arcs.iter().all(|arc| arc.place != place) {
                arcs.push(Arc { place, weight: 1 + dice.roll(2) });
            }
        }
        arcs
    };
    let transition = |i: u64, dice: &mut Dice| Transition {
        name: format!("t{i}"),
        takes: arcs(dice, 3),
        puts: arcs(dice, 3),
        reads: arcs(dice, 2),
        inhibits: arcs(dice, 2),
        free: false,
        gate: i as u32,
    };
    let transitions = (0..1 + dice.roll(7)).map(|i| transition(i, dice)).collect();
    PtNet { name: "random".to_owned(), places, transitions }
}

fn weight(arcs: &[Arc], place: usize) -> u64 {
    arcs.iter().find(|arc| arc.place.0 as usize == place).map_or(0, |arc| arc.weight)
}

/// The marking after a transition, if it is enabled.
fn fired(net: &PtNet, marking: &[u64], transition: &Transition) -> Option<Vec<u64>> {
    let mut after = marking.to_vec();
    for (place, tokens) in after.iter_mut().enumerate() {
        let (takes, puts) = (weight(&transition.takes, place), weight(&transition.puts, place));
        let inhibits = weight(&transition.inhibits, place);
        let tested = *tokens >= takes && *tokens >= weight(&transition.reads, place);
        if !tested || (inhibits > 0 && *tokens >= inhibits) {
            return None;
        }
        let more = puts.saturating_sub(takes);
        if more > 0 && *tokens + more > net.places[place].capacity.unwrap() {
            return None;
        }
        *tokens = *tokens - takes + puts;
    }
    Some(after)
}

#[test]
fn random_nets_have_the_markings_of_a_plain_search() {
    let mut dice = Dice(41);
    let mut largest = 0;
    for number in 0..600 {
        let net = random(&mut dice);
        let initial: Vec<u64> = net.places.iter().map(|place| place.initial).collect();
        let (mut seen, mut open) = (BTreeSet::from([initial.clone()]), vec![initial]);
        let (mut edges, mut dead) = (0, 0);
        while let Some(marking) = open.pop() {
            let next: Vec<Vec<u64>> = net.transitions.iter().filter_map(|t| fired(&net, &marking, t)).collect();
            edges += next.len() as u64;
            dead += u64::from(next.is_empty());
            open.extend(next.into_iter().filter(|marking| seen.insert(marking.clone())));
        }
        let found = Explorer::new(&net).explore(Semantics::Interleaving, Limit::Markings(usize::MAX), &mut |_| {});
        assert!(found.complete, "net {number}");
        assert_eq!(
            (found.markings, found.edges, found.dead),
            (seen.len() as u64, edges, dead),
            "net {number}: {net:?}"
        );
        let most: Vec<u64> = (0..net.places.len()).map(|p| seen.iter().map(|m| m[p]).max().unwrap()).collect();
        assert_eq!(found.most, most, "net {number}");
        largest = largest.max(seen.len());
    }
    assert!(largest > 50, "the largest has {largest} markings");
}
