//! Speed and memory of `check` and `build --emit c`.

use super::child::{Usage, in_turn, median, usage};
use super::sources::{Style, write_loops};
use super::table::{Bar, Row, Table};
use super::tools::Tools;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Lines of a program (beside its frame), which are also its blocks.
const SIZES: [usize; 4] = [1_000, 10_000, 100_000, 1_000_000];

/// A kibibyte a line.
const MEMORY_BAR: f64 = 1024.0;

pub(crate) fn measure(tools: &Tools, table: &mut Table) -> Result<(), String> {
    let sizes = if tools.quick { &SIZES[..3] } else { &SIZES[..] };
    let sources = sizes.iter().map(|size| source(tools, *size)).collect::<Result<Vec<_>, _>>()?;
    let out = tools.folder("front/out")?;
    phase(tools, table, "check", 500e3, sizes, &|size| check(tools, &sources[size]))?;
    phase(tools, table, "build", 250e3, sizes, &|size| build(tools, &sources[size], &out))?;
    let _ = std::fs::remove_dir_all(out);
    Ok(())
}

fn source(tools: &Tools, size: usize) -> Result<PathBuf, String> {
    write_loops(&tools.folder(&format!("front/{size}"))?, size / 4, Style::Straight)
}

fn check(tools: &Tools, source: &Path) -> Command {
    let mut command = tools.command("check");
    command.arg(source);
    command
}

fn build(tools: &Tools, source: &Path, out: &Path) -> Command {
    tools.build(source, out, &["--emit", "c"])
}

fn phase(
    tools: &Tools,
    table: &mut Table,
    name: &str,
    bar: f64,
    sizes: &[usize],
    command: &dyn Fn(usize) -> Command,
) -> Result<(), String> {
    for (i, size) in sizes.iter().enumerate().take(sizes.len() - 2) {
        let used = in_turn(tools.rounds(9), &mut [command(i)])?;
        report(table, name, *size, used[0], None);
    }
    let last = sizes.len() - 1;
    let (smaller, larger, growth) = growth(tools.rounds(3), command(last - 1), command(last))?;
    report(table, name, sizes[last - 1], smaller, Some(bar));
    report(table, name, sizes[last], larger, Some(bar));
    table.add(Row {
        what: format!("{name}: time a line at {}, peer: at {}", sizes[last], sizes[last - 1]),
        unit: "us",
        measured: larger.seconds / sizes[last] as f64 * 1e6,
        peer: Some(smaller.seconds / sizes[last - 1] as f64 * 1e6),
        ratio: Some(growth),
        bar: Some(Bar::Ratio(1.3)),
    });
    Ok(())
}

/// The medians of both, and of the time a line of the larger over that of the smaller before and after it.
fn growth(rounds: usize, mut smaller: Command, mut larger: Command) -> Result<(Usage, Usage, f64), String> {
    let mut seen: (Vec<Usage>, Vec<Usage>) = (Vec::new(), Vec::new());
    for _ in 0..rounds {
        seen.0.push(usage(&mut smaller)?);
        seen.1.push(usage(&mut larger)?);
        seen.0.push(usage(&mut smaller)?);
    }
    let around = |round: usize| (seen.0[2 * round].seconds + seen.0[2 * round + 1].seconds) / 2.0;
    let ratios = (0..rounds).map(|round| seen.1[round].seconds / around(round) / 10.0).collect();
    Ok((middle(&seen.0), middle(&seen.1), median(ratios)))
}

fn middle(seen: &[Usage]) -> Usage {
    let seconds = median(seen.iter().map(|one| one.seconds).collect());
    let bytes = median(seen.iter().map(|one| one.bytes).collect());
    Usage { seconds, bytes }
}

fn report(table: &mut Table, name: &str, size: usize, used: Usage, bar: Option<f64>) {
    let lines = size as f64;
    let speed = Row::value(format!("{name}: lines/s, {size} blocks"), lines / used.seconds, "");
    table.add(Row { bar: bar.map(Bar::AtLeast), ..speed });
    let memory = Row::value(format!("{name}: bytes a line, {size} blocks"), used.bytes / lines, "B");
    table.add(Row { bar: bar.map(|_| Bar::AtMost(MEMORY_BAR)), ..memory });
}
