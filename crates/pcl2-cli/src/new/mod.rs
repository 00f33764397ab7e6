//! `pcl2 new`: a project to begin with, a plant and a loop that run at once.

use crate::console;
use crate::outcome::Outcome;
use crate::output;
use clap::Args;
use pcl2_lang::syntax::MAX_NAME;
use std::fs;
use std::io;
use std::path::Path;

/// The files, with NAME where the project's name goes.
const FILES: [(&str, &str); 4] = [
    ("main.cfg", include_str!("main.cfg")),
    ("pcl2.toml", include_str!("project.toml")),
    ("stimulus.csv", include_str!("stimulus.csv")),
    ("README.md", include_str!("README.md")),
];

/// What a line of the README begins with that is to be typed.
const COMMAND: &str = "pcl2 ";

/// `pcl2 new`
#[derive(Args, Debug)]
pub(crate) struct NewArgs {
    /// The project's name: its folder, and the name in the C
    pub(crate) name: String,
}

/// Makes a project's folder.
pub(crate) fn new(args: &NewArgs) -> Outcome {
    let name = args.name.as_str();
    if !is_name(name) {
        console::error(&format!(
            "expected a name of a letter and at most {} more letters, digits and `_`, found `{name}`",
            MAX_NAME - 1
        ));
        return Outcome::Usage;
    }
    match create(Path::new(name), name) {
        Ok(()) => console::answer(&next(name)),
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
            console::error(&format!("`{name}` exists: nothing is written"));
            Outcome::Usage
        }
        Err(error) => {
            console::error(&format!("cannot make `{name}`: {error}"));
            Outcome::Failed
        }
    }
}

fn is_name(name: &str) -> bool {
    let first = name.bytes().next().is_some_and(|byte| byte.is_ascii_alphabetic());
    first && name.len() <= MAX_NAME && name.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
}

fn create(folder: &Path, name: &str) -> io::Result<()> {
    fs::create_dir(folder)?;
    FILES
        .iter()
        .try_for_each(|(file, text)| output::write_file(&folder.join(file), text.replace("NAME", name).as_bytes()))
}

/// What was made, and the commands of the README.
fn next(name: &str) -> String {
    let files: Vec<&str> = FILES.iter().map(|(file, _)| *file).collect();
    let readme = FILES.iter().find(|(file, _)| *file == "README.md").map_or("", |(_, text)| text);
    let commands: String = readme
        .lines()
        .filter(|line| line.starts_with(COMMAND))
        .map(|line| format!("  {}\n", line.replace("NAME", name)))
        .collect();
    format!("made {name} with {}; now:\n  cd {name}\n{commands}", files.join(", "))
}
