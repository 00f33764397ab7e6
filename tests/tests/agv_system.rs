//! The AGV system: its size, its generator, and what its vehicles do.

use pcl2_tests::cases::{Width, example};
use pcl2_tests::compilers::{check, files, folder};
use pcl2_tests::pcl2;
use pcl2_tests::table::{Table, same_text};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const VEHICLES: usize = 5;

fn here() -> PathBuf {
    example("agv_system").folder
}

/// The files of a folder, by name from there.
fn texts(folder: &Path) -> BTreeMap<String, String> {
    let all = ["net", "fc", "c"].into_iter().flat_map(|extension| files(folder, extension));
    all.map(|path| (path.strip_prefix(folder).unwrap().display().to_string(), fs::read_to_string(path).unwrap()))
        .collect()
}

#[test]
fn the_generator_writes_what_is_there() {
    let work = folder();
    check(Command::new("python3").arg("-B").arg(here().join("generate.py")).arg(work.path()));
    let (written, mut kept) = (texts(work.path()), texts(&here()));
    assert!(kept.remove("car.net").is_some(), "written by hand");
    assert_eq!(written.keys().collect::<Vec<_>>(), kept.keys().collect::<Vec<_>>());
    for (name, text) in &kept {
        same_text(name, text, &written[name]).unwrap();
    }
}

fn net(name: &str) -> String {
    fs::read_to_string(here().join(name)).unwrap()
}

fn lines(text: &str, words: &[&str]) -> usize {
    text.lines().filter(|line| words.contains(&line.split(' ').next().unwrap_or_default())).count()
}

/// Nagao and Kumagai: 284 boxes, 281 gates, 63 logical I/O, 5 classes, 82 user functions. Boxes and gates of all five
/// vehicles count, a macro and the boxes inside it too.
#[test]
fn the_system_has_the_size_of_the_papers() {
    let nets = ["agvs.net", "agv.net", "travel.net"].map(net);
    let boxes = ["STATE", "CAPACITY", "TIME", "PROCESS", "COUNT", "GENERATE", "ENTRY", "EXIT", "MACRO"];
    let instances = [1, lines(&nets[0], &["MODULE"]), lines(&nets[0], &["MODULE"]) * lines(&nets[1], &["MACRO"])];
    assert_eq!(instances, [1, VEHICLES, VEHICLES]);
    let all = |words: &[&str]| -> usize { nets.iter().zip(instances).map(|(net, n)| n * lines(net, words)).sum() };
    assert_eq!((all(&boxes), all(&["GATE"])), (284, 281));
    let head = nets[0].split("CLASS").next().unwrap();
    assert_eq!(head.matches("int ").count(), 63);
    let classes: BTreeSet<&str> = nets.iter().flat_map(|net| net.split("CLASS ").skip(1)).collect();
    let classes: BTreeSet<&str> = classes.into_iter().filter_map(|text| text.split(' ').next()).collect();
    assert_eq!(classes.into_iter().collect::<Vec<_>>(), ["event", "job", "place", "request", "vehicle"]);
    let functions: BTreeSet<String> = files(&here().join("functions"), "fc")
        .iter()
        .map(|path| path.file_stem().unwrap().to_string_lossy().into_owned())
        .collect();
    assert_eq!(functions.len(), 82);
    for name in &functions {
        assert!(nets.iter().any(|net| net.contains(&format!("= {name} ("))), "{name} is never called");
    }
}

/// What a vehicle does, in order: the scan, and what.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Deed {
    /// Through a zone, so many stations far.
    Run(usize, usize),
    Load,
    Unload,
    Charge,
}

struct Trip(Vec<(usize, Deed)>);

fn trace() -> Table {
    let case = example("agv_system");
    Table::read(&case.trace(case.run("embedded", Width::F64)).unwrap())
}

fn deeds(trace: &Table, vehicle: usize) -> Trip {
    let column = |name: &str| trace.values(&format!("{name}{vehicle}"));
    let (word, runs) = (column("S.word"), trace.values(&format!("C{vehicle}.runs")));
    let (load, unload, charge) = (column("S.load"), column("S.unload"), column("S.charge"));
    let mut deeds = Vec::new();
    let begins = |signal: &[f64], k: usize| signal[k] > 0.0 && signal[k - 1] == 0.0;
    for k in 1..word.len() {
        if begins(&runs, k) {
            deeds.push((k, Deed::Run(word[k] as usize / 100, word[k] as usize % 10)));
        }
        for (signal, deed) in [(&load, Deed::Load), (&unload, Deed::Unload), (&charge, Deed::Charge)] {
            if begins(signal, k) {
                deeds.push((k, deed));
            }
        }
    }
    Trip(deeds)
}

/// The zones behind a zone.
fn behind(zone: usize) -> Vec<usize> {
    let mut zones = vec![if zone == 12 { 1 } else { zone + 1 }];
    zones.extend(match zone {
        3 => Some(10),
        9 => Some(4),
        _ => None,
    });
    zones
}

/// How many zones further a zone is: by trying all ways.
fn far(start: usize, goal: usize) -> usize {
    let mut reached = BTreeSet::from([start]);
    let mut steps = 0;
    while !reached.contains(&goal) {
        let more: Vec<usize> = reached.iter().flat_map(|zone| behind(*zone)).collect();
        reached.extend(more);
        steps += 1;
    }
    steps
}

/// The transports of a vehicle: the scan in which it loads, and both stations.
fn transports(trip: &Trip) -> Vec<(usize, usize, usize)> {
    let mut station = 0;
    let (mut picked, mut done) = (None, Vec::new());
    for (scan, deed) in &trip.0 {
        match deed {
            Deed::Run(zone, stations) => station = 4 * (zone - 1) + stations,
            Deed::Load => picked = Some((*scan, station)),
            Deed::Unload => {
                let (scan, pick) = picked.take().unwrap();
                done.push((scan, pick, station));
            }
            Deed::Charge => assert!(picked.is_none(), "charged with a load"),
        }
    }
    assert!(picked.is_none());
    done
}

/// Of ten orders one names a station that is not there, and one is cancelled; the others are carried out, each once.
#[test]
fn every_order_is_carried_out_once() {
    let trace = trace();
    let mut done: Vec<(usize, usize, usize)> =
        (1..=VEHICLES).flat_map(|vehicle| transports(&deeds(&trace, vehicle))).collect();
    done.sort_unstable();
    let mut pairs: Vec<(usize, usize)> = done.iter().map(|(_, pick, drop)| (*pick, *drop)).collect();
    let third_wave = pairs.iter().position(|pair| *pair == (36, 9)).unwrap();
    let later = |pair| pairs.iter().position(|known| *known == pair).unwrap() > third_wave;
    assert!(later((1, 28)) && later((13, 45)), "the urgent order goes first");
    pairs.sort_unstable();
    assert_eq!(pairs, [(1, 28), (7, 40), (13, 45), (18, 22), (25, 3), (30, 16), (36, 9), (44, 7)]);
    let last = trace.rows.len() - 1;
    assert_eq!((trace.values("S.done")[last], trace.values("S.refused")[last]), (8.0, 1.0));
    // Nobody sets out between the stop at 125 s and 150 s: the queue stands, although a vehicle comes free at 131 s.
    let queue = trace.values("S.queue");
    assert!(trace.values("S.done")[270] == 1.0 && queue[250..299].iter().all(|waiting| *waiting == queue[250]));
    assert!(queue[302] < queue[250]);
}

/// Each vehicle goes on from zone to zone, by the shortest way, and takes the time of the zone's length and speed.
#[test]
fn vehicles_take_the_shortest_way() {
    let trace = trace();
    for vehicle in 1..=VEHICLES {
        let trip = deeds(&trace, vehicle);
        let runs = trace.values(&format!("C{vehicle}.runs"));
        let (mut from, mut way, mut loaded) = (None, Vec::new(), false);
        for (scan, deed) in &trip.0 {
            let Deed::Run(zone, stations) = *deed else {
                // At a stop: as many zones as the shortest way has, the first one too.
                let (first, last) = (way[0], *way.last().unwrap());
                assert_eq!(way.len(), far(first, last) + 1, "vehicle {vehicle}: {way:?}");
                assert!(from.is_none_or(|zone| zone == first), "vehicle {vehicle} jumps to {first}");
                (from, way) = (Some(last), Vec::new());
                loaded = *deed == Deed::Load;
                continue;
            };
            assert!(way.last().is_none_or(|last| behind(*last).contains(&zone)), "vehicle {vehicle}: {way:?}, {zone}");
            way.push(zone);
            let speed = match ([3, 4, 9, 10].contains(&zone), loaded) {
                (true, false) => 0.8,
                (true, true) => 0.5,
                (false, false) => 1.0,
                (false, true) => 0.8,
            };
            // In scans of 0.5 s.
            let takes = (5.0 * stations as f64 / speed / 0.5 - 1e-9).ceil() as usize;
            let took = runs[*scan..].iter().take_while(|runs| **runs > 0.0).count();
            assert!(
                took == takes || scan + took == runs.len(),
                "vehicle {vehicle}, zone {zone}: {took}, not {takes} scans"
            );
        }
    }
}

/// Two vehicles are never in one zone: from the start in it until the start in the next, or the stop.
#[test]
fn a_zone_has_one_vehicle() {
    let trace = trace();
    let mut owners: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    for vehicle in 1..=VEHICLES {
        let trip = deeds(&trace, vehicle);
        for pair in trip.0.windows(2) {
            let ((start, Deed::Run(zone, _)), (end, _)) = (pair[0], pair[1]) else {
                continue;
            };
            for scan in start..end {
                let other = owners.insert((zone, scan), vehicle);
                assert_eq!(other, None, "zone {zone} in scan {scan}: vehicle {vehicle} and another");
            }
        }
    }
    assert!(owners.len() > 2000);
}

/// The user functions in C do what the composites do.
#[test]
fn functions_in_c_give_the_same_run() {
    let run = |functions: &str| {
        let mut command = pcl2();
        command.args([
            "run",
            "main.cfg",
            "--period",
            "0.5",
            "--engine",
            "cc",
            "--stimulus",
            "stimulus.csv",
            "--trace",
            "-",
        ]);
        check(command.args(["--blocks", functions]).current_dir(here()))
    };
    same_text("composites and C", &run("functions"), &run("functions_c")).unwrap();
}
