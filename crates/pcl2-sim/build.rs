//! Compiles every C kernel in both widths, with thunks that take the arguments from a table of pointers.

use pcl2_lang::catalogue::Catalogue;
use pcl2_lang::decl::{Decl, Direction};
use pcl2_lang::kernel::{self, Arg, Entry};
use pcl2_lang::source::Sources;
use pcl2_lang::symbol::Symbols;
use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs};

type Outcome<T> = Result<T, Box<dyn Error>>;

/// The widths: bits, C type, suffix of a literal, prefix of external names.
const WIDTHS: [(u32, &str, &str, &str); 2] = [(64, "double", "", "pcl2_"), (32, "float", "f", "pcl2f_")];

fn main() -> Outcome<()> {
    let out = PathBuf::from(env::var("OUT_DIR")?);
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR")?).join("../..");
    let runtime = root.join("runtime-c");
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed={}", runtime.display());

    let decls = catalogue()?;
    let kernels: Vec<&Decl> = decls.iter().filter(|decl| decl.has_kernel() && has_kernel(decl, &runtime)).collect();
    let sources = c_files(&runtime, &kernels)?;
    fs::write(out.join("kernels.rs"), names(&kernels))?;
    for width in WIDTHS {
        let folder = out.join(format!("f{}", width.0));
        write_headers(&folder, width, &kernels, &runtime)?;
        fs::write(folder.join("thunks.c"), thunks(&kernels, width.0))?;
        compile(&folder, &format!("pcl2_kernels_f{}", width.0), &runtime, &sources)?;
    }
    Ok(())
}

/// The packed declarations. A faulty one is missing; the suite's tests report that as an error.
fn catalogue() -> Outcome<Vec<Decl>> {
    let mut diagnostics = Vec::new();
    let catalogue = Catalogue::packed(&mut Sources::default(), &mut Symbols::default(), &mut diagnostics);
    for diagnostic in diagnostics.iter().filter(|diagnostic| diagnostic.is_error()) {
        println!("cargo::warning=the catalogue has an error: {}", diagnostic.message);
    }
    Ok(catalogue.decls().cloned().collect())
}

/// A declaration without its kernel is left out here; the suite's test of pairs reports it as an error.
fn has_kernel(decl: &Decl, runtime: &Path) -> bool {
    let file = if decl.inline { format!("{}_inline.h", decl.stem) } else { format!("{}.c", decl.stem) };
    let path = runtime.join("src").join(&decl.group).join(file);
    let found = path.is_file();
    if !found {
        println!("cargo::warning={} has no kernel", decl.name);
    }
    found
}

/// Every C file of the runtime: kernels, mathematics, shared helpers.
fn c_files(runtime: &Path, kernels: &[&Decl]) -> Outcome<Vec<PathBuf>> {
    let mut files = Vec::new();
    for folder in folders(runtime)? {
        for entry in fs::read_dir(folder)? {
            let path = entry?.path();
            if path.extension().is_some_and(|extension| extension == "c") && is_declared(&path, kernels)? {
                files.push(path);
            }
        }
    }
    files.sort();
    Ok(files)
}

/// A kernel includes the header of its own stem, which is generated from its declaration.
fn is_declared(path: &Path, kernels: &[&Decl]) -> Outcome<bool> {
    let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    let header = format!("pcl2_{stem}.h");
    let includes_it = fs::read_to_string(path)?.contains(&format!("#include \"{header}\""));
    let written = path.with_file_name(&header).is_file();
    let declared = !includes_it || written || kernels.iter().any(|decl| decl.stem == stem);
    if !declared {
        println!("cargo::warning={} has no declaration", path.display());
    }
    Ok(declared)
}

/// The folders of C sources: src/<group>.
fn folders(runtime: &Path) -> Outcome<Vec<PathBuf>> {
    let mut folders = Vec::new();
    for entry in fs::read_dir(runtime.join("src"))? {
        let path = entry?.path();
        if path.is_dir() {
            folders.push(path);
        }
    }
    folders.sort();
    Ok(folders)
}

/// Name and stem of each kernel, in the order of the C tables.
fn names(kernels: &[&Decl]) -> String {
    let mut text = format!("pub(super) static NAMES: [(&str, &str); {}] = [\n", kernels.len());
    for decl in kernels {
        let _ = writeln!(text, "    ({:?}, {:?}),", decl.name, decl.stem);
    }
    text.push_str("];\n");
    text
}

fn write_headers(folder: &Path, width: (u32, &str, &str, &str), kernels: &[&Decl], runtime: &Path) -> Outcome<()> {
    fs::create_dir_all(folder)?;
    let mut families: BTreeMap<&str, Vec<&Decl>> = BTreeMap::new();
    for decl in kernels {
        families.entry(&decl.stem).or_default().push(decl);
    }
    let mut headers = Vec::new();
    for (stem, decls) in families {
        let text = kernel::header(stem, &decls);
        fs::write(folder.join(format!("pcl2_{stem}.h")), &text)?;
        headers.push(text);
    }
    let (bits, real, suffix, prefix) = width;
    let literal = if suffix.is_empty() { "x".to_owned() } else { format!("x##{suffix}") };
    let mut config = format!(
        "#ifndef PCL2_CONFIG_H\n#define PCL2_CONFIG_H\n\ntypedef {real} pcl2_real;\n#define PCL2_REAL_BITS {bits}\n#define PCL2_R(x) {literal}\n\n"
    );
    if prefix != "pcl2_" {
        for name in external_names(runtime, &headers)? {
            let _ = writeln!(config, "#define {name} {prefix}{}", &name["pcl2_".len()..]);
        }
    }
    config.push_str("\n#endif\n");
    fs::write(folder.join("pcl2_config.h"), config)?;
    Ok(())
}

/// All functions that could be external: a name that starts with `pcl2_`, stands before a parenthesis and is no macro.
fn external_names(runtime: &Path, headers: &[String]) -> Outcome<BTreeSet<String>> {
    let mut texts = headers.to_vec();
    for folder in folders(runtime)?.into_iter().chain([runtime.join("include")]) {
        for entry in fs::read_dir(folder)? {
            let path = entry?.path();
            if path.is_file() {
                texts.push(fs::read_to_string(path)?);
            }
        }
    }
    let mut names = BTreeSet::new();
    let mut macros = BTreeSet::new();
    for text in &texts {
        for (start, _) in text.match_indices("pcl2_") {
            let inside = text[..start].ends_with(|c: char| c.is_ascii_alphanumeric() || c == '_');
            let end = text[start..].find(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
            let name = &text[start..end.map_or(text.len(), |end| start + end)];
            if text[..start].ends_with("#define ") {
                macros.insert(name.to_owned());
            } else if !inside && text[start + name.len()..].trim_start().starts_with('(') {
                names.insert(name.to_owned());
            }
        }
    }
    Ok(names.difference(&macros).cloned().collect())
}

/// The thunks and their table for one width.
fn thunks(kernels: &[&Decl], bits: u32) -> String {
    let mut text = "/* Kernels called with arguments from a table of pointers. */\n#include <stddef.h>\n\n".to_owned();
    let stems: BTreeSet<&str> = kernels.iter().map(|decl| decl.stem.as_str()).collect();
    for stem in stems {
        let _ = writeln!(text, "#include \"pcl2_{stem}.h\"");
    }
    text.push_str("\ntypedef void thunk(void *const *f);\n\n");
    text.push_str("struct kernel {\n    uint32_t size, members;\n    const uint32_t *offsets;\n    thunk *step, *init, *tune, *check;\n};\n");
    for decl in kernels {
        for entry in Entry::ALL.into_iter().filter(|entry| kernel::has(decl, *entry)) {
            thunk(&mut text, decl, entry);
        }
        offsets(&mut text, decl);
    }
    let _ = write!(text, "\nextern const struct kernel pcl2_kernels_f{bits}[];\n");
    let _ = writeln!(text, "const struct kernel pcl2_kernels_f{bits}[] = {{");
    for decl in kernels {
        let _ = writeln!(text, "    {},", row(decl));
    }
    text.push_str("};\n");
    text
}

fn thunk_name(decl: &Decl, entry: Entry) -> String {
    let word = match entry {
        Entry::Step => "step",
        Entry::Init => "init",
        Entry::Tune => "tune",
        Entry::Check => "check",
    };
    format!("{word}_{}", decl.name)
}

fn thunk(text: &mut String, decl: &Decl, entry: Entry) {
    let args = kernel::args(decl, entry);
    let values: Vec<String> = args.iter().enumerate().map(|(i, arg)| argument(decl, *arg, i)).collect();
    let call = format!("{}({})", kernel::function_name(decl, entry), values.join(", "));
    let result = match entry {
        Entry::Check => format!("*(int32_t *)f[{}] = ", args.len()),
        Entry::Step if kernel::returns_value(decl) => {
            format!("*({} *)f[{}] = ", kernel::c_element(&decl.outputs[0].ty), args.len())
        }
        Entry::Step | Entry::Init | Entry::Tune => String::new(),
    };
    let unused = if values.is_empty() && result.is_empty() { "    (void)f;\n" } else { "" };
    let _ = write!(
        text,
        "\nstatic void {}(void *const *f)\n{{\n{unused}    {result}{call};\n}}\n",
        thunk_name(decl, entry)
    );
}

fn argument(decl: &Decl, arg: Arg, i: usize) -> String {
    let by_value = |element: &str| format!("*(const {element} *)f[{i}]");
    match arg {
        Arg::Size(_) => by_value("int32_t"),
        Arg::Period => by_value("int64_t"),
        Arg::Fail => by_value("pcl2_real"),
        Arg::Port(port) => match decl.ports().nth(port) {
            Some(port) if port.ty.is_scalar() && port.group.is_none() => by_value(kernel::c_element(&port.ty)),
            _ => format!("f[{i}]"),
        },
        Arg::Param(param) if decl.params[param].ty.is_scalar() => by_value(kernel::c_element(&decl.params[param].ty)),
        Arg::Image => match decl.image {
            Some(image) if image.direction == Direction::In => by_value(kernel::c_scalar(image.scalar)),
            _ => format!("f[{i}]"),
        },
        Arg::Instance | Arg::Param(_) | Arg::Memory(_) | Arg::Tuned(_) | Arg::Work(_) | Arg::Output(_) | Arg::Left => {
            format!("f[{i}]")
        }
    }
}

fn offsets(text: &mut String, decl: &Decl) {
    let members = kernel::members(decl);
    if members.is_empty() {
        return;
    }
    let _ = write!(text, "\nstatic const uint32_t offsets_{}[] = {{\n", decl.name);
    for member in members {
        let _ = writeln!(text, "    offsetof(struct pcl2_{}, {}),", decl.name, kernel::member_name(decl, member));
    }
    text.push_str("};\n");
}

fn row(decl: &Decl) -> String {
    let members = kernel::members(decl).len();
    let (size, offsets) = if members == 0 {
        ("0".to_owned(), "NULL".to_owned())
    } else {
        (format!("sizeof(struct pcl2_{})", decl.name), format!("offsets_{}", decl.name))
    };
    let entry = |entry| if kernel::has(decl, entry) { thunk_name(decl, entry) } else { "NULL".to_owned() };
    let [step, init, tune, check] = [Entry::Step, Entry::Init, Entry::Tune, Entry::Check].map(entry);
    format!("{{{size}, {members}, {offsets}, {step}, {init}, {tune}, {check}}}")
}

fn compile(folder: &Path, library: &str, runtime: &Path, sources: &[PathBuf]) -> Outcome<()> {
    let mut build = cc::Build::new();
    build.std("c99").opt_level(2).flag("-ffp-contract=off").warnings(false);
    build.debug(false).force_frame_pointer(false);
    build.include(folder).include(runtime.join("include"));
    for group in folders(runtime)? {
        build.include(group);
    }
    build.files(sources).file(folder.join("thunks.c"));
    build.try_compile(library)?;
    Ok(())
}
