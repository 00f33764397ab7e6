//! One scan at a time: transitions are tried in their order on the marking at its start, and each that can fire does. A
//! free one may also let it be.

use super::guards::Guards;
use super::interleaving::{guards, headroom};
use super::layout::Layout;
use super::moves::{Changes, Halt, Moves};
use super::rules::{Rule, Rules};
use super::words::Words;

/// The step semantics over one layout.
#[derive(Debug)]
pub(super) struct Steps<'a> {
    rules: &'a Rules,
    layout: &'a Layout,
    guards: Guards,
    changes: Changes,
    /// Passed where no step can overflow a field.
    headroom: Guards,
    blocked: Vec<u64>,
    enabled: Vec<u32>,
    phase: Phase,
}

/// A scan's gate phase.
#[derive(Clone, Debug, Default)]
pub(super) struct Phase {
    /// By place: tokens at its start.
    pub(super) start: Vec<u64>,
    /// By place: tokens that were not taken.
    pub(super) left: Vec<u64>,
    /// By place: how much it grew.
    filled: Vec<u128>,
    /// By gate: whether it fired.
    gates: Vec<bool>,
    /// What fired: where it stands among the enabled transitions.
    pub(super) fired: Vec<usize>,
}

impl<'a> Steps<'a> {
    /// Packs the rules.
    pub(super) fn new(rules: &'a Rules, layout: &'a Layout, bounds: &[Option<u64>]) -> Steps<'a> {
        Steps {
            rules,
            layout,
            guards: guards(rules, layout),
            changes: Changes::new(rules, layout, layout.key),
            headroom: headroom(rules, layout, bounds, u64::saturating_add),
            blocked: Vec::new(),
            enabled: Vec::new(),
            phase: Phase::of(rules, &[]),
        }
    }

    /// The field that a step overflows, if it does that.
    fn overflow(&self, words: &[u64], fired: &[u32]) -> Result<(), Halt> {
        let mut changed: Vec<(usize, i64)> =
            fired.iter().flat_map(|transition| self.rules.list[*transition as usize].change.iter().copied()).collect();
        changed.sort_unstable();
        for change in changed.chunk_by(|a, b| a.0 == b.0) {
            let place = change[0].0;
            let field = self.layout.fields[place];
            let sum = change.iter().map(|(_, change)| i128::from(*change)).sum::<i128>();
            let tokens = u64::try_from(i128::from(field.get(words)) + sum).unwrap_or(u64::MAX);
            if tokens > field.most() {
                return Err(Halt::Wider { place, tokens });
            }
        }
        Ok(())
    }
}

impl Moves for Steps<'_> {
    fn each<K: Words, F: Words>(
        &mut self,
        from: &F,
        _: u64,
        to: &mut impl FnMut(&[u64], &[u32], u64) -> Result<(), Halt>,
    ) -> Result<u64, Halt> {
        let words = from.words();
        self.headroom.blocked(words, &mut self.blocked);
        let tight = self.blocked[0] != 0;
        self.guards.enabled(words, &mut self.blocked, &mut self.enabled);
        self.phase.start(self.layout, words);
        let (mut key, mut fired, mut steps) = (K::zeros(self.layout.key), Vec::new(), 0);
        let mut first = Some(0);
        while let Some(at) = first {
            self.phase.advance(self.rules, &self.enabled, at);
            fired.clear();
            fired.extend(self.phase.fired.iter().map(|at| self.enabled[*at]));
            if !fired.is_empty() {
                if tight {
                    self.overflow(words, &fired)?;
                }
                key.words_mut().copy_from_slice(&words[..K::length(self.layout.key)]);
                fired.iter().for_each(|transition| self.changes.fire(*transition, key.words_mut()));
                to(key.words(), &fired, 0)?;
                steps += 1;
            }
            first = self.phase.retreat(self.rules, &self.enabled);
        }
        Ok(steps)
    }
}

impl Phase {
    /// The start of a phase, from a marking.
    pub(super) fn of(rules: &Rules, marking: &[u64]) -> Phase {
        let gates = rules.list.iter().map(|rule| rule.gate + 1).max().unwrap_or(0);
        let (start, left) = (marking.to_vec(), marking.to_vec());
        Phase { start, left, filled: vec![0; rules.places], gates: vec![false; gates], fired: Vec::new() }
    }

    /// Fires what can fire from one of the enabled transitions on, free ones too.
    pub(super) fn advance(&mut self, rules: &Rules, enabled: &[u32], first: usize) {
        for (at, transition) in enabled.iter().enumerate().skip(first) {
            if self.can_fire(rules, *transition) {
                self.fire(rules, *transition);
                self.fired.push(at);
            }
        }
    }

    /// Goes back to the last free transition that fired, and does without it.
    pub(super) fn retreat(&mut self, rules: &Rules, enabled: &[u32]) -> Option<usize> {
        while let Some(at) = self.fired.pop() {
            let transition = enabled[at];
            self.take_back(rules, transition);
            if rules.list[transition as usize].free {
                return Some(at + 1);
            }
        }
        None
    }

    fn start(&mut self, layout: &Layout, words: &[u64]) {
        self.start.clear();
        self.start.extend(layout.fields.iter().map(|field| field.get(words)));
        self.left.clone_from(&self.start);
        self.filled.fill(0);
        self.gates.fill(false);
        self.fired.clear();
    }

    /// Whether a transition that is enabled at the start still is.
    fn can_fire(&self, rules: &Rules, transition: u32) -> bool {
        let rule = &rules.list[transition as usize];
        !self.is_closed(rule) && rule.takes.iter().all(|(place, weight)| self.left[*place] >= *weight)
    }

    /// Whether another one of its gate has fired, or there is no room.
    pub(super) fn is_closed(&self, rule: &Rule) -> bool {
        let is_full =
            |(place, most): &(usize, u64)| u128::from(self.start[*place]) + self.filled[*place] > u128::from(*most);
        self.gates[rule.gate] || rule.room.iter().any(is_full)
    }

    pub(super) fn fire(&mut self, rules: &Rules, transition: u32) {
        let rule = &rules.list[transition as usize];
        self.gates[rule.gate] = true;
        rule.takes.iter().for_each(|(place, weight)| self.left[*place] -= weight);
        grown(rule).for_each(|(place, more)| self.filled[place] += u128::from(more));
    }

    fn take_back(&mut self, rules: &Rules, transition: u32) {
        let rule = &rules.list[transition as usize];
        self.gates[rule.gate] = false;
        rule.takes.iter().for_each(|(place, weight)| self.left[*place] += weight);
        grown(rule).for_each(|(place, more)| self.filled[place] -= u128::from(more));
    }
}

/// The places in which a transition needs room, and how much.
fn grown(rule: &Rule) -> impl Iterator<Item = (usize, u64)> + '_ {
    rule.change.iter().filter(|(_, change)| *change > 0).map(|(place, change)| (*place, change.unsigned_abs()))
}
