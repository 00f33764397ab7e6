//! What a controller must never do: bump, wind up, drift, or go on with a dead sensor.

use pcl2_tests::compilers::check;
use pcl2_tests::table::Table;
use pcl2_tests::{pcl2, run};
use std::fmt::Write;
use std::fs;
use std::path::PathBuf;

/// A program in a folder of its own.
struct Loop {
    folder: tempfile::TempDir,
}

impl Loop {
    fn new(program: &str) -> Loop {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("main.cfg"), program).unwrap();
        Loop { folder }
    }

    fn source(&self) -> PathBuf {
        self.folder.path().join("main.cfg")
    }

    /// Runs the embedded engine; stimulus is CSV text.
    fn run(&self, args: &str, stimulus: Option<&str>) -> (Table, String) {
        let mut command = pcl2();
        command.arg("run").arg(self.source()).args(args.split_whitespace()).args(["--trace", "-"]);
        if let Some(text) = stimulus {
            let path = self.folder.path().join("stimulus.csv");
            fs::write(&path, text).unwrap();
            command.arg("--stimulus").arg(path);
        }
        let output = run(&mut command);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{said}");
        (Table::read(&String::from_utf8_lossy(&output.stdout)), said)
    }
}

/// The distance of two doubles in units in the last place.
fn ulps(a: f64, b: f64) -> u64 {
    let key = |x: f64| if x < 0.0 { -((x.to_bits() & !(1 << 63)) as i64) } else { x.to_bits() as i64 };
    key(a).abs_diff(key(b))
}

const WHOLE_LOOP: &str =
    "PLANT\n1 T1 = first ( TIC : 0.1, 0.08, 20. )\nCONTROL\n2 TIC = pid ( y = T1 : K = 2., Ti = 10. )\nEND\n";

#[test]
fn a_settled_loop_goes_to_manual_and_back_without_a_bump() {
    let sets = "--period 0.1 --until 600 --set TIC.w=50 --set TIC.mode=man@500 --set TIC.mode=auto@520";
    let (trace, _) = Loop::new(WHOLE_LOOP).run(sets, None);
    let (u, mode) = (trace.values("TIC"), trace.values("TIC.actual"));
    assert_eq!((mode[4999], mode[5000], mode[5199], mode[5200]), (1.0, 0.0, 0.0, 1.0));
    assert!(u[4990..].iter().all(|now| ulps(*now, u[4989]) <= 1), "{:?}", &u[4989..]);
}

#[test]
fn a_moving_loop_goes_to_manual_and_back_without_a_bump() {
    let sets = "--period 0.1 --until 40 --set TIC.w=50@10 --set TIC.mode=man@12 --set TIC.mode=auto@15";
    let (trace, _) = Loop::new(WHOLE_LOOP).run(sets, None);
    let (u, y) = (trace.values("TIC"), trace.values("T1"));
    assert_eq!(ulps(u[120], u[119]), 0, "to manual");
    assert!(u[121..150].iter().all(|held| *held == u[120]));
    // Back in automatic, u moves by what y did in that scan, times K, and by that scan's integration.
    let own = 2.0 * (y[150] - y[149]).abs() + 2.0 * 0.1 / 10.0 * (50.0 - y[150]).abs();
    assert!((u[150] - u[149]).abs() <= own, "{} after {}, its own change is {own}", u[150], u[149]);
}

#[test]
fn an_operator_writes_the_manual_output() {
    let sets =
        "--period 0.1 --until 20 --set TIC.mode=man@2 --set TIC.um=31@4 --set TIC.um=250@6 --set TIC.mode=auto@8";
    let (trace, _) = Loop::new(WHOLE_LOOP).run(sets, None);
    let u = trace.values("TIC");
    assert_eq!((u[40], u[59], u[60], u[79]), (31.0, 31.0, 100.0, 100.0));
    assert!((u[80] - 100.0).abs() < 2.0, "{}", u[80]);
}

#[test]
fn a_broken_sensor_sheds_and_control_returns() {
    let program = "CONTROL\n1 T1 = ain ( : 0, 1, 1 )\n2 TIC = pid ( y = T1 : K = 2., Ti = 10., tbad = 1. )\n3 FV = aout ( TIC : 0, 2, 1 )\nEND\n";
    let mut stimulus = "t,\"ain(0,1,1)\"\n0,30\n".to_owned();
    let _ = write!(stimulus, "50,nan\n60,31\n");
    let (trace, said) = Loop::new(program).run("--period 0.1 --until 80 --set TIC.w=30.5@1", Some(&stimulus));
    let (u, valve, mode) = (trace.values("TIC"), trace.values("FV"), trace.values("TIC.actual"));
    assert!(valve.iter().all(|u| u.is_finite() && (0.0..=100.0).contains(u)));
    assert!(u[500..600].iter().all(|held| *held == u[499]), "the valve holds");
    assert_eq!((mode[499], mode[509], mode[510], mode[599], mode[600]), (1.0, 1.0, 0.0, 0.0, 1.0));
    assert_eq!(u[600], u[599], "the return has no bump");
    assert_ne!(u[610], u[600], "it controls again");
    assert!(said.contains("y is not finite"), "{said}");
}

#[test]
fn no_kick_of_the_derivative_when_the_set_point_steps() {
    let program = "PLANT\n1 y = first ( u : 0.1, 0.1, 0. )\nCONTROL\n2 u = pid ( y = y : K = 2., Ti = 10., Td = 3., b = 0. )\nEND\n";
    let (trace, _) = Loop::new(program).run("--period 0.1 --until 60 --set u.w=20 --set u.w=40@50", None);
    let u = trace.values("u");
    let integration = 2.0 * 0.1 / 10.0 * 20.0;
    assert!((u[500] - u[499]).abs() <= integration + 1e-3, "{} after {}", u[500], u[499]);
}

#[test]
fn retuning_a_settled_loop_does_not_move_the_output() {
    let sets = "--period 0.1 --until 520 --set TIC.w=50 --set TIC.K=7@500 --set TIC.b=0.3@502 --set TIC.Ti=3@504 \
                --set TIC.umax=90@506 --set TIC.Td=2@508";
    let (trace, said) = Loop::new(WHOLE_LOOP).run(sets, None);
    let u = trace.values("TIC");
    assert!(!said.contains("refused"), "{said}");
    // K and b move two parts of some hundreds each in opposite directions: a few last digits of them are left.
    assert!(u[4990..].iter().all(|now| (now - u[4989]).abs() < 1e-12 * 700.0), "{:?}", &u[4989..]);
}

#[test]
fn a_gain_of_zero_is_left_without_a_bump() {
    for code in ["pid", "apid"] {
        let program = format!("CONTROL\n1 y = msc ( : 50. )\n2 u = {code} ( y : K = 0., Ti = 10. )\nEND\n");
        let test = Loop::new(&program);
        let (table, _) = test.run("--period 1 --steps 8 --set u.um=20 --set u.w=52 --set u.K=2@3 --set u.K=0@6", None);
        let u = table.values("u");
        let expected = [20.0, 20.0, 20.0, 20.0, 20.4, 20.8, 21.2, 21.2];
        assert!(u.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9), "{code}: {u:?}");
    }
}

#[test]
fn direct_action_is_the_mirror_of_reverse_action() {
    let program = "CONTROL\n1 y = ain ( : 0, 1, 1 )\n2 minus = msc ( : -1. )\n3 zero = msc ( : 0. )\n\
                   4 m = sumII ( 1, y, zero, 2 : -1., 0. )\n\
                   5 a = pid ( y = y, w = zero : K = 2., Ti = 3., Td = 0.5, umin = -10., umax = 10., act = direct )\n\
                   6 b = pid ( y = m, w = zero : K = 2., Ti = 3., Td = 0.5, umin = -10., umax = 10. )\nEND\n";
    let mut stimulus = "k,\"ain(0,1,1)\"\n".to_owned();
    for k in 0..300 {
        let _ = writeln!(stimulus, "{k},{}", 8.0 * (f64::from(k) * 0.1).sin());
    }
    let (trace, _) = Loop::new(program).run("--period 0.1 --steps 300", Some(&stimulus));
    assert_eq!(trace.values("a"), trace.values("b"));
    assert!(trace.values("a").iter().all(|u| (-10.0..=10.0).contains(u)));
    assert!(trace.values("a").contains(&10.0), "the limit is reached");
}

#[test]
fn saturation_is_left_within_the_tracking_time() {
    let sets = "--period 0.1 --until 400 --set TIC.w=500 --set TIC.w=50@300";
    let (trace, _) = Loop::new(WHOLE_LOOP).run(sets, None);
    let u = trace.values("TIC");
    assert_eq!(u[2999], 100.0, "saturated for 300 s");
    let left = u[3000..].iter().position(|u| *u < 100.0).unwrap();
    assert!(left <= 100, "left after {left} scans: Tt is 100");
}

#[test]
fn halving_the_period_halves_the_error() {
    // The loop of a lag 1/(10 s + 1) and PI with Ti = 10: open loop K/(10 s), so y = w (1 - e^(-K t/10)).
    let error = |period: f64| {
        let program = "PLANT\n1 y = first ( u : 0.1, 0.1, 0. )\nCONTROL\n2 w = msc ( : 10. )\n\
                       3 u = pid ( y, w, um = w : K = 2., Ti = 10., umin = -1000., umax = 1000. )\nEND\n";
        let program = program.replace("um = w", "um = twenty").replace("3 u", "3 twenty = msc ( : 20. )\n4 u");
        let (trace, _) = Loop::new(&program).run(&format!("--period {period} --until 20"), None);
        let y = trace.values("y");
        let at = (10.0 / period).round() as usize;
        (y[at] - 10.0 * (1.0 - (-2.0_f64).exp())).abs()
    };
    let (coarse, fine) = (error(0.1), error(0.05));
    assert!(coarse < 0.5 && (0.4..0.6).contains(&(fine / coarse)), "{coarse}, {fine}");
}

#[test]
fn ten_million_scans_do_not_drift() {
    let program = "CONTROL\n1 y = ain ( : 0, 1, 1 )\n2 u = pid ( y : K = 2., Ti = 10. )\nEND\n";
    let folder = Loop::new(program);
    fs::write(folder.folder.path().join("s.csv"), "k,\"ain(0,1,1)\",u.w,u.um\n0,40,40,37.3\n").unwrap();
    let mut command = pcl2();
    command.arg("run").arg(folder.source()).args(["--period", "0.01", "--steps", "10000000", "--stimulus"]);
    let said = check(command.arg(folder.folder.path().join("s.csv")));
    assert!(said.lines().any(|line| line.split_whitespace().take(2).eq(["u", "37.3"])), "{said}");
}

#[test]
fn a_float_integral_moves_where_a_plain_sum_stands_still() {
    let program = "CONTROL\n1 y = ain ( : 0, 1, 1 )\n2 u = pid ( y : K = 1., Ti = 3600. )\nEND\n";
    let stimulus = "k,\"ain(0,1,1)\",u.w,u.um\n0,40,40,50\n1,39.9,,\n";
    let (trace, _) = Loop::new(program).run("--real f32 --period 0.01 --steps 360001", Some(stimulus));
    let u = trace.values("u");
    // e = 0.1 for one hour: P and I are 0.1 each.
    assert!((u[360_000] - 50.2).abs() < 1e-3, "{}", u[360_000]);
}

/// INITIALIZE says where the valve stands: the plant reads it before the controller writes it.
const CASCADE: &str = "INITIALIZE\n0 FIC = msc ( : 30. )\nPLANT\n1 F = first ( FIC : 0.5, 0.5, 30. )\n2 L = first ( F : 0.02, 0.02, 30. )\nCONTROL\n\
                       3 LIC = pid ( y = L, back = FIC.bk : K = 3., Ti = 60. )\n\
                       4 FIC = pid ( y = F, cas = LIC : K = 0.8, Ti = 3., umax = 60. )\nEND\n";

#[test]
fn a_cascade_starts_from_the_bottom_without_moving_the_valve() {
    let sets = "--period 0.5 --until 60 --set FIC.um=30@0 --set FIC.mode=cas@0";
    let (trace, _) = Loop::new(CASCADE).run(sets, None);
    let (valve, mode) = (trace.values("FIC"), trace.values("FIC.actual"));
    assert_eq!(mode[20], 2.0, "the cascade is closed");
    assert!(valve.iter().all(|u| (u - 30.0).abs() < 0.1), "{valve:?}");
}

#[test]
fn a_saturated_slave_holds_its_master() {
    let sets = "--period 0.5 --until 1200 --set FIC.um=30@0 --set FIC.mode=cas@0 --set LIC.w=90@50 --set LIC.w=40@600";
    let (trace, _) = Loop::new(CASCADE).run(sets, None);
    let (master, valve) = (trace.values("LIC"), trace.values("FIC"));
    assert_eq!(valve[1190], 60.0);
    let (before, after) = (master[1000], master[1199]);
    assert!(after <= before + 1e-9, "the master does not integrate outward: {before}, {after}");
    let freed = valve[1200..].iter().position(|u| *u < 60.0).unwrap();
    assert!(freed < 20, "the valve leaves its limit after {freed} scans");
}

#[test]
fn a_slave_in_automatic_makes_its_master_wait_at_its_set_point() {
    let sets = "--period 0.5 --until 200 --set FIC.um=30@0 --set FIC.mode=cas@0 --set FIC.mode=auto@100 --set FIC.w=35@100 \
                --set FIC.mode=cas@150";
    let (trace, _) = Loop::new(CASCADE).run(sets, None);
    let (master, waits, valve) = (trace.values("LIC"), trace.values("LIC.actual"), trace.values("FIC"));
    assert!(master[205..300].iter().all(|w| *w == 35.0), "the master is where the slave is");
    assert!(waits[205..300].iter().all(|mode| *mode == 4.0), "and says that it waits");
    assert!((valve[300] - valve[299]).abs() < 0.05, "{} after {}", valve[300], valve[299]);
}

#[test]
fn tracking_is_left_without_a_bump_in_every_form() {
    for form in ["isa", "parallel", "series", "erf"] {
        let program = format!(
            "CONTROL\n1 y = ain ( : 0, 1, 1 )\n2 trk = msi ( : 0 )\n3 utr = msc ( : 42.5 )\n4 ff = msc ( : 3. )\n\
             5 u = apid ( y, trk = trk, utr = utr, ff = ff : K = 2., Ti = 10., Td = 1., Tf = 0.4, form = {form} )\nEND\n"
        );
        let stimulus = "k,\"ain(0,1,1)\",u.w,trk.value\n0,40,40,0\n50,,,1\n80,,,0\n";
        let (trace, _) = Loop::new(&program).run("--period 0.1 --steps 120", Some(stimulus));
        let (u, mode) = (trace.values("u"), trace.values("u.actual"));
        assert_eq!((mode[49], mode[50], mode[79], mode[80]), (1.0, 3.0, 3.0, 1.0));
        assert!(u[50..].iter().all(|u| ulps(*u, 42.5) <= 1), "{form}: {:?}", &u[50..]);
    }
}

#[test]
fn a_feed_forward_that_fails_stays_where_it_was() {
    let program = "CONTROL\n1 y = ain ( : 0, 1, 1 )\n2 f = ain ( : 0, 1, 2 )\n\
                   3 u = apid ( y, ff = f : K = 2., Ti = 10. )\nEND\n";
    let stimulus = "k,\"ain(0,1,1)\",\"ain(0,1,2)\",u.w,u.um\n0,40,5,40,30\n10,,nan,,\n20,,5,,\n";
    let (trace, said) = Loop::new(program).run("--period 0.1 --steps 30", Some(stimulus));
    assert!(trace.values("u").iter().all(|u| ulps(*u, 30.0) <= 1));
    assert!(said.contains("ff is not finite") || said.contains("the sample is bad"), "{said}");
}

#[test]
fn a_master_in_a_slow_section_closes_the_cascade_without_a_bump() {
    let program = "PLANT\n1 F = first ( FC : 0.5, 0.5, )\n2 T1 = first ( F : 0.02, 0.02, )\nCONTROL 50\n\
                   3 TC = pid ( y = T1, back = FC.bk : K = 2., Ti = 60. )\nCONTROL\n\
                   4 FC = pid ( y = F, cas = TC : K = 0.8, Ti = 3. )\nEND\n";
    let sets = "--period 0.5 --until 200 --set FC.w=20 --set TC.w=20@1 --set FC.w=30@110 --set FC.mode=cas@112";
    let (trace, _) = Loop::new(program).run(sets, None);
    let (u, mode) = (trace.values("FC"), trace.values("FC.actual"));
    assert_eq!((mode[225], mode[399]), (1.0, 2.0), "the slave waits for the master's next scan, then follows");
    let moved = (226..300).map(|scan| (u[scan] - u[scan - 1]).abs()).fold(0.0, f64::max);
    assert!(moved < 0.2, "{moved}");
}

/// Flow under an override by pressure; the pressure is far from its limit, or not.
const OVERRIDE: &str = "PLANT\n1 F = first ( S : 0.2, 0.2, )\n2 P = first ( S : 0.05, 0.05, )\nCONTROL\n\
                        3 FIC = pid ( y = F, back = S.bk1 : K = 2., Ti = 5. )\n\
                        4 limit = msc ( : 70. )\n5 PIC = pid ( y = P, w = limit, back = S.bk2 : K = 2., Ti = 20. )\n\
                        6 S = ovr ( FIC, PIC, 2 : low )\nEND\n";

#[test]
fn the_loser_of_an_override_rests_beside_the_winner_and_neither_throttles_it_nor_takes_turns() {
    let sets = "--period 0.5 --steps 900 --set FIC.w=30 --set FIC.w=60@150 --set FIC.w=90@300";
    let (trace, _) = Loop::new(OVERRIDE).run(sets, None);
    let (flow, loser, idx) = (trace.values("F"), trace.values("PIC"), trace.values("S.idx"));
    // u + K e = 30 + 2 (70 - 30) is above the limit of 100.
    assert!(loser[299] > 95.0, "{}", loser[299]);
    assert!(flow[300..320].iter().any(|y| *y > 57.0), "the step is not throttled: {:?}", &flow[300..320]);
    let turns = idx.windows(2).filter(|pair| pair[0] != pair[1]).count();
    assert!(turns <= 3, "{turns} changes of the controller that acts");
    assert!((trace.values("P")[899] - 70.0).abs() < 1.0, "the pressure's controller holds its limit");
}

#[test]
fn a_limiter_holds_its_limit_and_the_master_does_not_go_on() {
    let program = "PLANT\n1 F = first ( V : 0.5, 0.5, )\n2 L = first ( F : 0.02, 0.02, )\nCONTROL\n\
                   3 LIC = pid ( y = L, back = FIC.bk : K = 3., Ti = 60. )\n\
                   4 FIC = pid ( y = F, cas = LIC, back = V.bk : K = 0.8, Ti = 3. )\n\
                   5 V = hilim ( FIC : 0., 60. )\nEND\n";
    let sets = "--period 0.5 --steps 1200 --set FIC.mode=cas --set LIC.w=90@50";
    let (trace, _) = Loop::new(program).run(sets, None);
    let (master, valve) = (trace.values("LIC"), trace.values("V"));
    assert!(valve[400..].iter().all(|v| (v - 60.0).abs() < 0.5), "the valve stays at its limit");
    assert!((master[1199] - master[800]).abs() < 3.0, "{} after {}", master[1199], master[800]);
}

#[test]
fn a_set_point_that_nobody_writes_is_no_fault() {
    let folder = Loop::new("CONTROL\n1 y = ain ( : 0, 1, 1 )\n2 u = lone ( y : )\nEND\n");
    let composite = "! A controller that nobody asked for a set-point.\nreal v = lone ( real y : )\nBODY\n\
                     1 v = pid ( y : K = 2. )\nEND\n";
    fs::write(folder.folder.path().join("lone.fc"), composite).unwrap();
    let blocks = format!("--period 0.1 --steps 20 --blocks {}", folder.folder.path().display());
    let (_, said) = folder.run(&blocks, Some("k,\"ain(0,1,1)\"\n0,40\n5,41\n"));
    assert!(!said.contains("fault"), "{said}");
}
