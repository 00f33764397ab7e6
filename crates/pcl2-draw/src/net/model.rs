//! Boxes and gates as nodes with texts, and the arcs between them.

use super::texts;
use pcl2_lang::net::written::{WrittenNet, weighted};
use pcl2_lang::net::{BoxId, Gate, Kind, NetBox};

/// What stands for a box or a gate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Symbol {
    State,
    Capacity,
    Time,
    Count,
    Operation,
    Signal,
    Process,
    Generation,
    Entry,
    Exit,
    Macro,
    Gate,
    /// What empties a macro.
    Abort,
}

/// A box or a gate.
pub(crate) struct Node {
    pub(crate) symbol: Symbol,
    pub(crate) name: String,
    /// What stands below the name.
    pub(crate) lines: Vec<String>,
    /// All that there is to say.
    pub(crate) tip: String,
    /// Tokens at the start.
    pub(crate) tokens: u32,
    /// The number in the symbol: room, or how many are counted.
    pub(crate) number: String,
    pub(crate) priority: i32,
    /// Arcs that no line shows.
    pub(crate) tags: Vec<Tag>,
}

/// What an arc does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum ArcKind {
    Take,
    Put,
    Read,
    Inhibit,
}

/// An arc between a box and a gate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arc {
    pub(crate) kind: ArcKind,
    pub(crate) place: usize,
    pub(crate) gate: usize,
    pub(crate) weight: u32,
}

/// A name in place of an arc: of a box at a gate, of a gate at a box.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Tag {
    pub(crate) kind: ArcKind,
    /// Tokens move from the tag to the symbol that it stands at.
    pub(crate) inwards: bool,
    pub(crate) text: String,
}

/// A net without those inside it.
pub(crate) struct Graph {
    /// Boxes, then gates, then what empties macros.
    pub(crate) nodes: Vec<Node>,
    pub(crate) arcs: Vec<Arc>,
}

impl ArcKind {
    /// Whether tokens move along it.
    pub(crate) fn moves(self) -> bool {
        match self {
            ArcKind::Take | ArcKind::Put => true,
            ArcKind::Read | ArcKind::Inhibit => false,
        }
    }
}

/// Reads a net.
pub(crate) fn graph(nets: &[WrittenNet<'_>], written: &WrittenNet<'_>) -> Graph {
    let net = written.net;
    let mut graph = Graph { nodes: Vec::new(), arcs: Vec::new() };
    for (i, place) in net.boxes.iter().enumerate() {
        graph.nodes.push(place_node(written, i, place));
    }
    let mut gates: Vec<&Gate> = net.gates.iter().collect();
    gates.sort_by_key(|gate| gate.span.start);
    for gate in gates {
        graph.gate(nets, written, gate);
    }
    for part in &net.parts {
        if let (Some(place), Some(abort)) = (part.place, &part.abort) {
            let gate = graph.nodes.len();
            graph.nodes.push(node(Symbol::Abort, "ABORT", texts::abort(written, part, abort)));
            graph.arcs.push(Arc { kind: ArcKind::Take, place: place.0 as usize, gate, weight: 1 });
            graph.arcs.push(Arc { kind: ArcKind::Put, place: abort.to.0 as usize, gate, weight: 1 });
        }
    }
    graph
}

fn node(symbol: Symbol, name: &str, (lines, tip): (Vec<String>, String)) -> Node {
    let name = name.to_owned();
    Node { symbol, name, lines, tip, tokens: 0, number: String::new(), priority: 0, tags: Vec::new() }
}

fn place_node(written: &WrittenNet<'_>, index: usize, place: &NetBox) -> Node {
    let (entry, exit) = (written.net.entry, written.net.exit);
    let is = |end: Option<BoxId>| end.is_some_and(|end| end.0 as usize == index);
    let symbol = match &place.kind {
        Kind::State if is(entry) => Symbol::Entry,
        Kind::State if is(exit) => Symbol::Exit,
        Kind::State => Symbol::State,
        Kind::Capacity => Symbol::Capacity,
        Kind::Time(_) => Symbol::Time,
        Kind::Count => Symbol::Count,
        Kind::Action(_) if written.words[index] == "SIGNAL" => Symbol::Signal,
        Kind::Action(_) => Symbol::Operation,
        Kind::Process(_) => Symbol::Process,
        Kind::Generation(_) => Symbol::Generation,
        Kind::Macro(_) => Symbol::Macro,
    };
    let mut node = node(symbol, &place.name, texts::place(written, index, place));
    node.tokens = place.initial;
    node.number = match (symbol, place.capacity) {
        (Symbol::Capacity, None) => "∞".to_owned(),
        (Symbol::Capacity | Symbol::Count | Symbol::Generation, Some(room)) => room.to_string(),
        _ => String::new(),
    };
    node
}

impl Graph {
    fn gate(&mut self, nets: &[WrittenNet<'_>], written: &WrittenNet<'_>, gate: &Gate) {
        let index = self.nodes.len();
        let tested = [&gate.reads, &gate.inhibits].map(|tested| written.tested(nets, tested));
        let mut node = node(Symbol::Gate, &gate.name, texts::gate(written, gate, tested));
        node.priority = gate.priority;
        let plain = [(ArcKind::Take, &gate.before), (ArcKind::Put, &gate.after)];
        for (kind, arcs) in plain {
            for arc in arcs {
                self.arcs.push(Arc { kind, place: arc.place.0 as usize, gate: index, weight: arc.weight });
            }
        }
        for (kind, tested) in [(ArcKind::Read, &gate.reads), (ArcKind::Inhibit, &gate.inhibits)] {
            for test in tested {
                match test.part {
                    Some(_) => node.tags.push(Tag { kind, inwards: true, text: written.test(nets, test) }),
                    None => {
                        self.arcs.push(Arc { kind, place: test.place.0 as usize, gate: index, weight: test.weight });
                    }
                }
            }
        }
        self.nodes.push(node);
    }

    /// Makes a tag at the gate of an arc.
    pub(crate) fn tag_gate(&mut self, arc: &Arc) {
        let text = weighted(arc.weight, &self.nodes[arc.place].name);
        self.nodes[arc.gate].tags.push(Tag { kind: arc.kind, inwards: arc.kind != ArcKind::Put, text });
    }

    /// Makes a tag at the box of an arc.
    pub(crate) fn tag_place(&mut self, arc: &Arc) {
        let text = weighted(arc.weight, &self.nodes[arc.gate].name);
        self.nodes[arc.place].tags.push(Tag { kind: arc.kind, inwards: arc.kind == ArcKind::Put, text });
    }
}
