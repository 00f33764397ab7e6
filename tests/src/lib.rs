//! The test harness: tests enter where the command line enters.

pub mod cases;
pub mod compilers;
pub mod definition;
pub mod dice;
pub mod expect;
pub mod fences;
pub mod net_picture;
pub mod nets;
pub mod picture;
pub mod random_nets;
pub mod renamed;
pub mod special;
pub mod table;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

/// The workspace's root.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().map_or_else(PathBuf::new, Path::to_path_buf)
}

/// A command that runs `pcl2` as this source tree builds it, without colours.
pub fn pcl2() -> Command {
    let mut command = Command::new(binary());
    command.env("NO_COLOR", "1");
    command
}

/// Runs a command to its end.
///
/// # Panics
/// When it cannot be started.
pub fn run(command: &mut Command) -> Output {
    command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"))
}

/// Where the command is. Built once in each test process, in the profile and folder of the tests themselves:
/// cargo hands the path of a binary only to tests of the same package.
fn binary() -> &'static Path {
    static BINARY: OnceLock<PathBuf> = OnceLock::new();
    BINARY.get_or_init(|| {
        let folder = profile_folder();
        let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let profile = if name == "debug" { "dev" } else { &name };
        let mut build = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
        build.args(["build", "--quiet", "--package", "pcl2", "--profile", profile]).current_dir(root());
        build.arg("--target-dir").arg(folder.parent().unwrap_or(&folder));
        let output = run(&mut build);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        folder.join(format!("pcl2{}", std::env::consts::EXE_SUFFIX))
    })
}

/// `target/debug`: the test itself runs in `target/debug/deps`.
fn profile_folder() -> PathBuf {
    let test = std::env::current_exe().unwrap_or_default();
    let folder = test.ancestors().find(|folder| folder.file_name().is_some_and(|name| name == "deps"));
    folder.and_then(Path::parent).map_or_else(|| root().join("target/debug"), Path::to_path_buf)
}

/// Fails with all complaints at once.
///
/// # Panics
/// When there is one.
pub fn none(complaints: &[String]) {
    assert!(complaints.is_empty(), "{} complaints:\n\n{}\n", complaints.len(), complaints.join("\n\n"));
}
