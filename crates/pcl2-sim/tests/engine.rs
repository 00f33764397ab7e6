//! The embedded engine on whole programs.

use pcl2_cfg::{Input, Options, Tunable};
use pcl2_lang::catalogue::Catalogue;
use pcl2_lang::source::Sources;
use pcl2_lang::symbol::Symbols;
use pcl2_lang::types::Width;
use pcl2_lang::verify::{Verified, verify};
use pcl2_lang::{render, syntax};
use pcl2_sim::engine::Machine;
use pcl2_sim::names::Names;
use pcl2_sim::stimulus;
use pcl2_sim::trace::{self, TraceWriter};
use rustc_hash::FxHashMap;

fn compile(text: &str, period: Option<i64>, width: Width, substeps: u32) -> Verified {
    let mut sources = Sources::default();
    let mut symbols = Symbols::default();
    let mut diagnostics = Vec::new();
    let catalogue = Catalogue::packed(&mut sources, &mut symbols, &mut diagnostics);
    diagnostics.clear();
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
