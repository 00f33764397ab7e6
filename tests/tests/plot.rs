//! `pcl2 run --plot`: what is drawn of a run, and that it stays small.

use pcl2_tests::compilers::{check, folder};
use pcl2_tests::{pcl2, root, run};
use roxmltree::{Document, Node};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

const MIX: &str = "\
CONTROL
1 x = ain ( : 0, 1, 1 )
2 big = sumII ( 1, x, x, 2 : 500., 500. )
3 on = msi ( : 0 )
4 off = msi ( : 1 )
5 n = msi ( : 5 )
END
";

fn project(name: &str, text: &str, stimulus: &str) -> TempDir {
    let folder = folder();
    fs::write(folder.path().join(name), text).unwrap();
    fs::write(folder.path().join("s.csv"), stimulus).unwrap();
    folder
}

/// Draws a run on standard output.
fn plot(folder: &Path, args: &[&str]) -> String {
    check(pcl2().current_dir(folder).args(["run", "p.cfg", "--plot", "-"]).args(args))
}

fn texts(svg: &str, class: &str) -> Vec<String> {
    let document = Document::parse(svg).expect("well-formed XML");
    let wanted =
        |node: &Node<'_, '_>| node.attribute("class").is_some_and(|found| found.split(' ').any(|c| c == class));
    let text = |node: Node<'_, '_>| node.descendants().filter(Node::is_text).filter_map(|part| part.text()).collect();
    document.descendants().filter(wanted).map(text).collect()
}

/// The names in each panel.
fn panels(svg: &str) -> Vec<Vec<String>> {
    let document = Document::parse(svg).expect("well-formed XML");
    let is = |node: &Node<'_, '_>, class: &str| node.attribute("class") == Some(class);
    let groups = document.descendants().filter(|node| is(node, "group"));
    let names = |group: Node<'_, '_>| {
        let names = group.descendants().filter(|node| is(node, "name"));
        let mut names: Vec<String> = names.filter_map(|name| name.text().map(str::to_owned)).collect();
        names.sort();
        names
    };
    groups.map(names).collect()
}

/// The trace of a signal: its path.
fn trace(svg: &str, name: &str) -> String {
    let document = Document::parse(svg).expect("well-formed XML");
    let titled = document.descendants().find(|node| node.has_tag_name("title") && node.text() == Some(name));
    let group = titled.and_then(|title| title.parent()).expect("a trace");
    let path = group.children().find(|node| node.has_tag_name("path")).expect("a path");
    path.attribute("d").unwrap_or_default().to_owned()
}

#[test]
fn ints_stand_apart_from_reals_and_switches_in_lanes() {
    let folder = project("p.cfg", MIX, "k,\"ain(0,1,1)\",n.value\n0,1,2\n5,2,-3\n9,3,7\n");
    let svg = plot(folder.path(), &["--stimulus", "s.csv"]);
    assert_eq!(panels(&svg), [vec!["x"], vec!["big"], vec!["off", "on"], vec!["n"]]);
    assert_eq!(texts(&svg, "head"), ["p, 10 scans"]);
    let ticks = texts(&svg, "tick");
    assert_eq!(&ticks[ticks.len() - 12..], ["0", "1", "2", "3", "4", "5", "6", "7", "8", "9", "10", "scans"]);
    assert!(["-2", "0", "2", "4", "6"].iter().all(|tick| ticks.iter().any(|found| found == tick)), "{ticks:?}");
}

#[test]
fn a_loop_is_drawn_as_what_it_compares_and_what_it_does() {
    let output = drawn_example(&["--engine", "embedded"]);
    assert_eq!(panels(&output), [vec!["w", "y1", "y2"], vec!["u1", "u2"]]);
}

/// The README's picture.
fn drawn_example(more: &[&str]) -> String {
    let gpc = root().join("examples/gpc");
    let mut command = pcl2();
    command.arg("run").arg(&gpc).arg("--stimulus").arg(gpc.join("stimulus.csv"));
    check(command.args(["--record", "w,y1,u1,y2,u2", "--plot", "-"]).args(more))
}

#[test]
fn samples_hold_until_the_next_and_bad_ones_are_gaps() {
    let folder = project("p.cfg", MIX, "k,\"ain(0,1,1)\"\n0,1\n1,2\n2,nan\n3,1\n4,1\n");
    let svg = plot(folder.path(), &["--stimulus", "s.csv", "--record", "x"]);
    // Five scans over 800 pixels from 84 on; 1 and 2 lie 6% of 112% above the bottom and below the top of 150 pixels.
    assert_eq!(trace(&svg, "x"), "M84 190H244V56H404M564 190H884");
    assert!(
        svg.contains("<title>x is bad</title><rect class='bad' x='404' y='48' width='160' height='150'/>"),
        "{svg}"
    );
    let ends = plot(folder.path(), &["--steps", "3", "--record", "x", "--set", "n.value=1"]);
    assert!(!ends.contains("class='bad'") && trace(&ends, "x").starts_with("M84 "));
}

#[test]
fn a_long_run_stays_small_and_keeps_its_peaks() {
    let text = "CONTROL\n1 one = msc ( : 1. )\n2 a = sumII ( 1, a, one, 2 : -0.9, 3. )\n3 p = msc ( : 0. )\nEND\n";
    let folder = project("p.cfg", text, "");
    let args = ["--steps", "1000000", "--period", "0.01", "--set", "p.value=50@5000", "--set", "p.value=0@5000.01"];
    let svg = plot(folder.path(), &args);
    assert!(svg.len() < 60_000, "{} bytes", svg.len());
    // One sample of a million: up to the panel's top and down again.
    let peak = trace(&svg, "p");
    assert!(peak.matches('V').count() == 2, "{peak}");
    let ticks = texts(&svg, "tick");
    assert!(ticks.contains(&"time in min".to_owned()) && ticks.contains(&"160".to_owned()), "{ticks:?}");
}

#[test]
fn both_engines_draw_the_same_with_and_without_a_trace() {
    let alone = drawn_example(&["--engine", "embedded"]);
    let work = folder();
    let csv = work.path().join("t.csv").display().to_string();
    let traced = drawn_example(&["--engine", "cc", "--trace", &csv]);
    assert!(alone == traced, "the pictures differ");
    assert_eq!(fs::read_to_string(&csv).unwrap().lines().count(), 122);
}

#[test]
fn many_signals_are_left_out_and_counted() {
    let text = "CONTROL\n1 v = setvec ( 50 : )\nEND\n";
    let folder = project("p.cfg", text, "");
    let svg = plot(folder.path(), &["--steps", "2"]);
    assert!(svg.contains(">and 10 more signals</text>"), "{svg}");
    assert_eq!(panels(&svg).concat().len(), 40);
    Document::parse(&plot(folder.path(), &["--steps", "0"])).expect("a picture without samples");
}

const NET: &str = "\
int busy = store ( int put, int take : )
GENERATE make SIZE 1 WHEN put
CAPACITY shelf SIZE 9 DRIVES busy
GATE in  : make -> shelf
GATE out : shelf ->  IF take
END
";

/// A token comes in scans 2, 12 and 22, one goes in scan 30.
const PUTS: &str = "k,put,take\n0,0,0\n2,1,0\n4,0,0\n12,1,0\n14,0,0\n22,1,0\n24,0,0\n30,0,1\n31,0,0\n49,0,0\n";

#[test]
fn a_net_is_drawn_as_a_time_chart() {
    let folder = project("store.net", NET, PUTS);
    let svg = check(pcl2().current_dir(folder.path()).args(["run", "store.net", "--stimulus", "s.csv", "--plot", "-"]));
    assert_eq!(panels(&svg), [vec!["busy", "put", "take"], vec!["store.make", "store.shelf"]]);
    // The number stands where it holds: 1, 2, 3 and 2 again. Each has a band of its own.
    assert_eq!(texts(&svg, "count"), ["1", "2", "3", "2"]);
    let columns: Vec<&str> = svg.split("class='marked'").skip(1).filter_map(|rest| rest.split('\'').nth(3)).collect();
    let starts: Vec<String> = [2, 12, 22, 30].map(|scan| (84 + scan * 800 / 50).to_string()).into();
    assert_eq!(columns, starts);
}

/// More boxes than other signals have room: in a `.cfg`, too, where each net has a chart of its own.
#[test]
fn the_boxes_of_each_net_stand_together() {
    let folder = project("p.cfg", "CONTROL\n1 A = ring ( : )\n2 B = ring ( : )\n3 n = msi ( : 5 )\nEND\n", "");
    let mut ring = "= ring ( : )\n".to_owned();
    for i in 0..60 {
        let start = if i == 0 { " MARKED" } else { "" };
        ring += &format!("STATE s{i}{start}\nGATE t{i} : s{i} -> s{}\n", (i + 1) % 60);
    }
    fs::write(folder.path().join("ring.net"), format!("{ring}END\n")).unwrap();
    let svg = plot(folder.path(), &["--steps", "60"]);
    let panels = panels(&svg);
    let of = |net: &str| (0..60).map(|i| format!("{net}.s{i}")).collect::<std::collections::BTreeSet<_>>();
    let found: Vec<std::collections::BTreeSet<String>> =
        panels.iter().map(|panel| panel.iter().cloned().collect()).collect();
    assert!(found.contains(&of("A")) && found.contains(&of("B")), "{found:?}");
    assert!(found.contains(&["n".to_owned()].into()) && !svg.contains("more signals"), "{found:?}");
}

#[test]
fn how_plotting_ends() {
    let folder = project("p.cfg", MIX, "");
    let ended = |args: &[&str]| {
        let output = run(pcl2().current_dir(folder.path()).args(["run", "p.cfg", "--steps", "2"]).args(args));
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    assert_eq!(ended(&["--plot", "p.svg"]), (Some(0), String::new()));
    assert!(folder.path().join("p.svg").is_file());
    let missing = "error: cannot write `no/p.svg`: there is no such folder\n";
    assert_eq!(ended(&["--plot", "no/p.svg"]), (Some(3), missing.to_owned()));
    let both = "error: only one of --trace and --plot can go to standard output\n";
    assert_eq!(ended(&["--plot", "-", "--trace", "-"]), (Some(2), both.to_owned()));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 3, "a failed run left something");
}

/// `docs/trends.svg` is what the README's command draws.
#[test]
fn the_picture_in_docs_is_fresh() {
    let kept = fs::read_to_string(root().join("docs/trends.svg")).unwrap_or_default();
    let stale = "run `pcl2 run examples/gpc` with the README's arguments and --plot docs/trends.svg";
    assert!(drawn_example(&[]) == kept, "{stale}");
}
