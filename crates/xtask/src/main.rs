//! `cargo xtask`: the project's chores.

mod bench;
mod manual;
mod packages;
mod scaffold;
mod shell;
mod suite;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// The project's chores.
#[derive(Parser)]
#[command(name = "cargo xtask")]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Run the whole test suite; installs the C compilers and emulators it needs where it may
    Test,
    /// Measure, and hold the numbers against the bars
    Bench(bench::BenchArgs),
    /// Compare the engines and the forms of the C over many random nets
    Nets {
        /// How many
        #[arg(default_value_t = 100_000)]
        count: u32,
    },
    /// Write docs/blocks.md from the declarations
    Docs,
    /// Begin a function code: blocks/GROUP/CODE.fc and its kernel
    NewBlock {
        /// The group, a folder below blocks/
        group: String,
        /// The function code
        code: String,
    },
    /// Begin a golden case: tests/cases/NAME
    NewCase {
        /// The case's folder
        name: String,
    },
}

fn main() -> ExitCode {
    let done = match Cli::parse().command {
        Command::Test => suite::test(),
        Command::Bench(args) => bench::bench(&args),
        Command::Nets { count } => suite::nets(count),
        Command::Docs => manual::docs(),
        Command::NewBlock { group, code } => scaffold::new_block(&group, &code),
        Command::NewCase { name } => scaffold::new_case(&name),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            shell::say(&format!("xtask: {message}"));
            ExitCode::FAILURE
        }
    }
}
