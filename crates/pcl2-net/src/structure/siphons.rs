//! Siphons and traps: sets of places that stay empty once they are empty, and sets that stay marked once they are.
//!
//! A siphon: each transition that puts into it also takes from it or reads in it. A trap: each transition that takes
//! from it also puts into it, or reads more in it than it takes there. Both sentences about staying hold with any
//! weights, and inhibitors only take firings away.
//!
//! A capacity that the P-invariants do not keep anyway is a place of its own: the room that is left. Putting takes room
//! and taking puts it. An inhibitor of a place with room reads that room.

use crate::pt::{PlaceId, PtNet, Transition};
use crate::structure::invariants::{p_invariants, place_bounds};
use crate::structure::part::{ARC_KINDS, arcs};
use fixedbitset::FixedBitSet;
use std::collections::{BTreeMap, VecDeque};

/// What a siphon or a trap consists of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Member {
    /// The tokens of a place.
    Tokens(PlaceId),
    /// What is left of a place's capacity.
    Room(PlaceId),
}

/// Members in order, places first.
pub type Siphon = Vec<Member>;

/// How many rows the search for P-invariants may take that finds the capacities which need no room.
const ROWS_FOR_BOUNDS: usize = 2000;

/// The minimal siphons, sorted. `None`, not known: more than `limit` sets would have to be looked at.
pub fn minimal_siphons(net: &PtNet, limit: usize) -> Option<Vec<Siphon>> {
    search(&Flow::new(net), false, limit)
}

/// The minimal traps, sorted. `None` as above.
pub fn minimal_traps(net: &PtNet, limit: usize) -> Option<Vec<Siphon>> {
    search(&Flow::new(net).reversed(), false, limit)
}

/// The minimal siphons without a trap that is marked at the start, sorted: those that nothing in the structure keeps
/// from becoming empty. `None` as above.
///
/// In an ordinary net (all weights 1, no inhibitors) a dead marking has an empty siphon, and so a net without such
/// siphons has no deadlock. With other weights a siphon that is marked too thinly is enough for a deadlock, and an empty
/// answer says only that no siphon can become empty.
pub fn siphons_that_can_empty(net: &PtNet, limit: usize) -> Option<Vec<Siphon>> {
    search(&Flow::new(net), true, limit)
}

/// Whether an empty answer of [`siphons_that_can_empty`] excludes a deadlock.
pub fn is_ordinary(net: &PtNet) -> bool {
    let ordinary = |transition: &Transition| {
        let arcs = transition.takes.iter().chain(&transition.puts).chain(&transition.reads);
        transition.inhibits.is_empty() && arcs.map(|arc| arc.weight).all(|weight| weight == 1)
    };
    net.transitions.iter().all(ordinary)
}

/// A net as far as siphons see it. Nodes are places, then the rooms that count.
#[derive(Clone, Debug, Default)]
struct Flow {
    members: Vec<Member>,
    marked: FixedBitSet,
    /// Of each transition the nodes that it takes from or reads in.
    inputs: Vec<Vec<u32>>,
    /// Of each transition the nodes that it puts into or reads in.
    outputs: Vec<Vec<u32>>,
    /// The transitions by their inputs, and by their outputs.
    readers: Vec<Vec<u32>>,
    writers: Vec<Vec<u32>>,
}

impl Flow {
    fn new(net: &PtNet) -> Flow {
        let mut flow = Flow::default();
        let rooms = flow.add_members(net);
        for transition in &net.transitions {
            let (inputs, outputs) = ends(transition, &rooms);
            flow.inputs.push(inputs);
            flow.outputs.push(outputs);
        }
        flow.readers = by_node(&flow.inputs, flow.members.len());
        flow.writers = by_node(&flow.outputs, flow.members.len());
        flow
    }

    /// Of each place the node of its room, and its capacity, if it has one that counts.
    fn add_members(&mut self, net: &PtNet) -> Vec<Option<Room>> {
        let without = net.places.iter().all(|place| place.capacity.is_none());
        let kept = if without { None } else { p_invariants(net, ROWS_FOR_BOUNDS) };
        let kept = kept.map(|invariants| place_bounds(&uncapped(net), &invariants));
        let initial = |i: usize| net.places[i].initial;
        self.members = (0..net.places.len() as u32).map(|i| Member::Tokens(PlaceId(i))).collect();
        let mut marked: Vec<bool> = (0..net.places.len()).map(|i| initial(i) > 0).collect();
        let mut rooms = vec![None; net.places.len()];
        for (i, place) in net.places.iter().enumerate() {
            let Some(capacity) = place.capacity else {
                continue;
            };
            let bound = kept.as_ref().and_then(|bounds| bounds[i]);
            if bound.is_none_or(|bound| bound > capacity) {
                rooms[i] = Some(Room { node: self.members.len() as u32, capacity });
                self.members.push(Member::Room(PlaceId(i as u32)));
                marked.push(initial(i) < capacity);
            }
        }
        self.marked = (0..marked.len()).filter(|node| marked[*node]).collect();
        self.marked.grow(marked.len());
        rooms
    }

    /// Traps are the siphons of the net with all arcs turned round.
    fn reversed(self) -> Flow {
        let Flow { members, marked, inputs, outputs, readers, writers } = self;
        Flow { members, marked, inputs: outputs, outputs: inputs, readers: writers, writers: readers }
    }

    /// The largest siphon within a set: a node that gets tokens from outside the set is no part of it.
    fn largest_siphon(&self, within: &FixedBitSet) -> FixedBitSet {
        self.shrinking_siphon(within).set
    }

    fn shrinking_siphon(&self, within: &FixedBitSet) -> Shrinking<'_> {
        Shrinking::new(within, &self.outputs, &self.readers, &self.writers)
    }

    /// The largest trap within a set.
    fn largest_trap(&self, within: &FixedBitSet) -> FixedBitSet {
        Shrinking::new(within, &self.inputs, &self.writers, &self.readers).set
    }

    fn has_marked_trap(&self, within: &FixedBitSet) -> bool {
        !self.largest_trap(within).is_disjoint(&self.marked)
    }

    /// Whether a siphon has no smaller one within it.
    fn is_minimal(&self, siphon: &FixedBitSet) -> bool {
        let mut rest = siphon.clone();
        siphon.ones().all(|node| {
            rest.set(node, false);
            let minimal = self.largest_siphon(&rest).is_clear();
            rest.insert(node);
            minimal
        })
    }
}

#[derive(Clone, Copy, Debug)]
struct Room {
    node: u32,
    capacity: u64,
}

/// The nodes that a transition needs, and those that it leaves marked for sure.
fn ends(transition: &Transition, rooms: &[Option<Room>]) -> (Vec<u32>, Vec<u32>) {
    let mut inputs = Vec::new();
    let mut outputs = Vec::new();
    let mut note = |node: u32, taken: u64, put: u64, read: u64| {
        inputs.extend((taken > 0 || read > 0).then_some(node));
        // What is read may be taken by the same transition.
        outputs.extend((put > 0 || read > taken).then_some(node));
    };
    for (place, [taken, put, read, blocked]) in weights(transition) {
        note(place.0, taken, put, read);
        if let Some(room) = rooms[place.0 as usize] {
            let seen = if blocked == 0 { 0 } else { (room.capacity.saturating_add(1)).saturating_sub(blocked) };
            note(room.node, put.saturating_sub(taken), taken.saturating_sub(put), seen);
        }
    }
    (inputs, outputs)
}

/// The weights of a transition's arcs by place, in the order of [`ARC_KINDS`].
fn weights(transition: &Transition) -> BTreeMap<PlaceId, [u64; ARC_KINDS.len()]> {
    let mut weights: BTreeMap<PlaceId, [u64; ARC_KINDS.len()]> = BTreeMap::new();
    for (i, kind) in ARC_KINDS.into_iter().enumerate() {
        for arc in arcs(transition, kind) {
            weights.entry(arc.place).or_default()[i] = arc.weight;
        }
    }
    weights
}

fn by_node(nodes: &[Vec<u32>], count: usize) -> Vec<Vec<u32>> {
    let mut transitions = vec![Vec::new(); count];
    for (transition, nodes) in nodes.iter().enumerate() {
        nodes.iter().for_each(|node| transitions[*node as usize].push(transition as u32));
    }
    transitions
}

/// The same net, all capacities without limit.
fn uncapped(net: &PtNet) -> PtNet {
    let mut net = net.clone();
    net.places.iter_mut().for_each(|place| place.capacity = None);
    net
}

/// The largest siphon within a set from which nodes go one by one. Only what touches the set is looked at: most sets
/// are small.
struct Shrinking<'f> {
    set: FixedBitSet,
    /// By transition its inputs in the set.
    fed: Vec<u32>,
    outputs: &'f [Vec<u32>],
    readers: &'f [Vec<u32>],
}

impl<'f> Shrinking<'f> {
    fn new(
        within: &FixedBitSet,
        outputs: &'f [Vec<u32>],
        readers: &'f [Vec<u32>],
        writers: &[Vec<u32>],
    ) -> Shrinking<'f> {
        let mut fed = vec![0; outputs.len()];
        within.ones().flat_map(|node| &readers[node]).for_each(|reader| fed[*reader as usize] += 1);
        let mut starved = VecDeque::new();
        for writer in within.ones().flat_map(|node| &writers[node]) {
            if fed[*writer as usize] == 0 {
                // It has no input to lose: once is enough.
                fed[*writer as usize] = u32::MAX;
                starved.push_back(*writer);
            }
        }
        let mut shrinking = Shrinking { set: within.clone(), fed, outputs, readers };
        shrinking.starve(starved);
        shrinking
    }

    fn remove(&mut self, node: usize) {
        let mut starved = VecDeque::new();
        self.take(node, &mut starved);
        self.starve(starved);
    }

    /// Removes the outputs of transitions without an input, until none is left.
    fn starve(&mut self, mut starved: VecDeque<u32>) {
        let outputs = self.outputs;
        while let Some(transition) = starved.pop_front() {
            outputs[transition as usize].iter().for_each(|node| self.take(*node as usize, &mut starved));
        }
    }

    fn take(&mut self, node: usize, starved: &mut VecDeque<u32>) {
        if !self.set.contains(node) {
            return;
        }
        self.set.set(node, false);
        for reader in &self.readers[node] {
            let fed = &mut self.fed[*reader as usize];
            *fed -= 1;
            if *fed == 0 {
                starved.push_back(*reader);
            }
        }
    }
}

/// A part of the search: siphons with all of one set and nothing outside another, which is the largest siphon there.
struct Branch {
    with: FixedBitSet,
    allowed: FixedBitSet,
}

/// Each minimal siphon stands in exactly one branch: of the inputs that a transition may have in it, the first that is
/// in it decides.
fn search(flow: &Flow, unprotected: bool, limit: usize) -> Option<Vec<Siphon>> {
    let nodes = flow.members.len();
    let mut left = limit;
    let mut found = Vec::new();
    let mut all = FixedBitSet::with_capacity(nodes);
    all.insert_range(..);
    let mut behind = flow.shrinking_siphon(&all);
    for first in 0..nodes {
        let mut with = FixedBitSet::with_capacity(nodes);
        with.insert(first);
        let mut open = vec![Branch { with, allowed: behind.set.clone() }];
        while let Some(branch) = open.pop() {
            left = left.checked_sub(1)?;
            match look(flow, branch, unprotected) {
                Look::Siphon(siphon) => found.push(siphon.ones().map(|node| flow.members[node]).collect()),
                Look::Branches(branches) => open.extend(branches),
            }
        }
        behind.remove(first);
    }
    found.sort();
    Some(found)
}

enum Look {
    Siphon(FixedBitSet),
    Branches(Vec<Branch>),
}

fn look(flow: &Flow, branch: Branch, unprotected: bool) -> Look {
    let none = Look::Branches(Vec::new());
    let Branch { with, mut allowed } = branch;
    if !with.is_subset(&allowed) || (unprotected && flow.has_marked_trap(&with)) {
        return none;
    }
    let inner = flow.largest_siphon(&with);
    if !inner.is_clear() {
        let minimal = inner == with && flow.is_minimal(&inner);
        return if minimal { Look::Siphon(inner) } else { none };
    }
    let Some(choices) = fewest_choices(flow, &with, &allowed) else {
        return none;
    };
    let mut branches = Vec::with_capacity(choices.len());
    for node in choices {
        let mut with = with.clone();
        with.insert(node);
        let within = if branches.is_empty() { allowed.clone() } else { flow.largest_siphon(&allowed) };
        branches.push(Branch { with, allowed: within });
        allowed.set(node, false);
    }
    Look::Branches(branches)
}

/// The inputs that may stand for the transition with the fewest of them, of those that put into a set and have no input
/// in it.
fn fewest_choices(flow: &Flow, with: &FixedBitSet, allowed: &FixedBitSet) -> Option<Vec<usize>> {
    let writers = with.ones().flat_map(|node| &flow.writers[node]).map(|writer| *writer as usize);
    let unfed = writers.filter(|writer| !flow.inputs[*writer].iter().any(|node| with.contains(*node as usize)));
    let choices = |writer: usize| {
        let nodes = flow.inputs[writer].iter().map(|node| *node as usize);
        nodes.filter(|node| allowed.contains(*node)).collect::<Vec<_>>()
    };
    unfed.map(|writer| (choices(writer).len(), writer)).min().map(|(_, writer)| choices(writer))
}
