//! The measuring tank as a whole.

use crate::nets::{place_names, tank, transition_names};
use pcl2_net::structure::matrix::{Matrix, MatrixKind};
use pcl2_net::structure::modules::modules;
use pcl2_net::structure::step::maximal_step;

#[test]
fn has_22_places_and_23_transitions() {
    let matrix = Matrix::of(&tank(), MatrixKind::Change);
    assert_eq!((matrix.rows.len(), matrix.columns.len()), (22, 23));
}

#[test]
fn its_modules_are_its_devices() {
    let net = tank();
    let found: Vec<String> = modules(&net)
        .iter()
        .map(|module| {
            let places = place_names(&net, module.places.iter().copied());
            format!("{}: {places} / {}", module.name, transition_names(&net, module.transitions.iter().copied()))
        })
        .collect();
    let expected = [
        "S: S0 S1 S2 S3 S4 S5 S6 / t0 t1 t2 t3 t4 t5 t6",
        "P: P0 P1 / tp10 tp11",
        "L: L1 L0 / tL0 tL1",
        "V1: V11 V10 / tv10 tv11",
        "V2: V21 V20 / tv20 tv21",
        "Z1: Z12 Z11 Z10 / tz10 tz11 tz12 tz13",
        "D1: D11 D10 / tD10 tD11",
        "D2: D21 D20 / tD20 tD21",
    ];
    assert_eq!(found, expected);
}

/// The scans from a press of the button on, the button let go in the scan `release`, until the first marking is back.
fn run(release: usize) -> Vec<String> {
    let net = tank();
    let start: Vec<u64> = net.places.iter().map(|place| place.initial).collect();
    let mut marking = start.clone();
    let mut scans = Vec::new();
    while scans.len() < 40 && (scans.is_empty() || marking != start) {
        let scan = scans.len();
        let press = |name: &str| name == "tp11" && scan == 0 || name == "tp10" && scan == release;
        let step = maximal_step(&net, &marking, |id| press(&net.transitions[id.0 as usize].name)).unwrap();
        scans.push(transition_names(&net, step.fired));
        marking = step.marking;
    }
    scans
}

/// The run without the button's release: it may come in any scan but the first.
pub(crate) const SCANS: [&str; 16] = [
    "tp11",
    "t0",
    "tL1 tv10",
    "tz11",
    "tz10 tD21",
    "t1 tD10",
    "t2",
    "tv11",
    "t3",
    "tv20",
    "tz12",
    "tz13 tD11",
    "t4 tD20",
    "t5",
    "tL0 tv21",
    "t6",
];

#[test]
fn runs_16_scans_and_fires_each_transition_once() {
    let net = tank();
    for release in 1..16 {
        let scans = run(release);
        let rest: Vec<String> = scans
            .iter()
            .map(|scan| scan.split(' ').filter(|name| *name != "tp10").collect::<Vec<_>>().join(" "))
            .collect();
        assert_eq!(rest, SCANS, "released in scan {release}");
        let mut fired: Vec<&str> = scans.iter().flat_map(|scan| scan.split(' ')).collect();
        let mut all: Vec<&str> = net.transitions.iter().map(|transition| transition.name.as_str()).collect();
        fired.sort_unstable();
        all.sort_unstable();
        assert_eq!(fired, all, "released in scan {release}");
    }
}

#[test]
fn starts_again_while_the_button_is_held() {
    let scans = run(40);
    assert_eq!(scans[..16], SCANS);
    assert_eq!(scans[16], "t0");
}
