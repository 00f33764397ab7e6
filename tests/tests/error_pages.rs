//! A page for each diagnostic, with an example that fails as it says and one that does not.

use pcl2_tests::fences::{Example, examples, fences, section};
use pcl2_tests::{none, pcl2, root, run};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::process::Output;

/// Instead of examples, on pages whose diagnostic no file can show.
const NO_EXAMPLE: &str = "<!-- no example: ";

/// The codes of the table, with their severity.
fn codes() -> BTreeMap<String, &'static str> {
    let table = fs::read_to_string(root().join("crates/pcl2-lang/src/codes.rs")).expect("the table of codes");
    let mut codes = BTreeMap::new();
    for severity in ["error", "warning"] {
        for (at, start) in table.match_indices(&format!("{severity}(\"P")) {
            let name = table[at + start.len() - 1..].split('"').next().unwrap_or_default();
            let known = codes.insert(name.to_owned(), severity);
            assert!(known.is_none(), "{name} stands in the table twice");
        }
    }
    assert!(codes.len() > 30, "the table has only {codes:?}");
    codes
}

/// The pages, by the code in their name.
fn pages() -> BTreeMap<String, String> {
    let mut pages = BTreeMap::new();
    for entry in fs::read_dir(root().join("docs/errors")).expect("docs/errors") {
        let path = entry.expect("an entry").path();
        let code = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        pages.insert(code, fs::read_to_string(path).expect("a page"));
    }
    pages
}

fn complaints(check: impl Fn(&str, &str) -> Result<(), String>) -> Vec<String> {
    pages().iter().filter_map(|(code, page)| check(code, page).err().map(|why| format!("{code}: {why}"))).collect()
}

#[test]
fn every_code_has_a_page_and_every_page_a_code() {
    let (codes, pages) = (codes(), pages());
    let without: Vec<&String> = codes.keys().filter(|code| !pages.contains_key(*code)).collect();
    let unknown: Vec<&String> = pages.keys().filter(|page| !codes.contains_key(*page)).collect();
    assert!(without.is_empty() && unknown.is_empty(), "without a page: {without:?}, without a code: {unknown:?}");
}

#[test]
fn every_page_has_its_parts() {
    none(&complaints(|code, page| {
        let titled = page.starts_with(&format!("# {code}: "));
        let shown = section(page, "Wrong").is_some() && section(page, "Right").is_some();
        let excused = page.contains(NO_EXAMPLE) && fences(page).is_empty();
        let whole = titled && (shown != excused);
        if whole { Ok(()) } else { Err("expected `# CODE: title`, then Wrong and Right, or no example".to_owned()) }
    }));
    let excused = pages().values().filter(|page| page.contains(NO_EXAMPLE)).count();
    assert!(excused <= 1, "{excused} pages without an example");
}

/// The one example below a heading; `None` on a page without examples.
fn example(page: &str, heading: &str) -> Result<Option<Example>, String> {
    let Some(part) = section(page, heading) else {
        return if page.contains(NO_EXAMPLE) { Ok(None) } else { Err(format!("there is no {heading}")) };
    };
    match examples(part).as_slice() {
        [one] => Ok(Some(one.clone())),
        several => Err(format!("expected one example below {heading}, found {}", several.len())),
    }
}

fn check(example: &Example, format: &str) -> Output {
    let folder = example.folder();
    run(example.command("check", &folder).args(["--format", format]))
}

#[test]
fn wrong_examples_give_exactly_their_diagnostic() {
    let codes = codes();
    none(&complaints(|code, page| {
        let Some(wrong) = example(page, "Wrong")? else {
            return Ok(());
        };
        let output = check(&wrong, "json");
        let found: Vec<Value> = String::from_utf8_lossy(&output.stdout)
            .lines()
            .map(|line| serde_json::from_str(line).map_err(|error| format!("{error}: {line}")))
            .collect::<Result<_, _>>()?;
        let severity = codes.get(code).copied().unwrap_or_default();
        let is_it = |one: &Value| one["code"] == *code && one["severity"] == severity;
        let status = i32::from(severity == "error");
        if matches!(&found[..], [one] if is_it(one)) && output.status.code() == Some(status) {
            Ok(())
        } else {
            Err(format!("expected one {severity} and exit status {status}, found {found:#?}, {}", output.status))
        }
    }));
}

#[test]
fn wrong_examples_show_what_the_command_prints() {
    none(&complaints(|_, page| {
        let Some(wrong) = example(page, "Wrong")? else {
            return Ok(());
        };
        let shown = section(page, "Wrong").map(fences).unwrap_or_default().pop();
        let shown = shown.filter(|fence| fence.language == "text").ok_or("expected a text fence behind the example")?;
        let output = check(&wrong, "text");
        let printed = String::from_utf8_lossy(&output.stderr).trim_end().to_owned();
        let same = shown.text.trim_end() == printed && output.stdout.is_empty();
        if same { Ok(()) } else { Err(format!("expected the page to show:\n{printed}")) }
    }));
}

#[test]
fn right_examples_are_clean() {
    none(&complaints(|_, page| {
        let Some(right) = example(page, "Right")? else {
            return Ok(());
        };
        let output = check(&right, "text");
        let clean = output.status.success() && output.stderr.is_empty() && output.stdout.is_empty();
        if clean {
            Ok(())
        } else {
            Err(format!("expected nothing, found:\n{}", String::from_utf8_lossy(&output.stderr)))
        }
    }));
}

#[test]
fn explain_prints_the_pages() {
    none(&complaints(|code, page| {
        let output = run(pcl2().args(["explain", code]));
        let printed = String::from_utf8_lossy(&output.stdout);
        let same = output.status.success() && printed == page && output.stderr.is_empty();
        if same { Ok(()) } else { Err(format!("expected its page, found:\n{printed}")) }
    }));
}

#[test]
fn explain_takes_any_case_and_refuses_what_is_no_code() {
    let small = run(pcl2().args(["explain", "p0203"]));
    assert_eq!(String::from_utf8_lossy(&small.stdout), pages()["P0203"]);
    let unknown = run(pcl2().args(["explain", "P9999"]));
    assert_eq!(unknown.status.code(), Some(2));
    assert!(unknown.stdout.is_empty());
    assert!(String::from_utf8_lossy(&unknown.stderr).contains("`P9999`"));
}
