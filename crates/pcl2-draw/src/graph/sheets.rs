//! What is drawn together. A small program is one sheet with a lane for each section. A large one has sheets of its
//! own for what hangs together within a section; long and wide nets go by name there, so that sheets stay small.

use super::layers;
use super::netlist::Netlist;
use pcl2_lang::program::Program;
use std::collections::BTreeMap;

/// The most blocks of a program on one sheet.
const WHOLE: usize = 60;
/// The most nets between sections on one sheet.
const CROSSINGS: usize = 16;
/// The most layers of a sheet.
const LAYERS: usize = 12;
/// The most nodes of a sheet in a program of several.
const NODES: usize = 60;
/// A net with more readers goes by name in a program of several sheets.
const READERS: usize = 6;
/// A net with more readers goes by name on a single sheet, too.
const READERS_WHOLE: usize = 16;

/// Sheets and how they are put together.
pub(crate) struct Plan {
    pub(crate) sheets: Vec<Sheet>,
    pub(crate) layout: Layout,
}

/// How sheets are put together.
pub(crate) enum Layout {
    /// One sheet with a lane for each section.
    Lanes,
    /// For each section how many sheets it has, in order.
    Packed(Vec<usize>),
}

/// Nodes that are drawn together with the wires between them.
pub(crate) struct Sheet {
    /// In order of execution.
    pub(crate) nodes: Vec<usize>,
    /// The layer of each.
    pub(crate) layers: Vec<usize>,
    /// The lane of each.
    pub(crate) lanes: Vec<usize>,
    /// The nets with a wire on this sheet.
    pub(crate) nets: Vec<usize>,
}

/// Divides a program. Readers that no wire reaches get a flag.
pub(crate) fn plan(program: &Program, list: &mut Netlist) -> Plan {
    let nodes: Vec<usize> = (0..list.nodes.len()).collect();
    let nets: Vec<usize> = (0..list.nets.len()).collect();
    if nodes.len() <= WHOLE && crossings(list) <= CROSSINGS {
        let layers = layers::assign(list, &nodes, &nets);
        if layers.iter().all(|layer| *layer < LAYERS) {
            flag_wide(list, READERS_WHOLE);
            let lanes = nodes.iter().map(|node| list.nodes[*node].section).collect();
            return Plan { sheets: vec![sheet(list, nodes, layers, lanes, nets)], layout: Layout::Lanes };
        }
    }
    flag_between(list, &nodes.iter().map(|node| list.nodes[*node].section).collect::<Vec<_>>());
    flag_wide(list, READERS);
    let rows = rows(list, &nodes, &nets);
    flag_between(list, &rows);
    let pieces = pieces(list, &rows);
    flag_between(list, &pieces);
    packed(program, list, &pieces)
}

/// Nets that cross between sections.
fn crossings(list: &Netlist) -> usize {
    let section = |node: usize| list.nodes[node].section;
    let crosses =
        |net: &&super::netlist::Net| net.sinks.iter().any(|sink| section(sink.node) != section(net.source.node));
    list.nets.iter().filter(crosses).count()
}

/// Readers in another group than the writer get a flag.
fn flag_between(list: &mut Netlist, groups: &[usize]) {
    for net in &list.nets {
        for sink in net.sinks.iter().filter(|sink| groups[sink.node] != groups[net.source.node]) {
            list.nodes[sink.node].pins[sink.pin].flag = true;
        }
    }
}

/// All readers of a net with many get a flag.
fn flag_wide(list: &mut Netlist, limit: usize) {
    for net in list.nets.iter().filter(|net| net.sinks.len() > limit) {
        for sink in &net.sinks {
            list.nodes[sink.node].pins[sink.pin].flag = true;
        }
    }
}

/// Sections of many layers are cut into rows, one below the other. Rows of different sections differ.
fn rows(list: &Netlist, nodes: &[usize], nets: &[usize]) -> Vec<usize> {
    let layers = layers::assign(list, nodes, nets);
    let most = layers.iter().max().map_or(1, |most| most / LAYERS + 1);
    nodes.iter().map(|node| list.nodes[*node].section * most + layers[*node] / LAYERS).collect()
}

/// What hangs together and is too large for a sheet is cut into pieces: nodes near each other by wires stay together.
fn pieces(list: &Netlist, rows: &[usize]) -> Vec<usize> {
    let parts = parts(list);
    let mut counts = vec![0; list.nodes.len()];
    let mut pieces = vec![0; list.nodes.len()];
    for node in sources_first(list) {
        let count = &mut counts[parts[node]];
        pieces[node] = *count / NODES;
        *count += 1;
    }
    let most = pieces.iter().max().map_or(1, |most| most + 1);
    rows.iter().zip(pieces).map(|(row, piece)| row * most + piece).collect()
}

/// All nodes, each behind what it reads by wire: depth first from the last ones back.
fn sources_first(list: &Netlist) -> Vec<usize> {
    let mut order = Vec::with_capacity(list.nodes.len());
    let mut seen = vec![false; list.nodes.len()];
    for last in (0..list.nodes.len()).rev() {
        let mut open = vec![(last, false)];
        while let Some((node, done)) = open.pop() {
            if done {
                order.push(node);
            } else if !std::mem::replace(&mut seen[node], true) {
                open.push((node, true));
                let pins = list.nodes[node].pins.iter().rev().filter(|pin| !pin.flag && !pin.back);
                let sources = pins.filter_map(|pin| pin.net).map(|net| list.nets[net].source.node);
                open.extend(sources.filter(|source| !seen[*source]).map(|source| (source, false)));
            }
        }
    }
    order
}

/// Sheets of what hangs together by wires, piece by piece in order of their first nodes.
fn packed(program: &Program, list: &Netlist, pieces: &[usize]) -> Plan {
    let parts = parts(list);
    let mut groups: BTreeMap<(usize, usize), Vec<usize>> = BTreeMap::new();
    for node in 0..list.nodes.len() {
        groups.entry((pieces[node], parts[node])).or_default().push(node);
    }
    let mut nets = BTreeMap::<usize, Vec<usize>>::new();
    for net in 0..list.nets.len() {
        nets.entry(parts[list.nets[net].source.node]).or_default().push(net);
    }
    let mut counts = vec![0; program.sections.len()];
    let mut sheets = Vec::new();
    for ((_, part), nodes) in groups {
        counts[list.nodes[nodes[0]].section] += 1;
        let nets = nets.remove(&part).unwrap_or_default();
        let layers = layers::assign(list, &nodes, &nets);
        let lanes = vec![0; nodes.len()];
        sheets.push(sheet(list, nodes, layers, lanes, nets));
    }
    Plan { sheets, layout: Layout::Packed(counts) }
}

/// For each node the least node that it hangs together with.
fn parts(list: &Netlist) -> Vec<usize> {
    let mut parts: Vec<usize> = (0..list.nodes.len()).collect();
    for net in 0..list.nets.len() {
        for sink in list.wired(net) {
            let (a, b) = (root(&mut parts, list.nets[net].source.node), root(&mut parts, sink.node));
            parts[a.max(b)] = a.min(b);
        }
    }
    (0..parts.len()).map(|node| root(&mut parts, node)).collect()
}

fn root(parts: &mut [usize], mut node: usize) -> usize {
    while parts[node] != node {
        parts[node] = parts[parts[node]];
        node = parts[node];
    }
    node
}

/// A sheet of these nodes, with those nets that have a wire.
fn sheet(list: &Netlist, nodes: Vec<usize>, layers: Vec<usize>, lanes: Vec<usize>, nets: Vec<usize>) -> Sheet {
    let nets = nets.into_iter().filter(|net| list.wired(*net).next().is_some()).collect();
    Sheet { nodes, layers, lanes, nets }
}
