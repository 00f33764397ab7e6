//! The paper's listings, as printed.

use pcl2_tests::cases::{self, Tolerance, Width};
use pcl2_tests::compilers::{Built, alone, check};
use pcl2_tests::table::{Table, compare};
use pcl2_tests::{root, run};
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

fn bytes(path: &str) -> Vec<u8> {
    fs::read(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

#[test]
fn the_listings_are_the_printed_ones_character_for_character() {
    let first = bytes("tests/reference/paper/example1_verbatim.cfg");
    let second = bytes("tests/reference/paper/gpc_verbatim.cfg");
    assert_eq!(first, bytes("examples/paper/listing1.cfg"));
    assert_eq!(first, bytes("tests/cases/paper_listing1/main.cfg"));
    assert_eq!(second, bytes("examples/paper/listing2.cfg"));
    assert_eq!(second, bytes("tests/cases/paper_gpc/main.cfg"));
    assert_eq!(second, bytes("tests/cases/paper_gpc_cut/main.cfg"));
    let reference = bytes("tests/reference/paper/gpc_verbatim.trace.csv");
    assert_eq!(reference, bytes("tests/cases/paper_gpc/trace.csv"));
    assert_eq!(reference, bytes("tests/cases/paper_gpc_cut/trace.csv"));
}

#[test]
fn a_cut_changes_nothing_in_the_trace() {
    let (whole, cut) = (cases::find("paper_gpc"), cases::find("paper_gpc_cut"));
    let columns = |case: &cases::Case| {
        let table = Table::read(&case.trace(case.run("embedded", Width::F64)).unwrap());
        ["w", "y1", "u1", "y2", "u2"].map(|name| table.values(name))
    };
    assert_eq!(columns(&whole), columns(&cut));
}

/// `name type` of the inputs or outputs that the model description lists.
fn border(built: &Built, name: &str, side: &str) -> Vec<String> {
    let text = fs::read_to_string(built.path().join(format!("{name}.json"))).unwrap();
    let model: serde_json::Value = serde_json::from_str(&text).unwrap();
    let text = |point: &serde_json::Value, key: &str| point[key].as_str().unwrap().to_owned();
    model[side].as_array().unwrap().iter().map(|point| text(point, "name") + " " + &text(point, "type")).collect()
}

#[test]
fn the_controller_has_the_measurements_as_inputs_and_the_moves_as_outputs() {
    let built = alone(&cases::find("paper_gpc_cut"), Width::F64);
    assert_eq!(border(&built, "paper_gpc_cut", "inputs"), ["y1 real", "y2 real"]);
    assert_eq!(border(&built, "paper_gpc_cut", "outputs"), ["u1 real", "u2 real"]);
    let said = check(cases::find("paper_gpc_cut").command("build").arg("-o").arg(built.path()));
    assert!(said.contains("3 of PLANT left out"), "{said}");
    assert!(said.contains("inputs:  y1, y2\n  outputs: u1, u2\n"), "{said}");
}

/// Both parts of a case, emitted into one folder.
fn parts(case: &cases::Case) -> Built {
    let built = Built::empty();
    for part in ["control", "plant"] {
        check(case.command("build").args(["--part", part, "-o"]).arg(built.path()));
    }
    built
}

#[test]
fn emitted_plant_and_emitted_controller_coupled_give_the_trace_again() {
    let case = cases::find("paper_gpc_cut");
    let built = parts(&case);
    assert_eq!(border(&built, "paper_gpc_cut_plant", "inputs"), ["u1 real", "u2 real"]);
    assert_eq!(border(&built, "paper_gpc_cut_plant", "outputs"), ["y1 real", "y2 real"]);
    let program = built.path().join("coupled");
    built.link(&root().join("tests/c/coupled.c"), &["-std=c99", "-O2", "-ffp-contract=off"], &program);
    let coupled = coupled(&program, &case.folder.join("stimulus.csv"));

    let reference = Table::read(&fs::read_to_string(case.folder.join("trace.csv")).unwrap());
    assert_eq!(coupled.rows.len(), 120);
    compare(&coupled, &reference, Tolerance { relative: 1e-9, absolute: 1e-12 }).unwrap();
    let simulated = Table::read(&case.trace(case.run("embedded", Width::F64)).unwrap());
    for name in ["w", "y1", "u1", "y2", "u2"] {
        assert_eq!(coupled.values(name), simulated.values(name), "{name}");
    }
}

fn coupled(program: &Path, stimulus: &Path) -> Table {
    let mut command = Command::new(program);
    let output = run(command.stdin(Stdio::from(fs::File::open(stimulus).unwrap())));
    assert!(output.status.success(), "{}", output.status);
    Table::read(&String::from_utf8(output.stdout).unwrap())
}
