//! Walks at random until nothing can fire any more.

use super::game::{Dice, Game};
use super::rules::Rules;
use rustc_hash::FxHashMap;

/// Steps of one walk.
const WALK: usize = 20_000;

/// The transitions of one of so many walks that ends in a dead marking, without what only led back to where it was.
pub(super) fn to_dead_marking(rules: &Rules, initial: &[u64], walks: u64) -> Option<Vec<u32>> {
    let mut game = Game::new(rules, initial);
    let mut dice = Dice::new(walks);
    for _ in 0..walks {
        let walk = walk(&mut game, &mut dice);
        if game.enabled.is_empty() {
            let mut ways = [without_loops(rules, &walk), walk].into_iter();
            return ways.find(|way| leads_to_dead_marking(rules, initial, way));
        }
        game.set(initial);
    }
    None
}

fn walk(game: &mut Game<'_>, dice: &mut Dice) -> Vec<u32> {
    let mut walk = Vec::new();
    while walk.len() < WALK && !game.enabled.is_empty() {
        let transition = game.enabled[dice.below(game.enabled.len())];
        if !game.fire(transition as usize) {
            break;
        }
        walk.push(transition);
    }
    walk
}

/// A walk without its loops. Markings are known by a sum over their tokens, and two might have the same.
fn without_loops(rules: &Rules, walk: &[u32]) -> Vec<u32> {
    let mut seen = FxHashMap::from_iter([(0_u64, 0_usize)]);
    let (mut sum, mut sums, mut short) = (0_u64, vec![0_u64], Vec::new());
    for transition in walk {
        for (place, change) in &rules.list[*transition as usize].change {
            sum = sum.wrapping_add(token(*place).wrapping_mul(*change as u64));
        }
        short.push(*transition);
        sums.push(sum);
        if let Some(before) = seen.get(&sum).copied() {
            sums.drain(before + 1..).for_each(|sum| {
                seen.remove(&sum);
            });
            seen.insert(sum, before);
            short.truncate(before);
        } else {
            seen.insert(sum, short.len());
        }
    }
    short
}

/// What a token in a place adds to the sum.
fn token(place: usize) -> u64 {
    let mixed = (place as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    (mixed ^ (mixed >> 29)).wrapping_mul(0xd6e8_feb8_6659_fd93) | 1
}

fn leads_to_dead_marking(rules: &Rules, initial: &[u64], walk: &[u32]) -> bool {
    let mut game = Game::new(rules, initial);
    let fires = |transition: &u32| game.enabled.contains(transition) && game.fire(*transition as usize);
    walk.iter().all(fires) && game.enabled.is_empty()
}
