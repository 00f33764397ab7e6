//! Time of a scan against the same C written by hand.

use super::compare::Times;
use super::sources::{Style, write_loops};
use super::table::{Bar, Table};
use super::tools::{Tools, bench_folder, compiler, output, runtime_sources};
use std::path::{Path, PathBuf};
use std::process::Command;

pub(crate) fn measure(tools: &Tools, table: &mut Table) -> Result<(), String> {
    let cases = [
        ("1 loop", 1, Style::Straight, 1.05),
        ("8 loops", 8, Style::Straight, 1.05),
        ("1000 loops, straight list", 1000, Style::Straight, 2.5),
        ("1000 loops, composites", 1000, Style::Composite, 1.12),
    ];
    for (what, count, style, bar) in cases {
        let program = built(tools, count, style)?;
        let times = Times::of(Command::new(program).arg(tools.rounds(2001).to_string()))?;
        table.add(times.row(format!("{what}, peer: by hand"), "ours", "hand").bar(Bar::Ratio(bar)));
    }
    Ok(())
}

fn built(tools: &Tools, count: usize, style: Style) -> Result<PathBuf, String> {
    let composite = style == Style::Composite;
    let folder = tools.folder(&format!("scan/{count}{}", if composite { "c" } else { "" }))?;
    let source = write_loops(&folder, count, style)?;
    let out = folder.join("out");
    output(tools.build(&source, &out, &[]).arg("--blocks").arg(&folder))?;
    compile(&folder, &out, count, composite)
}

fn compile(folder: &Path, out: &Path, count: usize, composite: bool) -> Result<PathBuf, String> {
    let bench = bench_folder();
    let program = folder.join("scan");
    let mut command = compiler("gcc", &["-O2"], out)?;
    command.arg("-I").arg(&bench).arg(format!("-DHAND_LOOPS={count}"));
    if composite {
        command.arg("-DHAND_COMPOSITE");
    }
    command.arg("-o").arg(&program);
    command.args(["c/scan.c", "c/compare.c", "hand/loops.c"].map(|file| bench.join(file)));
    command.args(["loops.c", "loops_map.c"].map(|file| out.join(file))).args(runtime_sources(out)?).arg("-lm");
    output(&mut command)?;
    Ok(program)
}
