//! The search for dead markings alone.

use crate::nets::{Dice, Flavour, random};
use crate::plain;
use pcl2_net::pt::TransitionId;
use pcl2_net::space::{Deadlock, Explorer, Semantics};

#[test]
fn stubborn_sets_find_a_dead_marking_exactly_if_there_is_one() {
    let (mut dice, mut dead) = (Dice(7), [0, 0]);
    for number in 0..1500 {
        let net = random(&mut dice, if number % 2 == 0 { Flavour::All } else { Flavour::Moving });
        let Some(graph) = plain::explore(&net, Semantics::Interleaving, 3000) else { continue };
        match Explorer::new(&net).reduced(usize::MAX) {
            Deadlock::Reached(way) => {
                let scans: Vec<Vec<TransitionId>> = way.iter().map(|transition| vec![*transition]).collect();
                let end = plain::replay(&net, &scans, Semantics::Interleaving).unwrap();
                assert!(graph.0[&end].is_empty(), "net {number}: {net:?}");
                dead[0] += 1;
            }
            Deadlock::Never => {
                assert!(graph.dead().is_empty(), "net {number}: {net:?}");
                dead[1] += 1;
            }
            Deadlock::Unknown => panic!("net {number}: {net:?}"),
        }
    }
    assert!(dead.iter().all(|count| *count > 100), "with and without: {dead:?}");
}

/// A walk at random finds the way where the reduced markings are too many.
#[test]
fn a_walk_replays_too() {
    let (mut dice, mut found) = (Dice(8), 0);
    for number in 0..200 {
        let net = random(&mut dice, Flavour::All);
        if let Deadlock::Reached(way) = Explorer::new(&net).deadlock(1) {
            let scans: Vec<Vec<TransitionId>> = way.iter().map(|transition| vec![*transition]).collect();
            let end = plain::replay(&net, &scans, Semantics::Interleaving).unwrap();
            assert!(plain::moves(&net, &end, Semantics::Interleaving).is_empty(), "net {number}");
            found += usize::from(way.len() > 1);
        }
    }
    assert!(found > 20, "{found}");
}
