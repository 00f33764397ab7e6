//! The programs of the language reference.

use pcl2_tests::fences::{Example, examples};
use pcl2_tests::{none, root, run};
use std::fs;
use std::process::Output;

fn page() -> Vec<Example> {
    let page = fs::read_to_string(root().join("docs/language.md")).expect("docs/language.md");
    let examples = examples(&page);
    assert!(examples.len() > 10, "only {} programs", examples.len());
    examples
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn programs_are_clean() {
    let failed = page().into_iter().filter_map(|example| {
        let folder = example.folder();
        let output = run(&mut example.command("check", &folder));
        let clean = output.status.success() && output.stderr.is_empty() && output.stdout.is_empty();
        (!clean).then(|| format!("line {}: expected nothing, found:\n{}", example.line, said(&output)))
    });
    none(&failed.collect::<Vec<_>>());
}

#[test]
fn a_stimulus_gives_the_trace_beside_it() {
    let mut traces = 0;
    for example in page() {
        let Some(trace) = example.file("trace.csv") else {
            continue;
        };
        let folder = example.folder();
        let mut command = example.command("run", &folder);
        let output = run(command.args(["--stimulus", "stimulus.csv", "--trace", "-"]));
        assert!(output.status.success(), "line {}: {}", example.line, said(&output));
        assert_eq!(String::from_utf8_lossy(&output.stdout), trace, "line {}", example.line);
        traces += 1;
    }
    assert!(traces > 0, "no trace on the page");
}
