//! The state space of a net: its reachable markings, and what they tell.

mod components;
mod cover;
mod depend;
mod game;
mod grow;
mod guards;
mod home;
mod interleaving;
mod jobs;
mod layout;
mod markings;
mod moves;
mod path;
mod rules;
mod search;
mod steps;
mod stubborn;
mod walk;
mod words;

pub use cover::{Cover, cover};
pub use grow::growing;

use crate::pt::{PtNet, TransitionId};
use components::Bottoms;
use jobs::{Components, Explore, Home, Way};
use moves::{AnyMoves, Halt, Kind};
use rules::Rules;
use search::{Found, Stop};

/// What may happen at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Semantics {
    /// One transition.
    Interleaving,
    /// A scan's gate phase: transitions are tried in their order on the marking at its start, and each that can fire does,
    /// unless it is free. A scan in which nothing fires is no step.
    Step,
}

/// Where an exploration stops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limit {
    /// At so many markings.
    pub markings: usize,
    /// At as many markings as fit into so many bytes.
    pub bytes: u64,
}

impl Limit {
    /// At so many markings, whatever memory they take.
    pub fn markings(markings: usize) -> Limit {
        Limit { markings, bytes: u64::MAX }
    }

    /// At as many markings as fit into so many bytes.
    pub fn bytes(bytes: u64) -> Limit {
        Limit { markings: usize::MAX, bytes }
    }

    /// At so many markings if it would be at more.
    #[must_use]
    pub fn at_most(self, markings: usize) -> Limit {
        Limit { markings: self.markings.min(markings), ..self }
    }

    /// As markings of a net whose packed markings have so many words.
    fn of_words(self, words: usize) -> usize {
        let fit = usize::try_from(self.bytes / (8 * words as u64 + BESIDE_KEY)).unwrap_or(usize::MAX);
        self.markings.min(fit)
    }
}

/// Bytes that a marking takes at most beside its key: in the table, while it waits to be looked at, in its component.
const BESIDE_KEY: u64 = 48;

/// What is known of the reachable markings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Space {
    /// How many markings were found.
    pub markings: u64,
    /// No more than so many were to be found.
    pub limit: u64,
    /// Pairs of a marking and a transition that is enabled in it, or a step that can be made in it, of the markings that
    /// were looked at.
    pub edges: u64,
    /// Markings in which no transition is enabled, of those that were looked at.
    pub dead: u64,
    /// The shortest way to a dead marking: the transitions of each step. `None`: no dead marking was seen.
    pub path: Option<Vec<Vec<TransitionId>>>,
    /// By place: the most tokens that were seen.
    pub most: Vec<u64>,
    /// By transition: whether it was enabled somewhere; under the step semantics, whether it fired.
    pub fired: Vec<bool>,
    /// All reachable markings were looked at.
    pub complete: bool,
    /// By transition: whether it can fire again, whatever happens. `None`: not known.
    pub live: Option<Vec<bool>>,
    /// Whether every reachable marking leads back to the initial one. `None`: not known.
    pub reversible: Option<bool>,
    /// How many sets of markings there are that are never left once they are entered. `None`: not known.
    pub bottoms: Option<u64>,
}

/// What is known of a net's dead markings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Deadlock {
    /// One is reached by these transitions.
    Reached(Vec<TransitionId>),
    /// None is reachable.
    Never,
    /// Not known: the search was given up.
    Unknown,
}

/// The work on reduced markings after which a dead marking is no more looked for: as many places and transitions are looked
/// at.
const REDUCED_WORK: usize = 20_000_000;

/// Walks after that.
const WALKS: u64 = 5;

/// A net that is explored.
#[derive(Clone, Debug)]
pub struct Explorer {
    rules: Rules,
    initial: Vec<u64>,
    /// The initial marking alone was found.
    start: Found,
}

impl Explorer {
    /// Gets a net ready.
    pub fn new(net: &PtNet) -> Explorer {
        let rules = Rules::new(net);
        let initial: Vec<u64> = net.places.iter().map(|place| place.initial).collect();
        let start = Found::new(&rules, &initial, &game::expected(&rules, &initial));
        Explorer { rules, initial, start }
    }

    /// Looks for a dead marking of the interleaving semantics, in at most so many markings: by a walk, by all that stubborn
    /// sets leave, by some more walks.
    pub fn deadlock(&self, limit: usize) -> Deadlock {
        self.walk(1).unwrap_or_else(|| match self.reduced(limit) {
            Deadlock::Unknown => self.walk(WALKS).unwrap_or(Deadlock::Unknown),
            known @ (Deadlock::Reached(_) | Deadlock::Never) => known,
        })
    }

    fn walk(&self, walks: u64) -> Option<Deadlock> {
        let way = walk::to_dead_marking(&self.rules, &self.initial, walks)?;
        Some(Deadlock::Reached(way.into_iter().map(TransitionId).collect()))
    }

    /// Looks for a dead marking in what stubborn sets leave of the markings, at most so many.
    pub fn reduced(&self, limit: usize) -> Deadlock {
        let size = self.rules.places + self.rules.list.len() + 1;
        let stop = Stop { limit: limit.min(REDUCED_WORK / size), at_dead: true };
        let mut found = self.start.clone();
        self.run(&mut found, Kind::Stubborn, &|_| stop, &mut |_| {});
        match found.first_dead.and_then(|number| self.way(&found, Kind::Stubborn, number)) {
            Some(way) => Deadlock::Reached(way.into_iter().flatten().collect()),
            None if found.complete => Deadlock::Never,
            None => Deadlock::Unknown,
        }
    }

    /// Explores the reachable markings, breadth first. `progress` is told from time to time how many were found.
    pub fn explore(&self, semantics: Semantics, limit: Limit, progress: &mut dyn FnMut(u64)) -> Space {
        let kind = match semantics {
            Semantics::Interleaving => Kind::Interleaving,
            Semantics::Step => Kind::Steps,
        };
        let mut found = self.start.clone();
        let stop = |words| Stop { limit: limit.of_words(words), at_dead: false };
        let limit = self.run(&mut found, kind, &stop, progress) as u64;
        let path = found.first_dead.and_then(|number| self.way(&found, kind, number));
        let bottoms = self.bottoms(&found, kind, progress);
        Space {
            markings: found.markings.count() as u64,
            limit,
            edges: found.edges,
            dead: found.dead,
            path,
            reversible: bottoms.as_ref().map(|bottoms| bottoms.reversible),
            bottoms: bottoms.as_ref().and_then(|bottoms| bottoms.count),
            live: bottoms.map(|bottoms| bottoms.live),
            most: found.most,
            fired: found.fired,
            complete: found.complete,
        }
    }

    /// Searches on, with wider fields where they are needed. The limit in markings that held at last.
    fn run(&self, found: &mut Found, kind: Kind, stop: &dyn Fn(usize) -> Stop, progress: &mut dyn FnMut(u64)) -> usize {
        loop {
            let (layout, bounds) = (found.layout.clone(), found.bounds.clone());
            let mut moves = AnyMoves::new(kind, &self.rules, &layout, &bounds);
            let stop = stop(layout.key);
            match layout.by_length(Explore { found, moves: &mut moves, stop, progress }) {
                Err(Halt::Wider { place, tokens }) if found.widen(place, tokens) => {}
                Err(Halt::Wider { .. } | Halt::Enough) | Ok(()) => return stop.limit,
            }
        }
    }

    /// The shortest way to the marking with a number.
    fn way(&self, found: &Found, kind: Kind, number: usize) -> Option<Vec<Vec<TransitionId>>> {
        let mut moves = AnyMoves::new(kind, &self.rules, &found.layout, &found.bounds);
        let path = found.layout.by_length(Way { found, moves: &mut moves, number })?;
        Some(path.into_iter().map(|fired| fired.into_iter().map(TransitionId).collect()).collect())
    }

    /// What the bottom components tell. A dead marking is one of them, in which nothing is live.
    fn bottoms(&self, found: &Found, kind: Kind, progress: &mut dyn FnMut(u64)) -> Option<Bottoms> {
        let rules = &self.rules;
        if let Some(dead) = found.first_dead {
            return Some(Bottoms { count: None, live: vec![false; rules.list.len()], reversible: dead == 1 });
        }
        if !found.complete {
            return None;
        }
        if kind == Kind::Interleaving && found.layout.by_length(Home { found, rules }) {
            return Some(Bottoms { count: Some(1), live: found.fired.clone(), reversible: true });
        }
        let mut moves = AnyMoves::new(kind, rules, &found.layout, &found.bounds);
        found.layout.by_length(Components { found, moves: &mut moves, progress }).ok()
    }
}
