//! Scans in which nothing happens: what the code of a net leaves out in them is seen by no later scan.

use pcl2_tests::nets::{column, traced};

const QUIET: [&str; 2] = ["--steps", "6"];

/// A gate that waits for what the first scan told goes in the second, though no input changes.
#[test]
fn what_a_scan_tells_is_seen_in_the_next_one() {
    let active = "int step = told ( int x : )
ACTIVE step OF a, b
STATE a MARKED
STATE b
GATE g : a -> b IF step == 1
END
";
    let trace = traced(&[("told.net", active)], "", &QUIET);
    assert_eq!(column(&trace, "step"), [1., 2., 2., 2., 2., 2.]);
    let outer = "int y = outer ( int x : )\nMODULE M : y = inner ( x : )\nEND\n";
    let inner = "int y = inner ( int x : )\nSTATE a MARKED DRIVES y\nSTATE b\nGATE g : a -> b IF y\nEND\n";
    let trace = traced(&[("outer.net", outer), ("inner.net", inner)], "", &QUIET);
    assert_eq!(column(&trace, "y"), [1., 0., 0., 0., 0., 0.]);
}

/// What the innermost net writes reaches a gate two nets further out.
#[test]
fn what_a_net_inside_writes_wakes_those_around_it() {
    let outer = "int y = outer ( int x : )\nMODULE M : y = middle ( x : )\nEND\n";
    let middle = "int y = middle ( int x : )
LOCAL int seen
MODULE N : seen = inner ( x : )
STATE a MARKED
STATE b DRIVES y
GATE g : a -> b IF seen > 0
END
";
    let inner = "int w = inner ( int x : )\nSTATE s MARKED\nOPERATION p DO w = w + 1\nGATE g : s -> p IF x\nEND\n";
    let files = [("outer.net", outer), ("middle.net", middle), ("inner.net", inner)];
    let trace = traced(&files, "k,x\n0,0\n2,1\n", &["--steps", "8"]);
    assert_eq!(column(&trace, "y"), [0., 0., 0., 0., 1., 1., 1., 1.]);
}

/// What a macro wrote long ago does not come out again when it is emptied.
#[test]
fn what_a_macro_told_is_told_once() {
    let outer = "int w = outer ( int x, int stop, int begin, int set : )
STATE idle MARKED
STATE other
SIGNAL told DO w = 6
MACRO M : w = inner ( x : )
ABORT stop -> idle
GATE go : idle -> M IF begin
GATE on : M -> other
STATE ready MARKED
SIGNAL seven DO w = 7
GATE k : ready -> seven IF set
GATE l : other -> told
END
";
    let inner = "int w = inner ( int x : )
ENTRY come
OPERATION p DO w = 5
EXIT gone
GATE a : come -> p
GATE b : p -> gone IF x
END
";
    let stimulus = "k,x,stop,begin,set\n0,0,0,1,0\n1,0,0,0,0\n5,0,0,0,1\n9,0,1,0,1\n";
    let trace = traced(&[("outer.net", outer), ("inner.net", inner)], stimulus, &["--steps", "13"]);
    assert_eq!(column(&trace, "w"), [0., 0., 5., 5., 5., 5., 7., 7., 7., 7., 7., 7., 7.]);
    assert_eq!(column(&trace, "outer.idle"), [0., 0., 0., 0., 0., 0., 0., 0., 0., 1., 1., 1., 1.]);
}

/// More places of driven outputs than fit into sixteen bits.
#[test]
fn a_box_may_drive_many_outputs() {
    let (boxes, outputs) = (300, 250);
    let names = |prefix: &str, n: usize, before: &str| -> String {
        (0..n).map(|i| format!("{before}{prefix}{i}")).collect::<Vec<_>>().join(", ")
    };
    let mut net = format!("{} = big ( int x : )\n", names("y", outputs, "int "));
    for i in 0..boxes {
        let marked = if i == boxes - 1 { " MARKED" } else { "" };
        net.push_str(&format!("CAPACITY p{i} SIZE 2{marked} DRIVES {}\n", names("y", outputs, "")));
    }
    net.push_str(&format!("GATE g : p{} -> IF x\nEND\n", boxes - 1));
    let trace = traced(&[("big.net", &net)], "k,x\n0,0\n2,1\n", &["--steps", "4"]);
    for output in ["y0", "y123", "y249"] {
        assert_eq!(column(&trace, output), [1., 1., 0., 0.]);
    }
}
