//! The examples of whole plants, held against what an engineer computes by hand.

use pcl2_tests::cases::{Width, example};
use pcl2_tests::compilers::{check, folder};
use pcl2_tests::pcl2;
use pcl2_tests::table::Table;
use std::collections::BTreeMap;
use std::fs;

/// The trace of an example under its stimulus, column by column.
struct Run(BTreeMap<String, Vec<f64>>);

impl Run {
    fn of(name: &str) -> Run {
        Run::with(name, &[])
    }

    fn with(name: &str, args: &[&str]) -> Run {
        let case = example(name);
        let mut command = case.run("embedded", Width::F64);
        command.args(args);
        Run::read(&case.trace(command).unwrap())
    }

    fn read(csv: &str) -> Run {
        let trace = Table::read(csv);
        Run(trace.header.iter().skip(2).map(|name| (name.clone(), trace.values(name))).collect())
    }

    fn at(&self, name: &str, scan: usize) -> f64 {
        self.all(name)[scan]
    }

    fn all(&self, name: &str) -> &[f64] {
        self.0.get(name).unwrap_or_else(|| panic!("no column {name}"))
    }

    fn is(&self, name: &str, scan: usize) -> bool {
        self.at(name, scan) != 0.0
    }

    /// How much a signal changed since the scan before, or since one further back.
    fn change(&self, name: &str, from: usize, to: usize) -> f64 {
        self.at(name, to) - self.at(name, from)
    }

    /// How far a signal is from a value at most, from scan to scan.
    fn furthest(&self, name: &str, from: usize, to: usize, value: f64) -> f64 {
        self.all(name)[from..to].iter().fold(0.0, |worst, found| (found - value).abs().max(worst))
    }

    /// The first scan from `from` on in which a signal is so.
    fn first(&self, name: &str, from: usize, so: impl Fn(f64) -> bool) -> usize {
        let found = self.all(name).iter().skip(from).position(|value| so(*value));
        from + found.unwrap_or_else(|| panic!("{name} never becomes so"))
    }
}

fn near(what: &str, found: f64, expected: f64, distance: f64) {
    assert!((found - expected).abs() <= distance, "{what}: expected {expected}, found {found}");
}

/// How many scans a lag needs to pass a part of its way, when each goes on by `e^(-rate T)`.
fn scans_of_lag(left: f64, rate: f64, period: f64) -> usize {
    ((1.0 / left).ln() / (rate * period)).ceil() as usize
}

#[test]
fn a_burner_starts_by_its_timers() {
    let run = Run::of("burner");
    // The fan passes 80 % when e^(-0.5 t) = 0.2; then 10 s of purge, 3 s of trial, 2 s of a steady flame.
    let air = 20 + scans_of_lag(0.2, 0.5, 0.1);
    assert_eq!(air, 53);
    assert_eq!(run.first("run", 0, |run| run == 1.0), 20);
    assert_eq!(run.first("vp", 0, |vp| vp == 1.0), air + 100);
    assert_eq!(run.first("spark", air + 100, |spark| spark == 0.0), air + 130);
    assert_eq!(run.first("vm", 0, |vm| vm == 1.0), air + 150);
    assert_eq!(run.first("vp", air + 100, |vp| vp == 0.0), air + 200);
    // The stop at 40 s: gas at once, the fan 5 s later.
    assert_eq!(run.first("vm", 300, |vm| vm == 0.0), 400);
    assert_eq!(run.first("fan", 300, |fan| fan == 0.0), 450);
}

#[test]
fn a_burner_burns_at_the_balance_of_its_pipe() {
    // pg = 50 - 0.1 q and q = 2 (0.9) pg: q = 90/1.18; the furnace has 0.5 mbar of air and 0.02 q of burnt gas.
    let run = Run::of("burner");
    let q = 90.0 / 1.18;
    near("q", run.at("q", 399), q, 1e-6);
    near("pg", run.at("pg", 399), 50.0 - 0.1 * q, 1e-6);
    near("pf", run.at("pf", 399), 0.5 + 0.02 * q, 1e-5);
}

#[test]
fn a_burner_trips_in_time() {
    let run = Run::of("burner");
    let cause = |from: usize| {
        let scan = run.first("lock", from, |lock| lock == 1.0);
        (scan, run.at("cause", scan))
    };
    // The scanner's signal falls from 100 to 20 at 4/s, from the scan of the storm on; then 0.5 s.
    let dark = 800 + scans_of_lag(0.2, 4.0, 0.1) - 1;
    assert_eq!(cause(410), (dark + 5, 2.0));
    assert!(dark + 5 - 800 < 10, "the flame failure takes a second");
    // 30 mbar less what the flow takes is below 35 mbar in the first scan; then 1 s.
    assert_eq!(cause(900), (1200 + 10, 3.0));
    // The furnace goes from p to 3 p with 1/s, and p is that of the full flow; the trip is at 5 mbar.
    let p = 0.5 + 0.02 * 90.0 / 1.18;
    assert_eq!(cause(1300), (1600 + scans_of_lag((3.0 * p - 5.0) / (2.0 * p), 1.0, 0.1) - 1, 4.0));
    // No ignition: the trial time after the pilot valve opened.
    assert_eq!(cause(1700), (run.first("vp", 1700, |vp| vp == 1.0) + 30, 1.0));
    for (reset, trip) in [(860, 809), (1260, 1210), (1680, 1613)] {
        assert!(run.all("lock")[trip..reset].iter().all(|lock| *lock == 1.0) && run.at("lock", reset) == 0.0);
    }
}

#[test]
fn a_burner_is_safe_in_every_scan() {
    let run = Run::of("burner");
    let fuel = |scan: usize| run.is("vp", scan) || run.is("vm", scan);
    let (mut purge, mut dark) = (0, 0);
    for scan in 0..run.all("run").len() {
        let shut = run.is("lock", scan) || !run.is("run", scan) || run.is("stop", scan);
        assert!(!(shut && fuel(scan)), "scan {scan}: fuel although it must be shut");
        assert!(!run.is("spark", scan) || run.is("vp", scan) && !run.is("vm", scan), "scan {scan}: a spark");
        assert!(!fuel(scan) || run.is("fan", scan), "scan {scan}: fuel without the fan");
        if scan > 0 && fuel(scan) && !fuel(scan - 1) {
            assert!(purge >= 100, "scan {scan}: fuel after {purge} scans of purge");
        }
        purge = if run.is("air", scan) && !fuel(scan) { purge + 1 } else { 0 };
        dark = if run.is("vm", scan) && !run.is("fire", scan) { dark + 1 } else { 0 };
        assert!(dark < 10, "scan {scan}: gas without a flame for a second");
    }
    // The starts at 84 s (locked) and 89 s (gas pressure) are refused, and missing says why.
    for (start, missing) in [(840, 8.0), (890, 1.0)] {
        assert!(run.is("push", start) && run.is("refused", start) && !run.is("run", start), "start at scan {start}");
        assert_eq!(run.at("missing", start), missing, "start at scan {start}");
    }
}

/// Each of its four sensors breaks while the burner fires.
#[test]
fn a_burner_does_not_fire_blind() {
    let source = fs::read_to_string(example("burner").folder.join("main.cfg")).unwrap();
    let stimulus = "t,start.value,\"ain(0,1,1)\"\n2,1,\n2.5,0,\n40,,nan\n45,,\n";
    for (signal, trip, cause) in [("pg", 410, 3.0), ("f", 405, 2.0), ("a", 400, 5.0), ("pf", 400, 4.0)] {
        let sensor =
            format!("CONTROL\n24 wire = ain ( : 0, 1, 1 )\n25 sensed = sumII ( 1, {signal}, wire, 2 : 1., 1. )\n");
        let broken = source.replace("CONTROL\n", &sensor).replace(&format!("hyst ( {signal} :"), "hyst ( sensed :");
        let folder = folder();
        fs::write(folder.path().join("main.cfg"), broken).unwrap();
        fs::write(folder.path().join("stimulus.csv"), stimulus).unwrap();
        let mut command = pcl2();
        command.args(["run", "main.cfg", "--period", "0.1", "--trace", "-", "--stimulus", "stimulus.csv"]);
        let run = Run::read(&check(command.current_dir(folder.path())));
        assert!(run.is("vm", 399), "{signal}");
        assert_eq!(run.first("vm", 300, |vm| vm == 0.0), trip, "{signal}");
        assert_eq!((run.at("lock", trip), run.at("cause", trip)), (1.0, cause), "{signal}");
    }
}

#[test]
fn an_exchanger_rests_where_its_heat_is_balanced() {
    // 2200 F = 4.2 W (T - Tin), and the valve passes 2 kg/s when it is open and the pressure is 10 bar.
    let run = Run::of("exchanger");
    for (scan, load, outlet, pressure) in [(699, 10.0, 70.0, 10.0), (1099, 13.0, 70.0, 10.0), (1399, 13.0, 75.0, 10.0)]
    {
        let steam = 4.2 * load * (outlet - 20.0) / 2200.0;
        near("TT", run.at("TT", scan), outlet, 0.02);
        near("F", run.at("F", scan), steam, 0.002);
        near("FC", run.at("FC", scan), 100.0 * steam / 2.0 * 10.0 / pressure, 0.1);
    }
    near("FC", run.at("FC", 1699), 100.0 * 4.2 * 13.0 * 55.0 / 2200.0 / 1.6, 0.1);
    // At rest, what the steam brings is what the water takes.
    let heat = 2200.0 * run.change("steam", 500, 650) / 3600.0;
    near("kWh", run.change("kWh", 500, 650), heat, 0.002 * heat);
}

#[test]
fn each_section_of_an_exchanger_counts_in_its_own_period() {
    let run = Run::of("exchanger");
    // From the law of a PI controller: T = Ti (du - dff - K (dw - dy))/(K e'), in scans that follow one another.
    let mut runs = 0;
    for k in (215..400).step_by(5) {
        let gain = 0.025;
        let moved = run.change("TC", k - 5, k) - run.change("FF", k - 5, k) + gain * run.change("TT", k - 5, k);
        near("T of TC", 30.0 * moved / (gain * (70.0 - run.at("TT", k - 5))), 2.5, 1e-6);
        runs += 1;
    }
    assert_eq!(runs, 37);
    for k in 1402..1420 {
        let gain = 40.0;
        let e = run.at("TC", k - 1) - run.at("F", k - 1);
        let p = gain * (run.change("TC", k - 1, k) - run.change("F", k - 1, k));
        near("T of FC", 2.0 * (run.change("FC", k - 1, k) - p) / (gain * e), 0.5, 1e-6);
    }
    for k in (50..2101).step_by(50) {
        near("steam", run.change("steam", k - 1, k), 25.0 * run.at("F", k), 1e-9);
    }
    // And between its turns a section does nothing.
    for k in 1..2101 {
        assert!(k % 5 == 0 || run.change("TC", k - 1, k) == 0.0 && run.change("FF", k - 1, k) == 0.0, "scan {k}");
        assert!(k % 50 == 0 || run.change("steam", k - 1, k) == 0.0 && run.change("mean", k - 1, k) == 0.0, "scan {k}");
    }
}

#[test]
fn an_exchanger_closes_its_cascade_and_loses_its_sensor_without_a_bump() {
    let run = Run::of("exchanger");
    // TC waits at the flow loop's set-point, and goes on from there.
    assert!(run.all("TC.actual")[5..205].iter().all(|actual| *actual == 4.0));
    assert!(run.all("TC")[25..205].iter().all(|point| *point == 0.5));
    assert!(run.furthest("FC", 190, 205, 25.0) < 0.05);
    // The sensor breaks at 850 s: held for the 10 s of tbad, then manual; TC does not move before 902.5 s.
    let shed = run.first("TC.actual", 1700, |actual| actual == 0.0);
    assert_eq!((shed, run.first("TC.actual", shed, |actual| actual == 1.0)), (1720, 1800));
    let held = run.at("TC", 1699);
    assert!(run.all("TC")[1700..1805].iter().all(|point| *point == held));
    let valve = run.at("FC", 1699);
    assert!(run.furthest("FC", 1700, 1820, valve) < 0.05, "{}", run.furthest("FC", 1700, 1820, valve));
}

#[test]
fn an_exchanger_is_tuned() {
    let run = Run::of("exchanger");
    // A third more water would cost 50 (1 - 10/13) = 11.5 K: feed-forward leaves a twentieth of it.
    let load = 50.0 * (1.0 - 10.0 / 13.0);
    assert!(run.furthest("TT", 700, 1100, 70.0) < 0.05 * load);
    let alone = Run::with("exchanger", &["--set", "FF.k=0"]);
    assert!(alone.furthest("TT", 700, 1100, 70.0) > 0.4 * load);
    // A new set-point: there in two minutes, no more than 0.1 K beyond. Less steam pressure: 2 s of a flow that is too low.
    assert!(run.all("TT")[1100..1400].iter().all(|outlet| *outlet < 75.1));
    assert!(run.furthest("TT", 1340, 1400, 75.0) < 0.1);
    assert!(run.furthest("TT", 1400, 1700, 75.0) < 1.0);
    near("F", run.at("F", 1420), run.at("TC", 1420), 0.03);
    // A settled loop: what the feedback gave is the integral of its error, du = (K/Ti) sum(e) T.
    let e: f64 = (695..1095).step_by(5).map(|k| 70.0 - run.at("TT", k)).sum();
    let given = run.change("TC", 695, 1095) - run.change("FF", 695, 1095) + 0.025 * run.change("TT", 695, 1095);
    near("du", given, 0.025 / 30.0 * 2.5 * e, 1e-12);
}

#[test]
fn a_level_starts_where_its_valves_stand() {
    let run = Run::of("level");
    for (name, rest) in [("xa", 100.0 * 4.0 / 7.0), ("va", 100.0 * 4.0 / 7.0), ("xb", 0.0), ("vb", 0.0), ("q", 20.0)] {
        let moved = run.furthest(name, 0, 120, rest);
        assert!(moved < 1e-6, "{name} moves by {moved}");
    }
    assert!(run.all("FC.actual")[6..120].iter().all(|actual| *actual == 2.0));
    assert!(run.all("LC.actual")[6..120].iter().all(|actual| *actual == 1.0));
}

#[test]
fn a_level_keeps_its_balances() {
    let run = Run::of("level");
    for k in 1..2401 {
        // What comes in and does not go out stays: 1 m3/h for a second is 1/180 % of 5 m3.
        let stays = (run.at("qi", k) - run.at("q", k)) * 0.5 / 180.0;
        near("dh", run.change("h", k - 1, k), stays, 1e-9);
        // The ranges are as the valves' sizes: together they open in proportion to the one output.
        if k > 10 {
            near("open", 0.2 * run.at("va", k) + 0.6 * run.at("vb", k), 0.8 * run.at("OV", k), 1e-9);
            assert!(run.at("va", k) == 100.0 || run.at("vb", k) == 0.0, "scan {k}: both valves move");
        }
    }
    // At rest at 20 m3/h: p = 2 + 0.05 (20), an opening of 4 (20)/(10 - p).
    near("p", run.at("p", 119), 3.0, 1e-6);
    near("OV", run.at("OV", 119), 4.0 * 20.0 / 7.0 / 0.8, 1e-6);
    // Under the override 6 = 4.5 + 0.05 q, and the opening is 4 (30)/(10 - 6).
    near("q", run.at("q", 1690), 30.0, 1e-3);
    near("OV", run.at("OV", 1690), 4.0 * 30.0 / 4.0 / 0.8, 1e-3);
}

#[test]
fn a_level_changes_its_modes_without_a_bump() {
    let run = Run::of("level");
    // FC: cascade to manual, and the whole time in manual until the operator moves it.
    near("OV", run.furthest("OV", 119, 160, run.at("OV", 119)), 0.0, 1e-12);
    near("OV", run.at("OV", 165), 16.0, 0.0);
    // Manual to automatic, automatic to cascade, and LC to manual.
    for (from, to) in [(199, 200), (279, 283), (399, 403)] {
        let moved = run.furthest("OV", from, to + 1, run.at("OV", from));
        assert!(moved < 1e-3, "scan {from}: the output moves by {moved}");
    }
    // While FC has its own set-point, LC waits there; it goes on from it, and from its manual output, by its own law.
    assert!(run.all("LC.actual")[121..281].iter().all(|actual| *actual == 4.0));
    near("LC", run.furthest("LC", 121, 281, 20.0), 0.0, 1e-9);
    near("LC", run.change("LC", 280, 281), 2.0 * run.change("h", 280, 281), 1e-6);
    near("LC", run.change("LC", 519, 520), 2.0 * run.change("h", 519, 520), 1e-9);
}

#[test]
fn a_level_is_overridden_and_nothing_winds_up() {
    let run = Run::of("level");
    // PC acts within 2 s of the network's pressure, which never passes 6 bar; FC acts 2 s after it is gone.
    let acts = run.first("OV.idx", 1400, |number| number == 2.0);
    assert!(acts < 1404 && run.first("OV.idx", acts, |number| number == 1.0) < 1705, "PC acts from scan {acts}");
    assert!(run.all("OV.idx")[acts..1700].iter().all(|number| *number == 2.0));
    assert!(run.all("p").iter().all(|p| *p < 6.0));
    // The one that does not act is K e away from the output, not more.
    near("FC", run.at("FC", 1690), run.at("OV", 1690) + 0.4 * (run.at("LC", 1690) - run.at("q", 1690)), 1e-3);
    near("PC", run.at("PC", 119), run.at("OV", 119) + 5.0 * (6.0 - run.at("p", 119)), 1e-3);
    // LC's output grows with the level, its integral part does not.
    let integral = |k: usize| run.at("LC", k) - 2.0 * (run.at("h", k) - 50.0);
    assert!(integral(1700) <= integral(acts + 1), "{} to {}", integral(acts + 1), integral(1700));
    assert!(run.change("h", acts, 1700) > 8.0);
}
