//! Sizes of symbols and of what stands beside them.

use super::model::{Node, Symbol, Tag};
use super::texts::NAME;
use crate::graph::sheet::GRID;
use crate::svg;

/// Font sizes: names, lines below them, tags.
pub(crate) const HEAD: i32 = 11;
pub(crate) const SMALL: i32 = 9;
/// Half the height of a box's symbol, and half its least width.
pub(crate) const HALF: i32 = 20;
/// Half the thickness of a gate's bar.
pub(crate) const BAR: i32 = 3;
/// The distance of two lines of text.
pub(crate) const PITCH: i32 = 12;
/// The distance of two tags.
pub(crate) const ROW: i32 = 18;
/// From a symbol to its text.
pub(crate) const SPACE: i32 = 7;
/// From a symbol to its tags.
pub(crate) const LEAD: i32 = 24;
/// Letters of a tag that are shown.
const TAG: usize = 20;

/// Whether it is drawn as a bar.
pub(crate) fn is_gate(node: &Node) -> bool {
    matches!(node.symbol, Symbol::Gate | Symbol::Abort)
}

/// The name as it is shown.
pub(crate) fn name(node: &Node) -> String {
    svg::brief(&node.name, NAME)
}

/// What stands behind the name.
pub(crate) fn priority(node: &Node) -> String {
    if node.priority == 0 { String::new() } else { format!("PRIORITY {}", node.priority) }
}

/// A tag's text.
pub(crate) fn tag(tag: &Tag) -> String {
    svg::brief(&tag.text, TAG)
}

/// A tag's width.
pub(crate) fn tag_width(text: &Tag) -> i32 {
    svg::width(&tag(text), SMALL) + 14
}

/// Room left of a symbol, in grid units.
pub(crate) fn before(node: &Node) -> i64 {
    let tags = node.tags.iter().map(|text| tag_width(text) + LEAD).max().unwrap_or(0);
    units(tags)
}

/// Room right of a symbol, in grid units.
pub(crate) fn after(node: &Node) -> i64 {
    let priority = priority(node);
    let room = if priority.is_empty() { 0 } else { svg::width(&priority, SMALL) + 6 };
    let head = svg::width(&name(node), HEAD) + room;
    let lines = node.lines.iter().map(|line| svg::width(line, SMALL)).max().unwrap_or(0);
    units(SPACE + head.max(lines))
}

fn units(pixels: i32) -> i64 {
    i64::from((pixels + GRID - 1) / GRID)
}

/// How far it reaches above its middle, and below it.
pub(crate) fn extent(node: &Node) -> i32 {
    let half = if is_gate(node) { BAR } else { HALF };
    let text = (count(node.lines.len()) + 1) * PITCH / 2;
    half.max(text).max(count(node.tags.len()) * ROW / 2)
}

/// How far below the middle a tag stands.
pub(crate) fn tag_y(node: &Node, tag: usize) -> i32 {
    (2 * count(tag) + 1 - count(node.tags.len())) * ROW / 2
}

/// How far right of a symbol's left end its outline lies, so far from the middle.
pub(crate) fn indent(node: &Node, y: i32) -> i32 {
    if is_round(node.symbol) { HALF - (HALF * HALF - y * y).max(0).isqrt() } else { 0 }
}

/// Whether its ends are round.
fn is_round(symbol: Symbol) -> bool {
    match symbol {
        Symbol::State | Symbol::Time | Symbol::Count | Symbol::Generation | Symbol::Entry | Symbol::Exit => true,
        Symbol::Capacity | Symbol::Operation | Symbol::Signal | Symbol::Process | Symbol::Macro => false,
        Symbol::Gate | Symbol::Abort => false,
    }
}

/// A count as pixels.
pub(crate) fn count(count: usize) -> i32 {
    i32::try_from(count).unwrap_or(i32::MAX / 1024)
}

/// How far from its middle the outline of a symbol lies at a pin, so far from the symbol's left end.
pub(crate) fn reach(node: &Node, width: i32, pin: i32) -> i32 {
    if is_gate(node) {
        return BAR;
    }
    let off = if is_round(node.symbol) { (HALF - pin.min(width - pin)).max(0) } else { 0 };
    (HALF * HALF - off * off).max(0).isqrt()
}
