//! The embedded engine on whole programs.
#![expect(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use pcl2_cfg::{Input, Options, Tunable};
use pcl2_lang::catalogue::{Catalogue, UserFile};
use pcl2_lang::source::Sources;
use pcl2_lang::symbol::Symbols;
use pcl2_lang::types::Width;
use pcl2_lang::verify::{Verified, verify};
use pcl2_lang::{render, syntax};
use pcl2_sim::engine::{self, Machine, Unsupported};
use pcl2_sim::names::Names;
use pcl2_sim::stimulus;
use pcl2_sim::trace::{self, TraceWriter};
use rustc_hash::FxHashMap;

fn compile(text: &str, period: Option<i64>, width: Width, substeps: u32) -> Verified {
    compile_with(&[], text, period, width, substeps)
}

/// Compiles a program that uses function codes of the project's own: stem and text.
fn compile_with(own: &[(&str, &str)], text: &str, period: Option<i64>, width: Width, substeps: u32) -> Verified {
    let mut sources = Sources::default();
    let mut symbols = Symbols::default();
    let mut diagnostics = Vec::new();
    let mut catalogue = Catalogue::packed(&mut sources, &mut symbols, &mut diagnostics);
    diagnostics.clear();
    let file = |(stem, text): &(&str, &str)| UserFile {
        name: format!("{stem}.fc"),
        stem: (*stem).to_owned(),
        bytes: text.as_bytes().to_vec(),
    };
    let own: Vec<UserFile> = own.iter().map(file).collect();
    catalogue.add_user(&own, &mut sources, &mut symbols, &mut diagnostics);
    let file = sources.add("test.cfg", text.as_bytes().to_vec());
    let tree = syntax::parse(&sources, file, &mut symbols, &mut diagnostics);
    let tunable = Tunable::All;
    let options = Options { name: "test".to_owned(), period, width, plant: Vec::new(), substeps, tunable };
    let files = FxHashMap::default();
    let input = Input {
        sources: &sources,
        file,
        tree: &tree,
        symbols: &symbols,
        catalogue: &catalogue,
        files: &files,
        options: &options,
        alone: None,
    };
    let program = pcl2_cfg::compile(&input, &mut diagnostics);
    let shown: String = diagnostics.iter().map(|diagnostic| render::render(diagnostic, &sources, false)).collect();
    let program = program.unwrap_or_else(|| panic!("{shown}"));
    verify(program).unwrap_or_else(|defect| panic!("{defect}"))
}

/// Runs a program with a stimulus and returns its trace and the refusals.
fn run(program: &Verified, stimulus_text: &str, sets: &[&str], scans: u64) -> (String, Vec<String>) {
    let names = Names::new(program.program());
    let width = program.program().width;
    let stimulus = stimulus::parse(stimulus_text.as_bytes(), &names, width).unwrap();
    let sets: Vec<_> = sets.iter().map(|set| stimulus::parse_set(set, &names, width).unwrap()).collect();
    let events = stimulus::merge(stimulus.events, sets);
    let columns = trace::all_signals(&names);
    let mut machine = Machine::new(program).unwrap();
    let probes: Vec<_> = columns.iter().map(|column| machine.probe(&names, *column)).collect();
    let mut writer = TraceWriter::new(Vec::new(), &names, &columns).unwrap();
    let mut refused = Vec::new();
    for scan in 0..scans {
        let due: Vec<_> = events.iter().filter(|event| event.scan == scan).copied().collect();
        if let Err(refusal) = machine.apply(&names, &due) {
            refused.push(format!("scan {scan}: {refusal}"));
        }
        machine.run(1);
        writer.row(scan, probes.iter().map(|probe| machine.read(*probe))).unwrap();
    }
    refused.extend(machine.health().lines(program.program()));
    (String::from_utf8(writer.finish().unwrap()).unwrap(), refused)
}

fn column(trace: &str, name: &str) -> Vec<f64> {
    let mut reader = csv::Reader::from_reader(trace.as_bytes());
    let index = reader.headers().unwrap().iter().position(|header| header == name).unwrap();
    reader.records().map(|record| record.unwrap()[index].parse().unwrap()).collect()
}

const FIRST_LISTING: &str = include_str!("../../../tests/reference/paper/example1_verbatim.cfg");
const GPC_LISTING: &str = include_str!("../../../tests/reference/paper/gpc_verbatim.cfg");
const GPC_TRACE: &str = include_str!("../../../tests/reference/paper/gpc_verbatim.trace.csv");

#[test]
fn the_first_listing_of_the_paper() {
    let program = compile(FIRST_LISTING, None, Width::F64, 1);
    let (trace, health) = run(&program, "k,\"ain(0,1,1)\"\n0,3.5\n2,nan\n", &[], 3);
    assert_eq!(
        trace,
        "@k,@t,a[1],a[2],b[1],b[2],x,c[1],c[2]\n\
         0,,100.0,2.0,3.5,100.0,3.5,103.5,102.0\n\
         1,,100.0,2.0,3.5,100.0,3.5,103.5,102.0\n\
         2,,100.0,2.0,nan,100.0,nan,nan,102.0\n"
    );
    assert_eq!(health, ["first fault: scan 2, block 3 `x` (ain): the sample is bad", "faults: 1"]);
}

#[test]
fn the_gpc_listing_of_the_paper() {
    let program = compile(GPC_LISTING, Some(250_000_000), Width::F64, 1);
    let w = column(GPC_TRACE, "w");
    let rows: String = w.iter().enumerate().map(|(k, w)| format!("{k},{w}\n")).collect();
    let (trace, health) = run(&program, &format!("k,w.value\n{rows}"), &[], w.len() as u64);
    assert_eq!(health, Vec::<String>::new());
    for name in ["w", "y1", "u1", "y2", "u2"] {
        for (k, (found, expected)) in column(&trace, name).iter().zip(column(GPC_TRACE, name)).enumerate() {
            // The tolerance of the reference numbers.
            assert!((found - expected).abs() <= 1e-9 * expected.abs() + 1e-12, "{name} {k}: {found} {expected}");
        }
    }
}

fn rows(trace: &str) -> Vec<&str> {
    trace.lines().skip(1).collect()
}

#[test]
fn a_reader_before_the_writer_gets_the_previous_scan() {
    let program =
        compile("CONTROL\n1 y = sumII ( 1, y, w, 2 : 1., 1. )\n2 w = msc ( : 1. )\nEND\n", None, Width::F64, 1);
    let (trace, _) = run(&program, "k\n", &[], 3);
    assert_eq!(rows(&trace), ["0,,0.0,1.0", "1,,1.0,1.0", "2,,2.0,1.0"]);
}

#[test]
fn arrays_that_alias_their_output_are_copied() {
    let text = "INITIALIZE\n1 a = setmat ( 2, 2 : 1., 1., 1., 0. )\n2 b = setmat ( 2, 2 : 1., 1., 1., 0. )\n\
                CONTROL\n5 a = mulmat ( 2, 2, a, b : )\nEND\n";
    let (trace, _) = run(&compile(text, None, Width::F64, 1), "k\n", &[], 3);
    assert_eq!(column(&trace, "a[1,1]"), [2.0, 3.0, 5.0]);
    assert_eq!(column(&trace, "a[2,2]"), [1.0, 1.0, 2.0]);
}

#[test]
fn sections_run_at_their_rates() {
    let text = "CONTROL\n1 w = msc ( : 1. )\n2 a = sumII ( 1, a, w, 2 : 1., 1. )\n\
                CONTROL 3 1\n3 b = sumII ( 1, b, w, 2 : 1., 1. )\nCONTROL 2\n4 c = sumII ( 1, c, w, 2 : 1., 1. )\nEND\n";
    let (trace, _) = run(&compile(text, None, Width::F64, 1), "k\n", &[], 6);
    assert_eq!(column(&trace, "a"), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    assert_eq!(column(&trace, "b"), [0.0, 1.0, 1.0, 1.0, 2.0, 2.0]);
    assert_eq!(column(&trace, "c"), [1.0, 1.0, 2.0, 2.0, 3.0, 3.0]);
}

#[test]
fn the_plant_runs_in_substeps_of_its_own_period() {
    let text = "PLANT\n1 n = sumII ( 1, n, u, 2 : 1., 1. )\n2 y = first ( u : 0., 1., 0. )\nCONTROL\n3 u = msc ( : 1. )\nEND\n";
    let (trace, _) = run(&compile(text, Some(1_000_000_000), Width::F64, 4), "k\n", &[], 3);
    assert_eq!(column(&trace, "n"), [0.0, 4.0, 8.0]);
    assert_eq!(column(&trace, "y"), [0.0, 1.0, 2.0]);
}

#[test]
fn an_int_fits_a_real_port() {
    for width in [Width::F64, Width::F32] {
        let text =
            "CONTROL\n1 i = msi ( : 3 )\n2 v = setivec ( 2 : 5, 7 )\n3 y = sumII ( 1, i, v[2], 2 : 1., 0.5 )\nEND\n";
        let (trace, _) = run(&compile(text, None, width, 1), "k\n", &[], 1);
        assert_eq!(rows(&trace), ["0,,3,5,7,6.5"]);
    }
}

#[test]
fn several_writers_share_a_slot_and_keep_their_own_outputs() {
    let text = "CONTROL\n1 w = msc ( : 1. )\n2 y = first ( w : 0., 1., 5. )\n3 a = sumII ( 1, y, w, 2 : 1., 0. )\n\
                4 y = sumII ( 1, w, w, 2 : 10., 0. )\nEND\n";
    let (trace, _) = run(&compile(text, Some(1_000_000_000), Width::F64, 1), "k\n", &[], 2);
    assert_eq!(column(&trace, "a"), [6.0, 7.0]);
    assert_eq!(column(&trace, "y"), [10.0, 10.0]);
}

#[test]
fn a_set_is_taken_as_a_whole_or_not_at_all() {
    let program = compile(GPC_LISTING, Some(250_000_000), Width::F64, 1);
    let stimulus = "t,u1.umin,u1.umax,w.value,u1.lambda\n0,11,,1,\n0.25,11,12,2,\n0.5,,,3,-1\n0.6,,,inf,\n";
    let (trace, health) = run(&program, stimulus, &["u2.u0=2"], 5);
    assert_eq!(column(&trace, "w"), [0.0, 2.0, 2.0, 2.0, 2.0]);
    assert_eq!(column(&trace, "u1"), [0.0, 11.0, 11.0, 11.0, 11.0]);
    assert_eq!(
        health,
        [
            "scan 0: block 6 `u1` (gpc2): umax must be from 11, not 10",
            "scan 2: block 6 `u1` (gpc2): lambda must be from 0, not -1",
            "scan 3: block 4 `w` (msc): value must be a finite number, not inf",
            "refused sets: 3"
        ]
    );
}

#[test]
fn what_only_the_kernel_can_judge() {
    let text = "CONTROL\n1 u = msc ( : 1. )\n2 y = trfun ( u, 1, 1, 1 : 1., 1., 0. )\nEND\n";
    let program = compile(text, Some(1_000_000_000), Width::F64, 1);
    assert_eq!(engine::judge(&program), Vec::new());
    let (_, health) = run(&program, "k,y.den[1]\n1,3\n", &[], 3);
    assert_eq!(health.len(), 2, "{health:?}");
    assert!(health[0].starts_with("scan 1: block 2 `y` (trfun): the pole at -3"), "{health:?}");
    let unstable = compile(&text.replace(": 1., 1., 0.", ": 3., 1., 0."), Some(1_000_000_000), Width::F64, 1);
    let refusals = engine::judge(&unstable);
    assert_eq!(refusals.len(), 1);
    assert!(refusals[0].message.starts_with("the pole at -3 + 0j is stable"), "{}", refusals[0]);
    assert_eq!(engine::judge(&compile(text, None, Width::F64, 1)), Vec::new());
}

const TWICE: &str = "real y = twice ( real u : real k, fixed real x0 = 0. )
BODY
1 e = sumII ( 1, u, y, 2 : k, 1. )
2 y = first ( e : 1., k, x0 )
END
";

#[test]
fn composites_have_memory_and_parameters_of_their_own() {
    let text = "CONTROL\n1 u = msc ( : 1. )\n2 a = twice ( u : 2., 3. )\n3 b = twice ( a : 0.5, )\nEND\n";
    let program = compile_with(&[("twice", TWICE)], text, Some(100_000_000), Width::F64, 1);
    let (trace, _) = run(&program, "k,a.k\n2,1\n", &[], 4);
    let (mut a, mut b) = (3.0_f64, 0.0_f64);
    for (scan, (found_a, found_b)) in column(&trace, "a").into_iter().zip(column(&trace, "b")).enumerate() {
        let k = if scan < 2 { 2.0 } else { 1.0 };
        let step = |k: f64, u: f64, y: f64| (-0.1_f64).exp() * y + k * (1.0 - (-0.1_f64).exp()) * (k * u + y);
        a = step(k, 1.0, a);
        b = step(0.5, a, b);
        // The mathematics of the kernels and of this test differ by some ulp.
        assert!((found_a - a).abs() < 1e-12 && (found_b - b).abs() < 1e-12, "{scan}: {found_a} {a} {found_b} {b}");
    }
}

#[test]
fn a_fault_inside_a_composite_is_its_own() {
    let own = "real y = guarded ( real u : )\nBODY\n1 y = tf ( u, 1, 1, 1 : -1., 1., 0. )\nEND\n";
    let text = "CONTROL\n1 u = msc ( : 1e308 )\n2 y = guarded ( u : )\nEND\n";
    let program = compile_with(&[("guarded", own)], text, Some(5_000_000_000), Width::F64, 1);
    let (_, health) = run(&program, "k\n", &[], 2);
    let text = "block 2 `y` (guarded): in `y`: the state left the range of a real and was held";
    assert_eq!(
        health,
        [format!("first fault: scan 0, {text}"), format!("last fault: scan 1, {text}"), "faults: 2".to_owned()]
    );
}

#[test]
fn c_of_the_users_own_needs_a_compiler() {
    let own = "real y = mine ( real u : )\n";
    let program =
        compile_with(&[("mine", own)], "CONTROL\n1 u = msc ( : )\n2 y = mine ( u : )\nEND\n", None, Width::F64, 1);
    assert_eq!(Machine::new(&program).err(), Some(Unsupported::OwnC("mine".to_owned())));
}

fn stimulus_error(text: &str, period: Option<i64>) -> String {
    let program = compile(FIRST_LISTING, period, Width::F64, 1);
    let names = Names::new(program.program());
    match stimulus::parse(text.as_bytes(), &names, Width::F64) {
        Ok(stimulus) => format!("{} events", stimulus.events.len()),
        Err(stimulus::InputError::Usage(message)) => format!("usage: {message}"),
        Err(stimulus::InputError::Data(message)) => format!("data: {message}"),
    }
}

#[test]
fn what_is_wrong_with_a_stimulus() {
    let word = "\"ain(0,1,1)\"";
    let cases = [
        (format!("k,{word}\r\n0,1\r\n5,\r\n7,2\r\n"), "2 events"),
        (format!("\u{feff}k,{word}\n0,1\n"), "1 events"),
        (
            format!("@k,{word}\n"),
            "usage: the first column is the clock, headed `k` (scan) or `t` (seconds); found `@k`",
        ),
        (format!("t,{word}\n"), "usage: a clock `t` needs a period (--period)"),
        ("k,x\n".to_owned(), "usage: column 2: `x` is written by a block"),
        ("k,ain\n".to_owned(), "usage: column 2: nothing has the name `ain`"),
        (format!("k,{word},{word}\n"), "usage: column 3: `ain(0,1,1)` stands in an earlier column"),
        (format!("k,{word}\n0,1\n0,2\n"), "data: row 3, column 1: the clock must ascend, `0` does not"),
        (format!("k,{word}\n1.5,1\n"), "data: row 2, column 1: expected a scan number, found `1.5`"),
        (format!("k,{word}\n0,one\n"), "data: row 2, column 2 (ain(0,1,1)): expected a number, found `one`"),
        (format!("k,{word}\n0,1,2\n"), "data: row 2: expected 2 fields, found 3"),
        ("k,a[3]\n".to_owned(), "usage: column 2: `a[3]`: `a` is a vec[2] and has no such element"),
        ("k,a\n".to_owned(), "usage: column 2: `a` is a vec[2]: name an element, such as `a[1]`"),
    ];
    for (text, expected) in cases {
        assert_eq!(stimulus_error(&text, None), expected, "{text}");
    }
    assert_eq!(stimulus_error(&format!("t,{word}\n0,1\n0.1,2\n"), Some(1_000_000_000)), "2 events");
}
