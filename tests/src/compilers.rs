//! C compilers, and the C that a build writes.

use crate::cases::{Case, Width};
use crate::{pcl2, run};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

/// The flags under which every C file of ours compiles without a warning.
pub const STRICT: [&str; 16] = [
    "-std=c99",
    "-pedantic",
    "-Wall",
    "-Wextra",
    "-Wconversion",
    "-Wsign-conversion",
    "-Wshadow",
    "-Wdouble-promotion",
    "-Wmissing-prototypes",
    "-Wstrict-prototypes",
    "-Wundef",
    "-Wcast-qual",
    "-Werror",
    "-ffp-contract=off",
    "-fno-common",
    "-O2",
];

/// A Cortex-M4 whose float instructions are all calls: they show in the object's symbols.
pub const CORTEX_M: [&str; 4] = ["-mcpu=cortex-m4", "-mthumb", "-Os", "-ffunction-sections"];

/// The most cases that one compiler call takes.
const BATCH: usize = 64;

/// A folder with emitted C.
#[derive(Debug)]
pub struct Built {
    folder: TempDir,
    /// What the build wrote to standard output.
    pub said: String,
    /// The cases in it.
    pub cases: Vec<String>,
}

/// A folder that goes away by itself.
///
/// # Panics
/// When there is no room.
pub fn folder() -> TempDir {
    tempfile::Builder::new().prefix("pcl2-test-").tempdir().expect("a temporary folder")
}

/// Builds these cases in one width: the plain ones together, the others one by one.
///
/// # Panics
/// When a build fails.
pub fn build(cases: &[Case], width: Width) -> Vec<Built> {
    let (plain, others): (Vec<&Case>, Vec<&Case>) = cases.iter().partition(|case| case.is_plain());
    let mut built: Vec<Built> = plain.chunks(BATCH).map(|batch| together(batch, width)).collect();
    built.extend(others.into_iter().map(|case| alone(case, width)));
    built
}

fn together(cases: &[&Case], width: Width) -> Built {
    let folder = folder();
    let mut command = pcl2();
    command.arg("build").args(cases.iter().map(|case| case.path()));
    finish(command, cases, width, folder)
}

/// Builds one case.
///
/// # Panics
/// When the build fails.
pub fn alone(case: &Case, width: Width) -> Built {
    let folder = folder();
    let mut command = case.command("build");
    if !case.has("pcl2.toml") {
        command.args(["--period", "0.1"]);
    }
    finish(command, &[case], width, folder)
}

fn finish(mut command: Command, cases: &[&Case], width: Width, folder: TempDir) -> Built {
    command.args(["--real", width.name(), "-o"]).arg(folder.path());
    let said = check(&mut command);
    Built { folder, said, cases: cases.iter().map(|case| case.name.clone()).collect() }
}

impl Built {
    /// An empty folder for builds with options of their own.
    pub fn empty() -> Built {
        Built { folder: folder(), said: String::new(), cases: Vec::new() }
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// All C files.
    pub fn sources(&self) -> Vec<PathBuf> {
        files(self.path(), "c")
    }

    /// The folders to search for headers.
    pub fn includes(&self) -> Vec<PathBuf> {
        let headers = files(self.path(), "h");
        let mut folders: Vec<PathBuf> =
            headers.iter().filter_map(|path| path.parent()).map(Path::to_path_buf).collect();
        folders.sort();
        folders.dedup();
        folders
    }

    /// Compiles every C file by itself, all in one call, into objects in a folder of their own.
    ///
    /// # Panics
    /// When the compiler says anything.
    pub fn compile(&self, compiler: &str, flags: &[&str]) -> TempDir {
        let objects = folder();
        let mut left = self.sources();
        for turn in 0.. {
            // Objects get the names of their sources: of two with one name, such as a program and a kernel, one has to wait.
            let mut names = BTreeSet::new();
            let (now, later): (Vec<_>, Vec<_>) =
                left.into_iter().partition(|path| names.insert(path.file_name().map(ToOwned::to_owned)));
            let place = objects.path().join(turn.to_string());
            fs::create_dir(&place).expect("a folder");
            let mut command = Command::new(compiler);
            command.args(flags).arg("-c").current_dir(&place);
            for include in self.includes() {
                command.arg("-I").arg(include);
            }
            check(command.args(&now));
            if later.is_empty() {
                break;
            }
            left = later;
        }
        objects
    }

    /// The bytes of an instance that the build told of each program are those that a C compiler counts.
    ///
    /// # Panics
    /// When one differs, or none was told.
    pub fn counts_bytes(&self) {
        let asserts = folder();
        let mut programs = Vec::new();
        let mut name = "";
        for line in self.said.lines() {
            if let Some(rest) = line.strip_prefix("  RAM:") {
                let bytes = rest.split_whitespace().next().expect("a number");
                let path = asserts.path().join(format!("{name}.c"));
                let text = format!("#include \"{name}.h\"\ntypedef char told[sizeof({name}) == {bytes} ? 1 : -1];\n");
                fs::write(&path, text).expect("a file");
                programs.push(path);
            } else if !line.starts_with(' ') {
                name = line.split(':').next().unwrap_or_default();
            }
        }
        assert!(!programs.is_empty(), "{}", self.said);
        let mut command = Command::new("gcc");
        command.arg("-fsyntax-only");
        for include in self.includes() {
            command.arg("-I").arg(include);
        }
        check(command.args(&programs));
    }

    /// Links a program of one main file with the C of the folder, examples left out.
    ///
    /// # Panics
    /// When the compiler says anything.
    pub fn link(&self, main: &Path, flags: &[&str], program: &Path) {
        let mut command = Command::new("gcc");
        command.args(flags).arg("-o").arg(program).arg(main);
        for include in self.includes() {
            command.arg("-I").arg(include);
        }
        let own = |path: &PathBuf| !path.to_string_lossy().ends_with("_example.c") && !self.is_included(path);
        command.args(self.sources().into_iter().filter(own)).arg("-lm");
        check(&mut command);
    }

    /// Whether another file takes this one in with `#include`: the kernels of small programs.
    fn is_included(&self, path: &Path) -> bool {
        let name = path.strip_prefix(self.path()).unwrap_or(path).display().to_string();
        let line = format!("#include \"{name}\"");
        self.sources().iter().any(|other| fs::read_to_string(other).is_ok_and(|text| text.contains(&line)))
    }
}

/// All files below a folder whose names end so, in order.
///
/// # Panics
/// When the folder cannot be read.
pub fn files(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut open = vec![folder.to_path_buf()];
    while let Some(next) = open.pop() {
        for entry in fs::read_dir(&next).unwrap_or_else(|error| panic!("{}: {error}", next.display())) {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|known| known == extension) {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// Runs a command that must succeed, and hands out what it wrote to standard output.
///
/// # Panics
/// When it fails.
pub fn check(command: &mut Command) -> String {
    let output = run(command);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}: {}\n{said}", output.status);
    String::from_utf8_lossy(&output.stdout).into_owned()
}
