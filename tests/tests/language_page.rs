//! The programs of the language reference and of the pages on nets and on sequences.

use pcl2_tests::fences::{Example, examples};
use pcl2_tests::{none, root, run};
use std::fs;
use std::process::Output;

/// The pages, and how many programs they have at least.
const PAGES: [(&str, usize); 3] = [("docs/language.md", 11), ("docs/nets.md", 4), ("docs/sequences.md", 3)];

/// All programs, each with its page.
fn programs() -> Vec<(&'static str, Example)> {
    let mut programs = Vec::new();
    for (page, least) in PAGES {
        let examples = examples(&fs::read_to_string(root().join(page)).expect(page));
        assert!(examples.len() >= least, "{page}: only {} programs", examples.len());
        programs.extend(examples.into_iter().map(|example| (page, example)));
    }
    programs
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn programs_are_clean() {
    let failed = programs().into_iter().filter_map(|(page, example)| {
        let folder = example.folder();
        let output = run(&mut example.command("check", &folder));
        let clean = output.status.success() && output.stderr.is_empty() && output.stdout.is_empty();
        (!clean).then(|| format!("{page}:{}: expected nothing, found:\n{}", example.line, said(&output)))
    });
    none(&failed.collect::<Vec<_>>());
}

#[test]
fn a_stimulus_gives_the_trace_beside_it() {
    let mut traces = Vec::new();
    for (page, example) in programs() {
        let Some(trace) = example.file("trace.csv") else {
            continue;
        };
        let folder = example.folder();
        let header = trace.lines().next().expect("a header");
        let signals = header.strip_prefix("@k,@t,").expect("the scan, its time, and signals");
        let mut command = example.command("run", &folder);
        let output = run(command.args(["--stimulus", "stimulus.csv", "--trace", "-", "--record", signals]));
        assert!(output.status.success(), "{page}:{}: {}", example.line, said(&output));
        assert_eq!(String::from_utf8_lossy(&output.stdout), trace, "{page}:{}", example.line);
        traces.push(page);
    }
    assert!(PAGES.iter().all(|(page, _)| traces.contains(page)), "traces only on {traces:?}");
}
