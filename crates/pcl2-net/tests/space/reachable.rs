//! Markings, edges, ways to dead markings, liveness and reversibility of both semantics.

use crate::nets::{Dice, Flavour, random};
use crate::plain::{self, Graph};
use pcl2_net::pt::PtNet;
use pcl2_net::space::{Explorer, Limit, Semantics, Space};

const SEMANTICS: [Semantics; 2] = [Semantics::Interleaving, Semantics::Step];

fn explore(net: &PtNet, semantics: Semantics, limit: usize) -> Space {
    Explorer::new(net).explore(semantics, Limit::markings(limit), &mut |_| {})
}

#[test]
fn random_nets_have_the_markings_of_a_plain_search() {
    let (mut dice, mut largest, mut seen) = (Dice(41), 0, [0; 4]);
    for number in 0..600 {
        let flavour = if number % 3 == 0 { Flavour::Moving } else { Flavour::All };
        let net = random(&mut dice, flavour);
        for semantics in SEMANTICS {
            let graph = plain::explore(&net, semantics, 400);
            let Some(graph) = graph else { continue };
            let found = explore(&net, semantics, usize::MAX);
            let what = format!("net {number}, {semantics:?}: {net:?}");
            compare(&net, &graph, &found, &what);
            compare_paths(&net, semantics, &graph, &found, &what);
            largest = largest.max(graph.0.len());
            let live = found.live.as_ref().unwrap();
            let kinds = [
                live.iter().all(|live| *live),
                found.reversible == Some(true) && graph.0.len() > 1,
                found.dead > 0 && found.path.as_ref().unwrap().len() > 2,
                found.dead == 0 && live.iter().any(|live| *live) && !live.iter().all(|live| *live),
            ];
            seen.iter_mut().zip(kinds).for_each(|(seen, kind)| *seen += u32::from(kind));
        }
    }
    assert!(largest > 50, "the largest has {largest} markings");
    assert!(seen.iter().all(|seen| *seen > 5), "live, reversible, with a longer path, partly live: {seen:?}");
}

fn compare(net: &PtNet, graph: &Graph, found: &Space, what: &str) {
    assert!(found.complete, "{what}");
    let counts = (graph.0.len() as u64, graph.edges(), graph.dead().len() as u64);
    assert_eq!((found.markings, found.edges, found.dead), counts, "{what}");
    let most: Vec<u64> = (0..net.places.len()).map(|p| graph.0.keys().map(|m| m[p]).max().unwrap()).collect();
    assert_eq!(found.most, most, "{what}");
    let fires = |t: usize| graph.0.values().flatten().any(|(fired, _)| fired.contains(&t));
    assert_eq!(found.fired, (0..net.transitions.len()).map(fires).collect::<Vec<_>>(), "{what}");
    assert_eq!(found.live, Some(graph.live(net.transitions.len())), "{what}");
    assert_eq!(found.reversible, Some(graph.reversible(&plain::initial(net))), "{what}");
}

fn compare_paths(net: &PtNet, semantics: Semantics, graph: &Graph, found: &Space, what: &str) {
    let distances = graph.distances(&plain::initial(net));
    let nearest = graph.dead().into_iter().map(|dead| distances[dead]).min();
    assert_eq!(found.path.as_ref().map(Vec::len), nearest, "{what}");
    if let Some(path) = &found.path {
        let end = plain::replay(net, path, semantics).unwrap();
        assert!(graph.0[&end].is_empty(), "{what}");
    }
}

/// What a search knows that was stopped holds, and the rest is left open.
#[test]
fn a_stopped_search_says_only_what_it_knows() {
    let (mut dice, mut stopped) = (Dice(43), 0);
    for number in 0..200 {
        let net = random(&mut dice, Flavour::Moving);
        let Some(graph) = plain::explore(&net, Semantics::Interleaving, 2000) else { continue };
        let found = explore(&net, Semantics::Interleaving, 5);
        if graph.0.len() <= 5 {
            continue;
        }
        stopped += 1;
        assert!(!found.complete && found.markings <= 5, "net {number}");
        if let Some(path) = &found.path {
            let end = plain::replay(&net, path, Semantics::Interleaving).unwrap();
            assert!(graph.0[&end].is_empty(), "net {number}");
        } else {
            assert_eq!((found.live, found.reversible), (None, None), "net {number}");
        }
    }
    assert!(stopped > 20);
}
