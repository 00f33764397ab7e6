//! `pcl2 net analyze` on nets with published numbers, and on files that are no nets.

use pcl2_tests::{pcl2, root, run};
use serde_json::Value;
use std::fs;
use std::time::{Duration, Instant};

fn analyzed(name: &str, args: &[&str]) -> Value {
    let path = root().join("tests/nets").join(name);
    let output = run(pcl2().args(["net", "analyze"]).arg(path).arg("--json").args(args));
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Markings, edges and dead markings as the Model Checking Contest publishes them.
#[test]
fn published_numbers_of_markings_and_edges() {
    let published = [
        ("Philosophers-PT-000010.pnml", 59_049, 459_270, 2),
        ("SwimmingPool-PT-01.pnml", 89_621, 450_003, 0),
        ("FMS-PT-00002.pnml", 3444, 16_311, 0),
    ];
    for (name, markings, edges, dead) in published {
        let found = analyzed(name, &[]);
        assert_eq!(found["markings"], markings, "{name}");
        assert_eq!(found["edges"], edges, "{name}");
        assert_eq!(found["dead_markings"], dead, "{name}");
        assert_eq!(found["deadlock"], dead > 0, "{name}");
        assert_eq!(found["complete"], true, "{name}");
    }
}

/// Philosophers: each of them goes round, each fork is somewhere; the net's only deadlocks are an empty siphon's.
#[test]
fn structural_answers_agree_with_the_markings() {
    let found = analyzed("Philosophers-PT-000010.pnml", &[]);
    assert_eq!(found["p_invariants"].as_array().unwrap().len(), 20);
    assert!(!found["siphons_that_can_empty"].as_array().unwrap().is_empty());
    assert_eq!(found["dead_transitions"], Value::Array(Vec::new()));
    let found = analyzed("SwimmingPool-PT-01.pnml", &[]);
    assert_eq!(found["bound"], 20);
}

/// A search that is stopped says so, and what it does not know is null.
#[test]
fn a_limit_leaves_what_is_not_known_open() {
    let found = analyzed("SwimmingPool-PT-01.pnml", &["--limit", "1000"]);
    assert_eq!(found["complete"], false);
    for key in ["bounded", "deadlock", "dead_transitions"] {
        assert_eq!(found[key], Value::Null, "{key}");
    }
    assert!(found["markings"].as_u64().unwrap() <= 1000);
}

/// Files that are no place/transition nets are refused with a place, soon.
#[test]
fn bad_files_are_refused() {
    let whole = fs::read_to_string(root().join("tests/nets/FMS-PT-00002.pnml")).unwrap();
    let bomb = "<?xml version=\"1.0\"?><!DOCTYPE p [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;&a;&a;\">]><pnml>&b;</pnml>";
    let other = whole.replace("grammar/ptnet", "grammar/symmetricnet");
    let cases = [
        &whole[..whole.len() / 2],
        bomb,
        &other,
        "",
        "no xml",
        "<pnml xmlns=\"http://www.pnml.org/version-2009/grammar/pnml\"/>",
    ];
    for (i, text) in cases.into_iter().enumerate() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("bad.pnml");
        fs::write(&file, text).unwrap();
        let clock = Instant::now();
        let output = run(pcl2().args(["net", "analyze"]).arg(&file));
        let shown = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "case {i}: {shown}");
        assert!(shown.contains("expected"), "case {i}: {shown}");
        assert!(clock.elapsed() < Duration::from_secs(10), "case {i}");
    }
}
