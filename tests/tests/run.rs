//! `pcl2 run`: what goes in, what comes out, how it ends; and both engines digit for digit.

use pcl2_tests::{pcl2, run};
use std::fs;
use std::path::Path;
use std::process::Output;
use tempfile::TempDir;

/// A folder with files.
fn folder(files: &[(&str, &str)]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    folder
}

fn pcl2_run(folder: &Path, args: &[&str]) -> Output {
    run(pcl2().current_dir(folder).arg("run").args(args))
}

/// Exit status, standard output and standard error.
fn said(output: &Output) -> (i32, String, String) {
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
    (output.status.code().unwrap(), text(&output.stdout), text(&output.stderr))
}

const LAG: &str = "\
PLANT
1 y = first ( u : 1., 1., 0. )
CONTROL
2 w = msc ( : 1. )
3 u = sumII ( 1, w, y, 2 : 2., -2. )
END
";

#[test]
fn the_summary_shows_last_values_and_drawings() {
    let folder = folder(&[("lag.cfg", LAG)]);
    let (code, out, err) = said(&pcl2_run(folder.path(), &["lag.cfg", "--period", "0.5", "--steps", "4"]));
    assert_eq!((code, err.as_str()), (0, ""));
    assert_eq!(out, "4 scans, 2 s\n  y  0.670581  ▁█▇▇\n  w       1.0  ▁▁▁▁\n  u  0.658838  █▁▂▂\n");
}

#[test]
fn a_trace_is_exact_and_quoted() {
    let folder = folder(&[(
        "m.cfg",
        "CONTROL\n1 m = setmat ( 1, 2 : 0.1, -0. )\n2 i = msi ( : -7 )\n3 = msc ( : 1e30 )\nEND\n",
    )]);
    let args =
        ["m.cfg", "--period", "0.1", "--until", "0.25", "--trace", "-", "--set", "3.value=nan", "--record", "m,i,3"];
    let (code, out, _) = said(&pcl2_run(folder.path(), &args));
    let expected =
        "@k,@t,\"m[1,1]\",\"m[1,2]\",i,3\n0,0,0.1,-0.0,-7,1e30\n1,0.1,0.1,-0.0,-7,1e30\n2,0.2,0.1,-0.0,-7,1e30\n";
    assert_eq!((code, out.as_str()), (0, expected));
    let narrow = pcl2_run(folder.path(), &["m.cfg", "--real", "f32", "--steps", "1", "--trace", "-"]);
    assert_eq!(said(&narrow).1, "@k,@t,\"m[1,1]\",\"m[1,2]\",i,3\n0,,0.1,-0.0,-7,1e30\n");
}

#[test]
fn how_a_run_ends() {
    let files =
        [("lag.cfg", LAG), ("s.csv", "k,w.value\n0,1\n6,2\n"), ("bad.csv", "k,w.value\n0,one\n"), ("y.csv", "k,y\n")];
    let folder = folder(&files);
    let cases: [(&[&str], i32, &str); 14] = [
        (&["--stimulus", "s.csv"], 0, ""),
        (
            &["--steps", "2", "--set", "u.p1=inf"],
            0,
            "scan 0: set refused: block 3 `u` (sumII): p1 must be a finite number",
        ),
        (&[], 2, "error: how long?"),
        (&["--steps", "2", "--until", "1"], 2, "error: the argument"),
        (&["--steps", "2", "--set", "w.valu=1"], 2, "did you mean `w.value`?"),
        (&["--steps", "2", "--set", "y=1"], 2, "error: --set `y` is written by a block"),
        (&["--steps", "2", "--set", "w.value=one"], 2, "expected a number, found `one`"),
        (&["--steps", "2", "--record", "z"], 2, "error: --record: nothing has the name `z`"),
        (&["--stimulus", "y.csv"], 2, "`y` is written by a block"),
        (&["--stimulus", "bad.csv"], 3, "error: bad.csv: row 2, column 2 (w.value): expected a number, found `one`"),
        (&["--stimulus", "none.csv"], 3, "error: cannot read `none.csv`"),
        (&["--steps", "2", "--trace", "no/t.csv"], 3, "error: cannot write `no/t.csv`: there is no such folder"),
        (&["--steps", "2", "--trace", "t.csv", "--params", "no/p"], 3, "error: cannot write `no/p`"),
        (&["--until", "-1"], 2, "error"),
    ];
    for (args, code, message) in cases {
        let args: Vec<&str> = ["lag.cfg", "--period", "0.1"].into_iter().chain(args.iter().copied()).collect();
        let (found, _, err) = said(&pcl2_run(folder.path(), &args));
        assert_eq!(found, code, "{args:?}: {err}");
        assert!(err.contains(message), "{args:?}: {err}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), files.len(), "a failed run left something");
    let (code, _, _) = said(&pcl2_run(folder.path(), &["lag.cfg", "--until", "1"]));
    assert_ne!(code, 0, "a program that needs a period ran without one");
}

const BLOCKS: [(&str, &str); 3] = [
    (
        "blocks/accu.fc",
        "real y = accu ( real u, cell real w = 1. from -100. to 100. tracks y, cell int mode = up {down, up} : real k = 1. from 0. to 10. )
BODY
1 s = sumII ( 1, w, u, 2 : 1., k )
2 y = sumII ( 1, s, mode, 2 : 1., 0.25 )
END
",
    ),
    (
        "blocks/nest.fc",
        "real z = nest ( real u : real k = 1. )
BODY
1 a = accu ( u : k )
2 b = tf ( a, 1, 1, 1 : -1., 1., 0. )
3 z = sumII ( 1, a, b, 2 : 1., 1. )
END
",
    ),
    (
        "blocks/both.fc",
        "vec[n] v = both ( n from 1, vec[n] a, real x : )
BODY
1 v = addvec ( n, a, a : )
2 v = ftov ( n, x, 1 : )
END
",
    ),
];

const MANY: &str = "\
INITIALIZE
1 g = setvec ( 3 : 1., 2., 3. )
PLANT
2 p = tf ( q, 1, 1, 1 : -3., 1., 0.5 )
CONTROL
3 u = msc ( : 0.5 )
4 y = accu ( u : )
5 y2 = accu ( y : k = 2. )
6 z = nest ( y : 3. )
7 g = both ( 3, g, u : )
8 q = sumII ( 1, p, u, 2 : 1e30, 1. )
9 m = mulmat ( 3, 1, o, g : )
12 o = setmat ( 3, 3 : 0., 1., 0., 0., 0., 1., 0.5, 0., 0. )
CONTROL 3 2
20 z = nest ( z : 1. )
21 q = msc ( : 1e30 )
22 h = ftov ( 3, z, 2 : )
23 x = ain ( : 0, 1, 1 )
24 v = aout ( x : 0, 2, 1 )
END
";

/// Rates, substeps, composites with faults, operator cells, several writers, image words, refused sets.
#[test]
fn both_engines_agree_digit_for_digit() {
    let stimulus = "t,\"ain(0,1,1)\",4.w,u.value\n0,1.5,,\n20,,7,\n33,nan,,\n60,-2,,nan\n".replace("4.w", "y.w");
    let toml = "[controller]\nsource = \"many.cfg\"\nblocks = [\"blocks\"]\nperiod = 2\n[sim]\nsubsteps = 2\n";
    let folder = folder(&[("many.cfg", MANY), ("s.csv", &stimulus), ("pcl2.toml", toml)]);
    for (name, text) in BLOCKS {
        fs::create_dir_all(folder.path().join("blocks")).unwrap();
        fs::write(folder.path().join(name), text).unwrap();
    }
    let sets = ["y2.mode=down@30", "y2.w=101@40", "y.mode=2@50", "6.k=4@61", "20.k=3"];
    for width in ["f64", "f32"] {
        let ran = ["embedded", "cc"].map(|engine| {
            let (trace, params) = (format!("{engine}.csv"), format!("{engine}.params"));
            let mut args = vec![".", "--steps", "200", "--stimulus", "s.csv", "--real", width, "--engine", engine];
            args.extend(["--trace", &trace, "--params", &params]);
            args.extend(sets.iter().flat_map(|set| ["--set", set]));
            let said = said(&pcl2_run(folder.path(), &args));
            let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
            (said, read(&trace), read(&params))
        });
        assert_eq!(ran[0], ran[1], "{width}");
        let ((code, _, err), trace, params) = &ran[0];
        assert_eq!(*code, 0, "{err}");
        assert_eq!(trace.lines().count(), 201);
        assert!(params.contains("z#1.k=4.0\n") && params.contains("z#2.k=3.0\n"), "{params}");
        assert!(err.contains("refused sets: 3\n") && err.contains("first fault: scan"), "{err}");
        // Without a trace the same samples reach the summary.
        let brief = ["embedded", "cc"].map(|engine| {
            let args = [".", "--steps", "200", "--stimulus", "s.csv", "--real", width, "--engine", engine];
            said(&pcl2_run(folder.path(), &args))
        });
        assert_eq!(brief[0], brief[1], "{width}");
    }
}

#[test]
fn c_of_the_projects_own_runs_through_the_compiler() {
    let declaration =
        "real y = mine ( real u : real k = 1. from 0. )\nMEMORY real last\nFAULTS negative \"the input is negative\"\n";
    let kernel = "#include \"pcl2_mine.h\"\n
PCL2_KERNEL void pcl2_mine_init(struct pcl2_mine *self, pcl2_real k)\n{\n    (void)k;\n    self->last = PCL2_R(0.0);\n}\n
PCL2_KERNEL void pcl2_mine(struct pcl2_mine *self, pcl2_real u, pcl2_real k)\n{\n    self->status = u < PCL2_R(0.0);
    self->y = k * u * u + self->last;\n    self->last = u;\n}\n";
    let source = "CONTROL\n1 u = msc ( : -2. )\n2 y = mine ( u : 2. )\nEND\n";
    let folder = folder(&[("own.cfg", source), ("own/mine.fc", declaration), ("own/mine.c", kernel)]);
    let own = |more: &[&str]| {
        let args: Vec<&str> = ["own.cfg", "--blocks", "own", "--steps", "2"].iter().chain(more).copied().collect();
        said(&pcl2_run(folder.path(), &args))
    };
    let (code, out, err) = own(&["--trace", "-", "--set", "y.k=-1"]);
    assert_eq!((code, out.as_str()), (0, "@k,@t,u,y\n0,,-2.0,8.0\n1,,-2.0,6.0\n"));
    let expected = "note: `mine` is C of the project's own: this program runs through the C compiler (--engine cc)
scan 0: set refused: `y.k`
first fault: scan 0, block 2 `y` (mine): the input is negative
last fault: scan 1, block 2 `y` (mine): the input is negative
faults: 2
refused sets: 1
";
    assert_eq!(err, expected);
    assert_eq!(own(&["--engine", "embedded"]).0, 2);
    fs::write(folder.path().join("own/mine.c"), "#include \"pcl2_mine.h\"\nno C\n").unwrap();
    let (code, _, err) = own(&[]);
    assert_eq!(code, 3);
    assert!(err.contains("mine.c:2"), "{err}");
}

#[test]
fn names_of_an_enumeration_stand_for_its_values() {
    let mode = "! A mode.\nint u {off, on}, real v = station ( real x, cell int mode = auto {man, auto, cas} : int form = isa {isa, parallel} )\n\
                BODY\n1 u = msi ( : form )\n2 v = sumII ( 1, x, mode, 2 : 1., 1. )\nEND\n";
    let folder = folder(&[
        ("blocks/station.fc", mode),
        ("a.cfg", "CONTROL\n1 x = msc ( : 2. )\n2 T = station ( x : )\n3 B = station ( x : parallel )\nEND\n"),
        ("s.csv", "t,T.mode,T.form\n0,cas,\n1,man,parallel\n2,1,isa\n"),
    ]);
    for engine in ["embedded", "cc"] {
        let args = ["a.cfg", "--blocks", "blocks", "--period", "1", "--engine", engine];
        let sets = ["--stimulus", "s.csv", "--set", "B.mode=man@1", "--set", "3.form=isa@2", "--trace", "-"];
        let (code, out, err) = said(&pcl2_run(folder.path(), &[&args[..], &sets].concat()));
        let expected = "@k,@t,x,T,T.v,B,B.v\n0,0,2.0,0,4.0,1,3.0\n1,1,2.0,1,2.0,1,2.0\n2,2,2.0,0,3.0,0,2.0\n";
        assert_eq!((code, out.as_str(), err.as_str()), (0, expected, ""));
    }
    let args = ["a.cfg", "--blocks", "blocks", "--steps", "1", "--set", "T.mode=auot"];
    let (code, _, err) = said(&pcl2_run(folder.path(), &args));
    assert_eq!(
        (code, err.as_str()),
        (2, "error: --set `T.mode=auot`: expected an int or one of man, auto, cas, found `auot`\n")
    );
}

#[test]
fn an_interrupted_run_leaves_nothing() {
    for signal in ["INT", "KILL"] {
        let folder = folder(&[("lag.cfg", LAG)]);
        let args = ["lag.cfg", "--period", "0.5", "--steps", "1000000000000", "--trace", "t.csv", "--params", "p.txt"];
        let mut child = pcl2().current_dir(folder.path()).arg("run").args(args).spawn().unwrap();
        std::thread::sleep(std::time::Duration::from_millis(300));
        assert!(child.try_wait().unwrap().is_none());
        let killed = std::process::Command::new("kill").args(["-s", signal, &child.id().to_string()]).status().unwrap();
        assert!(killed.success() && !child.wait().unwrap().success());
        let left: Vec<_> = fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        assert_eq!(left, ["lag.cfg"]);
    }
}

#[test]
fn a_late_row_makes_no_endless_run() {
    let folder =
        folder(&[("lag.cfg", LAG), ("s.csv", "t,w.value\n0,1\n1e18,2\n"), ("k.csv", "k,w.value\n1000000000,2\n")]);
    for file in ["s.csv", "k.csv"] {
        let (code, out, err) = said(&pcl2_run(folder.path(), &["lag.cfg", "--period", "1e9", "--stimulus", file]));
        assert_eq!((code, out.as_str()), (2, ""));
        let expected =
            "error: the last row of the stimulus is before scan 1000000000: a run so long needs --steps or --until\n";
        assert_eq!(err, expected);
        let steps = pcl2_run(folder.path(), &["lag.cfg", "--period", "1e9", "--stimulus", file, "--steps", "2"]);
        assert_eq!(said(&steps).0, 0);
    }
}

#[test]
fn a_fault_in_a_composite_says_where() {
    let pair = "! Two samples.\nreal y = pair ( real a, real b : )\nBODY\n1 u = aout2 ( a : )\n2 v = aout2 ( b : )\n3 y = sumII ( 1, u, v, 2 : 1., 1. )\nEND\n\
                ! One.\nreal y = aout2 ( real a : )\nBODY\n1 y = div ( a, z : )\n2 z = sumII ( 1, a, a, 2 : 1., -1. )\nEND\n";
    let source = "CONTROL\n1 x = msc ( : 1. )\n2 y = pair ( x, x : )\nEND\n";
    let folder = folder(&[("blocks/pair.fc", pair), ("a.cfg", source)]);
    let (code, _, err) =
        said(&pcl2_run(folder.path(), &["a.cfg", "--blocks", "blocks", "--period", "1", "--steps", "1"]));
    assert_eq!(code, 0);
    assert!(err.contains("block 2 `y` (pair): in `u`: in `y`: ") && err.contains(", or in `v`: in `y`: "), "{err}");
}

/// What a run is made from is not written over.
#[test]
fn a_run_spares_what_it_reads() {
    let net = "int y = keep ( int x : )\nSTATE a MARKED DRIVES y\nGATE g : a -> IF x\nEND\n";
    let folder = folder(&[("keep.net", net), ("s.csv", "k,x\n0,0\n")]);
    for file in ["--trace=keep.net", "--plot=keep.net", "--params=./keep.net", "--trace=s.csv"] {
        let output = pcl2_run(folder.path(), &["keep.net", "--steps", "2", "--stimulus", "s.csv", file]);
        let (status, _, told) = said(&output);
        assert_eq!(status, 2, "{file}: {told}");
        assert!(told.contains("expected another file"), "{told}");
    }
    assert_eq!(fs::read_to_string(folder.path().join("keep.net")).unwrap(), net);
    assert_eq!(fs::read_to_string(folder.path().join("s.csv")).unwrap(), "k,x\n0,0\n");
}
