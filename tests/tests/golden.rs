//! The golden cases and the examples: whatever stands in a case's folder is compared.

use pcl2_tests::cases::{self, Case, Width};
use pcl2_tests::table::{Table, compare, same_text};
use pcl2_tests::{compilers, expect, none, run};
use std::fs;

fn complaints(check: impl Fn(&Case) -> Result<(), String>) -> Vec<String> {
    of(&cases::with_examples(), check)
}

fn of(cases: &[Case], check: impl Fn(&Case) -> Result<(), String>) -> Vec<String> {
    assert!(!cases.is_empty(), "there are no cases");
    let failed = |case: &Case| check(case).err().map(|why| format!("{}: {why}", case.name));
    cases.iter().filter_map(failed).collect()
}

fn builds(case: &Case) -> bool {
    !expect::expected(case).iter().any(|found| found.contains(" error "))
}

#[test]
fn every_case_expects_something() {
    let files = ["trace.csv", "diagnostics.snap", "generated.snap", "diagram.snap"];
    none(&of(&cases::all(), |case| {
        let expects = files.iter().any(|file| case.has(file)) || !expect::expected(case).is_empty();
        if expects { Ok(()) } else { Err("nothing is expected".to_owned()) }
    }));
}

#[test]
fn diagnostics_are_those_at_the_ends_of_lines() {
    none(&complaints(|case| {
        let expected = expect::expected(case);
        let failed = expected.iter().any(|found| found.contains(" error "));
        same_findings(case, &[], &expected, failed)?;
        let strict: Vec<String> = expected.iter().map(|found| found.replace(" warning ", " error ")).collect();
        same_findings(case, &["--strict"], &strict, !strict.is_empty())
    }));
}

fn same_findings(case: &Case, more: &[&str], expected: &[String], failed: bool) -> Result<(), String> {
    let (found, status) = expect::reported(case, more)?;
    if found != expected {
        return Err(format!("{more:?}: expected {expected:#?}, found {found:#?}"));
    }
    let wanted = Some(i32::from(failed));
    if status == wanted { Ok(()) } else { Err(format!("{more:?}: expected exit status {wanted:?}, found {status:?}")) }
}

#[test]
fn engines_agree_with_each_other_and_with_the_reference() {
    none(&complaints(|case| engines(case, Width::F64)));
}

#[test]
fn engines_agree_in_float() {
    none(&complaints(|case| engines(case, Width::F32)));
}

fn engines(case: &Case, width: Width) -> Result<(), String> {
    if !builds(case) {
        return Ok(());
    }
    let (compiled, said) = case.ran(case.run("cc", width))?;
    if !case.has_own_c() {
        let embedded = case.ran(case.run("embedded", width))?;
        same_text(&format!("{}: embedded and cc", width.name()), &embedded.0, &compiled)?;
        same_text(&format!("{}: faults, embedded and cc", width.name()), &embedded.1, &said)?;
    }
    let tolerance = case.tolerance(width)?;
    match (fs::read_to_string(case.folder.join("trace.csv")), tolerance) {
        (Ok(reference), Some(tolerance)) => compare(&Table::read(&compiled), &Table::read(&reference), tolerance),
        (Ok(_), None) | (Err(_), _) => Ok(()),
    }
}

/// The compiled engine under the address and undefined-behaviour sanitizers.
#[test]
fn traces_are_the_same_under_the_sanitizers() {
    none(&complaints(|case| {
        if !builds(case) {
            return Ok(());
        }
        let width = if case.name.len() % 2 == 0 { Width::F64 } else { Width::F32 };
        let mut watched = case.run("cc", width);
        watched.env("CC", "gcc -fsanitize=address,undefined -fno-sanitize-recover=all");
        same_text("sanitizers", &case.trace(case.run("cc", width))?, &case.trace(watched)?)
    }));
}

/// Rendered diagnostics, generated C, the block diagram.
const SNAPSHOTS: [&str; 3] = ["diagnostics", "generated", "diagram"];

#[test]
fn snapshots_hold() {
    none(&complaints(|case| {
        for name in SNAPSHOTS {
            let listed = case.config.snapshots.iter().any(|known| known == name);
            if listed || case.has(&format!("{name}.snap")) {
                snapshot(case, name);
            }
        }
        let unknown = case.config.snapshots.iter().find(|name| !SNAPSHOTS.contains(&name.as_str()));
        unknown.map_or(Ok(()), |name| Err(format!("there is no snapshot of `{name}`")))
    }));
}

fn snapshot(case: &Case, name: &str) {
    let text = match name {
        "generated" => generated(case),
        "diagram" => diagram(case),
        _ => rendered(case),
    };
    let mut settings = insta::Settings::new();
    settings.set_snapshot_path(&case.folder);
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(name, text));
}

fn rendered(case: &Case) -> String {
    String::from_utf8_lossy(&run(&mut case.command("check")).stderr).into_owned()
}

fn diagram(case: &Case) -> String {
    String::from_utf8_lossy(&run(case.command("graph").args(["-o", "-"])).stdout).into_owned()
}

/// NAME.h and NAME.c.
fn generated(case: &Case) -> String {
    let built = compilers::alone(case, case.width());
    let mut names: Vec<String> = fs::read_dir(built.path())
        .expect("the build")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .filter(|name| name.ends_with(".h") || name.ends_with(".c"))
        .filter(|name| !name.ends_with("_map.c") && !name.ends_with("_example.c"))
        .collect();
    names.sort_by_key(|name| name.ends_with(".c"));
    let read = |name: &String| fs::read_to_string(built.path().join(name)).expect("a file");
    names.iter().map(|name| format!("// {name}\n{}", read(name))).collect::<Vec<_>>().join("\n")
}
