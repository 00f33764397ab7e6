//! `pcl2 net`: what is asked of a net before it runs.

mod analyze;
mod report;

use crate::console;
use crate::outcome::Outcome;
use crate::project::read_regular;
use clap::{Args, Subcommand};
use pcl2_net::pnml;
use pcl2_net::pt::PtNet;
use std::path::{Path, PathBuf};

/// What is asked of a net.
#[derive(Subcommand, Debug)]
pub(crate) enum NetCommand {
    /// Report invariants, bounds, siphons, deadlocks, liveness and reversibility of a net
    Analyze(AnalyzeArgs),
}

/// `pcl2 net analyze`
#[derive(Args, Debug)]
pub(crate) struct AnalyzeArgs {
    /// A .pnml file
    pub(crate) path: PathBuf,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
    /// What may happen at once; by default step for a .net file, interleaving for others
    #[arg(long, value_name = "step|interleaving")]
    pub(crate) semantics: Option<analyze::Choice>,
    /// The most markings that are looked at; by default what fits into half the free memory
    #[arg(long, value_name = "N")]
    pub(crate) limit: Option<usize>,
}

/// Runs a command.
pub(crate) fn net(command: &NetCommand) -> Outcome {
    match command {
        NetCommand::Analyze(args) => match load(&args.path) {
            Ok(net) => analyze::analyze(&net, args),
            Err(outcome) => outcome,
        },
    }
}

/// The largest PNML file in bytes.
const MAX_PNML: u64 = 64 << 20;

/// Reads the net at a path.
fn load(path: &Path) -> Result<PtNet, Outcome> {
    let shown = path.display();
    let refuse = |why: String| {
        console::error(&why);
        Outcome::Errors
    };
    let bytes = read_regular(path, MAX_PNML)
        .map_err(|why| refuse(format!("expected a readable file, found `{shown}`: {why}")))?;
    let text =
        String::from_utf8(bytes).map_err(|_| refuse(format!("{shown}: expected UTF-8 text, found other bytes")))?;
    pnml::read(&text).map_err(|error| refuse(format!("{shown}:{error}")))
}
