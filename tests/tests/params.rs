//! `pcl2 params`: what differs from the source, and back into its literals.

use pcl2_tests::cases;
use pcl2_tests::compilers::folder;
use pcl2_tests::{none, pcl2, run};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// The command in a folder: exit status, standard output, standard error.
fn said(folder: &Path, args: &[&str]) -> (i32, String, String) {
    let output = run(pcl2().args(args).current_dir(folder));
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
    (output.status.code().unwrap(), text(&output.stdout), text(&output.stderr))
}

fn project(source: &str, values: &str) -> TempDir {
    let folder = folder();
    fs::write(folder.path().join("a.cfg"), source).unwrap();
    fs::write(folder.path().join("values.txt"), values).unwrap();
    fs::write(folder.path().join("v.dat"), "1 2 3\n").unwrap();
    fs::create_dir(folder.path().join("blocks")).unwrap();
    fs::write(folder.path().join("blocks/mode.fc"), MODE).unwrap();
    folder
}

const MODE: &str = "! A mode, and a station in it.\n\
    int y = mode ( cell real manual = 0. \"%\" to 100. : int value = off {off, heat, cool}, real gain = 1. from 0. )\n\
    BODY\n1 y = msi ( : value )\n2 z = sumII ( 1, manual, manual, 2 : gain, 0. )\nEND\n";

const SOURCE: &str = "\
CONTROL
1 w=msc(:1.)               ! set point
2 y = first ( w : 1., 1., )  ! a, b
3 v = setvec ( 3 : )
4 z = first ( w : a=1.,    ! pole
  b =1. )
5 m = mode ( :heat, )
6 n = mode ( : )
7 k = setvec ( 2 : , 2. )
8 f = setvec ( 3 : \"v.dat\" )
9 g = setvec ( 2 : v = 7. )
END 1 w=msc(:1.)
";

const TUNE: [&str; 6] = ["params", "a.cfg", "--blocks", "blocks", "--from", "values.txt"];

#[test]
fn the_list_has_value_unit_and_range() {
    let folder =
        project("CONTROL\n1 w = msc ( : 1. )\n2 y = first ( w : 1., b = 0.1 )\n3 n = mode ( : cool, )\nEND\n", "");
    let (code, out, err) = said(folder.path(), &["params", "a.cfg", "--blocks", "blocks"]);
    assert_eq!((code, err.as_str()), (0, ""));
    let expected = "\
w.value   1.0        tunable
y.a       1.0   1/s  tunable
y.b       0.1   1/s  tunable
y.x0      0.0        fixed
n.value   cool       tunable   off, heat, cool
n.gain    1.0        tunable   from 0.
n.manual  0.0   %    operator  to 100.
";
    assert_eq!(out, expected);
    let (_, json, _) = said(folder.path(), &["params", "a.cfg", "--blocks", "blocks", "--format", "json"]);
    let rows: Vec<serde_json::Value> = json.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(rows.len(), 7);
    assert_eq!((&rows[2]["name"], &rows[2]["value"], &rows[2]["unit"]), (&"y.b".into(), &0.1.into(), &"1/s".into()));
}

#[test]
fn values_go_into_their_literals_and_nothing_else_changes() {
    let values = "w.value=2.5\ny.a=1.0\ny.b=-0.1\nv.v[2]=4\nz.a=2\nm.value=cool\n! a comment\nn.value=1\nn.gain=2.0\n\
                  k.v[1]=0.5\n9.v[1]=8\n9.v[2]=8\n";
    let folder = project(SOURCE, values);
    let (code, out, err) = said(folder.path(), &[&TUNE[..], &["--diff"]].concat());
    assert_eq!((code, err.as_str()), (0, ""));
    assert!(out.starts_with("w.value  1.0   -> 2.5\n") && out.contains("m.value  heat  -> cool\n"), "{out}");
    assert!(out.contains("\ny.b      1.0   -> -0.1  1/s\n") && !out.contains("y.a"), "{out}");
    assert_eq!(fs::read_to_string(folder.path().join("a.cfg")).unwrap(), SOURCE);

    let (code, _, err) = said(folder.path(), &[&TUNE[..], &["--save"]].concat());
    assert_eq!((code, err.as_str()), (0, "saved 10 of 10 in a.cfg\n"));
    let expected = SOURCE
        .replace("w=msc(:1.)               !", "w=msc(:2.5)               !")
        .replace("( w : 1., 1., )", "( w : 1., -0.1, )")
        .replace("( 3 : )", "( 3 : 0., 4., 0. )")
        .replace("a=1.,", "a=2.,")
        .replace(":heat", ":cool")
        .replace("n = mode ( : )", "n = mode ( : value = heat, gain = 2. )")
        .replace("( 2 : , 2. )", "( 2 : 0.5, 2. )")
        .replace("v = 7.", "v = 8.");
    assert_eq!(fs::read_to_string(folder.path().join("a.cfg")).unwrap(), expected);
    let (code, out, _) = said(folder.path(), &[&TUNE[..], &["--diff"]].concat());
    assert_eq!((code, out.as_str()), (0, "nothing differs from the source\n"));
}

#[test]
fn what_has_no_literal_is_said() {
    let folder = project(SOURCE, "f.v[1]=5\ng.v[1]=5\nm.manual=50\nw.value=3\n");
    let (code, out, err) = said(folder.path(), &[&TUNE[..], &["--save"]].concat());
    assert!(out.contains("m.manual  0.0  -> 50.0  %  operator"), "{out}");
    let expected = "\
not saved: f.v[1]: its value comes from the file \"v.dat\"
not saved: g.v[1]: one value stands for all its elements
not saved: m.manual: an operator cell has no literal
saved 1 of 4 in a.cfg
";
    assert_eq!((code, err.as_str()), (1, expected));
    let saved = fs::read_to_string(folder.path().join("a.cfg")).unwrap();
    assert_eq!(saved, SOURCE.replacen("msc(:1.)", "msc(:3.)", 1));
}

#[test]
fn refused_values_write_nothing() {
    let refused = [
        ("nothing.a=1\n", "error: values.txt:1: nothing has the name `nothing.a`"),
        ("\nw.valeu=1\n", "values.txt:2: nothing has the name `w.valeu`; did you mean `w.value`?"),
        ("y.x0=1\n", "`y.x0` is fixed"),
        ("w=1\n", "`w` is no parameter"),
        ("m.z.p1=1\n", "`m.z.p1` is set by the body of `mode`"),
        ("w.value=1\nw.value=2\n", "`w.value` has a value already"),
        ("w.value\n", "expected NAME=VALUE, found `w.value`"),
        ("w.value=one\n", "`w.value`: expected a number, found `one`"),
        ("w.value=nan\n", "block 1 `w` (msc): value must be a finite number, not NaN"),
        ("w.value=2\nm.gain=-1\n", "block 5 `m` (mode): gain must be from 0, not -1"),
        ("m.value=3\n", "value must be one of off, heat, cool, not 3"),
        ("m.manual=101\n", "m.manual must be to 100, not 101"),
        ("v.v[4]=1\n", "`v.v` is a vec[3] and has no such element"),
        ("v.v=1\n", "name an element"),
        ("y.#=1\u{0}\n", "nothing has the name"),
    ];
    let mut complaints = Vec::new();
    for (values, expected) in refused {
        let folder = project(SOURCE, values);
        let (code, out, err) = said(folder.path(), &[&TUNE[..], &["--save"]].concat());
        let text = fs::read_to_string(folder.path().join("a.cfg")).unwrap();
        if code != 1 || !out.is_empty() || !err.contains(expected) || text != SOURCE {
            complaints.push(format!("{values}: {code} {out}{err}"));
        }
    }
    none(&complaints);
}

#[test]
fn a_kernel_judges_too() {
    let source = "PLANT\n1 y = trfun ( u, 1, 1, 1 : 1., 1., 0. )\nCONTROL\n2 u = msc ( : 1. )\nEND\n";
    let folder = project(source, "y.den[1]=1e4\n");
    let (code, _, err) = said(folder.path(), &["params", "a.cfg", "--period", "0.1", "--from", "values.txt", "--save"]);
    assert!(code == 1 && err.starts_with("error: block 1 `y` (trfun)"), "{err}");
    assert_eq!(fs::read_to_string(folder.path().join("a.cfg")).unwrap(), source);
}

/// A tuned run's parameters, saved, are the program's: in every case, with each parameter a little larger.
#[test]
fn saved_values_are_the_programs() {
    let mut complaints = Vec::new();
    let mut saved = 0;
    for case in cases::all().into_iter().filter(|case| !case.has_own_c() && case.name != "parameter_files") {
        let folder = folder();
        assert!(run(std::process::Command::new("cp").arg("-r").arg(&case.folder).arg(folder.path())).status.success());
        let place = folder.path().join(&case.name);
        let source = if case.has("pcl2.toml") { "." } else { "main.cfg" };
        let with = |args: &[&str]| {
            let mut all: Vec<&str> = args.to_vec();
            all.extend(case.config.args.iter().map(String::as_str));
            said(&place, &all)
        };
        let run = |file: &str| with(&["run", source, "--steps", "0", "--period", "0.1", "--params", file]).0 == 0;
        if !run("before.txt") {
            continue;
        }
        let before = fs::read_to_string(place.join("before.txt")).unwrap();
        let values: String = before.lines().map(|line| format!("{}\n", larger(line))).collect();
        fs::write(place.join("values.txt"), values).unwrap();
        let (code, _, err) = with(&["params", source, "--from", "values.txt", "--save", "--period", "0.1"]);
        // The ranges and checks of some codes refuse the larger values.
        if err.contains("error: block ") {
            continue;
        }
        let all = err.contains("saved ") && code == 0;
        if all
            && run("after.txt")
            && fs::read(place.join("after.txt")).unwrap() == fs::read(place.join("values.txt")).unwrap()
        {
            saved += 1;
        } else if !err.contains("stands for all its elements") {
            complaints.push(format!("{}: {code} {err}", case.name));
        }
    }
    assert!(saved > 20, "only {saved}");
    none(&complaints);
}

/// `NAME=VALUE` with a real value doubled.
fn larger(line: &str) -> String {
    let (name, value) = line.split_once('=').unwrap();
    let doubled = |value: f64| if value.abs() < 1e15 { 2.0 * value } else { value };
    let is_real = value.contains(['.', 'e']);
    if is_real { format!("{name}={:?}", doubled(value.parse().unwrap())) } else { line.to_owned() }
}
