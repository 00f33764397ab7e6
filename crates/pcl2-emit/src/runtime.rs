//! The C block runtime inside the compiler, and which of it a program needs.

use crate::context::Context;
use crate::layout;
use crate::net::layout::NetLayout;
use pcl2_lang::decl::Decl;
use pcl2_lang::kernel;
use pcl2_lang::types::Width;
use std::collections::BTreeMap;

include!(concat!(env!("OUT_DIR"), "/runtime.rs"));

/// The folder of a user's own kernels.
const USER: &str = "user";

/// All files of the runtime: path below `runtime-c` and text.
pub fn files() -> &'static [(&'static str, &'static str)] {
    FILES
}

/// The runtime's part of the output.
#[derive(Debug, Default)]
pub(crate) struct Runtime {
    /// Path below the output folder, and text.
    pub(crate) files: BTreeMap<String, String>,
}

impl Runtime {
    /// The folders with headers.
    pub(crate) fn folders(&self) -> Vec<String> {
        let headers = self.files.keys().filter(|path| path.ends_with(".h"));
        let mut folders: Vec<String> =
            headers.filter_map(|path| path.rsplit_once('/').map(|(folder, _)| folder.to_owned())).collect();
        folders.dedup();
        folders
    }

    /// The C files.
    pub(crate) fn sources(&self) -> impl Iterator<Item = &str> {
        self.files.keys().map(String::as_str).filter(|path| path.ends_with(".c"))
    }
}

/// Whether a file among those of the runtime is of a user's own kernels.
pub(crate) fn is_of_user(path: &str) -> bool {
    path.split('/').any(|folder| folder == USER)
}

/// What belongs to a board port: linked by its user together with the table of points, never by itself.
pub(crate) fn is_port(path: &str) -> bool {
    path.starts_with("pcl2/ports/")
}

/// The folder of a declaration's kernel in the output.
pub(crate) fn folder(decl: &Decl) -> &str {
    if decl.user { USER } else { &decl.group }
}

/// Collects what the program's blocks need. `family` lists all known declarations, `user` the user's own C files.
pub(crate) fn collect(cx: &Context<'_>, known: &[&Decl], user: &[(String, String)], io: bool) -> Runtime {
    let mut collector = Collector { known, user, runtime: Runtime::default(), queue: Vec::new() };
    for header in ["pcl2.h", "pcl2_map.h", "pcl2_tune.h"] {
        collector.include(header);
    }
    if io {
        collector.include("pcl2_io.h");
        collector.port("io.c");
    }
    collector.put("pcl2/pcl2_config.h".to_owned(), config(cx));
    if let Some(header) = cx.net_header() {
        collector.resolve("", header);
    }
    for decl in layout::used_decls(cx.program, &cx.layout) {
        let decl = cx.program.decl(decl);
        if decl.has_kernel() {
            let family = family(known, &cx.program.decls, decl);
            collector.kernel(decl, &family);
        }
    }
    collector.follow();
    collector.math();
    collector.runtime
}

fn family<'d>(known: &[&'d Decl], used: &'d [Decl], decl: &Decl) -> Vec<&'d Decl> {
    let same = |other: &&Decl| other.user == decl.user && other.group == decl.group && other.stem == decl.stem;
    let family: Vec<&Decl> = known.iter().copied().filter(same).collect();
    if family.is_empty() { used.iter().filter(same).collect() } else { family }
}

fn config(cx: &Context<'_>) -> String {
    let (real, bits, literal) = match cx.program.width {
        Width::F64 => ("double", 64, "x"),
        Width::F32 => ("float", 32, "x##f"),
    };
    format!(
        "/* The width of a real. */
#ifndef PCL2_CONFIG_H
#define PCL2_CONFIG_H

typedef {real} pcl2_real;
#define PCL2_REAL_BITS {bits}
#define PCL2_R(x) {literal}
{}
#endif
",
        net_word(cx)
    )
}

/// The words of the tables of nets are as short as they fit.
fn net_word(cx: &Context<'_>) -> &'static str {
    let fits = |net: &NetLayout| net.table.words.iter().all(|word| u16::try_from(*word).is_ok());
    if cx.has_nets() && cx.nets().all(fits) { "#define PCL2_NET_WORD uint16_t\n" } else { "" }
}

struct Collector<'c> {
    known: &'c [&'c Decl],
    user: &'c [(String, String)],
    runtime: Runtime,
    queue: Vec<String>,
}

impl Collector<'_> {
    fn put(&mut self, path: String, text: String) {
        if !self.runtime.files.contains_key(&path) {
            self.queue.push(path.clone());
            self.runtime.files.insert(path, text);
        }
    }

    fn kernel(&mut self, decl: &Decl, family: &[&Decl]) {
        let folder = folder(decl).to_owned();
        let header = kernel::header(&decl.stem, family);
        self.put(format!("pcl2/{folder}/pcl2_{}.h", decl.stem), header);
        for name in [format!("{}.c", decl.stem), format!("{}_inline.h", decl.stem)] {
            if decl.user {
                self.user_file(&name);
            } else {
                self.packed(&folder, &name);
            }
        }
    }

    fn user_file(&mut self, name: &str) -> bool {
        let Some((_, text)) = self.user.iter().find(|(known, _)| known == name) else {
            return false;
        };
        self.put(format!("pcl2/{USER}/{name}"), text.clone());
        true
    }

    fn packed(&mut self, folder: &str, name: &str) -> bool {
        let path = format!("src/{folder}/{name}");
        let Some((_, text)) = FILES.iter().find(|(known, _)| *known == path) else {
            return false;
        };
        self.put(format!("pcl2/{folder}/{name}"), (*text).to_owned());
        true
    }

    /// Follows `#include "..."` of everything that was put.
    fn follow(&mut self) {
        while let Some(path) = self.queue.pop() {
            let text = self.runtime.files.get(&path).cloned().unwrap_or_default();
            let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder).trim_start_matches("pcl2/").to_owned();
            for name in includes(&text) {
                self.resolve(&folder, name);
            }
        }
    }

    fn resolve(&mut self, folder: &str, name: &str) {
        if folder == USER && self.user_file(name) {
            self.user_file(&source_of(name));
            return;
        }
        if self.include(name) {
            return;
        }
        let place = FILES.iter().find(|(path, _)| path.starts_with("src/") && path.ends_with(&format!("/{name}")));
        if let Some((path, _)) = place {
            let found =
                path.strip_prefix("src/").and_then(|path| path.rsplit_once('/')).map_or("", |(folder, _)| folder);
            self.packed(found, name);
            self.packed(found, &source_of(name));
            return;
        }
        let stem = source_of(name);
        let stem = stem.strip_suffix(".c").unwrap_or(&stem);
        if let Some(decl) = self.known.iter().find(|decl| decl.stem == stem && decl.has_kernel()) {
            let family = family(self.known, &[], decl);
            self.kernel(decl, &family);
        }
    }

    /// A file that board ports share.
    fn port(&mut self, name: &str) {
        let path = format!("ports/{name}");
        if let Some((_, text)) = FILES.iter().find(|(known, _)| *known == path) {
            self.put(format!("pcl2/{path}"), (*text).to_owned());
        }
    }

    fn include(&mut self, name: &str) -> bool {
        let path = format!("include/{name}");
        let Some((_, text)) = FILES.iter().find(|(known, _)| *known == path) else {
            return false;
        };
        self.put(format!("pcl2/{name}"), (*text).to_owned());
        true
    }

    /// Of the functions in `pcl2_math.h`, those that something calls; they may call others.
    fn math(&mut self) {
        if !self.runtime.files.contains_key("pcl2/pcl2_math.h") {
            return;
        }
        loop {
            let missing: Vec<&(&str, &str)> = FILES.iter().filter(|(path, text)| self.needs(path, text)).collect();
            if missing.is_empty() {
                return;
            }
            for (path, _) in missing {
                self.packed("math", path.trim_start_matches("src/math/"));
            }
            self.follow();
        }
    }

    fn needs(&self, path: &str, text: &str) -> bool {
        let Some(name) = path.strip_prefix("src/math/").filter(|name| name.ends_with(".c")) else {
            return false;
        };
        let present = self.runtime.files.contains_key(&format!("pcl2/math/{name}"));
        let called = |function: &str| {
            let mut texts = self.runtime.files.iter().filter(|(path, _)| *path != "pcl2/pcl2_math.h");
            texts.any(|(_, text)| calls(text, function))
        };
        !present && defined(text).any(called)
    }
}

/// `pcl2_expm.h` goes with `expm.c`.
fn source_of(header: &str) -> String {
    let stem = header.strip_suffix(".h").unwrap_or(header);
    format!("{}.c", stem.strip_prefix("pcl2_").unwrap_or(stem))
}

fn includes(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter_map(|line| line.trim_start().strip_prefix("#include \"")?.split('"').next())
}

/// The external functions that a file defines: a line at the margin that is no declaration.
fn defined(text: &str) -> impl Iterator<Item = &str> {
    let definition = |line: &&str| {
        let margin = line.bytes().next().is_some_and(|byte| byte.is_ascii_alphabetic());
        margin && !line.starts_with("static") && !line.trim_end().ends_with(';')
    };
    text.lines().filter(definition).filter_map(|line| {
        let name = line.split('(').next()?.rsplit([' ', '*']).next()?;
        (line.contains('(') && name.starts_with("pcl2_")).then_some(name)
    })
}

fn calls(text: &str, function: &str) -> bool {
    text.match_indices(function).any(|(at, _)| {
        let before = text.as_bytes().get(at.wrapping_sub(1));
        let part = before.is_some_and(|byte| byte.is_ascii_alphanumeric() || *byte == b'_');
        let after = text.as_bytes().get(at + function.len());
        let longer = after.is_some_and(|byte| byte.is_ascii_alphanumeric() || *byte == b'_');
        !part && !longer
    })
}
