//! Wires in the channel between two layers: each net runs along a vertical track of its own.
//!
//! A pin of one net may stand opposite a pin of another. Then the track of the net on the left must lie left of the
//! other's, or the two would share a piece. Where such wishes go in a circle, a net takes two tracks with a short
//! piece between them, at a height that no pin has.

use super::sheet::{Bundle, GRID, Wire};

/// The tracks of a channel.
pub(crate) struct Routed {
    tracks: usize,
    pub(crate) nets: Vec<Lines>,
}

/// A net's run through a channel.
pub(crate) struct Lines {
    /// The net's place in its sheet.
    pub(crate) net: usize,
    left: Vec<i32>,
    right: Vec<i32>,
    run: Run,
}

enum Run {
    /// All pins have one height.
    Straight,
    /// One track.
    Track(usize),
    /// A track for the left pins, one for the right pins, and the height where they join.
    Two(usize, usize, i32),
}

impl Routed {
    /// How many tracks there are.
    pub(crate) fn width(&self) -> i32 {
        i32::try_from(self.tracks).unwrap_or(i32::MAX / GRID)
    }
}

/// A vertical piece before it has a track.
struct Trunk {
    /// Index into the channel's bundles.
    bundle: usize,
    left: Vec<i32>,
    right: Vec<i32>,
    /// The pins whose wishes count: those on the left, those on the right.
    sides: (bool, bool),
}

impl Trunk {
    fn ends(&self) -> (i32, i32) {
        let heights = || self.left.iter().chain(&self.right).copied();
        (heights().min().unwrap_or(0), heights().max().unwrap_or(0))
    }

    fn overlaps(&self, other: &Trunk) -> bool {
        let ((a, b), (c, d)) = (self.ends(), other.ends());
        a <= d && c <= b
    }

    /// Crossings when this trunk lies left of the other.
    fn crossings(&self, other: &Trunk) -> usize {
        let inside = |heights: &[i32], (top, bottom): (i32, i32)| {
            heights.iter().filter(|height| top < **height && **height < bottom).count()
        };
        inside(&self.right, other.ends()) + inside(&other.left, self.ends())
    }

    /// Whether this trunk must lie left of the other.
    fn precedes(&self, other: &Trunk) -> bool {
        if self.bundle == other.bundle {
            return self.sides.0 && !other.sides.0;
        }
        self.sides.0 && other.sides.1 && self.left.iter().any(|height| other.right.contains(height))
    }
}

/// Finds tracks for all nets of a channel, given the tops of all items in pixels.
pub(crate) fn channel(bundles: &[Bundle], tops: &[i32]) -> Routed {
    let heights = |pins: &[(usize, i64)]| {
        let mut heights: Vec<i32> =
            pins.iter().map(|(item, offset)| tops[*item] + i32::try_from(*offset).unwrap_or(0) * GRID).collect();
        heights.sort_unstable();
        heights.dedup();
        heights
    };
    let mut nets: Vec<Lines> = bundles
        .iter()
        .map(|bundle| Lines {
            net: bundle.net,
            left: heights(&bundle.left),
            right: heights(&bundle.right),
            run: Run::Straight,
        })
        .collect();
    let mut trunks: Vec<Trunk> = Vec::new();
    for (bundle, lines) in nets.iter().enumerate() {
        let trunk = Trunk { bundle, left: lines.left.clone(), right: lines.right.clone(), sides: (true, true) };
        let (top, bottom) = trunk.ends();
        if top < bottom {
            trunks.push(trunk);
        }
    }
    let (ordered, joints) = order(trunks);
    let tracks = assign(&ordered);
    for (trunk, track) in ordered.iter().zip(&tracks) {
        let lines = &mut nets[trunk.bundle];
        let joint = joints.iter().find(|(bundle, _)| *bundle == trunk.bundle);
        lines.run = match (&lines.run, joint) {
            (Run::Track(first), Some((_, height))) => Run::Two(*first, *track, *height),
            _ => Run::Track(*track),
        };
    }
    Routed { tracks: tracks.iter().map(|track| track + 1).max().unwrap_or(0), nets }
}

/// Trunks from left to right, those that may go first with the fewest crossings first; and the nets cut in two with
/// the heights of their cuts.
fn order(mut waiting: Vec<Trunk>) -> (Vec<Trunk>, Vec<(usize, i32)>) {
    let mut ordered: Vec<Trunk> = Vec::new();
    let mut cuts: Vec<(usize, i32)> = Vec::new();
    let mut table = Table::new(&waiting);
    while !waiting.is_empty() {
        match table.next() {
            Some(next) => {
                ordered.push(waiting.remove(next));
                table.remove(next);
            }
            None => {
                cut(&mut waiting, &mut cuts);
                table = Table::new(&waiting);
            }
        }
    }
    (ordered, cuts)
}

/// What putting one trunk left of another costs, for all that wait.
struct Table {
    /// How many more crossings if the first index goes before the second.
    costs: Vec<Vec<i64>>,
    /// Whether the first index must go before the second.
    precedes: Vec<Vec<bool>>,
    /// Sums of `costs` over the second index.
    sums: Vec<i64>,
    /// How many must go before.
    blockers: Vec<usize>,
}

impl Table {
    fn new(trunks: &[Trunk]) -> Table {
        let count = |crossings: usize| i64::try_from(crossings).unwrap_or(0);
        let cost = |a: &Trunk, b: &Trunk| match a.bundle == b.bundle {
            true => 0,
            false => count(a.crossings(b)) - count(b.crossings(a)),
        };
        let costs: Vec<Vec<i64>> = trunks.iter().map(|a| trunks.iter().map(|b| cost(a, b)).collect()).collect();
        let precedes: Vec<Vec<bool>> = trunks.iter().map(|a| trunks.iter().map(|b| a.precedes(b)).collect()).collect();
        let sums = costs.iter().map(|row| row.iter().sum()).collect();
        let blockers = (0..trunks.len()).map(|i| precedes.iter().filter(|row| row[i]).count()).collect();
        Table { costs, precedes, sums, blockers }
    }

    /// The trunk that nothing must precede and that costs least, the first of equals.
    fn next(&self) -> Option<usize> {
        let free = (0..self.sums.len()).filter(|i| self.blockers[*i] == 0);
        free.min_by_key(|i| self.sums[*i])
    }

    fn remove(&mut self, gone: usize) {
        let precedes = self.precedes.remove(gone);
        self.costs.remove(gone);
        self.sums.remove(gone);
        self.blockers.remove(gone);
        for row in &mut self.precedes {
            row.remove(gone);
        }
        for (sum, row) in self.sums.iter_mut().zip(&mut self.costs) {
            *sum -= row.remove(gone);
        }
        let others = precedes.into_iter().enumerate().filter(|(i, _)| *i != gone).map(|(_, precedes)| precedes);
        for (blockers, precedes) in self.blockers.iter_mut().zip(others) {
            *blockers -= usize::from(precedes);
        }
    }
}

/// Cuts the first trunk that is not cut yet; its left part then waits for nobody.
fn cut(waiting: &mut Vec<Trunk>, cuts: &mut Vec<(usize, i32)>) {
    let Some(at) = waiting.iter().position(|trunk| trunk.sides == (true, true)) else {
        // Left parts wait for nobody and right parts for left ones alone: one of them was free.
        if let Some(trunk) = waiting.first_mut() {
            trunk.sides = (false, false);
        }
        return;
    };
    let whole = waiting.remove(at);
    let mut height = whole.ends().0 + GRID / 2;
    while cuts.iter().any(|(_, taken)| *taken == height) {
        height += GRID;
    }
    cuts.push((whole.bundle, height));
    let right = Trunk { bundle: whole.bundle, left: vec![height], right: whole.right, sides: (false, true) };
    let left = Trunk { bundle: whole.bundle, left: whole.left, right: vec![height], sides: (true, false) };
    waiting.insert(at, right);
    waiting.insert(at, left);
}

/// The leftmost track right of all earlier trunks that overlap.
fn assign(ordered: &[Trunk]) -> Vec<usize> {
    let mut tracks: Vec<usize> = Vec::with_capacity(ordered.len());
    for (i, trunk) in ordered.iter().enumerate() {
        let earlier = ordered[..i].iter().zip(&tracks).filter(|(other, _)| other.overlaps(trunk));
        tracks.push(earlier.map(|(_, track)| track + 1).max().unwrap_or(0));
    }
    tracks
}

impl Lines {
    /// Adds the pieces between the channel's ends, and dots where the net branches.
    pub(crate) fn put(&self, wire: &mut Wire, (left, right): (i32, i32), x: impl Fn(usize) -> i32) {
        match self.run {
            Run::Straight => {
                let height = self.left.first().or(self.right.first());
                if let (Some(height), false, false) = (height, self.left.is_empty(), self.right.is_empty()) {
                    wire.line((left, *height), (right, *height));
                }
            }
            Run::Track(track) => trunk(wire, x(track), (left, &self.left), (right, &self.right)),
            Run::Two(first, second, height) => {
                trunk(wire, x(first), (left, &self.left), (x(second), &[height]));
                trunk(wire, x(second), (x(second), &[height]), (right, &self.right));
            }
        }
    }
}

fn trunk(wire: &mut Wire, x: i32, (left, lefts): (i32, &[i32]), (right, rights): (i32, &[i32])) {
    let heights = || lefts.iter().chain(rights).copied();
    let (top, bottom) = (heights().min().unwrap_or(0), heights().max().unwrap_or(0));
    lefts.iter().for_each(|height| wire.line((left, *height), (x, *height)));
    wire.line((x, top), (x, bottom));
    rights.iter().for_each(|height| wire.line((x, *height), (right, *height)));
    let mut all: Vec<i32> = heights().collect();
    all.sort_unstable();
    for (i, height) in all.iter().enumerate() {
        let ends = *height == top || *height == bottom;
        let twice = all.get(i + 1) == Some(height);
        if twice || (!ends && all.get(i.wrapping_sub(1)) != Some(height)) {
            wire.dots.push((x, *height));
        }
    }
}
