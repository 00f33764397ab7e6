//! A copy of the catalogue as blocks of a user's, every function code with another name.

use crate::compilers::files;
use crate::root;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// Stands before every code: taken away, the old names are back.
pub const PREFIX: &str = "qzq";

/// Names of function codes, and of the files that declare them.
#[derive(Clone, Debug, Default)]
pub struct Codes {
    codes: BTreeSet<String>,
    stems: BTreeSet<String>,
}

impl Codes {
    /// Those of the catalogue.
    pub fn new(codes: impl Iterator<Item = (String, String)>) -> Codes {
        let mut all = Codes::default();
        for (code, stem) in codes {
            all.codes.insert(code);
            all.stems.insert(stem);
        }
        all
    }

    /// Writes declarations and kernels with new names into one folder.
    ///
    /// # Panics
    /// When it cannot.
    pub fn write(&self, folder: &Path) {
        fs::create_dir_all(folder).expect("a folder");
        for path in files(&root().join("blocks"), "fc") {
            let text = fs::read_to_string(&path).expect("a declaration");
            fs::write(folder.join(self.file_name(&path)), self.program(&text)).expect("a file");
        }
        let source = root().join("runtime-c/src");
        for path in files(&source, "c").into_iter().chain(files(&source, "h")) {
            let (old, new) = (path.file_name().expect("a name").to_string_lossy(), self.file_name(&path));
            if old != new {
                let text = fs::read_to_string(&path).expect("a kernel");
                fs::write(folder.join(new), self.kernel(&text)).expect("a file");
            }
        }
    }

    /// `first.c`, `msc_inline.h` with the new name in front; other files keep theirs.
    fn file_name(&self, path: &Path) -> String {
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        let stem = name.split('.').next().unwrap_or_default();
        let stem = stem.strip_suffix("_inline").unwrap_or(stem);
        if self.stems.contains(stem) { format!("{PREFIX}{name}") } else { name }
    }

    /// A program or a declaration: every `= code (`, and in expressions every `function(`, has the new name.
    pub fn program(&self, text: &str) -> String {
        replace(text, |before, word, after| {
            let line = before.rsplit('\n').next().unwrap_or_default();
            let in_text = line.matches('"').count() % 2 == 1;
            let in_statement = line.contains('=') && !line.contains('!') && !in_text;
            let called = in_statement && after.trim_start().starts_with('(');
            (called && self.codes.contains(word)).then(|| format!("{PREFIX}{word}"))
        })
    }

    /// A stimulus: every image word `code(..)` has the new name.
    pub fn stimulus(&self, text: &str) -> String {
        replace(text, |_, word, after| {
            (after.starts_with('(') && self.codes.contains(word)).then(|| format!("{PREFIX}{word}"))
        })
    }

    /// A kernel: every symbol and header of a code has the new name.
    fn kernel(&self, text: &str) -> String {
        replace(text, |_, word, _| {
            let name = word.strip_prefix("pcl2_")?;
            let code = ["_init", "_tune", "_check"].iter().find_map(|end| name.strip_suffix(end)).unwrap_or(name);
            let known = self.codes.contains(code) || self.codes.contains(name) || self.stems.contains(name);
            known.then(|| format!("pcl2_{PREFIX}{name}"))
        })
    }
}

/// Replaces words; `new` sees what stands before and after each.
fn replace(text: &str, new: impl Fn(&str, &str, &str) -> Option<String>) -> String {
    let is_word = |letter: char| letter.is_ascii_alphanumeric() || letter == '_';
    let mut out = String::new();
    let mut at = 0;
    while at < text.len() {
        let rest = &text[at..];
        let length = rest.find(|letter| !is_word(letter)).unwrap_or(rest.len());
        let word = &rest[..length];
        match (length > 0).then(|| new(&text[..at], word, &rest[length..])).flatten() {
            Some(other) => out.push_str(&other),
            None => out.push_str(word),
        }
        let other = rest[length..].chars().next();
        out.extend(other);
        at += length + other.map_or(0, char::len_utf8);
    }
    out
}
