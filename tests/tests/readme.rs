//! Every command of the README works as it stands there.

use pcl2_tests::compilers::{check, files, folder};
use pcl2_tests::fences::{Fence, fences};
use pcl2_tests::{pcl2, root};
use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::Command;

/// What a command is replaced by, and why.
const REPLACED: [(&str, &str); 2] = [
    // The command was built already, in the profile of the tests.
    ("cargo run --release -- ", "pcl2 "),
    // This very suite: it is asked whether it is there.
    ("cargo xtask test", "cargo xtask test --help"),
];

#[test]
fn its_commands_run_in_order() {
    let work = folder();
    let page = fs::read_to_string(root().join("README.md")).unwrap();
    let path = prepare(work.path());
    let mut commands = 0;
    for fence in fences(&page) {
        if let Some(file) = &fence.file {
            fs::write(work.path().join(file), &fence.text).unwrap();
        } else if fence.language == "sh" {
            commands += script(&fence, work.path(), &path);
        } else if fence.language == "c" {
            fs::write(work.path().join("user.c"), &fence.text).unwrap();
            let mut compile = Command::new("gcc");
            compile.args(["-std=c99", "-Wall", "-Wextra", "-Werror", "-c", "-Ilevel", "-Ilevel/pcl2"]);
            for header in files(&work.path().join("level/pcl2"), "h") {
                compile.arg("-I").arg(header.parent().unwrap());
            }
            check(compile.arg("user.c").current_dir(work.path()));
        }
    }
    assert!(commands >= 5, "only {commands} commands");
    assert!(work.path().join("gpc.csv").is_file() && work.path().join("level/level.h").is_file());
}

/// A folder with the examples and a path on which `pcl2` is.
fn prepare(work: &Path) -> String {
    for name in
        ["examples", "crates", "Cargo.toml", "Cargo.lock", ".cargo", "tests", "blocks", "runtime-c", "docs", "bench"]
    {
        let _ = symlink(root().join(name), work.join(name));
    }
    let bin = work.join("bin");
    fs::create_dir(&bin).unwrap();
    symlink(pcl2().get_program(), bin.join("pcl2")).unwrap();
    format!("{}:{}", bin.display(), std::env::var("PATH").unwrap_or_default())
}

fn script(fence: &Fence, work: &Path, path: &str) -> usize {
    for line in fence.text.lines() {
        let replaced = REPLACED.iter().find(|(from, _)| line.starts_with(from));
        let command = replaced.map_or(line.to_owned(), |(from, to)| line.replacen(from, to, 1));
        let folder = if command.starts_with("cargo ") { root() } else { work.to_path_buf() };
        check(Command::new("sh").args(["-e", "-c", &command]).current_dir(folder).env("PATH", path));
    }
    fence.text.lines().count()
}
