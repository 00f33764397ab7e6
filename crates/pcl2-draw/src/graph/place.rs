//! The heights of items: for each layer in turn those that make the wires to its neighbours as straight as the order
//! and the distances of the layer allow, exactly (isotonic regression with weighted medians).

use super::sheet::{Grid, Kind};

/// Sweeps by one side, then sweeps by both.
const SWEEPS: usize = 6;
/// How much a straight wire is worth: between passes, at a pass, between blocks.
const WEIGHTS: [u32; 3] = [160, 48, 40];
/// How much it is worth not to move.
const REST: u32 = 1;

/// The top of each item in grid units, from 0 in each lane.
pub(crate) fn tops(grid: &Grid) -> Vec<i64> {
    let mut tops = vec![0; grid.items.len()];
    let lanes = grid.items.iter().map(|item| item.lane + 1).max().unwrap_or(0);
    let columns: Vec<Vec<Vec<usize>>> = grid.layers.iter().map(|layer| split(grid, layer, lanes)).collect();
    for column in columns.iter().flatten() {
        let apart = distances(grid, column);
        column.iter().zip(apart).for_each(|(item, top)| tops[*item] = top);
    }
    for sweep in 0..3 * SWEEPS {
        let sides = match (sweep < 2 * SWEEPS, sweep % 2) {
            (true, 0) => [true, false],
            (true, _) => [false, true],
            (false, _) => [true, true],
        };
        let forward = sweep % 2 == 0;
        for i in 0..columns.len() {
            let layer = if forward { i } else { columns.len() - 1 - i };
            for column in &columns[layer] {
                settle(grid, column, &mut tops, sides);
            }
        }
    }
    from_zero(grid, &mut tops, lanes);
    tops
}

/// A layer's items by lanes.
fn split(grid: &Grid, layer: &[usize], lanes: usize) -> Vec<Vec<usize>> {
    let mut split = vec![Vec::new(); lanes];
    for item in layer {
        split[grid.items[*item].lane].push(*item);
    }
    split
}

/// Tops of a column's items when they stand as close as may be.
fn distances(grid: &Grid, column: &[usize]) -> Vec<i64> {
    let mut tops = Vec::with_capacity(column.len());
    let mut before: Option<(i64, bool)> = None;
    for item in column {
        let item = &grid.items[*item];
        let is_node = matches!(item.kind, Kind::Node(_));
        let top = before.map_or(0, |(bottom, node)| bottom + 1 + i64::from(node) + i64::from(is_node));
        before = Some((top + item.height, is_node));
        tops.push(top);
    }
    tops
}

/// Moves a column's items to where their wires want them.
fn settle(grid: &Grid, column: &[usize], tops: &mut [i64], [by_left, by_right]: [bool; 2]) {
    let apart = distances(grid, column);
    let mut pools: Vec<Pool> = Vec::with_capacity(column.len());
    for (item, apart) in column.iter().zip(&apart) {
        let mut wishes = vec![(tops[*item] - apart, REST)];
        for joint in grid.items[*item].joints.iter().filter(|joint| if joint.left { by_right } else { by_left }) {
            let bundle = &grid.channels[joint.channel][joint.bundle];
            for (other, offset) in if joint.left { &bundle.right } else { &bundle.left } {
                if grid.items[*other].lane == grid.items[*item].lane {
                    let is_node = |item: usize| usize::from(matches!(grid.items[item].kind, Kind::Node(_)));
                    let weight = WEIGHTS[is_node(*item) + is_node(*other)];
                    wishes.push((tops[*other] + offset - joint.offset - apart, weight));
                }
            }
        }
        pools.push(Pool::new(wishes));
        while let [.., above, below] = pools.as_slice() {
            if above.top <= below.top {
                break;
            }
            let below = pools.pop();
            if let (Some(above), Some(below)) = (pools.last_mut(), below) {
                above.take(below);
            }
        }
    }
    let found = pools.iter().flat_map(|pool| std::iter::repeat_n(pool.top, pool.items));
    for ((item, apart), top) in column.iter().zip(apart).zip(found) {
        tops[*item] = top + apart;
    }
}

/// Items that touch: they move as one.
struct Pool {
    items: usize,
    /// Wished tops and how much they are worth, in order.
    wishes: Vec<(i64, u32)>,
    top: i64,
}

impl Pool {
    fn new(mut wishes: Vec<(i64, u32)>) -> Pool {
        wishes.sort_unstable();
        let top = median(&wishes);
        Pool { items: 1, wishes, top }
    }

    fn take(&mut self, other: Pool) {
        self.items += other.items;
        self.wishes.extend(other.wishes);
        self.wishes.sort_unstable();
        self.top = median(&self.wishes);
    }
}

/// The weighted median, the lower one of two.
fn median(wishes: &[(i64, u32)]) -> i64 {
    let total: u64 = wishes.iter().map(|(_, weight)| u64::from(*weight)).sum();
    let mut sum = 0;
    for (wish, weight) in wishes {
        sum += u64::from(*weight);
        if 2 * sum >= total {
            return *wish;
        }
    }
    0
}

fn from_zero(grid: &Grid, tops: &mut [i64], lanes: usize) {
    let mut least = vec![i64::MAX; lanes];
    for (item, top) in grid.items.iter().zip(tops.iter()) {
        least[item.lane] = least[item.lane].min(*top);
    }
    for (item, top) in grid.items.iter().zip(tops) {
        *top -= least[item.lane];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_are_weighted() {
        assert_eq!(median(&[(1, 1), (2, 1), (9, 1)]), 2);
        assert_eq!(median(&[(1, 1), (9, 3)]), 9);
        assert_eq!(median(&[(1, 1), (9, 1)]), 1);
    }
}
