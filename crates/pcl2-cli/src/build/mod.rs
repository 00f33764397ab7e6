//! `pcl2 build`: emits C, and with a C compiler makes objects, a library or the example program of it.

mod footprint;

use crate::args::{BuildArgs, Emit, Part};
use crate::console;
use crate::outcome::Outcome;
use crate::output;
use crate::project::{self, Project};
use crate::toolchain::{self, Toolchain};
use footprint::Footprint;
use pcl2_emit::{Emitted, Options, amalgamate};
use pcl2_lang::border::{self, cut, is_whole};
use pcl2_lang::verify::{Verified, verify};
use std::fs;
use std::path::{Path, PathBuf};

/// Builds programs into one folder; they share one runtime folder.
pub(crate) fn build(args: &BuildArgs) -> Outcome {
    match try_build(args) {
        Ok(()) => Outcome::Done,
        Err(outcome) => outcome,
    }
}

fn try_build(args: &BuildArgs) -> Result<(), Outcome> {
    let mut loaded = Vec::new();
    for path in &args.paths {
        loaded.push(project::load_verified(path, &args.common)?);
    }
    check_together(&loaded)?;
    for (project, verified) in &loaded {
        let target = args.target.as_deref().or(project.config.target.as_deref());
        let toolchain = Toolchain::of(target).map_err(usage)?;
        one(args, project, verified, &toolchain)?;
    }
    if loaded.len() > 1 && args.emit == Emit::C {
        write(&args.output.join("Makefile"), &common_makefile(&loaded)).map_err(failed)?;
    }
    Ok(())
}

/// What emitting needs beside the program.
struct Build<'a> {
    emit: Options<'a>,
    /// Several programs share the folder.
    shared: bool,
}

/// Builds every program of a folder by its own makefile.
fn common_makefile(loaded: &[(Project, Verified)]) -> String {
    let mut text = "# Builds every program of this folder.\nall clean:\n".to_owned();
    for (_, verified) in loaded {
        text.push_str(&format!("\t$(MAKE) -f {}.mk $@\n", pcl2_emit::program_name(&verified.program().name)));
    }
    text.push_str("\n.PHONY: all clean\n");
    text
}

fn usage(message: String) -> Outcome {
    console::error(&message);
    Outcome::Usage
}

fn failed(message: String) -> Outcome {
    console::error(&message);
    Outcome::Failed
}

/// Programs in one folder have different names and the same width of reals.
fn check_together(loaded: &[(Project, Verified)]) -> Result<(), Outcome> {
    let names: Vec<String> = loaded.iter().map(|(_, v)| pcl2_emit::program_name(&v.program().name)).collect();
    for (i, name) in names.iter().enumerate() {
        if names[..i].contains(name) {
            return Err(usage(format!("two programs are called `{name}`; give one another `name` in pcl2.toml")));
        }
        if loaded[i].1.program().width != loaded[0].1.program().width {
            return Err(usage(
                "programs in one folder share a runtime: build f32 and f64 into different folders".to_owned(),
            ));
        }
    }
    Ok(())
}

fn one(args: &BuildArgs, project: &Project, verified: &Verified, toolchain: &Toolchain) -> Result<(), Outcome> {
    let part = match args.part {
        Part::Control => border::Part::Control,
        Part::Plant => border::Part::Plant,
    };
    let piece;
    let cut = if is_whole(verified.program(), part) {
        verified
    } else {
        piece = verify(cut(verified.program(), part)).map_err(|defect| failed(format!("cut: {defect}")))?;
        &piece
    };
    let options = Build { emit: project.emit_options(), shared: args.paths.len() > 1 };
    let target = &args.output;
    let (emitted, footprint) = match args.emit {
        Emit::C => (emit_into(target, cut, project, &options)?, None),
        Emit::Amalgamation => {
            let mut emitted = pcl2_emit::emit(cut, &project.sources, &options.emit);
            emitted.files = amalgamate(&emitted);
            write_all(target, &emitted.files)?;
            (emitted, None)
        }
        Emit::Obj | Emit::Lib | Emit::Exe => {
            let folder = tempfile::tempdir().map_err(|error| failed(format!("no temporary folder: {error}")))?;
            let emitted = emit_into(folder.path(), cut, project, &options)?;
            let footprint = compile(args.emit, folder.path(), target, &emitted, toolchain)?;
            (emitted, Some(footprint))
        }
    };
    console::answer(&summary(verified, cut, &emitted, args.part, footprint.as_ref())).done()
}

/// Writes the C of a program. Where several programs share a folder, each has a makefile of its own.
fn emit_into(folder: &Path, program: &Verified, project: &Project, options: &Build<'_>) -> Result<Emitted, Outcome> {
    let mut trouble = None;
    let makefile = format!("{}.mk", pcl2_emit::program_name(&program.program().name));
    let emitted = pcl2_emit::emit_each(program, &project.sources, &options.emit, &mut |path, text| {
        if trouble.is_none() {
            let path = if path == "Makefile" && options.shared { makefile.clone() } else { path };
            trouble = write(&folder.join(path), &text).err();
        }
    });
    match trouble {
        None => Ok(emitted),
        Some(message) => Err(failed(message)),
    }
}

fn write_all(folder: &Path, files: &[(String, String)]) -> Result<(), Outcome> {
    files.iter().try_for_each(|(path, text)| write(&folder.join(path), text)).map_err(failed)
}

fn write(path: &Path, text: &str) -> Result<(), String> {
    let folder = path.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(folder)
        .and_then(|()| output::write_file(path, text.as_bytes()))
        .map_err(|error| format!("cannot write `{}`: {error}", path.display()))
}

/// Compiles the emitted C in its folder and moves what was asked for to its place.
fn compile(
    emit: Emit,
    folder: &Path,
    target: &Path,
    emitted: &Emitted,
    toolchain: &Toolchain,
) -> Result<Footprint, Outcome> {
    let mut includes: Vec<PathBuf> = emitted.folders.iter().map(|include| folder.join(include)).collect();
    includes.push(folder.to_path_buf());
    let objects = objects(folder, &emitted.sources, &includes, toolchain).map_err(failed)?;
    let footprint = Footprint::measure(&objects, &emitted.name, toolchain);
    let place = |from: &Path, name: &Path| copy(from, &target.join(name));
    match emit {
        Emit::Obj => {
            for object in &objects {
                let name = object.strip_prefix(folder).unwrap_or(object);
                place(object, name).map_err(failed)?;
            }
            headers(folder, target).map_err(failed)?;
        }
        Emit::Lib => {
            let name = format!("lib{}.a", emitted.name);
            let library = folder.join(&name);
            toolchain::run(toolchain.archive(&library, &objects)).map_err(failed)?;
            place(&library, Path::new(&name)).map_err(failed)?;
            headers(folder, target).map_err(failed)?;
        }
        Emit::Exe | Emit::C | Emit::Amalgamation => {
            let program = folder.join("program");
            let mut link = toolchain.compile(&includes);
            link.arg(folder.join(format!("{}_example.c", emitted.name))).args(&objects).arg("-o").arg(&program);
            link.arg("-lm");
            toolchain::run(link).map_err(failed)?;
            place(&program, Path::new(&emitted.name)).map_err(failed)?;
        }
    }
    Ok(footprint)
}

fn objects(
    folder: &Path,
    sources: &[String],
    includes: &[PathBuf],
    toolchain: &Toolchain,
) -> Result<Vec<PathBuf>, String> {
    let mut objects = Vec::new();
    for source in sources {
        let object = folder.join(source).with_extension("o");
        let mut compile = toolchain.compile(includes);
        compile.args(footprint::FLAGS).arg("-c").arg(folder.join(source)).arg("-o").arg(&object);
        if toolchain::run(compile).is_err() {
            let mut plain = toolchain.compile(includes);
            plain.arg("-c").arg(folder.join(source)).arg("-o").arg(&object);
            toolchain::run(plain)?;
        }
        objects.push(object);
    }
    Ok(objects)
}

/// The headers that a user of objects or a library includes.
fn headers(folder: &Path, target: &Path) -> Result<(), String> {
    let mut open = vec![folder.to_path_buf()];
    while let Some(next) = open.pop() {
        let entries = fs::read_dir(&next).map_err(|error| error.to_string())?;
        for path in entries.filter_map(Result::ok).map(|entry| entry.path()) {
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|extension| extension == "h") {
                copy(&path, &target.join(path.strip_prefix(folder).unwrap_or(&path)))?;
            }
        }
    }
    Ok(())
}

fn copy(from: &Path, to: &Path) -> Result<(), String> {
    let said = |error: std::io::Error| format!("cannot write `{}`: {error}", to.display());
    let folder = to.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(folder).map_err(said)?;
    let bytes = fs::read(from).map_err(said)?;
    output::write_file(to, &bytes).map_err(said)?;
    let permissions = fs::metadata(from).map_err(said)?.permissions();
    fs::set_permissions(to, permissions).map_err(said)
}

/// What was built, what was left out, what crosses the border, and how large it is.
fn summary(whole: &Verified, cut: &Verified, emitted: &Emitted, part: Part, footprint: Option<&Footprint>) -> String {
    use pcl2_lang::program::Role;
    let unit = cut.program().main();
    let names = |role: Role| {
        let signals = unit.signals.iter().filter(|signal| signal.role == role);
        signals.map(|signal| signal.name.clone()).collect::<Vec<_>>().join(", ")
    };
    let mut text = format!("{}: {} blocks", emitted.name, emitted.sizes.blocks);
    let left_out = whole.program().main().blocks.len() - unit.blocks.len();
    if left_out > 0 {
        let other = if part == Part::Control { "PLANT" } else { "CONTROL" };
        text.push_str(&format!(", {left_out} of {other} left out"));
        text.push_str(&format!("\n  inputs:  {}\n  outputs: {}", names(Role::Input), names(Role::Output)));
    }
    text.push_str(&format!("\n  RAM:     {} bytes an instance", emitted.sizes.instance));
    if let Some(footprint) = footprint {
        text.push_str(&footprint.lines());
    }
    text.push('\n');
    text
}
