//! Nets as the player runs them: the papers' examples, what a scan promises, and random nets against a step of their own.

use pcl2_tests::compilers::{CORTEX_M, STRICT, check, folder};
use pcl2_tests::{pcl2, root, run};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::Command;

/// The values of each column of a trace.
type Trace = BTreeMap<String, Vec<f64>>;

/// Runs a program and returns the text of its trace.
fn run_in(path: &Path, args: &[&str], engine: &[&str]) -> Vec<u8> {
    let output = run(pcl2().arg("run").arg(path).args(["--trace", "-"]).args(args).args(engine));
    assert!(output.status.success(), "{engine:?}: {}", String::from_utf8_lossy(&output.stderr));
    output.stdout
}

/// Runs a program in the embedded engine and in each form of its C, and reads the trace that all of them give.
fn trace(path: &Path, args: &[&str]) -> Trace {
    let output = run_in(path, args, &[]);
    for form in FORMS {
        let compiled = run_in(path, args, &["--engine", "cc", "--net-form", form]);
        assert_eq!(String::from_utf8_lossy(&compiled), String::from_utf8_lossy(&output), "{form}");
    }
    read(&output)
}

fn read(text: &[u8]) -> Trace {
    let mut reader = csv::Reader::from_reader(text);
    let names: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let mut trace = Trace::new();
    for row in reader.records() {
        for (name, value) in names.iter().zip(row.unwrap().iter()) {
            trace.entry(name.clone()).or_default().push(value.parse().unwrap_or(f64::NAN));
        }
    }
    trace
}

/// The forms of a net in C.
const FORMS: [&str; 2] = ["table", "fast"];

/// Runs nets written here: file name and text, the first is the program.
fn traced(files: &[(&str, &str)], stimulus: &str, args: &[&str]) -> Trace {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        fs::write(folder.path().join(name), text).unwrap();
    }
    let mut args = args.to_vec();
    let file = folder.path().join("stimulus.csv");
    let file = file.to_str().unwrap().to_owned();
    if !stimulus.is_empty() {
        fs::write(&file, stimulus).unwrap();
        args.extend(["--stimulus", &file]);
    }
    trace(&folder.path().join(files[0].0), &args)
}

fn column<'t>(trace: &'t Trace, name: &str) -> &'t [f64] {
    trace.get(name).unwrap_or_else(|| panic!("no column {name} in {:?}", trace.keys()))
}

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
    let net = "int dummy = pool ( int more, int back : )\nCLASS c ( int a )\nSTATE spare OF c MARKED ( a = 1 ) DRIVES dummy\n\
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

/// Runs a net and returns what is told of it, in the embedded engine and in C, which tell the same.
fn told(net: &str, name: &str, stimulus: &str, steps: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let (file, values) = (folder.path().join(format!("{name}.net")), folder.path().join("s.csv"));
    fs::write(&file, net).unwrap();
    fs::write(&values, stimulus).unwrap();
    let shown = |engine: &[&str]| {
        let output =
            run(pcl2().arg("run").arg(&file).arg("--stimulus").arg(&values).args(["--steps", steps]).args(engine));
        let text = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{text}");
        text
    };
    let embedded = shown(&[]);
    assert_eq!(embedded, shown(&["--engine", "cc"]));
    embedded
}

const STOPPABLE: &str = "int y, int z, int n, real v, int step, real t = stops ( int mode, int go : )
MODE mode
STOP z = HOLD, v = -1.5, n = 7
ACTIVE step, t OF a, b, c
STATE a MARKED DRIVES y
TIME b 0.3 DRIVES z
OPERATION c DO n = n + 1
DO v = 2.5
GATE g1 : a -> b IF go
GATE g2 : b -> c
GATE g3 : c -> a
END
";

/// A stopped net shows what its outputs are meanwhile; then it goes on where it was, its times too.
#[test]
fn a_stopped_net_stands_still_and_goes_on() {
    let args = ["--steps", "14", "--period", "0.1"];
    let through = traced(&[("stops.net", STOPPABLE)], "k,mode,go\n0,0,0\n2,0,1\n", &args);
    let stopped = traced(&[("stops.net", STOPPABLE)], "k,mode,go\n0,0,0\n2,0,1\n4,9,1\n7,0,1\n10,3,1\n12,0,1\n", &args);
    let scans = [0, 1, 2, 3, 7, 8, 9, 12, 13];
    for name in ["y", "z", "n", "v", "step", "t", "stops.a", "stops.b", "stops.c"] {
        let running: Vec<f64> = scans.iter().map(|scan| column(&stopped, name)[*scan]).collect();
        assert_eq!(running, column(&through, name)[..scans.len()], "{name}");
    }
    for scan in [4, 5, 6, 10, 11] {
        let row = |name: &str| column(&stopped, name)[scan];
        let last = if scan < 7 { 3 } else { 9 };
        let held = |name: &str| column(&stopped, name)[last];
        assert_eq!([row("y"), row("n"), row("v")], [0., 7., -1.5], "scan {scan}");
        for name in ["z", "step", "t", "stops.a", "stops.b", "stops.c"] {
            assert!((row(name) - held(name)).abs() < 1e-12, "{name} in scan {scan}");
        }
    }
    assert_eq!(column(&stopped, "y")[9], 1., "the second stop begins while y is driven");
}

/// Step by step, gates are tried in a scan with a command alone; boxes go on.
#[test]
fn a_step_is_one_gate_phase() {
    let net = "int n = steps ( cell int mode = 0, cell int next = 0 : )
MODE mode, next
OPERATION a MARKED DO n = n + 1
TIME b 0.2
GATE g1 : a -> b
GATE g2 : b -> a
END
";
    let stimulus = "k,steps.mode,steps.next\n0,step,0\n2,step,1\n3,step,1\n6,step,1\n8,automatic,0\n";
    let trace = traced(&[("steps.net", net)], stimulus, &["--steps", "12", "--period", "0.1"]);
    assert_eq!(column(&trace, "steps.a"), [1., 1., 0., 0., 0., 0., 1., 1., 0., 0., 1., 0.]);
    assert_eq!(column(&trace, "n"), [1., 1., 1., 1., 1., 1., 1., 2., 2., 2., 2., 3.]);
    assert_eq!(column(&trace, "steps.next"), [0.; 12], "commands are cleared");
}

const HANDS: &str =
    "int y, int last, int why = hands ( int mode, cell int next = 0, cell int fire = 0, cell int put = 0
                                  , cell int take = 0, int ok : )
CLASS job ( int kind = 4 )
MODE mode, next, fire, put, take
STOP last = HOLD
BLOCKED why
STATE idle MARKED
STATE busy DRIVES y
CAPACITY queue OF job SIZE 2 ORDER lifo
COUNT three 3
OPERATION show OF job DO last = show.kind
GATE start : idle -> busy PERMIT ok IF 0
THEN idle -> nothing
IF 0
THEN idle -> busy
GATE shows : queue -> show PRIORITY 1 IF queue.kind > 9
GATE stop : busy -> idle IF 0
GATE out : show ->
GATE full : three -> queue IF 0
THEN three -> nothing
THEN NEW -> queue
END
";

/// In manual mode no gate fires by itself. What is forced is checked against tokens and room, and recorded.
#[test]
fn gates_and_tokens_are_forced_by_hand() {
    let rows = [
        "0,manual,0,0,0,0,0",           // nothing
        "1,manual,0,stop,0,0,0",        // no token: refused
        "2,manual,0,start,0,0,0",       // by the first rule: the token vanishes
        "3,manual,0,0,idle,0,0",        // a token
        "4,manual,0,0,idle,0,0",        // no room: refused
        "5,manual,0,0,queue,0,0",       // the class's first values
        "6,manual,0,shows,queue,0,0",   // takes the one, puts another
        "7,manual,0,out,three,queue,0", // three commands
        "8,manual,0,out,0,queue,0",     // the gate is obeyed, the other refused
        "9,manual,0,0,three,0,0",
        "10,manual,0,full,three,0,0", // not full: refused; the token is put
        "11,manual,0,full,0,three,0", // the gate empties the box: the token is refused
        "12,manual,1,0,0,0,0",        // a step is no command of this mode: refused
        "13,automatic,0,start,0,0,0", // refused
    ];
    let names = "k,mode,hands.next,hands.fire,hands.put,hands.take,ok\n";
    let net = HANDS.replace("int mode,", "cell int mode = 0,");
    let rows: Vec<String> = rows.iter().map(|row| (*row).to_owned()).collect();
    let stimulus = names.replace("k,mode", "k,hands.mode") + &rows.join("\n");
    let trace = traced(&[("hands.net", &net)], &stimulus, &["--steps", "15"]);
    let expected: [(&str, [f64; 15]); 5] = [
        ("hands.idle", [1., 1., 0., 1., 1., 1., 1., 1., 1., 1., 1., 1., 1., 1., 1.]),
        ("hands.queue", [0., 0., 0., 0., 0., 1., 1., 0., 0., 0., 0., 1., 1., 1., 1.]),
        ("hands.show", [0., 0., 0., 0., 0., 0., 1., 0., 0., 0., 0., 0., 0., 0., 0.]),
        ("hands.three", [0., 0., 0., 0., 0., 0., 0., 1., 1., 2., 3., 0., 0., 0., 0.]),
        ("last", [0., 0., 0., 0., 0., 0., 0., 4., 4., 4., 4., 4., 4., 4., 4.]),
    ];
    for (name, values) in expected {
        assert_eq!(column(&trace, name), values, "{name}");
    }
    for command in ["hands.fire", "hands.put", "hands.take", "hands.next"] {
        assert_eq!(column(&trace, command), [0.; 15], "{command} is cleared");
    }
    let first = |row: usize, steps: &str| {
        let text = told(
            &net,
            "hands",
            &(names.replace("k,mode", "k,hands.mode") + &rows[row].replace(row.to_string().as_str(), "0")),
            steps,
        );
        let line = text.lines().find(|line| line.contains("first fault")).unwrap_or_default().to_owned();
        (line.contains("an operator forced"), line.contains("of an operator was refused"))
    };
    assert_eq!(first(0, "2"), (false, false));
    assert_eq!(first(1, "2"), (false, true));
    assert_eq!(first(2, "2"), (true, false));
    assert_eq!(first(13, "2"), (false, true));
}

/// A wired mode that has no meaning stops the net, and a number that no gate or box has is refused.
#[test]
fn what_has_no_meaning_stops_or_is_refused() {
    let program = "CONTROL
1 mode = msi ( : 2 )
2 fire = msi ( : 0 )
3 ok = msi ( : 1 )
4 y, last, why = hands ( mode, , fire, , , ok : )
END
";
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("hands.net"), HANDS).unwrap();
    let file = folder.path().join("main.cfg");
    fs::write(&file, program).unwrap();
    for (mode, fire, refused) in
        [("2", "6", true), ("2", "-1", true), ("2", "0", false), ("-1", "0", false), ("7", "1", true)]
    {
        let set = [format!("mode.value={mode}"), format!("fire.value={fire}")];
        let output = run(pcl2().arg("run").arg(&file).args(["--steps", "2", "--set", &set[0], "--set", &set[1]]));
        let text = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{text}");
        assert_eq!(text.contains("was refused"), refused, "mode {mode}, fire {fire}\n{text}");
    }
}

/// The first permissive that holds a gate back is told by number and name, and only if tokens, rule and room are there.
#[test]
fn the_permissive_that_holds_a_gate_back_is_told() {
    let net = "int why = tells ( int go, int v1, int v2, cell int mode = 0, cell int next = 0 : )
MODE mode, next
BLOCKED why
STATE a MARKED
STATE b
STATE c MARKED
STATE d
GATE low : a -> b PERMIT v1, (v2 OR   ! either
     v1 > 3) IF go
GATE high : c -> d PRIORITY 1 PERMIT NOT v2
GATE back : d -> c
END
";
    let stimulus = "k,go,v1,v2,tells.mode,tells.next
0,0,0,1,0,0
1,1,0,0,0,0
2,1,1,0,0,0
3,1,1,1,0,0
4,1,1,1,1,0
5,1,1,1,1,1
6,1,1,0,1,0
7,1,1,1,2,0
";
    let trace = traced(&[("tells.net", net)], stimulus, &["--steps", "8"]);
    assert_eq!(column(&trace, "tells.c"), [1., 0., 1., 1., 1., 1., 1., 1.]);
    assert_eq!(column(&trace, "tells.a"), [1., 1., 1., 0., 0., 0., 0., 0.]);
    assert_eq!(column(&trace, "why"), [3., 1., 2., 3., 3., 3., 3., 0.]);
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("tells.net"), net).unwrap();
    let out = folder.path().join("out");
    check(pcl2().arg("build").arg(folder.path().join("tells.net")).arg("-o").arg(&out));
    let map = fs::read_to_string(out.join("tells.json")).unwrap();
    let names = r#""names":["none","low blocked: v1","low blocked: (v2 OR v1 > 3)","high blocked: NOT v2"]"#;
    assert!(map.contains(names), "{map}");
    assert!(map.contains(r#""names":["automatic","step","manual","stopped"]"#), "{map}");
}

/// Nets inside have the mode of the one around them unless they have one of their own.
#[test]
fn nets_inside_follow_the_mode() {
    let outer = "int a, int b, int kept, int step = around ( int mode, int own, int go : )
MODE mode
STOP b = HOLD, kept = HOLD, step = HOLD
STATE dark MARKED
MODULE follows : a, _, step = runner ( go : )
MODULE free : b, kept = free ( own, go : )
END
";
    let inner = "int on, int n, int step = runner ( int go : )
ACTIVE step OF first, second
OPERATION first MARKED DO n = n + 1
STATE second DRIVES on
GATE g1 : first -> second IF go
GATE g2 : second -> first IF go
END
";
    let free = "int on, int n = free ( int mode, int go : )
MODE mode
STOP n = 9
OPERATION first MARKED DO n = n + 1
STATE second DRIVES on
GATE g1 : first -> second IF go
GATE g2 : second -> first IF go
END
";
    let files = [("around.net", outer), ("runner.net", inner), ("free.net", free)];
    let stimulus = "k,mode,own,go\n0,0,0,1\n3,3,0,1\n5,0,3,1\n7,0,0,1\n";
    let trace = traced(&files, stimulus, &["--steps", "9"]);
    assert_eq!(
        column(&trace, "a"),
        [1., 0., 1., 0., 0., 0., 1., 0., 1.],
        "off while stopped, then on from where it was"
    );
    assert_eq!(column(&trace, "step"), [2., 1., 2., 2., 2., 1., 2., 1., 2.]);
    assert_eq!(
        column(&trace, "b"),
        [1., 0., 1., 1., 1., 0., 0., 0., 1.],
        "held outside, run inside, stopped by its own"
    );
    assert_eq!(column(&trace, "kept"), [1., 1., 2., 2., 2., 9., 9., 3., 4.]);
}

/// A macro is emptied by hand with all that is in it; its own net keeps a token as long as the macro is marked.
#[test]
fn macros_are_forced_as_a_whole() {
    let outer = "int q = tops ( int mode, cell int put = 0, cell int take = 0, cell int p = 0, cell int t = 0 : )
MODE mode, g, f, put, take
STATE idle MARKED
MACRO mid : q = mids ( mode, p, t : )
GATE start : idle -> mid IF 0
END
"
    .replace("int mode,", "int mode, cell int g = 0, cell int f = 0,");
    let middle = "int q = mids ( int mode, cell int p = 0, cell int t = 0, cell int f = 0, cell int g = 0 : )
MODE mode, g, f, p, t
ENTRY come
STATE one DRIVES q
MACRO deep = deeps ( : )
EXIT gone
GATE in : come -> one, deep
GATE out : one -> gone IF 0
END
";
    let inner = "= deeps ( : )\nENTRY come\nEXIT gone\nGATE never : come -> gone IF 0\nEND\n";
    let files = [("tops.net", outer.as_str()), ("mids.net", middle), ("deeps.net", inner)];
    let stimulus = "k,mode,tops.put,tops.take,tops.p,tops.t
0,2,0,0,2,0
1,2,2,0,0,0
2,2,0,0,4,1
3,2,2,0,2,0
4,2,0,0,0,2
5,0,0,0,0,0
6,2,0,0,0,2
7,2,0,0,0,3
8,2,0,2,0,0
9,2,2,0,0,0
";
    let trace = traced(&files, stimulus, &["--steps", "11"]);
    assert_eq!(column(&trace, "tops.mid"), [0., 1., 1., 1., 1., 1., 1., 1., 0., 1., 1.]);
    assert_eq!(column(&trace, "q"), [0., 0., 0., 1., 0., 1., 0., 0., 0., 0., 0.]);
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

/// What is wrong in a net is told at its place, and nothing runs.
#[test]
fn nets_with_mistakes_are_refused() {
    let head = "= bad ( int x : )\n";
    let cases = [
        ("STATE a MARKED\nGATE g : a -> b\nEND\n", "P0401"),
        ("STATE a\nSTATE a\nEND\n", "P0402"),
        ("CAPACITY a SIZE 2 MARKED 3\nEND\n", "P0404"),
        ("MACRO m = bad ( x : )\nEND\n", "P0406"),
        ("STATE a SIZE 3\nEND\n", "P0408"),
        ("STATE a MARKED\nGATE g : a -> IF 1.5\nEND\n", "P0409"),
        ("CLASS c ( int n )\nSTATE a OF c\nSTATE b\nGATE g : b -> a\nEND\n", "P0405"),
        ("STATE a MARKED\n", "P0006"),
        ("OPERATION o DO nobody ( x : )\nEND\n", "P0101"),
        ("GATE g : a ->\nTHEN\nEND\n", "P0002"),
        ("END\n", "P0408"),
        ("STATE a\nSTATE b MARKED\nSTATE c\nGATE g : b -> a, c\nTHEN b -> a\nEND\n", "P0403"),
        ("STATE a\nFOR i = 1 TO 2000000000\nNEXT\nEND\n", "P0208"),
        ("STATE a\nFOR i = 1 TO 2000000000\nFOR j = 1 TO 2000000000\nNEXT\nNEXT\nEND\n", "P0208"),
        ("CLASS c ( int n )\nFOR i = 1 TO 1000\nCAPACITY a[i] OF c SIZE 65535\nNEXT\nEND\n", "P0208"),
        ("MODE y\nSTATE a\nEND\n", "P0408"),
        ("MODE x\nMODE x\nSTATE a\nEND\n", "P0408"),
        ("MODE x, x\nSTATE a\nEND\n", "P0408"),
        ("LOCAL int l\nMODE x\nSTOP l = 0\nSTATE a\nEND\n", "P0408"),
        ("LOCAL int l\nSTOP l = 0\nSTATE a\nEND\n", "P0408"),
        ("MODE x\nSTOP nobody = HOLD\nSTATE a\nEND\n", "P0401"),
        ("LOCAL real l\nBLOCKED l\nSTATE a\nEND\n", "P0203"),
        ("LOCAL int l\nBLOCKED l\nBLOCKED l\nSTATE a\nEND\n", "P0408"),
        ("LOCAL int l\nBLOCKED l\nOPERATION a DO l = 1\nEND\n", "P0407"),
        ("BLOCKED x\nSTATE a\nEND\n", "P0401"),
        ("MODE\nSTATE a\nEND\n", "P0002"),
        ("STOP l = a\nSTATE a\nEND\n", "P0002"),
    ];
    for (text, code) in cases {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("bad.net");
        fs::write(&file, format!("{head}{text}")).unwrap();
        let output = run(pcl2().arg("check").arg(&file));
        let shown = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{text}\n{shown}");
        assert!(shown.contains(code), "{code} for\n{text}\nfound\n{shown}");
    }
}

/// A mistake in the head points at the name there; two things of one name are told once, not again where the name is
/// used; a help can be followed.
#[test]
fn a_mistake_is_told_once_at_its_place() {
    let cases = [
        ("int v, int q = bad ( : )\nSTATE a MARKED DRIVES v\nEND\n", "P0407", "bad.net:1:12"),
        ("int v, real q = bad ( : )\nSTATE a MARKED DRIVES v, q\nEND\n", "P0407", "bad.net:1:13"),
        ("int v = bad ( int v : )\nSTATE a MARKED DRIVES v\nEND\n", "P0402", "bad.net:1:5"),
        ("ivec[2] v = bad ( : )\nSTATE a MARKED\nEND\n", "P0501", "bad.net:1:9"),
        (
            "int on = bad ( int b : )\nSTATE off MARKED\nSTATE on DRIVES on\nGATE g : off -> on IF b\nGATE h : on -> off\nEND\n",
            "P0402",
            "bad.net:3:7",
        ),
        ("= bad ( : )\nSTATE a MARKED 2\nEND\n", "P0404", "expected at most 1 token in `a`, found 2"),
        ("= bad ( : )\nSTATE a MARKED\nSTATE b\nGATE g : 2*a -> b\nEND\n", "P0404", "at most 1 token from or to `a`"),
        (
            "= bad ( : )\nCLASS c ( int k )\nSTATE a MARKED\nSTATE b OF c\nGATE g : a -> b\nEND\n",
            "P0405",
            "help: make a new one: `THEN a -> nothing`, `THEN NEW -> b`",
        ),
        (
            "= bad ( : )\nCLASS c ( int k )\nSTATE a MARKED\nSTATE p OF c MARKED\nSTATE b OF c\nGATE g : a, p -> b\nEND\n",
            "P0405",
            "help: say with THEN which token goes where: `THEN p -> b`",
        ),
    ];
    for (text, code, words) in cases {
        let (status, shown) = checked(text);
        assert_eq!(status, Some(1), "{text}\n{shown}");
        assert_eq!(shown.matches("error[").count(), 1, "{text}\n{shown}");
        assert!(shown.contains(code) && shown.contains(words), "{code} {words} for\n{text}\nfound\n{shown}");
    }
    let followed = "= bad ( : )\nCLASS c ( int k )\nSTATE a MARKED\nSTATE b OF c\nGATE g : a -> b\nTHEN a -> nothing\nTHEN NEW -> b\nEND\n";
    assert_eq!(checked(followed), (Some(0), String::new()));
}

/// Checks the net `bad`.
fn checked(text: &str) -> (Option<i32>, String) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("bad.net"), text).unwrap();
    let output = run(pcl2().args(["check", "bad.net"]).current_dir(folder.path()));
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
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

/// What an operator works a net by is asked for in the head, and named once.
#[test]
fn modes_with_mistakes_are_refused() {
    let heads = "int q, real r = bad ( int x, cell int g, cell real h, cell int m : )\n";
    let rest = "STATE a MARKED DRIVES q\nOPERATION b DO r = 1.\nEND\n";
    let cases = [
        ("MODE x, h\n", "P0408"),
        ("MODE x, x\n", "P0408"),
        ("MODE h\n", "P0408"),
        ("MODE g, g\n", "P0408"),
        ("MODE x, g, g\n", "P0408"),
        ("MOMENTARY g\nMODE x, g\n", "P0408"),
        ("MOMENTARY m, m\n", "P0408"),
        ("MODE x, g, m, nobody\n", "P0408"),
        ("MODE x, g, m, g, m, g\n", "P0408"),
        ("MODE x\nSTOP q = 1, q = 2\n", "P0408"),
        ("MODE x\nSTOP q = 1.5\n", "P0210"),
        ("MODE x\nSTOP x = 1\n", "P0408"),
        ("MODE x\nSTOP q = 1 r = 2\n", "P0002"),
        ("BLOCKED q\n", "P0407"),
        ("BLOCKED g\n", "P0401"),
    ];
    for (text, code) in cases {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("bad.net");
        fs::write(&file, format!("{heads}{text}{rest}")).unwrap();
        let output = run(pcl2().arg("check").arg(&file));
        let shown = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{text}\n{shown}");
        assert!(shown.contains(code), "{code} for\n{text}\nfound\n{shown}");
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

/// A small generator of numbers: the same nets everywhere.
struct Dice(u64);

impl Dice {
    fn roll(&mut self, sides: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % sides
    }
}

/// A net of buffers: what a scan does is written down here once more, from the definition.
struct Plain {
    capacity: Vec<i64>,
    start: Vec<i64>,
    gates: Vec<PlainGate>,
}

struct PlainGate {
    takes: Vec<(usize, i64)>,
    puts: Vec<(usize, i64)>,
    reads: Vec<(usize, i64)>,
    inhibits: Vec<(usize, i64)>,
    priority: i64,
    input: Option<usize>,
}

const INPUTS: usize = 4;

impl Plain {
    fn random(dice: &mut Dice) -> Plain {
        let places = 2 + dice.roll(6) as usize;
        let capacity: Vec<i64> = (0..places).map(|_| 1 + dice.roll(4) as i64).collect();
        let start = capacity.iter().map(|most| dice.roll(*most as u64 + 1) as i64).collect();
        let arcs = |dice: &mut Dice, most: u64| {
            let mut arcs: Vec<(usize, i64)> = Vec::new();
            for _ in 0..dice.roll(most) {
                let place = dice.roll(places as u64) as usize;
                if arcs.iter().all(|(known, _)| *known != place) {
                    let weight = 1 + dice.roll(2).min(capacity[place] as u64 - 1) as i64;
                    arcs.push((place, weight));
                }
            }
            arcs
        };
        let gates = (0..1 + dice.roll(8)).map(|_| PlainGate {
            takes: arcs(dice, 3),
            puts: arcs(dice, 3),
            reads: arcs(dice, 2),
            inhibits: arcs(dice, 2),
            priority: dice.roll(3) as i64,
            input: (dice.roll(2) == 0).then(|| dice.roll(INPUTS as u64) as usize),
        });
        let gates: Vec<PlainGate> = gates.collect();
        Plain { capacity, start, gates }
    }

    fn text(&self) -> String {
        // Each gate counts its firings.
        let counts: Vec<String> = (0..self.gates.len()).map(|i| format!("int f{i}")).collect();
        let mut text = format!("{} = plain ( int x0, int x1, int x2, int x3 : )\n", counts.join(", "));
        for (i, (capacity, start)) in self.capacity.iter().zip(&self.start).enumerate() {
            let marked = if *start > 0 { format!(" MARKED {start}") } else { String::new() };
            let _ = writeln!(text, "CAPACITY p{i} SIZE {capacity}{marked}");
        }
        let list = |arcs: &[(usize, i64)]| {
            arcs.iter().map(|(place, weight)| format!("{weight}*p{place}")).collect::<Vec<_>>().join(", ")
        };
        for (i, gate) in self.gates.iter().enumerate() {
            let _ = write!(text, "GATE t{i} : {} -> {}", list(&gate.takes), list(&gate.puts));
            for (word, arcs) in [("READ", &gate.reads), ("INHIBIT", &gate.inhibits)] {
                if !arcs.is_empty() {
                    let _ = write!(text, " {word} {}", list(arcs));
                }
            }
            let _ = write!(text, " PRIORITY {}", gate.priority);
            match gate.input {
                Some(input) => drop(writeln!(text, " IF x{input}")),
                None => text.push('\n'),
            }
            let _ = writeln!(text, "DO f{i} = f{i} + 1");
        }
        text + "END\n"
    }

    /// The state equation: the marking at the start, and the firings times what each brings.
    fn after(&self, firings: &[i64]) -> Vec<i64> {
        let mut marking = self.start.clone();
        for (gate, times) in self.gates.iter().zip(firings) {
            gate.puts.iter().for_each(|(place, weight)| marking[*place] += weight * times);
            gate.takes.iter().for_each(|(place, weight)| marking[*place] -= weight * times);
        }
        marking
    }

    /// One scan from the definition: gates by priority, then in order; what was there at the start and is not taken.
    fn step(&self, start: &[i64], inputs: &[bool; INPUTS]) -> Vec<i64> {
        let mut order: Vec<usize> = (0..self.gates.len()).collect();
        order.sort_by_key(|i| -self.gates[*i].priority);
        let (mut taken, mut room, mut after) = (vec![0; start.len()], vec![0; start.len()], start.to_vec());
        for gate in order.into_iter().map(|i| &self.gates[i]) {
            let taken_by = |place: usize| gate.takes.iter().find(|(known, _)| *known == place).map_or(0, |(_, w)| *w);
            let fits = |(place, weight): &(usize, i64)| {
                let more = weight - taken_by(*place);
                more <= 0 || start[*place] + room[*place] + more <= self.capacity[*place]
            };
            let enabled = gate.takes.iter().all(|(place, weight)| start[*place] - taken[*place] >= *weight)
                && gate.reads.iter().all(|(place, weight)| start[*place] >= *weight)
                && gate.inhibits.iter().all(|(place, weight)| start[*place] < *weight)
                && gate.input.is_none_or(|input| inputs[input])
                && gate.puts.iter().all(fits);
            if !enabled {
                continue;
            }
            for (place, weight) in &gate.puts {
                room[*place] += (weight - taken_by(*place)).max(0);
                after[*place] += weight;
            }
            for (place, weight) in &gate.takes {
                taken[*place] += weight;
                after[*place] -= weight;
            }
        }
        after
    }
}

/// Random nets with weights, capacities, read and inhibitor arcs, priorities and inputs, against the definition and the
/// state equation.
#[test]
fn random_nets_do_what_the_definition_says() {
    let mut dice = Dice(20_261_129);
    let scans = 60;
    let mut moved = 0;
    for number in 0..250 {
        let net = Plain::random(&mut dice);
        let inputs: Vec<[bool; INPUTS]> = (0..scans).map(|_| std::array::from_fn(|_| dice.roll(2) == 0)).collect();
        let mut stimulus = "k,x0,x1,x2,x3\n".to_owned();
        for (k, row) in inputs.iter().enumerate() {
            let row: Vec<String> = row.iter().map(|x| u8::from(*x).to_string()).collect();
            let _ = writeln!(stimulus, "{k},{}", row.join(","));
        }
        let text = net.text();
        let folder = tempfile::tempdir().unwrap();
        let (path, values) = (folder.path().join("plain.net"), folder.path().join("stimulus.csv"));
        fs::write(&path, &text).unwrap();
        fs::write(&values, stimulus).unwrap();
        let args = ["--steps", &scans.to_string(), "--stimulus", values.to_str().unwrap()];
        let trace = read(&run_in(&path, &args, &[]));
        let mut marking = net.start.clone();
        for (scan, row) in inputs.iter().enumerate() {
            let next = net.step(&marking, row);
            moved += usize::from(next != marking);
            marking = next;
            let firings = (0..net.gates.len()).map(|i| column(&trace, &format!("f{i}"))[scan] as i64);
            assert_eq!(net.after(&firings.collect::<Vec<i64>>()), marking, "net {number}, scan {scan}: B f\n{text}");
            for (place, tokens) in marking.iter().enumerate() {
                let found = column(&trace, &format!("plain.p{place}"))[scan];
                assert!(
                    (found - *tokens as f64).abs() < 0.5,
                    "net {number}, scan {scan}, p{place}: {found}, not {tokens}\n{text}"
                );
            }
        }
    }
    assert!(moved > 500, "only {moved} scans moved a token");
}
