//! Whether every marking leads back to the initial one, tried quickly: one move is chosen in each marking, and the markings
//! whose chain of moves ends at home are at home too. The others choose anew, some times. Only a yes is an answer.

use super::interleaving::Interleaving;
use super::markings::{Batch, TOGETHER};
use super::rules::{Rule, Rules};
use super::search::{Found, load};
use super::words::Words;

/// Choices after which it is given up, and the share of the markings that each must bring home.
const ROUNDS: u64 = 200;
const LEAST_SHARE: usize = 32;

/// Whether the choices led home from everywhere. All markings must have been found.
pub(super) fn always<K: Words, F: Words>(found: &Found, rules: &Rules, moves: &mut Interleaving<'_>) -> bool {
    let distances = distances(rules, found);
    let mut search = Search {
        found,
        moves,
        from: F::zeros(found.layout.words),
        key: K::zeros(found.layout.key),
        next: vec![0; found.markings.count() + 1],
    };
    search.next[1] = HOME;
    let mut away: Vec<u32> = (2..search.next.len() as u32).collect();
    for round in 0..ROUNDS {
        let before = away.len();
        // First what is farthest from the initial marking: that brings work in hand to its end.
        let distance = |transition: u32| if round == 0 { distances[transition as usize] } else { 0 };
        search.choose(&away, &|marking, transition| (distance(transition), mixed(round, marking, transition)));
        search.follow(&away);
        away.retain(|marking| search.next[*marking as usize] != HOME);
        if away.is_empty() || before - away.len() < before / LEAST_SHARE {
            break;
        }
    }
    away.is_empty()
}

/// Numbers that look random.
fn mixed(round: u64, marking: u32, transition: u32) -> u64 {
    let seed = (round << 58) ^ (u64::from(marking) << 26) ^ u64::from(transition);
    let mixed = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    (mixed ^ (mixed >> 32)).wrapping_mul(0xd6e8_feb8_6659_fd93)
}

/// By transition: after how many others it can fire at the earliest, if each token could be used many times.
fn distances(rules: &Rules, found: &Found) -> Vec<u32> {
    let mut marking = vec![0; rules.places];
    let mut full = found.markings.key::<Vec<u64>>(1).to_vec();
    full.resize(found.layout.words, 0);
    found.layout.complete(&mut full);
    found.layout.unpack(&full, &mut marking);
    let mut places: Vec<u32> = marking.iter().map(|tokens| if *tokens > 0 { 0 } else { u32::MAX }).collect();
    let mut distances = vec![u32::MAX; rules.list.len()];
    for round in 1..=rules.list.len() as u32 {
        let fires = |rule: &Rule, places: &[u32]| {
            rule.lower().iter().all(|(place, least)| *least == 0 || places[*place] < round)
        };
        let new: Vec<usize> =
            (0..rules.list.len()).filter(|at| distances[*at] == u32::MAX && fires(&rules.list[*at], &places)).collect();
        if new.is_empty() {
            break;
        }
        for transition in new {
            distances[transition] = round;
            let gains = rules.list[transition].change.iter().filter(|(_, change)| *change > 0);
            gains.for_each(|(place, _)| places[*place] = places[*place].min(round));
        }
    }
    distances
}

/// What stands for the next marking where the way home is known, and where it is on the way that is looked at.
const HOME: u32 = u32::MAX;

struct Search<'a, 'r, K, F> {
    found: &'a Found,
    moves: &'a mut Interleaving<'r>,
    from: F,
    key: K,
    /// By marking: the one that the chosen move leads to.
    next: Vec<u32>,
}

impl<K: Words, F: Words> Search<'_, '_, K, F> {
    /// Chooses the move of the highest rank in each marking.
    fn choose(&mut self, markings: &[u32], rank: &impl Fn(u32, u32) -> (u32, u64)) {
        let (mut batch, mut numbers) = (Batch::default(), Vec::new());
        for chunk in markings.chunks(TOGETHER) {
            for marking in chunk {
                load::<K, F>(&self.found.markings, &self.found.layout, *marking as usize, &mut self.from);
                self.moves.best(&self.from, &mut self.key, |transition| rank(*marking, transition));
                batch.push(self.key.words(), 0);
            }
            numbers.clear();
            self.found.markings.numbers::<K>(&mut batch, &mut numbers);
            chunk.iter().zip(&numbers).for_each(|(marking, next)| self.next[*marking as usize] = *next);
        }
    }

    /// Follows the chosen moves. A way that comes to itself again is cut there.
    fn follow(&mut self, markings: &[u32]) {
        let mut way = Vec::new();
        for marking in markings {
            let mut at = *marking;
            // 0 is on this way, or on an earlier one that did not lead home.
            while self.next[at as usize] != HOME && self.next[at as usize] != 0 {
                way.push(at);
                at = std::mem::take(&mut self.next[at as usize]);
            }
            let end = self.next[at as usize];
            way.drain(..).for_each(|passed| self.next[passed as usize] = end);
        }
    }
}
