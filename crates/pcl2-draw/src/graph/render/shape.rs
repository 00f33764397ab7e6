//! Sizes of boxes and of what stands beside them.

use crate::graph::netlist::{Netlist, Node, Note, Pin, Side};
use crate::svg;

/// Font sizes: header, pins, parameters and notes.
pub(crate) const HEADER: i32 = 11;
pub(crate) const PIN: i32 = 10;
pub(crate) const SMALL: i32 = 9;
/// The header's height, and the distance of two pins.
pub(crate) const ROW: i32 = 20;
/// From the box to a note or a flag.
pub(crate) const LEAD: i32 = 10;
/// The mark of a delay: distance from the box, and width.
pub(crate) const DELAY: (i32, i32) = (12, 22);
/// Letters of a tag, a code, a label, a flag that are shown.
pub(crate) const TAG: usize = 20;
pub(crate) const LABEL: usize = 18;
/// The length of a flag's point.
pub(crate) const POINT: i32 = 6;
const LEAST_WIDTH: i32 = 80;

/// A box's height: header, rows of pins, parameters.
pub(crate) fn height(node: &Node) -> i32 {
    let rows = i32::try_from(node.rows()).unwrap_or(0) + i32::from(!node.note.is_empty());
    ROW * (1 + rows.max(1))
}

/// A pin's place below the top of its box.
pub(crate) fn pin_y(pin: &Pin) -> i32 {
    ROW + ROW / 2 + ROW * i32::try_from(pin.row).unwrap_or(0)
}

/// A box's width.
pub(crate) fn width(list: &Netlist, node: usize) -> i32 {
    let node = &list.nodes[node];
    let mut width = svg::width(&head(node), HEADER) + svg::width(&code(node), HEADER) + 28;
    width = width.max(svg::width(&node.note, SMALL) + 14);
    for row in 0..node.rows() {
        let labels = node.pins.iter().filter(|pin| pin.row == row).map(|pin| svg::width(&label(pin), PIN));
        width = width.max(labels.sum::<i32>() + 32);
    }
    // Even, so that both ends lie on whole pixels.
    (width.max(LEAST_WIDTH) + 9) / 10 * 10
}

/// Number and tag, as the header shows them.
pub(crate) fn head(node: &Node) -> String {
    let number = node.number.to_string();
    if node.tag == number { number } else { format!("{number} {}", svg::brief(&node.tag, TAG)) }
}

/// The function code, as the header shows it.
pub(crate) fn code(node: &Node) -> String {
    svg::brief(&node.code, TAG)
}

/// A pin's name, as the box shows it.
pub(crate) fn label(pin: &Pin) -> String {
    svg::brief(&pin.label, LABEL + 8)
}

/// How far what stands at a wired pin reaches out of the box: the wire begins there.
pub(crate) fn reach(pin: &Pin) -> i32 {
    if pin.delayed { DELAY.0 + DELAY.1 } else { 0 }
}

/// The text of a pin's flag.
pub(crate) fn flag(list: &Netlist, pin: &Pin) -> Option<String> {
    let net = pin.net?;
    let source = list.pin(list.nets[net].source);
    let own = std::ptr::eq(source, pin);
    (pin.flag || (own && list.has_flags(net))).then(|| svg::brief(&list.nets[net].name, LABEL))
}

/// Whether a wire begins or ends at a pin.
pub(crate) fn is_wired(list: &Netlist, pin: &Pin) -> bool {
    pin.net.is_some_and(|net| {
        let own = std::ptr::eq(list.pin(list.nets[net].source), pin);
        if own { list.wired(net).next().is_some() } else { !pin.flag }
    })
}

/// The room left of a box.
pub(crate) fn before(list: &Netlist, node: usize) -> i32 {
    beside(list, node, Side::Left)
}

/// The room right of a box.
pub(crate) fn after(list: &Netlist, node: usize) -> i32 {
    beside(list, node, Side::Right)
}

fn beside(list: &Netlist, node: usize, side: Side) -> i32 {
    let pins = list.nodes[node].pins.iter().filter(|pin| pin.side == side);
    pins.map(|pin| room(list, pin)).max().unwrap_or(0)
}

fn room(list: &Netlist, pin: &Pin) -> i32 {
    let note = match &pin.note {
        Note::Nothing => 0,
        Note::Constant(text) => LEAD + svg::width(&svg::brief(text, LABEL), SMALL) + 4,
        Note::Cell(text) => LEAD + svg::width(&svg::brief(text, LABEL), SMALL) + 12,
        Note::Word(text) => LEAD + svg::width(&svg::brief(text, LABEL), SMALL) + 12 + POINT,
    };
    let flag = flag(list, pin).map_or(0, |text| LEAD + svg::width(&text, SMALL) + 12 + POINT);
    let element = if pin.element.is_empty() { 0 } else { svg::width(&pin.element, SMALL) + 12 };
    reach(pin) + note.max(flag).max(element)
}
