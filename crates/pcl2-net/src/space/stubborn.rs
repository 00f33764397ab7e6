//! Stubborn sets: in each marking only as many transitions are fired as are needed to reach all dead markings.
//!
//! A set of transitions is stubborn if nothing outside it can enable a disabled member, and if enabled members and what is
//! outside neither disable each other. Then, whatever outsiders do, a member can still fire first and lead to the same
//! marking, so no way to a dead marking is lost. Each node of a graph demands others: an enabled transition demands what
//! may disturb it and what it may disturb; a disabled one demands what changes one of the places that block it to the
//! better. Whatever is reached from a node is stubborn.

use super::interleaving::Interleaving;
use super::layout::Layout;
use super::moves::{Halt, Moves};
use super::rules::{Rule, Rules};
use super::words::Words;

/// Interleaving, reduced to stubborn sets.
#[derive(Debug)]
pub(super) struct Stubborn<'a> {
    layout: &'a Layout,
    all: Interleaving<'a>,
    graph: Graph<'a>,
    search: Search,
}

impl<'a> Stubborn<'a> {
    /// Packs the rules.
    pub(super) fn new(rules: &'a Rules, layout: &'a Layout, bounds: &[Option<u64>]) -> Stubborn<'a> {
        let graph = Graph::new(rules);
        let search = Search { order: vec![0; rules.list.len() + graph.of_place.len()], ..Search::default() };
        Stubborn { layout, all: Interleaving::new(rules, layout, bounds), graph, search }
    }
}

impl Moves for Stubborn<'_> {
    fn each<K: Words, F: Words>(
        &mut self,
        from: &F,
        _: u64,
        to: &mut impl FnMut(&[u64], &[u32], u64) -> Result<(), Halt>,
    ) -> Result<u64, Halt> {
        let words = from.words();
        self.all.look(words)?;
        let marking = Marking { layout: self.layout, words, enabled: &self.all.enabled };
        let members = self.search.smallest(&self.graph, &marking);
        let mut key = K::zeros(self.layout.key);
        for transition in members {
            key.words_mut().copy_from_slice(&words[..K::length(self.layout.key)]);
            self.all.changes.fire(*transition, key.words_mut());
            to(key.words(), std::slice::from_ref(transition), 0)?;
        }
        Ok(members.len() as u64)
    }
}

/// A marking, with its enabled transitions in order.
struct Marking<'a> {
    layout: &'a Layout,
    words: &'a [u64],
    enabled: &'a [u32],
}

impl Marking<'_> {
    fn tokens(&self, place: usize) -> u64 {
        self.layout.fields[place].get(self.words)
    }

    fn enables(&self, transition: u32) -> bool {
        self.enabled.binary_search(&transition).is_ok()
    }
}

/// What a transition has to do with a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    /// It puts more than it takes.
    Raises,
    /// It takes more than it puts.
    Lowers,
    /// It needs a least number of tokens.
    NeedsTokens,
    /// It needs a most number of tokens.
    NeedsRoom,
}

/// The nodes: first the transitions, then for each place its sides. A side demands all transitions that have it.
#[derive(Debug)]
struct Graph<'a> {
    rules: &'a Rules,
    bounds: Vec<Bounds>,
    of_place: Vec<Vec<u32>>,
}

/// At least, and at most, so many tokens, by place.
#[derive(Clone, Debug)]
struct Bounds {
    lower: Vec<(usize, u64)>,
    upper: Vec<(usize, u64)>,
}

const SIDES: usize = 4;

impl<'a> Graph<'a> {
    fn new(rules: &'a Rules) -> Graph<'a> {
        let bounds = rules.list.iter().map(|rule| Bounds { lower: rule.lower(), upper: rule.upper() }).collect();
        let mut graph = Graph { rules, bounds, of_place: vec![Vec::new(); rules.places * SIDES] };
        for (transition, rule) in (0_u32..).zip(&rules.list) {
            let bounds = &graph.bounds[transition as usize];
            let mut sides: Vec<(usize, Side)> = changed(rule, Side::Raises, Side::Lowers).collect();
            sides.extend(bounds.lower.iter().map(|(place, _)| (*place, Side::NeedsTokens)));
            sides.extend(bounds.upper.iter().map(|(place, _)| (*place, Side::NeedsRoom)));
            sides.into_iter().for_each(|(place, side)| graph.of_place[place * SIDES + side as usize].push(transition));
        }
        graph
    }

    fn node(&self, place: usize, side: Side) -> u32 {
        (self.rules.list.len() + place * SIDES + side as usize) as u32
    }

    /// Adds the nodes that a node demands.
    fn demands(&self, node: u32, marking: &Marking<'_>, list: &mut Vec<u32>) {
        let transitions = self.rules.list.len();
        if node as usize >= transitions {
            list.extend(&self.of_place[node as usize - transitions]);
        } else if marking.enables(node) {
            let bounds = &self.bounds[node as usize];
            list.extend(bounds.lower.iter().map(|(place, _)| self.node(*place, Side::Lowers)));
            list.extend(bounds.upper.iter().map(|(place, _)| self.node(*place, Side::Raises)));
            let hinders = changed(&self.rules.list[node as usize], Side::NeedsRoom, Side::NeedsTokens);
            list.extend(hinders.map(|(place, side)| self.node(place, side)));
        } else if !self.rules.list[node as usize].never {
            list.extend(self.remedy(node, marking));
        }
    }

    /// The changes of a place that blocks a disabled transition; of several the place that the fewest change.
    fn remedy(&self, transition: u32, marking: &Marking<'_>) -> Option<u32> {
        let bounds = &self.bounds[transition as usize];
        let lacks = bounds.lower.iter().filter(|(place, least)| marking.tokens(*place) < *least);
        let full = bounds.upper.iter().filter(|(place, most)| marking.tokens(*place) > *most);
        let remedies = lacks.map(|(place, _)| self.node(*place, Side::Raises));
        let remedies = remedies.chain(full.map(|(place, _)| self.node(*place, Side::Lowers)));
        remedies.min_by_key(|node| self.of_place[*node as usize - self.rules.list.len()].len())
    }
}

/// The places that a rule changes, with a side for more and one for less.
fn changed(rule: &Rule, more: Side, less: Side) -> impl Iterator<Item = (usize, Side)> + '_ {
    rule.change.iter().map(move |(place, change)| (*place, if *change > 0 { more } else { less }))
}

/// The order of a node whose component is done, and of one that has or reaches enabled transitions.
const DONE: u32 = u32::MAX - 1;
const DONE_ENABLED: u32 = u32::MAX;

/// A search for strongly connected components (Tarjan's algorithm, with a stack of its own). A component with enabled
/// transitions from which no other such component is reached has the enabled transitions of a stubborn set.
#[derive(Debug, Default)]
struct Search {
    /// By node: when it was entered, from 1; 0: not yet.
    order: Vec<u32>,
    entered: Vec<u32>,
    /// Nodes whose component is not done.
    open: Vec<u32>,
    frames: Vec<Frame>,
    /// What the nodes of the frames demand.
    demands: Vec<u32>,
    best: Vec<u32>,
}

#[derive(Clone, Copy, Debug)]
struct Frame {
    node: u32,
    /// Where its demands begin, and where the next one is.
    begin: usize,
    next: usize,
    /// The earliest open node that it is known to reach.
    low: u32,
    /// It reaches enabled transitions in another component.
    needs_more: bool,
}

impl Search {
    /// The enabled transitions of a stubborn set; of the sets that are found, the smallest.
    fn smallest(&mut self, graph: &Graph<'_>, marking: &Marking<'_>) -> &[u32] {
        self.entered.iter().for_each(|node| self.order[*node as usize] = 0);
        self.entered.clear();
        self.best.clear();
        for root in marking.enabled {
            if self.best.len() == 1 {
                break;
            }
            if self.order[*root as usize] == 0 {
                self.enter(*root, graph, marking);
                self.visit(graph, marking);
            }
        }
        &self.best
    }

    fn enter(&mut self, node: u32, graph: &Graph<'_>, marking: &Marking<'_>) {
        self.entered.push(node);
        let order = self.entered.len() as u32;
        self.order[node as usize] = order;
        self.open.push(node);
        let begin = self.demands.len();
        graph.demands(node, marking, &mut self.demands);
        self.frames.push(Frame { node, begin, next: begin, low: order, needs_more: false });
    }

    fn visit(&mut self, graph: &Graph<'_>, marking: &Marking<'_>) {
        while let Some(frame) = self.frames.last_mut() {
            let Some(demanded) = self.demands.get(frame.next).copied() else {
                self.leave(graph, marking);
                continue;
            };
            frame.next += 1;
            match self.order[demanded as usize] {
                0 => self.enter(demanded, graph, marking),
                DONE => {}
                DONE_ENABLED => frame.needs_more = true,
                order => frame.low = frame.low.min(order),
            }
        }
    }

    /// Takes away the last frame, and its component if it was entered there.
    fn leave(&mut self, graph: &Graph<'_>, marking: &Marking<'_>) {
        let Some(frame) = self.frames.pop() else { return };
        self.demands.truncate(frame.begin);
        let is_root = frame.low == self.order[frame.node as usize];
        let has_enabled = is_root && self.close(frame, graph, marking);
        if let Some(parent) = self.frames.last_mut() {
            parent.low = parent.low.min(frame.low);
            parent.needs_more |= frame.needs_more || has_enabled;
        }
    }

    /// Ends a component. Whether it has enabled transitions.
    fn close(&mut self, root: Frame, graph: &Graph<'_>, marking: &Marking<'_>) -> bool {
        let first = self.open.iter().rposition(|open| *open == root.node).unwrap_or(0);
        let members = self.open.split_off(first);
        let is_enabled = |node: &u32| (*node as usize) < graph.rules.list.len() && marking.enables(*node);
        let mut enabled: Vec<u32> = members.iter().copied().filter(is_enabled).collect();
        let order = if root.needs_more || !enabled.is_empty() { DONE_ENABLED } else { DONE };
        members.iter().for_each(|member| self.order[*member as usize] = order);
        let has_enabled = !enabled.is_empty();
        if has_enabled && !root.needs_more && (self.best.is_empty() || enabled.len() < self.best.len()) {
            enabled.sort_unstable();
            self.best = enabled;
        }
        has_enabled
    }
}
