//! What the C compiler says about size: code, the deepest stack, and which library functions are called.

use crate::toolchain::{self, Toolchain};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::PathBuf;

/// Asks gcc for the stack of each function and for who calls whom.
pub(super) const FLAGS: [&str; 1] = ["-fcallgraph-info=su"];

/// Library functions that the generated C may call: compilers make them of plain C.
const PLAIN: [&str; 5] = ["memcpy", "memset", "memmove", "memcmp", "sqrt"];

/// Sizes of compiled code. Each is `None` when the tools do not tell.
#[derive(Debug, Default)]
pub(super) struct Footprint {
    /// Bytes of code and constants.
    code: Option<u64>,
    /// The deepest stack below `NAME_step`, in bytes.
    stack: Option<u64>,
    /// Functions of the mathematical library that are called.
    math: Option<Vec<String>>,
}

impl Footprint {
    pub(super) fn measure(objects: &[PathBuf], program: &str, toolchain: &Toolchain) -> Footprint {
        let graphs: Option<Vec<String>> =
            objects.iter().map(|object| fs::read_to_string(object.with_extension("ci")).ok()).collect();
        let graph = graphs.map(|texts| Graph::read(&texts));
        Footprint {
            code: code_bytes(objects, toolchain),
            stack: graph.as_ref().and_then(|graph| graph.deepest(&format!("{program}_step"))),
            math: graph.map(|graph| graph.outside()),
        }
    }

    pub(super) fn lines(&self) -> String {
        let mut text = String::new();
        if let Some(code) = self.code {
            text.push_str(&format!("\n  code:    {code} bytes, constants included"));
        }
        if let Some(stack) = self.stack {
            text.push_str(&format!("\n  stack:   at most {stack} bytes in a step, no recursion"));
        }
        match self.math.as_deref() {
            Some([]) => text.push_str("\n  library: nothing but memory functions: no heap, no libm"),
            Some(names) => text.push_str(&format!("\n  library: {}", names.join(", "))),
            None => {}
        }
        text
    }
}

/// Text and data of all objects, as `size` counts them.
fn code_bytes(objects: &[PathBuf], toolchain: &Toolchain) -> Option<u64> {
    let output = toolchain::run(toolchain.size(objects)).ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    text.lines()
        .skip(1)
        .map(|line| {
            let mut columns = line.split_whitespace().map(|column| column.parse::<u64>().ok());
            Some(columns.next()?? + columns.next()??)
        })
        .sum()
}

/// Functions with their stack, and their calls, from gcc's `.ci` files.
#[derive(Debug, Default)]
struct Graph {
    stack: BTreeMap<String, u64>,
    calls: BTreeMap<String, BTreeSet<String>>,
}

impl Graph {
    fn read(texts: &[String]) -> Graph {
        let mut graph = Graph::default();
        for line in texts.iter().flat_map(|text| text.lines()) {
            if line.starts_with("node:") {
                if let (Some(title), Some(label)) = (field(line, "title: \""), field(line, "label: \"")) {
                    if let Some(bytes) = bytes(label) {
                        graph.stack.insert(plain(title), bytes);
                    }
                }
            } else if line.starts_with("edge:") {
                if let (Some(from), Some(to)) = (field(line, "sourcename: \""), field(line, "targetname: \"")) {
                    graph.calls.entry(plain(from)).or_default().insert(plain(to));
                }
            }
        }
        graph
    }

    /// The deepest stack below a function; `None` when a call cannot be followed or leads back.
    fn deepest(&self, root: &str) -> Option<u64> {
        self.depth(root, &mut BTreeMap::new(), 0)
    }

    fn depth(&self, name: &str, known: &mut BTreeMap<String, u64>, level: usize) -> Option<u64> {
        if let Some(depth) = known.get(name) {
            return Some(*depth);
        }
        if level > 200 {
            return None;
        }
        let own = match self.stack.get(name) {
            Some(own) => *own,
            None if PLAIN.contains(&name) => 0,
            None => return None,
        };
        let mut below = 0;
        for callee in self.calls.get(name).into_iter().flatten() {
            below = below.max(self.depth(callee, known, level + 1)?);
        }
        known.insert(name.to_owned(), own + below);
        Some(own + below)
    }

    /// Functions that are called and not defined, plain ones left out.
    fn outside(&self) -> Vec<String> {
        let called: BTreeSet<&String> = self.calls.values().flatten().collect();
        let outside =
            called.into_iter().filter(|name| !self.stack.contains_key(*name) && !PLAIN.contains(&name.as_str()));
        outside.filter(|name| *name != "__indirect_call").cloned().collect()
    }
}

fn field<'a>(line: &'a str, key: &str) -> Option<&'a str> {
    let rest = &line[line.find(key)? + key.len()..];
    rest.split('"').next()
}

/// Static functions are titled `file.c:name`.
fn plain(title: &str) -> String {
    title.rsplit(':').next().unwrap_or(title).to_owned()
}

/// `name\nplace\n48 bytes (static)`
fn bytes(label: &str) -> Option<u64> {
    let line = label.split("\\n").find(|part| part.contains(" bytes ("))?;
    line.split(' ').next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_deepest_path_counts() {
        let text = "node: { title: \"a_step\" label: \"a_step\\na.c:1:6\\n16 bytes (static)\" }\n\
                    node: { title: \"a.c:f\" label: \"f\\na.c:9:6\\n32 bytes (static)\" }\n\
                    node: { title: \"g\" label: \"g\\nb.c:9:6\\n8 bytes (static)\" }\n\
                    edge: { sourcename: \"a_step\" targetname: \"a.c:f\" }\n\
                    edge: { sourcename: \"a_step\" targetname: \"g\" }\n\
                    edge: { sourcename: \"g\" targetname: \"pow\" }\n";
        let graph = Graph::read(&[text.to_owned()]);
        assert_eq!(graph.outside(), ["pow"]);
        assert_eq!(graph.deepest("a_step"), None);
        let graph = Graph::read(&[text.replace("pow", "sqrt")]);
        assert_eq!(graph.deepest("a_step"), Some(48));
    }
}
