//! `pcl2 run`: prepares what goes in, runs one of the engines, hands out what comes back.

mod compiled;
mod embedded;
pub(crate) mod files;
mod job;
mod pace;
mod progress;
mod recorder;
mod summary;

use crate::args::CommonArgs;
use crate::console;
use crate::outcome::Outcome;
use crate::project;
use crate::toolchain::Toolchain;
use clap::{Args, ValueEnum};
use files::Output;
use job::Job;
use pcl2_sim::engine::{Machine, Unsupported};
use pcl2_sim::health::Health;
use pcl2_sim::names::Names;
use pcl2_sim::number::Number;
use recorder::{Recorded, Recorder};
use std::path::{Path, PathBuf};

/// `pcl2 run`
#[derive(Args, Debug)]
pub(crate) struct RunArgs {
    /// A .cfg or .net file, or a folder with pcl2.toml
    pub(crate) path: PathBuf,
    /// How many scans
    #[arg(long, value_name = "N", conflicts_with = "until")]
    pub(crate) steps: Option<u64>,
    /// How long, in seconds
    #[arg(long, value_name = "S")]
    pub(crate) until: Option<String>,
    /// What comes from outside: a clock column `k` or `t`, then inputs, parameters and operator cells
    #[arg(long, value_name = "CSV")]
    pub(crate) stimulus: Option<PathBuf>,
    /// Set an input, a parameter or an operator cell, at a time if one is given
    #[arg(long = "set", value_name = "NAME=VALUE[@S]")]
    pub(crate) sets: Vec<String>,
    /// Write the signals after every scan (`-`: to standard output)
    #[arg(long, value_name = "CSV")]
    pub(crate) trace: Option<PathBuf>,
    /// Draw the signals over time (`-`: to standard output)
    #[arg(long, value_name = "SVG")]
    pub(crate) plot: Option<PathBuf>,
    /// Which signals to record, separated by commas; all of them if not given
    #[arg(long, value_name = "NAMES")]
    pub(crate) record: Vec<String>,
    /// What runs the program
    #[arg(long, value_enum)]
    pub(crate) engine: Option<Engine>,
    /// Compile for this target and run on QEMU's board for it: cortex-m3, cortex-m4, cortex-m7
    #[arg(long, value_name = "NAME", conflicts_with = "engine")]
    pub(crate) target: Option<String>,
    /// Run each scan when it is due by the clock on the wall
    #[arg(long, conflicts_with_all = ["engine", "target"])]
    pub(crate) realtime: bool,
    /// Write the parameters as they are at the end
    #[arg(long, value_name = "FILE")]
    pub(crate) params: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) common: CommonArgs,
}

/// What runs a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Engine {
    /// The kernels inside this command
    Embedded,
    /// The emitted C, compiled with $CC or cc
    Cc,
}

/// How a run ended early.
#[derive(Debug)]
pub(crate) struct Failure {
    outcome: Outcome,
    message: String,
}

impl Failure {
    fn usage(message: impl Into<String>) -> Failure {
        Failure { outcome: Outcome::Usage, message: message.into() }
    }

    fn failed(message: impl Into<String>) -> Failure {
        Failure { outcome: Outcome::Failed, message: message.into() }
    }

    /// Says what failed.
    pub(crate) fn report(self) -> Outcome {
        console::error(&self.message);
        self.outcome
    }
}

/// What an engine leaves.
#[derive(Debug, Default)]
pub(crate) struct Finished {
    health: Health,
    /// The values of [`Job::params`].
    params: Vec<Number>,
}

/// Runs a program.
pub(crate) fn run(args: &RunArgs) -> Outcome {
    let (project, verified) = match project::load_verified(&args.path, &args.common) {
        Ok(loaded) => loaded,
        Err(outcome) => return outcome,
    };
    let names = Names::new(verified.program());
    let ended = spare(args).and_then(|()| Job::new(args, &names)).and_then(|job| {
        let toolchain = toolchain(args)?;
        let wish = match (&args.target, args.realtime) {
            (Some(_), _) => Some(Engine::Cc),
            (None, true) => Some(Engine::Embedded),
            (None, false) => args.engine,
        };
        let engine = choose(wish, &verified)?;
        let recorder = Recorder::new(&job, args.trace.as_deref(), args.plot.is_some())?;
        execute(args, &job, recorder, |recorder| match engine {
            Some(machine) => embedded::run(&job, machine, recorder),
            None => compiled::run(&job, &verified, &project, &toolchain, recorder),
        })
    });
    match ended {
        Ok(outcome) => outcome,
        Err(failure) => failure.report(),
    }
}

/// Refuses to write over what the run is made from.
fn spare(args: &RunArgs) -> Result<(), Failure> {
    let read: Vec<PathBuf> =
        [Some(&args.path), args.stimulus.as_ref()].into_iter().flatten().flat_map(|path| path.canonicalize()).collect();
    let written = [&args.trace, &args.plot, &args.params].into_iter().flatten();
    for path in written.filter(|path| !files::is_stdout(path)) {
        if path.canonicalize().is_ok_and(|path| read.contains(&path)) {
            let path = path.display();
            return Err(Failure::usage(format!("`{path}`: expected another file than those that are read, found one")));
        }
    }
    Ok(())
}

/// The C compiler, and the board that an emulator has for the target.
fn toolchain(args: &RunArgs) -> Result<Toolchain, Failure> {
    let toolchain = Toolchain::of(args.target.as_deref()).map_err(Failure::usage)?;
    match &args.target {
        Some(target) if target != "host" && toolchain.board.is_none() => {
            Err(Failure::usage(format!("there is no emulator for the target `{target}`")))
        }
        _ => Ok(toolchain),
    }
}

/// The engine that takes the program. C of the user's own needs the C compiler.
fn choose<'a>(wish: Option<Engine>, verified: &'a pcl2_lang::verify::Verified) -> Result<Option<Machine<'a>>, Failure> {
    if wish == Some(Engine::Cc) {
        return Ok(None);
    }
    match Machine::new(verified) {
        Ok(machine) => Ok(Some(machine)),
        Err(reason @ Unsupported::OwnC(_)) if wish.is_none() => {
            console::err(&format!("note: {reason}"));
            Ok(None)
        }
        Err(reason) => Err(Failure::usage(reason.to_string())),
    }
}

fn execute(
    args: &RunArgs,
    job: &Job<'_>,
    mut recorder: Recorder,
    engine: impl FnOnce(&mut Recorder) -> Result<Finished, Failure>,
) -> Result<Outcome, Failure> {
    let is_stdout = |path: &Option<PathBuf>| path.as_deref().is_some_and(files::is_stdout);
    if is_stdout(&args.trace) && is_stdout(&args.plot) {
        return Err(Failure::usage("only one of --trace and --plot can go to standard output"));
    }
    let to_stdout = is_stdout(&args.trace) || is_stdout(&args.plot);
    let mut params = open(args.params.as_deref())?;
    let mut plot = open(args.plot.as_deref())?;
    let finished = engine(&mut recorder)?;
    let Recorded { history, trends, trace } = recorder.finish()?;
    if let Some((path, output)) = &mut params {
        files::write(path, output, job.params_text(&finished.params).as_bytes())?;
    }
    if let (Some((path, output)), Some(trends)) = (&mut plot, trends) {
        files::write(path, output, trends.svg().as_bytes())?;
    }
    for output in trace.into_iter().chain([params, plot].into_iter().flatten().map(|(_, output)| output)) {
        output.keep()?;
    }
    let told = if to_stdout { Outcome::Done } else { console::answer(&summary::text(job, &history)) };
    for line in finished.health.lines(job.names.program) {
        console::err(&line);
    }
    Ok(told)
}

/// Opens an output that is wanted.
fn open(path: Option<&Path>) -> Result<Option<(&Path, Output)>, Failure> {
    path.map(|path| Ok((path, Output::open(path)?))).transpose()
}
