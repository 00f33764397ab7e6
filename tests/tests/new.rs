//! `pcl2 new`: the project runs at once, as its README says.

use pcl2_tests::compilers::{check, folder};
use pcl2_tests::fences::fences;
use pcl2_tests::{none, pcl2, run};
use std::fs;
use std::process::Command;

#[test]
fn the_commands_of_the_readme_work() {
    let work = folder();
    let output = run(pcl2().args(["new", "tank_1"]).current_dir(work.path()));
    assert!(output.status.success(), "{output:?}");
    let project = work.path().join("tank_1");
    let readme = fs::read_to_string(project.join("README.md")).unwrap();
    let commands: Vec<String> = fences(&readme).into_iter().map(|fence| fence.text.trim().to_owned()).collect();
    assert_eq!(commands.len(), 3);
    let said = String::from_utf8(output.stdout).unwrap();
    let printed: Vec<&str> = said.lines().skip(1).map(str::trim).collect();
    assert_eq!(printed[0], "cd tank_1");
    assert_eq!(printed[1..], commands);
    for command in &commands {
        let arguments: Vec<&str> = command.strip_prefix("pcl2 ").unwrap().split_whitespace().collect();
        let output = run(pcl2().args(&arguments).current_dir(&project));
        let warned = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success() && warned.is_empty(), "{command}: {warned}");
    }
    let trace = fs::read_to_string(project.join("trace.csv")).unwrap();
    let at = |scan: usize, column: &str| {
        let head = trace.lines().next().unwrap().split(',').position(|name| name == column).unwrap();
        trace.lines().nth(scan + 1).unwrap().split(',').nth(head).unwrap().parse::<f64>().unwrap()
    };
    assert!((at(159, "T") - 60.).abs() < 0.5 && (at(319, "T") - 90.).abs() < 0.5, "it settles");
    assert!((at(330, "TIC") - 30.).abs() < 1e-9 && (at(480, "T") - 60.).abs() < 1., "it is manual");
    check(Command::new("make").args(["-C", "build", "-s"]).current_dir(&project));
    let layout = run(pcl2().args(["fmt", "--check", "."]).current_dir(&project));
    assert!(layout.status.success(), "{layout:?}");
}

#[test]
fn nothing_is_overwritten_and_names_are_names() {
    let work = folder();
    fs::create_dir(work.path().join("there")).unwrap();
    fs::write(work.path().join("file"), "mine").unwrap();
    let long = "x".repeat(64);
    let mut complaints = Vec::new();
    for name in ["there", "file", "", "1tank", "a-b", "../up", "a/b", ".", "t\u{e4}nk", long.as_str()] {
        let output = run(pcl2().args(["new", "--", name]).current_dir(work.path()));
        if output.status.code() != Some(2) || !output.stderr.starts_with(b"error: ") {
            complaints.push(format!("{name}: {output:?}"));
        }
    }
    none(&complaints);
    assert_eq!(fs::read(work.path().join("file")).unwrap(), b"mine");
    assert_eq!(fs::read_dir(work.path()).unwrap().count(), 2);
    assert_eq!(fs::read_dir(work.path().join("there")).unwrap().count(), 0);
}
