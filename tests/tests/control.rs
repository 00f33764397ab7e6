//! What the blocks between controller and valve must never do: bump, wind up, or move a valve that they only take over.

use pcl2_tests::table::Table;
use pcl2_tests::{pcl2, run};
use std::fs;

fn trace(program: &str, args: &str, stimulus: Option<&str>) -> Table {
    let folder = tempfile::tempdir().unwrap();
    let source = folder.path().join("main.cfg");
    fs::write(&source, program).unwrap();
    let mut command = pcl2();
    command.arg("run").arg(source).args(args.split_whitespace()).args(["--trace", "-"]);
    if let Some(text) = stimulus {
        let path = folder.path().join("stimulus.csv");
        fs::write(&path, text).unwrap();
        command.arg("--stimulus").arg(path);
    }
    let output = run(&mut command);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Table::read(&String::from_utf8_lossy(&output.stdout))
}

/// The distance of two doubles of one sign in units in the last place.
fn ulps(a: f64, b: f64) -> u64 {
    a.to_bits().abs_diff(b.to_bits())
}

const STATION: &str = "PLANT\n1 T1 = first ( HIC : 0.1, 0.08, 20. )\nCONTROL\n\
                       2 TIC = pid ( y = T1, back = HIC.bk : K = 2., Ti = 10. )\n3 HIC = ma ( TIC : )\nEND\n";

#[test]
fn a_station_goes_to_manual_and_back_without_a_bump_in_a_settled_loop() {
    let sets = "--period 0.1 --until 600 --set TIC.w=50 --set HIC.mode=man@500 --set HIC.mode=auto@520";
    let trace = trace(STATION, sets, None);
    let (u, mode, driver) = (trace.values("HIC"), trace.values("HIC.actual"), trace.values("TIC.actual"));
    assert_eq!((mode[4999], mode[5000], mode[5199], mode[5200]), (1.0, 0.0, 0.0, 1.0));
    assert_eq!((driver[5100], driver[5300]), (4.0, 1.0), "the controller waits meanwhile");
    for scan in 4990..u.len() {
        assert!(ulps(u[scan], u[4989]) <= 1, "scan {scan}: {} after {}", u[scan], u[4989]);
    }
}

#[test]
fn a_station_goes_to_manual_and_back_without_a_bump_in_a_moving_loop() {
    let sets =
        "--period 0.1 --until 40 --set TIC.w=50@10 --set HIC.mode=man@12 --set HIC.um=70@13 --set HIC.mode=auto@15";
    let trace = trace(STATION, sets, None);
    let (u, y) = (trace.values("HIC"), trace.values("T1"));
    assert_eq!(ulps(u[120], u[119]), 0, "to manual");
    assert!(u[120..130].iter().all(|held| *held == u[119]));
    assert!(u[130..=150].iter().all(|held| *held == 70.0), "what the operator wrote, and the first scan after it");
    // From then on the controller's own moves: P of what y does, and its integration.
    let own = 2.0 * (y[151] - y[150]).abs() + 2.0 * 0.1 / 10.0 * (50.0 - y[151]).abs();
    assert!((u[151] - u[150]).abs() <= own + 1e-12, "{} after {}, its own change is {own}", u[151], u[150]);
}

/// A temperature controller, and one that keeps a pressure below 80, on one valve.
const OVERRIDE: &str = "CONTROL\n1 T1 = ain ( : 0, 1, 1 )\n2 P1 = ain ( : 0, 1, 2 )\n\
                        3 TIC = pid ( T1, back = LOW.bk1 : K = 1., Ti = 5. )\n\
                        4 PIC = pid ( P1, back = LOW.bk2 : K = 1., Ti = 5. )\n\
                        5 LOW = ovr ( TIC, PIC, 2 : )\nEND\n";

#[test]
fn the_loser_of_an_override_does_not_wind_up() {
    let stimulus = "t,\"ain(0,1,1)\",\"ain(0,1,2)\",TIC.w,PIC.w,TIC.um,PIC.um\n0,40,60,40,80,30,30\n500,,85,,,,\n";
    let trace = trace(OVERRIDE, "--period 0.5 --until 600", Some(stimulus));
    let (t, p, u, idx) = (trace.values("TIC"), trace.values("PIC"), trace.values("LOW"), trace.values("LOW.idx"));
    assert_eq!((u[990], idx[990]), (t[990], 1.0));
    // 500 s at an error of 20 would have taken a deaf integral to the limit of 100; P is 20.
    assert!(p[100..1000].iter().all(|p| *p - 30.0 <= 20.0 + 2.0 + 1e-9), "{}", p[999]);
    let taken = (1000..1200).find(|scan| idx[*scan] == 2.0).unwrap();
    assert!(taken <= 1002, "the pressure takes over in scan {taken}");
    assert!(u[1199] < 20.0 && u[1000..].windows(2).all(|pair| pair[1] <= pair[0] + 1e-9), "and closes the valve");
    assert!(t[1199] <= u[1199] + 1.0, "now the temperature waits beside it");
}

#[test]
fn a_feed_forward_goes_on_and_off_without_a_bump() {
    let program = "CONTROL\n1 u = msc ( : 40. )\n2 ff = msc ( : 12.3 )\n3 on = msi ( : 0 )\n\
                   4 y = ffsum ( u, ff, on : k = 0.7, bias = 1., tb = 5. )\nEND\n";
    let trace =
        trace(program, "--period 0.1 --until 40 --set on.value=1@10 --set on.value=0@20 --set y.k=0.9@30", None);
    let y = trace.values("y");
    for scan in [100, 200, 300] {
        assert!((y[scan] - y[scan - 1]).abs() < 1e-12, "scan {scan}: {} after {}", y[scan], y[scan - 1]);
    }
    let step = (0.7 * 12.3 + 1.0) / 50.0;
    assert!(y.windows(2).all(|pair| (pair[1] - pair[0]).abs() < step + 1e-12), "and then evenly");
    assert!((y[150] - (40.0 + 0.7 * 12.3 + 1.0)).abs() < 1e-12, "{}: on after tb", y[150]);
    assert!((y[250] - 40.0).abs() < 1e-12, "{}: off after tb", y[250]);
}

#[test]
fn a_ratio_begins_with_the_one_that_there_is() {
    let program = "CONTROL\n1 wild = msc ( : 23.7 )\n2 FY = rat ( wild : )\nEND\n";
    let sets =
        "--period 0.1 --until 10 --set FY.mode=man@0 --set FY.wm=61.3@2 --set FY.mode=auto@5 --set wild.value=20@7";
    let trace = trace(program, sets, None);
    let (w, k) = (trace.values("FY"), trace.values("FY.k"));
    assert!(w[20..70].iter().all(|w| ulps(*w, 61.3) <= 1), "{w:?}");
    assert!((k[50] - 61.3 / 23.7).abs() < 1e-15 && (w[70] - 20.0 * k[50]).abs() < 1e-12);
}

/// Level over flow over a station over a valve that stands at 37; the measured values stand still.
const CASCADE: &str = "CONTROL\n1 L = ain ( : 0, 1, 1 )\n2 F = ain ( : 0, 1, 2 )\n3 pos = ain ( : 0, 1, 3 )\n\
                       4 local = msi ( : 0 )\n5 seat = rback ( pos, local : )\n\
                       6 LIC = pid ( L, back = SP.bk : K = 3., Ti = 60. )\n\
                       7 SP = casc ( LIC, back = FIC.bk : )\n\
                       8 FIC = pid ( F, cas = SP, back = HIC.bk : K = 0.8, Ti = 3. )\n\
                       9 HIC = ma ( FIC, back = FV.bk : )\n10 FV = aout ( HIC, seat : 0, 2, 1 )\nEND\n";

#[test]
fn a_cascade_starts_from_the_bottom_and_leaves_the_valve_where_it_stands() {
    let stimulus = "t,\"ain(0,1,1)\",\"ain(0,1,2)\",\"ain(0,1,3)\",FIC.mode,local.value\n0,55,42,37,cas,0\n\
                    50,,,60,,1\n80,,,,,0\n";
    let trace = trace(CASCADE, "--period 0.5 --until 120", Some(stimulus));
    let valve = trace.values("FV");
    assert!(valve[..100].iter().all(|u| *u == 37.0), "{:?}", &valve[..100]);
    assert!(valve[100..].iter().all(|u| *u == 60.0), "after local operation: {:?}", &valve[100..]);
    for scan in [12, 99, 172, 239] {
        let modes = ["LIC", "SP", "FIC", "HIC"].map(|tag| trace.values(&format!("{tag}.actual"))[scan]);
        assert_eq!(modes, [1.0, 2.0, 2.0, 1.0], "scan {scan}: everybody follows");
    }
    let (master, flow) = (trace.values("LIC"), trace.values("SP"));
    assert_eq!((master[20], flow[20]), (42.0, 42.0), "the set-points began at the measured flow");
}

#[test]
fn a_cascade_of_predictive_controllers_starts_from_the_bottom() {
    let program = "CONTROL\n1 L = ain ( : 0, 1, 1 )\n2 F = ain ( : 0, 1, 2 )\n3 pos = ain ( : 0, 1, 3 )\n4 w = msc ( : 55. )\n\
                   5 sw = msc ( : 0. )\n6 p = setvec ( 2 : 0.8, 0.4 )\n7 seat = rback ( pos : )\n\
                   8 LIC = gpc1 ( w, L, p, sw, 0, 8, 1, FIC.bk : 0., 0., 100., 0.1 )\n\
                   9 FIC = gpc1 ( LIC, F, p, sw, 0, 8, 1, FV.bk : 0., 0., 100., 0.1 )\n\
                   10 FV = aout ( FIC, seat : 0, 2, 1 )\nEND\n";
    let stimulus = "k,\"ain(0,1,1)\",\"ain(0,1,2)\",\"ain(0,1,3)\"\n0,55,42,37\n";
    let trace = trace(program, "--period 0.5 --until 60", Some(stimulus));
    assert!(trace.values("FV").iter().all(|u| *u == 37.0), "{:?}", trace.values("FV"));
    assert_eq!(trace.values("LIC")[40], 42.0);
}

#[test]
fn a_return_wire_that_nobody_reads_is_not_there() {
    let program = "CONTROL\n1 x = msc ( : 1. )\n2 u = ma ( x : )\n3 y = aout ( u : 0, 2, 1 )\nEND\n";
    let heard = program.replace("ma ( x : )", "ma ( x, back = y.bk : )");
    let columns = |program: &str| trace(program, "--period 1 --steps 1", None).header.join(" ");
    assert_eq!(columns(program), "@k @t x u u.actual y");
    assert_eq!(columns(&heard), "@k @t x u u.actual y y.bk[1] y.bk[2]");
}
