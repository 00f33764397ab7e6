//! Nets as the player runs them: the papers' examples, and what a scan promises.

use pcl2_tests::compilers::{CORTEX_M, STRICT, check, folder};
use pcl2_tests::nets::{FORMS, Trace, column, read, trace, traced};
use pcl2_tests::{pcl2, root, run};
use std::fs;
use std::process::Command;

/// The marked boxes of a net after a scan, in order of name.
fn marked(trace: &Trace, scan: usize) -> Vec<&str> {
    let boxes = trace.iter().filter_map(|(name, values)| Some((name.split_once('.')?.1, values)));
    boxes.filter(|(_, values)| values[scan] > 0.).map(|(name, _)| name).collect()
}

fn tank() -> Trace {
    tank_in("tank.net", "18")
}

fn tank_in(file: &str, steps: &str) -> Trace {
    let folder = tempfile::tempdir().unwrap();
    let stimulus = folder.path().join("button.csv");
    fs::write(&stimulus, "k,press,release\n0,1,0\n2,0,1\n").unwrap();
    trace(&root().join("tests/nets").join(file), &["--steps", steps, "--stimulus", stimulus.to_str().unwrap()])
}

/// How often each of some places is entered, and whether it is marked at the end.
fn entered(trace: &Trace, start: &[&str], column: impl Fn(&str) -> String, places: &[&str]) -> Vec<(usize, bool)> {
    let one = |place: &&str| {
        let values = self::column(trace, &column(place));
        let before = std::iter::once(f64::from(u8::from(start.contains(place)))).chain(values.iter().copied());
        let times = before.zip(values).filter(|(before, now)| **now > *before).count();
        (times, values.last().is_some_and(|last| *last > 0.))
    };
    places.iter().map(one).collect()
}

/// The tank in a hierarchy, steps as macros and devices as modules, enters each place as often as the flat net does,
/// from the start back to the start. A macro takes one scan more, from its entry to its exit: four of them do.
#[test]
fn the_hierarchical_tank_does_what_the_flat_one_does() {
    let start = ["D10", "D21", "L1", "P0", "S0", "V10", "V20", "Z10"];
    let steps = ["S0", "S1", "S2", "S3", "S4", "S5", "S6"];
    let devices = ["P0", "P1", "L1", "L0", "V10", "V11", "V20", "V21", "Z10", "Z11", "Z12", "D10", "D11", "D20", "D21"];
    let (flat, hierarchical) = (tank_in("tank.net", "16"), tank_in("tank_hierarchical.net", "20"));
    for (places, is_step) in [(steps.as_slice(), true), (devices.as_slice(), false)] {
        let expected = entered(&flat, &start, |place| format!("tank.{place}"), places);
        let name = |place: &str| if is_step { format!("tank_hierarchical.{place}") } else { place.to_owned() };
        assert_eq!(entered(&hierarchical, &start, name, places), expected);
        let firings: usize = expected.iter().map(|(times, _)| times).sum();
        assert_eq!(firings, if is_step { 7 } else { 16 });
        let marked: Vec<bool> = places.iter().map(|place| start.contains(place)).collect();
        assert_eq!(expected.iter().map(|(_, marked)| *marked).collect::<Vec<_>>(), marked);
    }
}

/// Jeong and Yang, equations (9), (15), (16), (17): the marked places after the scans.
#[test]
fn the_measuring_tank_gives_the_papers_vectors() {
    let trace = tank();
    let own = |scan: usize, names: &[&str]| -> Vec<&str> {
        marked(&trace, scan).into_iter().filter(|name| names.contains(name)).collect()
    };
    let controller = ["S0", "S1", "S2", "S3", "S4", "S5", "S6", "P0", "P1"];
    assert_eq!(own(1, &controller), ["P1", "S1"]);
    let devices = ["L1", "L0", "V11", "V10", "Z12", "Z11", "Z10", "D21", "D20"];
    assert_eq!(own(2, &devices), ["D21", "L0", "V11", "Z10"]);
    assert_eq!(own(3, &devices), ["D21", "L0", "V11", "Z11"]);
    assert_eq!(own(4, &devices), ["D20", "L0", "V11", "Z12"]);
}

/// From the button press back to the start are 16 maximal steps, and each transition fires once: each place but the
/// level's middle one is entered once.
#[test]
fn the_measuring_tank_comes_back_in_sixteen_scans() {
    let trace = tank();
    let start = ["D10", "D21", "L1", "P0", "S0", "V10", "V20", "Z10"];
    assert_eq!(marked(&trace, 15), start);
    assert!((0..15).all(|scan| marked(&trace, scan) != start));
    let initially = |name: &str| f64::from(u8::from(start.contains(&name)));
    let mut entered = 0;
    for (name, values) in trace.iter().filter_map(|(name, values)| Some((name.split_once('.')?.1, values))) {
        let before = std::iter::once(initially(name)).chain(values.iter().copied());
        let times = before.zip(values).filter(|(before, now)| **now > *before).count();
        assert_eq!(times, if name == "Z11" { 2 } else { 1 }, "{name}");
        entered += times;
    }
    assert_eq!(entered, 23);
}

/// Nagao and Kumagai, Fig. 9: one request, and the marked boxes after the scans.
#[test]
fn the_guided_vehicle_gives_the_figures_markings() {
    let folder = root().join("tests/nets");
    let stimulus = folder.join("agv.stimulus.csv");
    let trace = trace(&folder.join("agv.net"), &["--steps", "33", "--stimulus", stimulus.to_str().unwrap()]);
    let expected: [(usize, &[&str]); 11] = [
        (0, &["b5"]),
        (2, &["b11", "b13", "b5"]),
        (3, &["b1", "b13"]),
        (4, &["b1"]),
        (10, &["b2"]),
        (14, &["b3"]),
        (15, &["b6"]),
        (19, &["b7"]),
        (24, &["b4"]),
        (29, &["b14", "b5"]),
        (31, &["b5"]),
    ];
    for (scan, boxes) in expected {
        assert_eq!(marked(&trace, scan), boxes, "after scan {scan}");
    }
    let way = ["agv.b1", "agv.b2", "agv.b3", "agv.b4", "agv.b5", "agv.b6", "agv.b7"];
    for scan in 0..33 {
        let vehicles: f64 = way.iter().map(|name| column(&trace, name)[scan]).sum();
        assert!((vehicles - 1.).abs() < 1e-9, "scan {scan}: {vehicles} vehicles");
    }
}

/// A time box is excited when the time has passed, whatever it is made of.
#[test]
fn times_are_constants_parameters_and_inputs() {
    let net = "int q1, int q2, int q3 = times ( real t : real limit = 0.3 )
STATE go1 MARKED
TIME a 0.3
STATE end1 DRIVES q1
GATE g1 : go1 -> a
GATE g2 : a -> end1
STATE go2 MARKED
TIME b limit
STATE end2 DRIVES q2
GATE g3 : go2 -> b
GATE g4 : b -> end2
STATE go3 MARKED
TIME c t
STATE end3 DRIVES q3
GATE g5 : go3 -> c
GATE g6 : c -> end3
END
";
    let trace = traced(&[("times.net", net)], "k,t\n0,0.3\n", &["--steps", "8", "--period", "0.1"]);
    for output in ["q1", "q2", "q3"] {
        let first = column(&trace, output).iter().position(|value| *value > 0.);
        assert_eq!(first, Some(3), "{output}: the token came in scan 0");
    }
}

/// 15 s are no number of whole nanoseconds in float, and still over after 15 s.
#[test]
fn a_time_ends_in_the_same_scan_in_float() {
    let net = "int q = waits ( real t : )
STATE go MARKED
TIME a t
STATE end DRIVES q
GATE g1 : go -> a
GATE g2 : a -> end
END
";
    for real in ["f64", "f32"] {
        let args = ["--steps", "34", "--period", "0.5", "--real", real];
        let trace = traced(&[("waits.net", net)], "k,t\n0,15.\n", &args);
        assert_eq!(column(&trace, "q").iter().position(|q| *q > 0.), Some(30), "{real}");
    }
}

/// A counting box is full after its number of tokens, and a token that it gives empties it.
#[test]
fn a_counting_box_counts() {
    let net = "int q = counts ( int pulse : )
GENERATE make SIZE 1 WHEN pulse
COUNT three 3
STATE full DRIVES q
GATE g1 : make -> three
GATE g2 : three -> full
END
";
    let stimulus = "k,pulse\n0,1\n1,0\n2,1\n3,0\n4,1\n5,0\n6,1\n";
    let trace = traced(&[("counts.net", net)], stimulus, &["--steps", "8"]);
    assert_eq!(column(&trace, "counts.three"), [1., 1., 2., 2., 3., 0., 1., 1.]);
    assert_eq!(column(&trace, "q"), [0., 0., 0., 0., 0., 1., 1., 1.]);
}

/// Without room one edge waits; a further one is lost, and the health record says so.
#[test]
fn a_token_that_nobody_takes_is_lost_and_told() {
    let net =
        "= full ( int pulse : )\nGENERATE make SIZE 1 WHEN pulse\nSTATE other\nGATE g : make -> other IF 0\nEND\n";
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("full.net"), net).unwrap();
    fs::write(folder.path().join("s.csv"), "k,pulse\n0,1\n1,0\n2,1\n3,0\n4,1\n").unwrap();
    let (net, stimulus) = (folder.path().join("full.net"), folder.path().join("s.csv"));
    let faults = |steps: &str| {
        let output = run(pcl2().arg("run").arg(&net).arg("--stimulus").arg(&stimulus).args(["--steps", steps]));
        assert!(output.status.success());
        let text = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
        text.contains("it is lost")
    };
    assert!(!faults("4"), "one edge waits");
    assert!(faults("5"), "the next is lost");
}

/// The condition of a GENERATE box sees the box as it was before it makes a token in the scan.
#[test]
fn a_condition_sees_its_own_box_before_a_token_is_made() {
    let net = "int n = own ( int x, int out : )\nGENERATE make SIZE 1 WHEN x <> make DO n = n + 1\n\
               GATE g : make -> IF out\nEND\n";
    let stimulus = "k,x,out\n0,1,0\n2,0,1\n3,0,0\n4,0,1\n5,0,0\n";
    let trace = traced(&[("own.net", net)], stimulus, &["--steps", "6"]);
    assert_eq!(column(&trace, "own.make"), [1., 1., 0., 1., 0., 1.]);
    assert_eq!(column(&trace, "n"), [1., 1., 1., 2., 2., 3.]);
}

/// Two steps that count one word on entry both count, whatever their order.
#[test]
fn two_steps_that_count_one_word_both_count() {
    let first = "OPERATION a MARKED DO n = n + 1\n";
    let second = "OPERATION b MARKED DO n = n + 10\n";
    for lines in [[first, second], [second, first]] {
        let net = format!("int n = both ( : )\n{}{}END\n", lines[0], lines[1]);
        let trace = traced(&[("both.net", &net)], "", &["--steps", "2"]);
        assert_eq!(column(&trace, "n"), [11., 11.]);
    }
}

/// A level that two steps in a row drive has no gap, whatever their order.
#[test]
fn a_level_of_two_steps_in_a_row_has_no_gap() {
    let first = "STATE a MARKED DRIVES q\n";
    let second = "STATE b DRIVES q\n";
    for lines in [[first, second], [second, first]] {
        let net = format!("int q = level ( int go : )\n{}{}GATE g : a -> b IF go\nEND\n", lines[0], lines[1]);
        let trace = traced(&[("level.net", &net)], "k,go\n0,0\n2,1\n", &["--steps", "5"]);
        assert_eq!(column(&trace, "q"), [1.; 5]);
        assert_eq!(column(&trace, "level.b"), [0., 0., 1., 1., 1.]);
    }
}

/// Two different writes of an output in one scan: that of the gate with the higher priority stays, whatever the order.
#[test]
fn of_two_writes_that_of_the_higher_priority_stays() {
    let boxes = ["SIGNAL a DO v = 1.\n", "SIGNAL b DO v = 2.\n"];
    for order in [[0, 1], [1, 0]] {
        let net = format!(
            "real v = writes ( : )\nSTATE p MARKED\nSTATE q MARKED\n{}{}GATE ga : p -> a\nGATE gb : q -> b PRIORITY 5\nEND\n",
            boxes[order[0]], boxes[order[1]]
        );
        let trace = traced(&[("writes.net", &net)], "", &["--steps", "3"]);
        assert_eq!(column(&trace, "v"), [0., 2., 2.]);
    }
}

/// Of two writes that of the net around stays, and the other is told as a conflict.
#[test]
fn a_net_writes_before_those_inside_it() {
    let outer = "int w = outer ( int go : )
STATE a MARKED
STATE b
STATE c MARKED
MODULE M : w = inner ( go : )
GATE first : c -> IF 0
GATE g : a -> b IF go
DO w = 1
END
";
    let inner = "int w = inner ( int go : )\nSTATE a MARKED\nSTATE b\nGATE g : a -> b IF go\nDO w = 2\nEND\n";
    let trace = traced(&[("outer.net", outer), ("inner.net", inner)], "k,go\n0,0\n1,1\n", &["--steps", "3"]);
    assert_eq!(column(&trace, "w"), [0., 1., 1.]);
}

/// A macro's token runs through the net inside; the macro is excited when it stands at the exit.
#[test]
fn a_macro_is_entered_and_left() {
    let outer = "int lamp = outer ( int go, int level : )
STATE idle MARKED
MACRO fill : lamp = filling ( level : )
STATE done
GATE start : idle -> fill IF go
GATE end : fill -> done
GATE again : done -> idle
END
";
    let inner = "int open = filling ( int level : )
ENTRY begin
STATE running DRIVES open
EXIT finished
GATE g1 : begin -> running
GATE g2 : running -> finished IF level
END
";
    let stimulus = "k,go,level\n0,0,0\n1,1,0\n2,0,0\n4,0,1\n";
    let trace = traced(&[("outer.net", outer), ("filling.net", inner)], stimulus, &["--steps", "8"]);
    assert_eq!(column(&trace, "outer.fill"), [0., 1., 1., 1., 1., 0., 0., 0.]);
    assert_eq!(column(&trace, "outer.done"), [0., 0., 0., 0., 0., 1., 0., 0.]);
    assert_eq!(column(&trace, "lamp"), [0., 0., 1., 1., 0., 0., 0., 0.]);
}

/// In a condition a macro is its box, whatever its outputs are.
#[test]
fn a_macro_in_a_condition_is_its_token() {
    let outer = "int lamp, int inside = outer ( int go, int level : )
STATE idle MARKED
MACRO fill : lamp = filling ( level : )
STATE out MARKED
STATE in DRIVES inside
GATE start : idle -> fill IF go
GATE end : fill -> idle
GATE g1 : out -> in IF fill
GATE g2 : in -> out IF NOT fill
END
";
    let inner = "int open = filling ( int level : )
ENTRY begin DRIVES open
EXIT finished
GATE g : begin -> finished IF level
END
";
    let stimulus = "k,go,level\n0,1,0\n1,0,1\n";
    let trace = traced(&[("outer.net", outer), ("filling.net", inner)], stimulus, &["--steps", "5"]);
    assert_eq!(column(&trace, "outer.fill"), [1., 1., 0., 0., 0.]);
    assert_eq!(column(&trace, "lamp"), [1., 0., 0., 0., 0.]);
    assert_eq!(column(&trace, "inside"), [0., 1., 1., 0., 0.]);
}

/// A net may be made of other nets alone.
/// What a net inside counts, and what its ACTIVE tells, reaches the words of the net around it.
#[test]
fn words_of_a_net_inside_come_out_however_they_are_written() {
    let outer = "int n, int step, real t = outer ( : )\nMODULE M : n, step, t = inner ( : )\nEND\n";
    let inner = "int n, int step, real t = inner ( : )\nACTIVE step, t OF a, b\nSTATE a MARKED\nTIME b 2.\n\
                 GATE go : a -> b\nDO n = n + 1\nGATE back : b -> a\nEND\n";
    let trace = traced(&[("outer.net", outer), ("inner.net", inner)], "", &["--period", "1", "--steps", "8"]);
    assert_eq!(column(&trace, "n"), [1., 1., 1., 2., 2., 2., 3., 3.]);
    assert_eq!(column(&trace, "step"), [2., 2., 1., 2., 2., 1., 2., 2.]);
    assert_eq!(column(&trace, "t"), [0., 1., 0., 0., 1., 0., 0., 1.]);
}

/// A gate that puts a token into a GENERATE box makes no edge of its condition.
#[test]
fn a_token_put_into_a_generating_box_makes_no_edge() {
    let net = "int held = pool ( int more, int back : )\nCLASS c ( int a )\nSTATE spare OF c MARKED ( a = 1 ) DRIVES held\n\
               GENERATE made OF c SIZE 9 WHEN more\nGATE give : spare -> made IF back\nEND\n";
    let trace = traced(&[("pool.net", net)], "k,more,back\n0,1,0\n2,1,1\n", &["--steps", "6"]);
    assert_eq!(column(&trace, "pool.made"), [1., 1., 2., 2., 2., 2.]);
}

#[test]
fn a_net_of_modules_has_no_boxes_of_its_own() {
    let outer = "int q = twice ( int b : )
LOCAL int first
MODULE one : first = once ( b : )
MODULE two : q = once ( first : )
END
";
    let inner = "int on = once ( int b : )
STATE off MARKED
STATE up DRIVES on
GATE g : off -> up IF b
END
";
    let trace = traced(&[("twice.net", outer), ("once.net", inner)], "k,b\n0,0\n1,1\n", &["--steps", "4"]);
    assert_eq!(column(&trace, "q"), [0., 0., 1., 1.]);
}

/// A net is a function code: two instances in a configuration, and its boxes on wires.
#[test]
fn a_configuration_calls_nets() {
    let net = "int q = toggle ( int up, int down : )
STATE off MARKED
STATE on DRIVES q
GATE g1 : off -> on IF up
GATE g2 : on -> off IF down
END
";
    let program = "CONTROL
1 one = msi ( : 1 )
2 zero = msi ( : 0 )
3 A = toggle ( one, zero : )
4 B = toggle ( one, one : )
5 y = A.on*10 + B.on
END
";
    let trace = traced(&[("main.cfg", program), ("toggle.net", net)], "", &["--steps", "4"]);
    assert_eq!(column(&trace, "A"), [1., 1., 1., 1.]);
    assert_eq!(column(&trace, "B.on"), [1., 0., 1., 0.]);
    assert_eq!(column(&trace, "y"), [11., 10., 11., 10.]);
}

/// A net that only a composite calls is found beside the program, too.
#[test]
fn a_composite_calls_nets() {
    let folder = tempfile::tempdir().unwrap();
    let files = [
        ("k.cfg", "CONTROL\n1 x = msi ( : 1 )\n2 y = outer ( x : )\nEND\n"),
        ("outer.fc", "int y = outer ( int x : )\nBODY\n1 y = comp ( x : )\nEND\n"),
        ("comp.fc", "int y = comp ( int x : )\nBODY\n1 y = inner ( x : )\nEND\n"),
        ("inner.net", "int y = inner ( int x : )\nSTATE a MARKED\nSTATE b DRIVES y\nGATE g : a -> b IF x\nEND\n"),
    ];
    for (name, text) in files {
        fs::write(folder.path().join(name), text).unwrap();
    }
    let blocks = folder.path().to_str().unwrap();
    let trace = trace(&folder.path().join("k.cfg"), &["--steps", "2", "--blocks", blocks]);
    assert_eq!(column(&trace, "y"), [1., 1.]);
}

/// A condition over a bad operand is not true, its negation neither.
#[test]
fn a_condition_over_a_bad_operand_is_not_true() {
    let net = "int q, int r = bad ( real x : )
STATE a MARKED
STATE b DRIVES q
STATE c MARKED
STATE d DRIVES r
GATE g1 : a -> b IF x > 0.
GATE g2 : c -> d IF NOT x > 0.
END
";
    let trace = traced(&[("bad.net", net)], "k,x\n0,nan\n2,1.\n", &["--steps", "4"]);
    assert_eq!(column(&trace, "q"), [0., 0., 1., 1.]);
    assert_eq!(column(&trace, "r"), [0.; 4]);
    let net = "= way ( real u : )\nSTATE a MARKED\nSTATE b\nGATE g : a -> b IF u/0. > 1. OR 1\nEND\n";
    let trace = traced(&[("way.net", net)], "", &["--steps", "2"]);
    assert_eq!(column(&trace, "way.b"), [0.; 2]);
}

/// A macro is emptied from any step; its token goes to the box that is named, and what ABORT does is done.
#[test]
fn a_macro_is_aborted_from_any_step() {
    let outer = "int stopped = outer ( int go, int trip : )
LOCAL int trips
STATE idle MARKED
MACRO fill = filling ( : )
ABORT trip -> failed
DO trips = trips + 1
STATE failed DRIVES stopped
GATE start : idle -> fill IF go
GATE reset : failed -> idle IF NOT trip
END
";
    let inner = "= filling ( : )
ENTRY begin
STATE left
STATE right
EXIT finished
GATE g1 : begin -> left, right
GATE g2 : left, right -> finished IF 0
END
";
    let stimulus = "k,go,trip\n0,1,0\n1,0,0\n3,0,1\n5,0,0\n";
    let trace = traced(&[("outer.net", outer), ("filling.net", inner)], stimulus, &["--steps", "8"]);
    assert_eq!(column(&trace, "outer.fill"), [1., 1., 1., 0., 0., 0., 0., 0.]);
    assert_eq!(column(&trace, "stopped"), [0., 0., 0., 1., 1., 0., 0., 0.]);
    assert_eq!(column(&trace, "outer.idle"), [0., 0., 0., 0., 0., 1., 1., 1.]);
}

/// No token enters a macro while something is marked in a macro inside it.
#[test]
fn what_stays_in_the_innermost_macro_keeps_tokens_out() {
    let outer = "int n = outer ( int go : )
STATE idle MARKED
MACRO M = middle ( go : )
GATE in : idle -> M
GATE out : M -> idle
DO n = n + 1
END
";
    let middle = "= middle ( int go : )
ENTRY come
MACRO I = inner ( go : )
EXIT gone
GATE a : come -> I
GATE b : I -> gone
END
";
    let inner = "= inner ( int go : )
ENTRY come
STATE rest
EXIT gone
GATE a : come -> gone, rest
GATE b : rest -> IF go
END
";
    let files = [("outer.net", outer), ("middle.net", middle), ("inner.net", inner)];
    let trace = traced(&files, "k,go\n0,0\n9,1\n10,0\n", &["--steps", "14"]);
    assert_eq!(column(&trace, "n"), [0., 0., 0., 0., 1., 1., 1., 1., 1., 1., 1., 1., 1., 1.]);
    let entered = [1., 1., 1., 1., 0., 0., 0., 0., 0., 0., 1., 1., 1., 1.];
    assert_eq!(column(&trace, "outer.M"), entered);
}

/// A macro that is aborted while one inside it is, too, is empty after that.
#[test]
fn macros_are_aborted_together() {
    let outer = "int out = outer ( int go, int stop : )
STATE idle MARKED
MACRO M : out = middle ( stop : )
ABORT stop -> idle
GATE g : idle -> M IF go
END
";
    let middle = "int out = middle ( int stop : )
ENTRY come
STATE p DRIVES out
MACRO I = inner ( : )
ABORT stop -> p
EXIT gone
GATE g : come -> I
END
";
    let inner = "= inner ( : )\nENTRY come\nEXIT gone\nGATE g : come -> gone\nEND\n";
    let files = [("outer.net", outer), ("middle.net", middle), ("inner.net", inner)];
    let trace = traced(&files, "k,go,stop\n0,1,0\n5,1,1\n6,1,0\n", &["--steps", "9"]);
    assert_eq!(column(&trace, "outer.M"), [1., 1., 1., 1., 1., 0., 1., 1., 1.]);
    assert_eq!(column(&trace, "out"), [0.; 9]);
}

/// A command by which a macro is aborted is cleared, so that the macro can be entered again.
#[test]
fn an_abort_clears_its_command() {
    let outer = "= outer ( cell int stop = 0 : )
MOMENTARY stop
STATE idle MARKED
MACRO M = inner ( : )
ABORT stop -> idle
GATE g : idle -> M
END
";
    let inner = "= inner ( : )\nENTRY come\nEXIT gone\nGATE g : come -> gone IF 0\nEND\n";
    let stimulus = "k,outer.stop\n0,0\n2,1\n";
    let trace = traced(&[("outer.net", outer), ("inner.net", inner)], stimulus, &["--steps", "5"]);
    assert_eq!(column(&trace, "outer.M"), [1., 1., 0., 1., 1.]);
    assert_eq!(column(&trace, "outer.stop"), [0.; 5]);
}

/// A time that is bad does not end; it ends when it is good again and over.
#[test]
fn a_bad_time_does_not_end() {
    let net = "int q, int r = bad ( real t : )
TIME a t MARKED
STATE b DRIVES q
PROCESS p MARKED UNTIL 0 WITHIN t
STATE c DRIVES r
GATE g : a -> b
GATE h : p -> c
END
";
    for bad in ["nan", "inf", "-inf"] {
        let stimulus = format!("k,t\n0,{bad}\n3,0.5\n");
        let trace = traced(&[("bad.net", net)], &stimulus, &["--steps", "5", "--period", "0.5"]);
        assert_eq!(column(&trace, "q"), [0., 0., 0., 1., 1.], "{bad}");
        assert_eq!(column(&trace, "r"), [0., 0., 0., 1., 1.], "{bad}");
    }
}

/// A token that waits takes the room that has come; what comes in the same scan waits after it.
#[test]
fn a_token_that_waits_goes_first() {
    let net = "int q = make ( int x, int take : )
GENERATE g SIZE 1 WHEN x DO q = q + 1
GATE out : g -> IF take
END
";
    let stimulus = "k,x,take\n0,1,0\n1,0,0\n2,1,0\n3,0,0\n4,0,1\n5,1,0\n6,1,1\n7,1,0\n";
    let trace = traced(&[("make.net", net)], stimulus, &["--steps", "9"]);
    assert_eq!(column(&trace, "make.g"), [1., 1., 1., 1., 0., 1., 0., 1., 1.]);
    assert_eq!(column(&trace, "q"), [1., 1., 1., 1., 1., 2., 2., 3., 3.]);
}

/// Tokens leave a queue in its order, and carry their attributes along.
#[test]
fn queues_give_tokens_in_their_order() {
    let orders = [("fifo", [3., 1., 2.]), ("lifo", [2., 1., 3.]), ("least n", [1., 2., 3.]), ("most n", [3., 2., 1.])];
    for (order, expected) in orders {
        let net = format!(
            "int out = queue ( int in, int n, int go : )
CLASS job ( int n = 0 )
GENERATE make OF job SIZE 1 WHEN in DO make.n = n
CAPACITY wait OF job SIZE 5 ORDER {order}
OPERATION show OF job DO out = show.n
GATE g1 : make -> wait
GATE g2 : wait -> show IF go
GATE g3 : show ->
END
"
        );
        let stimulus = "k,in,n,go\n0,1,3,0\n1,0,3,0\n2,1,1,0\n3,0,1,0\n4,1,2,0\n5,0,2,1\n";
        let trace = traced(&[("queue.net", &net)], stimulus, &["--steps", "12"]);
        let shown: Vec<f64> = [6, 8, 10].iter().map(|scan| column(&trace, "out")[*scan]).collect();
        assert_eq!(shown, expected, "{order}");
    }
}

/// A process is supervised: AFTER learns the cause, and waits as long as it says so.
#[test]
fn a_process_waits_as_long_as_after_says() {
    let net = "int cause, int tries, int q = sup ( int done : )
STATE idle MARKED
PROCESS send UNTIL done WITHIN 0.2
AFTER cause = send.cause + 1
AFTER tries = tries + 1
AFTER send.ready = (tries >= 3) OR send.cause == 0
STATE end DRIVES q
GATE g1 : idle -> send
GATE g2 : send -> end
END
";
    let late = traced(&[("sup.net", net)], "k,done\n0,0\n", &["--steps", "12", "--period", "0.1"]);
    assert_eq!(column(&late, "tries"), [0., 0., 0., 1., 1., 2., 2., 3., 3., 3., 3., 3.]);
    assert_eq!(column(&late, "q").iter().position(|q| *q > 0.), Some(7));
    assert!((column(&late, "cause")[11] - 2.).abs() < 0.5);
    let done = traced(&[("sup.net", net)], "k,done\n0,0\n2,1\n", &["--steps", "6", "--period", "0.1"]);
    assert_eq!(column(&done, "cause"), [0., 0., 1., 1., 1., 1.]);
    assert_eq!(column(&done, "q"), [0., 0., 1., 1., 1., 1.]);
}

/// A gate takes the first token that satisfies its condition, and a permissive holds it back.
#[test]
fn gates_choose_tokens_and_ask_permissives() {
    let net = "int got = choose ( int want, int closed : )
CLASS part ( int kind = 0 )
STATE a OF part MARKED ( kind = 1 )
STATE b OF part MARKED ( kind = 2 )
CAPACITY store OF part SIZE 3
OPERATION taken OF part DO got = taken.kind
GATE g1 : a -> store
GATE g2 : b -> store PRIORITY 1
GATE g3 : store -> taken PERMIT closed IF store.kind == want
END
";
    let stimulus = "k,want,closed\n0,1,0\n3,1,1\n";
    let trace = traced(&[("choose.net", net)], stimulus, &["--steps", "6"]);
    assert_eq!(column(&trace, "choose.store"), [2., 2., 2., 1., 1., 1.]);
    assert_eq!(column(&trace, "got"), [0., 0., 0., 0., 1., 1.]);
}

/// ACTIVE tells which box is marked and since when; FOR makes boxes with an index; modules run beside.
#[test]
fn active_boxes_repeated_lines_and_modules() {
    let outer = "int step, real t = line ( int go : )
LOCAL int busy
FOR i = 1 TO 3
STATE s[i]
NEXT
STATE s0 MARKED
MODULE lamp : busy = blink ( s[2] : )
GATE g0 : s0 -> s[1] IF go
FOR i = 1 TO 2
GATE g[i] : s[i] -> s[i+1]
NEXT
GATE g3 : s[3] -> s0 IF busy
ACTIVE step, t OF s0, s[1], s[2], s[3]
END
";
    let inner = "int on = blink ( int run : )
STATE dark MARKED
STATE bright DRIVES on
GATE up : dark -> bright IF run
END
";
    let trace = traced(
        &[("line.net", outer), ("blink.net", inner)],
        "k,go\n0,0\n1,1\n2,0\n",
        &["--steps", "7", "--period", "0.5"],
    );
    assert_eq!(column(&trace, "step"), [1., 2., 3., 4., 1., 1., 1.]);
    assert_eq!(column(&trace, "t"), [0., 0., 0., 0., 0., 0.5, 1.]);
}

/// ABORT empties the macros in a macro too: it can be entered again.
#[test]
fn an_abort_empties_macros_in_a_macro() {
    let outer = "int q = aborts ( int go, int trip : )
STATE idle MARKED
MACRO mid : q = mids ( : )
ABORT trip -> idle
GATE start : idle -> mid IF go
END
";
    let middle = "int q = mids ( : )\nENTRY come\nMACRO deep : q = deeps ( : )\nEXIT gone\nGATE in : come -> deep\nGATE out : deep -> gone\nEND\n";
    let inner = "int q = deeps ( : )\nENTRY come\nSTATE on DRIVES q\nEXIT gone\nGATE a : come -> on\nGATE b : on -> gone IF 0\nEND\n";
    let files = [("aborts.net", outer), ("mids.net", middle), ("deeps.net", inner)];
    let trace = traced(&files, "k,go,trip\n0,1,0\n4,0,1\n5,0,0\n6,1,0\n", &["--steps", "11"]);
    assert_eq!(column(&trace, "q"), [0., 0., 1., 1., 0., 0., 0., 0., 1., 1., 1.]);
}

/// A function in C of one's own: what it is called with is compared by the C compiler, a missing one is told before.
#[test]
fn functions_in_c_are_called_from_nets() {
    let folder = tempfile::tempdir().unwrap();
    let put = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    put(
        "u.net",
        "int y = u ( int x : )\nSTATE a MARKED\nOPERATION b DO y = twice ( x : )\nGATE g : a -> b IF x\nEND\n",
    );
    put(
        "twice.fc",
        "! Twice.\nint q = twice ( int a : )\nBAD L\nEXAMPLE q = 4\n1 x = msi ( : 2 )\n2 q = twice ( x : )\nEND\n",
    );
    let ran = |form: &str| {
        let mut command = pcl2();
        command.arg("run").arg(folder.path().join("u.net")).arg("--blocks").arg(folder.path());
        run(command.args(["--steps", "3", "--set", "x=3", "--engine", "cc", "--trace", "-", "--net-form", form]))
    };
    let missing = String::from_utf8_lossy(&ran("fast").stderr).into_owned();
    assert!(missing.contains("P0504") && missing.contains("twice.c"), "{missing}");
    put(
        "twice.c",
        "#include \"pcl2_twice.h\"\nvoid pcl2_twice(struct pcl2_twice *self, double a)\n{\n    self->q = (int)a;\n}\n",
    );
    let wrong = String::from_utf8_lossy(&ran("fast").stderr).into_owned();
    assert!(wrong.contains("twice.c") && wrong.contains("pcl2_twice"), "{wrong}");
    put(
        "twice.c",
        "#include \"pcl2_twice.h\"\nvoid pcl2_twice(struct pcl2_twice *self, int32_t a)\n{\n    self->q = 2 * a;\n}\n",
    );
    for form in FORMS {
        let right = ran(form);
        assert!(right.status.success(), "{}", String::from_utf8_lossy(&right.stderr));
        assert_eq!(column(&read(&right.stdout), "y"), [0., 6., 6.], "{form}");
    }
}

/// The player compiles without a word, in both widths, on the host and for a microcontroller.
#[test]
fn compilers_have_nothing_to_say_about_the_player() {
    let runtime = root().join("runtime-c");
    for (real, bits, literal) in [("double", 64, "x"), ("float", 32, "x##f")] {
        let work = folder();
        let config = format!("typedef {real} pcl2_real;\n#define PCL2_REAL_BITS {bits}\n#define PCL2_R(x) {literal}\n");
        fs::write(work.path().join("pcl2_config.h"), config).unwrap();
        for (compiler, more) in [("gcc", &["-O2"][..]), ("clang", &["-O2"]), ("arm-none-eabi-gcc", &CORTEX_M)] {
            let mut command = Command::new(compiler);
            command.args(STRICT).args(more).arg("-c").arg(runtime.join("src/net/net.c"));
            for include in [work.path(), &runtime.join("include"), &runtime.join("src/net")] {
                command.arg("-I").arg(include);
            }
            check(command.arg("-o").arg(work.path().join("net.o")));
        }
    }
}
