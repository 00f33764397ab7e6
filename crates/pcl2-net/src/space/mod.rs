//! The state space of a net: its reachable markings, one transition at a time.

mod depend;
mod game;
mod guards;
mod interleaving;
mod layout;
mod markings;
mod moves;
mod rules;
mod search;
mod words;

use crate::pt::PtNet;
use interleaving::Interleaving;
use moves::Halt;
use rules::Rules;
use search::Found;

/// What is known of the reachable markings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Space {
    /// How many markings were found.
    pub markings: u64,
    /// Pairs of a marking and a transition that is enabled in it, of the markings that were looked at.
    pub edges: u64,
    /// Markings in which no transition is enabled, of those that were looked at.
    pub dead: u64,
    /// By place: the most tokens that were seen.
    pub most: Vec<u64>,
    /// By transition: whether it was enabled somewhere.
    pub fired: Vec<bool>,
    /// All reachable markings were looked at.
    pub complete: bool,
}

/// Explores at most so many markings, breadth first. `progress` is told from time to time how many were found.
pub fn explore(net: &PtNet, limit: usize, progress: &mut dyn FnMut(u64)) -> Space {
    let rules = Rules::new(net);
    let initial: Vec<u64> = net.places.iter().map(|place| place.initial).collect();
    let mut found = Found::new(&rules, &initial, &game::expected(&rules, &initial));
    loop {
        let (layout, bounds) = (found.layout.clone(), found.bounds.clone());
        let mut moves = Interleaving::new(&rules, &layout, &bounds);
        let halt = match (layout.key, layout.words) {
            (1, 1) => found.run::<[u64; 1], [u64; 1]>(&mut moves, limit, progress),
            (1, 2) => found.run::<[u64; 1], [u64; 2]>(&mut moves, limit, progress),
            (2, 2) => found.run::<[u64; 2], [u64; 2]>(&mut moves, limit, progress),
            (2, 3) => found.run::<[u64; 2], [u64; 3]>(&mut moves, limit, progress),
            (_, _) => found.run::<Vec<u64>, Vec<u64>>(&mut moves, limit, progress),
        };
        match halt {
            Err(Halt::Wider { place, tokens }) if found.widen(place, tokens) => {}
            Err(Halt::Wider { .. } | Halt::Enough) | Ok(()) => break,
        }
    }
    Space {
        markings: found.markings.count() as u64,
        edges: found.edges,
        dead: found.dead,
        most: found.most,
        fired: found.fired,
        complete: found.complete,
    }
}
