//! Which node stands in which layer: a reader of this scan's value right of its writer, as near as can be.

use super::netlist::Netlist;

/// The layer of each of these nodes, which stand in order of execution. Wires of other nodes, return wires and
/// reads of the previous scan's value do not count, so what is left has no loops.
pub(crate) fn assign(list: &Netlist, nodes: &[usize], nets: &[usize]) -> Vec<usize> {
    let edges = edges(list, nodes, nets);
    let mut layers = vec![0; nodes.len()];
    for (node, readers) in edges.iter().enumerate() {
        for reader in readers {
            layers[*reader] = layers[*reader].max(layers[node] + 1);
        }
    }
    let mut incoming = vec![0; nodes.len()];
    for reader in edges.iter().flatten() {
        incoming[*reader] += 1;
    }
    // A node with more readers than sources moves towards its readers: its wires get shorter.
    for node in (0..nodes.len()).rev() {
        let nearest = edges[node].iter().map(|reader| layers[*reader]).min();
        if let Some(nearest) = nearest.filter(|_| edges[node].len() > incoming[node]) {
            layers[node] = nearest - 1;
        }
    }
    let first = layers.iter().copied().min().unwrap_or(0);
    layers.iter().map(|layer| layer - first).collect()
}

/// For each node its readers, both as places in the list of nodes.
fn edges(list: &Netlist, nodes: &[usize], nets: &[usize]) -> Vec<Vec<usize>> {
    let mut edges = vec![Vec::new(); nodes.len()];
    for net in nets.iter().filter(|net| !list.nets[**net].is_return) {
        let Ok(source) = nodes.binary_search(&list.nets[*net].source.node) else {
            continue;
        };
        for sink in list.wired(*net).filter(|sink| !list.pin(*sink).delayed) {
            if let Ok(reader) = nodes.binary_search(&sink.node) {
                if reader > source {
                    edges[source].push(reader);
                }
            }
        }
    }
    edges
}
