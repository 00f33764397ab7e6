//! Scenes as SVG.

use super::layout::{Drawn, Line, Placed};
use super::legend;
use super::model::{ArcKind, Node, Symbol, Tag};
use super::scene::{self, Scene};
use super::symbol;
use crate::svg::{self, escape};
use pcl2_lang::net::written::Written;
use std::fmt::Write;

/// Around the picture.
const EDGE: i32 = 20;
/// The room of the picture's title.
const TITLE: i32 = 20;
/// Letters of the net's summary that are shown.
const SUMMARY: usize = 120;
/// So many tokens are drawn as dots.
const DOTS: u32 = 5;

const STYLE: &str = "\
.paper{fill:#fff}
.head{font-size:15px;font-weight:bold;fill:#1d2939}
.rate{font-weight:normal;fill:#667085}
.summary{font-size:11px;fill:#475467}
.frame{fill:#f6f7f9;stroke:#9aa4b2}
.title{font-size:12px;font-weight:bold;fill:#344054}
.box{fill:#fff;stroke:#344054;stroke-width:1.4}
.time .box,.count .box{fill:#fff8ec}.operation .box,.signal .box,.process .box{fill:#eef4ff}
.capacity .box{fill:#f2f4f7}.generation .box{fill:#ecfdf3}.macro .box{fill:#f4ebff}
.glyph{fill:none;stroke:#8391a7;stroke-width:1.3;stroke-linecap:round;stroke-linejoin:round}
.full{fill:#8391a7;stroke:none}
.token{fill:#101828}
.tokens{font-size:13px;font-weight:bold;fill:#101828}
.room{font-size:9px;fill:#475467}
.gate{fill:#1d2939}.abort .gate{fill:#b42318}
.post{fill:none;stroke:#1d2939;stroke-width:2}
.name{font-size:11px;font-weight:bold;fill:#101828}
.small{font-size:9px;font-weight:normal;fill:#475467}
.middle{text-anchor:middle}
.arc{fill:none;stroke:#475467;stroke-width:1.2;stroke-linejoin:round}
.tip{fill:#475467}
.read .arc{stroke:#175cd3}.read .tip{fill:#175cd3}
.inhibit .arc{stroke:#b42318}.inhibit .ring{stroke:#b42318}
.ring{fill:#fff;stroke-width:1.2}
.weight{font-size:9px;font-weight:bold;fill:#344054}
.tag{fill:#fff;stroke:#8391a7;stroke-dasharray:3 2}
.label{font-size:9px;fill:#344054}
.legend{font-size:10px;fill:#475467}
.rule{fill:none;stroke:#d0d5dd}
";

/// The whole picture.
pub(crate) fn picture(written: &Written<'_>, scene: &Scene) -> String {
    let Some(net) = written.nets.first() else {
        return String::new();
    };
    let (boxes, gates) = (net.net.boxes.len(), net.net.gates.len());
    let counts = format!(", {boxes} {}, {gates} {}", plural("box", "boxes", boxes), plural("gate", "gates", gates));
    let title = format!("{}{counts}", net.decl.name);
    let whole = net.decl.doc.split_whitespace().collect::<Vec<_>>().join(" ");
    let summary = svg::brief_words(&whole, SUMMARY);
    let width = scene.width.max(svg::width(&title, 15)).max(svg::width(&summary, 11));
    let legend = legend::legend(scene, width);
    let top = EDGE + TITLE;
    let height = top + scene.height + legend.height + EDGE;
    let mut text = svg::open(width + 2 * EDGE, height, &title, STYLE);
    let _ = writeln!(
        text,
        "<text class='head' x='{EDGE}' y='{}'>{}<tspan class='rate'>{counts}</tspan></text>\n\
         <text class='summary' x='{EDGE}' y='{}'>{}{}</text>",
        EDGE + 12,
        escape(&net.decl.name),
        EDGE + 30,
        if summary == whole { String::new() } else { format!("<title>{}</title>", escape(&whole)) },
        escape(&summary)
    );
    put_inside(&mut text, scene, (EDGE, top));
    let _ = write!(text, "<g transform='translate({EDGE} {})'>\n{}</g>\n", top + scene.height, legend.text);
    svg::close(&mut text);
    text
}

fn plural<'a>(one: &'a str, many: &'a str, count: usize) -> &'a str {
    if count == 1 { one } else { many }
}

fn put_inside(text: &mut String, scene: &Scene, (x, y): (i32, i32)) {
    for (sheet, at) in &scene.sheets {
        put_sheet(text, &scene.nodes, sheet, (x + at.0, y + at.1));
    }
    for (inner, at) in &scene.inner {
        put_framed(text, inner, (x + at.0, y + at.1));
    }
}

fn put_framed(text: &mut String, scene: &Scene, (x, y): (i32, i32)) {
    let left_out = if scene.left_out { " (in a picture of its own)" } else { "" };
    let _ = writeln!(
        text,
        "<g class='part'>\n<rect class='frame' x='{x}' y='{y}' width='{}' height='{}' rx='6'/>\
         <text class='title' x='{}' y='{}'>{}<tspan class='rate'>{left_out}</tspan></text>",
        scene.width,
        scene.height,
        x + 12,
        y + scene::HEAD - 11,
        escape(&scene.title)
    );
    put_inside(text, scene, (x, y));
    text.push_str("</g>\n");
}

fn put_sheet(text: &mut String, nodes: &[Node], sheet: &Drawn, at: (i32, i32)) {
    for line in &sheet.lines {
        put_line(text, nodes, line, at);
    }
    for placed in &sheet.nodes {
        let moved = Placed { x: placed.x + at.0, y: placed.y + at.1, ..*placed };
        put_node(text, &nodes[placed.node], &moved);
    }
}

/// The class of an arc.
pub(crate) fn arc_class(kind: ArcKind) -> &'static str {
    match kind {
        ArcKind::Take | ArcKind::Put => "moves",
        ArcKind::Read => "read",
        ArcKind::Inhibit => "inhibit",
    }
}

fn put_line(text: &mut String, nodes: &[Node], line: &Line, at: (i32, i32)) {
    let arc = line.arc;
    let points: Vec<(i32, i32)> = line.points.iter().map(|point| (point.0 + at.0, point.1 + at.1)).collect();
    let ([first, ..], Some(last)) = (points.as_slice(), points.last()) else {
        return;
    };
    let sign = match arc.kind {
        ArcKind::Take => "->",
        ArcKind::Put => "<-",
        ArcKind::Read => "<->",
        ArcKind::Inhibit => "-o",
    };
    let title = escape(&format!("{} {sign} {}", nodes[arc.place].name, nodes[arc.gate].name));
    let _ = write!(
        text,
        "<g class='{}'><title>{title}</title><path class='arc' d='M{} {}",
        arc_class(arc.kind),
        first.0,
        first.1
    );
    for (from, to) in points.iter().zip(&points[1..]) {
        let _ = if from.1 == to.1 { write!(text, "H{}", to.0) } else { write!(text, "V{}", to.1) };
    }
    text.push_str("'/>");
    match arc.kind {
        ArcKind::Take | ArcKind::Put => put_tip(text, *last, (0, 1)),
        ArcKind::Read => {
            put_tip(text, *first, (0, -1));
            put_tip(text, *last, (0, 1));
        }
        ArcKind::Inhibit if line.to_gate => put_ring(text, (last.0, last.1 - 4)),
        ArcKind::Inhibit => put_ring(text, (first.0, first.1 + 4)),
    }
    if arc.weight > 1 {
        let (x, y) = if line.to_gate { (last.0 + 5, last.1 - 5) } else { (first.0 + 5, first.1 + 12) };
        let _ = write!(text, "<text class='weight' x='{x}' y='{y}'>{}</text>", arc.weight);
    }
    text.push_str("</g>\n");
}

/// A head at a point, in a direction.
pub(crate) fn put_tip(text: &mut String, (x, y): (i32, i32), (dx, dy): (i32, i32)) {
    let _ = write!(
        text,
        "<path class='tip' d='M{x} {y}l{} {}l{} {}z'/>",
        -7 * dx - 3 * dy,
        -7 * dy - 3 * dx,
        6 * dy,
        6 * dx
    );
}

/// The end of an inhibitor arc.
pub(crate) fn put_ring(text: &mut String, (x, y): (i32, i32)) {
    let _ = write!(text, "<circle class='ring' cx='{x}' cy='{y}' r='4'/>");
}

fn put_node(text: &mut String, node: &Node, placed: &Placed) {
    let _ = write!(text, "<g class='{}'><title>{}</title>", class(node.symbol), escape(&node.tip));
    put_symbol(text, node.symbol, &node.number, placed);
    if !symbol::is_gate(node) {
        put_tokens(text, node, (placed.x + placed.width / 2, placed.y));
    }
    put_texts(text, node, placed);
    for (i, tag) in node.tags.iter().enumerate() {
        let y = symbol::tag_y(node, i);
        put_tag(text, tag, placed.x, (placed.x + symbol::indent(node, y), placed.y + y));
    }
    if node.tags.len() > 1 && symbol::is_gate(node) {
        let half = 6 - symbol::tag_y(node, 0);
        let _ = write!(text, "<path class='post' d='M{} {}v{}'/>", placed.x, placed.y - half, 2 * half);
    }
    text.push_str("</g>\n");
}

/// The class of a symbol.
fn class(symbol: Symbol) -> &'static str {
    match symbol {
        Symbol::State => "state",
        Symbol::Capacity => "capacity",
        Symbol::Time => "time",
        Symbol::Count => "count",
        Symbol::Operation => "operation",
        Symbol::Signal => "signal",
        Symbol::Process => "process",
        Symbol::Generation => "generation",
        Symbol::Entry => "entry",
        Symbol::Exit => "exit",
        Symbol::Macro => "macro",
        Symbol::Gate => "bar",
        Symbol::Abort => "abort",
    }
}

/// A symbol alone, in a group of its class.
pub(crate) fn put_alone(text: &mut String, symbol: Symbol, number: &str) {
    let placed = Placed { node: 0, x: 0, y: symbol::HALF, width: 2 * symbol::HALF };
    let _ = write!(text, "<g class='{}'>", class(symbol));
    put_symbol(text, symbol, number, &placed);
    text.push_str("</g>");
}

fn put_symbol(text: &mut String, symbol: Symbol, number: &str, placed: &Placed) {
    let (x, y, width) = (placed.x, placed.y, placed.width);
    let (middle, half) = (x + width / 2, symbol::HALF);
    let radius = match symbol {
        Symbol::Gate | Symbol::Abort => {
            let _ = write!(
                text,
                "<rect class='gate' x='{x}' y='{}' width='{width}' height='{}'/>",
                y - symbol::BAR,
                2 * symbol::BAR
            );
            return;
        }
        Symbol::State | Symbol::Time | Symbol::Count | Symbol::Generation | Symbol::Entry | Symbol::Exit => half,
        Symbol::Capacity | Symbol::Macro => 8,
        Symbol::Operation | Symbol::Signal | Symbol::Process => 2,
    };
    let _ = write!(
        text,
        "<rect class='box' x='{x}' y='{}' width='{width}' height='{}' rx='{radius}'/>",
        y - half,
        2 * half
    );
    let glyph = glyph(symbol, (x, y), width);
    if !glyph.is_empty() {
        let full = if matches!(symbol, Symbol::Entry | Symbol::Exit) { " full" } else { "" };
        let _ = write!(text, "<path class='glyph{full}' d='{glyph}'/>");
    }
    if !number.is_empty() {
        let _ = write!(text, "<text class='room middle' x='{middle}' y='{}'>{number}</text>", y + half - 5);
    }
}

/// What tells a symbol from others: hands of a clock, shelves, a tally, ..
fn glyph(symbol: Symbol, (x, y): (i32, i32), width: i32) -> String {
    let (middle, right) = (x + width / 2, x + width);
    let top = y - symbol::HALF;
    match symbol {
        Symbol::State | Symbol::Gate | Symbol::Abort => String::new(),
        Symbol::Capacity => format!("M{x} {}h{width}M{x} {}h{width}", top + 8, top + 26),
        Symbol::Time => format!(
            "M{middle} {y}v-12M{middle} {y}h8M{middle} {}v4M{middle} {}v-4M{} {y}h4M{} {y}h-4",
            top + 3,
            top + 37,
            middle - 17,
            middle + 17
        ),
        Symbol::Count => format!("M{} {}v10m4 -10v10m4 -10v10m4 -10v10m-15 -2l18 -6", middle - 6, top + 5),
        Symbol::Operation => format!("M{} {}h8m-4 -4v8m8 -4m-1 0h8m-8 4h8", middle - 9, top + 9),
        Symbol::Signal => format!("M{} {}l-5 9h8l-5 9", middle + 2, top + 4),
        Symbol::Process => format!("M{} {top}v40M{} {top}v40", x + 6, right - 6),
        Symbol::Generation => {
            format!("M{middle} {}v10m-5 -5h10m-9 -4l8 8m0 -8l-8 8", top + 5)
        }
        Symbol::Entry => format!("M{} {}h12l-6 8z", middle - 6, top + 4),
        Symbol::Exit => format!("M{} {}h12l-6 8z", middle - 6, top + 28),
        Symbol::Macro => {
            format!("M{} {}h{}v32h-{}z", x + 4, top + 4, width - 8, width - 8)
        }
    }
}

/// Dots, or a number where they are many.
fn put_tokens(text: &mut String, node: &Node, (x, y): (i32, i32)) {
    let y = if node.number.is_empty() { y } else { y - 3 };
    let places: &[(i32, i32)] = match node.tokens {
        0 => &[],
        1 => &[(0, 0)],
        2 => &[(-6, 0), (6, 0)],
        3 => &[(0, -6), (-6, 5), (6, 5)],
        4 => &[(-6, -6), (6, -6), (-6, 6), (6, 6)],
        _ => &[(0, 0), (-8, -7), (8, -7), (-8, 7), (8, 7)],
    };
    if node.tokens > DOTS {
        let _ = write!(text, "<text class='tokens middle' x='{x}' y='{}'>{}</text>", y + 5, node.tokens);
        return;
    }
    for (dx, dy) in places {
        let _ = write!(text, "<circle class='token' cx='{}' cy='{}' r='4'/>", x + dx, y + dy);
    }
}

/// Name, priority and lines, right of the symbol.
fn put_texts(text: &mut String, node: &Node, placed: &Placed) {
    let x = placed.x + placed.width + symbol::SPACE;
    let first = placed.y - (symbol::count(node.lines.len()) + 1) * symbol::PITCH / 2 + 9;
    let priority = symbol::priority(node);
    let small =
        if priority.is_empty() { String::new() } else { format!("<tspan class='small' dx='6'>{priority}</tspan>") };
    let _ = write!(text, "<text class='name' x='{x}' y='{first}'>{}{small}</text>", escape(&symbol::name(node)));
    for (i, line) in node.lines.iter().enumerate() {
        let y = first + symbol::PITCH * (symbol::count(i) + 1);
        let _ = write!(text, "<text class='small' x='{x}' y='{y}'>{}</text>", escape(line));
    }
}

/// A name left of a symbol, with an arc to the symbol's outline.
fn put_tag(text: &mut String, tag: &Tag, left: i32, (x, y): (i32, i32)) {
    let width = symbol::tag_width(tag);
    let right = left - symbol::LEAD;
    let _ = write!(
        text,
        "<g class='{}'><rect class='tag' x='{}' y='{}' width='{width}' height='14' rx='7'/>\
         <text class='label middle' x='{}' y='{}'>{}</text><path class='arc' d='M{right} {y}H{x}'/>",
        arc_class(tag.kind),
        right - width,
        y - 7,
        right - width / 2,
        y + 3,
        escape(&symbol::tag(tag))
    );
    match (tag.kind, tag.inwards) {
        (ArcKind::Take | ArcKind::Put, true) => put_tip(text, (x, y), (1, 0)),
        (ArcKind::Take | ArcKind::Put, false) => put_tip(text, (right, y), (-1, 0)),
        (ArcKind::Read, _) => {
            put_tip(text, (x, y), (1, 0));
            put_tip(text, (right, y), (-1, 0));
        }
        (ArcKind::Inhibit, _) => put_ring(text, (x - 4, y)),
    }
    text.push_str("</g>");
}
