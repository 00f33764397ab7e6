//! Sheets in rows, and nets inside in frames among them.

use super::layout::{self, Drawn};
use super::model::{self, Node};
use super::sheets;
use crate::svg;
use pcl2_lang::net::written::Written;

/// Around what stands in a frame.
const PAD: i32 = 14;
/// The room of a frame's title.
pub(crate) const HEAD: i32 = 30;
/// The font size of a frame's title.
const SIZE: i32 = 12;
/// Letters of a frame's title that are shown.
const TITLE: usize = 80;
/// The most boxes of a picture: nets inside beyond it are frames with their names alone.
const BOXES: usize = 4000;
/// Between sheets.
const GAP: i32 = 24;
/// A picture is about this much wider than high, in tenths.
const ASPECT: i64 = 14;
/// So many columns are tried.
const COLUMNS: usize = 40;

/// A net with its sheets, and those inside it.
pub(crate) struct Scene {
    pub(crate) title: String,
    pub(crate) nodes: Vec<Node>,
    pub(crate) sheets: Vec<(Drawn, (i32, i32))>,
    pub(crate) inner: Vec<(Scene, (i32, i32))>,
    pub(crate) width: i32,
    pub(crate) height: i32,
    /// It is too large to be drawn here.
    pub(crate) left_out: bool,
}

/// The picture of a net, with as many of the nets inside it as there is room for.
pub(crate) fn scene(written: &Written<'_>) -> Scene {
    let mut room = BOXES;
    let title = written.nets.first().map_or("", |net| &net.decl.name);
    framed(written, 0, title.to_owned(), &mut room)
}

fn framed(written: &Written<'_>, index: usize, title: String, room: &mut usize) -> Scene {
    let own = &written.nets[index];
    let title = svg::brief(&title, TITLE);
    let least = svg::width(&title, SIZE) + 2 * PAD;
    let first = *room == BOXES;
    if own.net.boxes.len() > *room && !first {
        let (nodes, sheets, inner) = (Vec::new(), Vec::new(), Vec::new());
        return Scene { title, nodes, sheets, inner, width: least, height: HEAD + PAD, left_out: true };
    }
    *room = room.saturating_sub(own.net.boxes.len().max(1));
    let mut graph = model::graph(&written.nets, own);
    let sheets: Vec<Drawn> = sheets::divide(&mut graph).iter().map(|sheet| layout::draw(&graph, sheet)).collect();
    let inner: Vec<Scene> =
        parts(written, index).into_iter().map(|(part, title)| framed(written, part, title, room)).collect();
    place(title, least, graph.nodes, sheets, inner)
}

/// The nets inside a net, each once, with titles that name all parts that it stands for.
fn parts(written: &Written<'_>, index: usize) -> Vec<(usize, String)> {
    let own = &written.nets[index];
    let mut parts: Vec<(usize, Vec<&str>)> = Vec::new();
    for (part, inner) in own.net.parts.iter().zip(&own.parts) {
        match parts.iter_mut().find(|(known, _)| known == inner) {
            Some((_, names)) => names.push(&part.name),
            None => parts.push((*inner, vec![&part.name])),
        }
    }
    let title = |(inner, names): (usize, Vec<&str>)| {
        let title = format!("{}: {}", names.join(", "), written.nets[inner].decl.name);
        (inner, title)
    };
    parts.into_iter().map(title).collect()
}

fn place(title: String, least: i32, nodes: Vec<Node>, sheets: Vec<Drawn>, inner: Vec<Scene>) -> Scene {
    let sheet_sizes = sheets.iter().map(|sheet| (sheet.width, sheet.height));
    let sizes: Vec<(i32, i32)> = sheet_sizes.chain(inner.iter().map(|scene| (scene.width, scene.height))).collect();
    let Columns { places, width, height } = columns(&sizes);
    let mut places = places.into_iter().map(|(x, y)| (x + PAD, y + HEAD));
    let sheets = sheets.into_iter().zip(&mut places).collect();
    let inner = inner.into_iter().zip(places).collect();
    let (width, height) = (least.max(width + 2 * PAD), HEAD + height + PAD);
    Scene { title, nodes, sheets, inner, width, height, left_out: false }
}

/// The places of sheets, one below the other in columns, and the size of it all.
#[derive(Default)]
struct Columns {
    places: Vec<(i32, i32)>,
    width: i32,
    height: i32,
}

/// Columns of the height at which the picture is as wide as it looks well.
fn columns(sizes: &[(i32, i32)]) -> Columns {
    let tallest = sizes.iter().map(|(_, height)| *height).max().unwrap_or(0);
    let whole = sizes.iter().fold(0_i32, |sum, (_, height)| sum.saturating_add(height + GAP));
    let heights = (1..=COLUMNS).map(|count| tallest.max(whole / i32::try_from(count).unwrap_or(1)));
    let tried = heights.map(|height| filled(sizes, height));
    let cost = |columns: &Columns| (i64::from(columns.width) * 10).max(i64::from(columns.height) * ASPECT);
    tried.min_by_key(cost).unwrap_or_default()
}

/// Columns of at most this height, filled in order.
fn filled(sizes: &[(i32, i32)], height: i32) -> Columns {
    let mut columns = Columns::default();
    let (mut x, mut y, mut width) = (0, 0, 0);
    for size in sizes {
        if y > 0 && y + size.1 > height {
            (x, y, width) = (x + width + GAP, 0, 0);
        }
        columns.places.push((x, y));
        columns.height = columns.height.max(y + size.1);
        width = width.max(size.0);
        columns.width = columns.width.max(x + width);
        y += size.1 + GAP;
    }
    columns
}
