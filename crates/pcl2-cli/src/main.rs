//! The `pcl2` command: the only part that touches files, clocks and the terminal.

mod args;
mod blocks;
mod build;
mod check;
mod config;
mod console;
mod explain;
mod fmt;
mod graph;
mod io;
mod net;
mod nets;
mod new;
mod outcome;
mod output;
mod params;
mod project;
mod run;
mod toolchain;

use args::{Cli, Command};
use clap::Parser;
use outcome::Outcome;
use std::process::ExitCode;

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => {
            let printed = error.print();
            let outcome = if error.use_stderr() { Outcome::Usage } else { console::arrived(printed) };
            return ExitCode::from(outcome.code());
        }
    };
    let outcome = match cli.command {
        Command::New(args) => new::new(&args),
        Command::Check(args) => check::check(&args),
        Command::Build(args) => build::build(&args),
        Command::Run(args) => run::run(&args),
        Command::Fmt(args) => fmt::fmt(&args),
        Command::Params(args) => params::params(&args),
        Command::Graph(args) => graph::graph(&args),
        Command::Net(command) => net::net(&command),
        Command::Blocks(args) => blocks::blocks(&args),
        Command::Explain(args) => explain::explain(&args),
    };
    ExitCode::from(outcome.code())
}
