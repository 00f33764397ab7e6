//! Nets: reachable markings and deadlocks.

use super::child::{Usage, usage};
use super::literature::{self, Net};
use super::table::{Bar, Row, Table};
use super::tools::{Tools, text, write};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Name, net, and its published number of reachable markings.
type Whole = (&'static str, Net, u64);

pub(crate) fn measure(tools: &Tools, table: &mut Table) -> Result<(), String> {
    let whole: [Whole; 4] = [
        ("Kanban-5", literature::kanban(5), 2_546_432),
        ("FMS-5", literature::fms(5), 2_895_018),
        ("HouseConstruction-5", literature::house_construction(5), 1_187_984),
        ("SwimmingPool-2", literature::swimming_pool(2), 3_408_031),
    ];
    for (name, net, markings) in &whole {
        let file = written(tools, name, net)?;
        explore(tools, table, name, &file, *markings)?;
        deadlock(tools, table, name, &file)?;
    }
    for n in [10, 100, 1000] {
        let name = format!("Referendum-{n}");
        deadlock(tools, table, &name, &written(tools, &name, &literature::referendum(n))?)?;
    }
    for n in [1, 6, 12, 24, 48, 96] {
        let name = format!("AutoFlight-{n}a");
        deadlock(tools, table, &name, &written(tools, &name, &literature::auto_flight(n))?)?;
    }
    Ok(())
}

fn written(tools: &Tools, name: &str, net: &Net) -> Result<PathBuf, String> {
    let file = tools.folder("space")?.join(format!("{name}.pnml"));
    write(&file, &net.pnml())?;
    Ok(file)
}

fn command(tools: &Tools, file: &Path, args: &[&str]) -> Command {
    let mut command = tools.command("net");
    command.arg("analyze").arg(file).arg("--json").args(args);
    command
}

/// All that is found out of all markings: liveness and reversibility too.
fn explore(tools: &Tools, table: &mut Table, name: &str, file: &Path, markings: u64) -> Result<(), String> {
    let found = text(&mut command(tools, file, &[]))?;
    if !found.contains(&format!("\"markings\":{markings},")) {
        return Err(format!("{name}: expected {markings} markings, found others"));
    }
    let used = best(tools, || command(tools, file, &[]))?;
    let count = markings as f64;
    table.add(Row::value(format!("{name}: markings/s"), count / used.seconds, "").bar(Bar::AtLeast(2e6)));
    table.add(Row::value(format!("{name}: bytes a marking"), used.bytes / count, "B").bar(Bar::AtMost(32.0)));
    Ok(())
}

/// The answer alone: no more than one marking is explored.
fn deadlock(tools: &Tools, table: &mut Table, name: &str, file: &Path) -> Result<(), String> {
    let found = text(&mut command(tools, file, &["--limit", "1"]))?;
    if found.contains("\"deadlock\":null") {
        return Err(format!("{name}: expected an answer about deadlocks, found none"));
    }
    let used = best(tools, || command(tools, file, &["--limit", "1"]))?;
    table.add(Row::value(format!("{name}: deadlock"), used.seconds, "s").bar(Bar::AtMost(0.05)));
    Ok(())
}

/// The least of several runs: others on the machine only add.
fn best(tools: &Tools, command: impl Fn() -> Command) -> Result<Usage, String> {
    let mut best = usage(&mut command())?;
    for _ in 1..tools.rounds(7) {
        let used = usage(&mut command())?;
        best = Usage { seconds: best.seconds.min(used.seconds), bytes: best.bytes.min(used.bytes) };
    }
    Ok(best)
}
