//! Speed of `run`: plant and controller, nothing recorded.

use super::child::{median, usage};
use super::table::{Bar, Row, Table};
use super::tools::{Tools, bench_folder};
use std::process::Command;

pub(crate) fn measure(tools: &Tools, table: &mut Table) -> Result<(), String> {
    engine(tools, table, "embedded", 10_000_000, 10e6)?;
    engine(tools, table, "cc", 100_000_000, 100e6)
}

/// The time of many scans less that of few: what an engine needs to begin does not count.
fn engine(tools: &Tools, table: &mut Table, name: &str, steps: u64, bar: f64) -> Result<(), String> {
    let few = steps / 10;
    let mut seconds = Vec::new();
    for _ in 0..tools.rounds(9) {
        let begin = usage(&mut call(tools, name, few))?.seconds;
        seconds.push(usage(&mut call(tools, name, steps))?.seconds - begin);
    }
    let speed = (steps - few) as f64 / median(seconds);
    table.add(Row::value(format!("{name} engine: plant and controller, steps/s"), speed, "").bar(Bar::AtLeast(bar)));
    Ok(())
}

fn call(tools: &Tools, engine: &str, steps: u64) -> Command {
    let mut command = tools.command("run");
    command.arg(bench_folder().join("kernels/closed_loop.cfg"));
    command.args(["--period", "0.1", "--engine", engine, "--steps", &steps.to_string()]);
    command
}
