//! `cargo xtask bench`: programs that measure. Never tests: a missed bar is a line in a table.

mod cc;
mod child;
mod compare;
mod front;
mod kernels;
mod literature;
mod m4;
mod nets;
mod run;
mod scan;
mod sources;
mod space;
mod table;
mod tools;

use crate::shell::say;
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use table::Table;
use tools::Tools;

/// `cargo xtask bench`
#[derive(Args)]
pub(crate) struct BenchArgs {
    /// What to measure; everything if not given
    #[arg(value_enum)]
    areas: Vec<Area>,
    /// Smaller programs, fewer repetitions
    #[arg(long)]
    quick: bool,
    /// Also write the table to a file
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Measure this command instead of building one
    #[arg(long, value_name = "FILE")]
    pcl2: Option<PathBuf>,
}

/// What can be measured.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Area {
    /// Speed and memory of `check` and `build`
    Front,
    /// Time and memory of the C compiler on our C
    Cc,
    /// Scan time against the same C by hand
    Scan,
    /// Single function codes against hand-written C and Eigen
    Kernels,
    /// Size and instruction counts on a Cortex-M4
    M4,
    /// Scans, code and compile time of nets
    Nets,
    /// Speed of `run`
    Run,
    /// Speed and memory of `net analyze`
    Space,
}

/// Measures, and prints the table to standard output.
pub(crate) fn bench(args: &BenchArgs) -> Result<(), String> {
    let tools = Tools::new(args.pcl2.as_deref(), args.quick)?;
    let mut table = Table::default();
    for area in Area::value_variants().iter().filter(|area| args.areas.is_empty() || args.areas.contains(area)) {
        say(&format!("measuring {}", name(*area)));
        tools.clear(name(*area));
        table.area(name(*area));
        if let Err(message) = measure(*area, &tools, &mut table) {
            say(&format!("{}: {message}", name(*area)));
        }
    }
    table.print()?;
    match &args.csv {
        Some(file) => table.save(file),
        None => Ok(()),
    }
}

fn measure(area: Area, tools: &Tools, table: &mut Table) -> Result<(), String> {
    match area {
        Area::Front => front::measure(tools, table),
        Area::Cc => cc::measure(tools, table),
        Area::Scan => scan::measure(tools, table),
        Area::Kernels => kernels::measure(tools, table),
        Area::M4 => m4::measure(tools, table),
        Area::Nets => nets::measure(tools, table),
        Area::Run => run::measure(tools, table),
        Area::Space => space::measure(tools, table),
    }
}

fn name(area: Area) -> &'static str {
    match area {
        Area::Front => "front",
        Area::Cc => "cc",
        Area::Scan => "scan",
        Area::Kernels => "kernels",
        Area::M4 => "m4",
        Area::Nets => "nets",
        Area::Run => "run",
        Area::Space => "space",
    }
}
