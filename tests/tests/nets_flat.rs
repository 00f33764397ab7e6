//! Nets as place/transition nets: what the player does is among what the abstraction can do.

use pcl2_lang::catalogue::Catalogue;
use pcl2_lang::declare::net;
use pcl2_lang::source::Sources;
use pcl2_lang::symbol::Symbols;
use pcl2_net::flat::{Flat, flat};
use pcl2_net::pt::{PtNet, Transition};
use pcl2_net::structure::step::maximal_step;
use pcl2_tests::dice::Dice;
use pcl2_tests::{pcl2, root, run};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::Command;
use tempfile::TempDir;

/// Flattens nets that are written here, inner ones first: name and text.
fn flattened(nets: &[(&str, &str)]) -> Result<Flat, String> {
    let (mut sources, mut symbols, mut diagnostics) = (Sources::default(), Symbols::default(), Vec::new());
    let mut catalogue = Catalogue::packed(&mut sources, &mut symbols, &mut diagnostics);
    for (name, text) in nets {
        let file = sources.add(format!("{name}.net"), text.as_bytes().to_vec());
        let read = net::read(&sources, file, name, &mut symbols, &mut diagnostics).expect("a head");
        let decl = pcl2_net::compile(read, &sources, &mut symbols, &catalogue, &mut diagnostics);
        assert!(diagnostics.is_empty(), "{diagnostics:?}\n{text}");
        catalogue.add_net(decl.expect("a net"), &mut diagnostics);
    }
    let outer = catalogue.find(nets.last().expect("a net").0).expect("the outer net");
    flat(outer, &catalogue, &symbols)
}

/// One line for each transition: what it takes, puts, reads and is inhibited by; `?` when it is free.
fn lines(net: &PtNet) -> Vec<String> {
    let line = |transition: &Transition| {
        let mut text = format!("{}{}", transition.name, if transition.free { "?" } else { "" });
        let kinds = [&transition.takes, &transition.puts, &transition.reads, &transition.inhibits];
        for (sign, arcs) in ["-", "+", "r", "i"].into_iter().zip(kinds) {
            for arc in arcs {
                let weight = if arc.weight == 1 { String::new() } else { arc.weight.to_string() };
                let _ = write!(text, " {sign}{weight}{}", net.places[arc.place.0 as usize].name);
            }
        }
        text
    };
    net.transitions.iter().map(line).collect()
}

fn check(nets: &[(&str, &str)], expected: &[&str]) -> Flat {
    let flat = flattened(nets).expect("a flat net");
    assert_eq!(lines(&flat.net), expected);
    flat
}

#[test]
fn conditions_over_boxes_become_arcs_and_others_leave_a_gate_free() {
    let net = "= n ( int x : )
STATE a MARKED
STATE b
CAPACITY c SIZE 3
FOR i = 1 TO 2
STATE s[i]
NEXT
GATE g1 : a -> b IF c AND NOT s[2]
GATE g2 : a -> b IF c >= 2 AND x
GATE g3 : a -> b IF a OR c
GATE g4 : a -> b IF NOT (a OR c > 1)
GATE g5 : a -> b PERMIT NOT s[1] IF 2 == c
GATE g6 : b -> a IF x < 3
GATE g7 : 2*c -> a READ b, 2*c INHIBIT 3*c PRIORITY 2
END
";
    let expected = [
        "g7 -2c +a rb r2c i3c",
        "g1 -a +b rc is[2]",
        "g2? -a +b r2c",
        "g3? -a +b",
        "g4 -a +b ia i2c",
        "g5 -a +b r2c is[1] i3c",
        "g6? -b +a",
    ];
    check(&[("n", net)], &expected);
}

#[test]
fn rules_are_alternatives_of_one_gate() {
    let net = "= n ( int x : )
STATE a MARKED
STATE b
STATE c
GATE keep : a -> b, c
IF x
THEN a -> b
ELSE
THEN a -> c
GATE both : a -> b, c
IF c
THEN a -> b
IF x
THEN a -> nothing
ELSE
THEN a -> b, c
GATE other : b -> c
END
";
    let expected = [
        // No room in b holds the gate back, when the first rule is the one.
        "keep/1? -a +b",
        "keep/2? -a +c",
        "both/1 -a +b rc",
        "both/2? -a ic",
        // Where x is true the second rule fires, whatever the room: else this one must.
        "both/3 -a +b +c ic",
        "other -b +c",
    ];
    let flat = check(&[("n", net)], &expected);
    let gates: Vec<u32> = flat.net.transitions.iter().map(|transition| transition.gate).collect();
    assert_eq!(gates, [0, 0, 1, 1, 1, 2]);
}

#[test]
fn boxes_that_wait_count_or_make_tokens_have_their_arcs() {
    let net = "= n ( int x : )
TIME wait 2. MARKED
COUNT three 3
PROCESS work UNTIL x
OPERATION sums DO n = n + 1
CAPACITY any
GENERATE new SIZE 2 WHEN x
LOCAL int n
GATE g1 : wait -> three
GATE g2 : three -> work
GATE g3 : work -> sums
GATE g4 : sums, new -> 2*any READ three
END
";
    let expected =
        ["g1? -wait +three", "g2 -3three +work", "g3? -work +sums", "g4 -sums -new +2any r3three", "+new? +new"];
    let flat = check(&[("n", net)], &expected);
    let capacities: Vec<Option<u64>> = flat.net.places.iter().map(|place| place.capacity).collect();
    assert_eq!(capacities, [Some(1), Some(3), Some(1), Some(1), None, Some(2)]);
    let scans = lines(&flat.for_scans().unwrap());
    assert_eq!(scans[3..5], ["g4+new? -sums -new +2any +new r3three r2new", expected[3]]);
}

/// The nets of the page on nets.
const DOSE: &str = "int wanted = dose ( : real length = 1. )
ENTRY come
TIME flow length DRIVES wanted
EXIT gone
GATE a : come -> flow
GATE b : flow -> gone
END
";
const VALVE: &str = "int coil = valve ( int wanted : )
STATE shut MARKED
STATE open DRIVES coil
GATE opens : shut -> open  IF wanted
GATE shuts : open -> shut  IF NOT wanted
END
";
const PLANT: &str = "int coil, int doses = plant ( int button, int stop : )
LOCAL int wanted
STATE idle MARKED
STATE held
MACRO D : wanted = dose ( : length = 2. )
ABORT stop -> idle
DO doses = 0
MODULE V : coil = valve ( wanted : )
GATE press : idle -> D     IF button
GATE dosed : D -> held     READ V.shut
DO doses = doses + 1
GATE again : held -> idle  IF NOT button
END
";

#[test]
fn a_macro_holds_its_token_and_a_module_stands_beside() {
    let inside = "iD.come iD.flow iD.gone";
    let expected = [
        "abort:D/come? -D -D.come +idle iD.flow iD.gone".to_owned(),
        "abort:D/flow? -D -D.flow +idle iD.come iD.gone".to_owned(),
        "abort:D/gone? -D -D.gone +idle iD.come iD.flow".to_owned(),
        format!("press? -idle +D +D.come {inside}"),
        "dosed -D -D.gone +held rV.shut".to_owned(),
        "again? -held +idle".to_owned(),
        "D.a -D.come +D.flow".to_owned(),
        "D.b? -D.flow +D.gone".to_owned(),
        "V.opens? -V.shut +V.open".to_owned(),
        "V.shuts? -V.open +V.shut".to_owned(),
    ];
    let expected: Vec<&str> = expected.iter().map(String::as_str).collect();
    let flat = check(&[("dose", DOSE), ("valve", VALVE), ("plant", PLANT)], &expected);
    let parts: Vec<(&str, bool, usize)> =
        flat.parts.iter().map(|part| (part.name.as_str(), part.is_macro, part.transitions.len())).collect();
    assert_eq!(parts, [("plant", false, 6), ("D", true, 2), ("V", false, 2)]);
}

/// A macro with too many markings inside is not written out: it says so.
#[test]
fn an_abort_over_too_many_markings_is_refused() {
    let inner = "= inner ( : )
ENTRY come
EXIT gone
CAPACITY many SIZE 60000
GATE a : -> many
GATE b : come -> gone
END
";
    let outer = "= outer ( int stop : )
STATE idle MARKED
MACRO M = inner ( : )
ABORT stop -> idle
GATE g : idle -> M
END
";
    let why = flattened(&[("inner", inner), ("outer", outer)]).unwrap_err();
    assert!(why.contains("macro `M`: expected at most 4096 markings"), "{why}");
}

/// Some of a list, each once.
fn some<'t>(dice: &mut Dice, of: &[&'t str], most: usize) -> Vec<&'t str> {
    let mut chosen: Vec<&str> = Vec::new();
    for _ in 0..dice.below(most + 1) {
        let one = dice.one(of);
        if !chosen.contains(&one) {
            chosen.push(one);
        }
    }
    chosen
}

/// A condition over inputs and boxes.
fn condition(dice: &mut Dice, boxes: &[&str], depth: usize) -> String {
    let inner = |dice: &mut Dice| condition(dice, boxes, depth + 1);
    match if depth > 1 { dice.below(4) } else { dice.below(7) } {
        0 => dice.one(&["x0", "x1"]).to_owned(),
        1 => format!("NOT {}", dice.one(boxes)),
        2 => format!("{} {} {}", dice.one(boxes), dice.one(&["==", ">=", "<", "<>"]), dice.below(3)),
        3 => dice.one(boxes).to_owned(),
        4 => format!("NOT ({})", inner(dice)),
        5 => format!("({}) OR ({})", inner(dice), inner(dice)),
        _ => format!("({}) AND ({})", inner(dice), inner(dice)),
    }
}

/// A gate between boxes; it may look at others. COUNT boxes are those with a `k` at their start.
fn gate(dice: &mut Dice, name: &str, boxes: &[&str], seen: &[&str]) -> String {
    let mut before = some(dice, boxes, 2);
    if before.is_empty() {
        before.push(dice.one(boxes));
    }
    let after = some(dice, boxes, 2);
    let mut text = format!("GATE {name} : {} -> {}", before.join(", "), after.join(", "));
    for word in ["READ", "INHIBIT"] {
        if dice.below(4) == 0 {
            let _ = write!(text, " {word} {}", dice.one(seen));
        }
    }
    let _ = write!(text, " PRIORITY {}", dice.below(2));
    if dice.below(5) == 0 {
        let _ = write!(text, " PERMIT ({})", condition(dice, seen, 1));
    }
    text.push('\n');
    let then = |first: &[&str]| {
        let mut lines = String::new();
        for (i, name) in before.iter().enumerate() {
            let to = if i == 0 && !first.is_empty() { first.join(", ") } else { "nothing".to_owned() };
            let _ = writeln!(lines, "THEN {name} -> {to}");
        }
        lines
    };
    match dice.below(3) {
        0 => {}
        1 => {
            let _ = writeln!(text, "IF {}", condition(dice, seen, 0));
        }
        _ => {
            let _ = write!(text, "IF {}\n{}", condition(dice, seen, 0), then(&after));
            if dice.below(2) == 0 {
                let _ = write!(text, "IF {}\n{}", condition(dice, seen, 0), then(&[]));
            }
            let _ = write!(text, "ELSE\n{}", then(&after[..after.len().min(1)]));
        }
    }
    text
}

/// Names and texts of a net with a macro and a module in it.
fn random(dice: &mut Dice) -> [(&'static str, String); 3] {
    let mut module = "= module ( int x0, int x1 : )\nSTATE off MARKED\nSTATE on\n".to_owned();
    for i in 0..2 {
        module += &gate(dice, &format!("m{i}"), &["off", "on"], &["off", "on"]);
    }
    let mut inner = "= inner ( int x0, int x1 : )\nENTRY come\nEXIT gone\nSTATE a\nCAPACITY b SIZE 2\n".to_owned();
    let boxes = ["come", "a", "b", "gone"];
    inner += "GATE i0 : come -> a\nGATE i1 : a -> gone IF x1\n";
    for i in 2..4 {
        inner += &gate(dice, &format!("i{i}"), &boxes, &boxes);
    }
    let mut outer = "= outer ( int x0, int x1, int x2 : )\nLOCAL int n\n".to_owned();
    let mut boxes = vec!["p", "q"];
    outer += "STATE p MARKED\nCAPACITY q SIZE 2 MARKED\n";
    let others = [
        ("r", "TIME r 0.2\n"),
        ("r", "COUNT r 2\n"),
        ("r", "PROCESS r UNTIL x0\n"),
        ("r", "OPERATION r MARKED DO n = n + 1\n"),
        ("s", "GENERATE s SIZE 1 WHEN x2\n"),
        ("s", "GENERATE s SIZE 2 WHEN x2\n"),
        ("s", "CAPACITY s\n"),
    ];
    for (name, line) in [others[dice.below(4)], others[4 + dice.below(3)]] {
        boxes.push(name);
        outer += line;
    }
    outer += "MACRO M = inner ( x0, x1 : )\n";
    let seen: Vec<&str> = boxes.iter().copied().chain(["M", "M.a", "M.b", "V.on"]).collect();
    if dice.below(2) == 0 {
        let _ = writeln!(outer, "ABORT {} -> {}", condition(dice, &seen, 1), dice.one(&["p", "q"]));
    }
    outer += "MODULE V = module ( x0, x1 : )\n";
    boxes.push("M");
    outer += "GATE o0 : p -> M IF x0\nGATE o1 : M -> p\n";
    for i in 2..5 {
        outer += &gate(dice, &format!("o{i}"), &boxes, &seen);
    }
    [("module", module + "END\n"), ("inner", inner + "END\n"), ("outer", outer + "END\n")]
}

/// All markings after a scan.
fn after_a_scan(net: &PtNet, marking: &[u64]) -> BTreeSet<Vec<u64>> {
    let mut found = BTreeSet::new();
    let mut choices: Vec<bool> = Vec::new();
    loop {
        let mut asked = 0;
        let step = maximal_step(net, marking, |_| {
            if asked == choices.len() {
                choices.push(true);
            }
            asked += 1;
            choices[asked - 1]
        });
        choices.truncate(asked);
        found.insert(step.expect("few tokens").marking);
        while choices.pop_if(|choice| !*choice).is_some() {}
        match choices.last_mut() {
            Some(last) => *last = false,
            None => return found,
        }
    }
}

type Trace = BTreeMap<String, Vec<u64>>;

/// Files of nets and a stimulus in a folder of their own.
fn written(nets: &[(&str, &str)], stimulus: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in nets {
        fs::write(folder.path().join(format!("{name}.net")), text).unwrap();
    }
    fs::write(folder.path().join("stimulus.csv"), stimulus).unwrap();
    folder
}

/// Runs a net: boxes of the outer net and of those inside after each scan.
fn played(folder: &Path, net: &str) -> Trace {
    let output = run(traced(net).current_dir(folder));
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let mut reader = csv::Reader::from_reader(output.stdout.as_slice());
    let names: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let mut trace = Trace::new();
    for row in reader.records() {
        for (name, value) in names.iter().zip(row.unwrap().iter()) {
            if let (Some(name), Ok(value)) = (name.strip_prefix("outer."), value.parse()) {
                trace.entry(name.to_owned()).or_default().push(value);
            }
        }
    }
    trace
}

fn traced(net: &str) -> Command {
    let mut command = pcl2();
    command.args(["run", net, "--stimulus", "stimulus.csv", "--trace", "-", "--period", "0.1", "--steps"]);
    command.arg(SCANS.to_string());
    command
}

const SCANS: usize = 40;

/// Random nets with a macro and a module: the markings that the player shows are among those of the abstraction, scan by
/// scan, where it steps as the player does.
#[test]
fn what_the_player_does_the_abstraction_can_do() {
    let mut dice = Dice(20_261_130);
    let (mut entered, mut alone) = (0, 0);
    for number in 0..200 {
        let nets = random(&mut dice);
        let texts: Vec<(&str, &str)> = nets.iter().map(|(name, text)| (*name, text.as_str())).collect();
        let flat = flattened(&texts).expect("a flat net");
        let net = flat.for_scans().expect("few GENERATE boxes");
        let mut stimulus = "k,x0,x1,x2\n0,0,0,0\n".to_owned();
        for k in 1..SCANS {
            let _ = writeln!(stimulus, "{k},{},{},{}", dice.below(2), dice.below(2), dice.below(2));
        }
        let folder = written(&texts, &stimulus);
        let trace = played(folder.path(), "outer.net");
        let shown: Vec<(usize, &Vec<u64>, bool)> = trace
            .iter()
            .filter_map(|(name, values)| {
                let place = net.places.iter().position(|place| place.name == *name)?;
                let made = flat.generations.iter().any(|known| known.0 as usize == place);
                Some((place, values, made))
            })
            .collect();
        assert!(shown.len() >= 5);
        let mut possible = BTreeSet::from([net.places.iter().map(|place| place.initial).collect::<Vec<u64>>()]);
        for scan in 0..SCANS {
            // A token that a GENERATE box makes in the next scan stands there already.
            let fits = |marking: &Vec<u64>| {
                shown.iter().all(|(place, values, made)| {
                    marking[*place] == values[scan] || (*made && marking[*place] == values[scan] + 1)
                })
            };
            possible = possible.iter().flat_map(|marking| after_a_scan(&net, marking)).filter(fits).collect();
            let text = || nets.iter().map(|(_, text)| text.as_str()).collect::<String>();
            assert!(!possible.is_empty(), "net {number}, scan {scan}:\n{}{stimulus}{trace:?}", text());
            alone += usize::from(possible.len() == 1);
        }
        entered += usize::from(trace["M"].contains(&1));
    }
    assert!(entered > 100, "only {entered} macros were entered");
    assert!(alone > 1000, "only {alone} markings were certain");
}

/// Writes a net of a folder flat, into a file of the same name in a folder below. `Err`: what was said.
fn flat_file(folder: &Path, net: &str) -> Result<(), String> {
    let below = folder.join("flat");
    fs::create_dir_all(&below).unwrap();
    let output = run(pcl2().args(["net", "flatten", net, "-o"]).arg(below.join(net)).current_dir(folder));
    match output.status.code() {
        Some(0) => Ok(()),
        _ => Err(String::from_utf8_lossy(&output.stderr).into_owned()),
    }
}

/// What the trace of a net says of some columns, as text.
fn columns(folder: &Path, net: &str, names: &[&str]) -> Vec<Vec<String>> {
    let output = run(traced(net).current_dir(folder));
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let mut reader = csv::Reader::from_reader(output.stdout.as_slice());
    let headers = reader.headers().unwrap().clone();
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    let column = |name: &&str| {
        let at = headers.iter().position(|header| header == *name).unwrap_or_else(|| panic!("{name} in {headers:?}"));
        rows.iter().map(|row| row[at].to_owned()).collect()
    };
    names.iter().map(column).collect()
}

/// Random nets, written flat, have the same tokens in all boxes after each scan, those of nets inside among them.
#[test]
fn random_nets_do_the_same_when_they_are_flat() {
    let mut dice = Dice(20_261_131);
    let (mut same, mut entered) = (0, 0);
    for number in 0..150 {
        let nets = random(&mut dice);
        let texts: Vec<(&str, &str)> = nets.iter().map(|(name, text)| (*name, text.as_str())).collect();
        let mut stimulus = "k,x0,x1,x2\n".to_owned();
        for k in 0..SCANS {
            let _ = writeln!(stimulus, "{k},{},{},{}", dice.below(2), dice.below(2), dice.below(2));
        }
        let folder = written(&texts, &stimulus);
        match flat_file(folder.path(), "outer.net") {
            Ok(()) => {
                let (before, after) = (played(folder.path(), "outer.net"), played(folder.path(), "flat/outer.net"));
                for (name, values) in &before {
                    let flat = after.get(&name.replace('.', "_"));
                    assert_eq!(Some(values), flat, "net {number}, {name}:\n{nets:?}\n{stimulus}");
                }
                same += 1;
                entered += usize::from(before["M"].contains(&1));
            }
            Err(why) => assert!(why.contains("expected"), "{why}"),
        }
    }
    assert!(same > 60 && entered > 40, "only {same} nets, {entered} with a token in the macro");
}

/// Values that go in and out of nets inside: parameters, levels, what statements write, tokens with attributes.
const STAGE: &str = "int on, int count, real last = stage ( int go, real x : real length = 0.2, int more = 1 )
LOCAL int own = 5
CLASS job ( int kind = 1 )
START count = 3
ENTRY come
TIME wait length DRIVES on
OPERATION note DO own = own + more
DO count = own*2 + count
DO last = x + 1.
EXIT gone
GATE a : come -> wait  IF go OR on
GATE b : wait -> note
GATE c : note -> gone  PERMIT (own > 2)
END
";
const NESTED: &str = "int both = nested ( int go, real level : real scale = 1. )
LOCAL int inner
ENTRY first
MACRO S : inner = stage ( go, level : scale, )
EXIT last
STATE lamp DRIVES both
GATE a : first -> S, lamp
GATE b : S, lamp -> last  READ S.gone
END
";
const WHOLE: &str = "int q, int n, real r, int driven = whole ( int x0, int x1, real level : real slow = 0.3 )
LOCAL int busy
CLASS job ( int kind = 7 )
STATE idle MARKED
MACRO one : busy, n, r = stage ( busy2, level : slow, )
MACRO two : q = nested ( go = x1, level = level : )
STATE busy2 DRIVES driven
CAPACITY jobs OF job SIZE 3
GATE g1 : idle -> one, busy2     IF x0
GATE g2 : one, busy2 -> two      PERMIT NOT one.wait
GATE g3 : two -> idle, jobs
THEN two -> idle
THEN NEW -> jobs
GATE g4 : jobs ->                IF jobs.kind == 7 AND x1
END
";

#[test]
fn values_go_in_and_out_of_a_flat_net_as_before() {
    let mut stimulus = "k,x0,x1,level\n".to_owned();
    for k in 0..SCANS {
        let _ = writeln!(stimulus, "{k},{},{},{}.5", u8::from(k % 3 == 0), u8::from(k % 7 > 2), k);
    }
    let folder = written(&[("stage", STAGE), ("nested", NESTED), ("whole", WHOLE)], &stimulus);
    flat_file(folder.path(), "whole.net").unwrap();
    let names = ["q", "n", "r", "driven", "whole.idle", "whole.one", "whole.two", "whole.busy2", "whole.jobs"];
    let before = columns(folder.path(), "whole.net", &names);
    assert_eq!(columns(folder.path(), "flat/whole.net", &names), before);
    for (name, values) in names.iter().zip(&before) {
        assert!(values.iter().any(|value| value != &values[0]), "{name} never changes");
    }
}

/// The tank's hierarchy, flat again, and the page's nets.
#[test]
fn the_tests_nets_do_the_same_when_they_are_flat() {
    let folder = written(&[], "k,press,release\n0,1,0\n2,0,1\n");
    for name in ["tank_hierarchical", "tank_step", "tank_device", "tank_level"] {
        let file = format!("{name}.net");
        fs::copy(root().join("tests/nets").join(&file), folder.path().join(&file)).unwrap();
    }
    flat_file(folder.path(), "tank_hierarchical.net").unwrap();
    let names = ["P1", "L0", "V11", "V21", "Z11", "Z12", "D11", "D20", "tank_hierarchical.S0", "tank_hierarchical.S6"];
    let before = columns(folder.path(), "tank_hierarchical.net", &names);
    assert_eq!(columns(folder.path(), "flat/tank_hierarchical.net", &names), before);
}

/// What a flat net would do at another time is refused, with the names.
#[test]
fn what_cannot_be_flat_is_refused() {
    let other = "int q = whole ( int x0, int x1, real level : )
LOCAL int n
STATE idle MARKED
MACRO one : q, n = stage ( x0, level : )
GATE g : idle -> one
GATE h : one -> idle
DO q2
END
";
    let read = other.replace("DO q2\n", "GATE i : one ->  IF n\n");
    let late = other.replace("DO q2\n", "DO n = n + 1\n").replace("one : q, n = stage ( x0,", "one : q = stage ( n,");
    let taken = other.replace("DO q2\n", "STATE one_come\n");
    let typed = other.replace("DO q2\n", "").replace("( x0, level", "( x0, x1");
    let aborted = |line: &str| WHOLE.replace(line, &format!("{line}ABORT x1 -> idle\n"));
    let cases = [
        (aborted("slow, )\n"), "`one`: expected boxes that give their token at any time, found `wait`"),
        (
            aborted("level = level : )\n"),
            "`two`: expected one token in the macro that ABORT empties, found more or none",
        ),
        (read, "`one`: expected nobody to read `n`, found statements that do"),
        (late, "`one`: expected its input `go` to keep its value in a scan, found `n`"),
        (taken, "expected a name of its own for `one.come` in the flat net, found `one_come`, which `one_come` has"),
        (typed, "`one`: expected its input `x` to have the type of `x1`, found another"),
    ];
    for (text, words) in cases {
        let folder = written(&[("stage", STAGE), ("nested", NESTED), ("whole", &text)], "k\n0\n");
        let why = flat_file(folder.path(), "whole.net").unwrap_err();
        assert!(why.contains(words), "{words} for\n{text}\nfound\n{why}");
    }
    let output = run(pcl2().args(["net", "flatten"]).arg(root().join("tests/nets/FMS-PT-00002.pnml")));
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).contains("expected a .net file"));
}
