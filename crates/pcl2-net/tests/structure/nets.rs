//! Nets for tests.

use pcl2_net::pt::{Arc, Place, PlaceId, PtNet, Transition, TransitionId};
use pcl2_net::structure::names::Names;

/// A net from text. Places: `name`, `name=tokens`, `name=tokens/capacity`. Transitions, one a line:
/// `name: what it takes -> what it puts ? what it reads`, an inhibitor as `!place`, a weight as `3*place`, `free` at
/// the end.
pub(crate) fn net(places: &str, transitions: &str) -> PtNet {
    let mut net = PtNet { name: "test".to_owned(), ..PtNet::default() };
    net.places = places.split_whitespace().map(place).collect();
    let lines = transitions.lines().map(str::trim).filter(|line| !line.is_empty());
    net.transitions = lines.enumerate().map(|(i, line)| transition(&net, line, i as u32)).collect();
    net
}

fn place(text: &str) -> Place {
    let (name, tokens) = text.split_once('=').unwrap_or((text, "0"));
    let (tokens, capacity) =
        tokens.split_once('/').map_or((tokens, None), |(tokens, capacity)| (tokens, Some(capacity)));
    Place {
        name: name.to_owned(),
        initial: tokens.parse().unwrap(),
        capacity: capacity.map(|capacity| capacity.parse().unwrap()),
    }
}

fn transition(net: &PtNet, line: &str, gate: u32) -> Transition {
    let (name, arcs) = line.split_once(':').unwrap();
    let (arcs, free) = arcs.strip_suffix("free").map_or((arcs, false), |arcs| (arcs, true));
    let (moves, seen) = arcs.split_once('?').unwrap_or((arcs, ""));
    let (takes, puts) = moves.split_once("->").unwrap();
    let (inhibits, reads): (Vec<&str>, Vec<&str>) = seen.split_whitespace().partition(|word| word.starts_with('!'));
    let arcs = |words: &[&str]| words.iter().map(|word| arc(net, word.trim_start_matches('!'))).collect();
    let words = |text: &str| arcs(&text.split_whitespace().collect::<Vec<_>>());
    let (takes, puts) = (words(takes), words(puts));
    Transition { name: name.to_owned(), takes, puts, reads: arcs(&reads), inhibits: arcs(&inhibits), free, gate }
}

fn arc(net: &PtNet, word: &str) -> Arc {
    let (weight, name) = word.split_once('*').unwrap_or(("1", word));
    Arc { place: place_id(net, name), weight: weight.parse().unwrap() }
}

/// The place of this name.
pub(crate) fn place_id(net: &PtNet, name: &str) -> PlaceId {
    Names::new(net).place(name).unwrap()
}

/// The transition of this name.
pub(crate) fn transition_id(net: &PtNet, name: &str) -> TransitionId {
    Names::new(net).transition(name).unwrap()
}

/// The names of places, separated by spaces.
pub(crate) fn place_names(net: &PtNet, ids: impl IntoIterator<Item = PlaceId>) -> String {
    let names: Vec<&str> = ids.into_iter().map(|id| net.places[id.0 as usize].name.as_str()).collect();
    names.join(" ")
}

/// The names of transitions, separated by spaces.
pub(crate) fn transition_names(net: &PtNet, ids: impl IntoIterator<Item = TransitionId>) -> String {
    let names: Vec<&str> = ids.into_iter().map(|id| net.transitions[id.0 as usize].name.as_str()).collect();
    names.join(" ")
}

/// The measuring tank of Jeong and Yang, figure 5. Two-state transitions of devices are named after the state that they
/// leave, the button's after the state that they enter.
pub(crate) fn tank() -> PtNet {
    net(
        "S0=1 S1 S2 S3 S4 S5 S6 P0=1 P1 L1=1 L0 V11 V10=1 V21 V20=1 Z12 Z11 Z10=1 D11 D10=1 D21=1 D20",
        "t0: S0 -> S1 ? P1
         t1: S1 -> S2 ? D20
         t2: S2 -> S3 ? D11
         t3: S3 -> S4 ? V10
         t4: S4 -> S5 ? D10
         t5: S5 -> S6 ? D21
         t6: S6 -> S0 ? V20 L1
         tp10: P1 -> P0 free
         tp11: P0 -> P1 free
         tL0: L0 -> L1 ? S6
         tL1: L1 -> L0 ? S1
         tv10: V10 -> V11 ? S1
         tv11: V11 -> V10 ? S3
         tv20: V20 -> V21 ? S4
         tv21: V21 -> V20 ? S6
         tz10: Z11 -> Z12 ? V11
         tz11: Z10 -> Z11 ? V11
         tz12: Z12 -> Z11 ? V21
         tz13: Z11 -> Z10 ? V21
         tD10: D10 -> D11 ? Z12
         tD11: D11 -> D10 ? Z11
         tD20: D20 -> D21 ? Z10
         tD21: D21 -> D20 ? Z11",
    )
}

/// Philosophers that take their forks one after the other, or both at once.
pub(crate) fn philosophers(count: usize, at_once: bool) -> PtNet {
    let (mut places, mut transitions) = (String::new(), String::new());
    for i in 0..count {
        let right = (i + 1) % count;
        places += &format!("think{i}=1 eat{i} fork{i}=1 ");
        if at_once {
            transitions += &format!("take{i}: think{i} fork{i} fork{right} -> eat{i}\n");
        } else {
            places += &format!("hold{i} ");
            transitions += &format!("left{i}: think{i} fork{i} -> hold{i}\nright{i}: hold{i} fork{right} -> eat{i}\n");
        }
        transitions += &format!("put{i}: eat{i} -> think{i} fork{i} fork{right}\n");
    }
    net(&places, &transitions)
}

/// Small numbers that look like chance and are the same in each run.
pub(crate) struct Dice(pub(crate) u64);

impl Dice {
    /// One of 0 to sides - 1.
    pub(crate) fn roll(&mut self, sides: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % sides
    }

    /// A net of a few places and transitions with up to two arcs of each kind.
    pub(crate) fn net(&mut self, places: u64, transitions: u64, weights: u64, reads: bool) -> PtNet {
        let name = |i: u64| format!("p{i}");
        let list: Vec<String> = (0..places).map(|i| format!("{}={}", name(i), self.roll(2))).collect();
        let mut lines = String::new();
        for t in 0..transitions {
            let mut arcs = |most: u64| {
                let mut ends: Vec<u64> = (0..self.roll(most + 1)).map(|_| self.roll(places)).collect();
                ends.sort_unstable();
                ends.dedup();
                let arcs = ends.iter().map(|end| format!("{}*{}", 1 + self.roll(weights), name(*end)));
                arcs.collect::<Vec<_>>().join(" ")
            };
            let (takes, puts, seen) = (arcs(2), arcs(2), arcs(u64::from(reads)));
            lines += &format!("t{t}: {takes} -> {puts} ? {seen}\n");
        }
        net(&list.join(" "), &lines)
    }
}
