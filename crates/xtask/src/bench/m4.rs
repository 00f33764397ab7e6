//! Size and instruction counts on a Cortex-M4, reals in float.

use super::sources::{Style, write_loops};
use super::table::{Bar, Row, Table};
use super::tools::{Tools, bench_folder, compiler, output, runtime_sources, text, write};
use crate::shell::root;
use std::path::{Path, PathBuf};
use std::process::Command;

const FLAGS: [&str; 7] = [
    "-mcpu=cortex-m4",
    "-mthumb",
    "-mfloat-abi=hard",
    "-mfpu=fpv4-sp-d16",
    "-Os",
    "-ffunction-sections",
    "-fdata-sections",
];

/// Loops of the two programs whose difference is taken: one function of a cut section, so all overheads are in it.
const LOOPS: (usize, usize) = (200, 216);

pub(crate) fn measure(tools: &Tools, table: &mut Table) -> Result<(), String> {
    sizes(tools, table, "straight", Style::Straight, 80.0)?;
    sizes(tools, table, "composite", Style::Composite, 16.0)?;
    counts(tools, table)
}

fn sizes(tools: &Tools, table: &mut Table, name: &str, style: Style, bar: f64) -> Result<(), String> {
    let few = Sizes::of(tools, &format!("m4/{name}-few"), LOOPS.0, style)?;
    let many = Sizes::of(tools, &format!("m4/{name}-many"), LOOPS.1, style)?;
    let each = |part: fn(&Sizes) -> u64| (part(&many) as f64 - part(&few) as f64) / (LOOPS.1 - LOOPS.0) as f64;
    let value = |what: &str, part| Row::value(format!("one loop, {name}: {what}"), each(part), "B");
    table.add(value("code and tune row", |sizes| sizes.code + sizes.rows).bar(Bar::AtMost(bar)));
    table.add(value("of that the tune row", |sizes| sizes.rows));
    table.add(value("initial image", |sizes| sizes.image));
    table.add(value("RAM read or written per scan", |sizes| sizes.hot).bar(Bar::AtMost(60.0)));
    table.add(value("RAM in all", |sizes| sizes.all).bar(Bar::AtMost(110.0)));
    table.add(Row::value(format!("{name}: calls of __aeabi_d*"), many.doubles as f64, "").bar(Bar::AtMost(0.0)));
    Ok(())
}

/// Bytes of a program.
struct Sizes {
    code: u64,
    rows: u64,
    image: u64,
    hot: u64,
    all: u64,
    doubles: usize,
}

impl Sizes {
    fn of(tools: &Tools, name: &str, count: usize, style: Style) -> Result<Sizes, String> {
        let folder = tools.folder(name)?;
        let source = write_loops(&folder, count, style)?;
        let out = folder.join("out");
        output(tools.build(&source, &out, &["--real", "f32"]).arg("--blocks").arg(&folder))?;
        let sections = sections(&object(&out, &out.join("loops.c"))?)?;
        let sum = |wanted: &dyn Fn(&str) -> bool| {
            sections.iter().filter(|(name, _)| wanted(name)).map(|(_, size)| size).sum()
        };
        let (hot, all) = instance(&out)?;
        Ok(Sizes {
            code: sum(&|name| name.starts_with(".text")),
            rows: sum(&|name| name.starts_with(".rodata") && name.ends_with("_rows")),
            image: sum(&|name| name.starts_with(".rodata") && name.ends_with("_initial")),
            hot,
            all,
            doubles: doubles(&out)?,
        })
    }
}

fn arm(out: &Path) -> Result<Command, String> {
    compiler("arm-none-eabi-gcc", &FLAGS, out)
}

/// Compiles a file of a built program for the Cortex-M4.
pub(crate) fn object(out: &Path, source: &Path) -> Result<PathBuf, String> {
    let object = source.with_extension("o");
    output(arm(out)?.arg("-c").arg("-o").arg(&object).arg(source))?;
    Ok(object)
}

/// Names and sizes of an object's sections.
fn sections(object: &Path) -> Result<Vec<(String, u64)>, String> {
    let listing = text(Command::new("arm-none-eabi-size").arg("-A").arg(object))?;
    Ok(listing.lines().filter_map(section).collect())
}

/// Bytes of code and constants that `size -A` tells of.
pub(crate) fn code(size: &mut Command) -> Result<f64, String> {
    let listing = text(size)?;
    let counted = |name: &str| name.starts_with(".text") || name.starts_with(".rodata");
    Ok(listing.lines().filter_map(section).filter(|(name, _)| counted(name)).map(|(_, size)| size).sum::<u64>() as f64)
}

fn section(line: &str) -> Option<(String, u64)> {
    let mut words = line.split_whitespace();
    Some((words.next()?.to_owned(), words.next()?.parse().ok()?))
}

/// Bytes of an instance that a scan touches, and all of them, as the C compiler lays them out.
fn instance(out: &Path) -> Result<(u64, u64), String> {
    let source = out.join("instance.c");
    write(
        &source,
        "#include <stddef.h>\n#include \"loops.h\"\n\
         const char hot[offsetof(loops, cold)] = {1};\nconst char all[sizeof(loops)] = {1};\n",
    )?;
    let sections = sections(&object(out, &source)?)?;
    let size = |name: &str| sections.iter().find(|(known, _)| known == name).map_or(0, |(_, size)| *size);
    Ok((size(".rodata.hot"), size(".rodata.all")))
}

/// How often our objects ask for arithmetic in double.
fn doubles(out: &Path) -> Result<usize, String> {
    let mut sources = runtime_sources(out)?;
    sources.extend(["loops.c", "loops_map.c"].map(|file| out.join(file)));
    let mut count = 0;
    for source in sources {
        let symbols = text(Command::new("arm-none-eabi-nm").arg("-u").arg(object(out, &source)?))?;
        count += symbols.lines().filter(|line| line.contains("__aeabi_d")).count();
    }
    Ok(count)
}

/// Instructions of a step, counted by the emulator.
fn counts(tools: &Tools, table: &mut Table) -> Result<(), String> {
    let out = tools.folder("m4/count")?;
    let mut command = tools.command("build");
    command.args(["kept_model", "product4"].map(|name| bench_folder().join(format!("kernels/{name}.cfg"))));
    output(command.arg("-o").arg(&out).args(["--period", "0.1", "--real", "f32"]))?;
    let program = link(&out)?;
    let mut emulator = Command::new("qemu-system-arm");
    emulator.args(["-M", "mps2-an386", "-display", "none", "-monitor", "none", "-serial", "none"]);
    emulator.args(["-semihosting-config", "enable=on,target=native", "-icount", "shift=0", "-kernel"]).arg(program);
    let printed = text(&mut emulator)?;
    for (name, what, bar) in [
        ("gpc", "gpc, model unchanged: instructions a step", 90.0),
        ("product", "product 4x4: instructions a step", 150.0),
    ] {
        let count = printed.lines().find_map(|line| line.strip_prefix(name)?.trim().parse().ok());
        let count = count.ok_or_else(|| format!("the emulated program printed `{printed}`"))?;
        table.add(Row::value(what, count, "").bar(Bar::AtMost(bar)));
    }
    Ok(())
}

fn link(out: &Path) -> Result<PathBuf, String> {
    let port = root().join("runtime-c/ports/mps2");
    let program = out.join("count.elf");
    let mut command = arm(out)?;
    command.args(["--specs=rdimon.specs", "-T"]).arg(port.join("link.ld"));
    command.arg("-Wl,--gc-sections").arg("-o").arg(&program);
    command.arg(port.join("start.c")).arg(bench_folder().join("c/count.c"));
    command.args(["kept_model.c", "product4.c"].map(|file| out.join(file))).args(runtime_sources(out)?);
    output(command.arg("-lm"))?;
    Ok(program)
}
