//! `pcl2 net`: what is asked of a net before it runs.

mod analyze;
mod answers;
mod compose;
mod divide;
mod export;
mod fire;
mod flatten;
mod matrix;
mod report;

pub(crate) use export::write;

use crate::args::CommonArgs;
use crate::console;
use crate::nets::is_net;
use crate::outcome::Outcome;
use crate::project::{self, Project, read_regular};
use clap::{Args, Subcommand};
use pcl2_net::flat::{self, Flat};
use pcl2_net::pnml;
use pcl2_net::pt::PtNet;
use std::path::{Path, PathBuf};

/// What is asked of a net.
#[derive(Subcommand, Debug)]
pub(crate) enum NetCommand {
    /// Report invariants, bounds, siphons, deadlocks, liveness and reversibility of a net
    Analyze(AnalyzeArgs),
    /// Print the matrices of a net, of the nets inside it and of its modules
    Matrix(matrix::MatrixArgs),
    /// Compose the matrix of a net from those of its modules
    Compose(compose::ComposeArgs),
    /// Fire transitions after the state equation, and check that they are enabled
    Fire(fire::FireArgs),
    /// Write a net with the nets inside it as one flat net
    Flatten(flatten::FlattenArgs),
    /// Divide a flat net by its steps into a main loop and sub-nets
    Divide(divide::DivideArgs),
    /// Write a net for another tool
    Export(export::ExportArgs),
    /// Write the documentation of a net: picture, tables, analysis, cross-reference
    Report(report::ReportArgs),
}

/// A net, and where those inside it are looked for.
#[derive(Args, Debug)]
pub(crate) struct NetPath {
    /// A .net or .pnml file
    pub(crate) path: PathBuf,
    /// A folder with nets
    #[arg(long, value_name = "DIR")]
    pub(crate) blocks: Vec<PathBuf>,
}

/// `pcl2 net analyze`
#[derive(Args, Debug)]
pub(crate) struct AnalyzeArgs {
    #[command(flatten)]
    pub(crate) net: NetPath,
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
        NetCommand::Analyze(args) => match load(&args.net.path, &args.net.blocks) {
            Ok(net) => analyze::analyze(&net, args),
            Err(outcome) => outcome,
        },
        NetCommand::Matrix(args) => matrix::matrix(args),
        NetCommand::Compose(args) => compose::compose(args),
        NetCommand::Fire(args) => fire::fire(args),
        NetCommand::Flatten(args) => flatten::flatten(args),
        NetCommand::Divide(args) => divide::divide(args),
        NetCommand::Export(args) => export::export(args),
        NetCommand::Report(args) => report::report(args),
    }
}

/// The largest PNML file in bytes.
const MAX_PNML: u64 = 64 << 20;

/// Reads the net at a path: of a .net file with all nets inside it. `blocks`: where those are looked for, too.
pub(crate) fn load(path: &Path, blocks: &[PathBuf]) -> Result<PtNet, Outcome> {
    if is_net(path) { load_flat(path, blocks).map(|flat| flat.net) } else { load_pnml(path) }
}

/// Reads a .net file with all nets inside it.
pub(crate) fn load_flat(path: &Path, blocks: &[PathBuf]) -> Result<Flat, Outcome> {
    let project = load_project(path, blocks)?;
    let decl = project.catalogue.find(&project.stem).ok_or(Outcome::Errors)?;
    flat::flat(decl, &project.catalogue, &project.symbols).map_err(|why| refuse(path, &why))
}

/// Reads and checks a .net file with all nets inside it.
fn load_project(path: &Path, blocks: &[PathBuf]) -> Result<Project, Outcome> {
    let common = CommonArgs { blocks: blocks.to_vec(), ..CommonArgs::default() };
    project::load_checked(path, &common).map(|(project, _)| project)
}

/// Reads a place/transition net.
pub(crate) fn load_pnml(path: &Path) -> Result<PtNet, Outcome> {
    let shown = path.display();
    let bytes = read_regular(path, MAX_PNML).map_err(|why| {
        console::error(&format!("expected a readable file, found `{shown}`: {why}"));
        Outcome::Errors
    })?;
    let text = String::from_utf8(bytes).map_err(|_| refuse(path, "expected UTF-8 text, found other bytes"))?;
    pnml::read(&text).map_err(|error| {
        console::error(&format!("{shown}:{error}"));
        Outcome::Errors
    })
}

/// Says why nothing is done with a file.
pub(crate) fn refuse(path: &Path, why: &str) -> Outcome {
    console::error(&format!("{}: {why}", path.display()));
    Outcome::Errors
}
