//! The places of everything on a sheet: layers from top to bottom, lines in the channels between them.
//!
//! Block diagrams run from left to right: what is a height there is a width here.

use super::model::{Arc, ArcKind, Graph};
use super::sheets::Sheet;
use super::symbol;
use crate::graph::sheet::{Bundle, End, GRID, Grid, Item, Joint, Kind, Segment, Wire};
use crate::graph::{order, place, route};
use std::cmp::Reverse;

/// Between a channel's outer tracks and the layers beside it: heads and weights of arcs stand here.
const MARGIN: i32 = 16;
/// The grid units from a symbol's middle to its ends, at least.
const HALF: i64 = 2;

/// A node with its place.
pub(crate) struct Placed {
    pub(crate) node: usize,
    /// The symbol's left end.
    pub(crate) x: i32,
    /// Its middle.
    pub(crate) y: i32,
    pub(crate) width: i32,
}

/// An arc with its way, from the box or gate that is above or that tokens leave.
pub(crate) struct Line {
    pub(crate) arc: Arc,
    /// The way ends at the gate; else it begins there.
    pub(crate) to_gate: bool,
    pub(crate) points: Vec<(i32, i32)>,
}

/// A sheet with all places known.
pub(crate) struct Drawn {
    pub(crate) width: i32,
    pub(crate) height: i32,
    pub(crate) nodes: Vec<Placed>,
    pub(crate) lines: Vec<Line>,
}

/// A sheet with more nodes is laid out once only.
const TWICE: usize = 400;

/// Lays a sheet out. Where tokens come back, on the left or on the right, is tried: the way with the shorter lines wins.
pub(crate) fn draw(graph: &Graph, sheet: &Sheet) -> Drawn {
    let right = draw_with(graph, sheet, false);
    if sheet.nodes.len() > TWICE {
        return right;
    }
    let left = draw_with(graph, sheet, true);
    if left.cost() < right.cost() { left } else { right }
}

impl Drawn {
    /// What its lines and its width take.
    fn cost(&self) -> i64 {
        let length = |[a, b]: &[(i32, i32); 2]| i64::from((a.0 - b.0).abs() + (a.1 - b.1).abs());
        let line = |line: &Line| line.points.windows(2).map(|pair| length(&[pair[0], pair[1]])).sum::<i64>();
        self.lines.iter().map(line).sum::<i64>() + 4 * i64::from(self.width)
    }
}

/// Lays a sheet out from an order in which lines that pass a layer stand left, or right, of its nodes.
fn draw_with(graph: &Graph, sheet: &Sheet, left: bool) -> Drawn {
    let mut grid = grid(graph, sheet);
    if left {
        let is_node = |item: &usize| matches!(grid.items[*item].kind, Kind::Node(_));
        grid.layers.iter_mut().for_each(|layer| layer.sort_by_key(is_node));
    }
    order::arrange(&mut grid);
    let halves = put_pins(graph, sheet, &mut grid);
    let across: Vec<i32> = place::tops(&grid).into_iter().map(pixels).collect();
    let channels: Vec<route::Routed> = grid.channels.iter().map(|bundles| route::channel(bundles, &across)).collect();
    let mut rows: Vec<Row> = Vec::new();
    let mut y = 0;
    for (layer, items) in grid.layers.iter().enumerate() {
        y += channel_height(&grid.channels[layer], channels[layer].width());
        let row = Row::new(graph, sheet, &grid, items, y);
        y = row.bottom;
        rows.push(row);
    }
    let height = y + channels.last().map_or(0, |last| channel_height(&grid.channels[rows.len()], last.width()));
    let width = grid.items.iter().zip(&across).map(|(item, x)| x + pixels(item.height)).max().unwrap_or(0);
    let nodes = nodes(graph, sheet, &grid, &across, &halves, &rows);
    let mut ways = ways(sheet, &channels, &rows, height);
    ends(graph, &grid, &across, &rows, &nodes, &mut ways);
    let to_gate = |arc: &Arc| direction(sheet, arc).is_some_and(|(_, to)| sheet.nodes[to] == arc.gate);
    let line = |(arc, way): (&Arc, Way)| Line { arc: *arc, to_gate: to_gate(arc), points: way.points() };
    let lines = sheet.arcs.iter().zip(ways).map(line);
    Drawn { width, height, lines: lines.collect(), nodes }
}

fn pixels(units: i64) -> i32 {
    i32::try_from(units).unwrap_or(i32::MAX / 64).saturating_mul(GRID)
}

/// Nodes and arcs of a sheet; all pins in the middle of their symbols.
fn grid(graph: &Graph, sheet: &Sheet) -> Grid {
    let mut grid = Grid::new(sheet.layers.iter().max().map_or(0, |last| last + 1));
    for (i, node) in sheet.nodes.iter().enumerate() {
        let node = &graph.nodes[*node];
        let height = symbol::before(node) + 2 * HALF + symbol::after(node);
        grid.add(Item { kind: Kind::Node(i), layer: sheet.layers[i], lane: 0, height, joints: Vec::new() });
    }
    for (i, arc) in sheet.arcs.iter().enumerate() {
        let Some((from, to)) = direction(sheet, arc) else {
            continue;
        };
        let offset = |node: usize| symbol::before(&graph.nodes[sheet.nodes[node]]) + HALF;
        let layer = |node: usize| sheet.layers[node];
        grid.connect(
            i,
            0,
            &[
                End { item: from, channel: layer(from) + 1, left: true, offset: offset(from) },
                End { item: to, channel: layer(to), left: false, offset: offset(to) },
            ],
        );
    }
    grid
}

/// From which node to which an arc is drawn: as tokens move, else downwards.
fn direction(sheet: &Sheet, arc: &Arc) -> Option<(usize, usize)> {
    let (place, gate) = (sheet.local(arc.place)?, sheet.local(arc.gate)?);
    let down = match arc.kind {
        ArcKind::Take => true,
        ArcKind::Put => false,
        ArcKind::Read | ArcKind::Inhibit => sheet.layers[place] < sheet.layers[gate],
    };
    Some(if down { (place, gate) } else { (gate, place) })
}

/// Gives each arc a pin of its own, in the order of what it leads to. Half the width of each node's symbol, in grid
/// units.
fn put_pins(graph: &Graph, sheet: &Sheet, grid: &mut Grid) -> Vec<i64> {
    let mut places = vec![0; grid.items.len()];
    for layer in &grid.layers {
        for (place, item) in layer.iter().enumerate() {
            places[*item] = place;
        }
    }
    let mut halves = Vec::with_capacity(sheet.nodes.len());
    for node in 0..sheet.nodes.len() {
        let sides = [true, false].map(|left| pins(sheet, grid, &places, node, left));
        let half = sides.iter().map(|pins| half(pins)).max().unwrap_or(HALF);
        let before = symbol::before(&graph.nodes[sheet.nodes[node]]);
        for pins in &sides {
            for (joint, at) in slots(pins, half) {
                move_pin(grid, node, joint, before + half + at);
            }
        }
        grid.items[node].height += 2 * (half - HALF);
        halves.push(half);
    }
    halves
}

/// A pin of a node.
struct Pin {
    /// Index into the item's joints.
    joint: usize,
    /// Grid units that it takes.
    room: i64,
    /// Where the arc leads, as a key for the order from left to right.
    key: (u8, Reverse<usize>, usize),
    /// The arc goes on in the direction of the layers, and tokens move on it.
    straight: bool,
    arc: usize,
}

/// The pins on one side of a node, from left to right.
fn pins(sheet: &Sheet, grid: &Grid, places: &[usize], node: usize, left: bool) -> Vec<Pin> {
    let joints = grid.items[node].joints.iter().enumerate().filter(|(_, joint)| joint.left == left);
    let mut pins: Vec<Pin> = joints.map(|(i, joint)| pin(sheet, grid, places, node, (i, joint))).collect();
    pins.sort_by_key(|pin| (pin.key, pin.arc));
    pins
}

fn pin(sheet: &Sheet, grid: &Grid, places: &[usize], node: usize, (index, joint): (usize, &Joint)) -> Pin {
    let bundle = &grid.channels[joint.channel][joint.bundle];
    let (own, beyond) = if joint.left { (&bundle.left, &bundle.right) } else { (&bundle.right, &bundle.left) };
    let arc = &sheet.arcs[bundle.net];
    // An arc that turns round ends in the layer that it began in: of two, the one that turns near is the outer one.
    let key = match (beyond.first(), own.iter().find(|(other, _)| *other != node)) {
        (Some((other, _)), _) => (1, Reverse(0), places[*other]),
        (None, Some((other, _))) if places[*other] < places[node] => (0, Reverse(places[*other]), 0),
        (None, Some((other, _))) => (2, Reverse(places[*other]), 0),
        (None, None) => (1, Reverse(0), 0),
    };
    let room = if arc.weight == 1 { 1 } else { 1 + (arc.weight.ilog10() as i64 + 2) / 2 };
    Pin { joint: index, room, key, straight: key.0 == 1 && arc.kind.moves(), arc: bundle.net }
}

/// How far pins reach from the first to the last.
fn span(pins: &[Pin]) -> i64 {
    pins.iter().rev().skip(1).map(|pin| pin.room).sum()
}

fn half(pins: &[Pin]) -> i64 {
    HALF.max((span(pins) + 1) / 2 + 1)
}

/// Places of pins from the symbol's middle: the arc that goes straight on stands there if it can.
fn slots(pins: &[Pin], half: i64) -> Vec<(usize, i64)> {
    let mut at = 0;
    let mut slots = Vec::with_capacity(pins.len());
    for pin in pins {
        slots.push((pin.joint, at));
        at += pin.room;
    }
    let main = (0..pins.len()).filter(|i| pins[*i].straight).min_by_key(|i| pins[*i].arc);
    let middle = main.map_or(span(pins) / 2, |main| slots[main].1);
    let first = (-middle).max(1 - half).min(half - 1 - span(pins)).max(1 - half);
    slots.into_iter().map(|(joint, at)| (joint, at + first)).collect()
}

fn move_pin(grid: &mut Grid, node: usize, joint: usize, offset: i64) {
    let joint = &mut grid.items[node].joints[joint];
    joint.offset = offset;
    let bundle = &mut grid.channels[joint.channel][joint.bundle];
    let side = if joint.left { &mut bundle.left } else { &mut bundle.right };
    side.iter_mut().filter(|(item, _)| *item == node).for_each(|(_, own)| *own = offset);
}

/// A layer's place.
struct Row {
    top: i32,
    middle: i32,
    bottom: i32,
}

impl Row {
    fn new(graph: &Graph, sheet: &Sheet, grid: &Grid, items: &[usize], top: i32) -> Row {
        let extent = |item: &usize| match grid.items[*item].kind {
            Kind::Node(node) => symbol::extent(&graph.nodes[sheet.nodes[node]]),
            Kind::Pass(_) => 0,
        };
        let half = items.iter().map(extent).max().unwrap_or(0);
        Row { top, middle: top + half, bottom: top + 2 * half }
    }
}

fn channel_height(bundles: &[Bundle], tracks: i32) -> i32 {
    if bundles.is_empty() { 0 } else { 2 * MARGIN + (tracks - 1).max(0) * GRID }
}

fn nodes(graph: &Graph, sheet: &Sheet, grid: &Grid, across: &[i32], halves: &[i64], rows: &[Row]) -> Vec<Placed> {
    let place = |(i, node): (usize, &usize)| Placed {
        node: *node,
        x: across[i] + pixels(symbol::before(&graph.nodes[*node])),
        y: rows[grid.items[i].layer].middle,
        width: pixels(2 * halves[i]),
    };
    sheet.nodes.iter().enumerate().map(place).collect()
}

/// An arc on the way to be a line. The first coordinate runs down.
struct Way {
    start: (i32, i32),
    wire: Wire,
}

impl Way {
    /// The corners from the start to the end, as x and y.
    fn points(mut self) -> Vec<(i32, i32)> {
        let mut points = vec![self.start];
        let mut at = self.start;
        while let Some(i) = self.wire.segments.iter().position(|piece| piece.from == at || piece.to == at) {
            let Segment { from, to } = self.wire.segments.swap_remove(i);
            at = if from == at { to } else { from };
            let straight = |a: (i32, i32), b: (i32, i32)| (a.0 == b.0 && b.0 == at.0) || (a.1 == b.1 && b.1 == at.1);
            if let [.., before, last] = points.as_mut_slice() {
                if straight(*before, *last) {
                    *last = at;
                    continue;
                }
            }
            points.push(at);
        }
        points.into_iter().map(|(down, across)| (across, down)).collect()
    }
}

/// The pieces of arcs in channels.
fn ways(sheet: &Sheet, channels: &[route::Routed], rows: &[Row], height: i32) -> Vec<Way> {
    let way = |net| Way { start: (0, 0), wire: Wire { net, segments: Vec::new(), dots: Vec::new() } };
    let mut ways: Vec<Way> = (0..sheet.arcs.len()).map(way).collect();
    for (index, routed) in channels.iter().enumerate() {
        let top = index.checked_sub(1).map_or(0, |layer| rows[layer].bottom);
        let bottom = rows.get(index).map_or(height, |row| row.top);
        let first = top + (bottom - top - (routed.width() - 1).max(0) * GRID) / 2;
        for lines in &routed.nets {
            lines.put(&mut ways[lines.net].wire, (top, bottom), |track| first + symbol::count(track) * GRID);
        }
    }
    ways
}

/// The pieces from layers' edges to symbols, and past layers.
fn ends(graph: &Graph, grid: &Grid, across: &[i32], rows: &[Row], nodes: &[Placed], ways: &mut [Way]) {
    for (item, start) in grid.items.iter().zip(across) {
        let row = &rows[item.layer];
        let node = match item.kind {
            Kind::Pass(net) => {
                ways[net].wire.line((row.top, *start), (row.bottom, *start));
                continue;
            }
            Kind::Node(node) => &nodes[node],
        };
        for joint in &item.joints {
            let x = start + pixels(joint.offset);
            let reach = symbol::reach(&graph.nodes[node.node], node.width, x - node.x);
            let way = &mut ways[grid.channels[joint.channel][joint.bundle].net];
            if joint.left {
                way.start = (row.middle + reach, x);
                way.wire.line(way.start, (row.bottom, x));
            } else {
                way.wire.line((row.top, x), (row.middle - reach, x));
            }
        }
    }
}
