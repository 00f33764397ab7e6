//! `pcl2 net report`: what is written of a net, and that it can be read.

use pcl2_tests::compilers::{check, folder};
use pcl2_tests::fences::examples;
use pcl2_tests::{none, pcl2, root, run};
use roxmltree::{Document, Node, ParsingOptions};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// The report on a net: the folder with it.
fn report(path: &Path, more: &[&str]) -> TempDir {
    let folder = folder();
    let said = check(pcl2().args(["net", "report"]).arg(path).arg("-o").arg(folder.path()).args(more));
    assert_eq!(said, "");
    folder
}

fn read(folder: &TempDir, name: &str) -> String {
    fs::read_to_string(folder.path().join(name)).expect(name)
}

fn text(node: Node<'_, '_>) -> String {
    node.descendants()
        .filter_map(|part| if part.has_tag_name("br") { Some("\n") } else { part.text().filter(|_| part.is_text()) })
        .collect()
}

/// By title of a section of the HTML: its paragraphs and code, and the rows of its tables.
type Sections = BTreeMap<String, (Vec<String>, Vec<Vec<String>>)>;

fn sections(html: &str) -> Sections {
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    let document = Document::parse_with_options(html, options).expect("well-formed elements");
    let main = document.descendants().find(|node| node.has_tag_name("main")).expect("main");
    let (mut sections, mut title) = (Sections::new(), String::new());
    for node in main.children().filter(Node::is_element) {
        let section = sections.entry(title.clone()).or_default();
        match node.tag_name().name() {
            "h1" | "h2" | "h3" => title = text(node),
            "p" | "pre" => section.0.push(text(node)),
            "table" => {
                let rows = node.descendants().filter(|row| row.has_tag_name("tr")).skip(1);
                section.1.extend(rows.map(|row| row.children().map(text).collect()));
            }
            "figure" => section.0.push(node.descendants().filter(|node| node.has_tag_name("svg")).count().to_string()),
            "nav" => {}
            other => panic!("{other}"),
        }
    }
    sections.entry(title).or_default();
    sections
}

fn column(sections: &Sections, title: &str, index: usize) -> Vec<String> {
    sections.get(title).unwrap_or_else(|| panic!("{title}")).1.iter().map(|row| row[index].clone()).collect()
}

/// Jeong and Yang name the modules of their tank: in each of these loops circulates one token.
#[test]
fn the_measuring_tank_has_its_devices() {
    let folder = report(&root().join("tests/nets/tank.net"), &[]);
    let html = read(&folder, "tank.html");
    let found = sections(&html);
    let loops = [
        "S0 + S1 + S2 + S3 + S4 + S5 + S6",
        "P0 + P1",
        "L1 + L0",
        "V10 + V11",
        "V20 + V21",
        "Z10 + Z11 + Z12",
        "D10 + D11",
        "D21 + D20",
    ];
    assert_eq!(column(&found, "Cycles of devices", 0), loops);
    assert_eq!(column(&found, "Cycles of devices", 1), ["1"; 8]);
    let mut fired: Vec<String> = column(&found, "Cycles of firings", 0)
        .iter()
        .flat_map(|sum| sum.split(" + ").map(str::to_owned).collect::<Vec<_>>())
        .collect();
    let mut gates = column(&found, "Gates, in the order in which a scan tries them", 0);
    fired.sort();
    gates.sort();
    assert_eq!(fired, gates, "each transition is in one cycle");
    assert_eq!(column(&found, "Boxes", 0).len(), 22);
    assert_eq!(found["Conflicts"].1, [["Z11", "tokens", "tz10, tz13"]]);
    assert_eq!(found["Picture"].0, ["1"]);
    let matrix = &found["Incidence matrix"].0[1];
    let sums = matrix.lines().skip(1).map(|line| line.split_whitespace().filter(|entry| *entry == "1").count());
    assert_eq!(sums.sum::<usize>(), 23, "each transition marks one place");
}

/// The Markdown says what the HTML says, and its picture stands beside it.
#[test]
fn both_notations_say_the_same() {
    for net in ["tank", "agv"] {
        let folder = report(&root().join(format!("tests/nets/{net}.net")), &[]);
        let (markdown, html) = (read(&folder, &format!("{net}.md")), read(&folder, &format!("{net}.html")));
        let titles = markdown.lines().filter_map(|line| line.strip_prefix("## ")).collect::<Vec<_>>();
        for (title, (_, rows)) in sections(&html).iter().filter(|(title, _)| !title.is_empty() && *title != net) {
            assert!(titles.contains(&title.as_str()), "{title} is not in {titles:?}");
            for row in rows {
                let cells: Vec<&str> =
                    row.iter().flat_map(|cell| cell.split('\n')).filter(|line| !line.is_empty()).collect();
                let line = markdown.lines().find(|line| {
                    line.starts_with('|') && cells.iter().all(|cell| line.replace('\\', "").contains(cell))
                });
                assert!(line.is_some(), "{row:?} is not in the Markdown of {net}");
            }
        }
        assert!(markdown.contains(&format!("![{net}]({net}.svg)")), "{markdown}");
        let picture = read(&folder, &format!("{net}.svg"));
        let drawn = check(pcl2().arg("graph").arg(root().join(format!("tests/nets/{net}.net"))).args(["-o", "-"]));
        assert!(picture == drawn && html.contains(&picture), "the picture of {net}");
    }
}

/// The lines on which a name stands, found by looking at the text alone.
fn lines_of(source: &str, name: &str) -> BTreeSet<usize> {
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let stands = |line: &str| {
        let code = line.split('!').next().unwrap();
        code.match_indices(name).any(|(at, _)| {
            let before = code[..at].chars().next_back();
            let after = &code[at + name.len()..];
            let whole = !before.is_some_and(|c| is_word(c) || c == '.') && !after.starts_with(is_word);
            let typed = code[..at].trim_end().ends_with("int") || code[..at].trim_end().ends_with("real");
            let label = !typed && after.trim_start().starts_with('=') && !after.trim_start().starts_with("==");
            whole && !after.trim_start().starts_with('(') && !(label && code[..at].contains('('))
        })
    };
    source.lines().enumerate().filter(|(_, line)| stands(line)).map(|(i, _)| i + 1).collect()
}

/// Declared, read and written: together these are the lines on which a name stands. Attributes and classes that are
/// called as something else are no names of the net.
#[test]
fn the_cross_reference_knows_every_line() {
    let mut nets = vec![root().join("tests/nets/tank.net"), root().join("tests/nets/agv.net")];
    let page = examples(&fs::read_to_string(root().join("docs/nets.md")).unwrap());
    let folders: Vec<_> = page.iter().map(|example| example.folder()).collect();
    for name in ["fill.net", "cars.net", "plant.net"] {
        nets.extend(folders.iter().map(|folder| folder.path().join(name)).filter(|path| path.is_file()).take(1));
    }
    let mut wrong = Vec::new();
    let mut names = 0;
    for path in &nets {
        let stem = path.file_stem().unwrap().to_string_lossy().into_owned();
        let source = fs::read_to_string(path).unwrap();
        let found = sections(&read(&report(path, &[]), &format!("{stem}.html")));
        // Of a net with nets inside it the last table is that of the last net.
        if stem == "plant" {
            continue;
        }
        for row in &found["Cross-reference"].1 {
            let listed: BTreeSet<usize> =
                row[2..].iter().flat_map(|cell| cell.split(", ")).filter_map(|line| line.parse().ok()).collect();
            let stands = lines_of(&source, &row[0]);
            if listed != stands {
                wrong.push(format!("{stem}: {} is listed on {listed:?} and stands on {stands:?}", row[0]));
            }
            names += 1;
        }
    }
    none(&wrong);
    assert!(names > 50, "only {names} names");
}

const NET: &str = "\
! Is a < b & \"c\"? <script>alert(1)</script>
!
! A second paragraph | with *stars*.
int lamp, real y \"degC\", int n = odd ( int start, real level \"m\" from 0 to 3, cell int stop = 0 : real wait = 2. \"s\" from 0 to 60 )
START y = 1.5
MOMENTARY stop
LOCAL int count = 3
CLASS job ( int kind = 1, real due = 2.5 \"s\" )
STATE idle MARKED DRIVES lamp
TIME work wait
CAPACITY queue OF job SIZE 3 MARKED ( kind = 7 ) ORDER most due
GATE go : idle -> work PERMIT level < 2., (start OR NOT stop) INHIBIT 3*queue
DO y = level*2.
GATE back : work -> idle PRIORITY -2
IF stop
DO n, count = 1, 2
ELSE
DO n = count
END
";

#[test]
fn a_report_has_all_that_the_net_says() {
    let folder = folder();
    let net = NET.replace("DO n, count = 1, 2\n", "DO n = n + 1\nDO count = n\n");
    fs::write(folder.path().join("odd.net"), net).unwrap();
    let toml = "[controller]\nsource = \"odd.net\"\nperiod = 0.5\n[io]\nstart = { point = \"DI 3\" }\nlamp = { point = \"DO 1\" }\nlevel = { point = \"AI <1>\", raw = [0, 100], range = [0, 3] }\n";
    fs::write(folder.path().join("pcl2.toml"), toml).unwrap();
    let out = report(folder.path(), &[]);
    let html = read(&out, "odd.html");
    assert!(!html.contains("<script"), "{html}");
    let found = sections(&html);
    assert_eq!(
        found["odd"].0[..2],
        ["Is a < b & \"c\"? <script>alert(1)</script>", "A second paragraph | with *stars*."]
    );
    assert_eq!(
        found["Inputs"].1,
        [
            ["start", "int", "", "", "", "DI 3", ""],
            ["level", "real", "m", "", "from 0 to 3", "AI <1>\n0.03*raw + 0.0", ""],
            ["stop", "int", "", "0", "", "", "command: the gate that reads it clears it"],
        ]
    );
    assert_eq!(
        found["Outputs"].1,
        [
            ["lamp", "int", "", "0", "1 while idle is marked", "DO 1"],
            ["y", "real", "degC", "1.5", "statements", ""],
            ["n", "int", "", "0", "statements", ""],
        ]
    );
    assert_eq!(found["Parameters"].1, [["wait", "real", "s", "2.", "from 0 to 60"]]);
    assert_eq!(found["Locals"].1, [["count", "int", "3", "statements"]]);
    assert_eq!(found["Classes of tokens"].1, [["job", "kind", "int", "1", ""], ["job", "due", "real", "2.5", "s"]]);
    assert_eq!(
        found["Boxes"].1[2],
        ["queue", "CAPACITY", "3", "1", "OF job\nORDER most due\nMARKED ( kind = 7, due = 2.5 )", "", "11"]
    );
    let gates = &found["Gates, in the order in which a scan tries them"].1;
    let go = "PERMIT level < 2., (start OR NOT stop)\nDO y = level*2.";
    assert_eq!(gates[0], ["go", "idle", "work", "3*queue", "", go, "12"]);
    assert_eq!(
        gates[1],
        ["back", "work", "idle", "", "-2", "IF stop\nDO n = n + 1\nDO count = n\nELSE\nDO n = count", "14"]
    );
    let names = &found["Cross-reference"].1;
    let row = |name: &str| names.iter().find(|row| row[0] == name).unwrap_or_else(|| panic!("{name}"))[1..].to_vec();
    assert_eq!(row("count"), ["local", "7", "19", "17"]);
    assert_eq!(row("n"), ["output", "4", "16, 17", "16, 19"]);
    assert_eq!(row("y"), ["output", "4", "", "5, 13"]);
    assert_eq!(row("stop"), ["input", "4", "6, 12, 15", ""]);
    let markdown = read(&out, "odd.md");
    assert!(markdown.contains("A second paragraph \\| with \\*stars\\*."), "{markdown}");
    assert!(markdown.contains("Is a \\< b \\& \"c\"? \\<script\\>"), "{markdown}");
}

/// What stands inside is reported, too, with the whole as one net.
#[test]
fn nets_inside_are_reported() {
    let page = examples(&fs::read_to_string(root().join("docs/nets.md")).unwrap());
    let folders: Vec<_> = page.iter().map(|example| example.folder()).collect();
    let path = folders.iter().map(|folder| folder.path().join("plant.net")).find(|path| path.is_file()).unwrap();
    let out = report(&path, &[]);
    let markdown = read(&out, "plant.md");
    for line in ["## Net dose", "It stands in dose.net, and in this net as D of plant.", "## Net valve"] {
        assert!(markdown.lines().any(|known| known == line), "{line} is not in {markdown}");
    }
    let found = sections(&read(&out, "plant.html"));
    let devices = column(&found, "Cycles of devices", 0);
    assert!(devices.contains(&"idle + held + D".to_owned()) && devices.contains(&"V.shut + V.open".to_owned()));
    let parts = &found["Macros and modules"].1;
    assert_eq!(parts[0][2], "MACRO D : wanted = dose ( : length = 2. )\nABORT stop -> idle\nDO doses = 0");
}

#[test]
fn the_same_net_gives_the_same_bytes_from_any_folder() {
    let [first, second] = [folder(), folder()];
    let read_all = |place: &TempDir| {
        fs::copy(root().join("tests/nets/agv.net"), place.path().join("agv.net")).unwrap();
        let out = report(&place.path().join("agv.net"), &[]);
        ["agv.html", "agv.md", "agv.svg"].map(|name| read(&out, name))
    };
    assert_eq!(read_all(&first), read_all(&second));
}

#[test]
fn how_reporting_ends() {
    let folder = folder();
    fs::write(folder.path().join("main.cfg"), "CONTROL\n1 a = msc ( : 1. )\nEND\n").unwrap();
    fs::write(folder.path().join("bad.net"), "= bad ( : )\nSTATE a\nGATE g : a -> c\nEND\n").unwrap();
    fs::write(folder.path().join("good.net"), "= good ( : )\nSTATE a\nGATE g : a ->\nEND\n").unwrap();
    fs::write(folder.path().join("file"), "").unwrap();
    let ended = |source: &str, out: &str| {
        let output = run(pcl2().current_dir(folder.path()).args(["net", "report", source, "-o", out]));
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    let (code, said) = ended("main.cfg", "out");
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("expected a net, found a configuration"), "{said}");
    let (code, said) = ended("bad.net", "out");
    assert!(code == Some(1) && said.contains("found `c`"), "{said}");
    assert!(!folder.path().join("out").exists());
    let (code, said) = ended("good.net", "file/out");
    assert!(code == Some(3) && said.starts_with("error: cannot write `file/out`"), "{said}");
    assert_eq!(ended("good.net", "new/out"), (Some(0), String::new()));
    assert_eq!(fs::read_dir(folder.path().join("new/out")).unwrap().count(), 3);
}
