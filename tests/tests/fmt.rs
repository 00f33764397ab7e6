//! `pcl2 fmt`: the layout changes, the meaning does not.

use pcl2_cfg::{Input, Options, Tunable};
use pcl2_lang::catalogue::Catalogue;
use pcl2_lang::declare;
use pcl2_lang::diagnostic::Diagnostic;
use pcl2_lang::format::{format, format_net};
use pcl2_lang::source::Sources;
use pcl2_lang::symbol::Symbols;
use pcl2_lang::syntax;
use pcl2_lang::types::Width;
use pcl2_tests::compilers::{files, folder};
use pcl2_tests::fences::{fences, section};
use pcl2_tests::{cases, none, pcl2, root, run};
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The sources of all cases, examples and benchmarks.
fn sources() -> Vec<PathBuf> {
    let folders = ["tests/cases", "examples", "bench"];
    let found: Vec<PathBuf> = folders.iter().flat_map(|name| files(&root().join(name), "cfg")).collect();
    assert!(found.len() > 60, "only {} sources", found.len());
    found
}

/// What a text means, without places; `None` when it has errors. Blocks of the catalogue only.
fn meaning(bytes: &[u8]) -> Option<String> {
    let (mut sources, mut symbols, mut diagnostics) = (Sources::default(), Symbols::default(), Vec::new());
    let catalogue = Catalogue::packed(&mut sources, &mut symbols, &mut diagnostics);
    let file = sources.add("a.cfg", bytes.to_vec());
    let tree = syntax::parse(&sources, file, &mut symbols, &mut diagnostics);
    let options = Options {
        name: "a".to_owned(),
        period: Some(100_000_000),
        width: Width::F64,
        plant: Vec::new(),
        substeps: 1,
        tunable: Tunable::All,
    };
    let input = Input {
        sources: &sources,
        file,
        tree: &tree,
        symbols: &symbols,
        catalogue: &catalogue,
        files: &FxHashMap::default(),
        options: &options,
        alone: None,
    };
    let program = pcl2_cfg::compile(&input, &mut diagnostics)?;
    if diagnostics.iter().any(Diagnostic::is_error) {
        return None;
    }
    let (units, sections) = (&program.units, &program.sections);
    Some(without_places(&format!("{units:?} {sections:?} {:?} {:?}", program.images, program.delays)))
}

fn without_places(text: &str) -> String {
    let mut parts = text.split("Span {");
    let first = parts.next().unwrap_or_default().to_owned();
    first + &parts.map(|part| part.split_once('}').map_or(part, |(_, rest)| rest)).collect::<String>()
}

fn formatted(bytes: &[u8]) -> Option<Vec<u8>> {
    let (mut sources, mut diagnostics) = (Sources::default(), Vec::new());
    let file = sources.add("a.cfg", bytes.to_vec());
    syntax::parse(&sources, file, &mut Symbols::default(), &mut diagnostics);
    let clean = !diagnostics.iter().any(Diagnostic::is_error);
    clean.then(|| format(sources.file(file)).expect("a source without mistakes has a layout"))
}

/// Complains when the layout is not stable, or means something else.
fn judge(name: &str, bytes: &[u8], complaints: &mut Vec<String>) -> bool {
    let Some(once) = formatted(bytes) else {
        return false;
    };
    if formatted(&once).as_deref() != Some(&once) {
        complaints.push(format!("{name}: not stable:\n{}", String::from_utf8_lossy(&once)));
    }
    if meaning(bytes) != meaning(&once) {
        complaints.push(format!("{name}: another meaning:\n{}", String::from_utf8_lossy(bytes)));
    }
    true
}

#[test]
fn every_source_keeps_its_meaning() {
    let mut complaints = Vec::new();
    let judged = sources().into_iter().filter(|path| judge(&path.display().to_string(), &read(path), &mut complaints));
    assert!(judged.count() > 40);
    none(&complaints);
}

/// Numbers without much order, the same in every run.
struct Noise(u64);

impl Noise {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % end.max(1)
    }
}

/// A text with a few changes, mostly of blanks, line ends and comments.
fn mutated(bytes: &[u8], noise: &mut Noise) -> Vec<u8> {
    const PUT: [&[u8]; 12] =
        [b" ", b"\t", b"\n", b"\r\n", b"\n\n\n", b" ! \xb0\xa1x \n", b"!\r", b", ", b"  -", b"a", b".", b"\n  ! y\n"];
    let mut bytes = bytes.to_vec();
    for _ in 0..=noise.below(4) {
        // Most line ends can only stand behind punctuation.
        let start = noise.below(bytes.len());
        let at =
            bytes[start..].iter().position(|byte| b",():\n ".contains(byte)).map_or(start, |found| start + found + 1);
        match noise.below(8) {
            0 => drop(bytes.remove(start)),
            1 => bytes.splice(start..start, PUT[noise.below(PUT.len())].iter().copied()).for_each(drop),
            _ => bytes.splice(at..at, PUT[noise.below(PUT.len())].iter().copied()).for_each(drop),
        }
    }
    bytes
}

#[test]
fn changed_sources_keep_their_meaning() {
    let mut noise = Noise(1);
    let mut complaints = Vec::new();
    let mut judged = 0;
    for path in sources().iter().filter(|path| path.metadata().is_ok_and(|data| data.len() < 4000)) {
        let bytes = read(path);
        for _ in 0..12 {
            judged += usize::from(judge(&path.display().to_string(), &mutated(&bytes, &mut noise), &mut complaints));
        }
    }
    assert!(judged > 150, "only {judged} could be judged");
    none(&complaints);
}

#[test]
fn the_examples_are_laid_out_so() {
    let examples = files(&root().join("examples"), "cfg");
    let ours = examples.iter().filter(|path| !path.display().to_string().contains("/paper/"));
    none(
        &ours
            .filter(|path| formatted(&read(path)) != Some(read(path)))
            .map(|path| format!("{path:?}"))
            .collect::<Vec<_>>(),
    );
}

#[test]
fn so_is_the_example_of_the_page() {
    let page = fs::read_to_string(root().join("docs/language.md")).unwrap();
    let examples = fences(section(&page, "Layout").unwrap());
    assert_eq!(examples.len(), 1);
    assert_eq!(formatted(examples[0].text.as_bytes()).as_deref(), Some(examples[0].text.as_bytes()));
}

/// What the lines of a net say, without places; `None` when it has errors.
fn lines_of_net(bytes: &[u8]) -> Option<String> {
    let (mut sources, mut diagnostics) = (Sources::default(), Vec::new());
    let file = sources.add("a.net", bytes.to_vec());
    let read = declare::net::read(&sources, file, "a", &mut Symbols::default(), &mut diagnostics)?;
    // Another name than the file's is no mistake of syntax.
    let clean = diagnostics.iter().filter(|diagnostic| diagnostic.is_error()).count() <= 1;
    (clean && !read.lines.is_empty())
        .then(|| without_places(&format!("{:?} {:?} {}", read.decl, read.lines, read.sound)))
}

fn formatted_net(bytes: &[u8]) -> Vec<u8> {
    let mut sources = Sources::default();
    let file = sources.add("a.net", bytes.to_vec());
    format_net(sources.file(file)).expect("a net without mistakes has a layout")
}

/// Complains when the layout of a net is not stable, or says something else.
fn judge_net(name: &str, bytes: &[u8], complaints: &mut Vec<String>) -> bool {
    let Some(before) = lines_of_net(bytes) else {
        return false;
    };
    let once = formatted_net(bytes);
    let shown = String::from_utf8_lossy(&once);
    let twice = formatted_net(&once);
    if twice != once {
        let again = String::from_utf8_lossy(&twice);
        let lines = shown.lines().zip(again.lines()).find(|(first, second)| first != second);
        complaints.push(format!("{name}: not stable, {lines:?}:\n{shown}"));
    }
    if lines_of_net(&once) != Some(before) {
        complaints.push(format!("{name}: another meaning:\n{}\n{shown}", String::from_utf8_lossy(bytes)));
    }
    true
}

/// The nets in files and on pages, with their names.
fn nets() -> Vec<(String, Vec<u8>)> {
    let mut nets = Vec::new();
    for folder in ["tests", "examples", "docs"] {
        let found = files(&root().join(folder), "net");
        nets.extend(found.iter().map(|path| (path.display().to_string(), read(path))));
    }
    for page in files(&root().join("docs"), "md") {
        let text = fs::read_to_string(&page).unwrap();
        let named = fences(&text).into_iter().filter(|fence| fence.file.as_ref().is_some_and(|n| n.ends_with(".net")));
        nets.extend(named.map(|fence| (format!("{}:{}", page.display(), fence.line), fence.text.into_bytes())));
    }
    assert!(nets.len() > 20, "only {} nets", nets.len());
    nets
}

#[test]
fn every_net_keeps_its_lines() {
    let mut complaints = Vec::new();
    let judged = nets().iter().filter(|(name, bytes)| judge_net(name, bytes, &mut complaints)).count();
    assert!(judged > 15, "only {judged}");
    none(&complaints);
}

#[test]
fn changed_nets_keep_their_lines() {
    let mut noise = Noise(2);
    let mut complaints = Vec::new();
    let mut judged = 0;
    for (name, bytes) in nets() {
        for _ in 0..60 {
            judged += usize::from(judge_net(&name, &mutated(&bytes, &mut noise), &mut complaints));
        }
    }
    assert!(judged > 150, "only {judged} could be judged");
    none(&complaints);
}

/// The nets of the page on nets, of the examples and of the tests stand in the layout, but for those that a generator
/// writes.
#[test]
fn nets_are_laid_out_so() {
    let made = ["agv_system/agv.net", "agv_system/agvs.net", "agv_system/travel.net"];
    let hand = |name: &str| !made.iter().any(|made| name.ends_with(made));
    let ours =
        nets().into_iter().filter(|(name, _)| (name.contains("nets.md") || name.ends_with(".net")) && hand(name));
    none(&ours.filter(|(_, bytes)| formatted_net(bytes) != *bytes).map(|(name, _)| name).collect::<Vec<_>>());
}

#[test]
fn gates_are_aligned_and_lists_keep_their_blanks() {
    let loose = "int y=a(cell int go=0:real t=2.)  ! head
MOMENTARY go
CLASS job(int kind=0,real due)
STATE one OF job MARKED(kind=1)
FOR i=1 TO 2
STATE  s[i]
NEXT
GATE a:one->nowhere IF NOT(x+1>=2)
THEN one->nothing
GATE  longer :2*one , s[ 1 ]-> READ s[i + 1],2*F.b PRIORITY -1
GATE b:->one

DO y=code(a,b:1.)
GATE c : one -> PERMIT go==1,(a OR
  b)
END  ! rest
";
    let expected = "int y = a ( cell int go = 0 : real t = 2. )  ! head
MOMENTARY go
CLASS job ( int kind = 0, real due )
STATE one OF job MARKED ( kind = 1 )
FOR i = 1 TO 2
STATE s[i]
NEXT
GATE a      : one -> nowhere  IF NOT (x + 1 >= 2)
THEN one -> nothing
GATE longer : 2*one, s[1] ->  READ s[i+1], 2*F.b PRIORITY -1
GATE b      : -> one

DO y = code ( a, b : 1. )
GATE c : one ->  PERMIT go == 1, (a OR b)
END  ! rest
";
    assert_eq!(String::from_utf8_lossy(&formatted_net(loose.as_bytes())), expected);
    assert_eq!(String::from_utf8_lossy(&formatted_net(expected.as_bytes())), expected);
}

#[test]
fn a_net_is_laid_out_by_the_command_and_refused_with_a_mistake() {
    let folder = folder();
    let path = folder.path().join("a.net");
    let fmt = |args: &[&str], text: &str| {
        fs::write(&path, text).unwrap();
        let output = run(pcl2().arg("fmt").args(args).arg("a.net").current_dir(folder.path()));
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        (output.status.code().unwrap(), said, fs::read_to_string(&path).unwrap())
    };
    let (loose, tidy) = ("=a( : )\nSTATE s   MARKED\nEND\n", "= a ( : )\nSTATE s MARKED\nEND\n");
    assert_eq!(fmt(&[], loose), (0, String::new(), tidy.to_owned()));
    assert_eq!(fmt(&["--check"], loose), (1, "a.net would change\n".to_owned(), loose.to_owned()));
    assert_eq!(fmt(&["--check"], tidy), (0, String::new(), tidy.to_owned()));
    for wrong in ["= a ( : )\nSTATE MARKED\nEND\n", "= a ( : )\nSTATE s MARKED\n", "= a (\nEND\n"] {
        let (status, said, text) = fmt(&[], wrong);
        assert!(status == 1 && said.starts_with("error[P0"), "{said}");
        assert_eq!(text, wrong);
    }
    let (status, said, _) = fmt(&["--renumber"], tidy);
    assert!(status == 1 && said.contains("leave --renumber off"), "{said}");
}

fn read(path: &Path) -> Vec<u8> {
    fs::read(path).unwrap()
}

/// The columns of a trace by name, without outputs that have none.
fn columns(trace: &str) -> BTreeMap<String, Vec<String>> {
    let mut reader = csv::Reader::from_reader(trace.as_bytes());
    let headers: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let mut columns: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for row in reader.records() {
        for (header, cell) in headers.iter().zip(row.unwrap().iter()) {
            columns.entry(header.clone()).or_default().push(cell.to_owned());
        }
    }
    columns.retain(|name, _| !name.starts_with(|first: char| first.is_ascii_digit()));
    columns
}

#[test]
fn new_numbers_give_the_same_trace() {
    let mut complaints = Vec::new();
    let mut compared = 0;
    for case in
        cases::all().into_iter().filter(|case| !case.has_own_c() && !case.config.args.contains(&"--plant".into()))
    {
        let folder = folder();
        let copied = run(std::process::Command::new("cp").arg("-r").arg(&case.folder).arg(folder.path()));
        assert!(copied.status.success());
        let place = folder.path().join(&case.name);
        let trace = || {
            let mut command = pcl2();
            command.arg("run").arg(if case.has("pcl2.toml") { "." } else { "main.cfg" }).args(&case.config.args);
            let output = run(command.args(["--period", "0.1", "--steps", "5", "--trace", "-"]).current_dir(&place));
            output.status.success().then(|| columns(&String::from_utf8(output.stdout).unwrap()))
        };
        let Some(before) = trace() else {
            continue;
        };
        let blocks = case.config.args.iter().any(|arg| arg == "--blocks");
        let fmt = |extra: &[&str]| {
            let mut command = pcl2();
            command.args(["fmt", "--renumber", "main.cfg"]).args(extra).current_dir(&place);
            if blocks || place.join("blocks").is_dir() {
                command.args(["--blocks", "blocks"]);
            }
            run(&mut command)
        };
        let output = fmt(&[]);
        if !output.status.success() || trace() != Some(before) {
            complaints.push(format!("{}: {}", case.name, String::from_utf8_lossy(&output.stderr)));
        }
        if fmt(&["--check"]).status.code() != Some(0) {
            complaints.push(format!("{}: numbers change a second time", case.name));
        }
        compared += 1;
    }
    assert!(compared > 30, "only {compared}");
    none(&complaints);
}

#[test]
fn numbers_and_what_refers_to_them_change_together() {
    let folder = folder();
    let path = folder.path().join("a.cfg");
    fs::write(&path, "CONTROL\r\n70 = msc(: 2.)\r\n7 x = msc(: 4.)\r\n y = msc(:7.)\r\n90 = sumII(1, 70, 7, 2 : 70., 7.) ! of 70, 7\r\nEND 70").unwrap();
    let output = run(pcl2().args(["fmt", "--renumber"]).arg(&path));
    assert!(output.status.success(), "{output:?}");
    let expected = "CONTROL\r\n3   = msc ( : 2. )\r\n1 x = msc ( : 4. )\r\n  y = msc ( : 7. )\r\n4   = sumII ( 1, 3, 1, 2 : 70., 7. )  ! of 70, 7\r\nEND 70";
    assert_eq!(fs::read_to_string(&path).unwrap(), expected);
}

#[test]
fn a_check_writes_nothing_and_a_mistake_is_shown() {
    let folder = folder();
    let write = |text: &[u8]| fs::write(folder.path().join("a.cfg"), text).unwrap();
    let fmt = |args: &[&str]| {
        let output = run(pcl2().arg("fmt").args(args).current_dir(folder.path()));
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        (output.status.code().unwrap(), said, fs::read(folder.path().join("a.cfg")).unwrap())
    };
    let loose = b"\xef\xbb\xbfCONTROL\n1 x=msc(:1.)\nEND";
    write(loose);
    assert_eq!(fmt(&["a.cfg", "--check"]), (1, "a.cfg would change\n".to_owned(), loose.to_vec()));
    let tidy = b"\xef\xbb\xbfCONTROL\n1 x = msc ( : 1. )\nEND";
    assert_eq!(fmt(&["a.cfg"]), (0, String::new(), tidy.to_vec()));
    assert_eq!(fmt(&["a.cfg", "--check"]), (0, String::new(), tidy.to_vec()));
    for broken in ["CONTROL\n1 x=msc(:1.\nEND\n", "CONTROL\n1 x=msc(:1.)\n", "\u{ff08}\nEND"] {
        write(broken.as_bytes());
        let (code, said, text) = fmt(&["a.cfg"]);
        assert!(code == 1 && said.starts_with("error[P0"), "{said}");
        assert_eq!(text, broken.as_bytes());
    }
    fs::write(folder.path().join("pcl2.toml"), "[controller]\nsource = \"a.cfg\"\n").unwrap();
    write(b"CONTROL\n1 x=mcs(:1.)\nEND\n");
    let (code, said, _) = fmt(&[".", "--renumber"]);
    assert!(code == 1 && said.starts_with("error[P0101]"), "{said}");
    let (code, said, text) = fmt(&["."]);
    assert_eq!((code, said.as_str(), text.as_slice()), (0, "", b"CONTROL\n1 x = mcs ( : 1. )\nEND\n".as_slice()));
}
