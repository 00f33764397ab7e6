//! Which places can hold any number of tokens: the tree of Karp and Miller.
//!
//! In a marking of the tree a place may hold [`ANY`] number of tokens: as many as are wanted can be brought there. A branch
//! that comes to at least the tokens of a marking before it can repeat what lies between, without end. Capacities and
//! inhibitors ask for few tokens, so a branch may be repeated only if it leaves their places as they were; such a place is
//! never found to be unbounded, and if it is, the tree does not end by itself.

use super::rules::{Rule, Rules};
use crate::pt::{MOST, PlaceId, PtNet};
use rustc_hash::FxHashSet;

/// Any number of tokens.
const ANY: u64 = u64::MAX;

/// What a tree tells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cover {
    /// The tree is whole.
    pub complete: bool,
    /// The places that were found to be unbounded; all of them in a whole tree.
    pub unbounded: Vec<PlaceId>,
    /// By transition: whether it can fire; all that can in a whole tree.
    pub fired: Vec<bool>,
}

/// Tokens of places that all nodes of a tree may have together, and that may be compared.
const TOKENS: usize = 1 << 22;
const COMPARISONS: usize = 1 << 29;

/// Builds the tree, of at most so many nodes.
pub fn cover(net: &PtNet, limit: usize) -> Cover {
    let rules = Rules::new(net);
    let initial: Vec<u64> = net.places.iter().map(|place| place.initial).collect();
    let mut tree = Tree {
        exact: exact(&rules),
        nodes: Vec::new(),
        known: FxHashSet::default(),
        fired: vec![false; rules.list.len()],
        comparisons: COMPARISONS,
        limit: limit.min(TOKENS / initial.len().max(1)).max(1),
    };
    let complete = tree.grow(&rules, initial).is_some();
    let is_unbounded = |place: usize| tree.nodes.iter().any(|node| node.marking[place] == ANY);
    let unbounded = (0..rules.places).filter(|place| is_unbounded(*place)).map(|place| PlaceId(place as u32)).collect();
    Cover { complete, unbounded, fired: tree.fired }
}

/// The places that some transition wants to hold few tokens.
fn exact(rules: &Rules) -> Vec<bool> {
    let mut exact = vec![false; rules.places];
    rules.list.iter().flat_map(Rule::upper).for_each(|(place, _)| exact[place] = true);
    exact
}

#[derive(Clone, Debug)]
struct Node {
    before: Option<usize>,
    marking: Vec<u64>,
}

struct Tree {
    exact: Vec<bool>,
    nodes: Vec<Node>,
    known: FxHashSet<Vec<u64>>,
    fired: Vec<bool>,
    comparisons: usize,
    limit: usize,
}

impl Tree {
    /// Grows the tree to its end, or gives up.
    fn grow(&mut self, rules: &Rules, initial: Vec<u64>) -> Option<()> {
        let bounds: Vec<_> = rules.list.iter().map(|rule| (rule.lower(), rule.upper())).collect();
        self.add(None, initial)?;
        let mut open = vec![0];
        while let Some(node) = open.pop() {
            for (transition, rule) in rules.list.iter().enumerate() {
                let marking = &self.nodes[node].marking;
                let (lower, upper) = &bounds[transition];
                let enabled = !rule.never
                    && lower.iter().all(|(place, least)| marking[*place] >= *least)
                    && upper.iter().all(|(place, most)| marking[*place] <= *most);
                if enabled {
                    self.fired[transition] = true;
                    let mut after = fire(rule, marking)?;
                    self.accelerate(node, &mut after)?;
                    open.extend(self.add(Some(node), after)?);
                }
            }
        }
        Some(())
    }

    /// Adds a node, unless there is one with its marking.
    fn add(&mut self, before: Option<usize>, marking: Vec<u64>) -> Option<Option<usize>> {
        if !self.known.insert(marking.clone()) {
            return Some(None);
        }
        self.nodes.push(Node { before, marking });
        (self.nodes.len() <= self.limit).then(|| Some(self.nodes.len() - 1))
    }

    /// Any number of tokens where a marking on the way to a new one had fewer, and no more elsewhere.
    fn accelerate(&mut self, last: usize, marking: &mut [u64]) -> Option<()> {
        let mut at = Some(last);
        while let Some(node) = at {
            let Node { before, marking: earlier } = &self.nodes[node];
            self.comparisons = self.comparisons.checked_sub(marking.len())?;
            let pairs = || marking.iter().zip(earlier).zip(&self.exact);
            if pairs().all(|((now, then), exact)| if *exact { now == then } else { now >= then }) {
                let more: Vec<usize> = (0..marking.len()).filter(|place| marking[*place] > earlier[*place]).collect();
                more.into_iter().for_each(|place| marking[place] = ANY);
            }
            at = *before;
        }
        Some(())
    }
}

/// The marking after an enabled transition, if its numbers can be counted.
fn fire(rule: &Rule, marking: &[u64]) -> Option<Vec<u64>> {
    let mut after = marking.to_vec();
    for (place, change) in &rule.change {
        if after[*place] != ANY {
            after[*place] = after[*place].checked_add_signed(*change).filter(|tokens| *tokens <= MOST)?;
        }
    }
    Some(after)
}
