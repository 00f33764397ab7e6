//! Runs of nets in the embedded engine and in both forms of their C, and what the checker says of faulty ones.

use crate::{pcl2, run};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// The values of each column of a trace.
pub type Trace = BTreeMap<String, Vec<f64>>;

/// Runs a program and returns the text of its trace.
pub fn run_in(path: &Path, args: &[&str], engine: &[&str]) -> Vec<u8> {
    let output = run(pcl2().arg("run").arg(path).args(["--trace", "-"]).args(args).args(engine));
    assert!(output.status.success(), "{engine:?}: {}", String::from_utf8_lossy(&output.stderr));
    output.stdout
}

/// Runs a program in the embedded engine and in each form of its C, and reads the trace that all of them give.
pub fn trace(path: &Path, args: &[&str]) -> Trace {
    let output = run_in(path, args, &[]);
    for form in FORMS {
        let compiled = run_in(path, args, &["--engine", "cc", "--net-form", form]);
        assert_eq!(String::from_utf8_lossy(&compiled), String::from_utf8_lossy(&output), "{form}");
    }
    read(&output)
}

/// Reads the text of a trace.
pub fn read(text: &[u8]) -> Trace {
    let mut reader = csv::Reader::from_reader(text);
    let names: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let mut trace = Trace::new();
    for row in reader.records() {
        for (name, value) in names.iter().zip(row.unwrap().iter()) {
            trace.entry(name.clone()).or_default().push(value.parse().unwrap_or(f64::NAN));
        }
    }
    trace
}

/// The forms of a net in C.
pub const FORMS: [&str; 2] = ["table", "fast"];

/// Runs nets written here: file name and text, the first is the program.
pub fn traced(files: &[(&str, &str)], stimulus: &str, args: &[&str]) -> Trace {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        fs::write(folder.path().join(name), text).unwrap();
    }
    let mut args = args.to_vec();
    let file = folder.path().join("stimulus.csv");
    let file = file.to_str().unwrap().to_owned();
    if !stimulus.is_empty() {
        fs::write(&file, stimulus).unwrap();
        args.extend(["--stimulus", &file]);
    }
    trace(&folder.path().join(files[0].0), &args)
}

/// The values of a column.
pub fn column<'t>(trace: &'t Trace, name: &str) -> &'t [f64] {
    trace.get(name).unwrap_or_else(|| panic!("no column {name} in {:?}", trace.keys()))
}

/// Checks a net called `bad`: how the command ended, and what it said.
pub fn checked(text: &str) -> (Option<i32>, String) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("bad.net"), text).unwrap();
    let output = run(pcl2().args(["check", "bad.net"]).current_dir(folder.path()));
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}
