//! Every diagnostic has a page, and what the page says is true: the wrong example yields exactly this code and this
//! message, the right one yields nothing.
//!
//! A section's fences are the files of its example: `pcl2` is `example.cfg`, `toml` is `pcl2.toml`, `file=NAME` gives
//! another name, `args=".."` adds to the command line, and a `text` fence without a name is the message.

use pcl2_tests::{none, pcl2, root, run};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Output;

/// The only code without an example: a defect of the compiler.
const NO_EXAMPLE: &str = "P0599";

#[derive(Default)]
struct Example {
    files: Vec<(String, String)>,
    args: Vec<String>,
    message: Option<String>,
}

/// The codes in the table of `codes.rs`.
fn codes() -> Vec<String> {
    let path = root().join("crates/pcl2-lang/src/codes.rs");
    let table = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let row = |line: &str| line.strip_prefix("pub const ")?.split('"').nth(1).map(str::to_owned);
    table.lines().filter_map(row).collect()
}

/// Name and text of the pages.
fn pages() -> Vec<(String, String)> {
    let folder = root().join("docs/errors");
    let entries = fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut paths: Vec<_> = entries.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    let name = |path: &Path| path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    paths.iter().map(|path| (name(path), fs::read_to_string(path).unwrap_or_default())).collect()
}

/// The example below a heading.
fn example(page: &str, heading: &str) -> Option<Example> {
    let (_, section) = page.split_once(&format!("\n## {heading}\n"))?;
    let section = section.split("\n## ").next().unwrap_or(section);
    let mut example = Example::default();
    let mut lines = section.lines();
    while let Some(info) = lines.by_ref().find_map(|line| line.strip_prefix("```")) {
        let body: Vec<&str> = lines.by_ref().take_while(|line| *line != "```").collect();
        example.add(info, body.join("\n") + "\n");
    }
    Some(example)
}

impl Example {
    fn add(&mut self, info: &str, body: String) {
        let name = info.split_whitespace().find_map(|word| word.strip_prefix("file="));
        if let Some((_, args)) = info.split_once("args=\"") {
            self.args.extend(args.trim_end_matches('"').split_whitespace().map(str::to_owned));
        }
        match (name, info.split_whitespace().next()) {
            (Some(name), _) => self.files.push((name.to_owned(), body)),
            (None, Some("pcl2")) => self.files.push(("example.cfg".to_owned(), body)),
            (None, Some("toml")) => self.files.push(("pcl2.toml".to_owned(), body)),
            (None, _) => self.message = Some(body),
        }
    }

    /// Runs `pcl2 check` on the example in a folder of its own.
    fn check(&self, more: &[&str]) -> Output {
        let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
        for (name, body) in &self.files {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().unwrap_or(folder.path())).unwrap_or_else(|error| panic!("{error}"));
            fs::write(&path, body).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        }
        let is_project = self.files.iter().any(|(name, _)| name == "pcl2.toml");
        let path = if is_project { "." } else { "example.cfg" };
        run(pcl2().args(["check", path]).args(&self.args).args(more).current_dir(folder.path()))
    }

    /// The codes that `check --format json` reports.
    fn reported(&self) -> Vec<String> {
        let output = self.check(&["--format", "json"]);
        let text = String::from_utf8_lossy(&output.stdout);
        let code = |line: &str| {
            let object: serde_json::Value = serde_json::from_str(line).unwrap_or_default();
            object["code"].as_str().unwrap_or(line).to_owned()
        };
        text.lines().map(code).collect()
    }
}

fn trimmed(text: &str) -> String {
    let lines: Vec<&str> = text.trim().lines().map(str::trim_end).collect();
    lines.join("\n")
}

fn complaints(code: &str, page: &str) -> Vec<String> {
    let mut complaints = Vec::new();
    if !page.starts_with(&format!("# {code}: ")) {
        complaints.push(format!("{code}: the heading does not start with `# {code}: `"));
    }
    if code == NO_EXAMPLE {
        return complaints;
    }
    let (Some(wrong), Some(right)) = (example(page, "Wrong"), example(page, "Right")) else {
        complaints.push(format!("{code}: needs `## Wrong` and `## Right`"));
        return complaints;
    };
    let found = wrong.reported();
    if found != [code] {
        complaints.push(format!("{code}: the wrong example yields {found:?}"));
    }
    let message = trimmed(&String::from_utf8_lossy(&wrong.check(&[]).stderr));
    if wrong.message.as_deref().map(trimmed) != Some(message.clone()) {
        complaints.push(format!("{code}: the message of the wrong example is\n{message}"));
    }
    let found = right.reported();
    if !found.is_empty() {
        complaints.push(format!("{code}: the right example yields {found:?}"));
    }
    complaints
}

#[test]
fn every_code_has_a_page_and_every_page_a_code() {
    let codes = codes();
    let pages: BTreeSet<String> = pages().into_iter().map(|(name, _)| name).collect();
    assert!(!codes.is_empty());
    assert_eq!(codes.iter().cloned().collect::<BTreeSet<_>>(), pages);
    assert_eq!(codes.len(), pages.len(), "a code stands in the table twice");
}

#[test]
fn examples_yield_what_their_page_says() {
    let complaints: Vec<String> = pages().iter().flat_map(|(code, page)| complaints(code, page)).collect();
    none(&complaints);
}
