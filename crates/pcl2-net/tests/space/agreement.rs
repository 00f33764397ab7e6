//! The structure and the reachable markings say the same.

use crate::nets::{Dice, Flavour, random};
use crate::plain;
use pcl2_net::analysis::{Analysis, analyze};
use pcl2_net::pnml;
use pcl2_net::pt::{PtNet, TransitionId};
use pcl2_net::space::{Limit, Semantics};
use pcl2_net::structure::conflicts::Over;
use pcl2_net::structure::siphons::{self, Member};

fn analyzed(net: &PtNet, semantics: Semantics, limit: usize) -> Analysis {
    analyze(net, semantics, Limit::markings(limit), &mut |_| {})
}

#[test]
fn random_nets_agree() {
    let (mut dice, mut compared) = (Dice(5), 0);
    for number in 0..500 {
        let net = random(&mut dice, if number % 2 == 0 { Flavour::All } else { Flavour::Moving });
        for semantics in [Semantics::Interleaving, Semantics::Step] {
            let Some(graph) = plain::explore(&net, semantics, 300) else { continue };
            let what = format!("net {number}, {semantics:?}: {net:?}");
            let markings: Vec<&plain::Marking> = graph.0.keys().collect();
            agree(&net, &markings, &analyzed(&net, semantics, usize::MAX), &what);
            compared += 1;
        }
    }
    assert!(compared > 300, "{compared}");
}

#[test]
fn nets_of_the_literature_agree() {
    for name in ["FMS-PT-00002", "SwimmingPool-PT-01"] {
        let file = format!("{}/../../tests/nets/{name}.pnml", env!("CARGO_MANIFEST_DIR"));
        let net = pnml::read(&std::fs::read_to_string(file).unwrap()).unwrap();
        let graph = plain::explore(&net, Semantics::Interleaving, 100_000).unwrap();
        let markings: Vec<&plain::Marking> = graph.0.keys().collect();
        agree(&net, &markings, &analyzed(&net, Semantics::Interleaving, usize::MAX), name);
    }
}

/// What invariants, bounds and siphons say holds in each marking; the answers that follow from them are those of all
/// markings.
fn agree(net: &PtNet, markings: &[&plain::Marking], found: &Analysis, what: &str) {
    for invariant in found.p_invariants.as_ref().unwrap() {
        let sum = |marking: &plain::Marking| -> u64 {
            invariant.iter().map(|(place, weight)| marking[place.0 as usize] * weight).sum()
        };
        assert!(markings.iter().all(|marking| sum(marking) == sum(&plain::initial(net))), "{what}");
    }
    for (place, bound) in found.bounds.iter().enumerate() {
        let most = markings.iter().map(|marking| marking[place]).max().unwrap();
        assert!(bound.is_none_or(|bound| bound >= most), "{what}");
    }
    assert_eq!(found.bounded, Some(true), "{what}");
    assert_eq!(found.unbounded, Some(Vec::new()), "{what}");
    let dead = found.space.dead > 0;
    assert_eq!((found.deadlock, found.path.is_some()), (Some(dead), dead), "{what}");
    let never = found.dead_transitions.as_ref().unwrap();
    let fired = |t: &TransitionId| found.space.fired[t.0 as usize];
    assert!(!never.iter().any(fired) && found.space.fired.iter().filter(|fired| !**fired).count() == never.len());
    let safe = siphons::is_ordinary(net) && !net.transitions.is_empty();
    let reads = net.transitions.iter().any(|transition| !transition.reads.is_empty());
    if safe && !reads && found.siphons.as_ref().unwrap().is_empty() {
        assert!(!dead, "{what}");
    }
}

/// A siphon that is empty in some marking is, or contains, one that can become empty.
#[test]
fn siphons_that_are_seen_empty_are_reported() {
    let (mut dice, mut seen) = (Dice(3), 0);
    for number in 0..400 {
        let net = random(&mut dice, Flavour::Moving);
        let Some(graph) = plain::explore(&net, Semantics::Interleaving, 300) else { continue };
        let found = analyzed(&net, Semantics::Interleaving, usize::MAX);
        let can_empty = found.siphons.unwrap();
        for siphon in siphons::minimal_siphons(&net, 10_000).unwrap() {
            let is_empty = |marking: &plain::Marking| {
                siphon.iter().all(|member| matches!(member, Member::Tokens(place) if marking[place.0 as usize] == 0))
            };
            if graph.0.keys().any(is_empty) {
                assert!(can_empty.contains(&siphon), "net {number}: {net:?}");
                seen += 1;
            }
        }
    }
    assert!(seen > 100, "{seen}");
}

/// Two transitions that are enabled together, of which one disables the other by its tokens, are named as a conflict.
#[test]
fn conflicts_that_are_met_are_reported() {
    let (mut dice, mut met) = (Dice(11), 0);
    for number in 0..300 {
        let net = random(&mut dice, Flavour::Moving);
        let Some(graph) = plain::explore(&net, Semantics::Interleaving, 300) else { continue };
        let found = analyzed(&net, Semantics::Interleaving, usize::MAX);
        let named = |a: usize, b: usize| {
            let has = |ids: &[TransitionId], t: usize| ids.contains(&TransitionId(t as u32));
            let all = found.conflicts.iter().filter(|conflict| conflict.over == Over::Tokens);
            all.clone().any(|conflict| has(&conflict.transitions, a) && has(&conflict.transitions, b))
        };
        for moves in graph.0.values() {
            for (fired, to) in moves {
                for (other, _) in moves.iter().filter(|(other, _)| other != fired) {
                    if plain::fired(&net, to, &net.transitions[other[0]]).is_none() {
                        assert!(named(fired[0], other[0]), "net {number}: {net:?}");
                        met += 1;
                    }
                }
            }
        }
    }
    assert!(met > 100, "{met}");
}

/// What is known of a net without bounds, and what is not.
#[test]
fn unbounded_nets_end_with_what_is_known() {
    let (mut dice, mut unbounded) = (Dice(23), 0);
    for number in 0..200 {
        let net = random(&mut dice, Flavour::Open);
        let found = analyzed(&net, Semantics::Interleaving, 2000);
        let what = format!("net {number}: {net:?}");
        assert!(found.space.markings <= 2000, "{what}");
        if found.bounded == Some(false) {
            unbounded += 1;
            assert!(!found.space.complete, "{what}");
            assert!(found.unbounded.as_ref().is_none_or(|places| !places.is_empty()), "{what}");
        }
        if let Some(path) = &found.path {
            let end = plain::replay(&net, path, Semantics::Interleaving).unwrap();
            assert!(plain::moves(&net, &end, Semantics::Interleaving).is_empty(), "{what}");
            assert_eq!((found.deadlock, found.reversible), (Some(true), Some(path.is_empty())), "{what}");
        }
    }
    assert!(unbounded > 50, "{unbounded}");
}
