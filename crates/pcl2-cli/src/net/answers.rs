//! What is known of a net, for people and for tools.

use pcl2_net::analysis::Analysis;
use pcl2_net::pt::{PlaceId, PtNet, TransitionId};
use pcl2_net::space::Semantics;
use pcl2_net::structure::conflicts::{Conflict, Over};
use pcl2_net::structure::invariants::{Invariant, weighted_tokens};
use pcl2_net::structure::matrix::{Matrix, MatrixKind};
use pcl2_net::structure::names::{counted, size};
use pcl2_net::structure::siphons::{Member, Siphon};
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;

/// The most lines of a list for people.
const MOST_LINES: usize = 50;

/// A net and what is known of it.
#[derive(Clone, Copy)]
pub(crate) struct Report<'a> {
    /// The net.
    pub(crate) net: &'a PtNet,
    /// The semantics under which it was analysed.
    pub(crate) semantics: Semantics,
    /// What is known.
    pub(crate) analysis: &'a Analysis,
}

impl<'a> Report<'a> {
    fn place(&self, id: PlaceId) -> &'a str {
        &self.net.places[id.0 as usize].name
    }

    fn transition(&self, id: TransitionId) -> &'a str {
        &self.net.transitions[id.0 as usize].name
    }

    fn transitions(&self, ids: &[TransitionId]) -> Vec<&'a str> {
        ids.iter().map(|id| self.transition(*id)).collect()
    }

    fn places(&self, ids: &[PlaceId]) -> Vec<&'a str> {
        ids.iter().map(|id| self.place(*id)).collect()
    }

    fn semantics(&self) -> &'static str {
        match self.semantics {
            Semantics::Interleaving => "interleaving",
            Semantics::Step => "step",
        }
    }

    /// A room is not a place: its name says of which place it is.
    fn members(&self, siphon: &Siphon) -> Vec<String> {
        let member = |member: &Member| match member {
            Member::Tokens(place) => self.place(*place).to_owned(),
            Member::Room(place) => format!("room of {}", self.place(*place)),
        };
        siphon.iter().map(member).collect()
    }

    /// The keys are always all there; null is not known.
    pub(crate) fn json(&self) -> Value {
        let (net, found, space) = (self.net, self.analysis, &self.analysis.space);
        let names: Vec<&str> = net.places.iter().map(|place| place.name.as_str()).collect();
        let transitions: Vec<&str> = net.transitions.iter().map(|transition| transition.name.as_str()).collect();
        let path = found.path.as_ref().map(|path| path.iter().map(|scan| self.transitions(scan)).collect::<Vec<_>>());
        json!({
            "places": names,
            "transitions": transitions,
            "semantics": self.semantics(),
            "complete": space.complete,
            "markings": space.markings,
            "edges": space.edges,
            "dead_markings": space.dead,
            "bound": space.most.iter().max().copied().unwrap_or(0),
            "bounded": found.bounded,
            "unbounded_places": found.unbounded.as_ref().map(|places| self.places(places)),
            "deadlock": found.deadlock,
            "deadlock_path": path,
            "dead_transitions": found.dead_transitions.as_ref().map(|dead| self.transitions(dead)),
            "live": found.live.as_ref().map(|live| live.iter().all(|live| *live)),
            "reversible": found.reversible,
            "p_invariants": found.p_invariants.as_ref().map(|found| weighted(found, |id| self.place(id))),
            "t_invariants": found.t_invariants.as_ref().map(|found| weighted(found, |id| self.transition(id))),
            "siphons_that_can_empty": found.siphons.as_ref().map(|found| {
                found.iter().map(|siphon| self.members(siphon)).collect::<Vec<_>>()
            }),
        })
    }

    /// For people: what the structure says, then what the markings say.
    pub(crate) fn text(&self) -> String {
        let matrix = Matrix::of(self.net, MatrixKind::Change);
        let entries: usize = (0..matrix.rows.len()).map(|row| matrix.row(row).len()).sum();
        let mut text = Text(format!("{}\n", self.net.name));
        let size = size(self.net.places.len(), self.net.transitions.len());
        let entries = counted(entries, "entry that is", "entries that are");
        text.line(&format!("{size}; the incidence matrix has {entries} not 0"));
        self.structure(&mut text);
        self.markings(&mut text);
        self.behaviour(&mut text);
        text.0
    }

    fn structure(&self, text: &mut Text) {
        let found = self.analysis;
        let cycle = |invariant: &Invariant<PlaceId>| {
            let sum = weighted_tokens(self.net, invariant).map(|sum| format!(" = {sum}")).unwrap_or_default();
            sum_of(invariant, |id| self.place(id)) + &sum
        };
        let lines = |found: &[Invariant<PlaceId>]| found.iter().map(cycle).collect::<Vec<_>>();
        text.list(
            "P-invariants: cycles of a device, with the tokens in them",
            found.p_invariants.as_deref().map(lines),
        );
        let lines = |found: &[Invariant<TransitionId>]| {
            found.iter().map(|invariant| sum_of(invariant, |id| self.transition(id))).collect::<Vec<_>>()
        };
        text.list("T-invariants: firings that lead back to where they began", found.t_invariants.as_deref().map(lines));
        text.list("bounds of places", Some(self.bounds()));
        let siphons = |found: &Vec<Siphon>| found.iter().map(|siphon| self.members(siphon).join(", ")).collect();
        text.list("siphons that can empty", found.siphons.as_ref().map(siphons));
        let conflicts = found.conflicts.iter().map(|conflict| self.conflict(conflict)).collect();
        text.list("conflicts that priority decides", Some(conflicts));
    }

    /// Places by the most tokens that they can hold.
    fn bounds(&self) -> Vec<String> {
        let found = self.analysis;
        let mut groups: BTreeMap<Bound, Vec<&str>> = BTreeMap::new();
        for (i, place) in self.net.places.iter().enumerate() {
            let seen = found.space.complete.then_some(found.space.most[i]);
            let bound = match seen.or(found.bounds[i]) {
                Some(bound) => Bound::AtMost(bound),
                None if self.is_unbounded(i) => Bound::AnyNumber,
                None => Bound::NotKnown,
            };
            groups.entry(bound).or_default().push(&place.name);
        }
        groups.into_iter().map(|(bound, places)| format!("{}: {}", bound.text(), places.join(", "))).collect()
    }

    fn is_unbounded(&self, place: usize) -> bool {
        self.analysis.proved_unbounded.contains(&PlaceId(place as u32))
    }

    fn conflict(&self, conflict: &Conflict) -> String {
        let over = match conflict.over {
            Over::Tokens => "tokens in",
            Over::Room => "room in",
        };
        format!("{over} {}: {}", self.place(conflict.place), self.transitions(&conflict.transitions).join(", "))
    }

    fn markings(&self, text: &mut Text) {
        let space = &self.analysis.space;
        let whole = if space.complete { "all" } else { "not all" };
        text.line(&format!(
            "reachable markings, {}: {}, {whole}; edges {}; dead markings {}; limit {} markings",
            self.semantics(),
            space.markings,
            space.edges,
            space.dead,
            space.limit
        ));
    }

    fn behaviour(&self, text: &mut Text) {
        let found = self.analysis;
        let mut names = self.places(&found.proved_unbounded);
        names.extend(found.unbounded.is_none().then_some("and perhaps others"));
        match found.bounded {
            Some(false) => text.names("unbounded places", Some(names)),
            bounded => text.answer("bounded", bounded),
        }
        text.answer("deadlock", found.deadlock);
        if let Some(path) = &found.path {
            let scan =
                |(i, fired): (usize, &Vec<TransitionId>)| format!("{}: {}", i + 1, self.transitions(fired).join(", "));
            text.list("firings up to a dead marking", Some(path.iter().enumerate().map(scan).collect()));
        }
        text.names("transitions that never fire", found.dead_transitions.as_ref().map(|dead| self.transitions(dead)));
        let stuck = |live: &Vec<bool>| {
            let all = self.net.transitions.iter().zip(live);
            all.filter(|(_, live)| !**live).map(|(transition, _)| transition.name.as_str()).collect()
        };
        text.names("transitions that are not live", found.live.as_ref().map(stuck));
        text.answer("reversible", found.reversible);
        if let Some(bottoms) = found.space.bottoms.filter(|bottoms| *bottoms > 1) {
            text.line(&format!("sets of markings that are never left: {bottoms}"));
        }
    }
}

/// How many tokens a place can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Bound {
    AtMost(u64),
    AnyNumber,
    NotKnown,
}

impl Bound {
    fn text(self) -> String {
        match self {
            Bound::AtMost(bound) => format!("at most {bound}"),
            Bound::AnyNumber => "any number".to_owned(),
            Bound::NotKnown => "not known".to_owned(),
        }
    }
}

/// The text of a report.
struct Text(String);

impl Text {
    fn line(&mut self, line: &str) {
        self.0.extend(["  ", line, "\n"]);
    }

    fn answer(&mut self, what: &str, answer: Option<bool>) {
        let answer = answer.map_or("not known", |yes| if yes { "yes" } else { "no" });
        self.line(&format!("{what}: {answer}"));
    }

    fn names(&mut self, what: &str, names: Option<Vec<&str>>) {
        let names = match names {
            None => "not known".to_owned(),
            Some(names) if names.is_empty() => "none".to_owned(),
            Some(names) => names.join(", "),
        };
        self.line(&format!("{what}: {names}"));
    }

    /// A title and a line for each entry; `None`: more than can be looked at.
    fn list(&mut self, title: &str, lines: Option<Vec<String>>) {
        let Some(lines) = lines else { return self.line(&format!("{title}: too many to look at")) };
        if lines.is_empty() {
            return self.line(&format!("{title}: none"));
        }
        self.line(title);
        lines.iter().take(MOST_LINES).for_each(|line| self.line(&format!("  {line}")));
        if lines.len() > MOST_LINES {
            self.line(&format!("  and {} more, which --json lists", lines.len() - MOST_LINES));
        }
    }
}

fn sum_of<'n, Id: Copy>(invariant: &Invariant<Id>, name: impl Fn(Id) -> &'n str) -> String {
    let term = |(id, weight): &(Id, u64)| match weight {
        1 => name(*id).to_owned(),
        weight => format!("{weight} {}", name(*id)),
    };
    invariant.iter().map(term).collect::<Vec<_>>().join(" + ")
}

/// Each invariant as an object of names and weights.
fn weighted<'n, Id: Copy>(found: &[Invariant<Id>], name: impl Fn(Id) -> &'n str) -> Vec<Value> {
    let object = |invariant: &Invariant<Id>| {
        let entries = invariant.iter().map(|(id, weight)| (name(*id).to_owned(), Value::from(*weight)));
        Value::Object(entries.collect::<Map<String, Value>>())
    };
    found.iter().map(object).collect()
}
