//! Work on packed markings that is compiled for each common length of them.

use super::components::{self, Bottoms};
use super::home;
use super::interleaving::Interleaving;
use super::layout::Layout;
use super::moves::{AnyMoves, Halt};
use super::path;
use super::rules::Rules;
use super::search::{Found, Stop};
use super::words::Words;

/// A piece of work.
pub(super) trait Job {
    /// What comes out.
    type Output;
    /// Does it, on keys and full markings of these lengths.
    fn run<K: Words, F: Words>(self) -> Self::Output;
}

impl Layout {
    /// Does a piece of work on this layout.
    pub(super) fn by_length<J: Job>(&self, job: J) -> J::Output {
        match (self.key, self.words) {
            (1, 1) => job.run::<[u64; 1], [u64; 1]>(),
            (1, 2) => job.run::<[u64; 1], [u64; 2]>(),
            (2, 2) => job.run::<[u64; 2], [u64; 2]>(),
            (2, 3) => job.run::<[u64; 2], [u64; 3]>(),
            (_, _) => job.run::<Vec<u64>, Vec<u64>>(),
        }
    }
}

/// [`Found::run`]
pub(super) struct Explore<'a, 'm> {
    pub(super) found: &'a mut Found,
    pub(super) moves: &'a mut AnyMoves<'m>,
    pub(super) stop: Stop,
    pub(super) progress: &'a mut dyn FnMut(u64),
}

impl Job for Explore<'_, '_> {
    type Output = Result<(), Halt>;

    fn run<K: Words, F: Words>(self) -> Result<(), Halt> {
        match self.moves {
            AnyMoves::Interleaving(moves) => self.found.run::<K, F>(moves, self.stop, self.progress),
            AnyMoves::Stubborn(moves) => self.found.run::<K, F>(moves, self.stop, self.progress),
            AnyMoves::Steps(moves) => self.found.run::<K, F>(moves, self.stop, self.progress),
        }
    }
}

/// [`path::shortest`]
pub(super) struct Way<'a, 'm> {
    pub(super) found: &'a Found,
    pub(super) moves: &'a mut AnyMoves<'m>,
    pub(super) number: usize,
}

impl Job for Way<'_, '_> {
    type Output = Option<Vec<Vec<u32>>>;

    fn run<K: Words, F: Words>(self) -> Self::Output {
        path::shortest::<K, F>(self.found, self.moves, self.number)
    }
}

/// [`components::bottoms`]
pub(super) struct Components<'a, 'm> {
    pub(super) found: &'a Found,
    pub(super) moves: &'a mut AnyMoves<'m>,
    pub(super) progress: &'a mut dyn FnMut(u64),
}

impl Job for Components<'_, '_> {
    type Output = Result<Bottoms, Halt>;

    fn run<K: Words, F: Words>(self) -> Self::Output {
        components::bottoms::<K, F>(self.found, self.moves, self.progress)
    }
}

/// [`home::always`]
pub(super) struct Home<'a> {
    pub(super) found: &'a Found,
    pub(super) rules: &'a Rules,
}

impl Job for Home<'_> {
    type Output = bool;

    fn run<K: Words, F: Words>(self) -> bool {
        let mut moves = Interleaving::new(self.rules, &self.found.layout, &self.found.bounds);
        home::always::<K, F>(self.found, self.rules, &mut moves)
    }
}
