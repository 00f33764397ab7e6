//! The search of all reachable markings, breadth first.

use super::depend::{self, Dependence};
use super::layout::{Layout, WIDEST, bits_of};
use super::markings::{Batch, MOST_MARKINGS, Markings, TOGETHER};
use super::moves::{Halt, Moves};
use super::rules::Rules;
use super::words::{Words, borrows};
use std::collections::VecDeque;

/// Moves for each marking of the limit after which a search gives up: under step semantics one marking can have very many.
const MOVES_A_MARKING: u64 = 1000;

/// Markings between two calls of the progress callback.
pub(super) const STRIDE: usize = 1 << 16;

/// Where a search stops before all is found.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stop {
    /// At so many markings.
    pub(super) limit: usize,
    /// At a dead marking.
    pub(super) at_dead: bool,
}

/// What a search found.
#[derive(Clone, Debug)]
pub(super) struct Found {
    pub(super) markings: Markings,
    pub(super) layout: Layout,
    /// The first number of each level: markings that take equally many moves from the initial one.
    pub(super) levels: Vec<usize>,
    pub(super) edges: u64,
    pub(super) dead: u64,
    /// The number of the first dead marking.
    pub(super) first_dead: Option<usize>,
    /// By transition: whether it fired.
    pub(super) fired: Vec<bool>,
    /// By place: the most tokens.
    pub(super) most: Vec<u64>,
    /// All reachable markings were found, and all their moves.
    pub(super) complete: bool,
    /// The next marking to look at, and the last one of its level.
    next: usize,
    level_end: usize,
    skips: VecDeque<u64>,
    pub(super) explored: u64,
    pub(super) bounds: Vec<Option<u64>>,
    bits: Vec<u32>,
    dependences: Vec<Dependence>,
}

impl Found {
    /// Begins with the initial marking, and fields for so many tokens.
    pub(super) fn new(rules: &Rules, initial: &[u64], expected: &[u64]) -> Found {
        let bits: Vec<u32> = expected.iter().zip(initial).map(|(most, now)| bits_of(*most.max(now))).collect();
        let mut order: Vec<usize> = (0..bits.len()).collect();
        // Wide fields last: they become the dependent ones.
        order.sort_by_key(|place| (bits[*place], *place));
        let dependences = depend::find(rules, initial, &order);
        let bounds = depend::bounds(&dependences, &rules.capacities, initial);
        let layout = Layout::new(&bits, &dependences);
        let mut markings = Markings::new(layout.key);
        let (mut batch, mut key) = (Batch::default(), vec![0; layout.key]);
        layout.pack(initial, &mut key);
        batch.push(&key, 0);
        let mut skips = VecDeque::new();
        markings.insert::<Vec<u64>>(&mut batch, 1, &mut skips);
        Found {
            markings,
            layout,
            levels: vec![1],
            edges: 0,
            dead: 0,
            first_dead: None,
            fired: vec![false; rules.list.len()],
            most: initial.to_vec(),
            complete: false,
            next: 1,
            level_end: 1,
            skips,
            explored: 0,
            bits,
            dependences,
            bounds,
        }
    }

    /// The initial marking.
    pub(super) fn initial(&self) -> Vec<u64> {
        let (mut full, mut marking) = (vec![0; self.layout.words], vec![0; self.layout.fields.len()]);
        load::<Vec<u64>, Vec<u64>>(&self.markings, &self.layout, 1, &mut full);
        self.layout.unpack(&full, &mut marking);
        marking
    }

    /// Makes a place's field wide enough. Whether that can be done.
    pub(super) fn widen(&mut self, place: usize, tokens: u64) -> bool {
        if bits_of(tokens) > WIDEST {
            return false;
        }
        self.bits[place] = bits_of(tokens);
        let new = Layout::new(&self.bits, &self.dependences);
        self.markings.repack(&self.layout, &new);
        self.layout = new;
        true
    }

    /// Goes on until all is found, enough is (`Enough`) or a field is too narrow.
    pub(super) fn run<K: Words, F: Words>(
        &mut self,
        moves: &mut impl Moves,
        stop: Stop,
        progress: &mut dyn FnMut(u64),
    ) -> Result<(), Halt> {
        let limit = stop.limit.clamp(1, MOST_MARKINGS);
        let most_edges = (limit as u64).saturating_mul(MOVES_A_MARKING);
        let layout = self.layout.clone();
        let mut high = High::new(&layout, &self.most);
        let (mut from, mut batch) = (F::zeros(layout.words), Batch::default());
        let (markings, fired) = (&mut self.markings, &mut self.fired);
        let skips = &mut self.skips;
        let insert = |batch: &mut Batch, markings: &mut Markings, skips: &mut VecDeque<u64>| {
            if markings.insert::<K>(batch, limit, skips) { Ok(()) } else { Err(Halt::Enough) }
        };
        loop {
            if self.next > self.level_end {
                insert(&mut batch, markings, skips)?;
                if self.next > markings.count() {
                    break;
                }
                self.levels.push(self.level_end + 1);
                self.level_end = markings.count();
            }
            load::<K, F>(markings, &layout, self.next, &mut from);
            high.see(&layout, from.words());
            let mut seen = 0;
            let moves =
                moves.each::<K, F>(&from, skips.front().copied().unwrap_or(0), &mut |key, transitions, skip| {
                    batch.push(key, skip);
                    transitions.iter().for_each(|transition| fired[*transition as usize] = true);
                    seen += 1;
                    if batch.len() < TOGETHER {
                        return Ok(());
                    }
                    insert(&mut batch, markings, skips)?;
                    if self.edges + seen > most_edges { Err(Halt::Enough) } else { Ok(()) }
                });
            self.most.copy_from_slice(&high.most);
            let moves = match moves {
                Ok(moves) => moves,
                // What was looked at before must not be lost.
                Err(halt) => return insert(&mut batch, markings, skips).and(Err(halt)),
            };
            self.edges += moves;
            self.explored += seen;
            skips.pop_front();
            if moves == 0 {
                self.dead += 1;
                self.first_dead.get_or_insert(self.next);
                if stop.at_dead {
                    return insert(&mut batch, markings, skips).and(Err(Halt::Enough));
                }
            }
            if self.next % STRIDE == 0 {
                progress(markings.count() as u64);
            }
            self.next += 1;
        }
        self.complete = true;
        Ok(())
    }
}

/// Loads the full marking with a number.
#[inline(always)]
pub(super) fn load<K: Words, F: Words>(markings: &Markings, layout: &Layout, number: usize, into: &mut F) {
    let length = K::length(layout.key);
    into.words_mut()[..length].copy_from_slice(markings.key::<K>(number));
    layout.complete(into.words_mut());
}

/// The most tokens that were seen in each place.
struct High {
    most: Vec<u64>,
    /// The same, packed.
    words: Vec<u64>,
    tops: Vec<u64>,
    marking: Vec<u64>,
}

impl High {
    fn new(layout: &Layout, most: &[u64]) -> High {
        let mut words = vec![0; layout.words];
        layout.pack(most, &mut words);
        let tops = (0..layout.words).map(|word| layout.tops(word)).collect();
        High { most: most.to_vec(), words, tops, marking: most.to_vec() }
    }

    #[inline(always)]
    fn see(&mut self, layout: &Layout, words: &[u64]) {
        let higher = words.iter().zip(&self.words).zip(&self.tops);
        if higher.fold(0, |any, ((word, most), tops)| any | borrows(*most, *word) & tops) != 0 {
            self.raise(layout, words);
        }
    }

    #[cold]
    fn raise(&mut self, layout: &Layout, words: &[u64]) {
        layout.unpack(words, &mut self.marking);
        for (most, tokens) in self.most.iter_mut().zip(&self.marking) {
            *most = (*most).max(*tokens);
        }
        layout.pack(&self.most, &mut self.words);
    }
}
