//! `pcl2 net`: matrices, firing, composition, division, export; and the commands that the page on nets shows.

use pcl2_net::pnml;
use pcl2_net::pt::{Arc, Place, PlaceId, PtNet, Transition};
use pcl2_tests::compilers::{check, folder};
use pcl2_tests::fences::fences;
use pcl2_tests::{none, pcl2, root, run};
use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::Command;

fn net(name: &str) -> PathBuf {
    root().join("tests/nets").join(name)
}

/// Status, output and messages of a command.
fn said(command: &str, path: &Path, args: &[&str]) -> (i32, String, String) {
    let output = run(pcl2().args(["net", command]).arg(path).args(args));
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code().unwrap(), text(&output.stdout), text(&output.stderr))
}

fn done(command: &str, path: &Path, args: &[&str]) -> String {
    let (status, out, messages) = said(command, path, args);
    assert_eq!(status, 0, "{messages}");
    out
}

/// Refused with this status; the message has these words.
fn refused(command: &str, path: &Path, args: &[&str], status: i32, words: &str) {
    let (found, _, messages) = said(command, path, args);
    assert_eq!(found, status, "{messages}");
    assert!(messages.contains(words), "{messages}");
}

/// Jeong and Yang: the loop of the button has the matrix of a device with two states.
#[test]
fn a_matrix_is_printed_for_people_and_for_tools() {
    let out = done("matrix", &net("tank.net"), &["--of", "P", "--kind", "change"]);
    assert_eq!(out, "loop P, 2 places, 2 transitions\n\nB   tp11  tp10\nP0    -1     1\nP1     1    -1\n");
    let out = done("matrix", &net("tank.net"), &["--of", "P", "--kind", "change", "--csv"]);
    assert_eq!(out, "B,tp11,tp10\nP0,-1,1\nP1,1,-1\n");
    refused("matrix", &net("tank.net"), &["--of", "X"], 2, "expected one of tank, S, P, L, V1, V2, Z1, D1, D2 behind");
    refused("matrix", &net("none.net"), &[], 1, "expected a readable file");
}

/// Names of other tools have no longest length: what is wider than a column stands out. A net is no matrix.
#[test]
fn long_names_are_printed_and_a_net_is_no_matrix() {
    let work = folder();
    let file = work.path().join("long.pnml");
    let name = "n".repeat(70_000);
    let text = done("export", &net("tank.net"), &["--to", "pnml"]);
    let text =
        text.replace("\"tp11\"", &format!("\"{name}\"")).replace("<text>tp11</text>", &format!("<text>{name}</text>"));
    fs::write(&file, text).unwrap();
    assert!(done("matrix", &file, &[]).contains(&format!("  {name}  tp10")));
    assert!(done("fire", &file, &[&name]).contains(&format!("  1  {name}  S0")));
    refused("compose", &file, &[], 1, "expected a matrix as CSV, found XML");
}

/// An answer that does not reach its file is a failure.
#[test]
fn a_full_disk_is_told() {
    let full = || fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    for command in [&["analyze"][..], &["analyze", "--json"], &["matrix"], &["matrix", "--csv"]] {
        let output = pcl2().arg("net").args(command).arg(net("tank.net")).stdout(full()).output().unwrap();
        let messages = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(3), "{command:?} {messages}");
        assert!(messages.contains("cannot write to standard output"), "{messages}");
    }
}

/// The matrices of the loops, each in a file, add up to that of the whole net; a copy counts once; two that differ are
/// an error.
#[test]
fn a_net_is_composed_of_its_modules() {
    let work = folder();
    let mut files = Vec::new();
    for part in ["S", "P", "L", "V1", "V2", "Z1", "D1", "D2"] {
        let file = work.path().join(format!("{part}.csv"));
        fs::write(&file, done("matrix", &net("tank.net"), &["--csv", "--kind", "change", "--of", part])).unwrap();
        files.push(file);
    }
    fs::copy(work.path().join("V1.csv"), work.path().join("again.csv")).unwrap();
    files.push(work.path().join("again.csv"));
    let others: Vec<&str> = files[1..].iter().map(|file| file.to_str().unwrap()).collect();
    let composed = done("compose", &files[0], &[&["--csv"], others.as_slice()].concat());
    let whole = done("matrix", &net("tank.net"), &["--csv", "--kind", "change", "--of", "tank"]);
    assert_eq!(cells(&composed), cells(&whole));
    let text = done("compose", &files[0], &others);
    assert!(text.contains("module V1: 2 copies\n") && text.contains("module S: 1 copy\n"), "{text}");
    fs::write(&files[8], "B,tv10,tv11\nV10,-1,2\nV11,1,-1\n").unwrap();
    refused(
        "compose",
        &files[3],
        &[others[7]],
        1,
        "module `V1`, place `V10`, transition `tv11`: expected equal copies",
    );
    fs::write(&files[8], "B-,tv10,tv11\nV10,1,0\nV11,0,1\n").unwrap();
    refused(
        "compose",
        &files[3],
        &[others[7]],
        1,
        "expected matrices of one kind, found `B` in `V1` and `B-` in `again`",
    );
}

/// A file has one matrix: a second one is told at its line, blank lines counted, and how to write one alone.
#[test]
fn a_file_with_several_matrices_is_not_composed() {
    let work = folder();
    let file = work.path().join("tank.csv");
    for (args, found) in [(&["--csv"][..], "found a second matrix"), (&["--csv", "--kind", "change"], "fields, found")]
    {
        let text = done("matrix", &net("tank.net"), args);
        let second = text.lines().position(str::is_empty).unwrap() + 2;
        fs::write(&file, text).unwrap();
        refused("compose", &file, &[], 1, &format!("line {second}: expected "));
        refused("compose", &file, &[], 1, found);
        refused("compose", &file, &[], 1, "a file has one matrix: `net matrix --csv` writes one with --of and --kind");
    }
    fs::write(&file, "B,t\r\n\r\n\r\np,1\r\np,2\r\n").unwrap();
    refused("compose", &file, &[], 1, "line 5, column 1: `p` stands in an earlier row");
    refused("compose", &file, &["--kind", "takes"], 2, "expected one .net file with --kind, found others");
}

/// One is not several.
#[test]
fn one_place_and_one_transition_are_told_so() {
    let work = folder();
    let file = work.path().join("one.net");
    fs::write(&file, "= one ( int b : )\nSTATE a MARKED\nGATE g : a -> IF b\nEND\n").unwrap();
    let analysis = done("analyze", &file, &[]);
    let words = "1 place, 1 transition; the incidence matrix has 1 entry that is not 0\n";
    assert!(analysis.contains(words), "{analysis}");
    assert!(done("matrix", &file, &[]).starts_with("net one, 1 place, 1 transition\n"));
    assert!(done("report", &file, &["-o", work.path().to_str().unwrap()]).is_empty());
    let report = fs::read_to_string(work.path().join("one.md")).unwrap();
    assert!(report.contains("1 box, 1 gate."), "{report}");
}

/// The rules of a gate stand below one another, without a blank line.
#[test]
fn rules_written_flat_follow_one_another() {
    let work = folder();
    let file = work.path().join("two.net");
    let rules = "GATE g : a -> c, d\nIF b\nTHEN a -> c\nIF NOT b\nTHEN a -> d\nELSE\nTHEN a -> nothing\n";
    fs::write(&file, format!("= two ( int b : )\nSTATE a MARKED\nSTATE c\nSTATE d\n{rules}END\n")).unwrap();
    let flat = done("flatten", &file, &[]);
    assert!(flat.contains(rules), "{flat}");
}

/// Arcs of other kinds are no ordinary ones, whichever way a tool writes their type.
#[test]
fn arcs_of_other_types_are_refused() {
    let work = folder();
    let file = work.path().join("arc.pnml");
    let written = |arc: &str| {
        let nodes = "<place id=\"p\"/><transition id=\"t\"/>";
        let net = "net id=\"n\" type=\"http://www.pnml.org/version-2009/grammar/ptnet\"";
        fs::write(&file, format!("<pnml><{net}><page id=\"g\">{nodes}{arc}</page></net></pnml>")).unwrap();
    };
    let ends = "source=\"p\" target=\"t\"";
    let words = "expected an ordinary arc, found one of the type `inhibitor`";
    written(&format!("<arc {ends} type=\"inhibitor\"/>"));
    refused("matrix", &file, &[], 1, words);
    written(&format!("<arc {ends}><type value=\"inhibitor\"/></arc>"));
    refused("matrix", &file, &[], 1, words);
    written(&format!("<arc {ends} type=\"normal\"/>"));
    assert!(done("matrix", &file, &[]).starts_with("net n, 1 place, 1 transition\n"));
}

/// What is not zero, with its names, in order.
fn cells(csv: &str) -> Vec<(String, String, String)> {
    let mut reader = csv::Reader::from_reader(csv.as_bytes());
    let names: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let mut cells = Vec::new();
    for row in reader.records() {
        let row = row.unwrap();
        let full = names.iter().zip(row.iter()).skip(1).filter(|(_, value)| *value != "0");
        cells.extend(full.map(|(name, value)| (row[0].to_owned(), name.clone(), value.to_owned())));
    }
    cells.sort();
    assert!(cells.len() > 10);
    cells
}

/// Jeong and Yang, equation (9): t0 and tp11 lead from the start to S1 and P1.
#[test]
fn a_sequence_is_fired_after_the_state_equation() {
    let out = done("fire", &net("tank.net"), &["tp11 {t0, tp10}", "{tL1 tv10}"]);
    let last = "  3  tL1 tv10  S1 P0 L0 V11 V20 Z10 D10 D21\n";
    assert!(out.ends_with(last), "{out}");
    let csv = done("fire", &net("tank.net"), &["--csv", "tp11"]);
    assert!(csv.starts_with("k,S0,S1,S2,S3,S4,S5,S6,P0,P1,") && csv.lines().count() == 3, "{csv}");
    let tank = net("tank.net");
    let tokens = "scan 2: `t1` is not enabled: expected 1 token to take from `S1`, found 0";
    refused("fire", &tank, &["tp11 t1"], 1, tokens);
    refused("fire", &tank, &["{tp11 t0}"], 1, "scan 1: `t0` is not enabled: expected 1 token to read in `P1`, found 0");
    refused("fire", &tank, &["tp12"], 1, "expected a transition of the net, found `tp12` (did you mean `tp10`?)");
    refused("fire", &tank, &["{tp11"], 1, "expected `}` at the end of the sequence");
    refused("fire", &tank, &["tp11}"], 1, "expected `{` before `}`");
}

/// The largest net after the division has 13 places and 13 transitions: the main loop.
#[test]
fn the_tank_is_divided_by_its_steps() {
    let out = done("divide", &net("tank.net"), &["--steps", "S0,S1,S2,S3,S4,S5,S6"]);
    let sizes: Vec<&str> = out.lines().filter(|line| line.ends_with(" transitions")).collect();
    let expected = [
        "main: 13 places, 13 transitions",
        "Su1: 9 places, 10 transitions",
        "Su2: 2 places, 2 transitions",
        "Su3: 7 places, 8 transitions",
        "Su4: 4 places, 4 transitions",
    ];
    assert_eq!(sizes, expected);
    assert!(out.contains("  t1 : S1, Su1 -> S2\n") && out.contains("  step S4 starts tv20\n"), "{out}");
    refused("divide", &net("tank.net"), &["--steps", "S0,Q"], 1, "expected a place of the net, found `Q`");
    refused("divide", &net("tank.net"), &[], 2, "--steps");
}

/// A net that has nothing but arcs comes back from PNML as it was.
#[test]
fn pnml_reads_back_to_the_same_net() {
    for name in ["FMS-PT-00002.pnml", "SwimmingPool-PT-01.pnml", "Philosophers-PT-000010.pnml"] {
        let before = pnml::read(&fs::read_to_string(net(name)).unwrap()).unwrap();
        let after = pnml::read(&done("export", &net(name), &["--to", "pnml"])).unwrap();
        assert_eq!(sorted(&before), sorted(&after), "{name}");
    }
}

/// The arcs of each transition in order.
fn sorted(net: &PtNet) -> PtNet {
    let mut net = net.clone();
    for transition in &mut net.transitions {
        transition.takes.sort_unstable();
        transition.puts.sort_unstable();
    }
    net
}

/// Markings, edges and dead markings.
fn counted(path: &Path) -> (u64, u64, u64) {
    let found: serde_json::Value = serde_json::from_str(&done("analyze", path, &["--json"])).unwrap();
    let number = |key: &str| found[key].as_u64().unwrap();
    assert_eq!(found["complete"], true);
    (number("markings"), number("edges"), number("dead_markings"))
}

/// A net with room, read arcs, inhibitors, weights and a macro with an ABORT, and others.
fn written(work: &Path) -> Vec<PathBuf> {
    let page = fs::read_to_string(root().join("docs/nets.md")).unwrap();
    for fence in fences(&page) {
        if let Some(file) = fence.file.filter(|file| file.ends_with(".net")) {
            fs::write(work.join(file), fence.text).unwrap();
        }
    }
    let arcs = "= arcs ( int x : )
CAPACITY a SIZE 5 MARKED 3
CAPACITY b SIZE 4
CAPACITY c SIZE 2 MARKED
GATE g1 : 2*a -> 3*b INHIBIT 2*b
GATE g2 : 2*b, c -> c, a READ 3*b
GATE g3 : b -> c INHIBIT 4*a
GATE g4 : c -> a, b READ a
GATE g5 : a, c -> 2*a IF x
GATE g6 : c -> PRIORITY -1 INHIBIT a, b
END
";
    fs::write(work.join("arcs.net"), arcs).unwrap();
    let mut nets: Vec<PathBuf> =
        ["arcs", "plant", "cars", "jobs", "fill"].iter().map(|name| work.join(format!("{name}.net"))).collect();
    nets.extend([net("tank.net"), net("FMS-PT-00002.pnml")]);
    nets
}

/// Fields of the analysis that its default for .net files does not count in the same way.
fn interleaving(path: &Path, work: &Path) -> (u64, u64, u64) {
    let copy = work.join("plain.pnml");
    fs::write(&copy, done("export", path, &["--to", "pnml"])).unwrap();
    counted(&copy)
}

/// Exported nets have the markings of the net: those of LTSmin's C with room and all as conditions of a row, counted by
/// a stand-in for LTSmin, are those of PNML with places for room.
#[test]
fn each_format_has_the_same_markings() {
    let work = folder();
    for path in written(work.path()) {
        let (markings, edges, _) = interleaving(&path, work.path());
        let file = work.path().join("net.c");
        done("export", &path, &["--to", "ltsmin", "-o", file.to_str().unwrap()]);
        let mut compile = Command::new("gcc");
        compile.args(["-std=c99", "-O2", "-Wall", "-Wextra", "-Werror", "-I"]).arg(root().join("tests/c/ltsmin"));
        check(compile.arg(&file).arg(root().join("tests/c/ltsmin.c")).arg("-o").arg(work.path().join("net")));
        let output = run(&mut Command::new(work.path().join("net")));
        let counted = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(counted.ends_with(&format!(" {markings} {edges}\n")), "{path:?}: {counted}, not {markings} {edges}");
        let lola = work.path().join("lola.pnml");
        let net = read_lola(&done("export", &path, &["--to", "lola"]));
        fs::write(&lola, pcl2_net::export::pnml(&net).unwrap()).unwrap();
        let (lola_markings, lola_edges, _) = self::counted(&lola);
        assert_eq!((lola_markings, lola_edges), (markings, edges), "{path:?}");
    }
    assert_eq!(interleaving(&net("FMS-PT-00002.pnml"), work.path()), (3444, 16_311, 0), "as published");
}

/// LoLA's format, read after its grammar: names without blanks and `,;:(){}`.
fn read_lola(text: &str) -> PtNet {
    let spaced: String =
        text.chars().flat_map(|c| if ",;:".contains(c) { vec![' ', c, ' '] } else { vec![c] }).collect();
    let mut words = spaced.split_whitespace().peekable();
    let mut net = PtNet::default();
    let list = |words: &mut std::iter::Peekable<std::str::SplitWhitespace<'_>>| {
        let mut found: Vec<(String, u64)> = Vec::new();
        loop {
            match words.next().expect("a `;`") {
                ";" => return found,
                "," => {}
                ":" => found.last_mut().unwrap().1 = words.next().unwrap().parse().unwrap(),
                name => found.push((name.to_owned(), 1)),
            }
        }
    };
    assert_eq!(words.next(), Some("PLACE"));
    for (name, _) in list(&mut words) {
        net.places.push(Place { name, ..Place::default() });
    }
    let place = |net: &PtNet, name: &str| net.places.iter().position(|place| place.name == name).expect("a place");
    assert_eq!(words.next(), Some("MARKING"));
    for (name, tokens) in list(&mut words) {
        let at = place(&net, &name);
        net.places[at].initial = tokens;
    }
    while let Some(word) = words.next() {
        assert_eq!(word, "TRANSITION");
        let mut transition = Transition { name: words.next().unwrap().to_owned(), ..Transition::default() };
        let arcs = |words: &mut _, first: &str| -> Vec<Arc> {
            assert_eq!(std::iter::Iterator::next(words), Some(first));
            let arc = |(name, weight): (String, u64)| Arc { place: PlaceId(place(&net, &name) as u32), weight };
            list(words).into_iter().map(arc).collect()
        };
        transition.takes = arcs(&mut words, "CONSUME");
        transition.puts = arcs(&mut words, "PRODUCE");
        net.transitions.push(transition);
    }
    net
}

/// An inhibitor at a place without a limit cannot be said in these formats; in C it can.
#[test]
fn what_a_format_cannot_say_is_refused() {
    let work = folder();
    let path = work.path().join("open.net");
    fs::write(&path, "= open ( : )\nCAPACITY a\nGATE g : -> a INHIBIT 3*a\nEND\n").unwrap();
    for format in ["pnml", "lola"] {
        refused("export", &path, &["--to", format], 1, "`g`: expected a limit of the tokens in `a`");
    }
    assert!(done("export", &path, &["--to", "ltsmin"]).contains("{0, 0, 2, 1}"));
    refused("export", &path, &["--to", "dot"], 2, "possible values: pnml, lola, ltsmin");
}

/// The commands of the page on nets, in order, in a folder with the page's nets; the output stands behind them.
#[test]
fn the_commands_of_the_page_say_what_stands_there() {
    let work = folder();
    let bin = work.path().join("bin");
    fs::create_dir(&bin).unwrap();
    symlink(pcl2().get_program(), bin.join("pcl2")).unwrap();
    let path = format!("{}:{}", bin.display(), std::env::var("PATH").unwrap_or_default());
    let page = fences(&fs::read_to_string(root().join("docs/nets.md")).unwrap());
    let (mut commands, mut complaints) = (0, Vec::new());
    for (i, fence) in page.iter().enumerate() {
        if let Some(file) = &fence.file {
            fs::write(work.path().join(file), &fence.text).unwrap();
        }
        if fence.language != "sh" {
            continue;
        }
        let mut shell = Command::new("sh");
        let output = run(shell.args(["-e", "-c", &fence.text]).current_dir(work.path()).env("PATH", &path));
        let shown = page.get(i + 1).filter(|next| next.language == "text" && next.file.is_none());
        let found = String::from_utf8_lossy(&output.stdout).into_owned();
        if !output.status.success() || shown.is_some_and(|shown| shown.text != found) {
            complaints.push(format!("line {}: {found}{}", fence.line, String::from_utf8_lossy(&output.stderr)));
        }
        commands += fence.text.lines().count();
    }
    assert!(commands >= 5, "only {commands} commands");
    none(&complaints);
}

#[test]
fn a_source_is_not_written_over() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("one.net");
    let text = "= one ( : )\nSTATE a MARKED\nGATE g : a -> a\nEND\n";
    std::fs::write(&path, text).unwrap();
    for command in [["export", "--to", "pnml"].as_slice(), &["flatten"]] {
        let (name, more) = command.split_first().unwrap();
        let output = run(pcl2().args(["net", name]).arg(&path).args(more).arg("-o").arg(&path));
        assert_eq!(output.status.code(), Some(1), "{command:?}");
        assert_eq!(std::fs::read_to_string(&path).unwrap(), text, "{command:?}");
    }
}

/// A report appears whole or not at all.
#[test]
fn a_report_leaves_no_half_of_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("q.net");
    std::fs::write(&path, "= q ( : )\nSTATE a MARKED\nGATE g : a -> a\nEND\n").unwrap();
    std::fs::create_dir_all(folder.path().join("out/q.md")).unwrap();
    let output = run(pcl2().args(["net", "report"]).arg(&path).arg("-o").arg(folder.path().join("out")));
    assert_eq!(output.status.code(), Some(3));
    assert!(String::from_utf8_lossy(&output.stderr).contains("cannot write"));
    assert!(!folder.path().join("out/q.html").exists());
}
