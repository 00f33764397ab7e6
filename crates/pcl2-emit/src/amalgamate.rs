//! A program as one header and one C file.

use crate::Emitted;
use crate::runtime::is_of_user;
use crate::unused::without_unused;
use std::collections::{BTreeMap, BTreeSet};

/// Puts the files of a program together: `NAME.h` and `NAME.c` with everything that they include of ours,
/// and the example, the model description as they are.
pub fn amalgamate(emitted: &Emitted) -> Vec<(String, String)> {
    let files: BTreeMap<&str, &str> = emitted.files.iter().map(|(path, text)| (path.as_str(), text.as_str())).collect();
    let name = &emitted.name;
    let mut weaver = Weaver {
        files: &files,
        folders: &emitted.folders,
        done: BTreeSet::new(),
        text: String::new(),
        ours: Vec::new(),
    };
    let header_name = format!("{name}.h");
    weaver.weave(&header_name);
    let header = std::mem::take(&mut weaver.text);
    weaver.ours.clear();
    weaver.text.push_str(&format!("#include \"{header_name}\"\n\n"));
    weaver.ours.extend([true, true]);
    let main = format!("{name}.c");
    let (last, first): (Vec<&String>, Vec<&String>) = emitted.sources.iter().partition(|path| **path == main);
    for path in first.into_iter().chain(last) {
        weaver.weave(path);
    }
    let mut out = vec![(header_name, header), (main, without_unused(&weaver.text, &weaver.ours))];
    for path in [format!("{name}_example.c"), format!("{name}.json")] {
        if let Some(text) = files.get(path.as_str()) {
            out.push((path, (*text).to_owned()));
        }
    }
    out
}

/// The header with the kernels' prototypes comes first here, so that their linkage is the one that it gives them.
const STATIC: &str = "#define PCL2_KERNEL static inline";
const EXTERNAL: &str = "#define PCL2_KERNEL";

struct Weaver<'a> {
    files: &'a BTreeMap<&'a str, &'a str>,
    folders: &'a [String],
    done: BTreeSet<String>,
    text: String,
    /// By line of the text: no user wrote it.
    ours: Vec<bool>,
}

impl Weaver<'_> {
    /// Appends a file, and in place of each of our includes that file, once.
    fn weave(&mut self, path: &str) {
        let Some(text) = self.files.get(path).filter(|_| self.done.insert(path.to_owned())) else {
            return;
        };
        for line in text.lines() {
            match included(line).and_then(|name| self.find(path, name)) {
                Some(found) => self.weave(&found),
                None => {
                    self.ours.push(!is_of_user(path));
                    self.text.push_str(if line == STATIC { EXTERNAL } else { line });
                    self.text.push('\n');
                }
            }
        }
    }

    /// Where an include leads: beside the file, then in the folders of headers, then at the top.
    fn find(&self, from: &str, name: &str) -> Option<String> {
        let beside = from.rsplit_once('/').map_or(name.to_owned(), |(folder, _)| format!("{folder}/{name}"));
        let folders = self.folders.iter().map(|folder| format!("{folder}/{name}"));
        let candidates = std::iter::once(beside).chain(folders).chain(std::iter::once(name.to_owned()));
        candidates.into_iter().find(|path| self.files.contains_key(path.as_str()))
    }
}

/// `#include "name"`
fn included(line: &str) -> Option<&str> {
    line.trim_start().strip_prefix("#include")?.trim_start().strip_prefix('"')?.split('"').next()
}
