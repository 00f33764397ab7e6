//! `pcl2 net analyze`

use super::AnalyzeArgs;
use crate::console;
use crate::outcome::Outcome;
use indicatif::{ProgressBar, ProgressStyle};
use pcl2_net::pt::{PlaceId, PtNet, TransitionId};
use pcl2_net::space::{self, Space};
use pcl2_net::structure::invariants::{self, Invariant};
use pcl2_net::structure::siphons::{self, Member, Siphon};
use serde_json::{Map, Value, json};
use std::fmt::Write;
use std::fs;

/// The most rows that the search for invariants, and the most sets that the search for siphons, may hold.
const MOST_ROWS: usize = 20_000;

/// Bytes that a marking takes, at most, of a net with up to 1000 places.
const BYTES_A_MARKING: u64 = 256;

/// What is found out.
struct Report<'n> {
    net: &'n PtNet,
    space: Space,
    p_invariants: Option<Vec<Invariant<PlaceId>>>,
    t_invariants: Option<Vec<Invariant<TransitionId>>>,
    siphons: Option<Vec<Siphon>>,
}

/// Analyses a net.
pub(crate) fn analyze(net: &PtNet, args: &AnalyzeArgs) -> Outcome {
    let fits = usize::try_from(free_memory() / 2 / BYTES_A_MARKING).unwrap_or(usize::MAX);
    let bar = ProgressBar::new_spinner();
    if let Ok(style) = ProgressStyle::with_template("{spinner} {pos} markings {elapsed}") {
        bar.set_style(style);
    }
    let space = space::explore(net, args.limit.unwrap_or(fits), &mut |markings| bar.set_position(markings));
    bar.finish_and_clear();
    let report = Report {
        net,
        space,
        p_invariants: invariants::p_invariants(net, MOST_ROWS),
        t_invariants: invariants::t_invariants(net, MOST_ROWS),
        siphons: siphons::siphons_that_can_empty(net, MOST_ROWS),
    };
    console::out(&if args.json { format!("{}\n", report.json()) } else { report.text() });
    Outcome::Done
}

/// Bytes that nobody uses; without an answer of the system as many as a small machine has.
fn free_memory() -> u64 {
    let text = fs::read_to_string("/proc/meminfo").unwrap_or_default();
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"));
    let kilobytes = line.and_then(|line| line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok());
    kilobytes.map_or(1 << 30, |kilobytes| kilobytes.saturating_mul(1024))
}

impl Report<'_> {
    fn place(&self, id: PlaceId) -> &str {
        &self.net.places[id.0 as usize].name
    }

    fn transition(&self, id: TransitionId) -> &str {
        &self.net.transitions[id.0 as usize].name
    }

    /// What a set of reachable markings tells only when it is whole.
    fn when_complete<T>(&self, value: T) -> Option<T> {
        self.space.complete.then_some(value)
    }

    /// Whether some marking is dead; one may be found before all are.
    fn deadlock(&self) -> Option<bool> {
        if self.space.dead > 0 { Some(true) } else { self.when_complete(false) }
    }

    fn dead_transitions(&self) -> Option<Vec<&str>> {
        let all = self.net.transitions.iter().zip(&self.space.fired);
        self.when_complete(all.filter(|(_, fired)| !**fired).map(|(transition, _)| transition.name.as_str()).collect())
    }

    /// The keys are always all there; null is not known.
    fn json(&self) -> Value {
        let names: Vec<&str> = self.net.places.iter().map(|place| place.name.as_str()).collect();
        let transitions: Vec<&str> = self.net.transitions.iter().map(|transition| transition.name.as_str()).collect();
        json!({
            "places": names,
            "transitions": transitions,
            "semantics": "interleaving",
            "complete": self.space.complete,
            "markings": self.space.markings,
            "edges": self.space.edges,
            "dead_markings": self.space.dead,
            "bound": self.space.most.iter().max().copied().unwrap_or(0),
            "bounded": self.when_complete(true),
            "unbounded_places": self.when_complete(Vec::<&str>::new()),
            "deadlock": self.deadlock(),
            "deadlock_path": Value::Null,
            "dead_transitions": self.dead_transitions(),
            "live": Value::Null,
            "reversible": Value::Null,
            "p_invariants": self.p_invariants.as_ref().map(|found| weighted(found, |id| self.place(id))),
            "t_invariants": self.t_invariants.as_ref().map(|found| weighted(found, |id| self.transition(id))),
            "siphons_that_can_empty": self.siphons.as_ref().map(|found| {
                found.iter().map(|siphon| self.members(siphon)).collect::<Vec<_>>()
            }),
        })
    }

    fn members(&self, siphon: &Siphon) -> Vec<String> {
        let member = |member: &Member| match member {
            Member::Tokens(place) => self.place(*place).to_owned(),
            Member::Room(place) => format!("room of {}", self.place(*place)),
        };
        siphon.iter().map(member).collect()
    }

    fn text(&self) -> String {
        let (net, space) = (self.net, &self.space);
        let mut text = format!("{}\n", net.name);
        let whole = if space.complete { "" } else { ", not all: raise --limit" };
        let _ = writeln!(text, "  places {}, transitions {}", net.places.len(), net.transitions.len());
        let _ = writeln!(text, "  reachable markings {}{whole}, edges {}", space.markings, space.edges);
        let _ = writeln!(text, "  dead markings {}", space.dead);
        let _ = writeln!(text, "  most tokens in a place {}", space.most.iter().max().copied().unwrap_or(0));
        if let Some(dead) = self.dead_transitions().filter(|dead| !dead.is_empty()) {
            let _ = writeln!(text, "  transitions that never fire: {}", dead.join(", "));
        }
        cycles(&mut text, "P-invariants", self.p_invariants.as_deref(), |id| self.place(id));
        cycles(&mut text, "T-invariants", self.t_invariants.as_deref(), |id| self.transition(id));
        match &self.siphons {
            Some(siphons) if siphons.is_empty() => text.push_str("  no siphon can empty\n"),
            Some(siphons) => {
                text.push_str("  siphons that can empty\n");
                for siphon in siphons {
                    let _ = writeln!(text, "    {}", self.members(siphon).join(", "));
                }
            }
            None => text.push_str("  siphons that can empty: too many to look at\n"),
        }
        text
    }
}

/// Each invariant as an object of names and weights.
fn weighted<'n, Id: Copy>(found: &[Invariant<Id>], name: impl Fn(Id) -> &'n str) -> Vec<Value> {
    let object = |invariant: &Invariant<Id>| {
        let entries = invariant.iter().map(|(id, weight)| (name(*id).to_owned(), Value::from(*weight)));
        Value::Object(entries.collect::<Map<String, Value>>())
    };
    found.iter().map(object).collect()
}

fn cycles<'n, Id: Copy>(text: &mut String, title: &str, found: Option<&[Invariant<Id>]>, name: impl Fn(Id) -> &'n str) {
    let Some(found) = found else {
        let _ = writeln!(text, "  {title}: too many to look at");
        return;
    };
    let _ = writeln!(text, "  {title}");
    for invariant in found {
        let term = |(id, weight): &(Id, u64)| match weight {
            1 => name(*id).to_owned(),
            weight => format!("{weight} {}", name(*id)),
        };
        let _ = writeln!(text, "    {}", invariant.iter().map(term).collect::<Vec<_>>().join(" + "));
    }
}
