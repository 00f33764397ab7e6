//! Where the tokens of each place stand in a packed marking.
//!
//! A full marking has a field for each place. Its first words are the key, which is what is stored: they have the fields
//! of the independent places. Tokens of dependent places follow from those by linear equations, the place invariants, and
//! stand in the words behind the key.

use super::depend::Dependence;
use std::cmp::Reverse;

/// A run of bits in one word.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Field {
    pub(super) word: usize,
    pub(super) shift: u32,
    pub(super) bits: u32,
}

impl Field {
    /// The number in the field.
    #[inline(always)]
    pub(super) fn get(self, words: &[u64]) -> u64 {
        (words[self.word] >> self.shift) & self.most()
    }

    /// The largest number that the field holds.
    #[inline(always)]
    pub(super) fn most(self) -> u64 {
        (1 << self.bits) - 1
    }

    /// A number in its place in the word.
    #[inline(always)]
    pub(super) fn put(self, number: u64) -> u64 {
        number << self.shift
    }

    /// The field's top bit.
    pub(super) fn top(self) -> u64 {
        1 << (self.shift + self.bits - 1)
    }
}

/// The widest field.
pub(super) const WIDEST: u32 = 62;

/// How many bits a number takes, at least one.
pub(super) fn bits_of(number: u64) -> u32 {
    (u64::BITS - number.leading_zeros()).max(1)
}

/// The fields of all places.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    /// By place.
    pub(super) fields: Vec<Field>,
    /// Words of the key.
    pub(super) key: usize,
    /// Words of a full marking.
    pub(super) words: usize,
    /// The words behind the key, of a marking whose independent places are empty.
    start: Vec<u64>,
    terms: Vec<Term>,
}

/// What each token of an independent place adds to a word behind the key.
#[derive(Clone, Copy, Debug)]
struct Term {
    source: Field,
    word: usize,
    factor: u64,
}

impl Layout {
    /// Lays out fields of so many bits.
    pub(super) fn new(bits: &[u32], dependences: &[Dependence]) -> Layout {
        let mut fields = vec![Field::default(); bits.len()];
        let mut dependent = vec![false; bits.len()];
        dependences.iter().for_each(|dependence| dependent[dependence.place] = true);
        let part = |wanted: bool| (0..bits.len()).filter(|place| dependent[*place] == wanted).collect::<Vec<_>>();
        let key = place_fields(&part(false), bits, 0, &mut fields).max(1);
        let words = place_fields(&part(true), bits, key, &mut fields).max(key);
        let mut layout = Layout { fields, key, words, start: vec![0; words - key], terms: Vec::new() };
        dependences.iter().for_each(|dependence| layout.depend(dependence));
        layout
    }

    /// Wrapping sums of whole words are right, since in the end no field overflows.
    fn depend(&mut self, dependence: &Dependence) {
        let field = self.fields[dependence.place];
        let start = &mut self.start[field.word - self.key];
        *start = start.wrapping_add(field.put(dependence.constant as u64));
        for (place, factor) in &dependence.terms {
            let (source, factor) = (self.fields[*place], field.put(*factor as u64));
            let same = |term: &&mut Term| {
                (term.word, term.source.word, term.source.shift) == (field.word, source.word, source.shift)
            };
            match self.terms.iter_mut().find(same) {
                Some(term) => term.factor = term.factor.wrapping_add(factor),
                None => self.terms.push(Term { source, word: field.word, factor }),
            }
        }
    }

    /// Computes the words behind the key.
    #[inline(always)]
    pub(super) fn complete(&self, words: &mut [u64]) {
        words[self.key..self.words].copy_from_slice(&self.start);
        for term in &self.terms {
            words[term.word] = words[term.word].wrapping_add(term.source.get(words).wrapping_mul(term.factor));
        }
    }

    /// Packs a marking.
    pub(super) fn pack(&self, marking: &[u64], words: &mut [u64]) {
        words.fill(0);
        for (field, tokens) in self.fields.iter().zip(marking) {
            if let Some(word) = words.get_mut(field.word) {
                *word |= field.put(*tokens);
            }
        }
    }

    /// Unpacks a full marking.
    pub(super) fn unpack(&self, words: &[u64], marking: &mut [u64]) {
        for (field, tokens) in self.fields.iter().zip(marking) {
            *tokens = field.get(words);
        }
    }

    /// The top bits of all fields of a word.
    pub(super) fn tops(&self, word: usize) -> u64 {
        self.fields.iter().filter(|field| field.word == word).fold(0, |tops, field| tops | field.top())
    }
}

/// Puts fields into words from one on, wide ones first; the word after the last one.
fn place_fields(places: &[usize], bits: &[u32], first: usize, fields: &mut [Field]) -> usize {
    let mut order = places.to_vec();
    order.sort_by_key(|place| (Reverse(bits[*place]), *place));
    let (mut used, mut open): (Vec<u32>, usize) = (Vec::new(), 0);
    for place in order {
        let width = bits[place];
        let fits = |used: &u32| used + width <= u64::BITS;
        let at = (open..used.len()).find(|word| fits(&used[*word])).unwrap_or_else(|| {
            used.push(0);
            used.len() - 1
        });
        fields[place] = Field { word: first + at, shift: used[at], bits: width };
        used[at] += width;
        // Words that are full need not be looked at again.
        while used.get(open).is_some_and(|used| *used == u64::BITS) {
            open += 1;
        }
    }
    first + used.len()
}
