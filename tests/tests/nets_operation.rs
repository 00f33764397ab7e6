//! Nets under an operator: modes, commands, what outputs do meanwhile, permissives that hold a gate back.

use pcl2_tests::compilers::check;
use pcl2_tests::nets::{column, traced};
use pcl2_tests::{pcl2, run};
use std::fs;

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

/// A command that comes in the first scan after a stop is obeyed as any other.
#[test]
fn a_command_right_after_a_stop_is_obeyed() {
    let net = "int w = back ( real v, cell int mode = 0, cell int next = 0, cell int fire = 0 : )
MODE mode, next, fire
STATE s MARKED
GATE g1 : s -> s IF v > 0.
DO w = w + 1
END
";
    let stimulus = "k,v,back.mode,back.fire\n0,2.,automatic,0\n1,2.,stopped,0\n2,2.,manual,g1\n3,2.,manual,g1\n";
    let trace = traced(&[("back.net", net)], stimulus, &["--steps", "5"]);
    assert_eq!(column(&trace, "w"), [1., 0., 2., 3., 3.]);
}

/// A net that is stopped from the start holds what its outputs were before: what START says.
#[test]
fn a_net_that_never_ran_holds_what_it_began_with() {
    let net = "int y = never ( int mode : )\nMODE mode\nSTOP y = HOLD\nSTATE s MARKED DRIVES y\nEND\n";
    let trace = traced(&[("never.net", net)], "k,mode\n0,3\n2,0\n3,3\n", &["--steps", "5"]);
    assert_eq!(column(&trace, "y"), [0., 0., 1., 1., 1.]);
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
