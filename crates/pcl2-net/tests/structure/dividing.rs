//! Division into main loop and sub-nets.

use crate::nets::{net, place_names, tank, transition_names};
use pcl2_net::pt::{Arc, PlaceId, PtNet, TransitionId};
use pcl2_net::structure::divide::{Division, SubNet, divide};
use pcl2_net::structure::matrix::{Matrix, MatrixKind};
use pcl2_net::structure::part::{ArcKind, Part};
use pcl2_net::structure::step::maximal_step;
use std::collections::{BTreeMap, BTreeSet};

const STEPS: [&str; 7] = ["S0", "S1", "S2", "S3", "S4", "S5", "S6"];

fn text(net: &PtNet, kind: MatrixKind) -> String {
    let mut bytes = Vec::new();
    Matrix::of(net, kind).write_text(&mut bytes).unwrap();
    String::from_utf8(bytes).unwrap()
}

/// Places / transitions / what the step starts / what the exit waits for.
fn shown(sub_net: &SubNet) -> String {
    let net = &sub_net.part.net;
    let all = |count: usize| 0..count as u32;
    let places = place_names(net, all(net.places.len()).map(PlaceId));
    let transitions = transition_names(net, all(net.transitions.len()).map(TransitionId));
    let starts = transition_names(net, sub_net.starts.iter().copied());
    let ends = place_names(net, sub_net.ends.iter().map(|(arc, _)| arc.place));
    format!("{}: {places} / {transitions} / {starts} / {ends}", net.name)
}

#[test]
fn the_tanks_main_loop_with_its_pairs_is_13_by_13() {
    let division = divide(&tank(), &STEPS).unwrap();
    let expected = "\
B    t0  t1  t2  t3  t4  t5  t6  tp10  tp11  tsu1  tsu2  tsu3  tsu4
S0   -1   .   .   .   .   .   1     .     .     .     .     .     .
S1    1  -1   .   .   .   .   .     .     .     .     .     .     .
S2    .   1  -1   .   .   .   .     .     .     .     .     .     .
S3    .   .   1  -1   .   .   .     .     .     .     .     .     .
S4    .   .   .   1  -1   .   .     .     .     .     .     .     .
S5    .   .   .   .   1  -1   .     .     .     .     .     .     .
S6    .   .   .   .   .   1  -1     .     .     .     .     .     .
P0    .   .   .   .   .   .   .     1    -1     .     .     .     .
P1    .   .   .   .   .   .   .    -1     1     .     .     .     .
Su1   .  -1   .   .   .   .   .     .     .     1     .     .     .
Su2   .   .   .  -1   .   .   .     .     .     .     1     .     .
Su3   .   .   .   .  -1   .   .     .     .     .     .     1     .
Su4   .   .   .   .   .   .  -1     .     .     .     .     .     1
";
    assert_eq!(text(&division.main.net, MatrixKind::Change), expected);
    let reads = Matrix::of(&division.main.net, MatrixKind::Reads);
    let reads: Vec<(usize, u32)> =
        (0..13).flat_map(|row| reads.row(row).iter().map(move |(column, _)| (row, *column))).collect();
    // tsu1 reads S1, tsu2 S3, tsu3 S4, tsu4 S6, t0 P1.
    assert_eq!(reads, [(1, 9), (3, 10), (4, 11), (6, 12), (8, 0)]);
    let capacities: Vec<Option<u64>> = division.main.net.places.iter().map(|place| place.capacity).collect();
    assert_eq!(capacities[..9], [None; 9]);
    assert_eq!(capacities[9..], [Some(1); 4]);
    let marked: Vec<u64> = division.main.net.places.iter().map(|place| place.initial).collect();
    assert_eq!(marked, [1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0]);
    let free = division.main.net.transitions.iter().filter(|transition| transition.free);
    let free: Vec<&str> = free.map(|transition| transition.name.as_str()).collect();
    assert_eq!(free, ["t2", "t5", "tp10", "tp11", "tsu1", "tsu2", "tsu3", "tsu4"]);
}

#[test]
fn the_tanks_sub_nets_hold_what_their_steps_move() {
    let division = divide(&tank(), &STEPS).unwrap();
    let found: Vec<String> = division.sub_nets.iter().map(shown).collect();
    let expected = [
        // Equations (10) and (11).
        "Su1: L1 L0 V11 V10 Z12 Z11 Z10 D21 D20 / tL0 tL1 tv10 tv11 tz10 tz11 tz12 tz13 tD20 tD21 / tL1 tv10 / D20",
        "Su2: V11 V10 / tv10 tv11 / tv11 / V10",
        "Su3: V21 V20 Z12 Z11 Z10 D11 D10 / tv20 tv21 tz10 tz11 tz12 tz13 tD10 tD11 / tv20 / D10",
        "Su4: L1 L0 V21 V20 / tL0 tL1 tv20 tv21 / tL0 tv21 / V20 L1",
    ];
    assert_eq!(found, expected);
    let notes = [
        "`t2` waits for `D11`, to which no action of its step leads",
        "`t5` waits for `D21`, to which no action of its step leads",
    ];
    assert_eq!(division.notes, notes);
}

/// A divided net that runs: each part has a marking of its own.
struct Hierarchy<'a> {
    whole: &'a PtNet,
    division: &'a Division,
    /// Of the main net, then of the sub-nets.
    markings: Vec<Vec<u64>>,
}

impl Hierarchy<'_> {
    fn parts(&self) -> impl Iterator<Item = &Part> {
        std::iter::once(&self.division.main).chain(self.division.sub_nets.iter().map(|sub_net| &sub_net.part))
    }

    /// What the part or the parts with a place have in it.
    fn tokens(&self, place: PlaceId) -> u64 {
        let of_part = |(part, marking): (&Part, &Vec<u64>)| {
            part.places.iter().position(|own| *own == place).map(|own| marking[own])
        };
        let mut copies: Vec<u64> = self.parts().zip(&self.markings).filter_map(of_part).collect();
        copies.dedup();
        assert_eq!(copies.len(), 1, "copies of {}", self.whole.places[place.0 as usize].name);
        copies[0]
    }

    fn holds(&self, arc: Arc, kind: ArcKind, tokens: u64) -> bool {
        match kind {
            ArcKind::Read => tokens >= arc.weight,
            ArcKind::Inhibit => tokens < arc.weight,
            ArcKind::Take | ArcKind::Put => panic!("a token leaves its part"),
        }
    }

    /// One scan of all parts on the same snapshot: what fired, by name.
    fn scan(&mut self, mut press: impl FnMut(&str) -> bool) -> Vec<String> {
        let mut fired = Vec::new();
        let mut after = Vec::new();
        for (i, part) in self.parts().enumerate() {
            let step = maximal_step(&part.net, &self.markings[i], |id| {
                let pair = self.division.sub_nets.iter().position(|sub_net| i == 0 && sub_net.transition == id);
                if let Some(pair) = pair {
                    let marking = &self.markings[pair + 1];
                    let ends = &self.division.sub_nets[pair].ends;
                    return ends.iter().all(|(arc, kind)| self.holds(*arc, *kind, marking[arc.place.0 as usize]));
                }
                let mut outer = part.outer.iter().filter(|outer| outer.transition == id);
                let of_whole = &self.whole.transitions[part.transitions[id.0 as usize].0 as usize];
                outer.all(|outer| self.holds(outer.arc, outer.kind, self.tokens(outer.arc.place)))
                    && (!of_whole.free || press(&of_whole.name))
            });
            let step = step.unwrap();
            fired.extend(step.fired.iter().map(|id| part.net.transitions[id.0 as usize].name.clone()));
            after.push(step.marking);
        }
        self.markings = after;
        fired
    }
}

#[test]
fn the_hierarchical_run_fires_what_the_flat_one_fires() {
    let whole = tank();
    let division = divide(&whole, &STEPS).unwrap();
    let initial = |part: &Part| part.net.places.iter().map(|place| place.initial).collect::<Vec<u64>>();
    let mut hierarchy = Hierarchy { whole: &whole, division: &division, markings: Vec::new() };
    let start: Vec<Vec<u64>> = hierarchy.parts().map(initial).collect();
    hierarchy.markings = start.clone();
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    let mut scans = 0;
    while scans == 0 || hierarchy.markings != start {
        let fired = hierarchy.scan(|name| name == "tp11" && scans == 0 || name == "tp10" && scans == 1);
        fired.into_iter().for_each(|name| *counts.entry(name).or_default() += 1);
        scans += 1;
        assert!(scans < 100);
    }
    // A scan more for each of the pairs.
    assert_eq!(scans, 20);
    let copies = |name: &str| {
        hierarchy.parts().filter(|part| part.net.transitions.iter().any(|other| other.name == name)).count()
    };
    let once: BTreeMap<String, usize> = counts.keys().map(|name| (name.clone(), copies(name))).collect();
    assert_eq!((counts.len(), &counts), (27, &once));
}

#[test]
fn devices_that_lead_to_no_exit_and_waits_for_nothing_are_placed_and_told() {
    let net = net(
        "A=1 B lamp0=1 lamp1 horn0=1 horn1 key0=1 key1 led0=1 led1 Su1",
        "next: A -> B ? key1
         back: B -> A ? !2*key1
         on: lamp0 -> lamp1 ? A
         off: lamp1 -> lamp0 ? B
         blow: horn0 -> horn1 ? !lamp0
         turn: key0 -> key1
         show: led0 -> led1 ? key1",
    );
    let division = divide(&net, &["A", "B"]).unwrap();
    let main = &division.main.net;
    assert_eq!(place_names(main, (0..main.places.len() as u32).map(PlaceId)), "A B key0 key1 led0 led1 Su1 Su1_ Su2");
    let found: Vec<String> = division.sub_nets.iter().map(shown).collect();
    let expected =
        ["Su1_: lamp0 lamp1 horn0 horn1 / on off blow / on / ", "Su2: lamp0 lamp1 horn0 horn1 / on off blow / off / "];
    assert_eq!(found, expected);
    let notes = [
        "step `A`: its exit `next` waits for no place of its sub-net `Su1_`",
        "step `B`: its exit `back` waits for no place of its sub-net `Su2`",
    ];
    assert_eq!(division.notes, notes);
    let gates: BTreeSet<u32> = main.transitions.iter().map(|transition| transition.gate).collect();
    assert_eq!(gates.len(), main.transitions.len());
}

#[test]
fn what_cannot_be_divided_is_told() {
    let tank = tank();
    let refused = |net: &PtNet, steps: &[&str]| divide(net, steps).unwrap_err();
    assert_eq!(refused(&tank, &["S0", "s9"]), "expected a place of the net, found `s9`");
    assert_eq!(refused(&tank, &["S0", "S1", "S0"]), "expected each step once, found `S0` again");
    assert_eq!(refused(&tank, &[]), "expected the names of the steps, found none");
    assert_eq!(
        refused(&tank, &STEPS[..6]),
        "transition `t5`: expected tokens to move from step to step only, found `S6`; make it a step, or read it"
    );
    let choice = net("A=1 B C", "b: A -> B\nc: A -> C\nd: B -> A\ne: C -> A");
    assert_eq!(
        refused(&choice, &["A", "B", "C"]),
        "step `A`: expected one transition that leaves it and ends its sub-net, found `b` and `c`"
    );
    let end = net("A=1 B", "b: A -> B");
    assert_eq!(refused(&end, &["A", "B"]), "step `B`: expected a transition that leaves it, found none");
    let drain = net("A=1 B", "b: A -> B\nend: B ->");
    assert_eq!(
        refused(&drain, &["A", "B"]),
        "transition `end`: expected a step that it leads to, found none: the main loop is open there"
    );
    let source = net("A=1", "make: -> A");
    assert_eq!(
        refused(&source, &["A"]),
        "transition `make`: expected a step that it leaves, found none: the main loop is open there"
    );
}
