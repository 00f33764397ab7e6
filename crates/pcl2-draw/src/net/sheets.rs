//! What is drawn together: boxes and gates that tokens connect. Arcs that would run far are tags at their gates.

use super::layers;
use super::model::{Arc, Graph, Symbol};

/// A box with more arcs on which tokens move goes by name at all its gates.
const BOX_ARCS: usize = 16;
/// A box that has more arcs without lines does not name their gates.
const BOX_TAGS: usize = 3;
/// A gate has at most so many arcs on which tokens move; further boxes go by name.
const GATE_ARCS: usize = 24;
/// The most nodes of a sheet.
const NODES: usize = 800;
/// The most layers of a sheet: what runs on goes on in the next sheet.
const LAYERS: usize = 40;
/// A sheet with a few more is not cut.
const WHOLE: usize = 52;
/// The longest arc that only looks, in layers.
const LOOK: usize = 3;
/// The most layers that the arcs of a sheet pass; beyond it long ones go by name.
const PASSES: usize = 3000;
/// What is a long arc then, in layers.
const LONG: usize = 12;

/// Nodes with the arcs between them.
#[derive(Default)]
pub(crate) struct Sheet {
    /// Indexes of nodes, in ascending order.
    pub(crate) nodes: Vec<usize>,
    /// The layer of each: even for boxes, odd for gates.
    pub(crate) layers: Vec<usize>,
    pub(crate) arcs: Vec<Arc>,
}

impl Sheet {
    /// The node's place in the sheet.
    pub(crate) fn local(&self, node: usize) -> Option<usize> {
        self.nodes.binary_search(&node).ok()
    }

    /// How many layers an arc spans, up or down.
    fn length(&self, arc: &Arc) -> usize {
        let layer = |node| self.local(node).map_or(0, |node| self.layers[node]);
        layer(arc.place).abs_diff(layer(arc.gate))
    }
}

/// Divides a net. Arcs without a line become tags.
pub(crate) fn divide(graph: &mut Graph) -> Vec<Sheet> {
    let arcs = std::mem::take(&mut graph.arcs);
    let busy = busy(graph, &arcs);
    let (lines, mut named): (Vec<Arc>, Vec<Arc>) = partition(arcs, &busy);
    let groups = groups(graph, &lines);
    let (lines, between): (Vec<Arc>, Vec<Arc>) =
        lines.into_iter().partition(|arc| groups[arc.place] == groups[arc.gate]);
    named.extend(between);
    let mut sheets = Vec::new();
    for whole in sheets_of(graph, &groups, lines) {
        for mut sheet in cut(whole, &mut named) {
            named.extend(shorten(&mut sheet));
            sheets.push(sheet);
        }
    }
    named.sort_by_key(|arc| (!arc.kind.moves(), arc.gate));
    let counts = counts(graph, &named);
    for arc in &named {
        graph.tag_gate(arc);
        if arc.kind.moves() && counts[arc.place] <= BOX_TAGS {
            graph.tag_place(arc);
        }
    }
    sheets
}

/// By box: on how many arcs tokens move.
fn counts(graph: &Graph, arcs: &[Arc]) -> Vec<usize> {
    let mut counts = vec![0; graph.nodes.len()];
    for arc in arcs.iter().filter(|arc| arc.kind.moves()) {
        counts[arc.place] += 1;
    }
    counts
}

/// By arc: whether its box or its gate has too many.
fn busy(graph: &Graph, arcs: &[Arc]) -> Vec<bool> {
    let mut counts = counts(graph, arcs);
    let mut busy = Vec::with_capacity(arcs.len());
    for arc in arcs {
        let by_name = counts[arc.place] > BOX_ARCS || (arc.kind.moves() && counts[arc.gate] == GATE_ARCS);
        counts[arc.gate] += usize::from(arc.kind.moves() && !by_name);
        busy.push(by_name);
    }
    busy
}

fn partition(arcs: Vec<Arc>, busy: &[bool]) -> (Vec<Arc>, Vec<Arc>) {
    let (mut lines, mut named) = (Vec::new(), Vec::new());
    for (arc, busy) in arcs.into_iter().zip(busy) {
        if *busy { named.push(arc) } else { lines.push(arc) }
    }
    (lines, named)
}

/// For each node the group that it is drawn with.
fn groups(graph: &Graph, arcs: &[Arc]) -> Vec<usize> {
    let mut near: Vec<Vec<usize>> = vec![Vec::new(); graph.nodes.len()];
    for arc in arcs.iter().filter(|arc| arc.kind.moves()) {
        near[arc.place].push(arc.gate);
        near[arc.gate].push(arc.place);
    }
    let mut groups = vec![usize::MAX; graph.nodes.len()];
    let (mut group, mut size) = (0, 0);
    for first in 0..graph.nodes.len() {
        let mut open = vec![first];
        while let Some(node) = open.pop() {
            if groups[node] != usize::MAX {
                continue;
            }
            if size == NODES {
                (group, size) = (group + 1, 0);
            }
            (groups[node], size) = (group, size + 1);
            open.extend(near[node].iter().rev());
        }
        if size > 0 {
            (group, size) = (group + 1, 0);
        }
    }
    groups
}

fn sheets_of(graph: &Graph, groups: &[usize], arcs: Vec<Arc>) -> Vec<Sheet> {
    let count = groups.iter().max().map_or(0, |last| last + 1);
    let mut sheets: Vec<Sheet> = (0..count).map(|_| Sheet::default()).collect();
    for (node, group) in groups.iter().enumerate() {
        sheets[*group].nodes.push(node);
    }
    for arc in arcs {
        sheets[groups[arc.place]].arcs.push(arc);
    }
    for sheet in &mut sheets {
        sheet.layers = layers::assign(graph, sheet);
    }
    sheets
}

/// Cuts a sheet of many layers between a gate and what comes after it.
fn cut(whole: Sheet, named: &mut Vec<Arc>) -> Vec<Sheet> {
    let last = whole.layers.iter().copied().max().unwrap_or(0);
    if last < WHOLE {
        return vec![whole];
    }
    let band = |node: usize| whole.local(node).map_or(0, |node| whole.layers[node] / LAYERS);
    let mut bands: Vec<Sheet> = (0..=last / LAYERS).map(|_| Sheet::default()).collect();
    for (node, layer) in whole.nodes.iter().zip(&whole.layers) {
        let sheet = &mut bands[layer / LAYERS];
        sheet.nodes.push(*node);
        sheet.layers.push(layer % LAYERS);
    }
    for arc in &whole.arcs {
        let (place, gate) = (band(arc.place), band(arc.gate));
        if place == gate { bands[place].arcs.push(*arc) } else { named.push(*arc) }
    }
    bands
}

/// Takes long arcs away.
fn shorten(sheet: &mut Sheet) -> Vec<Arc> {
    let passes: usize = sheet.arcs.iter().map(|arc| sheet.length(arc)).sum();
    let arcs = std::mem::take(&mut sheet.arcs);
    let most = |arc: &Arc| match arc.kind.moves() {
        true if passes <= PASSES => usize::MAX,
        true => LONG,
        false => LOOK,
    };
    let (near, far) = arcs.into_iter().partition(|arc| sheet.length(arc) <= most(arc));
    sheet.arcs = near;
    far
}

/// Where tokens begin: the nodes of a sheet in the order in which ways are followed from them.
pub(crate) fn beginnings(graph: &Graph, sheet: &Sheet) -> Vec<usize> {
    let rank = |node: &usize| {
        let node = &graph.nodes[sheet.nodes[*node]];
        match node.symbol {
            Symbol::Entry => 0,
            _ if node.tokens > 0 => 1,
            Symbol::Generation => 2,
            Symbol::Gate | Symbol::Abort => 4,
            Symbol::State | Symbol::Capacity | Symbol::Time | Symbol::Count | Symbol::Operation => 3,
            Symbol::Signal | Symbol::Process | Symbol::Exit | Symbol::Macro => 3,
        }
    };
    let mut order: Vec<usize> = (0..sheet.nodes.len()).collect();
    order.sort_by_key(rank);
    order
}
