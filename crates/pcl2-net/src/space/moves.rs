//! What leads from one packed marking to the next ones.

use super::interleaving::Interleaving;
use super::layout::Layout;
use super::rules::Rules;
use super::steps::Steps;
use super::stubborn::Stubborn;
use super::words::Words;

/// Why no further move is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Halt {
    /// The field of a place is too narrow for a number of tokens.
    Wider { place: usize, tokens: u64 },
    /// Enough was seen.
    Enough,
}

/// A semantics: the moves that it allows.
pub(super) trait Moves {
    /// Hands out the key after each move from a full marking, with the transitions that fire. How many moves there were.
    fn each<K: Words, F: Words>(
        &mut self,
        from: &F,
        skip: u64,
        to: &mut impl FnMut(&[u64], &[u32], u64) -> Result<(), Halt>,
    ) -> Result<u64, Halt>;
}

/// Which moves are looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// All of the interleaving semantics.
    Interleaving,
    /// Those of them that reach all dead markings.
    Stubborn,
    /// All of the step semantics.
    Steps,
}

/// The moves of any kind.
#[derive(Debug)]
pub(super) enum AnyMoves<'a> {
    Interleaving(Interleaving<'a>),
    Stubborn(Stubborn<'a>),
    Steps(Steps<'a>),
}

impl<'a> AnyMoves<'a> {
    /// Packs the rules.
    pub(super) fn new(kind: Kind, rules: &'a Rules, layout: &'a Layout, bounds: &[Option<u64>]) -> AnyMoves<'a> {
        match kind {
            Kind::Interleaving => AnyMoves::Interleaving(Interleaving::new(rules, layout, bounds)),
            Kind::Stubborn => AnyMoves::Stubborn(Stubborn::new(rules, layout, bounds)),
            Kind::Steps => AnyMoves::Steps(Steps::new(rules, layout, bounds)),
        }
    }
}

impl Moves for AnyMoves<'_> {
    fn each<K: Words, F: Words>(
        &mut self,
        from: &F,
        skip: u64,
        to: &mut impl FnMut(&[u64], &[u32], u64) -> Result<(), Halt>,
    ) -> Result<u64, Halt> {
        match self {
            AnyMoves::Interleaving(moves) => moves.each::<K, F>(from, skip, to),
            AnyMoves::Stubborn(moves) => moves.each::<K, F>(from, skip, to),
            AnyMoves::Steps(moves) => moves.each::<K, F>(from, skip, to),
        }
    }
}

/// What each transition adds to the words of a marking.
#[derive(Clone, Debug, Default)]
pub(super) struct Changes {
    /// Where the transition's list begins; one more at the end.
    starts: Vec<u32>,
    list: Vec<(u32, u64)>,
}

impl Changes {
    /// The changes of the first so many words.
    pub(super) fn new(rules: &Rules, layout: &Layout, words: usize) -> Changes {
        let mut changes = Changes { starts: vec![0], list: Vec::new() };
        for rule in &rules.list {
            let mut sums: Vec<(u32, u64)> = Vec::new();
            for (place, change) in &rule.change {
                let field = layout.fields[*place];
                let (word, share) = (field.word as u32, field.put(*change as u64));
                match sums.iter_mut().find(|(known, _)| *known == word) {
                    Some((_, sum)) => *sum = sum.wrapping_add(share),
                    None => sums.push((word, share)),
                }
            }
            changes.list.extend(sums.into_iter().filter(|(word, _)| (*word as usize) < words));
            changes.starts.push(changes.list.len() as u32);
        }
        changes
    }

    /// Fires a transition. A whole word is added to at once: no field overflows, so none disturbs another.
    #[inline(always)]
    pub(super) fn fire(&self, transition: u32, words: &mut [u64]) {
        let (start, end) = (self.starts[transition as usize] as usize, self.starts[transition as usize + 1] as usize);
        for (word, change) in &self.list[start..end] {
            let word = &mut words[*word as usize];
            *word = word.wrapping_add(*change);
        }
    }
}

/// The field that overflows, if a transition does that.
pub(super) fn overflow(rules: &Rules, layout: &Layout, transition: u32, words: &[u64]) -> Result<(), Halt> {
    for (place, change) in &rules.list[transition as usize].change {
        let field = layout.fields[*place];
        let tokens = field.get(words).saturating_add_signed(*change);
        if tokens > field.most() {
            return Err(Halt::Wider { place: *place, tokens });
        }
    }
    Ok(())
}
