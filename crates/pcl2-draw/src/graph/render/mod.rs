//! Sheets as SVG.

pub(crate) mod shape;

use super::netlist::{Netlist, Node, Note, Pin, Side};
use super::sheet::{Drawn, Frame, Placed, Wire};
use super::sheets::Layout;
use crate::svg::{self, escape};
use pcl2_lang::program::{Program, SectionKind};
use pcl2_lang::types::{Scalar, Shape};
use shape::{DELAY, LABEL, LEAD, POINT, ROW, SMALL};
use std::fmt::Write;

/// Around the picture.
const EDGE: i32 = 20;
/// The room of the picture's title.
const TITLE: i32 = 30;
/// The font size of a frame's title.
const TITLE_SIZE: i32 = 13;
/// Between sheets.
const GAP: i32 = 20;
/// The room of a frame's title.
const FRAME: i32 = 30;
/// Sheets begin at multiples of this.
const STEP: i32 = 60;
/// A large picture is about this much wider than high, in tenths.
const ASPECT: i64 = 16;

const STYLE: &str = "\
.paper{fill:#fff}
.frame{fill:#f6f7f9;stroke:#9aa4b2;stroke-width:1}
.initialize .frame{fill:#f7f6f2}.plant .frame{fill:#f1f7f1}.control .frame{fill:#f1f5fa}
.title{font-size:13px;font-weight:bold;fill:#344054;stroke:#f1f5fa;stroke-width:4;paint-order:stroke}
.initialize .title{stroke:#f7f6f2}.plant .title{stroke:#f1f7f1}
.head{font-size:15px;font-weight:bold;fill:#1d2939}
.rate{font-weight:normal;fill:#667085}
.box{fill:#fff;stroke:#344054;stroke-width:1.2}
.composite .box{stroke-width:2.4}
.band{fill:#e4e9f0}
.tag{font-size:11px;font-weight:bold;fill:#101828}
.code{font-size:11px;fill:#175cd3}
.number{font-weight:normal;fill:#667085}
.pin{font-size:10px;fill:#344054}
.small{font-size:9px;fill:#475467}
.end{text-anchor:end}.middle{text-anchor:middle}
.wire{fill:none;stroke:#1d2939;stroke-width:1.2;stroke-linecap:square}
.whole{stroke:#175cd3}
.wide{stroke-width:2.6}
.return{stroke:#98a2b3;stroke-width:1;stroke-dasharray:4 3;stroke-linecap:butt}
.dot{fill:#1d2939}.dot.whole{fill:#175cd3;stroke:none}.dot.return{fill:#98a2b3;stroke:none}
.arrow{fill:#1d2939}.arrow.return{fill:#98a2b3;stroke:none}
.lead{stroke:#667085;stroke-width:1}
.delay{fill:#fff4e5;stroke:#b54708;stroke-width:1}
.z{font-size:9px;fill:#b54708}
.cell{fill:#fffaeb;stroke:#b54708;stroke-width:.8}
.flag{fill:#eef4ff;stroke:#667085;stroke-width:.8}
.word{fill:#ecfdf3;stroke:#027a48;stroke-width:1}
";

/// The whole picture.
pub(crate) fn picture(program: &Program, list: &Netlist, layout: &Layout, sheets: &[Drawn]) -> String {
    let mut body = String::new();
    let (width, height) = match (layout, sheets.first()) {
        (Layout::Packed(counts), _) => packed(&mut body, program, list, counts, sheets),
        (Layout::Lanes, Some(sheet)) => lanes(&mut body, program, list, sheet),
        (Layout::Lanes, None) => (0, 0),
    };
    let title = format!("{}, {} blocks", program.name, program.main().blocks.len());
    let least = svg::width(&title, 15);
    let mut text = svg::open(width.max(least) + 2 * EDGE, height + TITLE + 2 * EDGE, &title, STYLE);
    let _ = writeln!(
        text,
        "<text class='head' x='{EDGE}' y='{}'>{}<tspan class='rate'>{}</tspan></text>",
        EDGE + 14,
        escape(&program.name),
        escape(&title[program.name.len()..])
    );
    text.push_str(&body);
    svg::close(&mut text);
    text
}

/// Frames first, titles last: a wire may pass behind a title.
fn lanes(text: &mut String, program: &Program, list: &Netlist, sheet: &Drawn) -> (i32, i32) {
    let moved = |frame: &Frame| Frame { x: frame.x + EDGE, y: frame.y + EDGE + TITLE, ..*frame };
    let frames: Vec<Frame> = sheet.frames.iter().map(moved).collect();
    for frame in &frames {
        put_frame(text, program, frame);
        text.push_str("</g>\n");
    }
    put_sheet(text, list, sheet, (EDGE, EDGE + TITLE));
    for frame in &frames {
        let _ = writeln!(text, "<g class='{}'>", title(program, frame.section).0.to_ascii_lowercase());
        put_title(text, program, frame);
        text.push_str("</g>\n");
    }
    (sheet.width, sheet.height)
}

/// Each section's sheets in rows, sections one below the other.
fn packed(text: &mut String, program: &Program, list: &Netlist, counts: &[usize], sheets: &[Drawn]) -> (i32, i32) {
    let area: i64 = sheets.iter().map(|sheet| i64::from(sheet.width + GAP) * i64::from(sheet.height + GAP)).sum();
    let widest = sheets.iter().map(|sheet| sheet.width).max().unwrap_or(0);
    let wanted = i32::try_from((area * ASPECT / 10).isqrt()).unwrap_or(i32::MAX / 4);
    let wanted = wanted.max(widest);
    let mut rest = sheets;
    let mut sections = Vec::new();
    for (section, count) in counts.iter().enumerate() {
        let (own, others) = rest.split_at(*count);
        rest = others;
        sections.push((section, own, rows(own, wanted)));
    }
    let width = sections.iter().map(|(.., (_, size))| size.0 + 2 * GAP).max().unwrap_or(0);
    let mut y = 0;
    for (section, own, (places, size)) in sections {
        let frame = Frame { section, x: EDGE, y: y + EDGE + TITLE, width, height: size.1 + FRAME + GAP };
        put_frame(text, program, &frame);
        for (sheet, place) in own.iter().zip(places) {
            put_sheet(text, list, sheet, (frame.x + GAP + place.0, frame.y + FRAME + place.1));
        }
        put_title(text, program, &frame);
        text.push_str("</g>\n");
        y += frame.height + GAP;
    }
    (width, y - GAP)
}

/// The places of sheets in rows of a width, and the size of it all. A low sheet stands below the one before it where
/// its row is high enough.
fn rows(sheets: &[Drawn], wanted: i32) -> (Vec<(i32, i32)>, (i32, i32)) {
    let mut places: Vec<(i32, i32)> = Vec::new();
    let mut row = Row::default();
    let mut width = 0;
    for sheet in sheets {
        if row.right > 0 && !row.fits_below(sheet) && row.right + sheet.width > wanted {
            row = Row { y: row.y + row.height + GAP, ..Row::default() };
        }
        places.push(row.put(sheet));
        width = width.max(row.column.0 + row.column.1);
    }
    (places, (width, row.y + row.height))
}

/// A row of sheets in the making.
#[derive(Default)]
struct Row {
    y: i32,
    height: i32,
    /// Where the next column begins.
    right: i32,
    /// The newest column: place, width, used height.
    column: (i32, i32, i32),
}

impl Row {
    fn fits_below(&self, sheet: &Drawn) -> bool {
        self.right > 0 && sheet.width <= self.column.1 && self.column.2 + GAP + sheet.height <= self.height
    }

    fn put(&mut self, sheet: &Drawn) -> (i32, i32) {
        if self.fits_below(sheet) {
            let y = self.y + self.column.2 + GAP;
            self.column.2 += GAP + sheet.height;
            return (self.column.0, y);
        }
        self.column = (self.right, sheet.width, sheet.height);
        self.height = self.height.max(sheet.height);
        self.right = (self.right + sheet.width + GAP + STEP - 1) / STEP * STEP;
        (self.column.0, self.y)
    }
}

/// Opens a section's group with its frame.
fn put_frame(text: &mut String, program: &Program, frame: &Frame) {
    let _ = writeln!(
        text,
        "<g class='{}'>\n<rect class='frame' x='{}' y='{}' width='{}' height='{}' rx='4'/>",
        title(program, frame.section).0.to_ascii_lowercase(),
        frame.x,
        frame.y,
        frame.width,
        frame.height
    );
}

fn put_title(text: &mut String, program: &Program, frame: &Frame) {
    let (word, rate) = title(program, frame.section);
    let (x, y) = (frame.x + 10, frame.y + 19);
    let _ = writeln!(text, "<text class='title' x='{x}' y='{y}'>{word}<tspan class='rate'>{rate}</tspan></text>");
}

/// The width that a frame's title takes.
pub(crate) fn title_width(program: &Program, section: usize) -> i32 {
    let (word, rate) = title(program, section);
    svg::width(word, TITLE_SIZE) + svg::width(&rate, TITLE_SIZE) + 20
}

/// A section's word and when it runs.
fn title(program: &Program, section: usize) -> (&'static str, String) {
    let section = &program.sections[section];
    let seconds = |nanoseconds: i64| format!("{} s", nanoseconds as f64 / 1e9);
    let period = program.period.map(|period| section.period(period, program.substeps));
    match section.kind {
        SectionKind::Initialize => ("INITIALIZE", ", once".to_owned()),
        SectionKind::Plant => match (period, program.substeps) {
            (Some(period), _) => ("PLANT", format!(", every {}", seconds(period))),
            (None, 0 | 1) => ("PLANT", ", every scan".to_owned()),
            (None, substeps) => ("PLANT", format!(", {substeps} times a scan")),
        },
        SectionKind::Control { every, offset } => {
            let from = if offset > 0 { format!(", first at scan {offset}") } else { String::new() };
            let rate = match (period, every) {
                (Some(period), _) => format!("every {}", seconds(period)),
                (None, 1) => "every scan".to_owned(),
                (None, _) => format!("every {every} scans"),
            };
            ("CONTROL", format!(", {rate}{from}"))
        }
    }
}

fn put_sheet(text: &mut String, list: &Netlist, sheet: &Drawn, at: (i32, i32)) {
    for wire in &sheet.wires {
        put_wire(text, list, wire, at);
    }
    for node in &sheet.nodes {
        let placed = Placed { node: node.node, x: node.x + at.0, y: node.y + at.1, width: node.width };
        put_node(text, list, &placed);
    }
}

/// The classes of a net's wires.
fn kind(list: &Netlist, net: usize) -> &'static str {
    let net = &list.nets[net];
    match (net.is_return, net.ty.scalar, net.ty.shape) {
        (true, ..) => " return",
        (false, Scalar::Int, Shape::Scalar) => " whole",
        (false, Scalar::Int, _) => " whole wide",
        (false, Scalar::Real, Shape::Scalar) => "",
        (false, Scalar::Real, _) => " wide",
    }
}

fn put_wire(text: &mut String, list: &Netlist, wire: &Wire, (x, y): (i32, i32)) {
    if wire.segments.is_empty() {
        return;
    }
    let net = &list.nets[wire.net];
    let kind = kind(list, wire.net);
    let _ = write!(text, "<g><title>{}: {}</title><path class='wire{kind}' d='", escape(&net.name), net.ty);
    for segment in &wire.segments {
        let (from, to) = (segment.from, segment.to);
        let _ = write!(text, "M{} {}", from.0 + x, from.1 + y);
        let _ = if from.1 == to.1 { write!(text, "H{}", to.0 + x) } else { write!(text, "V{}", to.1 + y) };
    }
    text.push_str("'/>");
    let radius = if kind.ends_with("wide") { "3.8" } else { "2.6" };
    for dot in &wire.dots {
        let _ = write!(text, "<circle class='dot{kind}' cx='{}' cy='{}' r='{radius}'/>", dot.0 + x, dot.1 + y);
    }
    text.push_str("</g>\n");
}

fn put_node(text: &mut String, list: &Netlist, placed: &Placed) {
    let node = &list.nodes[placed.node];
    let (x, y, width, height) = (placed.x, placed.y, placed.width, shape::height(node));
    let composite = if node.composite { " composite" } else { "" };
    let _ = write!(
        text,
        "<g class='block{composite}'><title>{}</title>\n\
         <rect class='box' x='{x}' y='{y}' width='{width}' height='{height}' rx='2'/>\
         <path class='band' d='M{} {}h{}v{}h-{}z'/>",
        escape(&node.tip),
        x + 1,
        y + 1,
        width - 2,
        ROW - 2,
        width - 2
    );
    put_header(text, node, placed);
    if !node.note.is_empty() {
        let _ = write!(
            text,
            "<text class='small middle' x='{}' y='{}'>{}</text>",
            x + width / 2,
            y + height - 7,
            escape(&node.note)
        );
    }
    text.push('\n');
    for pin in &node.pins {
        put_pin(text, list, pin, placed);
    }
    text.push_str("</g>\n");
}

fn put_header(text: &mut String, node: &Node, placed: &Placed) {
    let head = shape::head(node);
    let (number, tag) =
        head.split_once(' ').map_or((head.as_str(), String::new()), |(number, tag)| (number, format!(" {tag}")));
    let _ = write!(
        text,
        "<text class='tag' x='{}' y='{}'><tspan class='number'>{number}</tspan>{}</text>\
         <text class='code end' x='{}' y='{}'>{}</text>",
        placed.x + 6,
        placed.y + 14,
        escape(&tag),
        placed.x + placed.width - 6,
        placed.y + 14,
        escape(&shape::code(node))
    );
}

/// A pin's name, and what stands at it: a mark, a note, a flag. Outwards is -1 on the left and 1 on the right.
fn put_pin(text: &mut String, list: &Netlist, pin: &Pin, placed: &Placed) {
    let y = placed.y + shape::pin_y(pin);
    let (edge, out, anchor) = match pin.side {
        Side::Left => (placed.x, -1, ""),
        Side::Right => (placed.x + placed.width, 1, " end"),
    };
    let _ = write!(
        text,
        "<text class='pin{anchor}' x='{}' y='{}'>{}</text>",
        edge - out * 8,
        y + 3,
        escape(&shape::label(pin))
    );
    let source = pin.net.is_some_and(|net| std::ptr::eq(list.pin(list.nets[net].source), pin));
    if pin.net.is_some() && !source {
        let kind = pin.net.map_or("", |net| kind(list, net)).replace(" wide", "");
        let _ = write!(text, "<path class='arrow{kind}' d='M{edge} {y}l{} -3v6z'/>", out * 7);
    }
    if pin.delayed {
        put_delay(text, (edge, y), out);
    }
    put_note(text, list, pin, (edge, y), out);
    text.push('\n');
}

/// The mark of the previous scan's value.
fn put_delay(text: &mut String, (edge, y): (i32, i32), out: i32) {
    let near = edge + out * DELAY.0;
    let left = near.min(near + out * DELAY.1);
    let _ = write!(
        text,
        "<path class='lead' d='M{edge} {y}H{near}'/>\
         <rect class='delay' x='{left}' y='{}' width='{}' height='14' rx='2'/>\
         <text class='z' x='{}' y='{}'>z<tspan dy='-3' font-size='7'>-1</tspan></text>",
        y - 7,
        DELAY.1,
        left + 4,
        y + 4
    );
}

fn put_note(text: &mut String, list: &Netlist, pin: &Pin, (edge, y): (i32, i32), out: i32) {
    let start = edge + out * shape::reach(pin);
    let anchor = if out < 0 { " end" } else { "" };
    if !pin.element.is_empty() {
        let x = start + out * 9;
        let _ = write!(text, "<text class='small{anchor}' x='{x}' y='{}'>{}</text>", y - 3, escape(&pin.element));
    }
    let (words, class) = match (&pin.note, shape::flag(list, pin)) {
        (Note::Nothing, None) => return,
        (Note::Nothing, Some(flag)) if shape::is_wired(list, pin) => {
            let x = start + out * 6;
            let _ = write!(text, "<text class='small{anchor}' x='{x}' y='{}'>{}</text>", y - 4, escape(&flag));
            return;
        }
        (Note::Nothing, Some(flag)) => (flag, "flag"),
        (Note::Constant(words), _) => (svg::brief(words, LABEL), ""),
        (Note::Cell(words), _) => (svg::brief(words, LABEL), "cell"),
        (Note::Word(words), _) => (svg::brief(words, LABEL), "word"),
    };
    let near = start + out * LEAD;
    let width = svg::width(&words, SMALL);
    let _ = write!(text, "<path class='lead' d='M{start} {y}H{near}'/>");
    let room = match class {
        "" => 3,
        "cell" => {
            let left = near.min(near + out * (width + 12));
            let _ =
                write!(text, "<rect class='cell' x='{left}' y='{}' width='{}' height='14' rx='7'/>", y - 7, width + 12);
            6
        }
        _ => {
            put_flag(text, class, (near, y), out * (width + 12));
            6 + if pin.side == Side::Left { POINT } else { 0 }
        }
    };
    let _ =
        write!(text, "<text class='small{anchor}' x='{}' y='{}'>{}</text>", near + out * room, y + 3, escape(&words));
}

/// A label with a point in the direction of the signal: left to right.
fn put_flag(text: &mut String, class: &str, (near, y): (i32, i32), length: i32) {
    if length < 0 {
        let _ = write!(text, "<path class='{class}' d='M{near} {y}l-{POINT} -7h{length}v14h{}z'/>", -length);
    } else {
        let _ = write!(text, "<path class='{class}' d='M{near} {}h{length}l{POINT} 7l-{POINT} 7h-{length}z'/>", y - 7);
    }
}
