//! Random nets of every kind against the definition of what a net does.
//!
//! `PCL2_DEFINED_NETS` is how many nets are compared.

use pcl2_tests::definition::expression::Value;
use pcl2_tests::definition::model::Net;
use pcl2_tests::definition::{Fault, Run, text};
use pcl2_tests::dice::Dice;
use pcl2_tests::random_nets::{Stimulus, Wanted, dice, net, smaller};
use pcl2_tests::{pcl2, run};
use std::fs;
use std::path::Path;

static HAPPENED: std::sync::Mutex<std::collections::BTreeMap<&str, usize>> =
    std::sync::Mutex::new(std::collections::BTreeMap::new());
static UNSETTLED: std::sync::Mutex<std::collections::BTreeMap<&str, usize>> =
    std::sync::Mutex::new(std::collections::BTreeMap::new());
const SCANS: usize = 120;
const PERIOD: i64 = 250_000_000;

/// What the embedded engine gives: the trace, and what it tells of faults.
fn traced(folder: &Path, net: &Net, stimulus: &Stimulus) -> Result<(String, String), String> {
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

fn text_of(fault: Fault) -> &'static str {
    match fault {
        Fault::Lost => "it is lost",
        Fault::Conflict => "different values",
        Fault::Late => "complete",
        Fault::Forced => "an operator forced",
        Fault::Refused => "of an operator was refused",
    }
}

fn write(folder: &Path, net: &Net, stimulus: &Stimulus) {
    for (name, text) in text::files(net) {
        fs::write(folder.join(name), text).unwrap();
    }
    fs::write(folder.join("stimulus.csv"), stimulus.text(net)).unwrap();
}

/// What differs first, in words.
fn difference(net: &Net, stimulus: &Stimulus, trace: &str, told: &str) -> Option<String> {
    let mut reader = csv::Reader::from_reader(trace.as_bytes());
    let names: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let mut defined = Run::new(net, PERIOD);
    let mut faults: Vec<(usize, Vec<Fault>)> = Vec::new();
    for (scan, (row, writes)) in reader.records().zip(&stimulus.scans).enumerate() {
        let (mut expected, seen) = defined.scan(writes);
        if scan + 1 == stimulus.scans.len() || defined.unsettled().is_some() {
            for (what, times) in defined.happened() {
                *HAPPENED.lock().unwrap().entry(what).or_insert(0) += times;
            }
            for fault in faults.iter().flat_map(|(_, faults)| faults) {
                *HAPPENED.lock().unwrap().entry(text_of(*fault)).or_insert(0) += 1;
            }
        }
        if let Some(why) = defined.unsettled() {
            *UNSETTLED.lock().unwrap().entry(why).or_insert(0) += 1;
            return None;
        }
        for (name, text) in names.iter().zip(row.unwrap().iter()) {
            let Some(expected) = expected.remove(name) else { continue };
            let found = if text == "nan" { f64::NAN } else { text.parse().unwrap() };
            if !expected.same(Value::Real(found)) {
                return Some(format!("{name} in scan {scan}: {expected:?} by the definition, {text} found"));
            }
        }
        if !expected.is_empty() {
            return Some(format!("not in the trace: {expected:?}"));
        }
        if !seen.is_empty() {
            faults.push((scan, seen));
        }
    }
    faulty(&faults, told)
}

/// Scans with a fault are counted; the first and the last are told.
fn faulty(faults: &[(usize, Vec<Fault>)], told: &str) -> Option<String> {
    let line = |start: &str| told.lines().find_map(|line| line.strip_prefix(start)).unwrap_or_default().to_owned();
    let count = line("faults: ").parse().unwrap_or(0);
    if count != faults.len() {
        return Some(format!("{count} scans with faults found, not {faults:?}\n{told}"));
    }
    for (start, fault) in [("first fault: ", faults.first()), ("last fault: ", faults.last())] {
        let line = line(start);
        if let Some((scan, kinds)) = fault {
            let right =
                line.starts_with(&format!("scan {scan}, ")) && kinds.iter().any(|kind| line.contains(text_of(*kind)));
            if !right && !line.is_empty() {
                return Some(format!("scan {scan}, {kinds:?} by the definition, {line} found"));
            }
        }
    }
    None
}

fn wanted() -> u64 {
    std::env::var("PCL2_DEFINED_NETS").ok().and_then(|text| text.parse().ok()).unwrap_or(300)
}

/// What differs between the embedded engine and the definition; an error where the net is none.
fn compared(folder: &Path, net: &Net, stimulus: &Stimulus) -> Result<Option<String>, String> {
    write(folder, net, stimulus);
    let (trace, told) = traced(folder, net, stimulus)?;
    Ok(difference(net, stimulus, &trace, &told))
}

/// A net and a stimulus that differ still, with less in them.
fn smallest(folder: &Path, mut net: Net, mut stimulus: Stimulus) -> (Net, Stimulus) {
    let differs = |net: &Net, stimulus: &Stimulus| {
        if stimulus.scans[0].get("mode").is_some_and(|mode| mode.int() == 3) {
            return false;
        }
        std::panic::catch_unwind(|| compared(folder, net, stimulus)).is_ok_and(|found| matches!(found, Ok(Some(_))))
    };
    let mut size = usize::MAX;
    let mut open = net.clone();
    open.boxes.iter_mut().for_each(|place| place.repeated = None);
    open.gates.iter_mut().for_each(|gate| gate.repeated = None);
    if differs(&open, &stimulus) {
        net = open;
    }
    let length = |net: &Net, stimulus: &Stimulus| {
        text::files(net).values().map(String::len).sum::<usize>() + stimulus.text(net).len()
    };
    while size != length(&net, &stimulus) {
        size = length(&net, &stimulus);
        stimulus = descend(stimulus, Stimulus::smaller, |less, than| {
            length(&net, less) < length(&net, than) && differs(&net, less)
        });
        net = descend(net, smaller, |less, than| {
            length(less, &stimulus) < length(than, &stimulus) && differs(less, &stimulus)
        });
    }
    (net, stimulus)
}

/// Takes each step that keeps the property.
fn descend<T>(mut thing: T, steps: impl Fn(&T) -> Vec<T>, keeps: impl Fn(&T, &T) -> bool) -> T {
    let mut at = 0;
    loop {
        let mut less = steps(&thing);
        if at >= less.len() {
            return thing;
        }
        if keeps(&less[at], &thing) {
            thing = less.swap_remove(at);
        } else {
            at += 1;
        }
    }
}

fn compare(seed: u64) -> Result<(), String> {
    let mut dice: Dice = dice(seed);
    let net = net(&mut dice, "r", Wanted { classes: true, modes: true });
    let stimulus = Stimulus::random(&mut dice, &net, SCANS);
    let folder = tempfile::tempdir().unwrap();
    if compared(folder.path(), &net, &stimulus).map_err(|e| format!("net {seed}: {e}"))?.is_none() {
        return Ok(());
    }
    if std::env::var("QUICK").is_ok() {
        return Err(format!("net {seed}: {:?}", compared(folder.path(), &net, &stimulus)));
    }
    let (net, stimulus) = smallest(folder.path(), net, stimulus);
    let found = compared(folder.path(), &net, &stimulus);
    let files: Vec<String> = text::files(&net).into_values().collect();
    Err(format!("net {seed}: {found:?}\n{}\n{}", files.join("\n"), stimulus.text(&net)))
}

#[test]
fn random_nets_do_what_the_second_definition_says() {
    let from: u64 = std::env::var("FROM").ok().and_then(|t| t.parse().ok()).unwrap_or(0);
    std::panic::set_hook(Box::new(|_| {}));
    for seed in from..from + wanted() {
        let r = std::panic::catch_unwind(|| compare(seed))
            .unwrap_or_else(|e| Err(format!("net {seed} panic {:?}", e.downcast_ref::<String>())));
        if let Err(e) = r {
            eprintln!("{e}");
        }
    }
    eprintln!("unsettled {:?}", UNSETTLED.lock().unwrap());
    eprintln!("happened {:?}", HAPPENED.lock().unwrap());
}
