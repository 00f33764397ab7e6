//! `pcl2 graph` of nets: every box, gate and arc is there, nothing lies on anything else, the same net gives the same
//! picture.

use pcl2_net::pnml;
use pcl2_net::pt::Arc;
use pcl2_tests::compilers::{check, folder};
use pcl2_tests::dice::Dice;
use pcl2_tests::fences::{examples, fences};
use pcl2_tests::net_picture::{NetPicture, net_picture};
use pcl2_tests::picture::{Area, overlap, runs_through, touch};
use pcl2_tests::{none, pcl2, root, run};
use std::fmt::Write;
use std::fs;
use std::path::Path;

/// A generated net: its text, its boxes, its gates, and its arcs as gate, kind and box with weight.
#[derive(Default)]
struct Generated {
    text: String,
    boxes: usize,
    gates: usize,
    arcs: Vec<(String, &'static str, String)>,
}

/// A net of so many boxes of all kinds, with gates between near boxes (and now and then far ones).
fn generate(boxes: usize, seed: u64) -> Generated {
    let mut dice = Dice(seed);
    let mut net = Generated { boxes, ..Generated::default() };
    let _ = writeln!(net.text, "int y = random ( int a, int b : real t = 2. )");
    net.text.push_str("OPERATION s0 DO y = 0\n");
    for i in 1..boxes {
        let line = match dice.below(12) {
            0 => format!("CAPACITY s{i} SIZE 8 MARKED {}", 1 + dice.below(8)),
            1 => format!("CAPACITY s{i}"),
            2 => format!("TIME s{i} t"),
            3 => format!("COUNT s{i} 4"),
            4 => format!("OPERATION s{i} DO y = {i}"),
            5 => format!("SIGNAL s{i} DO y = 1"),
            6 => format!("PROCESS s{i} UNTIL a AND NOT b WITHIN t"),
            7 => format!("GENERATE s{i} SIZE 3 WHEN b"),
            _ => format!("STATE s{i}{}", if dice.below(4) == 0 { " MARKED" } else { "" }),
        };
        let _ = writeln!(net.text, "{line}");
    }
    for i in 0..boxes {
        net.gate(&mut dice, i);
    }
    net.text.push_str("END\n");
    net
}

impl Generated {
    fn gate(&mut self, dice: &mut Dice, near: usize) {
        let name = format!("t{near}");
        let mut lists = [" : ", " -> ", " READ ", " INHIBIT "].map(|sign| (sign, Vec::<String>::new()));
        for (i, (_, list)) in lists.iter_mut().enumerate() {
            let count = if i < 2 { 1 + dice.below(5) / 3 } else { dice.below(6) / 4 };
            let mut used = Vec::new();
            for _ in 0..count {
                let far = dice.below(15) == 0;
                let place = if far { dice.below(self.boxes) } else { (near + dice.below(5)) % self.boxes };
                if used.contains(&place) {
                    continue;
                }
                used.push(place);
                // What is read must have room for so many.
                let room = i == 3 || self.text.contains(&format!("CAPACITY s{place}\n"));
                let heavy = i > 1 && dice.below(if i == 3 { 8 } else { 2 }) == 0 && room;
                let text = if heavy { format!("12*s{place}") } else { format!("s{place}") };
                self.arcs.push((name.clone(), ["take", "put", "read", "inhibit"][i], text.clone()));
                list.push(text);
            }
        }
        let _ = write!(self.text, "GATE {name}");
        for (sign, list) in lists.iter().filter(|(_, list)| !list.is_empty()) {
            let _ = write!(self.text, "{sign}{}", list.join(", "));
        }
        let more = ["", " PRIORITY -3", " PERMIT a, NOT b", " IF a AND b OR NOT a AND NOT b AND a"][dice.below(4)];
        let _ = writeln!(self.text, "{more}");
        self.gates += 1;
    }
}

/// Draws a net of this text.
fn draw(name: &str, text: &str) -> String {
    let folder = folder();
    fs::write(folder.path().join(name), text).unwrap();
    check(pcl2().current_dir(folder.path()).args(["graph", name, "-o", "-"]))
}

/// What must not be in a picture, whatever the net.
fn faults(name: &str, drawn: &NetPicture) -> Vec<String> {
    let mut faults = Vec::new();
    let symbols = drawn.symbols.iter().map(|symbol| (symbol.name.as_str(), symbol.area));
    let tags = drawn.tags.iter().map(|tag| (tag.text.as_str(), tag.area));
    let texts = drawn.texts.iter().map(|(text, area)| (text.as_str(), *area));
    let things: Vec<(&str, Area)> = symbols.chain(tags).chain(texts).collect();
    for (i, a) in things.iter().enumerate() {
        let others = things[i + 1..].iter().filter(|b| overlap(&a.1, &b.1));
        faults.extend(others.map(|b| format!("{name}: {a:?} lies on {b:?}")));
        let outside = a.1[0] < 0 || a.1[1] < 0 || a.1[2] > drawn.size.0 || a.1[3] > drawn.size.1;
        faults.extend(outside.then(|| format!("{name}: {a:?} lies outside")));
        let across = drawn.frames.iter().filter(|frame| overlap(&a.1, frame) && !is_inside(&a.1, frame));
        faults.extend(across.map(|frame| format!("{name}: {a:?} lies across {frame:?}")));
    }
    for (i, (title, pieces)) in drawn.arcs.iter().enumerate() {
        for piece in pieces {
            let through = things.iter().filter(|(_, area)| runs_through(piece, &smaller(area)));
            faults.extend(through.map(|thing| format!("{name}: {title} runs through {thing:?} by {piece:?}")));
        }
        for (other, others) in &drawn.arcs[i + 1..] {
            let touching = pieces.iter().flat_map(|a| others.iter().map(move |b| (a, b))).find(|(a, b)| touch(a, b));
            faults.extend(touching.map(|(a, b)| format!("{name}: {title} and {other} share {a:?} and {b:?}")));
        }
    }
    faults
}

fn is_inside(area: &Area, frame: &Area) -> bool {
    frame[0] < area[0] && frame[1] < area[1] && area[2] < frame[2] && area[3] < frame[3]
}

/// Round symbols give way at their corners: an arc may come near.
fn smaller([left, top, right, bottom]: &Area) -> Area {
    if bottom - top > 20 { [left + 5, top + 8, right - 5, bottom - 8] } else { [*left, *top, *right, *bottom] }
}

/// What is wrong with the ends of arcs.
fn loose(name: &str, drawn: &NetPicture) -> Vec<String> {
    let mut loose = Vec::new();
    for (title, pieces) in &drawn.arcs {
        let mut words = title.split(' ');
        let names = [words.next().unwrap(), words.next_back().unwrap()];
        let ends = [pieces[0][0], pieces[pieces.len() - 1][1]];
        let on = |name: &str, end| drawn.symbols.iter().any(|symbol| symbol.name == name && symbol.has_on_edge(end));
        let joined =
            (on(names[0], ends[0]) && on(names[1], ends[1])) || (on(names[0], ends[1]) && on(names[1], ends[0]));
        loose.extend((!joined).then(|| format!("{name}: {title} runs from {:?} to {:?}", ends[0], ends[1])));
    }
    loose
}

/// The arcs of a picture, drawn or by name, in the notation of [`Generated`].
fn arcs(drawn: &NetPicture) -> Vec<(String, &'static str, String)> {
    let mut arcs = Vec::new();
    for (title, _) in &drawn.arcs {
        let words: Vec<&str> = title.split(' ').collect();
        let [place, sign, gate] = words[..] else { panic!("{title}") };
        let kind = [("->", "take"), ("<-", "put"), ("<->", "read"), ("-o", "inhibit")];
        let kind = kind.into_iter().find(|(known, _)| *known == sign).unwrap().1;
        arcs.push((gate.to_owned(), kind, place.to_owned()));
    }
    arcs
}

#[test]
fn nothing_lies_on_anything_else_and_nothing_is_missing() {
    let mut complaints = Vec::new();
    for seed in 0..30 {
        let net = generate(3 + 5 * usize::try_from(seed).unwrap(), seed);
        let drawn = net_picture(&draw("random.net", &net.text));
        let name = format!("seed {seed}");
        complaints.extend(faults(&name, &drawn));
        complaints.extend(loose(&name, &drawn));
        let gates = drawn.symbols.iter().filter(|symbol| symbol.kind == "bar").count();
        assert_eq!((drawn.symbols.len() - gates, gates), (net.boxes, net.gates), "{name}");
        let lines = arcs(&drawn);
        for (gate, kind, place) in &net.arcs {
            let bare = place.trim_start_matches("12*");
            let drawn_one = lines.iter().any(|(g, k, p)| g == gate && k == kind && p == bare);
            let class = if matches!(*kind, "take" | "put") { "moves" } else { kind };
            let named = drawn.tags.iter().any(|tag| tag.at == *gate && tag.kind == class && tag.text == *place);
            assert!(drawn_one || named, "{name}: {gate} {kind} {place} is not drawn");
        }
    }
    none(&complaints);
}

/// The size of the largest plant that the paper on K-NET reports: 284 boxes, 281 gates.
#[test]
fn a_plant_of_284_boxes_is_drawn() {
    let net = generate(284, 7);
    let svg = draw("random.net", &net.text);
    let drawn = net_picture(&svg);
    none(&faults("284", &drawn));
    none(&loose("284", &drawn));
    assert_eq!(drawn.symbols.len(), net.boxes + net.gates);
    assert!(svg.len() < 1_000_000, "{} bytes", svg.len());
}

/// All hang together in one ring, or at one box: what runs far goes by name.
#[test]
fn long_rings_and_busy_boxes_go_by_name() {
    let mut ring = "= ring ( : )\n".to_owned();
    let mut hub = "= hub ( int a : )\nSTATE key MARKED\n".to_owned();
    for i in 0..200 {
        let _ = writeln!(ring, "STATE s{i}{}", if i == 0 { " MARKED" } else { "" });
        let _ = writeln!(hub, "STATE s{i}");
    }
    for i in 0..200 {
        let _ = writeln!(ring, "GATE t{i} : s{i} -> s{}", (i + 1) % 200);
        let _ = writeln!(hub, "GATE t{i} : key -> s{i} IF a");
    }
    let drawn = net_picture(&draw("ring.net", &format!("{ring}END\n")));
    none(&faults("ring", &drawn));
    assert!(drawn.size.1 < 4 * drawn.size.0, "{:?}", drawn.size);
    // Each cut is seen from both sides.
    let gates = drawn.tags.iter().filter(|tag| tag.at.starts_with('t')).count();
    assert_eq!((drawn.arcs.len() + gates, drawn.tags.len()), (400, 2 * gates));
    let drawn = net_picture(&draw("hub.net", &format!("{hub}END\n")));
    none(&faults("hub", &drawn));
    assert_eq!(drawn.tags.iter().filter(|tag| tag.text == "key").count(), 200);
}

#[test]
fn the_nets_of_the_papers_and_of_the_docs_are_drawn_without_faults() {
    let mut complaints = Vec::new();
    let mut drawn = 0;
    let mut look = |name: &str, svg: &str| {
        let picture = net_picture(svg);
        complaints.extend(faults(name, &picture));
        complaints.extend(loose(name, &picture));
        drawn += 1;
    };
    for name in ["tank", "agv"] {
        let path = root().join(format!("tests/nets/{name}.net"));
        look(name, &check(pcl2().arg("graph").arg(path).args(["-o", "-"])));
    }
    for example in examples(&fs::read_to_string(root().join("docs/nets.md")).unwrap()) {
        let folder = example.folder();
        for entry in fs::read_dir(folder.path()).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|extension| extension == "net") {
                look(&path.display().to_string(), &check(pcl2().arg("graph").arg(&path).args(["-o", "-"])));
            }
        }
    }
    none(&complaints);
    assert!(drawn >= 8, "only {drawn} nets");
}

/// A net in PNML is drawn whole: each place and transition once, with the arcs that the file has.
#[test]
fn a_net_in_pnml_is_drawn() {
    for name in ["FMS-PT-00002", "SwimmingPool-PT-01"] {
        let file = root().join(format!("tests/nets/{name}.pnml"));
        let drawn = net_picture(&check(pcl2().arg("graph").arg(&file).args(["-o", "-"])));
        none(&faults(name, &drawn));
        none(&loose(name, &drawn));
        let net = pnml::read(&fs::read_to_string(&file).unwrap()).unwrap();
        assert_eq!(drawn.symbols.len(), net.places.len() + net.transitions.len(), "{name}");
        let arc = |gate: &str, kind: &'static str, arc: &Arc| {
            let place = &net.places[arc.place.0 as usize].name;
            let weight = if arc.weight == 1 { String::new() } else { format!("{}*", arc.weight) };
            (gate.to_owned(), kind, format!("{weight}{place}"))
        };
        let mut expected = Vec::new();
        for gate in &net.transitions {
            let lists = [("take", &gate.takes), ("put", &gate.puts), ("read", &gate.reads)];
            expected.extend(lists.iter().flat_map(|(kind, list)| list.iter().map(|of| arc(&gate.name, kind, of))));
        }
        let mut found = arcs(&drawn);
        [&mut expected, &mut found].into_iter().for_each(|arcs| arcs.sort());
        assert_eq!(found, expected, "{name}");
    }
}

const INNER: &str = "\
int lamp = inner ( int go : real wait = 1. )
ENTRY come
TIME rest wait DRIVES lamp
EXIT gone
GATE a : come -> rest
GATE b : rest -> gone
END
";

const OUTER: &str = "\
! Is a < b & \"c\"?
int lamp, int n = outer ( int go, int stop : )
CLASS job ( int kind = 1, real due = 2.5 )
STATE idle MARKED
MACRO work : lamp = inner ( go : wait = 3. )
ABORT stop AND NOT go -> idle
DO n = 0
MODULE side = inner ( go : )
CAPACITY store SIZE 7 MARKED 4
CAPACITY heap MARKED 23
CAPACITY queue OF job SIZE 3 ORDER least due MARKED ( kind = 7 )
GATE begin : idle, 2*store -> work READ side.come INHIBIT 3*heap PRIORITY 5 PERMIT go < 2, (go OR stop)
IF go > stop
DO n = n + 1
GATE end : work, queue -> idle, 2*store
END
";

#[test]
fn a_small_net_shows_all_it_has() {
    let folder = folder();
    fs::write(folder.path().join("inner.net"), INNER).unwrap();
    fs::write(folder.path().join("outer.net"), OUTER).unwrap();
    let svg = check(pcl2().current_dir(folder.path()).args(["graph", "outer.net", "-o", "-"]));
    let drawn = net_picture(&svg);
    none(&faults("outer", &drawn));
    none(&loose("outer", &drawn));
    // Both parts have one net: it is drawn once.
    assert_eq!(drawn.frames.len(), 1);
    let kinds: Vec<(&str, &str, usize)> =
        drawn.symbols.iter().map(|symbol| (symbol.name.as_str(), symbol.kind.as_str(), symbol.tokens)).collect();
    for symbol in [
        ("idle", "state", 1),
        ("work", "macro", 0),
        ("store", "capacity", 4),
        ("heap", "capacity", 0),
        ("come", "entry", 0),
        ("rest", "time", 0),
        ("gone", "exit", 0),
        ("begin", "bar", 0),
        ("ABORT", "abort", 0),
    ] {
        assert!(kinds.contains(&symbol), "{symbol:?} is not in {kinds:?}");
    }
    let texts: Vec<&str> = drawn.texts.iter().map(|(text, _)| text.as_str()).collect();
    for text in [
        "beginPRIORITY 5",
        "PERMIT go < 2, (go OR stop)",
        "IF go > stop",
        "DO n = n + 1",
        "ORDER least due",
        "MARKED ( kind = 7, due = 2.5 )",
        "TIME wait",
        "DRIVES lamp",
        "IF stop AND NOT go",
    ] {
        assert!(texts.contains(&text), "{text} is not in {texts:?}");
    }
    let tags: Vec<(&str, &str)> = drawn.tags.iter().map(|tag| (tag.kind.as_str(), tag.text.as_str())).collect();
    assert_eq!(tags, [("read", "side.come"), ("inhibit", "3*heap")]);
    assert!(svg.contains(">23</text>") && svg.contains(">∞</text>") && svg.contains("class='weight'"), "{svg}");
    assert!(svg.contains("Is a &lt; b &amp; &quot;c&quot;?"), "{svg}");
    for words in ["state", "macro, drawn in a frame", "reads", "is inhibited", "empties a macro"] {
        assert!(drawn.legend.iter().any(|known| known == words), "{words} is not in {:?}", drawn.legend);
    }
    assert!(!drawn.legend.iter().any(|known| known == "process"), "{:?}", drawn.legend);
}

/// Nets in nets in nets: what no picture has room for is left out, with its name.
#[test]
fn deep_nets_do_not_grow_without_bound() {
    let folder = folder();
    for depth in 0..14 {
        let mut text = format!("= d{depth} ( : )\nSTATE s MARKED\n");
        for i in depth + 1..14 {
            let _ = writeln!(text, "MODULE m{i} = d{i} ( : )");
        }
        let _ = writeln!(text, "GATE t : s -> s\nEND");
        fs::write(folder.path().join(format!("d{depth}.net")), text).unwrap();
    }
    let svg = check(pcl2().current_dir(folder.path()).args(["graph", "d0.net", "-o", "-"]));
    assert!(svg.contains("(in a picture of its own)"));
    assert!(net_picture(&svg).symbols.len() <= 2 * 4001);
}

#[test]
fn the_same_net_gives_the_same_bytes() {
    let text = generate(120, 5).text;
    assert_eq!(draw("random.net", &text), draw("random.net", &text));
}

#[test]
fn how_drawing_ends() {
    let folder = folder();
    fs::write(folder.path().join("inner.net"), INNER).unwrap();
    fs::write(folder.path().join("bad.net"), INNER.replace("inner", "bad").replace("-> rest", "-> reset")).unwrap();
    let graph = |source: &str, output: &str| {
        let output = run(pcl2().current_dir(folder.path()).args(["graph", source, "-o", output]));
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    assert_eq!(graph("inner.net", "inner.svg"), (Some(0), String::new()));
    assert!(Path::new(&folder.path().join("inner.svg")).is_file());
    let (code, said) = graph("bad.net", "bad.svg");
    assert!(code == Some(1) && said.contains("did you mean `rest`?"), "{said}");
    assert!(!folder.path().join("bad.svg").exists());
    let (code, said) = graph("inner.net", "inner.net");
    assert!(code == Some(1) && said.contains("expected another file than the source"), "{said}");
    let net = |tokens: u64| {
        let place = format!("<place id='p'><initialMarking><text>{tokens}</text></initialMarking></place>");
        let kind = "http://www.pnml.org/version-2009/grammar/ptnet";
        format!("<pnml><net id='n' type='{kind}'><page id='g'>{place}</page></net></pnml>")
    };
    fs::write(folder.path().join("n.pnml"), net(7)).unwrap();
    assert_eq!(graph("n.pnml", "n.svg"), (Some(0), String::new()));
    fs::write(folder.path().join("n.pnml"), net(1 << 40)).unwrap();
    let (code, said) = graph("n.pnml", "m.svg");
    assert!(code == Some(1) && said.contains("expected numbers of tokens up to 4294967295, found"), "{said}");
    fs::write(folder.path().join("n.pnml"), "<pnml>").unwrap();
    let (code, said) = graph("n.pnml", "m.svg");
    assert!(code == Some(1) && said.contains("n.pnml:1"), "{said}");
    assert!(!folder.path().join("m.svg").exists());
}

/// The pictures in `docs` are what the commands of the README and of the page on nets draw.
#[test]
fn the_pictures_in_docs_are_fresh() {
    let page = fences(&fs::read_to_string(root().join("docs/nets.md")).unwrap());
    let work = folder();
    for fence in &page {
        if let Some(file) = fence.file.as_ref().filter(|file| file.ends_with(".net")) {
            fs::write(work.path().join(file), &fence.text).unwrap();
        }
    }
    let tank = root().join("tests/nets/tank.net").display().to_string();
    let chart =
        page.iter().flat_map(|fence| fence.text.lines()).find(|line| line.ends_with("--plot chart.svg")).unwrap();
    let commands = [
        ("tank.svg", vec!["graph", &tank, "-o", "tank.svg"]),
        ("plant.svg", vec!["graph", "plant.net", "-o", "plant.svg"]),
        ("chart.svg", chart.split(' ').skip(1).collect()),
    ];
    for (name, args) in commands {
        check(pcl2().current_dir(work.path()).args(args));
        let drawn = fs::read_to_string(work.path().join(name)).unwrap();
        let kept = fs::read_to_string(root().join("docs").join(name)).unwrap_or_default();
        assert!(drawn == kept, "docs/{name} is stale: draw it anew with the command of the page");
    }
}
