//! Sets of parameters while a program runs: all of a scan's sets are taken, or none.

use pcl2_tests::cases::{self, Width};
use pcl2_tests::compilers::{alone, check, folder};
use pcl2_tests::root;
use std::fs;
use std::process::Command;

const GOOD: [&str; 2] = ["--set", "w.value=2@1"];
/// umin of 20 is above umax: refused, and lambda, which comes in the same scan, with it.
const REFUSED: [&str; 4] = ["--set", "u1.umin=20@0.5", "--set", "u1.lambda=5@0.5"];

fn run(engine: &str, sets: &[&str]) -> (String, String, String) {
    let case = cases::find("gpc_closed_loop");
    let work = folder();
    let params = work.path().join("params");
    let mut command = case.command("run");
    command.args(["--engine", engine, "--steps", "12", "--trace", "-"]).args(sets).arg("--params").arg(&params);
    let (trace, said) = case.ran(command).unwrap();
    (trace, said, fs::read_to_string(params).unwrap())
}

#[test]
fn a_refused_set_keeps_every_old_value_and_is_counted() {
    let plain = run("embedded", &GOOD);
    assert_eq!(plain.1, "");
    for engine in ["embedded", "cc"] {
        let (trace, said, params) = run(engine, &[&GOOD[..], &REFUSED[..]].concat());
        assert_eq!(trace, plain.0, "{engine}");
        assert_eq!(params, plain.2, "{engine}");
        let lines: Vec<&str> = said.lines().collect();
        assert_eq!(lines.len(), 2, "{said}");
        assert!(lines[0].starts_with("scan 2: set refused: block 8 `u1` (gpc2): umax must be from 20"), "{said}");
        assert_eq!(lines[1], "refused sets: 1");
    }
}

#[test]
fn sets_that_are_legal_together_are_taken_together() {
    let sets = ["--set", "u1.umin=20@0.5", "--set", "u1.umax=30@0.5"];
    for engine in ["embedded", "cc"] {
        let (trace, said, params) = run(engine, &sets);
        assert_eq!(said, "", "{engine}");
        assert!(params.contains("u1.umin=20.0\nu1.umax=30.0\n"), "{params}");
        let moves = pcl2_tests::table::Table::read(&trace).values("u1");
        assert!(moves[1] < 1.7 && moves[2] == 20.0, "{moves:?}");
    }
}

#[test]
fn sets_from_c_are_taken_or_refused_as_a_whole() {
    let built = alone(&cases::find("gpc_closed_loop"), Width::F64);
    let program = built.path().join("refused");
    built.link(&root().join("tests/c/refused.c"), &["-std=c99", "-O1", "-fsanitize=address,undefined"], &program);
    check(&mut Command::new(&program));
}
