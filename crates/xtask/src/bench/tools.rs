//! The command that is measured, a folder for what is made, C compilers.

use crate::shell::{root, say};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// What all areas use.
pub(crate) struct Tools {
    /// The command that is measured.
    pub(crate) pcl2: PathBuf,
    /// Smaller programs, fewer repetitions.
    pub(crate) quick: bool,
    scratch: PathBuf,
}

impl Tools {
    /// Builds the command, if none is given.
    pub(crate) fn new(pcl2: Option<&Path>, quick: bool) -> Result<Tools, String> {
        let target = target_folder();
        let pcl2 = match pcl2 {
            Some(file) => fs::canonicalize(file).map_err(|error| format!("{}: {error}", file.display()))?,
            None => built(&target)?,
        };
        let scratch = target.join("bench");
        Ok(Tools { pcl2, quick, scratch })
    }

    /// Removes what an earlier run made for an area.
    pub(crate) fn clear(&self, area: &str) {
        let _ = fs::remove_dir_all(self.scratch.join(area));
    }

    /// A folder of this name for what is made.
    pub(crate) fn folder(&self, name: &str) -> Result<PathBuf, String> {
        let folder = self.scratch.join(name);
        fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        Ok(folder)
    }

    /// A call of the measured command.
    pub(crate) fn command(&self, subcommand: &str) -> Command {
        let mut command = Command::new(&self.pcl2);
        command.arg(subcommand);
        command
    }

    /// A call that compiles a program to C.
    pub(crate) fn build(&self, source: &Path, folder: &Path, more: &[&str]) -> Command {
        let mut command = self.command("build");
        command.arg(source).arg("-o").arg(folder).args(["--period", "0.1"]).args(more);
        command
    }

    /// How many repetitions: fewer when quick.
    pub(crate) fn rounds(&self, rounds: usize) -> usize {
        if self.quick { rounds.div_ceil(3) } else { rounds }
    }
}

fn target_folder() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from)
}

fn built(target: &Path) -> Result<PathBuf, String> {
    say("building the command");
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.current_dir(root()).args(["build", "--release", "--quiet", "--package", "pcl2"]);
    output(&mut command)?;
    Ok(target.join("release/pcl2"))
}

/// The project's folder of hand-written C and programs for benchmarks.
pub(crate) fn bench_folder() -> PathBuf {
    root().join("bench")
}

/// Writes a file.
pub(crate) fn write(file: &Path, text: &str) -> Result<(), String> {
    fs::write(file, text).map_err(|error| format!("{}: {error}", file.display()))
}

/// Runs a program; what it said, or an error with what it said.
pub(crate) fn output(command: &mut Command) -> Result<Output, String> {
    let output = command.output().map_err(|error| format!("{command:?}: {error}"))?;
    if output.status.success() {
        return Ok(output);
    }
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    Err(format!("{command:?} ended with {}: {}", output.status, said.trim_end()))
}

/// Standard output of a program as text.
pub(crate) fn text(command: &mut Command) -> Result<String, String> {
    Ok(String::from_utf8_lossy(&output(command)?.stdout).into_owned())
}

/// A C compiler with the flags of all our compilations, and a built program's folder as include path.
pub(crate) fn compiler(name: &str, flags: &[&str], built: &Path) -> Result<Command, String> {
    let mut command = Command::new(name);
    command.args(["-std=c99", "-ffp-contract=off"]).args(flags).arg("-I").arg(built);
    for folder in runtime_folders(built)? {
        command.arg("-I").arg(folder);
    }
    Ok(command)
}

/// The folders of the runtime's part that a build wrote.
fn runtime_folders(built: &Path) -> Result<Vec<PathBuf>, String> {
    let runtime = built.join("pcl2");
    let mut folders: Vec<PathBuf> = entries(&runtime)?.into_iter().filter(|path| path.is_dir()).collect();
    folders.push(runtime);
    Ok(folders)
}

/// The runtime's C files that a build wrote; the linker takes what is needed.
pub(crate) fn runtime_sources(built: &Path) -> Result<Vec<PathBuf>, String> {
    let mut files = Vec::new();
    for folder in runtime_folders(built)? {
        files.extend(entries(&folder)?.into_iter().filter(|path| path.extension().is_some_and(|ending| ending == "c")));
    }
    Ok(files)
}

/// What is in a folder, in order of name.
pub(crate) fn entries(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let list = fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut paths: Vec<PathBuf> = list.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    Ok(paths)
}
