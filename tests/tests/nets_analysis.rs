//! `pcl2 net analyze` on nets with published numbers, and on files that are no nets.

use pcl2_net::pnml;
use pcl2_net::structure::fire::{self, OnBlocked, Rule};
use pcl2_net::structure::names::Names;
use pcl2_tests::{fences, pcl2, root, run};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::{Duration, Instant};

const KEYS: [&str; 18] = [
    "places",
    "transitions",
    "semantics",
    "complete",
    "markings",
    "edges",
    "dead_markings",
    "bound",
    "bounded",
    "unbounded_places",
    "deadlock",
    "deadlock_path",
    "dead_transitions",
    "live",
    "reversible",
    "p_invariants",
    "t_invariants",
    "siphons_that_can_empty",
];

fn net_file(name: &str) -> PathBuf {
    root().join("tests/nets").join(name)
}

fn analyzed(name: &str, args: &[&str]) -> Value {
    analyzed_file(&net_file(name), args)
}

fn analyzed_file(path: &Path, args: &[&str]) -> Value {
    let output = run(pcl2().args(["net", "analyze"]).arg(path).arg("--json").args(args));
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let found: BTreeMap<String, Value> = serde_json::from_slice(&output.stdout).unwrap();
    let mut keys = KEYS;
    keys.sort_unstable();
    assert!(found.keys().eq(keys), "{:?}", found.keys());
    found.into_iter().collect()
}

/// A PNML text; places with tokens, transitions with the places that they take from and put into.
fn net_text(places: &[(&str, u64)], transitions: &[(&str, &[&str], &[&str])]) -> String {
    let mut net = String::new();
    for (name, tokens) in places {
        let marking = format!("<initialMarking><text>{tokens}</text></initialMarking>");
        let _ = write!(net, "<place id=\"{name}\">{marking}</place>");
    }
    for (name, takes, puts) in transitions {
        let _ = write!(net, "<transition id=\"{name}\"/>");
        for (source, target) in takes.iter().map(|p| (p, name)).chain(puts.iter().map(|p| (name, p))) {
            let _ = write!(net, "<arc source=\"{source}\" target=\"{target}\"/>");
        }
    }
    let kind = "http://www.pnml.org/version-2009/grammar/ptnet";
    format!("<pnml><net id=\"net\" type=\"{kind}\"><page id=\"page\">{net}</page></net></pnml>")
}

fn written(text: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("net.pnml");
    fs::write(&file, text).unwrap();
    (folder, file)
}

/// How many scans lead to a marking in which nothing can fire.
fn replayed(file: &Path, path: &Value, rule: Rule) -> usize {
    let net = pnml::read(&fs::read_to_string(file).unwrap()).unwrap();
    let names = Names::new(&net);
    let scan =
        |scan: &Value| fire::by_names(&names, scan.as_array().unwrap().iter().map(|name| name.as_str().unwrap()));
    let scans: Vec<fire::Scan> = path.as_array().unwrap().iter().map(|fired| scan(fired).unwrap()).collect();
    let run = fire::fire(&net, &fire::initial(&net), &scans, rule, OnBlocked::Refuse).unwrap();
    assert!(run.blocked.is_empty(), "{}", run.blocked[0].message(&net));
    let last = run.markings.last().unwrap();
    for transition in &net.transitions {
        let alone = fire::by_names(&names, [transition.name.as_str()]).unwrap();
        let more = fire::fire(&net, last, &[alone], rule, OnBlocked::Refuse).unwrap();
        assert!(!more.blocked.is_empty(), "{} can fire", transition.name);
    }
    scans.len()
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
        assert_eq!(found["live"], dead == 0, "{name}");
        assert_eq!(found["reversible"], dead == 0, "{name}");
    }
}

/// Each of ten philosophers takes the fork on the same side: no shorter way ends at a dead marking, for that needs all
/// forks taken and nobody with two.
#[test]
fn the_shortest_way_to_a_deadlock_replays() {
    let name = "Philosophers-PT-000010.pnml";
    let found = analyzed(name, &[]);
    assert_eq!(replayed(&net_file(name), &found["deadlock_path"], Rule::Interleaving), 10);
    // Not all markings: a way that is found by stubborn sets.
    let found = analyzed(name, &["--limit", "2000"]);
    assert_eq!((&found["complete"], &found["deadlock"], &found["live"]), (&false.into(), &true.into(), &false.into()));
    assert!(replayed(&net_file(name), &found["deadlock_path"], Rule::Interleaving) >= 10);
}

/// In one scan all ten take the left fork, as that stands first: the net is stuck after one.
#[test]
fn a_scan_fires_all_that_can() {
    let name = "Philosophers-PT-000010.pnml";
    let found = analyzed(name, &["--semantics", "step"]);
    assert_eq!(found["semantics"], "step");
    assert_eq!((&found["markings"], &found["edges"]), (&2.into(), &1.into()));
    assert_eq!(replayed(&net_file(name), &found["deadlock_path"], Rule::Step), 1);
}

#[test]
fn a_dead_first_marking_has_an_empty_path() {
    let (_folder, file) = written(&net_text(&[("p", 0), ("q", 1)], &[("t", &["p"], &["q"])]));
    for semantics in ["step", "interleaving"] {
        let found = analyzed_file(&file, &["--semantics", semantics]);
        assert_eq!(found["deadlock_path"], Value::Array(Vec::new()));
        assert_eq!((&found["live"], &found["reversible"]), (&false.into(), &true.into()));
        assert_eq!(found["dead_transitions"], serde_json::json!(["t"]));
    }
}

/// No marking is dead, but behind `leave` two transitions go round for good: live are those alone.
#[test]
fn a_net_may_be_stuck_in_part_without_a_dead_marking() {
    let text = net_text(
        &[("a", 1), ("b", 0), ("c", 0), ("d", 0)],
        &[
            ("go", &["a"], &["b"]),
            ("back", &["b"], &["a"]),
            ("leave", &["b"], &["c"]),
            ("on", &["c"], &["d"]),
            ("off", &["d"], &["c"]),
        ],
    );
    let (_folder, file) = written(&text);
    let found = analyzed_file(&file, &[]);
    assert_eq!(
        (&found["deadlock"], &found["live"], &found["reversible"]),
        (&false.into(), &false.into(), &false.into())
    );
    let output = run(pcl2().args(["net", "analyze"]).arg(&file));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(text.contains("transitions that are not live: go, back, leave\n"), "{text}");
}

/// The paper's measuring tank: scan by scan it comes back to its start; one transition at a time its modules get out of
/// step, and some never move again although no marking is dead.
#[test]
fn the_measuring_tank_is_live_scan_by_scan_alone() {
    let found = analyzed("tank.net", &[]);
    assert_eq!(found["semantics"], "step");
    assert_eq!((&found["deadlock"], &found["live"], &found["reversible"]), (&false.into(), &true.into(), &true.into()));
    let found = analyzed("tank.net", &["--semantics", "interleaving"]);
    assert_eq!(
        (&found["deadlock"], &found["live"], &found["reversible"]),
        (&false.into(), &false.into(), &false.into())
    );
}

/// A pump fills a tank for ever; the basin behind it too. Whatever the limit, that is known, and the run ends.
#[test]
fn unbounded_places_are_named() {
    let text = net_text(
        &[("on", 1), ("tank", 0), ("basin", 0)],
        &[("pump", &["on"], &["on", "tank"]), ("drain", &["tank"], &["basin"])],
    );
    let (_folder, file) = written(&text);
    for limit in [&["--limit", "100"][..], &[]] {
        let found = analyzed_file(&file, limit);
        assert_eq!((&found["bounded"], &found["complete"]), (&false.into(), &false.into()));
        assert_eq!(found["unbounded_places"], serde_json::json!(["tank", "basin"]));
        assert_eq!((&found["deadlock"], &found["dead_transitions"]), (&false.into(), &serde_json::json!([])));
    }
}

/// The page on nets shows what the command prints.
#[test]
fn the_page_on_nets_shows_what_is_printed() {
    let page = fs::read_to_string(root().join("docs/nets.md")).unwrap();
    let section = fences::section(&page, "Analysis").unwrap();
    let fences = fences::fences(section);
    let net = fences.iter().find(|fence| fence.language == "xml").unwrap();
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("batch.pnml"), &net.text).unwrap();
    let mut shown = 0;
    for fence in fences.iter().filter(|fence| fence.language == "console") {
        let (command, expected) = fence.text.split_once('\n').unwrap();
        let args = command.strip_prefix("$ pcl2 ").unwrap().split(' ');
        let output = run(pcl2().args(args).current_dir(folder.path()));
        assert_eq!(without_limit(&said(&output)), without_limit(expected), "line {}", fence.line);
        shown += 1;
    }
    assert!(shown >= 2);
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// The limit depends on the memory that is free.
fn without_limit(text: &str) -> String {
    let cut = |line: &str| line.split("; limit ").next().unwrap_or(line).to_owned();
    text.lines().map(cut).collect::<Vec<_>>().join("\n")
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
    for key in ["dead_transitions", "live", "reversible"] {
        assert_eq!(found[key], Value::Null, "{key}");
    }
    // The structure alone knows these.
    assert_eq!((&found["bounded"], &found["deadlock"]), (&true.into(), &false.into()));
    assert!(found["markings"].as_u64().unwrap() <= 1000);
}

/// Runs the command in 512 MiB and 10 s of processor time.
fn bounded(file: &Path, args: &[&str]) -> Output {
    let script = "ulimit -v 524288; ulimit -t 10; exec \"$0\" net analyze \"$@\"";
    let mut command = Command::new("sh");
    run(command.args(["-c", script]).arg(pcl2().get_program()).arg(file).args(args).env("NO_COLOR", "1"))
}

/// Files that are no place/transition nets are refused with a place, soon and in little memory.
#[test]
fn bad_files_are_refused() {
    let whole = fs::read_to_string(net_file("FMS-PT-00002.pnml")).unwrap();
    let bomb = "<?xml version=\"1.0\"?><!DOCTYPE p [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;&a;&a;\">]><pnml>&b;</pnml>";
    let kind = "type=\"http://www.pnml.org/version-2009/grammar/ptnet\"";
    let cases = [
        ("cut short", whole[..whole.len() / 2].to_owned()),
        ("entities", bomb.to_owned()),
        ("another class", whole.replace("grammar/ptnet", "grammar/symmetricnet")),
        ("empty", String::new()),
        ("no XML", "no xml".to_owned()),
        ("no net", "<pnml xmlns=\"http://www.pnml.org/version-2009/grammar/pnml\"/>".to_owned()),
        ("too long", whole.replace("<name>", &" ".repeat(4 << 20))),
        ("deep", format!("<pnml><net {kind}>{}", "<page>".repeat(200_000))),
        ("many places", format!("<pnml><net {kind}>{}", "<place id=\"p\"/>".repeat(400_000))),
        ("too many places", format!("<pnml><net {kind}>{}", "<place id=\"p\"/>".repeat(1_600_000))),
        ("a huge number", whole.replacen("<text>2</text>", &format!("<text>{}</text>", "9".repeat(1_000_000)), 1)),
        ("many attributes", format!("<pnml {}/>", "a='1' ".repeat(1_000_000))),
    ];
    for (what, text) in cases {
        let (_folder, file) = written(&text);
        let clock = Instant::now();
        let output = bounded(&file, &[]);
        let shown = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{what}: {shown}");
        assert!(shown.contains("expected"), "{what}: {shown}");
        assert!(clock.elapsed() < Duration::from_secs(10), "{what}");
    }
}

/// A net is no bad input because it is large: what its structure says may be not known, the command ends.
#[test]
fn large_nets_stay_within_bounds() {
    let names: Vec<String> = (0..20_000).map(|i| format!("n{i}")).collect();
    let places: Vec<(&str, u64)> = names.iter().map(|name| (name.as_str(), u64::from(name == "n0"))).collect();
    let steps: Vec<String> = (0..20_000).map(|i| format!("t{i}")).collect();
    let ends: Vec<[&str; 2]> = names.windows(2).map(|pair| [pair[0].as_str(), pair[1].as_str()]).collect();
    let transitions: Vec<(&str, &[&str], &[&str])> = steps
        .iter()
        .zip(&ends)
        .map(|(step, [from, to])| (step.as_str(), std::slice::from_ref(from), std::slice::from_ref(to)))
        .collect();
    let (_folder, file) = written(&net_text(&places, &transitions));
    let output = bounded(&file, &["--json", "--limit", "100"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&found["complete"], &found["markings"]), (&false.into(), &100.into()));
}

/// Parts come when they like and wait on a belt; what is done goes into a bin. Whether enough wait is asked by READ and
/// INHIBIT, which no run that goes on without end may depend on.
#[test]
fn a_net_that_fills_scan_by_scan_is_told() {
    let net = "int q, int full = belt ( int come, int go : )
GENERATE part SIZE 1 WHEN come
CAPACITY belt
CAPACITY bin
STATE idle MARKED
TIME busy 1. DRIVES q
STATE few MARKED
STATE lots DRIVES full
GATE in   : part -> belt
GATE take : belt, idle -> busy  IF go
GATE done : busy -> idle, bin
GATE more : few -> lots         READ 3*belt
GATE less : lots -> few         INHIBIT 3*belt
END
";
    let work = tempfile::tempdir().unwrap();
    let file = work.path().join("belt.net");
    fs::write(&file, net).unwrap();
    let found = analyzed_file(&file, &["--limit", "2000"]);
    assert_eq!((&found["bounded"], &found["complete"]), (&Value::Bool(false), &Value::Bool(false)));
    assert_eq!(found["unbounded_places"], serde_json::json!(["belt", "bin"]));
    // A bin that is asked for room is never said to be unbounded: few parts may be all that ever come into it.
    fs::write(
        &file,
        net.replace("done : busy", "done : busy, few").replace("idle, bin\n", "idle, bin, few INHIBIT 9*bin\n"),
    )
    .unwrap();
    assert_eq!(analyzed_file(&file, &["--limit", "2000"])["unbounded_places"], Value::Null);
    let text = run(pcl2().args(["net", "analyze", "--limit", "2000"]).arg(&file));
    assert!(String::from_utf8_lossy(&text.stdout).contains("\n  unbounded places: belt, and perhaps others\n"));
}
