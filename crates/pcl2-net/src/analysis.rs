//! All that is found out about a net: first from its structure, then from a search for dead markings, then from its
//! reachable markings.

use crate::pt::{PlaceId, PtNet, TransitionId};
use crate::space::{self, Cover, Deadlock, Explorer, Limit, Semantics, Space};
use crate::structure::conflicts::{self, Conflict};
use crate::structure::invariants::{self, Invariant};
use crate::structure::siphons::{self, Siphon};

/// The most rows that the search for invariants may hold.
const MOST_ROWS: usize = 2000;

/// The most sets that the search for siphons may look at, and the places and transitions in all of them.
const MOST_SETS: usize = 20_000;
const SETS_WORK: usize = 4_000_000;

/// The most pairs of transitions whose conflicts are looked at closely.
const MOST_PAIRS: usize = 1_000_000;

/// The most markings of a net that is unbounded, and the most nodes of its coverability tree.
const MOST_UNBOUNDED: usize = 1_000_000;

/// Nodes of a first coverability tree, and markings of a net of which it does not say whether it is bounded.
const FEW_NODES: usize = 2000;
const MOST_UNDECIDED: usize = 4_000_000;

/// The most markings that a search for dead ones alone may find: before all are looked at, and if that was too many.
const FEW_REDUCED: usize = 10_000;
const MOST_REDUCED: usize = 1_000_000;

/// What is known of a net. `None`: not known.
#[derive(Clone, Debug)]
pub struct Analysis {
    /// The minimal P-invariants.
    pub p_invariants: Option<Vec<Invariant<PlaceId>>>,
    /// The minimal T-invariants.
    pub t_invariants: Option<Vec<Invariant<TransitionId>>>,
    /// The minimal siphons without a trap that is marked at the start.
    pub siphons: Option<Vec<Siphon>>,
    /// Transitions that want the same tokens or room, so that their order decides.
    pub conflicts: Vec<Conflict>,
    /// By place: the most tokens that it can hold, by its capacity and the P-invariants.
    pub bounds: Vec<Option<u64>>,
    /// Whether there are most tokens for each place.
    pub bounded: Option<bool>,
    /// The places without.
    pub unbounded: Option<Vec<PlaceId>>,
    /// Those that are proved to be, although there may be more.
    pub proved_unbounded: Vec<PlaceId>,
    /// Whether a dead marking is reachable.
    pub deadlock: Option<bool>,
    /// A way to it: the transitions of each step. The shortest, if all reachable markings up to it were looked at.
    pub path: Option<Vec<Vec<TransitionId>>>,
    /// The transitions that never fire.
    pub dead_transitions: Option<Vec<TransitionId>>,
    /// By transition: whether it can fire again, whatever happens.
    pub live: Option<Vec<bool>>,
    /// Whether every reachable marking leads back to the first one.
    pub reversible: Option<bool>,
    /// What the reachable markings say.
    pub space: Space,
}

/// Finds out all about a net. `progress` is told from time to time how many markings were found.
pub fn analyze(net: &PtNet, semantics: Semantics, limit: Limit, progress: &mut dyn FnMut(u64)) -> Analysis {
    let p_invariants = invariants::p_invariants(net, MOST_ROWS);
    let known = p_invariants.as_deref().unwrap_or(&[]);
    let bounds = invariants::place_bounds(net, known);
    let size = net.places.len() + net.transitions.len() + 1;
    let siphons = siphons::siphons_that_can_empty(net, MOST_SETS.min(SETS_WORK / size));
    let explorer = Explorer::new(net);
    let mut dead = deadlock(net, &explorer, semantics, siphons.as_deref());
    let covered = bounds.iter().all(Option::is_some);
    let (space, cover) = explore(net, &explorer, semantics, limit, covered, progress);
    if dead == Deadlock::Unknown && !space.complete && semantics == Semantics::Interleaving {
        dead = explorer.deadlock(limit.markings.min(MOST_REDUCED));
    }
    let bounded = bounded(&space, cover.as_ref(), &bounds);
    let path = space.path.clone().or_else(|| alone(&dead));
    let dead_transitions = dead_transitions(&space, cover.as_ref(), semantics);
    // What a dead marking says holds although not all markings are known.
    let (live, reversible) = match &path {
        Some(path) => (Some(vec![false; net.transitions.len()]), Some(path.is_empty())),
        None => (space.live.clone(), space.reversible),
    };
    Analysis {
        t_invariants: invariants::t_invariants(net, MOST_ROWS),
        conflicts: conflicts::conflicts(net, known, MOST_PAIRS),
        unbounded: unbounded(bounded, cover.as_ref()),
        proved_unbounded: cover.filter(|_| bounded == Some(false)).map_or_else(Vec::new, |cover| cover.unbounded),
        bounded,
        deadlock: is_deadlock(&space, &dead),
        path,
        live,
        reversible,
        dead_transitions,
        p_invariants,
        siphons,
        bounds,
        space,
    }
}

/// Explores the reachable markings, not without end if they may have none.
fn explore(
    net: &PtNet,
    explorer: &Explorer,
    semantics: Semantics,
    limit: Limit,
    is_bounded: bool,
    progress: &mut dyn FnMut(u64),
) -> (Space, Option<Cover>) {
    if is_bounded {
        return (explorer.explore(semantics, limit, progress), None);
    }
    let tree = |nodes: usize| cover(net, semantics, limit.markings.min(nodes));
    let mut known = tree(FEW_NODES);
    if known.as_ref().is_none_or(|cover| !cover.complete && cover.unbounded.is_empty()) {
        let space = explorer.explore(semantics, limit.at_most(MOST_UNDECIDED), progress);
        if space.complete || (limit.markings == usize::MAX && semantics == Semantics::Step) {
            return (space, known);
        }
    }
    if known.as_ref().is_none_or(|cover| !cover.complete) {
        known = tree(MOST_UNBOUNDED);
    }
    let is_unbounded = known.as_ref().is_some_and(|cover| !cover.unbounded.is_empty());
    let is_bounded = known.as_ref().is_some_and(|cover| cover.complete && !is_unbounded);
    // What is not known to be bounded fills no memory unless somebody says how many markings are wanted.
    let most = match (is_unbounded, is_bounded || limit.markings != usize::MAX) {
        (true, _) => MOST_UNBOUNDED,
        (false, true) => usize::MAX,
        (false, false) => MOST_UNDECIDED,
    };
    (explorer.explore(semantics, limit.at_most(most), progress), known)
}

/// The coverability tree. Scans reach no more than single transitions do if nothing is only read: a place that is bounded
/// so is bounded. That one is not is proved by a run that can be repeated.
fn cover(net: &PtNet, semantics: Semantics, nodes: usize) -> Option<Cover> {
    if semantics == Semantics::Interleaving {
        return Some(space::cover(net, nodes));
    }
    let most = space::cover(&without_tests(net), nodes);
    if most.complete && most.unbounded.is_empty() {
        return Some(most);
    }
    let all: Vec<PlaceId> = (0..net.places.len() as u32).map(PlaceId).collect();
    let unbounded = space::growing(net, if most.complete { &most.unbounded } else { &all }, nodes);
    let complete = most.complete && most.unbounded == unbounded;
    (!unbounded.is_empty()).then_some(Cover { complete, unbounded, ..most })
}

fn without_tests(net: &PtNet) -> PtNet {
    let mut net = net.clone();
    for transition in &mut net.transitions {
        transition.reads.clear();
        transition.inhibits.clear();
    }
    net
}

/// Dead markings, by the siphons, or by a search for them alone.
fn deadlock(net: &PtNet, explorer: &Explorer, semantics: Semantics, siphons: Option<&[Siphon]>) -> Deadlock {
    let never_empty = siphons.is_some_and(<[Siphon]>::is_empty);
    // In a scan two transitions may each take what the other one reads, and a marked trap may become empty.
    let is_safe = semantics == Semantics::Interleaving || net.transitions.iter().all(|t| t.reads.is_empty());
    if never_empty && is_safe && siphons::is_ordinary(net) && !net.transitions.is_empty() {
        return Deadlock::Never;
    }
    match semantics {
        Semantics::Interleaving => explorer.deadlock(FEW_REDUCED),
        Semantics::Step => Deadlock::Unknown,
    }
}

fn is_deadlock(space: &Space, dead: &Deadlock) -> Option<bool> {
    if space.dead > 0 {
        return Some(true);
    }
    match dead {
        Deadlock::Reached(_) => Some(true),
        Deadlock::Never => Some(false),
        Deadlock::Unknown => space.complete.then_some(false),
    }
}

/// A way on which transitions fire one by one.
fn alone(dead: &Deadlock) -> Option<Vec<Vec<TransitionId>>> {
    match dead {
        Deadlock::Reached(way) => Some(way.iter().map(|transition| vec![*transition]).collect()),
        Deadlock::Never | Deadlock::Unknown => None,
    }
}

fn bounded(space: &Space, cover: Option<&Cover>, bounds: &[Option<u64>]) -> Option<bool> {
    if space.complete || bounds.iter().all(Option::is_some) {
        return Some(true);
    }
    let cover = cover?;
    if cover.unbounded.is_empty() { cover.complete.then_some(true) } else { Some(false) }
}

fn unbounded(bounded: Option<bool>, cover: Option<&Cover>) -> Option<Vec<PlaceId>> {
    if bounded? {
        return Some(Vec::new());
    }
    cover.filter(|cover| cover.complete).map(|cover| cover.unbounded.clone())
}

/// A complete space knows all that fire; so does a complete tree, but only of single transitions.
fn dead_transitions(space: &Space, cover: Option<&Cover>, semantics: Semantics) -> Option<Vec<TransitionId>> {
    let tree = cover.filter(|cover| cover.complete && semantics == Semantics::Interleaving);
    let fired = if space.complete { &space.fired } else { &tree?.fired };
    let dead = (0_u32..).zip(fired).filter(|(_, fired)| !**fired);
    Some(dead.map(|(transition, _)| TransitionId(transition)).collect())
}
