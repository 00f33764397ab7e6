//! The process image bound to physical points: `[io]`, latch, deliver, and a board port.

use pcl2_tests::compilers::{self, Built, STRICT};
use pcl2_tests::{pcl2, root, run};
use std::process::Command;

/// Scaling by hand: h = (12 - 4)/16 * 2 = 1, q = 2 (1 - h), FV104 = 4 + t/100 * 16; a bad t fails safe to 25: 8 mA.
const EXPECTED: &str = "\
good: bad 0, troubled 0, h 1, FV104 12, FQ1 0, faults 0
level up: bad 0, troubled 0, h 2, FV104 12, FQ1 -2, faults 0
temperature broken: bad 1, troubled 0, h 2, FV104 8, FQ1 -2, faults 2
level broken too: bad 2, troubled 0, h 2, FV104 8, FQ1 -2, faults 4
mended: bad 0, troubled 0, h 2, FV104 12, FQ1 -2, faults 4
valve broken: bad 0, troubled 1, h 2, FV104 12, FQ1 -2, faults 4
";

#[test]
fn bad_samples_are_held_and_bad_outputs_fail_safe() {
    let built = Built::empty();
    compilers::check(pcl2().arg("build").arg(root().join("tests/projects/points")).arg("-o").arg(built.path()));
    let port = root().join("runtime-c/ports/memory");
    let program = built.path().join("points");
    let mut flags: Vec<String> = STRICT.map(str::to_owned).to_vec();
    flags.push(format!("-I{}", port.display()));
    flags.push(port.join("port.c").display().to_string());
    let flags: Vec<&str> = flags.iter().map(String::as_str).collect();
    built.link(&root().join("tests/c/points.c"), &flags, &program);
    assert_eq!(compilers::check(&mut Command::new(program)), EXPECTED);
}

/// What a line of `[io]` may not say.
#[test]
fn wrong_bindings_are_named() {
    let wrong = [
        ("hh = \"LT1\"", "found `hh`"),
        ("h = { raw = [4, 20], range = [0, 2] }", "expected the physical point of `h`"),
        ("h = { point = \"LT1\", raw = [4, 20] }", "raw and range together"),
        ("h = { point = \"LT1\", raw = [4, 4], range = [0, 2] }", "two different ends"),
        ("h = { point = \"LT1\", fail = 1 }", "expected `fail` for an output"),
        ("q = { point = \"FV1\", bad = \"hold\" }", "expected `bad` for an input"),
        ("h = { point = \"LT1\", bda = \"hold\" }", "did you mean `bad`?"),
        ("h = \"LT1\"\n[build]\ntunable = [\"w\", \"zz*\"]", "found `zz*`, which no block has"),
    ];
    let source = root().join("tests/projects/points/loop.cfg");
    for (line, expected) in wrong {
        let folder = compilers::folder();
        let toml = format!("[controller]\nname = \"loop\"\nsource = \"loop.cfg\"\nperiod = 0.5\n[io]\n{line}\n");
        std::fs::write(folder.path().join("pcl2.toml"), toml).expect("a project file");
        std::fs::copy(&source, folder.path().join("loop.cfg")).expect("a source");
        let output = run(pcl2().arg("check").arg(folder.path()));
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(1), "{line}: {said}");
        assert!(said.contains("P0503") && said.contains(expected), "{line}: {said}");
    }
}

/// A run has no board: words are values behind the latch, and every engine gives the same.
#[test]
fn every_engine_runs_a_bound_program() {
    let trace = |runner: [&str; 2]| {
        let project = root().join("tests/projects/points");
        let bad = ["--set", "ain(0,1,1)=50@0.5", "--set", "ain(0,1,1)=nan@1"];
        compilers::check(pcl2().arg("run").arg(project).args(["--steps", "4", "--trace", "-"]).args(bad).args(runner))
    };
    let embedded = trace(["--engine", "embedded"]);
    assert!(embedded.contains(",nan,25.0\n"), "the fail-safe value stands in for a bad one:\n{embedded}");
    assert_eq!(embedded, trace(["--engine", "cc"]));
    assert_eq!(embedded, trace(["--target", "cortex-m4"]));
}
