//! The examples of nets, held against their papers and against what an engineer computes by hand.

use pcl2_tests::cases::{Width, example};
use pcl2_tests::compilers::check;
use pcl2_tests::table::Table;
use pcl2_tests::{pcl2, root};

/// The trace of an example under its stimulus.
fn run(name: &str, args: &[&str]) -> Table {
    let case = example(name);
    let mut command = case.run("embedded", Width::F64);
    command.args(args);
    Table::read(&case.trace(command).unwrap())
}

/// The trace of another program in an example's folder, under the example's stimulus.
fn run_beside(name: &str, program: &str) -> Table {
    let mut command = pcl2();
    command.args(["run", program, "--trace", "-", "--stimulus", "stimulus.csv"]);
    Table::read(&check(command.current_dir(example(name).folder)))
}

const DEVICES: [&str; 15] =
    ["P0", "P1", "L0", "L1", "V10", "V11", "V20", "V21", "Z10", "Z11", "Z12", "D10", "D11", "D20", "D21"];
const STEPS: [&str; 7] = ["S0", "S1", "S2", "S3", "S4", "S5", "S6"];

/// The places of the paper's net, in the trace of a plant and a controller.
fn places(trace: &Table) -> Vec<Vec<f64>> {
    let devices = DEVICES.iter().map(|place| trace.values(&format!("tank.{place}")));
    devices.chain(STEPS.iter().map(|step| trace.values(&format!("plc.{step}")))).collect()
}

/// The paper's net in one piece.
fn whole_tank() -> Table {
    let folder = pcl2_tests::compilers::folder();
    let stimulus = folder.path().join("stimulus.csv");
    std::fs::write(&stimulus, "k,press,release\n0,1,0\n2,0,1\n17,,\n").unwrap();
    let mut command = pcl2();
    command.arg("run").arg(root().join("tests/nets/tank.net")).args(["--trace", "-", "--stimulus"]).arg(stimulus);
    Table::read(&check(&mut command))
}

#[test]
fn a_measuring_tank_in_two_pieces_is_that_in_one() {
    let whole = whole_tank();
    let expected: Vec<Vec<f64>> =
        DEVICES.iter().chain(&STEPS).map(|place| whole.values(&format!("tank.{place}"))).collect();
    assert_eq!(places(&run("measuring_tank", &[])), expected);
}

#[test]
fn a_measuring_tank_does_the_same_by_steps_with_nets_of_their_own() {
    let (flat, hierarchical) = (run("measuring_tank", &[]), run_beside("measuring_tank", "steps.cfg"));
    assert_eq!(places(&hierarchical), places(&flat));
    for output in ["plc", "plc.open1", "plc.close1", "plc.open2", "plc.close2", "plc.light", "plc.dim"] {
        assert_eq!(hierarchical.values(output), flat.values(output), "{output}");
    }
}

/// Jeong and Yang: 16 scans from the button to the start, and each of the 23 transitions fires once.
#[test]
fn a_measuring_tank_is_back_after_sixteen_scans() {
    let places = places(&run("measuring_tank", &[]));
    let start: Vec<f64> = DEVICES.iter().chain(&STEPS).map(|place| f64::from(START.contains(place))).collect();
    let after = |scan: usize| -> Vec<f64> { places.iter().map(|tokens| tokens[scan]).collect() };
    assert_eq!((0..18).find(|scan| after(*scan) == start), Some(15));
    // Each transition puts one token, into a place that was empty.
    let entered = |scan: usize| -> usize {
        let before = if scan == 0 { start.clone() } else { after(scan - 1) };
        before.iter().zip(after(scan)).filter(|(before, after)| after > *before).count()
    };
    assert_eq!((0..16).map(entered).sum::<usize>(), 23);
}

const START: [&str; 8] = ["S0", "P0", "L1", "V10", "V20", "Z10", "D10", "D21"];

/// The moves from a station to another on the ring of eight, counted one by one: pass 1, left 2, stop 3.
fn moves(here: i32, there: i32) -> Vec<i32> {
    let (mut at, mut moves) = (here, vec![]);
    while at != there {
        if [2, 4, 6, 8].contains(&at) {
            moves.push(2);
        }
        at = if at == 8 { 1 } else { at + 1 };
        moves.push(1);
    }
    // The last station is not passed, the vehicle stops there.
    moves.pop();
    moves.push(3);
    moves
}

/// What the functions in C give, for all pairs of stations.
#[test]
fn a_guided_vehicle_knows_its_ways() {
    let mut program = "CONTROL\n".to_owned();
    for station in 1..9 {
        program += &format!("s{station} = {station}\n");
    }
    for (here, there) in pairs() {
        program += &format!("w{here}{there} = route ( s{here}, s{there} : )\n");
        program += &format!("t{here}{there} = duration ( w{here}{there} : )\n");
        program += &format!("o{here}{there} = {}\n", 100 * here + there);
        program += &format!("p{here}{there}, d{here}{there} = stations ( o{here}{there} : )\n");
    }
    let folder = pcl2_tests::compilers::folder();
    std::fs::write(folder.path().join("main.cfg"), program + "END\n").unwrap();
    let mut command = pcl2();
    command.args(["run", "main.cfg", "--engine", "cc", "--steps", "1", "--trace", "-", "--blocks"]);
    let trace = Table::read(&check(command.arg(example("agv").folder.join("blocks")).current_dir(folder.path())));
    let value = |letter: &str, (here, there): (i32, i32)| trace.values(&format!("{letter}{here}{there}"))[0];
    for (here, there) in pairs() {
        let moves = moves(here, there);
        let word = moves.iter().fold(0, |word, digit| 4 * word + digit);
        assert_eq!(value("w", (here, there)), f64::from(word), "from {here} to {there}");
        assert_eq!(value("t", (here, there)), moves.len() as f64, "from {here} to {there}");
        let legal = if here == there { (0.0, 0.0) } else { (f64::from(here), f64::from(there)) };
        assert_eq!((value("p", (here, there)), value("d", (here, there))), legal, "from {here} to {there}");
    }
}

fn pairs() -> impl Iterator<Item = (i32, i32)> {
    (1..9).flat_map(|here| (1..9).map(move |there| (here, there)))
}

/// Nagao and Kumagai, Fig. 9: the boxes that are marked after the scans of the first transport; then what a hand computes
/// for the others.
#[test]
fn a_guided_vehicle_goes_the_way_of_the_figure() {
    let trace = Table::read(&std::fs::read_to_string(example("agv").folder.join("trace.csv")).unwrap());
    let boxes = ["b1", "b2", "b3", "b4", "b5", "b6", "b7", "b9", "b10", "b11", "b13", "b14"];
    let tokens: Vec<Vec<f64>> = boxes.iter().map(|name| trace.values(&format!("agv.{name}"))).collect();
    let marked = |scan: usize| -> Vec<&str> {
        boxes.iter().zip(&tokens).filter(|(_, tokens)| tokens[scan] > 0.0).map(|(name, _)| *name).collect()
    };
    let figure: [(usize, &[&str]); 8] = [
        (0, &["b5"]),
        (2, &["b5", "b11", "b13"]),
        (3, &["b1", "b13"]),
        (4, &["b1"]),
        (10, &["b2"]),
        // From here on the second order waits.
        (14, &["b3", "b11"]),
        (15, &["b6", "b11"]),
        (24, &["b4", "b11"]),
    ];
    for (scan, expected) in figure {
        assert_eq!(marked(scan), expected, "after scan {scan}");
    }
    for scan in 0..trace.rows.len() {
        assert_eq!(tokens[..7].iter().map(|tokens| tokens[scan]).sum::<f64>(), 1.0, "scan {scan}");
    }
    // 3 to 10: a scan to hear of it, 6 moves. 10 to 14: a scan, 3 s. 15 to 19: a scan, 3 s. 19 to 24: 5 moves. 24 to 29.
    let done = trace.values("agv.done");
    let ends = |number: f64| done.iter().position(|done| *done == number).unwrap();
    let transport = |first: i32, pick: i32, drop: i32| -> usize {
        let ways = moves(first, pick).len() + moves(pick, drop).len();
        // To b1, then to each of the others with a scan in which the vehicle hears of it; loading, answering, unloading.
        1 + (1 + 3) + 1 + (1 + 3) + (1 + 4) + 1 + ways
    };
    assert_eq!(ends(1.0), 2 + transport(8, 4, 7));
    assert_eq!(ends(2.0), ends(1.0) + transport(7, 1, 2));
    // Sent at 63 s in vain, again after 5 s without an answer; heard in the scan in which the link is back.
    let undisturbed = ends(2.0) + transport(2, 6, 8);
    assert_eq!(undisturbed, 74);
    assert_eq!(ends(3.0), undisturbed + 4);
    assert_eq!(trace.values("agv.tries")[67..69], [1.0, 2.0]);
    assert_eq!(trace.values("agv.refused")[90], 1.0);
}
