//! Reachable markings, written down plainly.

use pcl2_net::pt::{Arc, PtNet, Transition, TransitionId};
use pcl2_net::space::Semantics;
use pcl2_net::structure::fire::{self, OnBlocked, Rule};
use std::collections::{BTreeMap, BTreeSet, VecDeque};

pub(crate) type Marking = Vec<u64>;

/// What fires together, and what it leads to.
pub(crate) type Move = (Vec<usize>, Marking);

/// All markings with their moves.
pub(crate) struct Graph(pub(crate) BTreeMap<Marking, Vec<Move>>);

pub(crate) fn initial(net: &PtNet) -> Marking {
    net.places.iter().map(|place| place.initial).collect()
}

pub(crate) fn weight(arcs: &[Arc], place: usize) -> u64 {
    arcs.iter().find(|arc| arc.place.0 as usize == place).map_or(0, |arc| arc.weight)
}

/// Whether a transition can fire that sees one marking, while of another one tokens are left to take, and each place has
/// grown so much.
fn is_enabled(net: &PtNet, seen: &[u64], left: &[u64], grown: &[u64], transition: &Transition) -> bool {
    (0..seen.len()).all(|place| {
        let (takes, puts) = (weight(&transition.takes, place), weight(&transition.puts, place));
        let inhibits = weight(&transition.inhibits, place);
        let more = puts.saturating_sub(takes);
        left[place] >= takes
            && seen[place] >= weight(&transition.reads, place)
            && (inhibits == 0 || seen[place] < inhibits)
            && (more == 0 || net.places[place].capacity.is_none_or(|most| seen[place] + grown[place] + more <= most))
    })
}

/// The marking after a transition, if it is enabled.
pub(crate) fn fired(net: &PtNet, marking: &[u64], transition: &Transition) -> Option<Marking> {
    is_enabled(net, marking, marking, &vec![0; marking.len()], transition).then(|| after(marking, &[transition]))
}

fn after(marking: &[u64], fired: &[&Transition]) -> Marking {
    let sum = |place: usize, arcs: fn(&Transition) -> &[Arc]| fired.iter().map(|t| weight(arcs(t), place)).sum::<u64>();
    (0..marking.len()).map(|place| marking[place] + sum(place, |t| &t.puts) - sum(place, |t| &t.takes)).collect()
}

pub(crate) fn moves(net: &PtNet, marking: &[u64], semantics: Semantics) -> Vec<Move> {
    match semantics {
        Semantics::Interleaving => {
            let all = net.transitions.iter().enumerate();
            all.filter_map(|(t, transition)| Some((vec![t], fired(net, marking, transition)?))).collect()
        }
        Semantics::Step => {
            let mut sets = BTreeSet::new();
            steps(net, marking, 0, &mut Vec::new(), &mut sets);
            sets.remove(&Vec::new());
            let transitions = |set: &Vec<usize>| set.iter().map(|t| &net.transitions[*t]).collect::<Vec<_>>();
            sets.into_iter().map(|set| (set.clone(), after(marking, &transitions(&set)))).collect()
        }
    }
}

/// All sets that fire together, from a transition on.
fn steps(net: &PtNet, marking: &[u64], next: usize, fired: &mut Vec<usize>, sets: &mut BTreeSet<Vec<usize>>) {
    let Some(transition) = net.transitions.get(next) else {
        sets.insert(fired.clone());
        return;
    };
    let (mut left, mut grown) = (marking.to_vec(), vec![0; marking.len()]);
    for place in 0..marking.len() {
        for t in fired.iter().map(|t| &net.transitions[*t]) {
            left[place] -= weight(&t.takes, place);
            grown[place] += weight(&t.puts, place).saturating_sub(weight(&t.takes, place));
        }
    }
    let is_gate_open = fired.iter().all(|t| net.transitions[*t].gate != transition.gate);
    let enabled = is_gate_open && is_enabled(net, marking, &left, &grown, transition);
    if enabled {
        fired.push(next);
        steps(net, marking, next + 1, fired, sets);
        fired.pop();
    }
    if !enabled || transition.free {
        steps(net, marking, next + 1, fired, sets);
    }
}

/// All reachable markings, or `None` if there are more than so many.
pub(crate) fn explore(net: &PtNet, semantics: Semantics, limit: usize) -> Option<Graph> {
    let mut graph = BTreeMap::new();
    let mut open = vec![initial(net)];
    while let Some(marking) = open.pop() {
        if graph.contains_key(&marking) {
            continue;
        }
        let moves = moves(net, &marking, semantics);
        open.extend(moves.iter().map(|(_, to)| to.clone()));
        graph.insert(marking, moves);
        if graph.len() > limit {
            return None;
        }
    }
    Some(Graph(graph))
}

impl Graph {
    /// The markings that are reached from one, each with the number of moves.
    pub(crate) fn distances(&self, from: &Marking) -> BTreeMap<Marking, usize> {
        let mut distances = BTreeMap::from([(from.clone(), 0)]);
        let mut open = VecDeque::from([from.clone()]);
        while let Some(marking) = open.pop_front() {
            let distance = distances[&marking] + 1;
            for (_, to) in &self.0[&marking] {
                if !distances.contains_key(to) {
                    distances.insert(to.clone(), distance);
                    open.push_back(to.clone());
                }
            }
        }
        distances
    }

    pub(crate) fn edges(&self) -> u64 {
        self.0.values().map(|moves| moves.len() as u64).sum()
    }

    pub(crate) fn dead(&self) -> Vec<&Marking> {
        self.0.iter().filter(|(_, moves)| moves.is_empty()).map(|(marking, _)| marking).collect()
    }

    /// By transition: whether from every marking one is reached in which it fires.
    pub(crate) fn live(&self, transitions: usize) -> Vec<bool> {
        let mut live = vec![true; transitions];
        for marking in self.0.keys() {
            let reached = self.distances(marking);
            let fired: BTreeSet<usize> =
                reached.keys().flat_map(|at| &self.0[at]).flat_map(|(fired, _)| fired.iter().copied()).collect();
            live.iter_mut().enumerate().for_each(|(t, live)| *live &= fired.contains(&t));
        }
        live
    }

    pub(crate) fn reversible(&self, initial: &Marking) -> bool {
        self.0.keys().all(|marking| self.distances(marking).contains_key(initial))
    }
}

/// Whether a path can be fired from the start, and where it ends.
pub(crate) fn replay(net: &PtNet, path: &[Vec<TransitionId>], semantics: Semantics) -> Option<Marking> {
    let scans: Vec<fire::Scan> = path.iter().map(|scan| scan.iter().map(|id| (*id, 1)).collect()).collect();
    let rule = match semantics {
        Semantics::Interleaving => Rule::Interleaving,
        Semantics::Step => Rule::Step,
    };
    let run = fire::fire(net, &fire::initial(net), &scans, rule, OnBlocked::Refuse).ok()?;
    let last = run.markings.last().filter(|_| run.blocked.is_empty())?;
    Some(last.iter().map(|tokens| u64::try_from(*tokens).unwrap()).collect())
}
