//! Names with an index: what FOR makes is what a net has in which each line is written out.

use pcl2_tests::compilers::folder;
use pcl2_tests::nets::{Trace, column, traced};
use pcl2_tests::{pcl2, run};
use std::fs;

/// Three lamps, each with a module, a local of its own for what goes in and what comes out, a count and a time.
const LAMPS: &str = "! Three lamps.
int lit,   ! how many are on
int any,

real second = lamps ( ivec[3] call : )
ACTIVE at[2], second OF idle[1], idle[2]
FOR i = 1 TO 3
LOCAL int want[i], int on[i] = 1, int n[i] = 0, int at[i], real t[i]
START on[i] = 0, t[i] = 0.5
STATE idle[i] MARKED
TIME busy[i] t[i] DRIVES want[i], any
MODULE L[i] : on[i] = lamp ( want[i] : )
GATE go[i]   : idle[i] -> busy[i]  IF call[i] AND NOT on[i] AND L[i].off[1]
DO n[i] = n[i] + 1
DO t[i] = t[i] + 0.5
GATE back[i] : busy[i] -> idle[i]
NEXT
OPERATION sum MARKED DO lit = on[1] + on[2] + on[3]
STATE next
GATE s : sum -> next
GATE e : next -> sum
END
";

const LAMP: &str = "int on = lamp ( int wanted : )
STATE off[1] MARKED
STATE lit DRIVES on
GATE up   : off[1] -> lit  IF wanted
GATE down : lit -> off[1]  IF NOT wanted
END
";

const PROGRAM: &str = "CONTROL
1 call = setivec ( 3 : 1, 0, 1 )
2 N = lamps ( call : )
busy = not ( N.idle[3] : )
sum = N.idle[1] + N.busy[1]*N.busy[3]
END
";

/// The same without FOR and without indexes, but for the input's.
fn written_out() -> String {
    let (before, rest) = LAMPS.split_once("FOR i = 1 TO 3\n").unwrap();
    let (lines, after) = rest.split_once("NEXT\n").unwrap();
    let plain = |text: &str, index: &str| {
        let kept = text.replace(&format!("call[{index}]"), "CALL").replace("ivec[3]", "VECTOR");
        let plain = kept.replace("off[1]", "off").replace(&format!("[{index}]"), &format!("_{index}"));
        plain.replace("CALL", &format!("call[{index}]")).replace("VECTOR", "ivec[3]")
    };
    let all = |text: &str| ["1", "2", "3"].iter().fold(text.to_owned(), |text, index| plain(&text, index));
    let repeated: String =
        ["1", "2", "3"].map(|index| plain(&lines.replace("[i]", &format!("[{index}]")), index)).concat();
    let head = before.replace("   ! how many are on\n", " ").replace(",\n\n", ", ");
    format!("{}{repeated}{}", all(&head), all(after))
}

fn played(net: &str, lamp: &str, program: &str) -> Trace {
    let args = ["--period", "0.5", "--steps", "16"];
    traced(&[("program.cfg", program), ("lamps.net", net), ("lamp.net", lamp)], "", &args)
}

/// Locals, what a part gives them, what boxes drive and what statements write can have indexes, and a head can run over
/// lines. In a program a box with an index stands wherever a variable stands.
#[test]
fn repeated_lines_do_what_written_out_ones_do() {
    let out = written_out();
    assert_eq!(out.matches('[').count(), out.matches("call[").count() + 1, "{out}");
    let program = PROGRAM.replace("idle[3]", "idle_3").replace("[1]", "_1").replace("[3]", "_3");
    let plain = played(&out, &LAMP.replace("[1]", ""), &program);
    let repeated = played(LAMPS, LAMP, PROGRAM);
    let index = |name: &str| match name.strip_prefix("N.") {
        Some(name) => {
            let indexed =
                ["1", "2", "3"].iter().fold(name.to_owned(), |n, i| n.replace(&format!("_{i}"), &format!("[{i}]")));
            format!("N.{}", if indexed.ends_with(".off") { indexed + "[1]" } else { indexed })
        }
        None => name.to_owned(),
    };
    let plain: Trace = plain.into_iter().map(|(name, values)| (index(&name), values)).collect();
    assert_eq!(repeated, plain);
    // By hand: a token goes in scan 0, t is 1 s then: it may go in scan 2, and comes back when the lamp is off.
    let [idle, busy] = ["N.idle[1]", "N.busy[3]"].map(|name| column(&repeated, name).to_vec());
    assert_eq!(idle[..7], [0., 0., 1., 1., 0., 0., 0.]);
    assert_eq!(busy[..7], [1., 1., 0., 0., 1., 1., 1.]);
    assert_eq!(column(&repeated, "N.idle[2]"), [1.; 16]);
    assert_eq!(column(&repeated, "busy")[..7], [1., 1., 0., 0., 1., 1., 1.]);
    assert_eq!(column(&repeated, "sum")[..4], [1., 1., 1., 1.]);
    assert!(column(&repeated, "N").contains(&2.), "two lamps are on");
}

/// A flat net keeps the indexes, and its lines stay in their layout.
#[test]
fn a_flat_net_of_repeated_lines_is_a_net() {
    let work = folder();
    fs::write(work.path().join("lamps.net"), LAMPS).unwrap();
    fs::write(work.path().join("lamp.net"), LAMP).unwrap();
    let done = |args: &[&str]| {
        let output = run(pcl2().args(args).current_dir(work.path()));
        assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    };
    done(&["fmt", "lamps.net"]);
    let laid_out = fs::read_to_string(work.path().join("lamps.net")).unwrap();
    assert!(laid_out.contains("\nint any,\n\nreal second = lamps ( ivec[3] call : )\n"), "{laid_out}");
    done(&["check", "lamps.net", "--period", "1"]);
    done(&["net", "flatten", "lamps.net", "-o", "flat.net"]);
    let flat = fs::read_to_string(work.path().join("flat.net")).unwrap();
    assert!(flat.contains("int lit, int any, real second = flat ( ivec[3] call : )\n"), "{flat}");
    assert!(flat.contains("LOCAL int want[3] = 0\n") && flat.contains("STATE L_3_off[1] MARKED\n"), "{flat}");
    done(&["fmt", "--check", "flat.net"]);
}

/// Pictures and reports show which element a repeated line means, not its counter.
#[test]
fn pictures_and_reports_show_numbers_for_counters() {
    let work = folder();
    fs::write(work.path().join("lamps.net"), LAMPS).unwrap();
    fs::write(work.path().join("lamp.net"), LAMP).unwrap();
    for args in [&["graph", "lamps.net", "-o", "lamps.svg"][..], &["net", "report", "lamps.net", "-o", "."]] {
        let output = run(pcl2().args(args).current_dir(work.path()));
        assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    }
    let statements = ["call[2] AND NOT on[2] AND L[2].off[1]", "n[3] = n[3] + 1"];
    for (file, more) in [("lamps.svg", "TIME t[1]"), ("lamps.md", "on[2] = lamp ( want[2] : )")] {
        let text = fs::read_to_string(work.path().join(file)).unwrap();
        assert!(!text.contains("[i]"), "{file}");
        assert!(statements.iter().chain([&more]).all(|shown| text.contains(shown)), "{file}: {text}");
    }
}
