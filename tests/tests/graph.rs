//! `pcl2 graph`: everything is there, nothing lies on anything else, the same program gives the same picture.

use pcl2_tests::cases;
use pcl2_tests::compilers::{check, folder};
use pcl2_tests::dice::Dice;
use pcl2_tests::picture::{Diagram, Piece, diagram, lies_on, overlap, runs_along, runs_through, touch};
use pcl2_tests::{none, pcl2, root, run};
use std::fmt::Write;
use std::fs;
use std::path::Path;

/// A generated program: its text, and how many ports read a signal.
struct Generated {
    text: String,
    blocks: usize,
    reads: usize,
}

/// A program of so many blocks in sections of different rates, with loops, vectors, words and constants.
fn generate(blocks: usize, sections: usize, seed: u64) -> Generated {
    let mut dice = Dice(seed);
    let mut generated = Generated { text: String::new(), blocks, reads: 0 };
    for i in 0..blocks {
        if i % blocks.div_ceil(sections) == 0 {
            let section = i / blocks.div_ceil(sections);
            let word = if section == 1 { "PLANT".to_owned() } else { format!("CONTROL {}", section + 1) };
            let _ = writeln!(generated.text, "{word}");
        }
        let mut pick = || {
            let near = i.checked_sub(1 + dice.below(9)).filter(|_| dice.below(12) > 0);
            near.unwrap_or_else(|| dice.below(blocks))
        };
        let (a, b) = (pick(), pick());
        // Words of the process image stand in CONTROL alone.
        let in_plant = i / blocks.div_ceil(sections) == 1;
        let (code, reads) = match if in_plant { 7 + dice.below(13) } else { dice.below(20) } {
            0..=3 => (format!("msc ( : {i}. )"), 0),
            4..=5 => (format!("ain ( : 0, {}, {i} )", seed % 7), 0),
            6 => (format!("aout ( v{a} : 1, 0, {i} )"), 1),
            7..=12 => (format!("first ( v{a} : 2., 0.25, )"), 1),
            _ => (format!("sumII ( 1, v{a}, v{b}, 2 : 1., -1. )"), 2),
        };
        let _ = writeln!(generated.text, "{} v{i} = {code}", i + 1);
        generated.reads += reads;
    }
    generated.text.push_str("END\n");
    generated
}

/// Draws a source text.
fn draw(text: &str, more: &[&str]) -> String {
    let folder = folder();
    fs::write(folder.path().join("program.cfg"), text).unwrap();
    check(pcl2().current_dir(folder.path()).args(["graph", "program.cfg", "-o", "-"]).args(more))
}

/// What must not be in a picture, whatever the program.
fn faults(name: &str, drawn: &Diagram) -> Vec<String> {
    let mut faults = Vec::new();
    let solid = || drawn.boxes.iter().chain(&drawn.marks);
    for (i, a) in solid().enumerate() {
        faults.extend(solid().skip(i + 1).filter(|b| overlap(a, b)).map(|b| format!("{name}: {a:?} lies on {b:?}")));
        let outside = a[0] < 0 || a[1] < 0 || a[2] > drawn.size.0 || a[3] > drawn.size.1;
        faults.extend(outside.then(|| format!("{name}: {a:?} lies outside")));
    }
    for (i, frame) in drawn.frames.iter().enumerate() {
        let others = drawn.frames[i + 1..].iter().filter(|other| overlap(frame, other));
        faults.extend(others.map(|other| format!("{name}: {frame:?} lies on {other:?}")));
    }
    for area in &drawn.boxes {
        let frames = drawn.frames.iter().filter(|frame| overlap(area, frame)).collect::<Vec<_>>();
        let inside =
            |frame: &[i32; 4]| frame[0] < area[0] && frame[1] < area[1] && area[2] < frame[2] && area[3] < frame[3];
        let framed = frames.len() == 1 && inside(frames[0]);
        faults.extend((!framed).then(|| format!("{name}: {area:?} lies in {frames:?}")));
    }
    for (i, (net, pieces)) in drawn.wires.iter().enumerate() {
        for piece in pieces {
            let along = drawn.frames.iter().filter(|frame| runs_along(piece, frame));
            faults.extend(along.map(|frame| format!("{name}: {net} runs along {frame:?} by {piece:?}")));
            let through = solid().filter(|area| runs_through(piece, area));
            faults.extend(through.map(|area| format!("{name}: {net} runs through {area:?} by {piece:?}")));
        }
        for (other, others) in &drawn.wires[i + 1..] {
            let touching = pieces.iter().flat_map(|a| others.iter().map(move |b| (a, b))).find(|(a, b)| touch(a, b));
            faults.extend(touching.map(|(a, b)| format!("{name}: {net} and {other} share {a:?} and {b:?}")));
        }
        faults.extend((!is_one(pieces)).then(|| format!("{name}: {net} is in pieces")));
    }
    faults.extend(drawn.ports.iter().filter(|port| !is_reached(drawn, **port)).map(|port| {
        let (x, y) = port.0;
        format!("{name}: nothing comes to the port at {x} {y}")
    }));
    faults
}

/// Whether all pieces hang together.
fn is_one(pieces: &[Piece]) -> bool {
    let mut reached = vec![false; pieces.len()];
    let mut open = vec![0];
    while let Some(at) = open.pop() {
        if !std::mem::replace(&mut reached[at], true) {
            open.extend((0..pieces.len()).filter(|other| !reached[*other] && touch(&pieces[at], &pieces[*other])));
        }
    }
    reached.into_iter().all(|reached| reached)
}

/// Whether a wire or a flag comes to a port, past the mark of a delay if there is one.
fn is_reached(drawn: &Diagram, ((x, y), side): ((i32, i32), i32)) -> bool {
    let at = |x: i32| {
        let wires = drawn.wires.iter().flat_map(|(_, pieces)| pieces);
        wires.into_iter().any(|piece| lies_on((x, y), piece)) || drawn.flags.contains(&(x, y))
    };
    let behind = drawn.marks.iter().find(|mark| {
        let near = if side < 0 { x - mark[2] } else { mark[0] - x };
        mark[1] < y && y < mark[3] && (0..20).contains(&near)
    });
    behind.map_or_else(|| at(x), |mark| at(if side < 0 { mark[0] } else { mark[2] }))
}

#[test]
fn nothing_lies_on_anything_else() {
    let mut complaints = Vec::new();
    for seed in 0..40 {
        let blocks = 4 + 7 * usize::try_from(seed).unwrap();
        let generated = generate(blocks, 1 + blocks % 4, seed);
        let drawn = diagram(&draw(&generated.text, &[]));
        complaints.extend(faults(&format!("seed {seed}"), &drawn));
        assert_eq!(drawn.boxes.len(), generated.blocks, "seed {seed}");
        assert_eq!(drawn.ports.len(), generated.reads, "seed {seed}");
    }
    none(&complaints);
}

#[test]
fn a_program_of_a_thousand_blocks_is_drawn() {
    let generated = generate(1000, 5, 9);
    let svg = draw(&generated.text, &[]);
    let drawn = diagram(&svg);
    none(&faults("1000", &drawn));
    assert_eq!((drawn.boxes.len(), drawn.ports.len()), (generated.blocks, generated.reads));
    assert!(svg.len() < 2_000_000, "{} bytes", svg.len());
}

/// All hang together: cut into sheets, it is drawn in no time.
#[test]
fn a_tangle_is_cut_into_sheets() {
    let mut dice = Dice(3);
    let mut text = "CONTROL\n".to_owned();
    for i in 0..1000 {
        let (a, b) = (dice.below(1000), dice.below(1000));
        let _ = writeln!(text, "{} v{i} = sumII ( 1, v{a}, v{b}, 2 : 1., 1. )", i + 1);
    }
    text.push_str("END\n");
    let drawn = diagram(&draw(&text, &[]));
    none(&faults("tangle", &drawn));
    assert_eq!((drawn.boxes.len(), drawn.ports.len()), (1000, 2000));
}

#[test]
fn examples_are_drawn_without_faults() {
    let mut complaints = Vec::new();
    for path in ["gpc", "selftuner", "paper/listing1.cfg", "paper/listing2.cfg"] {
        let drawn = check(pcl2().arg("graph").arg(root().join("examples").join(path)).args(["-o", "-"]));
        complaints.extend(faults(path, &diagram(&drawn)));
    }
    none(&complaints);
}

#[test]
fn golden_cases_are_drawn_without_faults() {
    let mut complaints = Vec::new();
    let mut drawn = 0;
    for case in cases::all() {
        let output = run(case.command("graph").args(["-o", "-"]));
        if output.status.success() {
            complaints.extend(faults(&case.name, &diagram(&String::from_utf8_lossy(&output.stdout))));
            drawn += 1;
        }
    }
    assert!(drawn > 40, "only {drawn} pictures");
    none(&complaints);
}

const LOOP: &str = "\
INITIALIZE
1 p = setvec ( 2 : 1., 2. )
PLANT
2 y = first ( u : 1., 1., )
CONTROL
3 w = msc ( : 5. )
4 e = sumII ( 1, w, y, 2 : 1., -1. )
5 u = sumII ( 1, e, p[2], 2 : 2., 0. )
CONTROL 10 3
6 x = ain ( : 0, 1, 2 )
7 o = aout ( x : 0, 1, 3 )
END
";

#[test]
fn a_small_program_shows_all_it_has() {
    let drawn = diagram(&draw(LOOP, &["--period", "0.5"]));
    none(&faults("loop", &drawn));
    let nets: Vec<&str> = drawn.wires.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(nets, ["p: vec[2]", "y: real", "w: real", "e: real", "u: real", "x: real"]);
    assert_eq!(drawn.delays, 1);
    let texts: Vec<&str> = drawn.texts.iter().map(|(text, ..)| text.as_str()).collect();
    for text in [
        "program, 7 blocks",
        "INITIALIZE, once",
        "PLANT, every 0.5 s",
        "CONTROL, every 0.5 s",
        "CONTROL, every 5 s, first at scan 3",
        "4 e",
        "sumII",
        "p1=1 p2=-1",
        "[2]",
        "z-1",
        "ain(0,1,2)",
        "aout(0,1,3)",
    ] {
        assert!(texts.contains(&text), "{text} is not in {texts:?}");
    }
}

#[test]
fn the_forward_path_runs_to_the_right_and_return_wires_against_it() {
    let blocks = folder();
    let ctl = "real u, vec[2] bk = ctl ( cell real w = 0., real y, vec[2] back = 0. : )\n";
    fs::write(blocks.path().join("ctl.fc"), ctl).unwrap();
    fs::write(blocks.path().join("ctl.c"), "\n").unwrap();
    let text = "CONTROL\n1 x = ain ( : 0, 1, 1 )\n2 A = ctl ( , x, B.bk : )\n3 B = ctl ( A, x : )\nEND\n";
    let svg = draw(text, &["--blocks", &blocks.path().display().to_string()]);
    let drawn = diagram(&svg);
    none(&faults("cascade", &drawn));
    assert!(svg.contains("<path class='wire return'"), "{svg}");
    let [x, outer, inner] = drawn.boxes.as_slice() else {
        panic!("{:?}", drawn.boxes);
    };
    assert!(x[2] < outer[0] && outer[2] < inner[0], "{:?}", drawn.boxes);
    // It leaves the second controller on its left and comes to the first one on its right.
    assert!(drawn.ports.iter().any(|((at, _), side)| *at == outer[2] && *side == 1), "{:?}", drawn.ports);
}

#[test]
fn a_net_is_a_block_and_its_boxes_are_read_by_name() {
    let blocks = folder();
    fs::write(blocks.path().join("two.net"), "= two ( : )\nSTATE off MARKED\nSTATE on\nGATE g : off -> on\nEND\n")
        .unwrap();
    let text = "CONTROL\n1 N = two ( : )\n2 y = not ( N.on : )\nEND\n";
    let drawn = diagram(&draw(text, &["--blocks", &blocks.path().display().to_string()]));
    none(&faults("net", &drawn));
    assert_eq!(drawn.boxes.len(), 2);
    assert!(drawn.texts.iter().any(|(text, ..)| text == "on"), "{:?}", drawn.texts);
}

#[test]
fn the_same_program_gives_the_same_bytes() {
    let text = generate(150, 3, 5).text;
    assert_eq!(draw(&text, &[]), draw(&text, &[]));
}

#[test]
fn names_that_xml_would_take_for_itself_are_escaped() {
    let blocks = folder();
    let declaration = "! Is a < b & c > \"d\"?\nreal y = less ( real a : real k = 1. )\n";
    fs::write(blocks.path().join("less.fc"), declaration).unwrap();
    fs::write(blocks.path().join("less.c"), "\n").unwrap();
    let text = "CONTROL\n1 a = msc ( : 1. )\n2 b = less ( a : )\nEND\n";
    let svg = draw(text, &["--blocks", &blocks.path().display().to_string()]);
    assert_eq!(diagram(&svg).boxes.len(), 2);
    assert!(svg.contains("Is a &lt; b &amp; c &gt; &quot;d&quot;?"), "{svg}");
}

#[test]
fn how_drawing_ends() {
    let folder = folder();
    fs::write(folder.path().join("good.cfg"), LOOP).unwrap();
    fs::write(folder.path().join("bad.cfg"), LOOP.replace("first", "frist")).unwrap();
    let graph = |source: &str, output: &str| {
        let output = run(pcl2().current_dir(folder.path()).args(["graph", source, "-o", output]));
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    assert_eq!(graph("good.cfg", "good.svg"), (Some(0), String::new()));
    assert!(Path::new(&folder.path().join("good.svg")).is_file());
    let (code, said) = graph("bad.cfg", "bad.svg");
    assert!(code == Some(1) && said.contains("did you mean `first`?"), "{said}");
    let (code, said) = graph("good.cfg", "no/good.svg");
    assert_eq!((code, said.as_str()), (Some(3), "error: cannot write `no/good.svg`: there is no such folder\n"));
    assert_eq!(run(pcl2().arg("graph").arg("good.cfg")).status.code(), Some(2));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 3, "a failed command left something");
}

/// `docs/gpc.svg` is what the README's command draws.
#[test]
fn the_picture_in_docs_is_fresh() {
    let drawn = check(pcl2().arg("graph").arg(root().join("examples/gpc")).args(["-o", "-"]));
    let kept = fs::read_to_string(root().join("docs/gpc.svg")).unwrap_or_default();
    assert!(drawn == kept, "run `pcl2 graph examples/gpc -o docs/gpc.svg`");
}
