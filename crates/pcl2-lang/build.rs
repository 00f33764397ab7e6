//! Builds the grammars and packs what the compiler carries inside itself: declarations and error pages.

use std::fmt::Write;
use std::path::{Path, PathBuf};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("cargo::rerun-if-changed=build.rs");
    for grammar in ["src/cfg.lalrpop", "src/fc.lalrpop"] {
        println!("cargo::rerun-if-changed={grammar}");
    }
    lalrpop::process_src()?;
    let root = Path::new(&std::env::var("CARGO_MANIFEST_DIR")?).join("../..");
    let mut code = String::new();
    pack(&mut code, "DECLARATIONS", &root.join("blocks"), "fc")?;
    pack(&mut code, "PAGES", &root.join("docs/errors"), "md")?;
    let out = PathBuf::from(std::env::var("OUT_DIR")?).join("packed.rs");
    std::fs::write(out, code)?;
    Ok(())
}

/// A table of (path below the folder, text), in order of path.
fn pack(code: &mut String, table: &str, folder: &Path, extension: &str) -> Result<(), Box<dyn std::error::Error>> {
    let mut files = Vec::new();
    if folder.is_dir() {
        collect(folder, extension, &mut files)?;
    }
    files.sort();
    writeln!(code, "pub(crate) const {table}: &[(&str, &str)] = &[")?;
    for file in files {
        let name: Vec<String> =
            file.strip_prefix(folder)?.components().map(|c| c.as_os_str().to_string_lossy().into_owned()).collect();
        writeln!(code, "    ({:?}, include_str!({:?})),", name.join("/"), file.canonicalize()?)?;
    }
    writeln!(code, "];")?;
    Ok(())
}

fn collect(folder: &Path, extension: &str, files: &mut Vec<PathBuf>) -> Result<(), Box<dyn std::error::Error>> {
    println!("cargo::rerun-if-changed={}", folder.display());
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            collect(&path, extension, files)?;
        } else if path.extension().is_some_and(|e| e == extension) {
            println!("cargo::rerun-if-changed={}", path.display());
            files.push(path);
        }
    }
    Ok(())
}
