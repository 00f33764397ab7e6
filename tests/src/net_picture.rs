//! What stands in a picture of a net, read back from its SVG: symbols, arcs, tags, texts.

use crate::picture::{Area, Piece, area, number, start};
use roxmltree::{Document, Node};

/// A picture of a net.
#[derive(Debug, Default)]
pub struct NetPicture {
    /// The picture's size.
    pub size: (i32, i32),
    /// Frames of nets inside.
    pub frames: Vec<Area>,
    /// Boxes and gates.
    pub symbols: Vec<Symbol>,
    /// Arcs with a line: their titles, such as `a -> t`, and pieces.
    pub arcs: Vec<(String, Vec<Piece>)>,
    /// Names that stand for an arc: the kind, the text, the place, and at which box or gate.
    pub tags: Vec<Tag>,
    /// Names and lines beside symbols: the text, and what it covers.
    pub texts: Vec<(String, Area)>,
    /// What the legend explains.
    pub legend: Vec<String>,
}

/// A box or a gate.
#[derive(Debug)]
pub struct Symbol {
    /// Its name as it is shown.
    pub name: String,
    /// `state`, `bar`, ..
    pub kind: String,
    /// What its tooltip says.
    pub tip: String,
    /// What it covers.
    pub area: Area,
    /// Half the height of a round end, else 0.
    pub radius: i32,
    /// Dots in it.
    pub tokens: usize,
}

/// A name that stands for an arc.
#[derive(Debug)]
pub struct Tag {
    /// `moves`, `read` or `inhibit`.
    pub kind: String,
    /// The name.
    pub text: String,
    /// What it covers.
    pub area: Area,
    /// The box or gate that it stands at.
    pub at: String,
}

/// Reads a picture of a net.
///
/// # Panics
/// When the text is no XML, or has something else in an arc than straight pieces.
pub fn net_picture(svg: &str) -> NetPicture {
    let document = Document::parse(svg).expect("well-formed XML");
    let root = document.root_element();
    let mut found = NetPicture { size: (number(root, "width"), number(root, "height")), ..NetPicture::default() };
    for node in root.descendants().filter(Node::is_element) {
        let class = node.attribute("class").unwrap_or_default();
        if node.ancestors().any(|above| above.has_attribute("transform")) {
            if class == "legend" {
                found.legend.push(text(node));
            }
            continue;
        }
        match class {
            "frame" => found.frames.push(area(node)),
            "box" | "gate" => found.symbols.push(symbol(node)),
            "tag" => found.tags.push(tag(node)),
            "name" | "small" if node.has_tag_name("text") => found.texts.push(covered(node)),
            "arc" => {
                let group = node.parent().expect("a group");
                let title = group.children().find(|child| child.has_tag_name("title"));
                if let Some(title) = title {
                    found.arcs.push((text(title), way(node.attribute("d").unwrap_or_default())));
                }
            }
            _ => {}
        }
    }
    found
}

fn text(node: Node<'_, '_>) -> String {
    node.descendants().filter(Node::is_text).filter_map(|part| part.text()).collect()
}

fn symbol(node: Node<'_, '_>) -> Symbol {
    let group = node.parent().expect("a group");
    let child = |name: &str| group.children().find(|child| child.attribute("class") == Some(name));
    let title = group.children().find(|child| child.has_tag_name("title")).expect("a tooltip");
    let name = child("name").and_then(|name| name.first_child()).and_then(|name| name.text()).unwrap_or_default();
    let area = area(node);
    let round = node.has_attribute("rx") && number(node, "rx") * 2 == area[3] - area[1];
    Symbol {
        name: name.to_owned(),
        kind: group.attribute("class").unwrap_or_default().to_owned(),
        tip: text(title),
        area,
        radius: if round { number(node, "rx") } else { 0 },
        tokens: group.children().filter(|child| child.attribute("class") == Some("token")).count(),
    }
}

fn tag(node: Node<'_, '_>) -> Tag {
    let group = node.parent().expect("a group");
    let label = group.children().find(|child| child.has_tag_name("text")).map(text).unwrap_or_default();
    let owner = group.parent().expect("a symbol");
    let name = owner.children().find(|child| child.attribute("class") == Some("name"));
    let at = name.and_then(|name| name.first_child()).and_then(|name| name.text()).unwrap_or_default().to_owned();
    let kind = group.attribute("class").unwrap_or_default().to_owned();
    Tag { kind, text: label, area: area(node), at }
}

/// A text and what it covers: letters are six tenths of their size wide.
fn covered(node: Node<'_, '_>) -> (String, Area) {
    let length = |text: &str, size: i32| i32::try_from(text.chars().count()).unwrap() * size * 6 / 10;
    let (x, y) = (number(node, "x"), number(node, "y"));
    let size = if node.attribute("class") == Some("name") { 11 } else { 9 };
    let own = node.first_child().and_then(|first| first.text()).unwrap_or_default();
    let behind = node.children().find(|child| child.has_tag_name("tspan")).map(text);
    let width = length(own, size) + behind.map_or(0, |behind| 6 + length(&behind, 9));
    (text(node), [x, y - size * 8 / 10, x + width, y + 2])
}

/// `M3 4H7V9`: the pieces of a way.
fn way(data: &str) -> Vec<Piece> {
    let (mut at, mut rest) = start(data);
    let mut pieces = Vec::new();
    while !rest.is_empty() {
        let end = rest[1..].find(char::is_alphabetic).map_or(rest.len(), |end| end + 1);
        let value: i32 = rest[1..end].parse().expect("a coordinate");
        let to = match &rest[..1] {
            "H" => (value, at.1),
            "V" => (at.0, value),
            other => panic!("{other} in an arc"),
        };
        pieces.push([at, to]);
        (at, rest) = (to, &rest[end..]);
    }
    pieces
}

impl Symbol {
    /// Whether a point lies on its outline, to a pixel.
    pub fn has_on_edge(&self, (x, y): (i32, i32)) -> bool {
        let [left, top, right, bottom] = self.area;
        if self.radius == 0 {
            return left <= x && x <= right && (y == top || y == bottom);
        }
        let middle = (top + bottom) / 2;
        let centre = x.clamp(left + self.radius, right - self.radius);
        let distance = f64::from((x - centre).pow(2) + (y - middle).pow(2)).sqrt();
        (distance - f64::from(self.radius)).abs() < 1.5
    }
}
