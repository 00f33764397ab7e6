//! One sheet: layers of items, channels of wires between them, and what becomes of both.

use super::netlist::{Netlist, PinAt, Side};
use super::render::shape;
use super::sheets::Sheet;
use super::{order, place, route};

/// The grid that boxes, pins and wires stand on, in pixels.
pub(crate) const GRID: i32 = 10;
/// Between a channel's outer tracks and the layers beside it.
const MARGIN: i32 = 14;
/// Around the blocks of a layer: frames run here.
pub(crate) const PAD: i32 = 14;

/// What stands in a layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A block: its place in [`Sheet::nodes`].
    Node(usize),
    /// A wire that passes by: its place in [`Sheet::nets`].
    Pass(usize),
}

/// Something with a place in a layer.
pub(crate) struct Item {
    pub(crate) kind: Kind,
    pub(crate) layer: usize,
    /// Even: a section. Odd: between two sections.
    pub(crate) lane: usize,
    /// In grid units.
    pub(crate) height: i64,
    pub(crate) joints: Vec<Joint>,
}

/// Where an item meets a net of a channel.
#[derive(Clone, Copy)]
pub(crate) struct Joint {
    pub(crate) channel: usize,
    /// Index into the channel's bundles.
    pub(crate) bundle: usize,
    /// The item stands left of the channel.
    pub(crate) left: bool,
    /// Below the item's top, in grid units.
    pub(crate) offset: i64,
}

/// An end of a net: as [`Joint`], and the item.
pub(crate) struct End {
    pub(crate) item: usize,
    pub(crate) channel: usize,
    pub(crate) left: bool,
    pub(crate) offset: i64,
}

/// A net in a channel: items and offsets on both sides.
#[derive(Default)]
pub(crate) struct Bundle {
    pub(crate) net: usize,
    pub(crate) left: Vec<(usize, i64)>,
    pub(crate) right: Vec<(usize, i64)>,
}

/// A sheet's items. Channel c lies left of layer c, the last one right of the last layer.
pub(crate) struct Grid {
    pub(crate) items: Vec<Item>,
    /// The items of each layer from top to bottom.
    pub(crate) layers: Vec<Vec<usize>>,
    pub(crate) channels: Vec<Vec<Bundle>>,
}

/// A block with its place.
pub(crate) struct Placed {
    pub(crate) node: usize,
    pub(crate) x: i32,
    pub(crate) y: i32,
    pub(crate) width: i32,
}

/// A straight piece of wire.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Segment {
    pub(crate) from: (i32, i32),
    pub(crate) to: (i32, i32),
}

/// A net's wires.
pub(crate) struct Wire {
    pub(crate) net: usize,
    pub(crate) segments: Vec<Segment>,
    /// Where it branches.
    pub(crate) dots: Vec<(i32, i32)>,
}

/// A lane with blocks in it.
pub(crate) struct Frame {
    pub(crate) section: usize,
    pub(crate) x: i32,
    pub(crate) y: i32,
    pub(crate) width: i32,
    pub(crate) height: i32,
}

/// A sheet with all places known.
pub(crate) struct Drawn {
    pub(crate) width: i32,
    pub(crate) height: i32,
    pub(crate) nodes: Vec<Placed>,
    pub(crate) wires: Vec<Wire>,
    pub(crate) frames: Vec<Frame>,
}

/// Lays a sheet out. With titles, given as their widths, lanes are framed.
pub(crate) fn draw(list: &Netlist, sheet: &Sheet, titles: Option<&[i32]>) -> Drawn {
    let mut grid = grid(list, sheet);
    order::arrange(&mut grid);
    let (tops, frames, height) = stack(&grid, &place::tops(&grid), titles.is_some());
    let routed: Vec<route::Routed> = grid.channels.iter().map(|bundles| route::channel(bundles, &tops)).collect();
    let columns = columns(list, sheet, &grid, &routed, titles.unwrap_or(&[]));
    let last = columns.last().map_or(0, |column| column.right());
    let nodes = nodes(sheet, &grid, &tops, &columns);
    let frames = frames.into_iter().map(|(section, y, height)| {
        let (first, last) = grid.span(section * 2);
        let x = columns[first].x - PAD / 2;
        Frame { section, x, y, width: columns[last].right() + PAD / 2 - x, height }
    });
    let frames = frames.collect();
    let wires = wires(list, sheet, &grid, &tops, &columns, &routed);
    let tail = grid.channels.last().zip(routed.last()).map_or(0, |(bundles, routed)| channel_width(bundles, routed));
    Drawn { width: last + tail, height, nodes, wires, frames }
}

/// Items and channels of a sheet, in order of execution.
fn grid(list: &Netlist, sheet: &Sheet) -> Grid {
    let count = sheet.layers.iter().max().map_or(0, |last| last + 1);
    let mut grid = Grid::new(count);
    for (i, node) in sheet.nodes.iter().enumerate() {
        let height = i64::from(shape::height(&list.nodes[*node]) / GRID);
        grid.add(Item {
            kind: Kind::Node(i),
            layer: sheet.layers[i],
            lane: sheet.lanes[i] * 2,
            height,
            joints: vec![],
        });
    }
    for (i, net) in sheet.nets.iter().enumerate() {
        grid.net(list, sheet, i, *net);
    }
    grid.sort_by_lane();
    grid
}

impl Grid {
    /// So many empty layers.
    pub(crate) fn new(layers: usize) -> Grid {
        let channels = (0..=layers).map(|_| Vec::new()).collect();
        Grid { items: Vec::new(), layers: vec![Vec::new(); layers], channels }
    }

    /// Adds an item to its layer.
    pub(crate) fn add(&mut self, item: Item) -> usize {
        self.layers[item.layer].push(self.items.len());
        self.items.push(item);
        self.items.len() - 1
    }

    fn net(&mut self, list: &Netlist, sheet: &Sheet, index: usize, net: usize) {
        let pins = std::iter::once(list.nets[net].source).chain(list.wired(net));
        let end = |at: PinAt| {
            let item = sheet.nodes.binary_search(&at.node).ok()?;
            let left = list.pin(at).side == Side::Right;
            let channel = sheet.layers[item] + usize::from(left);
            Some(End { item, channel, left, offset: i64::from(shape::pin_y(list.pin(at)) / GRID) })
        };
        let ends: Vec<End> = pins.filter_map(end).collect();
        let lanes = ends.iter().map(|end| sheet.lanes[end.item] * 2);
        let (top, bottom) = (lanes.clone().min().unwrap_or(0), lanes.max().unwrap_or(0));
        self.connect(index, if top == bottom { top } else { top + 1 }, &ends);
    }

    /// A net takes part in each channel from its first end's to its last end's, and passes the layers between.
    pub(crate) fn connect(&mut self, net: usize, lane: usize, ends: &[End]) {
        let first = ends.iter().map(|end| end.channel).min().unwrap_or(0);
        let last = ends.iter().map(|end| end.channel).max().unwrap_or(0);
        for channel in first..=last {
            self.channels[channel].push(Bundle { net, ..Bundle::default() });
        }
        for end in ends {
            self.join(end.item, end.channel, end.left, end.offset);
        }
        for layer in first..last {
            let item = self.add(Item { kind: Kind::Pass(net), layer, lane, height: 0, joints: vec![] });
            self.join(item, layer, false, 0);
            self.join(item, layer + 1, true, 0);
        }
    }

    /// Joins an item to the channel's newest bundle.
    fn join(&mut self, item: usize, channel: usize, left: bool, offset: i64) {
        let Some(bundle) = self.channels[channel].len().checked_sub(1) else {
            return;
        };
        let side = &mut self.channels[channel][bundle];
        if left {
            side.left.push((item, offset))
        } else {
            side.right.push((item, offset))
        }
        self.items[item].joints.push(Joint { channel, bundle, left, offset });
    }

    /// The first and the last layer of a lane's blocks.
    fn span(&self, lane: usize) -> (usize, usize) {
        let own = self.items.iter().filter(|item| item.lane == lane && matches!(item.kind, Kind::Node(_)));
        let layers = own.map(|item| item.layer);
        (layers.clone().min().unwrap_or(0), layers.max().unwrap_or(0))
    }

    fn sort_by_lane(&mut self) {
        for layer in &mut self.layers {
            layer.sort_by_key(|item| self.items[*item].lane);
        }
    }
}

/// Puts lanes one below the other: tops of items in pixels, section, top and height of each frame, the whole height.
fn stack(grid: &Grid, tops: &[i64], framed: bool) -> (Vec<i32>, Vec<(usize, i32, i32)>, i32) {
    let lanes = grid.items.iter().map(|item| item.lane + 1).max().unwrap_or(0);
    let mut heights: Vec<Option<i64>> = vec![None; lanes];
    for (item, top) in grid.items.iter().zip(tops) {
        let bottom = top + item.height;
        heights[item.lane] = Some(heights[item.lane].unwrap_or(0).max(bottom));
    }
    let (mut starts, mut frames, mut y) = (vec![0; lanes], Vec::new(), 0);
    for (lane, height) in heights.iter().enumerate() {
        let height = height.map(|height| i32::try_from(height).unwrap_or(i32::MAX / 64) * GRID);
        match height {
            None => starts[lane] = y,
            Some(height) if lane % 2 == 1 => {
                starts[lane] = y;
                y += height + 2 * GRID;
            }
            Some(height) if framed => {
                starts[lane] = y + 4 * GRID;
                frames.push((lane / 2, y, height + 6 * GRID));
                y += height + 8 * GRID;
            }
            Some(height) => {
                starts[lane] = y;
                y += height;
            }
        }
    }
    let tops = grid.items.iter().zip(tops);
    let tops =
        tops.map(|(item, top)| starts[item.lane] + i32::try_from(*top).unwrap_or(i32::MAX / 64) * GRID).collect();
    (tops, frames, y)
}

/// A layer's place: left end, room for notes left of the boxes, their width, room right of them.
struct Column {
    x: i32,
    before: i32,
    width: i32,
    after: i32,
}

impl Column {
    fn right(&self) -> i32 {
        self.x + self.before + self.width + self.after
    }
}

/// The width of a channel; the outer ones of a sheet may be empty.
fn channel_width(bundles: &[Bundle], routed: &route::Routed) -> i32 {
    if bundles.is_empty() { PAD } else { PAD + 2 * MARGIN + (routed.width() - 1).max(0) * GRID }
}

/// Columns from left to right; the last one of a lane makes room for the lane's title.
fn columns(list: &Netlist, sheet: &Sheet, grid: &Grid, routed: &[route::Routed], titles: &[i32]) -> Vec<Column> {
    let spans: Vec<(usize, usize)> = (0..titles.len()).map(|section| grid.span(section * 2)).collect();
    let mut columns: Vec<Column> = Vec::new();
    let mut x = 0;
    for (layer, items) in grid.layers.iter().enumerate() {
        x += channel_width(&grid.channels[layer], &routed[layer]);
        let mut column = Column { x, before: 0, width: 0, after: 0 };
        for item in items {
            if let Kind::Node(node) = grid.items[*item].kind {
                let node = sheet.nodes[node];
                column.before = column.before.max(shape::before(list, node));
                column.width = column.width.max(shape::width(list, node));
                column.after = column.after.max(shape::after(list, node));
            }
        }
        for ((first, _), title) in spans.iter().zip(titles).filter(|((_, last), _)| *last == layer) {
            let left = columns.get(*first).map_or(column.x, |first| first.x);
            column.after += (title - PAD - (column.right() - left)).max(0);
        }
        x = column.right();
        columns.push(column);
    }
    columns
}

fn nodes(sheet: &Sheet, grid: &Grid, tops: &[i32], columns: &[Column]) -> Vec<Placed> {
    let mut nodes = Vec::new();
    for (item, top) in grid.items.iter().zip(tops) {
        if let Kind::Node(node) = item.kind {
            let column = &columns[item.layer];
            nodes.push(Placed { node: sheet.nodes[node], x: column.x + column.before, y: *top, width: column.width });
        }
    }
    nodes
}

fn wires(
    list: &Netlist,
    sheet: &Sheet,
    grid: &Grid,
    tops: &[i32],
    columns: &[Column],
    routed: &[route::Routed],
) -> Vec<Wire> {
    let wire = |net: &usize| Wire { net: *net, segments: Vec::new(), dots: Vec::new() };
    let mut wires: Vec<Wire> = sheet.nets.iter().map(wire).collect();
    for (channel, routed) in routed.iter().enumerate() {
        let left = channel.checked_sub(1).map_or(0, |layer| columns[layer].right());
        let right =
            columns.get(channel).map_or(left + channel_width(&grid.channels[channel], routed), |column| column.x);
        let first = left + (right - left - (routed.width() - 1).max(0) * GRID) / 2;
        for lines in &routed.nets {
            lines.put(&mut wires[lines.net], (left, right), |track| first + i32::try_from(track).unwrap_or(0) * GRID);
        }
    }
    for (item, top) in grid.items.iter().zip(tops) {
        let column = &columns[item.layer];
        match item.kind {
            Kind::Pass(net) => wires[net].line((column.x, *top), (column.right(), *top)),
            Kind::Node(node) => {
                let node = sheet.nodes[node];
                let place = (column.x + column.before, column.width);
                for joint in &item.joints {
                    let y = top + i32::try_from(joint.offset).unwrap_or(0) * GRID;
                    let wire = &mut wires[grid.channels[joint.channel][joint.bundle].net];
                    let pin = |pin: &&super::netlist::Pin| pin.net == Some(wire.net) && shape::pin_y(pin) == y - top;
                    let side = if joint.left { Side::Right } else { Side::Left };
                    let reach = list.nodes[node].pins.iter().filter(|pin| pin.side == side).find(pin);
                    let reach = reach.map_or(0, shape::reach);
                    if joint.left {
                        wire.line((place.0 + place.1 + reach, y), (column.right(), y));
                    } else {
                        wire.line((column.x, y), (place.0 - reach, y));
                    }
                }
            }
        }
    }
    wires
}

impl Wire {
    /// Adds a piece that has a length.
    pub(crate) fn line(&mut self, from: (i32, i32), to: (i32, i32)) {
        if from != to {
            self.segments.push(Segment { from, to });
        }
    }
}
