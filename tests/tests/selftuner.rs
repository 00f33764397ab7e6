//! The self-tuner: identification and predictive control in one scan.

use pcl2_tests::compilers::{Built, check};
use pcl2_tests::table::{Table, number};
use pcl2_tests::{pcl2, root};

#[test]
fn it_converges_and_tracks_while_the_gain_changes() {
    let project = root().join("examples/selftuner");
    let mut command = pcl2();
    command.arg("run").arg(&project).args(["--steps", "840", "--trace", "-", "--stimulus"]);
    let trace = Table::read(&check(command.arg(project.join("stimulus.csv"))));
    let (w, y) = (trace.values("w"), trace.values("y"));
    let settled = [119, 199, 359, 399, 599, 799, 839];
    for scan in settled {
        assert!((y[scan] - w[scan]).abs() < 0.01, "scan {scan}: w {} y {}", w[scan], y[scan]);
    }
    let (p, q) = ((-0.5_f64).exp(), (-1.25_f64).exp());
    for (scan, gain) in [(399, 1.0), (839, 2.5)] {
        let expected = [p + q, -p * q, gain * (1.0 - p) * (1.0 - q), 0.0];
        for (i, expected) in expected.into_iter().enumerate() {
            let found = trace.values(&format!("th[{}]", i + 1))[scan];
            assert!((found - expected).abs() < 0.01, "scan {scan}, th[{}]: {found}, expected {expected}", i + 1);
        }
    }
}

fn million(real: &str) {
    let built = Built::empty();
    for part in ["control", "plant"] {
        let mut command = pcl2();
        command.arg("build").arg(root().join("examples/selftuner")).args(["--real", real, "--part", part, "-o"]);
        check(command.arg(built.path()));
    }
    let program = built.path().join("program");
    built.link(&root().join("tests/c/selftuner.c"), &["-std=c99", "-O2", "-ffp-contract=off"], &program);
    let said = check(&mut std::process::Command::new(&program));
    let values: Vec<f64> = said.trim().split(", ").map(|part| number(part.split(' ').next_back().unwrap())).collect();
    let [w, y, u, faults] = values[..] else { panic!("{said}") };
    assert!((y - w).abs() < 1e-3 && (u - w).abs() < 1e-2 && faults < 1000.0, "{said}");
}

#[test]
fn a_million_scans_without_excitation_stay_finite_in_double() {
    million("f64");
}

#[test]
fn a_million_scans_without_excitation_stay_finite_in_float() {
    million("f32");
}
