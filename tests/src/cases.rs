//! Golden cases: folders in `tests/cases`; and the examples, which are compared in the same way.

use crate::{pcl2, root, run};
use serde::Deserialize;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A folder in `tests/cases` or `examples`.
#[derive(Clone, Debug)]
pub struct Case {
    /// The folder's name.
    pub name: String,
    /// The folder.
    pub folder: PathBuf,
    /// What `case.toml` says.
    pub config: Config,
}

/// `case.toml`.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Config {
    /// How many scans; without it, as long as the stimulus, else ten.
    steps: Option<u64>,
    /// Arguments of check, build and run.
    pub args: Vec<String>,
    /// Arguments of run alone.
    run: Vec<String>,
    /// Snapshots that must be there.
    pub snapshots: Vec<String>,
    /// Expected diagnostics of a file that must not be changed: `main.cfg:18 warning P0005`.
    pub diagnostics: Vec<String>,
    relative: Option<f64>,
    absolute: Option<f64>,
    /// Why the tolerance is as it is.
    reason: Option<String>,
    f32: Single,
}

/// What a case says about floats.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Single {
    relative: Option<f64>,
    absolute: Option<f64>,
    reason: Option<String>,
    /// Whether they are compared with the reference at all.
    compare: Option<bool>,
}

/// How far a value may be from the reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Of the reference's value.
    pub relative: f64,
    /// Beside that.
    pub absolute: f64,
}

/// The width of reals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Width {
    /// C double
    F64,
    /// C float
    F32,
}

impl Width {
    /// Both widths.
    pub const ALL: [Width; 2] = [Width::F64, Width::F32];

    /// As the command line has it.
    pub fn name(self) -> &'static str {
        match self {
            Width::F64 => "f64",
            Width::F32 => "f32",
        }
    }

    fn standard(self) -> Tolerance {
        match self {
            Width::F64 => Tolerance { relative: 1e-9, absolute: 1e-12 },
            Width::F32 => Tolerance { relative: 1e-4, absolute: 1e-4 },
        }
    }
}

/// All cases, in order of name.
///
/// # Panics
/// When a case cannot be read.
pub fn all() -> Vec<Case> {
    below("tests/cases").iter().map(|folder| Case::read(folder)).collect()
}

/// All cases, and the examples that are projects.
///
/// # Panics
/// When one cannot be read.
pub fn with_examples() -> Vec<Case> {
    let examples = below("examples").into_iter().map(|folder| Case::read(&folder));
    all().into_iter().chain(examples.filter(|example| example.has("pcl2.toml"))).collect()
}

/// The folders in a folder, in order of name.
fn below(path: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"));
    let mut folders: Vec<PathBuf> =
        entries.map(|entry| entry.expect("an entry").path()).filter(|path| path.is_dir()).collect();
    folders.sort();
    folders
}

/// The example of this name.
///
/// # Panics
/// When there is none.
pub fn example(name: &str) -> Case {
    Case::read(&root().join("examples").join(name))
}

/// The case of this name.
///
/// # Panics
/// When there is none.
pub fn find(name: &str) -> Case {
    Case::read(&root().join("tests/cases").join(name))
}

impl Case {
    fn read(folder: &Path) -> Case {
        let name = folder.file_name().expect("a name").to_string_lossy().into_owned();
        let text = fs::read_to_string(folder.join("case.toml")).unwrap_or_default();
        let config = toml::from_str(&text).unwrap_or_else(|error| panic!("{name}/case.toml: {error}"));
        Case { name, folder: folder.to_path_buf(), config }
    }

    /// Whether the case's folder has this file.
    pub fn has(&self, file: &str) -> bool {
        self.folder.join(file).exists()
    }

    /// Whether it has C of its own, which the embedded engine cannot run.
    pub fn has_own_c(&self) -> bool {
        let blocks = self.folder.join("blocks");
        let has = |extension| !crate::compilers::files(&blocks, extension).is_empty();
        blocks.is_dir() && (has("c") || has("h"))
    }

    /// The width that the case is about.
    pub fn width(&self) -> Width {
        let text = fs::read_to_string(self.folder.join("pcl2.toml")).unwrap_or_default();
        if text.contains("real = \"f32\"") { Width::F32 } else { Width::F64 }
    }

    /// The folder where it is a project, else the source.
    pub fn path(&self) -> PathBuf {
        if self.has("pcl2.toml") { self.folder.clone() } else { self.folder.join("main.cfg") }
    }

    /// Whether it can be built together with others: nothing of its own on the command line or in C.
    pub fn is_plain(&self) -> bool {
        self.has("pcl2.toml") && self.config.args.is_empty() && !self.has("blocks")
    }

    /// A command on this case, started in its folder: the messages name files as they stand there.
    pub fn command(&self, command: &str) -> Command {
        let mut pcl2 = pcl2();
        pcl2.arg(command).arg(if self.has("pcl2.toml") { "." } else { "main.cfg" });
        pcl2.args(&self.config.args).current_dir(&self.folder);
        pcl2
    }

    /// A run with everything that the case says, the trace on standard output.
    pub fn run(&self, engine: &str, width: Width) -> Command {
        self.run_by(["--engine", engine], width)
    }

    /// The same on an emulated board.
    pub fn run_on(&self, target: &str, width: Width) -> Command {
        self.run_by(["--target", target], width)
    }

    fn run_by(&self, runner: [&str; 2], width: Width) -> Command {
        let mut command = self.command("run");
        command.args(runner).args(["--real", width.name(), "--trace", "-"]).args(&self.config.run);
        if self.has("stimulus.csv") {
            command.args(["--stimulus", "stimulus.csv"]);
        }
        match self.config.steps {
            Some(steps) => _ = command.args(["--steps", &steps.to_string()]),
            None if self.has("stimulus.csv") => {}
            None => _ = command.args(["--steps", "10"]),
        }
        if !self.has("pcl2.toml") {
            command.args(["--period", "0.1"]);
        }
        command
    }

    /// The trace of such a run.
    ///
    /// # Errors
    /// When the run fails.
    pub fn trace(&self, command: Command) -> Result<String, String> {
        self.ran(command).map(|(trace, _)| trace)
    }

    /// The trace of such a run, and what it says about faults and refused sets.
    ///
    /// # Errors
    /// When the run fails.
    pub fn ran(&self, mut command: Command) -> Result<(String, String), String> {
        let Output { status, stdout, stderr } = run(&mut command);
        let said = String::from_utf8_lossy(&stderr).into_owned();
        if !status.success() {
            return Err(format!("{status}\n{said}"));
        }
        Ok((String::from_utf8(stdout).expect("text"), said))
    }

    /// The tolerance in this width; `None`: not compared. A looser one than the standard needs a reason.
    ///
    /// # Errors
    /// When the reason is missing.
    pub fn tolerance(&self, width: Width) -> Result<Option<Tolerance>, String> {
        let (config, standard) = (&self.config, width.standard());
        let (relative, absolute, reason, compare) = match width {
            Width::F64 => (config.relative, config.absolute, &config.reason, None),
            Width::F32 => (config.f32.relative, config.f32.absolute, &config.f32.reason, config.f32.compare),
        };
        let (relative, absolute) = (relative.unwrap_or(standard.relative), absolute.unwrap_or(standard.absolute));
        let skipped = compare == Some(false);
        let looser = relative > standard.relative || absolute > standard.absolute || skipped;
        if looser && reason.as_deref().unwrap_or_default().is_empty() {
            return Err(format!("a looser tolerance in {} needs a reason in case.toml", width.name()));
        }
        Ok((!skipped).then_some(Tolerance { relative, absolute }))
    }
}
