//! The state equation x(k+1) = x(k) + B f(k) for given firings, with a check whether they could have happened.

use crate::pt::{PlaceId, PtNet, TransitionId};
use crate::structure::names::{self, Names};
use crate::structure::step::{Phase, Reason, missing};

/// What fires in a scan: transitions in their order within it, each with how often.
pub type Scan = Vec<(TransitionId, u64)>;

/// When a transition of a scan is enabled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Together: all see the marking at the scan's start, and none uses what another one puts.
    Step,
    /// One after the other: each sees what the earlier ones left.
    Interleaving,
}

/// What to do about a transition that is not enabled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OnBlocked {
    /// End before its scan.
    Refuse,
    /// Note it, and follow the equation all the same.
    Note,
}

/// What became of the firings.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Run {
    /// The marking at the start, and after each scan. Below zero only after a blocked firing.
    pub markings: Vec<Vec<i128>>,
    /// The firings that could not have happened.
    pub blocked: Vec<Blocked>,
}

/// A firing that could not have happened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Blocked {
    /// In this scan, counted from 0.
    pub scan: usize,
    /// The transition.
    pub transition: TransitionId,
    /// The first thing that it misses.
    pub reason: Reason,
}

impl Blocked {
    /// A sentence in the names of the net. As in a table, scans count from 1: 0 is the start.
    pub fn message(&self, net: &PtNet) -> String {
        let name = names::transition(net, self.transition);
        format!("scan {}: `{name}` is not enabled: {}", self.scan + 1, self.reason.in_names(net))
    }
}

/// The first marking of a net.
pub fn initial(net: &PtNet) -> Vec<i128> {
    net.places.iter().map(|place| i128::from(place.initial)).collect()
}

/// A scan from names, in their order. A name that stands twice fires twice.
pub fn by_names<'n>(names: &Names<'_>, fired: impl IntoIterator<Item = &'n str>) -> Result<Scan, String> {
    fired.into_iter().map(|name| Ok((names.transition(name)?, 1))).collect()
}

/// A scan from a firing vector: a number for each transition of the net. Within the scan they fire in the net's order.
pub fn by_vector(net: &PtNet, counts: &[u64]) -> Result<Scan, String> {
    let expected = net.transitions.len();
    if counts.len() != expected {
        return Err(format!("expected a firing vector of {expected} numbers, found {}", counts.len()));
    }
    let scan = names::transition_ids(net).zip(counts.iter().copied());
    Ok(scan.filter(|(_, count)| *count > 0).collect())
}

/// Fires scan after scan from a marking with a number for each place.
pub fn fire(net: &PtNet, start: &[i128], scans: &[Scan], rule: Rule, on_blocked: OnBlocked) -> Result<Run, String> {
    let expected = net.places.len();
    if start.len() != expected {
        return Err(format!("expected a marking of {expected} numbers, found {}", start.len()));
    }
    if let Some(tokens) = start.iter().find(|tokens| !is_countable(**tokens)) {
        return Err(format!("expected tokens below 2^120, found {tokens}"));
    }
    let mut marking = start.to_vec();
    let mut run = Run { markings: vec![marking.clone()], blocked: Vec::new() };
    for (k, scan) in scans.iter().enumerate() {
        let mut next = marking.clone();
        let reasons = match rule {
            Rule::Step => together(net, &marking, scan),
            Rule::Interleaving => in_turn(net, &marking, scan).map_err(|error| format!("scan {}: {error}", k + 1))?,
        };
        let blocked = reasons.into_iter().map(|(transition, reason)| Blocked { scan: k, transition, reason });
        run.blocked.extend(blocked);
        if on_blocked == OnBlocked::Refuse && !run.blocked.is_empty() {
            return Ok(run);
        }
        for (id, count) in scan {
            change(net, &mut next, *id, *count).map_err(|error| format!("scan {}: {error}", k + 1))?;
        }
        run.markings.push(next.clone());
        marking = next;
    }
    Ok(run)
}

/// What is not enabled on the marking at the scan's start.
fn together(net: &PtNet, start: &[i128], scan: &Scan) -> Vec<(TransitionId, Reason)> {
    let mut phase = Phase::new(net, start);
    let mut blocked = Vec::new();
    for (id, count) in scan {
        // The second firing of a gate is refused, however often it would be repeated.
        for _ in 0..(*count).min(2) {
            blocked.extend(phase.blocked(*id).map(|reason| (*id, reason)));
            phase.fire(*id);
        }
    }
    blocked
}

/// What is not enabled when its turn comes.
fn in_turn(net: &PtNet, start: &[i128], scan: &Scan) -> Result<Vec<(TransitionId, Reason)>, String> {
    let mut marking = start.to_vec();
    let mut blocked = Vec::new();
    for (id, count) in scan.iter().filter(|(_, count)| *count > 0) {
        // Markings change linearly from one repetition to the next: between a first and a last that are enabled all are.
        let first = blocked_now(net, &marking, *id);
        change(net, &mut marking, *id, count - 1)?;
        blocked.extend(first.or_else(|| blocked_now(net, &marking, *id)).map(|reason| (*id, reason)));
        change(net, &mut marking, *id, 1)?;
    }
    Ok(blocked)
}

fn blocked_now(net: &PtNet, marking: &[i128], id: TransitionId) -> Option<Reason> {
    let seen = |place: PlaceId| marking[place.0 as usize];
    missing(net, id, seen, seen, |place, capacity| i128::from(capacity) - seen(place))
}

/// x + B f for one transition.
fn change(net: &PtNet, marking: &mut [i128], id: TransitionId, count: u64) -> Result<(), String> {
    let transition = &net.transitions[id.0 as usize];
    let signed = transition.takes.iter().map(|arc| (arc, -1)).chain(transition.puts.iter().map(|arc| (arc, 1)));
    for (arc, sign) in signed {
        let tokens = &mut marking[arc.place.0 as usize];
        let moved = i128::from(arc.weight).checked_mul(i128::from(count)).map(|moved| moved * sign);
        *tokens = moved
            .and_then(|moved| tokens.checked_add(moved))
            .filter(|tokens| is_countable(*tokens))
            .ok_or_else(|| format!("`{}` gets more tokens than can be counted", names::place(net, arc.place)))?;
    }
    Ok(())
}

/// Far from the ends of what 128 bits hold, so that sums of a few weights stay within them.
fn is_countable(tokens: i128) -> bool {
    tokens.unsigned_abs() < 1 << 120
}
