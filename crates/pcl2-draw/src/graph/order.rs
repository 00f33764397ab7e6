//! The order of items within a layer: barycentres of their neighbours, swept to and fro a fixed number of times.

use super::sheet::{Bundle, Grid};

/// Sweeps in both directions.
const SWEEPS: usize = 12;
/// A channel with more pairs of pins is not counted through.
const PAIRS: usize = 2000;

/// Orders all layers; the best order seen wins, the first of equals.
pub(crate) fn arrange(grid: &mut Grid) {
    let mut best = (crossings(grid), grid.layers.clone());
    for _ in 0..SWEEPS {
        for layer in 0..grid.layers.len() {
            sort(grid, layer, true);
        }
        keep(grid, &mut best);
        for layer in (0..grid.layers.len()).rev() {
            sort(grid, layer, false);
        }
        keep(grid, &mut best);
        if best.0 == 0 {
            break;
        }
    }
    grid.layers = best.1;
}

fn keep(grid: &Grid, best: &mut (usize, Vec<Vec<usize>>)) {
    let found = crossings(grid);
    if found < best.0 {
        *best = (found, grid.layers.clone());
    }
}

/// The place of each item in its layer.
fn places(grid: &Grid) -> Vec<usize> {
    let mut places = vec![0; grid.items.len()];
    for layer in &grid.layers {
        for (place, item) in layer.iter().enumerate() {
            places[*item] = place;
        }
    }
    places
}

/// Sorts one layer by its neighbours on one side; items without any keep their places, lanes stay apart.
fn sort(grid: &mut Grid, layer: usize, by_left: bool) {
    let places = places(grid);
    let mut order = grid.layers[layer].clone();
    let key = |item: &usize| (grid.items[*item].lane, key(grid, &places, *item, by_left));
    let mut keyed: Vec<(usize, f64, usize)> = Vec::new();
    for item in &order {
        if let (lane, Some(key)) = key(item) {
            keyed.push((lane, key, *item));
        }
    }
    keyed.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut sorted = keyed.iter().map(|(.., item)| *item);
    for place in &mut order {
        if key(place).1.is_some() {
            *place = sorted.next().unwrap_or(*place);
        }
    }
    grid.layers[layer] = order;
}

/// The mean place of an item's neighbours on one side. A wire that turns round has its neighbour in its own layer.
fn key(grid: &Grid, places: &[usize], item: usize, by_left: bool) -> Option<f64> {
    let (mut sum, mut count) = (0.0, 0.0);
    let joints = || grid.items[item].joints.iter().filter(|joint| joint.left != by_left);
    for joint in joints() {
        let bundle = &grid.channels[joint.channel][joint.bundle];
        for (other, offset) in if joint.left { &bundle.right } else { &bundle.left } {
            sum += place(grid, places, *other, *offset);
            count += 1.0;
        }
    }
    if count > 0.0 {
        return Some(sum / count);
    }
    for joint in joints() {
        let bundle = &grid.channels[joint.channel][joint.bundle];
        let others = if joint.left { &bundle.left } else { &bundle.right };
        for (other, offset) in others.iter().filter(|(other, _)| *other != item) {
            sum += place(grid, places, *other, *offset) + 0.5;
            count += 1.0;
        }
    }
    (count > 0.0).then(|| sum / count)
}

/// A pin's place in units of places.
fn place(grid: &Grid, places: &[usize], item: usize, offset: i64) -> f64 {
    places[item] as f64 + (offset as f64 + 0.5) / (grid.items[item].height as f64 + 1.0)
}

fn crossings(grid: &Grid) -> usize {
    let places = places(grid);
    grid.channels.iter().map(|bundles| crossings_in(grid, &places, bundles)).sum()
}

/// Crossings of straight lines from each pin on the left to each on the right.
fn crossings_in(grid: &Grid, places: &[usize], bundles: &[Bundle]) -> usize {
    let mut lines: Vec<(f64, f64, usize)> = Vec::new();
    for bundle in bundles {
        for (left, left_offset) in &bundle.left {
            for (right, right_offset) in &bundle.right {
                let line = (*left, *left_offset, *right, *right_offset);
                lines.push((place(grid, places, line.0, line.1), place(grid, places, line.2, line.3), bundle.net));
            }
        }
    }
    lines.truncate(PAIRS);
    let mut count = 0;
    for (i, a) in lines.iter().enumerate() {
        for b in lines[i + 1..].iter().filter(|b| b.2 != a.2) {
            count += usize::from((a.0 < b.0 && a.1 > b.1) || (a.0 > b.0 && a.1 < b.1));
        }
    }
    count
}
