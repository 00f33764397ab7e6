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
