//! `pcl2 run`

use crate::args::CommonArgs;
use crate::outcome::Outcome;
use crate::project;
use clap::Args;
use std::path::PathBuf;

/// `pcl2 run`
#[derive(Args, Debug)]
pub(crate) struct RunArgs {
    /// A .cfg file, or a folder with pcl2.toml
    pub(crate) path: PathBuf,
    #[command(flatten)]
    pub(crate) common: CommonArgs,
}

/// Runs a program.
pub(crate) fn run(args: &RunArgs) -> Outcome {
    match project::load_verified(&args.path, &args.common) {
        Ok(_) => Outcome::Done,
        Err(outcome) => outcome,
    }
}
