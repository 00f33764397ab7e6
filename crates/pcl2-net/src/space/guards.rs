//! Which transitions are enabled in a packed marking, all tested at once, word by word and without a branch.

use super::layout::{Field, Layout};
use super::words::borrows;

/// Tests of one kind: at least, or at most, so many tokens in some fields of a word.
#[derive(Clone, Debug, Default)]
pub(super) struct Guards {
    least: Vec<Test>,
    most: Vec<Test>,
    /// Not 0 where a transition can never be enabled.
    never: Vec<u64>,
}

#[derive(Clone, Copy, Debug)]
struct Test {
    word: u32,
    transition: u32,
    /// The numbers in their fields.
    bound: u64,
    /// All bits of the fields.
    mask: u64,
    /// The top bits of the fields.
    tops: u64,
}

impl Guards {
    /// No test yet, of so many transitions.
    pub(super) fn new(transitions: usize) -> Guards {
        Guards { never: vec![0; transitions], ..Guards::default() }
    }

    /// Forbids a transition.
    pub(super) fn forbid(&mut self, transition: usize) {
        self.never[transition] = 1;
    }

    /// Adds: at least so many tokens.
    pub(super) fn at_least(&mut self, layout: &Layout, transition: usize, bounds: &[(usize, u64)]) {
        for (place, number) in bounds.iter().filter(|(_, number)| *number > 0) {
            let field = layout.fields[*place];
            if *number > field.most() {
                self.forbid(transition);
            } else {
                add(&mut self.least, transition, field, *number);
            }
        }
    }

    /// Adds: at most so many tokens.
    pub(super) fn at_most(&mut self, layout: &Layout, transition: usize, bounds: &[(usize, u64)]) {
        for (place, number) in bounds {
            let field = layout.fields[*place];
            if *number < field.most() {
                add(&mut self.most, transition, field, *number);
            }
        }
    }

    /// Puts the tests in order of words.
    pub(super) fn sort(&mut self) {
        for tests in [&mut self.least, &mut self.most] {
            tests.sort_by_key(|test| (test.word, test.transition));
        }
    }

    /// For each transition 0 if it is enabled.
    #[inline(always)]
    pub(super) fn blocked(&self, words: &[u64], blocked: &mut Vec<u64>) {
        blocked.clear();
        blocked.extend_from_slice(&self.never);
        for test in &self.least {
            blocked[test.transition as usize] |= borrows(words[test.word as usize], test.bound) & test.tops;
        }
        for test in &self.most {
            blocked[test.transition as usize] |= borrows(test.bound, words[test.word as usize] & test.mask) & test.tops;
        }
    }

    /// The enabled transitions.
    #[inline(always)]
    pub(super) fn enabled(&self, words: &[u64], blocked: &mut Vec<u64>, enabled: &mut Vec<u32>) {
        self.blocked(words, blocked);
        enabled.resize(blocked.len(), 0);
        let mut count = 0;
        for (transition, blocked) in (0_u32..).zip(blocked.iter()) {
            enabled[count] = transition;
            count += usize::from(*blocked == 0);
        }
        enabled.truncate(count);
    }
}

fn add(tests: &mut Vec<Test>, transition: usize, field: Field, number: u64) {
    let (word, transition) = (field.word as u32, transition as u32);
    let mine = tests.iter().rposition(|test| test.transition != transition).map_or(0, |last| last + 1);
    let (bound, mask, tops) = (field.put(number), field.put(field.most()), field.top());
    match tests[mine..].iter_mut().find(|test| test.word == word) {
        Some(test) => {
            test.bound |= bound;
            test.mask |= mask;
            test.tops |= tops;
        }
        None => tests.push(Test { word, transition, bound, mask, tops }),
    }
}
