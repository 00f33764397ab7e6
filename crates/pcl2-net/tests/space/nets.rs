//! Small nets at random, always the same.

use pcl2_net::pt::{Arc, Place, PlaceId, PtNet, Transition};

pub(crate) struct Dice(pub(crate) u64);

impl Dice {
    pub(crate) fn roll(&mut self, sides: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % sides
    }
}

/// What a random net may have.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Flavour {
    /// Weights, capacities of all places, read and inhibitor arcs, free transitions, gates with several.
    All,
    /// Weights and read arcs: places may be unbounded.
    Open,
    /// Each transition moves one token for each that it takes, so that nothing is lost or made.
    Moving,
}

pub(crate) fn random(dice: &mut Dice, flavour: Flavour) -> PtNet {
    let count = 2 + dice.roll(5);
    let places = (0..count).map(|i| place(i, dice, flavour)).collect();
    let transitions = (0..2 + dice.roll(8)).map(|i| transition(i, count, dice, flavour)).collect();
    PtNet { name: "random".to_owned(), places, transitions }
}

fn place(i: u64, dice: &mut Dice, flavour: Flavour) -> Place {
    let (most, initial) = (1 + dice.roll(3), dice.roll(4));
    let capacity = (flavour == Flavour::All).then_some(most);
    Place { name: format!("p{i}"), initial: initial.min(capacity.unwrap_or(2)), capacity }
}

fn transition(i: u64, places: u64, dice: &mut Dice, flavour: Flavour) -> Transition {
    let all = flavour == Flavour::All;
    let mut transition = Transition {
        name: format!("t{i}"),
        takes: arcs(dice, places, 3),
        puts: arcs(dice, places, 3),
        reads: arcs(dice, places, if flavour == Flavour::Moving { 1 } else { 2 }),
        inhibits: arcs(dice, places, if all { 2 } else { 1 }),
        free: all && dice.roll(2) == 0,
        gate: if all && dice.roll(4) == 0 { 0 } else { i as u32 },
    };
    if flavour == Flavour::Moving {
        let weights = transition.takes.iter().map(|arc| arc.weight).sum();
        transition.puts = vec![Arc { place: PlaceId(dice.roll(places) as u32), weight: weights }];
        transition.puts.retain(|arc| arc.weight > 0);
    }
    transition
}

/// Fewer than so many arcs.
fn arcs(dice: &mut Dice, places: u64, end: u64) -> Vec<Arc> {
    let mut arcs: Vec<Arc> = Vec::new();
    for _ in 0..dice.roll(end) {
        let place = PlaceId(dice.roll(places) as u32);
        if arcs.iter().all(|arc| arc.place != place) {
            arcs.push(Arc { place, weight: 1 + dice.roll(2) });
        }
    }
    arcs
}
