//! What stands in a picture of ours, read back from its SVG: boxes, wires, marks.

use roxmltree::{Document, Node};

/// A rectangle: left, top, right, bottom.
pub type Area = [i32; 4];

/// A straight piece: two points.
pub type Piece = [(i32, i32); 2];

/// A block diagram.
#[derive(Debug, Default)]
pub struct Diagram {
    /// The picture's size.
    pub size: (i32, i32),
    /// The sections' frames.
    pub frames: Vec<Area>,
    /// The blocks' boxes.
    pub boxes: Vec<Area>,
    /// Marks of delays, and operator cells.
    pub marks: Vec<Area>,
    /// Each net's name and pieces.
    pub wires: Vec<(String, Vec<Piece>)>,
    /// Where a wire or a flag ends at a port: the point, and -1 on the left side of a box, 1 on the right.
    pub ports: Vec<((i32, i32), i32)>,
    /// Where a flag begins or ends.
    pub flags: Vec<(i32, i32)>,
    /// Where delayed values come in, as [`Diagram::ports`].
    pub delays: usize,
    /// All texts with their places and sizes.
    pub texts: Vec<(String, i32, i32)>,
}

/// Reads a block diagram.
///
/// # Panics
/// When the text is no XML, or has something else in a wire than straight pieces.
pub fn diagram(svg: &str) -> Diagram {
    let document = Document::parse(svg).expect("well-formed XML");
    let root = document.root_element();
    let mut found = Diagram { size: (number(root, "width"), number(root, "height")), ..Diagram::default() };
    for node in root.descendants().filter(Node::is_element) {
        let classes: Vec<&str> = node.attribute("class").unwrap_or_default().split(' ').collect();
        let data = node.attribute("d").unwrap_or_default();
        match classes[0] {
            "frame" => found.frames.push(area(node)),
            "box" => found.boxes.push(area(node)),
            "delay" | "cell" => {
                found.delays += usize::from(classes[0] == "delay");
                found.marks.push(area(node));
            }
            "wire" => {
                let title = node.parent().and_then(|group| group.children().find(|child| child.has_tag_name("title")));
                let name = title.and_then(|title| title.text()).unwrap_or_default();
                found.wires.push((name.to_owned(), pieces(data)));
            }
            "arrow" => {
                let (point, rest) = start(data);
                found.ports.push((point, if rest.starts_with("l-") { -1 } else { 1 }));
            }
            "lead" => found.flags.extend(pieces(data).concat()),
            _ => {}
        }
        if node.has_tag_name("text") {
            let text = node.descendants().filter_map(|part| part.text().filter(|_| part.is_text())).collect();
            found.texts.push((text, number(node, "x"), number(node, "y")));
        }
    }
    found
}

pub(crate) fn number(node: Node<'_, '_>, name: &str) -> i32 {
    node.attribute(name).and_then(|text| text.parse().ok()).unwrap_or_else(|| panic!("{name} of {node:?}"))
}

pub(crate) fn area(node: Node<'_, '_>) -> Area {
    let [x, y, width, height] = ["x", "y", "width", "height"].map(|name| number(node, name));
    [x, y, x + width, y + height]
}

/// `M3 4..`: the point and what follows.
pub(crate) fn start(data: &str) -> ((i32, i32), &str) {
    let data = data.strip_prefix('M').expect("a path begins with M");
    let end = data.find(char::is_alphabetic).unwrap_or(data.len());
    let (x, y) = data[..end].split_once(' ').expect("two coordinates");
    ((x.parse().expect("x"), y.parse().expect("y")), &data[end..])
}

fn pieces(data: &str) -> Vec<Piece> {
    let mut pieces = Vec::new();
    for part in data.split_inclusive('M').map(|part| part.trim_end_matches('M')).filter(|part| !part.is_empty()) {
        let text = format!("M{part}");
        let (from, rest) = start(&text);
        let end: i32 = rest[1..].parse().expect("a coordinate");
        let to = match &rest[..1] {
            "H" => (end, from.1),
            "V" => (from.0, end),
            other => panic!("{other} in a wire"),
        };
        pieces.push([from, to]);
    }
    pieces
}

/// Whether two areas have a point inside both.
pub fn overlap(a: &Area, b: &Area) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

/// A piece as an area without inside.
pub fn span(piece: &Piece) -> Area {
    let [(a, b), (c, d)] = *piece;
    [a.min(c), b.min(d), a.max(c), b.max(d)]
}

/// Whether a piece runs through the inside of an area.
pub fn runs_through(piece: &Piece, area: &Area) -> bool {
    let span = span(piece);
    span[0] < area[2]
        && area[0] < span[2].max(span[0] + 1)
        && span[1] < area[3]
        && area[1] < span[3].max(span[1] + 1)
        && (span[0] > area[0] || span[2] > span[0])
        && (span[1] > area[1] || span[3] > span[1])
}

/// Whether a piece runs along an edge of an area.
pub fn runs_along(piece: &Piece, area: &Area) -> bool {
    let span = span(piece);
    let upright = span[0] == span[2] && (span[0] == area[0] || span[0] == area[2]);
    let level = span[1] == span[3] && (span[1] == area[1] || span[1] == area[3]);
    (upright && span[1] < area[3] && area[1] < span[3]) || (level && span[0] < area[2] && area[0] < span[2])
}

/// Whether a point lies on a piece.
pub fn lies_on((x, y): (i32, i32), piece: &Piece) -> bool {
    let span = span(piece);
    span[0] <= x && x <= span[2] && span[1] <= y && y <= span[3]
}

/// Whether two pieces share more than a crossing: a stretch, or an end of one on the other.
pub fn touch(a: &Piece, b: &Piece) -> bool {
    a.iter().any(|point| lies_on(*point, b)) || b.iter().any(|point| lies_on(*point, a))
}
