//! Random nets: the embedded engine and every form of the C give the same trace.
//!
//! `PCL2_RANDOM_NETS` is how many nets are compared; `cargo xtask nets` sets it for the long form.

use pcl2_tests::definition::model::Net;
use pcl2_tests::definition::text;
use pcl2_tests::random_nets::{Wanted, configuration, dice, net, shared_stimulus};
use pcl2_tests::{none, pcl2, run};
use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;

/// Nets of one program.
const BATCH: usize = 50;
/// The long form tells how far it is after so many programs.
const PROGRESS: u64 = 50;
const SCANS: usize = 1000;

fn batch(folder: &Path, seed: u64) {
    let mut dice = dice(seed);
    // Nets of one program share inputs: one that is never at rest would hide what a quiet scan does to the others.
    let wanted = Wanted { classes: seed % 2 == 1, modes: true, calm: seed % 3 == 2 };
    let nets: Vec<Net> = (0..BATCH).map(|i| net(&mut dice, &format!("r{i}"), wanted)).collect();
    for (name, text) in nets.iter().flat_map(text::files) {
        fs::write(folder.join(name), text).unwrap();
    }
    fs::write(folder.join("main.cfg"), configuration(&nets)).unwrap();
    fs::write(folder.join("stimulus.csv"), shared_stimulus(&mut dice, &nets, SCANS)).unwrap();
}

fn traced(folder: &Path, compiler: &str, more: &[&str]) -> String {
    let mut command = pcl2();
    command.arg("run").arg(folder.join("main.cfg")).args(["--period", "0.25", "--trace", "-"]);
    command.arg("--stimulus").arg(folder.join("stimulus.csv")).args(["--steps", &SCANS.to_string()]);
    let output = run(command.env("CC", compiler).args(more));
    assert!(output.status.success(), "{more:?}: {}", String::from_utf8_lossy(&output.stderr));
    // The faults of the health record stand behind the trace.
    String::from_utf8(output.stdout).unwrap() + &String::from_utf8(output.stderr).unwrap()
}

/// The first place where two traces differ: scan, column, values; and the net.
fn difference(folder: &Path, a: &str, b: &str) -> Option<String> {
    let names: Vec<&str> = a.lines().next()?.split(',').collect();
    for (scan, (x, y)) in a.lines().zip(b.lines()).skip(1).enumerate() {
        let row = x.split(',').zip(y.split(','));
        if let Some((i, (x, y))) = row.enumerate().find(|(_, (x, y))| x != y) {
            let net = names[i].split('.').next()?.strip_prefix('N')?;
            let text = fs::read_to_string(folder.join(format!("r{net}.net"))).unwrap_or_default();
            return Some(format!("{} in scan {scan}: {x} and {y}\n{text}", names[i]));
        }
    }
    (a != b).then(|| "lengths".to_owned())
}

/// What differs between the engine and the forms.
fn compare(seed: u64, compiler: &str) -> Option<String> {
    let folder = tempfile::tempdir().unwrap();
    batch(folder.path(), seed);
    let embedded = traced(folder.path(), compiler, &[]);
    ["fast", "table"].iter().find_map(|form| {
        let compiled = traced(folder.path(), compiler, &["--engine", "cc", "--net-form", form]);
        let found = difference(folder.path(), &embedded, &compiled)?;
        Some(format!("seed {seed}, {form}: {found}"))
    })
}

fn wanted() -> u64 {
    std::env::var("PCL2_RANDOM_NETS").ok().and_then(|text| text.parse().ok()).unwrap_or(2000)
}

#[test]
fn random_nets_are_the_same_in_every_form() {
    let (batches, next) = (wanted().div_ceil(BATCH as u64), AtomicU64::new(0));
    let work = || {
        let mut found = Vec::new();
        loop {
            let seed = next.fetch_add(1, Ordering::Relaxed);
            if seed >= batches {
                return found;
            }
            if seed != 0 && seed % PROGRESS == 0 {
                eprintln!("{} nets", seed * BATCH as u64);
            }
            // A long run tells all that it finds, and each at once.
            found.extend(compare(seed, "tcc").inspect(|difference| eprintln!("{difference}")));
        }
    };
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let found = thread::scope(|scope| {
        let threads: Vec<_> = (0..cores).map(|_| scope.spawn(work)).collect();
        threads.into_iter().flat_map(|thread| thread.join().unwrap()).collect::<Vec<_>>()
    });
    none(&found);
}

#[test]
fn random_nets_are_the_same_under_optimisation() {
    none(&(1000..1002).filter_map(|seed| compare(seed, "gcc")).collect::<Vec<_>>());
}
