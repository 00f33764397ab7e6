//! Conflicts that the order of transitions decides.

use crate::nets::{Dice, net, philosophers, place_names, tank, transition_names};
use pcl2_net::pt::{PtNet, TransitionId};
use pcl2_net::structure::conflicts::{Conflict, conflicts};
use pcl2_net::structure::fire::{OnBlocked, Rule, fire, initial};
use pcl2_net::structure::invariants::p_invariants;
use std::collections::BTreeSet;

const LIMIT: usize = 10_000;

fn shown(net: &PtNet, limit: usize) -> Vec<String> {
    let invariants = p_invariants(net, LIMIT).unwrap();
    let found = conflicts(net, &invariants, limit);
    let line = |conflict: &Conflict| {
        let (place, over) = (place_names(net, [conflict.place]), conflict.over);
        format!("{place} {over:?}: {}", transition_names(net, conflict.transitions.iter().copied()))
    };
    found.iter().map(line).collect()
}

#[test]
fn only_the_middle_level_of_the_tank_can_go_both_ways() {
    assert_eq!(shown(&tank(), LIMIT), ["Z11 Tokens: tz10 tz13"]);
}

#[test]
fn philosophers_fight_for_forks() {
    let net = philosophers(3, true);
    let forks = ["fork0 Tokens: take0 take2", "fork1 Tokens: take0 take1", "fork2 Tokens: take1 take2"];
    assert_eq!(shown(&net, LIMIT), forks);
}

#[test]
fn what_is_never_enabled_together_is_no_conflict() {
    let by_invariant = "a: x -> ? s0\nb: x -> ? s1\nc: s0 -> s1\nd: s1 -> s0";
    assert_eq!(shown(&net("x=1 s0=1 s1", by_invariant), LIMIT), Vec::<String>::new());
    assert_eq!(shown(&net("x=1 s0=1 s1", by_invariant), 0), ["x Tokens: a b"]);
    assert_eq!(shown(&net("x=1 s0=2 s1", by_invariant), LIMIT), ["x Tokens: a b"]);
    let by_inhibitor = "a: x -> ? y\nb: x -> ? !y\nc: -> y";
    assert_eq!(shown(&net("x=1 y", by_inhibitor), LIMIT), Vec::<String>::new());
    let by_weight = "a: x -> ? 2*y\nb: x -> ? !3*y\nc: -> y";
    assert_eq!(shown(&net("x=1 y", by_weight), LIMIT), ["x Tokens: a b"]);
    let three = "a: x -> ? y\nb: x -> ? !y\nc: x -> ? z";
    assert_eq!(shown(&net("x=1 y=1 z=1", three), LIMIT), ["x Tokens: a b c"]);
}

#[test]
fn room_is_wanted_too() {
    let lines = "a: -> x\nb: -> x\nc: x -> 2*x\nd: 2*x -> x";
    assert_eq!(shown(&net("x=1/3", lines), LIMIT), ["x Tokens: c d", "x Room: a b c"]);
    assert_eq!(shown(&net("x=1", lines), LIMIT), ["x Tokens: c d"]);
}

/// Pairs of transitions of which either is enabled in a marking that is reached, and not both one after the other.
fn met(net: &PtNet) -> BTreeSet<(TransitionId, TransitionId)> {
    let ids = || (0..net.transitions.len() as u32).map(TransitionId);
    let follow = |marking: &[i128], scan: &[TransitionId]| {
        let scan = scan.iter().map(|id| (*id, 1)).collect();
        let run = fire(net, marking, &[scan], Rule::Step, OnBlocked::Refuse).unwrap();
        run.markings.into_iter().nth(1)
    };
    let mut seen = BTreeSet::from([initial(net)]);
    let mut open = vec![initial(net)];
    let mut pairs = BTreeSet::new();
    while let Some(marking) = open.pop() {
        let enabled: Vec<TransitionId> = ids().filter(|id| follow(&marking, &[*id]).is_some()).collect();
        for (i, a) in enabled.iter().enumerate() {
            let lost = enabled[i + 1..].iter().filter(|b| follow(&marking, &[*a, **b]).is_none());
            pairs.extend(lost.map(|b| (*a, *b)));
            let next = follow(&marking, &[*a]).unwrap();
            if seen.len() < 200 && seen.insert(next.clone()) {
                open.push(next);
            }
        }
    }
    pairs
}

#[test]
fn all_conflicts_that_are_met_are_found() {
    let mut dice = Dice(4);
    let mut count = 0;
    for round in 0..200 {
        let mut net = dice.net(2 + round % 5, 2 + round % 6, 1 + round % 2, true);
        for place in &mut net.places {
            place.capacity = (dice.roll(3) == 0).then(|| place.initial.max(1 + dice.roll(2)));
        }
        let found = conflicts(&net, &p_invariants(&net, LIMIT).unwrap(), LIMIT);
        for (a, b) in met(&net) {
            let both = |transitions: &Vec<TransitionId>| transitions.contains(&a) && transitions.contains(&b);
            assert!(found.iter().any(|conflict| both(&conflict.transitions)), "round {round}: {a:?} {b:?}");
            count += 1;
        }
    }
    assert!(count > 100, "only {count}");
}
