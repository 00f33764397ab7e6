//! Time and memory of the C compiler on our C.

use super::child::{Usage, in_turn};
use super::sources::{Style, write_loops};
use super::table::{Bar, Row, Table};
use super::tools::{Tools, compiler, output};
use std::path::{Path, PathBuf};
use std::process::Command;

pub(crate) fn measure(tools: &Tools, table: &mut Table) -> Result<(), String> {
    let straight = built(tools, "straight", 1000, Style::Straight)?;
    let larger = built(tools, "larger", 2000, Style::Straight)?;
    let composite = built(tools, "composite", 1000, Style::Composite)?;
    let folders = [&straight, &larger, &composite];
    let mut calls = Vec::new();
    for folder in folders {
        calls.push(call(folder, "loops")?);
        calls.push(call(folder, "loops_map")?);
    }
    let used = in_turn(tools.rounds(9), &mut calls)?;
    report(table, "1000 loops", &used[..2], 0.6);
    report(table, "1000 composites", &used[4..], 0.2);
    let growth = used[2].seconds / used[0].seconds / 2.0;
    let row = Row::value("gcc -O2, NAME.c: ms a loop at 2000 loops, peer: at 1000", used[2].seconds / 2.0, "ms");
    table.add(row.peer(used[0].seconds, growth).bar(Bar::Ratio(1.1)));
    Ok(())
}

fn built(tools: &Tools, name: &str, count: usize, style: Style) -> Result<PathBuf, String> {
    let folder = tools.folder(&format!("cc/{name}"))?;
    let source = write_loops(&folder, count, style)?;
    output(tools.build(&source, &folder.join("out"), &[]).arg("--blocks").arg(&folder))?;
    Ok(folder.join("out"))
}

fn call(built: &Path, file: &str) -> Result<Command, String> {
    let mut command = compiler("gcc", &["-O2", "-c"], built)?;
    command.arg("-o").arg(built.join(format!("{file}.o"))).arg(built.join(format!("{file}.c")));
    Ok(command)
}

fn report(table: &mut Table, what: &str, used: &[Usage], bar: f64) {
    let bytes = used.iter().map(|one| one.bytes).fold(0.0, f64::max);
    table.add(Row::value(format!("gcc -O2, {what}: NAME.c"), used[0].seconds, "s").bar(Bar::AtMost(bar)));
    table.add(Row::value(format!("gcc -O2, {what}: NAME_map.c"), used[1].seconds, "s"));
    table.add(Row::value(format!("gcc -O2, {what}: peak memory"), bytes / 1e6, "MB").bar(Bar::AtMost(80.0)));
}
