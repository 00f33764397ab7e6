//! `pcl2 params`: a program's parameters, what differs from the source, and back into its literals.

mod given;
mod save;
mod table;

use crate::args::{CommonArgs, Format};
use crate::console;
use crate::outcome::Outcome;
use crate::project::{self, Project};
use clap::Args;
use pcl2_lang::verify::Verified;
use pcl2_sim::names::Names;
use std::path::PathBuf;

/// `pcl2 params`
#[derive(Args, Debug)]
pub(crate) struct ParamsArgs {
    /// A .cfg or .net file, or a folder with pcl2.toml
    pub(crate) path: PathBuf,
    /// Values to compare with the source: lines NAME=VALUE, as `run --params` writes them
    #[arg(long, value_name = "FILE")]
    pub(crate) from: Option<PathBuf>,
    /// Print what differs from the source
    #[arg(long, requires = "from", conflicts_with = "save")]
    pub(crate) diff: bool,
    /// Write what differs into the literals of the source
    #[arg(long, requires = "from")]
    pub(crate) save: bool,
    /// How the table is printed
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(crate) format: Format,
    #[command(flatten)]
    pub(crate) common: CommonArgs,
}

/// Lists, compares or saves parameters.
pub(crate) fn params(args: &ParamsArgs) -> Outcome {
    let (project, verified) = match project::load_checked(&args.path, &args.common) {
        Ok(loaded) => loaded,
        Err(outcome) => return outcome,
    };
    match &args.from {
        None => console::answer(&table::list(verified.program(), args.format)),
        Some(file) => compare(args, file, &project, &verified),
    }
}

fn compare(args: &ParamsArgs, file: &std::path::Path, project: &Project, verified: &Verified) -> Outcome {
    let names = Names::new(verified.program());
    let changes = match given::read(file, &names) {
        Ok(changes) => changes,
        Err(complaints) => {
            complaints.iter().for_each(|complaint| console::error(complaint));
            return Outcome::Errors;
        }
    };
    let told = console::answer(&table::differences(&names, &changes, args.format));
    if !args.save || told != Outcome::Done {
        return told;
    }
    match save::save(args, project, &names, &changes) {
        Ok(outcome) => outcome,
        Err(message) => {
            console::error(&message);
            Outcome::Failed
        }
    }
}
