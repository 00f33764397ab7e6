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

/// A signal of a trace, scan by scan.
struct Signals(Table);

impl Signals {
    fn of(args: &[&str]) -> Signals {
        Signals(run("batch_reactor", args))
    }

    fn all(&self, name: &str) -> Vec<f64> {
        self.0.values(name)
    }

    fn at(&self, name: &str, scan: usize) -> f64 {
        self.all(name)[scan]
    }

    /// The first scan from `from` on in which a signal is so.
    fn first(&self, name: &str, from: usize, so: impl Fn(f64) -> bool) -> usize {
        let found = self.all(name).iter().skip(from).position(|value| so(*value));
        from + found.unwrap_or_else(|| panic!("{name} never becomes so"))
    }

    /// The sum of a signal over scans, the last one included.
    fn sum(&self, name: &str, from: usize, to: usize) -> f64 {
        self.all(name)[from..=to].iter().sum()
    }

    fn is_all(&self, name: &str, from: usize, to: usize, value: f64) -> bool {
        self.all(name)[from..to].iter().all(|found| (found - value).abs() < 1e-9)
    }
}

fn near(what: &str, found: f64, expected: f64, distance: f64) {
    assert!((found - expected).abs() <= distance, "{what}: expected {expected}, found {found}");
}

/// 5 kg/s from 50 to 1000 kg take 190 s, and the minute of the hold; 10 kg/s back to 50 kg take 95 s.
#[test]
fn a_batch_is_filled_and_drained_in_time() {
    let run = Signals::of(&[]);
    assert_eq!(run.first("B", 0, |step| step == 2.0), 10);
    assert_eq!((run.at("m", 100), run.at("m", 160)), (500.0, 500.0));
    assert!(run.is_all("feed", 100, 160, 0.0) && run.is_all("B.holds", 100, 160, 1.0));
    let full = run.first("B.ramps", 0, |ramps| ramps == 1.0);
    assert_eq!(full, 10 + 190 + 60);
    assert_eq!(run.at("m", full), 1000.0);
    // The drain opens, 95 s of flow, the macro's exit, and idle.
    let open = run.first("drain", full, |drain| drain == 1.0);
    let shut = run.first("drain", open, |drain| drain == 0.0);
    assert_eq!((shut - open, run.at("m", shut)), (95, 50.0));
    assert_eq!((run.first("B.made", 0, |made| made == 1.0), run.at("B", shut + 1)), (shut + 1, 1.0));
    // And after the abort.
    assert_eq!(run.first("B", 3700, |step| step == 1.0), 3700 + 95);
}

/// With all 1000 kg in the vessel: what steam, water and reaction bring is what contents and jacket keep.
#[test]
fn a_batch_keeps_its_energy() {
    let run = Signals::of(&[]);
    let (from, to) = (261, run.first("drain", 261, |drain| drain == 1.0));
    let change = |name: &str| run.at(name, to) - run.at(name, from - 1);
    let steam = 8.0 * run.sum("heat", from - 1, to - 1);
    let jacket = run.all("Tj");
    let cool = run.all("cool");
    let water: f64 = (from..=to).map(|k| 4.2 * 0.06 * cool[k - 1] * (5.0 - jacket[k - 1])).sum();
    let reaction = -100.0 * change("A");
    let kept = 4.2 * 1000.0 * change("T") + 4.2 * 200.0 * change("Tj");
    near("kJ", steam + water + reaction, kept, 1e-6 * steam);
    // Nearly all of it has reacted.
    near("reacted", reaction, 0.86 * 95_000.0, 0.02 * 95_000.0);
    // The rate after Arrhenius, 0.002/s at 80 C.
    for scan in [300, 971, 1400, 2000] {
        let kelvin = run.at("T", scan - 1) + 273.15;
        let rate = 0.002 * (8000.0 * (1.0 / 353.15 - 1.0 / kelvin)).exp();
        near("k", run.at("k", scan), rate, 1e-6 * rate);
    }
}

/// The ramp: 0.1 K/s, whatever happens, and the steam that it takes.
#[test]
fn a_batch_is_heated_by_a_ramp_that_a_hold_freezes() {
    let run = Signals::of(&[]);
    let point = run.all("SP");
    let ramps = |k: usize| point[k] - point[k - 1];
    assert!((261..500).chain(620..950).all(|k| (ramps(k) - 0.1).abs() < 1e-9));
    assert!((501..620).all(|k| ramps(k) == 0.0));
    // While both contents and jacket follow at 0.1 K/s: 0.1 (4200 + 840) kW, less what the reaction gives, of 800 kW.
    for scan in [460, 499] {
        let steam = (0.1 * (4200.0 + 840.0) - 100.0 * run.at("gone", scan)) / 8.0;
        // 3 %: the loop is still catching up.
        near("TC", run.at("TC", scan), steam, 3.0);
        near("K/s", (run.at("T", scan) - run.at("T", scan - 40)) / 40.0, 0.1, 0.005);
    }
    // From 20 C to 79 C at 0.1 K/s, and two minutes of hold.
    let reacts = run.first("B.reacts", 0, |reacts| reacts == 1.0);
    near("reacts", reacts as f64, 260.0 + 590.0 + 120.0, 5.0);
    // No more than 3 K too hot, and near 80 C at the end: what reacts there goes into the water, or warms it all up.
    assert!(run.all("T").iter().all(|temperature| *temperature < 83.0));
    near("T", run.at("T", 1640), 80.0, 1.0);
    let water = 4.2 * 0.06 * run.at("cool", 1640) * (run.at("Tj", 1640) - 5.0);
    let rise = |name: &str| run.at(name, 1640) - run.at(name, 1639);
    let warms = 4200.0 * rise("T") + 840.0 * rise("Tj");
    near("kW", water + warms, 100.0 * run.at("gone", 1640), 0.5);
}

/// The clock of the reaction stands while the batch is held, and a blind controller opens a fifth of the water.
#[test]
fn a_batch_is_held_when_its_sensor_breaks() {
    let run = Signals::of(&[]);
    let reacts = run.first("B.reacts", 0, |reacts| reacts == 1.0);
    assert_eq!(run.first("B.reacts", reacts, |reacts| reacts == 0.0), reacts + 600 + 70);
    // From the scan of the break until the operator's second word; the first came while the sensor was bad.
    assert!(run.is_all("B.holds", 1200, 1270, 1.0) && run.at("B.holds", 1270) == 0.0);
    assert!(run.is_all("TC", 1200, 1260, -20.0) && run.is_all("heat", 1200, 1260, 0.0));
    assert!(run.is_all("cool", 1200, 1260, 20.0) && run.is_all("clock", 1200, 1270, run.at("clock", 1200)));
    // Back without a bump: the controller goes on from where it was.
    assert!(run.is_all("TC.actual", 1200, 1260, 0.0) && run.at("TC.actual", 1260) == 1.0);
    // P acts on the error that there is now; the integral part begins at what makes -20 %.
    near("TC", run.at("TC", 1260), -20.0, 1.0);
    assert!(run.is_all("feed", 500, 620, 0.0) && run.is_all("drain", 500, 620, 0.0));
}

/// A command acts at once or not at all; an abort cools with all the water, and only a reset leads out of it.
#[test]
fn a_batch_is_aborted_to_a_safe_state() {
    let run = Signals::of(&[]);
    // The start at 1800 s came in a batch, and starts no second one; that at 3200 s came after an abort.
    assert!(run.is_all("B", 2142, 2560, 1.0) && run.at("B", 2560) == 2.0);
    assert_eq!(
        (run.at("B", 3099), run.at("B", 3100), run.at("TC", 3100), run.at("cool", 3100)),
        (2.0, 3.0, -100.0, 100.0)
    );
    let locked = run.first("B.locked", 3100, |locked| locked == 1.0);
    assert!(run.at("T", locked) <= 45.0 && run.at("T", locked - 1) > 45.0);
    assert!(run.is_all("B.locked", locked, 3700, 1.0) && run.is_all("B", locked, 3700, 4.0));
    assert!(run.is_all("heat", 3100, 3850, 0.0) && run.is_all("feed", 3100, 3850, 0.0));
    assert!(run.is_all("B", 3795, 3850, 1.0) && run.at("B", 3850) == 2.0);
    assert_eq!((run.at("B.made", 4200), run.at("B.aborted", 4200)), (1.0, 1.0));
    // 70 C in the place of 95 C: it trips by itself, in the scan in which it is too hot.
    let trips = Signals::of(&["--set", "high.on=70.", "--set", "high.off=65."]);
    let hot = trips.first("T", 0, |temperature| temperature >= 70.0);
    assert_eq!(trips.first("B", 0, |step| step == 3.0), hot);
    assert_eq!(trips.at("TC", hot), -100.0);
}
