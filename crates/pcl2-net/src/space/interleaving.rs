//! One transition at a time.

use super::guards::Guards;
use super::layout::Layout;
use super::moves::{Changes, Halt, Moves, overflow};
use super::rules::Rules;
use super::words::Words;

/// The interleaving semantics over one layout.
#[derive(Debug)]
pub(super) struct Interleaving<'a> {
    rules: &'a Rules,
    layout: &'a Layout,
    guards: Guards,
    pub(super) changes: Changes,
    /// Passed where no transition can overflow a field.
    headroom: Guards,
    kept: Vec<u64>,
    blocked: Vec<u64>,
    /// What [`Interleaving::look`] found.
    pub(super) enabled: Vec<u32>,
}

impl<'a> Interleaving<'a> {
    /// Packs the rules.
    pub(super) fn new(rules: &'a Rules, layout: &'a Layout, bounds: &[Option<u64>]) -> Interleaving<'a> {
        let guards = guards(rules, layout);
        let changes = Changes::new(rules, layout, layout.key);
        let headroom = headroom(rules, layout, bounds, u64::max);
        let kept = kept(rules);
        Interleaving { rules, layout, kept, guards, changes, headroom, blocked: Vec::new(), enabled: Vec::new() }
    }
}

/// What each transition alone asks of a marking.
pub(super) fn guards(rules: &Rules, layout: &Layout) -> Guards {
    let mut guards = Guards::new(rules.list.len());
    for (transition, rule) in rules.list.iter().enumerate() {
        guards.at_least(layout, transition, &rule.lower());
        guards.at_most(layout, transition, &rule.upper());
        if rule.never {
            guards.forbid(transition);
        }
    }
    guards.sort();
    guards
}

impl Interleaving<'_> {
    /// Finds the enabled transitions of a marking.
    #[inline(always)]
    pub(super) fn look(&mut self, words: &[u64]) -> Result<(), Halt> {
        self.headroom.blocked(words, &mut self.blocked);
        let tight = self.blocked[0] != 0;
        self.guards.enabled(words, &mut self.blocked, &mut self.enabled);
        if tight {
            for transition in &self.enabled {
                overflow(self.rules, self.layout, *transition, words)?;
            }
        }
        Ok(())
    }

    /// The key after the enabled transition that is chosen; its own if none is.
    #[inline(always)]
    pub(super) fn one<K: Words, F: Words>(&mut self, from: &F, key: &mut K, choice: impl Fn(&[u32]) -> Option<u32>) {
        let words = from.words();
        self.guards.enabled(words, &mut self.blocked, &mut self.enabled);
        key.words_mut().copy_from_slice(&words[..K::length(self.layout.key)]);
        if let Some(chosen) = choice(&self.enabled) {
            self.changes.fire(chosen, key.words_mut());
        }
    }
}

/// A guard against overflow of fields by what transitions add to them, taken together in some way.
pub(super) fn headroom(
    rules: &Rules,
    layout: &Layout,
    proven: &[Option<u64>],
    together: fn(u64, u64) -> u64,
) -> Guards {
    let mut added = vec![0; rules.places];
    for (place, change) in rules.list.iter().flat_map(|rule| &rule.change).filter(|(_, change)| *change > 0) {
        added[*place] = together(added[*place], change.unsigned_abs());
    }
    let mut guards = Guards::new(1);
    let mut bounds = Vec::new();
    for (place, added) in added.into_iter().enumerate().filter(|(_, added)| *added > 0) {
        let most = layout.fields[place].most();
        if proven[place].is_some_and(|bound| bound <= most) {
            continue;
        }
        match most.checked_sub(added) {
            Some(most) => bounds.push((place, most)),
            None => guards.forbid(0),
        }
    }
    guards.at_most(layout, 0, &bounds);
    guards.sort();
    guards
}

impl Moves for Interleaving<'_> {
    #[inline(always)]
    fn each<K: Words, F: Words>(
        &mut self,
        from: &F,
        skip: u64,
        to: &mut impl FnMut(&[u64], &[u32], u64) -> Result<(), Halt>,
    ) -> Result<u64, Halt> {
        let words = from.words();
        self.look(words)?;
        let mut key = K::zeros(self.layout.key);
        let all = self.enabled.iter().fold(0, |all, t| all | 1_u64.checked_shl(*t).unwrap_or(0));
        for transition in &self.enabled {
            let bit = 1_u64.checked_shl(*transition).unwrap_or(0);
            if skip & bit != 0 {
                continue;
            }
            let child = all & bit.wrapping_sub(1) & self.kept[*transition as usize];
            let length = K::length(self.layout.key);
            key.words_mut().copy_from_slice(&words[..length]);
            self.changes.fire(*transition, key.words_mut());
            to(key.words(), std::slice::from_ref(transition), child)?;
        }
        Ok(self.enabled.len() as u64)
    }
}

/// By transition t: which of the first 64 transitions leave it enabled. Where such a u with a lower number is enabled in
/// m too, the marking behind m + t and u is found from m + u by t: u is skipped in m + t. Skipping again leads to ever
/// higher numbers, so every marking is found by somebody.
fn kept(rules: &Rules) -> Vec<u64> {
    rules
        .list
        .iter()
        .map(|rule| {
            let (lower, upper) = (rule.lower(), rule.upper());
            let mut mask = 0;
            for (at, other) in rules.list.iter().enumerate().take(64) {
                let disables = other.change.iter().any(|(place, change)| {
                    (*change < 0 && lower.iter().any(|(p, _)| p == place))
                        || (*change > 0 && upper.iter().any(|(p, _)| p == place))
                });
                if !disables {
                    mask |= 1_u64 << at;
                }
            }
            mask
        })
        .collect()
}
