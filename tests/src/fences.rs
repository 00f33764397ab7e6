//! Programs in Markdown pages. An example is a `pcl2` fence; the fences before it that carry `file=NAME` are files
//! beside it, a `toml` fence is its `pcl2.toml`, and `args=".."` goes on the command line.

use crate::{compilers, pcl2};
use std::fs;
use std::path::Path;
use std::process::Command;
use tempfile::TempDir;

/// A program with the files that it needs.
#[derive(Clone, Debug, Default)]
pub struct Example {
    /// The line of the program's fence, counted from 1.
    pub line: usize,
    /// Names and texts; the program itself is `example.cfg`.
    files: Vec<(String, String)>,
    args: Vec<String>,
}

/// A fenced block.
#[derive(Clone, Debug)]
pub struct Fence {
    /// Where it begins, counted from 1.
    pub line: usize,
    /// The word behind the back quotes.
    pub language: String,
    /// What stands between the fences.
    pub text: String,
    /// The file that it stands for.
    pub file: Option<String>,
    args: Vec<String>,
}

/// The fences of a page.
///
/// # Panics
/// When a fence is never closed, or has an attribute that is not known.
pub fn fences(page: &str) -> Vec<Fence> {
    let mut fences = Vec::new();
    let mut lines = page.lines().enumerate();
    while let Some((i, line)) = lines.next() {
        let Some(info) = line.strip_prefix("```") else {
            continue;
        };
        let mut fence = opened(info, i + 1);
        loop {
            let (_, line) = lines.next().unwrap_or_else(|| panic!("line {}: a fence is never closed", i + 1));
            if line == "```" {
                break;
            }
            fence.text.extend([line, "\n"]);
        }
        fences.push(fence);
    }
    fences
}

/// `pcl2 file=NAME args="A B"`
fn opened(info: &str, line: usize) -> Fence {
    let (language, mut rest) = info.split_once(' ').unwrap_or((info, ""));
    let mut fence = Fence { line, language: language.to_owned(), text: String::new(), file: None, args: Vec::new() };
    while let Some((key, value)) = rest.split_once('=') {
        let quoted = value.strip_prefix('"').and_then(|value| value.split_once('"'));
        let (value, behind) = quoted.or_else(|| value.split_once(' ')).unwrap_or((value, ""));
        match key.trim() {
            "file" => fence.file = Some(value.to_owned()),
            "args" => fence.args = value.split_whitespace().map(str::to_owned).collect(),
            other => panic!("line {line}: expected file= or args=, found {other}="),
        }
        rest = behind;
    }
    fence
}

/// The part of a page below a heading of the second level.
pub fn section<'p>(page: &'p str, heading: &str) -> Option<&'p str> {
    let (_, rest) = page.split_once(&format!("\n## {heading}\n"))?;
    Some(rest.split("\n## ").next().unwrap_or(rest))
}

/// The examples of a page, in order.
///
/// # Panics
/// When a file belongs to no example.
pub fn examples(page: &str) -> Vec<Example> {
    let mut examples = Vec::new();
    let mut next = Example::default();
    for fence in fences(page) {
        let name = match (fence.file, fence.language.as_str()) {
            (Some(name), _) => name,
            (None, "toml") => "pcl2.toml".to_owned(),
            (None, "pcl2") => "example.cfg".to_owned(),
            (None, _) => continue,
        };
        let whole = name == "example.cfg";
        next.files.push((name, fence.text));
        next.args.extend(fence.args);
        if whole {
            examples.push(Example { line: fence.line, ..std::mem::take(&mut next) });
        }
    }
    assert!(next.files.is_empty(), "no program follows {:?}", next.files.iter().map(|(name, _)| name));
    examples
}

impl Example {
    /// The text of a file.
    pub fn file(&self, name: &str) -> Option<&str> {
        self.files.iter().find(|(known, _)| known == name).map(|(_, text)| text.as_str())
    }

    /// Its files in a folder of their own.
    ///
    /// # Panics
    /// When they cannot be written.
    pub fn folder(&self) -> TempDir {
        let folder = compilers::folder();
        for (name, text) in &self.files {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().unwrap_or(Path::new("."))).expect("a folder");
            fs::write(path, text).expect("a file");
        }
        folder
    }

    /// A command on it, started in its folder: the messages name files as the page does.
    pub fn command(&self, command: &str, folder: &TempDir) -> Command {
        let mut pcl2 = pcl2();
        let path = if self.file("pcl2.toml").is_some() { "." } else { "example.cfg" };
        pcl2.args([command, path]).args(&self.args).current_dir(folder.path());
        pcl2
    }
}
