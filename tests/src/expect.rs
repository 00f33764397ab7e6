//! Expected diagnostics: `! error: P0203` at the end of the offending line.

use crate::cases::Case;
use crate::run;
use serde_json::Value;
use std::fs;

/// A diagnostic's place and code: `main.cfg:4 error P0203`.
pub type Found = String;

/// What a case expects, in order of file and line.
///
/// # Panics
/// When the folder cannot be read.
pub fn expected(case: &Case) -> Vec<Found> {
    let mut found = case.config.diagnostics.clone();
    let mut open = vec![case.folder.clone()];
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(&folder).expect("the case's folder") {
            let path = entry.expect("an entry").path();
            let extension = path.extension().unwrap_or_default().to_string_lossy().into_owned();
            if path.is_dir() {
                open.push(path);
            } else if ["cfg", "fc"].contains(&extension.as_str()) || path.ends_with("pcl2.toml") {
                let name = path.strip_prefix(&case.folder).expect("below").display().to_string();
                let text = String::from_utf8_lossy(&fs::read(&path).expect("a file")).into_owned();
                let mark = if extension == "toml" { "# " } else { "! " };
                comments(&name, &text, mark, &mut found);
            }
        }
    }
    found.sort();
    found
}

fn comments(name: &str, text: &str, mark: &str, found: &mut Vec<Found>) {
    for (i, line) in text.lines().enumerate() {
        for severity in ["error", "warning"] {
            for (at, start) in line.match_indices(&format!("{mark}{severity}: P")) {
                let code = &line[at + start.len() - 1..];
                let code = &code[..code.find(char::is_whitespace).unwrap_or(code.len())];
                found.push(format!("{name}:{} {severity} {code}", i + 1));
            }
        }
    }
}

/// What `check --format json` reports, in order of file and line, and its exit status.
///
/// # Errors
/// When the output is not what DESIGN promises.
pub fn reported(case: &Case, more: &[&str]) -> Result<(Vec<Found>, Option<i32>), String> {
    let output = run(case.command("check").args(["--format", "json"]).args(more));
    let text = String::from_utf8(output.stdout).map_err(|error| error.to_string())?;
    let mut found = Vec::new();
    for line in text.lines() {
        found.push(one(line)?);
    }
    if !output.stderr.is_empty() {
        return Err(format!("standard error is not empty: {}", String::from_utf8_lossy(&output.stderr)));
    }
    found.sort();
    Ok((found, output.status.code()))
}

const KEYS: [&str; 10] =
    ["file", "line", "column", "end_line", "end_column", "severity", "code", "message", "labels", "help"];

fn one(line: &str) -> Result<Found, String> {
    let value: Value = serde_json::from_str(line).map_err(|error| format!("{error}: {line}"))?;
    if KEYS.iter().any(|key| value.get(key).is_none())
        || value.as_object().map(serde_json::Map::len) != Some(KEYS.len())
    {
        return Err(format!("expected the keys {KEYS:?}, found {line}"));
    }
    let text = |key: &str| value[key].as_str().unwrap_or_default().to_owned();
    let file = text("file");
    let file = file.strip_prefix("./").unwrap_or(&file);
    Ok(format!("{file}:{} {} {}", value["line"], text("severity"), text("code")))
}
