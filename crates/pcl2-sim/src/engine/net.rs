//! Nets in the embedded engine: what they keep, and what the player of the runtime is handed.

use super::Unsupported;
use super::place::{Body, Fill, Node, Store, width_of};
use crate::ffi::{Answer, NetPlan, Script, Slot};
use pcl2_lang::net::table::{self, Table};
use pcl2_lang::net::{Net, PartId};
use pcl2_lang::program::{Program, Role, SignalId, Unit};
use pcl2_lang::types::Scalar;
use std::ops::Range;

/// What a net keeps beside its signals.
#[derive(Debug)]
pub(crate) struct NetStore {
    /// The table of the net.
    table: Table,
    /// The arrays in the order of [`NetPlan::arrays`].
    arrays: Vec<Slot>,
    /// Where each word is.
    words: Vec<usize>,
    /// Where the attributes of tokens in hand are.
    hands: Vec<usize>,
}

/// The signals that a net keeps begin behind its ports.
fn first_held(unit: &Unit) -> usize {
    unit.signals.iter().position(|signal| signal.role == Role::Held).unwrap_or(unit.signals.len())
}

impl<'a> Store<'a> {
    /// Places what a net keeps.
    pub(crate) fn net(&mut self, net: &'a Net, body: &Body) -> Result<NetStore, Unsupported> {
        let program = self.program;
        let inner = |part: PartId| inner_net(program, body, net, part);
        let table = table::table(net, &inner);
        let held = first_held(program.unit(body.unit));
        let words: Vec<usize> = (0..net.words.len()).map(|i| body.signals[held + i]).collect();
        let tokens = body.signals.get(held + net.words.len()).copied().unwrap_or(super::place::NOWHERE);
        let hands = (0..table.hands).map(|i| body.signals[held + net.words.len() + 1 + i]).collect();
        for (word, place) in net.words.iter().zip(&words) {
            self.fills.push((*place, Fill::Value(word.scalar, 1, &word.initial)));
        }
        for (i, place) in net.boxes.iter().enumerate() {
            self.fills.push((tokens + i * 4, Fill::Int(i32::try_from(place.initial).unwrap_or(i32::MAX))));
        }
        let arrays = self.arrays(net, &table, tokens)?;
        Ok(NetStore { table, arrays, words, hands })
    }

    fn arrays(&mut self, net: &Net, table: &Table, tokens: usize) -> Result<Vec<Slot>, Unsupported> {
        let (boxes, words, actives) = (net.boxes.len() * 4, net.words.len() * 4, net.actives.len());
        // A net of parts alone has no boxes of its own.
        let tokens = if boxes == 0 { self.take(8)? } else { tokens };
        let mut arrays = vec![Slot { at: tokens, bytes: boxes }];
        let real = width_of(Scalar::Real, self.program.width);
        let sizes =
            [boxes, boxes, boxes, boxes, boxes, boxes, boxes * 2, table.ints.len() * 4, table.reals.len() * real];
        let modes: &[usize] = if net.operation.is_some() { &[8, 4, 4, 4] } else { &[] };
        for bytes in sizes.into_iter().chain([words, actives * 4, actives * 8, 4, 4]).chain(modes.iter().copied()) {
            arrays.push(Slot { at: self.take(bytes.max(8))?, bytes: bytes.max(8) });
        }
        for (i, value) in table.ints.iter().enumerate() {
            self.fills.push((arrays[INTS].at + i * 4, Fill::Int(*value)));
        }
        for (i, value) in table.reals.iter().enumerate() {
            self.fills.push((arrays[REALS].at + i * real, Fill::Real(*value)));
        }
        Ok(arrays)
    }
}

/// The places of some arrays in [`NetStore::arrays`].
const INTS: usize = 8;
const REALS: usize = 9;

fn inner_net<'a>(program: &'a Program, body: &Body, net: &Net, part: PartId) -> Option<(&'a Net, usize)> {
    let statement = net.parts.get(part.0 as usize)?.statement;
    let node = body.nodes.get(statement.0 as usize)?;
    Some((program.decl(node.decl).net.as_deref()?, count(node)))
}

/// How many nets a net is made of, itself included.
fn count(node: &Node) -> usize {
    let inner = node.inner.iter().flat_map(|body| &body.nodes).filter(|node| node.net.is_some());
    1 + inner.map(count).sum::<usize>()
}

/// What the player is handed of a net; statements and parts are filled in as they are wired.
pub(crate) fn plan(store: &NetStore, status: usize, period: i64) -> NetPlan {
    NetPlan {
        table: store.table.words.clone(),
        arrays: store.arrays.clone(),
        words: store.words.clone(),
        hands: store.hands.clone(),
        outer: None,
        inputs: 0,
        scripts: Vec::new(),
        latch: 0..0,
        status,
        period,
    }
}

/// A statement that was wired: what is done, its result, and the reals that it reads.
pub(crate) fn script(ops: Range<usize>, unit: &Unit, node: &Node, index: usize, reals: Vec<usize>) -> Script {
    let block = &unit.blocks[index];
    let scalar = block.outputs.first().map(|id: &SignalId| unit.signal(*id).ty.scalar);
    let at = node.outputs.first().copied().filter(|at| *at != super::place::NOWHERE);
    let answer = match (at, scalar) {
        (Some(at), Some(Scalar::Int)) => Answer::Int(at),
        (Some(at), Some(Scalar::Real)) => Answer::Real(at),
        _ => Answer::None,
    };
    Script { ops, answer, reals }
}
