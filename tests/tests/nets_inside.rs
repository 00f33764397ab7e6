//! The boxes of nets inside stand in traces, charts and maps under the names of the parts that they are in.

use pcl2_tests::compilers::{check, folder};
use pcl2_tests::fences::fences;
use pcl2_tests::nets::{Trace, column, trace, traced};
use pcl2_tests::{pcl2, root, run};
use std::fs;
use std::path::Path;

/// The nets of the page on nets.
fn page(folder: &Path) {
    for fence in fences(&fs::read_to_string(root().join("docs/nets.md")).unwrap()) {
        if let Some(file) = fence.file.as_ref().filter(|file| file.ends_with(".net")) {
            fs::write(folder.join(file), &fence.text).unwrap();
        }
    }
}

/// By hand: the press comes in scan 0, the dose begins in the next and takes 2 s, which are four scans. The valve sees
/// what the dose drives one scan later, and the dose is over when the valve has reported that it is shut.
#[test]
fn a_macro_and_a_module_show_their_boxes() {
    let work = folder();
    page(work.path());
    for real in ["f64", "f32"] {
        let args = ["--period", "0.5", "--steps", "9", "--set", "button=1", "--real", real];
        let trace = trace(&work.path().join("plant.net"), &args);
        let scans = |name: &str| -> Vec<usize> { (0..9).filter(|scan| column(&trace, name)[*scan] > 0.).collect() };
        assert_eq!(scans("plant.D.come"), [0]);
        assert_eq!(scans("plant.D.flow"), [1, 2, 3, 4]);
        assert_eq!(scans("plant.D.gone"), [5, 6]);
        assert_eq!(scans("plant.V.open"), [2, 3, 4, 5]);
        assert_eq!(scans("plant.V.shut"), [0, 1, 6, 7, 8]);
        assert_eq!(scans("plant.D"), [0, 1, 2, 3, 4, 5, 6]);
    }
}

/// Three deep, with indexes, twice in a program: each has its own. They can be recorded by name.
#[test]
fn nets_in_nets_show_theirs_under_dotted_names() {
    let outer = "int q = outer ( int a : )\nFOR i = 1 TO 2\nLOCAL int m[i]\nMODULE M[i] : m[i] = middle ( a : )\nNEXT\n\
                 OPERATION o MARKED DO q = m[1] + m[2]\nEND\n";
    let middle = "int q = middle ( int a : )\nSTATE off MARKED\nMODULE I : q = inner ( a : )\nEND\n";
    let inner = "int q = inner ( int a : )\nSTATE off[1] MARKED\nSTATE on DRIVES q\nGATE up : off[1] -> on IF a\nEND\n";
    let program =
        "CONTROL\n1 zero = msi ( : 0 )\n2 one = msi ( : 1 )\n3 A = outer ( zero : )\n4 B = outer ( one : )\nEND\n";
    let files = [("p.cfg", program), ("outer.net", outer), ("middle.net", middle), ("inner.net", inner)];
    let trace = traced(&files, "", &["--steps", "3"]);
    assert_eq!(column(&trace, "A.M[2].I.off[1]"), [1., 1., 1.]);
    assert_eq!(column(&trace, "B.M[1].I.off[1]"), [0., 0., 0.]);
    assert_eq!(column(&trace, "B.M[2].I.on"), [1., 1., 1.]);
    assert_eq!(column(&trace, "B.M[2].off"), [1., 1., 1.]);
    let names = "B.M[2].I.on,A.M[1].I.box";
    let recorded = traced(&files, "", &["--steps", "3", "--record", names]);
    let expected = ["@k", "@t", "A.M[1].I.off[1]", "A.M[1].I.on", "B.M[2].I.on"];
    assert_eq!(recorded.keys().map(String::as_str).collect::<Vec<_>>(), expected);
    assert!(expected[2..].iter().all(|name| recorded[*name] == trace[*name]));
}

/// A flat net has the boxes of the nets inside as its own: they hold the same tokens scan by scan.
#[test]
fn boxes_inside_hold_what_those_of_the_flat_net_hold() {
    let work = folder();
    page(work.path());
    let tank = fs::read_to_string(root().join("tests/nets/tank_hierarchical.net")).unwrap();
    fs::write(work.path().join("tank_hierarchical.net"), tank).unwrap();
    for entry in fs::read_dir(root().join("tests/nets")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "net") {
            fs::copy(&path, work.path().join(path.file_name().unwrap())).unwrap();
        }
    }
    let mut compared = 0;
    for (net, input) in [("line", "button=1"), ("tank_hierarchical", "press=1")] {
        let file = work.path().join(format!("{net}.net"));
        let flat = work.path().join("flat.net");
        check(pcl2().args(["net", "flatten"]).arg(&file).arg("-o").arg(&flat));
        let args = ["--steps", "30", "--period", "1", "--set", input];
        let (deep, flat): (Trace, Trace) = (trace(&file, &args), trace(&flat, &args));
        for (name, values) in deep.iter().filter(|(name, _)| name.matches('.').count() > 1) {
            let (_, inside) = name.split_once('.').unwrap();
            assert_eq!(column(&flat, &format!("flat.{}", inside.replace('.', "_"))), values, "{net}: {name}");
            compared += 1;
        }
    }
    assert!(compared > 10, "{compared} boxes");
}

/// The chart of a run has a lane for each of them, and the map and its JSON have a row for each net.
#[test]
fn charts_and_maps_have_them() {
    let work = folder();
    page(work.path());
    let at = |args: &[&str]| check(pcl2().current_dir(work.path()).args(args));
    at(&["run", "plant.net", "--period", "0.5", "--steps", "9", "--set", "button=1", "--plot", "plant.svg"]);
    let chart = fs::read_to_string(work.path().join("plant.svg")).unwrap();
    assert!(["plant.D.flow", "plant.V.open"].iter().all(|lane| chart.contains(&format!(">{lane}</text>"))), "{chart}");
    at(&["build", "plant.net", "--period", "0.5", "-o", "out"]);
    let map = fs::read_to_string(work.path().join("out/plant_map.c")).unwrap();
    assert!(map.contains("{\"plant.D.box\", offsetof(plant, plant.D.box), "), "{map}");
    let json: serde_json::Value =
        serde_json::from_slice(&fs::read(work.path().join("out/plant.json")).unwrap()).unwrap();
    let row = json["signals"].as_array().unwrap().iter().find(|row| row["name"] == "plant.V.box").unwrap();
    assert_eq!(row["elements"], serde_json::json!(["shut", "open"]));
    assert_eq!(json["kinds"][row["kind"].as_u64().unwrap() as usize]["type"], "ivec[2]");
    let refused =
        run(pcl2().current_dir(work.path()).args(["run", "plant.net", "--period", "1", "--set", "plant.D.flow=1"]));
    assert_eq!(refused.status.code(), Some(2), "{}", String::from_utf8_lossy(&refused.stderr));
}
