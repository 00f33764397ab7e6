//! Which node stands in which layer: tokens run down, boxes in even layers and gates in odd ones.

use super::model::{ArcKind, Graph, Symbol};
use super::sheets::{self, Sheet};

/// The layer of each node of a sheet.
pub(crate) fn assign(graph: &Graph, sheet: &Sheet) -> Vec<usize> {
    let ways = ways(graph, sheet);
    let (order, ways) = forward(&sheets::beginnings(graph, sheet), ways);
    let is_gate = |node: usize| matches!(graph.nodes[sheet.nodes[node]].symbol, Symbol::Gate | Symbol::Abort);
    let mut layers: Vec<usize> = (0..sheet.nodes.len()).map(|node| usize::from(is_gate(node))).collect();
    let mut incoming = vec![0; layers.len()];
    for node in &order {
        for next in &ways[*node] {
            layers[*next] = layers[*next].max(layers[*node] + 1);
            incoming[*next] += 1;
        }
    }
    // A node that more tokens leave than enter moves down to them: its arcs get shorter.
    for node in order.iter().rev() {
        let nearest = ways[*node].iter().map(|next| layers[*next]).min();
        if let Some(nearest) = nearest.filter(|_| ways[*node].len() > incoming[*node]) {
            layers[*node] = nearest - 1;
        }
    }
    let first = layers.iter().copied().min().unwrap_or(0) / 2 * 2;
    layers.iter().map(|layer| layer - first).collect()
}

/// For each node where its tokens go. What leads to a box that is marked at the start leads back.
fn ways(graph: &Graph, sheet: &Sheet) -> Vec<Vec<usize>> {
    let mut ways = vec![Vec::new(); sheet.nodes.len()];
    for arc in &sheet.arcs {
        if let (Some(place), Some(gate)) = (sheet.local(arc.place), sheet.local(arc.gate)) {
            match arc.kind {
                ArcKind::Take => ways[place].push(gate),
                ArcKind::Put if graph.nodes[arc.place].tokens > 0 => {}
                ArcKind::Put => ways[gate].push(place),
                ArcKind::Read | ArcKind::Inhibit => {}
            }
        }
    }
    ways
}

/// The nodes in an order in which ways lead forward, and the ways without those that lead back.
fn forward(beginnings: &[usize], ways: Vec<Vec<usize>>) -> (Vec<usize>, Vec<Vec<usize>>) {
    let mut order = Vec::with_capacity(ways.len());
    let mut kept: Vec<Vec<usize>> = vec![Vec::new(); ways.len()];
    // Not seen yet; how many of its ways are followed; done.
    let mut state = vec![State::New; ways.len()];
    for first in beginnings {
        let mut path = Vec::new();
        if state[*first] == State::New {
            state[*first] = State::Open;
            path.push((*first, 0));
        }
        while let Some((node, followed)) = path.last_mut() {
            let Some(next) = ways[*node].get(*followed) else {
                state[*node] = State::Done;
                order.push(*node);
                path.pop();
                continue;
            };
            *followed += 1;
            match state[*next] {
                State::Open => continue,
                State::New | State::Done => kept[*node].push(*next),
            }
            if state[*next] == State::New {
                state[*next] = State::Open;
                path.push((*next, 0));
            }
        }
    }
    order.reverse();
    (order, kept)
}

/// How far a node is followed.
#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    New,
    Open,
    Done,
}
