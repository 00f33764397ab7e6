//! Random nets of every kind in the embedded engine, against what the definition of a net says, signal by signal.
//!
//! `PCL2_DEFINED_NETS` is how many nets are compared. What differs is told of a net as small as can be.

use pcl2_tests::definition::expression::Value;
use pcl2_tests::definition::model::Net;
use pcl2_tests::definition::{Fault, Run, text};
use pcl2_tests::random_nets::{Stimulus, Wanted, dice, net, smaller, written_out};
use pcl2_tests::{none, pcl2, run};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

const SCANS: usize = 120;
const PERIOD: i64 = 250_000_000;

/// What was compared.
#[derive(Default)]
struct Seen {
    scans: usize,
    happened: BTreeMap<&'static str, usize>,
}

/// What the embedded engine gives: the trace, and what it tells of faults. An error where it refuses the net or a value.
fn traced(folder: &Path, net: &Net, stimulus: &Stimulus) -> Result<(String, String), String> {
    for (name, text) in text::files(net) {
        fs::write(folder.join(name), text).unwrap();
    }
    fs::write(folder.join("stimulus.csv"), stimulus.text(net)).unwrap();
    let mut command = pcl2();
    command.arg("run").arg(folder.join(format!("{}.net", net.name))).args(["--period", "0.25", "--trace", "-"]);
    command.arg("--stimulus").arg(folder.join("stimulus.csv")).args(["--steps", &stimulus.scans.len().to_string()]);
    let output = run(&mut command);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    if !output.status.success() || told.contains("set refused") {
        return Err(told);
    }
    Ok((String::from_utf8_lossy(&output.stdout).into_owned(), told))
}

/// What differs first, in words.
fn difference(net: &Net, stimulus: &Stimulus, trace: &str, told: &str, seen: &mut Seen) -> Option<String> {
    let mut reader = csv::Reader::from_reader(trace.as_bytes());
    let names: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let mut defined = Run::new(net, PERIOD);
    let mut faults: Vec<(usize, Vec<Fault>)> = Vec::new();
    for (scan, (row, writes)) in reader.records().zip(&stimulus.scans).enumerate() {
        let (expected, faulty) = defined.scan(writes);
        let row = row.unwrap();
        let found: BTreeMap<&str, &str> = names.iter().map(String::as_str).zip(&row).collect();
        if let Some((name, (expected, found))) = first_difference(&expected, &found) {
            return Some(format!("{name} in scan {scan}: {expected:?} by the definition, {found} found"));
        }
        if !faulty.is_empty() {
            faults.push((scan, faulty));
        }
        seen.scans += 1;
    }
    defined.happened().into_iter().for_each(|(what, times)| *seen.happened.entry(what).or_default() += times);
    difference_in_faults(&faults, told)
}

type Different<'v> = (&'v str, (Value, &'v str));

fn first_difference<'v>(
    expected: &'v BTreeMap<String, Value>,
    found: &BTreeMap<&str, &'v str>,
) -> Option<Different<'v>> {
    let pairs = expected.iter().map(|(name, value)| (name.as_str(), (*value, found.get(name.as_str()).copied())));
    let mut pairs = pairs.map(|(name, (value, found))| (name, (value, found.unwrap_or("no column"))));
    pairs.find(|(_, (value, found))| !found.parse().is_ok_and(|found| value.same(Value::Real(found))))
}

/// Compares how many scans had a fault, and the scan and one of the faults of the first and of the last of them: more is
/// not told.
fn difference_in_faults(faults: &[(usize, Vec<Fault>)], told: &str) -> Option<String> {
    let line = |start: &str| told.lines().find_map(|line| line.strip_prefix(start)).unwrap_or_default();
    let is = |line: &str, (scan, faults): &(usize, Vec<Fault>)| {
        line.starts_with(&format!("scan {scan}, ")) && faults.iter().any(|fault| line.contains(words_of(*fault)))
    };
    let counted = line("faults: ").parse().unwrap_or(0) == faults.len();
    let first = faults.first().is_none_or(|fault| is(line("first fault: "), fault));
    let last = faults.len() < 2 || faults.last().is_none_or(|fault| is(line("last fault: "), fault));
    (!counted || !first || !last).then(|| format!("{faults:?} by the definition, found\n{told}"))
}

fn words_of(fault: Fault) -> &'static str {
    match fault {
        Fault::Lost => "it is lost",
        Fault::Conflict => "two different values",
        Fault::Late => "not complete within its supervision time",
        Fault::Forced => "an operator forced",
        Fault::Refused => "of an operator was refused",
    }
}

/// A net and a stimulus that still differ, with as little in them as can be.
fn smallest(folder: &Path, net: Net, stimulus: Stimulus) -> (Net, Stimulus) {
    let differs = |(net, stimulus): &(Net, Stimulus)| {
        // What lacks a box that it speaks of makes the definition fail.
        let found = std::panic::catch_unwind(|| {
            let (trace, told) = traced(folder, net, stimulus)?;
            Ok::<_, String>(difference(net, stimulus, &trace, &told, &mut Seen::default()))
        });
        matches!(found, Ok(Ok(Some(_))))
    };
    let steps = |(net, stimulus): &(Net, Stimulus)| -> Vec<(Net, Stimulus)> {
        let with_less = stimulus.smaller().into_iter().map(|less| (net.clone(), less));
        with_less.chain(smaller(net).into_iter().map(|less| (less, stimulus.clone()))).collect()
    };
    let length = |(net, stimulus): &(Net, Stimulus)| {
        text::files(net).values().map(String::len).sum::<usize>() + stimulus.text(net).len()
    };
    let plain = (written_out(&net), stimulus.clone());
    let mut at = if differs(&plain) { plain } else { (net, stimulus) };
    loop {
        let before = length(&at);
        let mut next = 0;
        while let Some(less) = steps(&at).into_iter().nth(next) {
            if length(&less) < length(&at) && differs(&less) {
                at = less;
            } else {
                next += 1;
            }
        }
        if length(&at) == before {
            return at;
        }
    }
}

/// What differs, told of a net as small as can be.
fn compare(seed: u64, seen: &mut Seen) -> Option<String> {
    let mut dice = dice(seed);
    let net = net(&mut dice, "r", Wanted { classes: true, modes: true, calm: seed % 3 == 2 });
    let stimulus = Stimulus::random(&mut dice, &net, SCANS);
    let folder = tempfile::tempdir().unwrap();
    let (trace, told) = traced(folder.path(), &net, &stimulus).unwrap_or_else(|told| panic!("net {seed}: {told}"));
    let found = difference(&net, &stimulus, &trace, &told, seen)?;
    eprintln!("net {seed}: {found}; what is the smallest one that differs?");
    let (net, stimulus) = smallest(folder.path(), net, stimulus);
    let (trace, told) = traced(folder.path(), &net, &stimulus).unwrap_or_else(|told| panic!("net {seed}: {told}"));
    let smaller = difference(&net, &stimulus, &trace, &told, &mut Seen::default()).unwrap_or_default();
    let files: Vec<String> = text::files(&net).into_values().collect();
    Some(format!("net {seed}: {found}\nsmaller: {smaller}\n{}\n{}", files.join("\n"), stimulus.text(&net)))
}

/// Each of these must have happened, or the comparison is of little.
const WANTED: [&str; 26] = [
    "BLOCKED tells",
    "COUNT emptied",
    "HOLD",
    "a command in manual mode",
    "a command refused",
    "a firing",
    "a firing by a later rule",
    "a firing with READ",
    "a firing with a weight",
    "a lost edge",
    "a macro aborted",
    "a macro entered",
    "a macro left",
    "a permissive that holds a gate back",
    "a process complete",
    "a process that is late",
    "a process that waits on",
    "a step",
    "a stop",
    "a token made",
    "a token taken that is not the first",
    "a token with attributes taken",
    "an edge that waits",
    "something forced",
    "two different writes",
    "two different writes across nets",
];

#[test]
fn random_nets_do_what_the_definition_says_scan_by_scan() {
    let wanted = std::env::var("PCL2_DEFINED_NETS").ok().and_then(|text| text.parse().ok()).unwrap_or(300);
    let mut seen = Seen::default();
    let found = (0..wanted).filter_map(|seed| compare(seed, &mut seen)).collect::<Vec<_>>();
    none(&found);
    for what in WANTED {
        assert!(seen.happened.contains_key(what), "never: {what}");
    }
    let all = SCANS * wanted as usize;
    assert_eq!(seen.scans, all);
}
