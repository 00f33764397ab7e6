//! Single function codes, each in a generated program, against hand-written C and Eigen.

use super::compare::Times;
use super::table::{Bar, Row, Table};
use super::tools::{Tools, bench_folder, compiler, entries, output, runtime_sources};
use crate::packages;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Codes compared with hand-written C: contender, what it is, bar.
const CODES: [(&str, &str, f64); 9] = [
    ("gpc_one", "gpc adaptive, Nu = 1", 1.15),
    ("gpc_three", "gpc adaptive, Nu = 3", 1.15),
    ("rls_six", "rls, 6 parameters", 1.15),
    ("sugeno", "fuzzy 7x7, Sugeno", 1.3),
    ("mamdani", "fuzzy 7x7, Mamdani", 1.3),
    ("nn_small", "nn 2-16-1, tanh", 1.1),
    ("nn_small_learns", "nn 2-16-1, learning", 1.1),
    ("nn_large", "nn 8-32-4, tanh", 1.1),
    ("nn_large_learns", "nn 8-32-4, learning", 1.1),
];

pub(crate) fn measure(tools: &Tools, table: &mut Table) -> Result<(), String> {
    let out = built(tools)?;
    products(tools, table, &out)?;
    codes(tools, table, &out)
}

/// All programs of the folder, into one folder with one runtime.
fn built(tools: &Tools) -> Result<PathBuf, String> {
    let out = tools.folder("kernels/out")?;
    let mut command = tools.command("build");
    command.args(programs()?).arg("-o").arg(&out).args(["--period", "0.1"]);
    output(&mut command)?;
    Ok(out)
}

fn programs() -> Result<Vec<PathBuf>, String> {
    let files = entries(&bench_folder().join("kernels"))?.into_iter();
    Ok(files.filter(|file| file.extension().is_some_and(|extension| extension == "cfg")).collect())
}

fn products(tools: &Tools, table: &mut Table, out: &Path) -> Result<(), String> {
    packages::install_peers()?;
    let object = out.join("eigen.o");
    let mut eigen = Command::new("g++");
    eigen
        .args(["-O2", "-fno-exceptions", "-DEIGEN_NO_MALLOC", "-I/usr/include/eigen3", "-c", "-o"])
        .arg(&object)
        .arg(bench_folder().join("c/eigen.cc"));
    output(&mut eigen)?;
    let main = ["c/products.c", "hand/product.c"];
    let program = compile(out, "products", &main, &[object], &["product4.c", "product8.c"])?;
    let times = Times::of(Command::new(program).arg(tools.rounds(2001).to_string()))?;
    for (size, bar) in [("4", 0.55), ("8", 0.6)] {
        let name = |who: &str| format!("{who}{size}");
        let what = |peer: &str| format!("product {size}x{size}, peer: {peer}");
        table.add(times.row(what("Eigen"), &name("ours"), &name("eigen")).bar(Bar::Ratio(bar)));
        table.add(times.row(what("three loops by hand"), &name("ours"), &name("hand")));
    }
    Ok(())
}

fn codes(tools: &Tools, table: &mut Table, out: &Path) -> Result<(), String> {
    let main = ["c/kernels.c", "hand/gpc.c", "hand/rls.c", "hand/flc.c", "hand/nn.c"];
    let names =
        ["kept_model"].into_iter().chain(CODES.iter().map(|code| code.0)).filter(|name| !name.ends_with("learns"));
    let programs: Vec<String> = names.map(|name| format!("{name}.c")).collect();
    let program = compile(out, "kernels", &main, &[], &programs.iter().map(String::as_str).collect::<Vec<_>>())?;
    let times = Times::of(Command::new(program).arg(tools.rounds(1001).to_string()))?;
    let over = times.difference("kept_model", "empty_call");
    table.add(Row::value("gpc, model unchanged, over an empty call", over, "ns").bar(Bar::AtMost(5.0)));
    table.add(times.row("gpc, model unchanged, peer: by hand", "kept_model", "kept_model_hand"));
    for (name, what, bar) in CODES {
        let row = times.row(format!("{what}, peer: by hand"), name, &format!("{name}_hand"));
        table.add(row.bar(Bar::Ratio(bar)));
    }
    Ok(())
}

fn compile(out: &Path, name: &str, main: &[&str], objects: &[PathBuf], programs: &[&str]) -> Result<PathBuf, String> {
    let bench = bench_folder();
    let program = out.join(name);
    let mut command = compiler("gcc", &["-O2"], out)?;
    command.arg("-I").arg(&bench).arg("-o").arg(&program).arg(bench.join("c/compare.c"));
    command.args(main.iter().map(|file| bench.join(file))).args(objects);
    command.args(programs.iter().map(|file| out.join(file))).args(runtime_sources(out)?).arg("-lm");
    output(&mut command)?;
    Ok(program)
}
