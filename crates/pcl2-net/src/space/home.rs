//! Whether every marking leads back to the initial one, tried quickly: one move is chosen in each marking, and the markings
//! whose chain of moves ends at home are at home too. The others choose anew, some times. Only a yes is an answer.

use super::interleaving::Interleaving;
use super::markings::{Batch, TOGETHER};
use super::rules::{Rule, Rules};
use super::search::{Found, load};
use super::words::Words;
use std::cmp::Reverse;

/// Choices after which it is given up, and the share of the markings that one in a few of them must bring home.
const ROUNDS: u64 = 64;
const LEAST_SHARE: usize = 32;
const PATIENCE: u32 = 4;

/// Whether the choices led home from everywhere. All markings must have been found.
pub(super) fn always<K: Words, F: Words>(found: &Found, rules: &Rules, moves: &mut Interleaving<'_>) -> bool {
    let distances = Distances::new(rules, found);
    let mut search = Search {
        found,
        moves,
        from: F::zeros(found.layout.words),
        key: K::zeros(found.layout.key),
        next: vec![0; found.markings.count() + 1],
    };
    search.next[1] = HOME;
    let mut away: Vec<u32> = (2..search.next.len() as u32).collect();
    let mut vain = 0;
    for round in 0..ROUNDS {
        let before = away.len();
        if round % 2 == 0 {
            let order = distances.order(round);
            search.choose(&away, &|_, enabled| enabled.iter().copied().max_by_key(|at| order[*at as usize]));
        } else {
            search.choose(&away, &|marking, enabled| enabled.get(mixed(round, marking, enabled.len())).copied());
        }
        search.follow(&away);
        away.retain(|marking| search.next[*marking as usize] != HOME);
        vain = if before - away.len() < before / LEAST_SHARE { vain + 1 } else { 0 };
        if away.is_empty() || vain == PATIENCE {
            break;
        }
    }
    away.is_empty()
}

/// A number below another one that looks random.
fn mixed(round: u64, number: u32, end: usize) -> usize {
    let mixed = ((round << 32) ^ u64::from(number)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mixed = (mixed ^ (mixed >> 32)).wrapping_mul(0xd6e8_feb8_6659_fd93);
    ((u128::from(mixed) * end as u128) >> 64) as usize
}

/// How far transitions are from the initial marking, if each token could be used many times.
struct Distances {
    /// By transition: after how many others it can fire at the earliest.
    from_home: Vec<u32>,
    /// By transition: how many others bring what it puts to places that are marked at home.
    to_home: Vec<u32>,
}

impl Distances {
    fn new(rules: &Rules, found: &Found) -> Distances {
        let initial = found.initial();
        let takes = |rule: &Rule| rule.takes.iter().chain(&rule.reads).map(|(place, _)| *place).collect::<Vec<_>>();
        let gains =
            |rule: &Rule| rule.change.iter().filter(|(_, change)| *change > 0).map(|(place, _)| *place).collect();
        let forward: Vec<_> = rules.list.iter().map(|rule| (takes(rule), gains(rule))).collect();
        let backward: Vec<_> =
            forward.iter().map(|(takes, gains): &(_, Vec<usize>)| (gains.clone(), takes.clone())).collect();
        Distances { from_home: spread(&initial, &forward), to_home: spread(&initial, &backward) }
    }

    /// By transition: the higher the sooner it is chosen. First what is farthest from the initial marking: that brings
    /// work in hand to its end. Of those what is nearest to its return.
    fn order(&self, round: u64) -> Vec<usize> {
        let count = self.from_home.len();
        let rank = |at: &usize| {
            let far = if round == 0 { self.from_home[*at] } else { 0 };
            (far, Reverse(self.to_home[*at]), mixed(round, *at as u32, usize::MAX))
        };
        let mut sorted: Vec<usize> = (0..count).collect();
        sorted.sort_by_key(rank);
        let mut order = vec![0; count];
        sorted.into_iter().enumerate().for_each(|(position, at)| order[at] = position);
        order
    }
}

/// By transition: in which round all places of its first list are reached, and with it those of its second list. Marked
/// places are reached before the first round.
fn spread(marking: &[u64], transitions: &[(Vec<usize>, Vec<usize>)]) -> Vec<u32> {
    let mut places: Vec<u32> = marking.iter().map(|tokens| if *tokens > 0 { 0 } else { u32::MAX }).collect();
    let mut rounds = vec![u32::MAX; transitions.len()];
    for round in 1..=transitions.len() as u32 {
        let is_new =
            |at: &usize| rounds[*at] == u32::MAX && transitions[*at].0.iter().all(|place| places[*place] < round);
        let new: Vec<usize> = (0..transitions.len()).filter(is_new).collect();
        if new.is_empty() {
            break;
        }
        for transition in new {
            rounds[transition] = round;
            transitions[transition].1.iter().for_each(|place| places[*place] = places[*place].min(round));
        }
    }
    rounds
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
    /// Chooses one of the enabled transitions of each marking.
    fn choose(&mut self, markings: &[u32], choice: &impl Fn(u32, &[u32]) -> Option<u32>) {
        let (mut batch, mut numbers) = (Batch::default(), Vec::new());
        for chunk in markings.chunks(TOGETHER) {
            for marking in chunk {
                load::<K, F>(&self.found.markings, &self.found.layout, *marking as usize, &mut self.from);
                self.moves.one(&self.from, &mut self.key, |enabled| choice(*marking, enabled));
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
