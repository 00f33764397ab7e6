//! What the symbols of a picture mean: those that are in it.

use super::model::{ArcKind, Symbol};
use super::render;
use super::scene::Scene;
use crate::svg;
use std::collections::BTreeSet;
use std::fmt::Write;

/// The font size.
const SIZE: i32 = 10;
/// The width of a symbol, with the space behind it.
const SYMBOL: i32 = 32;
/// Between two entries.
const GAP: i32 = 22;
/// The height of a row.
const ROW: i32 = 32;

/// The legend of a picture.
pub(crate) struct Legend {
    pub(crate) text: String,
    pub(crate) height: i32,
}

/// What a legend can explain.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Entry {
    Symbol(Symbol),
    Token,
    Arc(ArcKind),
    Tag,
}

/// Explains what is in a scene, in rows of a width.
pub(crate) fn legend(scene: &Scene, width: i32) -> Legend {
    let mut entries = BTreeSet::new();
    collect(scene, &mut entries);
    let mut text = format!("<path class='rule' d='M0 4H{width}'/>\n");
    let (mut x, mut y) = (0, 14);
    for entry in entries {
        let words = words(entry);
        let size = SYMBOL + svg::width(words, SIZE);
        if x > 0 && x + size > width {
            (x, y) = (0, y + ROW);
        }
        let _ = write!(text, "<g transform='translate({x} {y})'>");
        put(&mut text, entry);
        let _ = writeln!(text, "<text class='legend' x='{SYMBOL}' y='16'>{words}</text></g>");
        x += size + GAP;
    }
    Legend { text, height: y + ROW }
}

fn collect(scene: &Scene, entries: &mut BTreeSet<Entry>) {
    for node in &scene.nodes {
        entries.insert(Entry::Symbol(node.symbol));
        entries.extend((node.tokens > 0).then_some(Entry::Token));
        for tag in &node.tags {
            entries.insert(Entry::Tag);
            entries.extend(shown(tag.kind));
        }
    }
    for (sheet, _) in &scene.sheets {
        entries.extend(sheet.lines.iter().filter_map(|line| shown(line.arc.kind)));
    }
    for (inner, _) in &scene.inner {
        collect(inner, entries);
    }
}

/// Arcs along which tokens move need no words.
fn shown(kind: ArcKind) -> Option<Entry> {
    (!kind.moves()).then_some(Entry::Arc(kind))
}

fn words(entry: Entry) -> &'static str {
    match entry {
        Entry::Symbol(symbol) => match symbol {
            Symbol::State => "state",
            Symbol::Capacity => "capacity, and its room",
            Symbol::Time => "time",
            Symbol::Count => "count, and how many",
            Symbol::Operation => "operation",
            Symbol::Signal => "signal",
            Symbol::Process => "process",
            Symbol::Generation => "generation, and its room",
            Symbol::Entry => "entry",
            Symbol::Exit => "exit",
            Symbol::Macro => "macro, drawn in a frame",
            Symbol::Gate => "gate",
            Symbol::Abort => "empties a macro",
        },
        Entry::Token => "token at the start",
        Entry::Arc(ArcKind::Read) => "reads",
        Entry::Arc(ArcKind::Inhibit) => "is inhibited",
        Entry::Arc(ArcKind::Take | ArcKind::Put) => "moves tokens",
        Entry::Tag => "arc to or from elsewhere in the picture",
    }
}

fn put(text: &mut String, entry: Entry) {
    match entry {
        Entry::Symbol(symbol) => {
            let number = match symbol {
                Symbol::Capacity | Symbol::Count | Symbol::Generation => "n",
                Symbol::State | Symbol::Time | Symbol::Operation | Symbol::Signal | Symbol::Process => "",
                Symbol::Entry | Symbol::Exit | Symbol::Macro | Symbol::Gate | Symbol::Abort => "",
            };
            text.push_str("<g transform='scale(.6)'>");
            render::put_alone(text, symbol, number);
            text.push_str("</g>");
        }
        Entry::Token => text.push_str("<circle class='token' cx='16' cy='12' r='4'/>"),
        Entry::Tag => text.push_str("<rect class='tag' x='2' y='5' width='24' height='14' rx='7'/>"),
        Entry::Arc(kind) => {
            let _ = write!(text, "<g class='{}'><path class='arc' d='M0 12H26'/>", render::arc_class(kind));
            match kind {
                ArcKind::Inhibit => render::put_ring(text, (22, 12)),
                ArcKind::Take | ArcKind::Put => render::put_tip(text, (26, 12), (1, 0)),
                ArcKind::Read => {
                    render::put_tip(text, (26, 12), (1, 0));
                    render::put_tip(text, (0, 12), (-1, 0));
                }
            }
            text.push_str("</g>");
        }
    }
}
