//! Which places can hold any number of tokens scan by scan: what is proved of it.
//!
//! A run of steps that comes back to at least the tokens that it began with, and to more in some places, can go on so without
//! end if none of its steps depends on how many more there are: what fires asks for no room in places that grow, and what
//! must not fire is blocked by something else than too few tokens there. What is not proved so is not known.

use super::rules::{Rule, Rules};
use super::steps::Phase;
use crate::pt::{MOST, PlaceId, PtNet};
use rustc_hash::FxHashSet;

/// Tokens of places that all markings may have together, and that may be compared.
const TOKENS: usize = 1 << 22;
const COMPARISONS: usize = 1 << 26;

/// The most steps from one marking: many free transitions can fire in many ways.
const STEPS: usize = 64;

/// The places among some that are proved to be unbounded, by runs among so many markings.
pub fn growing(net: &PtNet, among: &[PlaceId], limit: usize) -> Vec<PlaceId> {
    let rules = Rules::new(net);
    let initial: Vec<u64> = net.places.iter().map(|place| place.initial).collect();
    let mut search = Search {
        nodes: Vec::new(),
        known: FxHashSet::default(),
        grown: (0..rules.places).map(|place| !among.contains(&PlaceId(place as u32))).collect(),
        comparisons: COMPARISONS,
        limit: limit.min(TOKENS / initial.len().max(1)).max(1),
    };
    search.run(&rules, initial);
    among.iter().copied().filter(|place| search.grown[place.0 as usize]).collect()
}

/// A marking, and the step that led to it.
struct Node {
    before: Option<usize>,
    fired: Vec<u32>,
    marking: Vec<u64>,
}

struct Search {
    nodes: Vec<Node>,
    known: FxHashSet<Vec<u64>>,
    /// By place: whether it is known to be unbounded, or nobody asks.
    grown: Vec<bool>,
    comparisons: usize,
    limit: usize,
}

impl Search {
    /// Goes breadth first; `None`: it was too much.
    fn run(&mut self, rules: &Rules, initial: Vec<u64>) -> Option<()> {
        self.known.insert(initial.clone());
        self.nodes.push(Node { before: None, fired: Vec::new(), marking: initial });
        let mut next = 0;
        while next < self.nodes.len() && self.grown.contains(&false) {
            for (fired, marking) in steps(rules, &self.nodes[next].marking)? {
                if self.known.insert(marking.clone()) {
                    self.nodes.push(Node { before: Some(next), fired, marking });
                    self.compare(rules, self.nodes.len() - 1)?;
                }
                if self.nodes.len() >= self.limit {
                    return None;
                }
            }
            next += 1;
        }
        Some(())
    }

    /// Looks for a marking on the way to a new one from which the run can go on without end.
    fn compare(&mut self, rules: &Rules, last: usize) -> Option<()> {
        let mut at = self.nodes[last].before;
        while let Some(first) = at {
            let (now, then) = (&self.nodes[last].marking, &self.nodes[first].marking);
            self.comparisons = self.comparisons.checked_sub(now.len())?;
            at = self.nodes[first].before;
            if !now.iter().zip(then).all(|(now, then)| now >= then) {
                continue;
            }
            let more: Vec<bool> = now.iter().zip(then).map(|(now, then)| now > then).collect();
            let is_new = more.iter().zip(&self.grown).any(|(more, known)| *more && !known);
            if is_new && self.goes_on(rules, (first, last), &more)? {
                self.grown.iter_mut().zip(more).for_each(|(known, more)| *known |= more);
            }
        }
        Some(())
    }

    /// Whether all steps between two markings can be made with any number of tokens more in some places.
    fn goes_on(&mut self, rules: &Rules, (first, last): (usize, usize), more: &[bool]) -> Option<bool> {
        let mut at = last;
        while at != first {
            let Node { before, fired, .. } = &self.nodes[at];
            let before = (*before)?;
            self.comparisons = self.comparisons.checked_sub(rules.list.len())?;
            if !holds(rules, &self.nodes[before].marking, fired, more) {
                return Some(false);
            }
            at = before;
        }
        Some(true)
    }
}

/// Whether a step can be made with any number of tokens more in some places: what fires can fire, and what does not may
/// let it be or cannot.
fn holds(rules: &Rules, marking: &[u64], fired: &[u32], more: &[bool]) -> bool {
    let mut phase = Phase::of(rules, marking);
    (0_u32..).zip(&rules.list).all(|(transition, rule)| {
        if !fired.contains(&transition) {
            return rule.free || is_blocked(&phase, rule, more);
        }
        phase.fire(rules, transition);
        rule.below.iter().chain(&rule.room).all(|(place, _)| !more[*place])
    })
}

/// Whether a transition cannot fire, however many more tokens stand in some places: there it lacks none.
fn is_blocked(phase: &Phase, rule: &Rule, more: &[bool]) -> bool {
    let lacks = |list: &[(usize, u64)], tokens: &[u64]| {
        list.iter().any(|(place, weight)| !more[*place] && tokens[*place] < *weight)
    };
    rule.never
        || lacks(&rule.reads, &phase.start)
        || lacks(&rule.takes, &phase.left)
        || rule.below.iter().any(|(place, most)| phase.start[*place] > *most)
        || phase.is_closed(rule)
}

/// The steps from a marking, and where they lead; not all if there are many. `None`: the tokens cannot be counted.
fn steps(rules: &Rules, marking: &[u64]) -> Option<Vec<(Vec<u32>, Vec<u64>)>> {
    let lacks = |(place, weight): &(usize, u64)| marking[*place] < *weight;
    let exceeds = |(place, most): &(usize, u64)| marking[*place] > *most;
    let enabled = (0_u32..).zip(&rules.list).filter(|(_, rule)| {
        let lower = rule.takes.iter().chain(&rule.reads).any(lacks);
        !rule.never && !lower && !rule.below.iter().chain(&rule.room).any(exceeds)
    });
    let enabled: Vec<u32> = enabled.map(|(transition, _)| transition).collect();
    let mut phase = Phase::of(rules, marking);
    let (mut steps, mut first) = (Vec::new(), Some(0));
    while let Some(at) = first.filter(|_| steps.len() < STEPS) {
        phase.advance(rules, &enabled, at);
        let fired: Vec<u32> = phase.fired.iter().map(|at| enabled[*at]).collect();
        if !fired.is_empty() {
            let after = after(rules, marking, &fired)?;
            steps.push((fired, after));
        }
        first = phase.retreat(rules, &enabled);
    }
    Some(steps)
}

/// The marking after a step.
fn after(rules: &Rules, marking: &[u64], fired: &[u32]) -> Option<Vec<u64>> {
    let mut sums: Vec<i128> = marking.iter().map(|tokens| i128::from(*tokens)).collect();
    for (place, change) in fired.iter().flat_map(|transition| &rules.list[*transition as usize].change) {
        sums[*place] += i128::from(*change);
    }
    sums.into_iter().map(|sum| u64::try_from(sum).ok().filter(|tokens| *tokens <= MOST)).collect()
}
