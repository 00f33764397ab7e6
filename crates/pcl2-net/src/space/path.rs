//! The way from the initial marking to another one.

use super::moves::{Halt, Moves};
use super::search::{Found, load};
use super::words::Words;

/// The moves from the initial marking to the one with a number, each with the transitions that fire. No way is shorter:
/// in each level of the search some marking leads into the next one.
pub(super) fn shortest<K: Words, F: Words>(
    found: &Found,
    moves: &mut impl Moves,
    number: usize,
) -> Option<Vec<Vec<u32>>> {
    let (mut target, mut from) = (number, F::zeros(found.layout.words));
    let mut path = Vec::new();
    let levels = &found.levels[..found.levels.partition_point(|first| *first <= number)];
    for level in levels.windows(2).rev() {
        let key = found.markings.key::<K>(target);
        let (before, fired) = (level[0]..level[1]).find_map(|number| {
            load::<K, F>(&found.markings, &found.layout, number, &mut from);
            Some((number, move_to::<K, F>(moves, &from, key)?))
        })?;
        path.push(fired);
        target = before;
    }
    path.reverse();
    Some(path)
}

/// The transitions that fire together on the way from a marking to the one with a key.
fn move_to<K: Words, F: Words>(moves: &mut impl Moves, from: &F, key: &[u64]) -> Option<Vec<u32>> {
    let mut found = None;
    let _ = moves.each::<K, F>(from, 0, &mut |reached, transitions, _| {
        if reached == key {
            found = Some(transitions.to_vec());
            return Err(Halt::Enough);
        }
        Ok(())
    });
    found
}
