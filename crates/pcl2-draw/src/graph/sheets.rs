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
    if nodes.len() <= WHOLE && crossings(list) <= CROSSINGS {
        let layers = layers::assign(list, &nodes);
        if layers.iter().all(|layer| *layer < LAYERS) {
            flag_wide(list, READERS_WHOLE);
            let lanes = nodes.iter().map(|node| list.nodes[*node].section).collect();
            let nets = (0..list.nets.len()).collect();
            return Plan { sheets: finish(list, vec![(nodes, layers, lanes, nets)]), layout: Layout::Lanes };
        }
    }
    flag_between(list, &nodes.iter().map(|node| list.nodes[*node].section).collect::<Vec<_>>());
    flag_wide(list, READERS);
    let rows = rows(list, &nodes);
    flag_between(list, &rows);
    packed(program, list, &rows)
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
fn rows(list: &Netlist, nodes: &[usize]) -> Vec<usize> {
    let layers = layers::assign(list, nodes);
    let most = layers.iter().max().map_or(1, |most| most / LAYERS + 1);
    nodes.iter().map(|node| list.nodes[*node].section * most + layers[*node] / LAYERS).collect()
}

/// Sheets of what hangs together by wires, row by row in order of their first nodes.
fn packed(program: &Program, list: &Netlist, rows: &[usize]) -> Plan {
    let parts = parts(list);
    let mut groups: BTreeMap<(usize, usize), Vec<usize>> = BTreeMap::new();
    for node in 0..list.nodes.len() {
        groups.entry((rows[node], parts[node])).or_default().push(node);
    }
    let mut counts = vec![0; program.sections.len()];
    let mut sheets = Vec::new();
    let mut nets = BTreeMap::<usize, Vec<usize>>::new();
    for net in (0..list.nets.len()).filter(|net| list.wired(*net).next().is_some()) {
        nets.entry(parts[list.nets[net].source.node]).or_default().push(net);
    }
    for ((_, part), nodes) in groups {
        counts[list.nodes[nodes[0]].section] += 1;
        let layers = layers::assign(list, &nodes);
        let lanes = vec![0; nodes.len()];
        sheets.push((nodes, layers, lanes, nets.remove(&part).unwrap_or_default()));
    }
    Plan { sheets: finish(list, sheets), layout: Layout::Packed(counts) }
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

type Loose = (Vec<usize>, Vec<usize>, Vec<usize>, Vec<usize>);

fn finish(list: &Netlist, sheets: Vec<Loose>) -> Vec<Sheet> {
    let sheet = |(nodes, layers, lanes, nets): Loose| {
        let nets = nets.into_iter().filter(|net| list.wired(*net).next().is_some()).collect();
        Sheet { nodes, layers, lanes, nets }
    };
    sheets.into_iter().map(sheet).collect()
}
