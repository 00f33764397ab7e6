//! Source text, places in it, and how places are counted.

use std::sync::OnceLock;

/// An index into [`Sources`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct FileId(pub u32);

/// A run of bytes of one file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Span {
    /// The file.
    pub file: FileId,
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

impl Span {
    /// The span from this one's start to the other's end.
    pub fn to(self, other: Span) -> Span {
        Span { file: self.file, start: self.start, end: other.end.max(self.start) }
    }
}

/// A file's largest size: places are 32-bit.
pub const MAX_FILE: usize = 1 << 30;

/// One source file as the front end sees it.
#[derive(Clone, Debug)]
pub struct SourceFile {
    /// The name shown in messages: as the user gave it.
    pub name: String,
    /// The text; bytes that are not UTF-8 (legal in comments only) stand as [`NOT_TEXT`].
    pub text: String,
    /// The bytes as read, kept only where the text differs from them.
    pub raw: Option<Box<[u8]>>,
    /// A byte order mark stood before it.
    pub marked: bool,
    line_starts: Vec<u32>,
    shown: OnceLock<Option<String>>,
}

/// Stands for each byte that is not UTF-8. It is no legal character outside comments.
pub const NOT_TEXT: char = '\u{1a}';

/// The byte order mark of UTF-8.
pub const MARK: &[u8] = b"\xef\xbb\xbf";

/// All files of one run of the compiler.
#[derive(Clone, Debug, Default)]
pub struct Sources {
    files: Vec<SourceFile>,
}

/// A place as people count it: both from 1, columns in Unicode scalars.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    /// Line.
    pub line: u32,
    /// Column.
    pub column: u32,
}

impl Sources {
    /// Adds a file from its bytes. One UTF-8 byte order mark is skipped.
    pub fn add(&mut self, name: impl Into<String>, bytes: Vec<u8>) -> FileId {
        let id = FileId(self.files.len() as u32);
        self.files.push(SourceFile::new(name.into(), bytes));
        id
    }

    /// A file.
    pub fn file(&self, id: FileId) -> &SourceFile {
        &self.files[id.0 as usize]
    }

    /// The text under a span.
    pub fn text(&self, span: Span) -> &str {
        self.file(span.file).text.get(span.start as usize..span.end as usize).unwrap_or("")
    }

    /// Start and end of a span as people count them.
    pub fn positions(&self, span: Span) -> (Position, Position) {
        let file = self.file(span.file);
        (file.position(span.start), file.position(span.end))
    }
}

impl SourceFile {
    fn new(name: String, mut bytes: Vec<u8>) -> SourceFile {
        let marked = bytes.starts_with(MARK);
        if marked {
            bytes.drain(..MARK.len());
        }
        let (text, raw) = match String::from_utf8(bytes) {
            Ok(text) => (text, None),
            Err(error) => {
                let bytes = error.into_bytes();
                (replace_non_text(&bytes), Some(bytes.into_boxed_slice()))
            }
        };
        let line_starts = line_starts(text.as_bytes());
        SourceFile { name, text, raw, marked, line_starts, shown: OnceLock::new() }
    }

    /// The bytes as read, without a byte order mark.
    pub fn bytes(&self) -> &[u8] {
        self.raw.as_deref().unwrap_or(self.text.as_bytes())
    }

    /// The text for people: what has no shape of its own stands as `?`.
    pub fn shown(&self) -> &str {
        let hidden = |c: char| c.is_ascii_control() && !matches!(c, '\t' | '\r' | '\n');
        let shown = self.shown.get_or_init(|| self.text.contains(hidden).then(|| self.text.replace(hidden, "?")));
        shown.as_deref().unwrap_or(&self.text)
    }

    /// The place of a byte.
    pub fn position(&self, byte: u32) -> Position {
        let byte = byte.min(self.text.len() as u32);
        let line = self.line_starts.partition_point(|start| *start <= byte).max(1);
        let start = self.line_starts.get(line - 1).copied().unwrap_or(0);
        let before = self.text.as_bytes().get(start as usize..byte as usize).unwrap_or(&[]);
        let column = before.iter().filter(|byte| (**byte & 0xc0) != 0x80).count();
        Position { line: line as u32, column: column as u32 + 1 }
    }

    /// The number of lines.
    pub fn lines(&self) -> usize {
        self.line_starts.len()
    }

    /// The byte at which a line (from 1) starts, and one past its end, line end excluded.
    pub fn line_range(&self, line: u32) -> (u32, u32) {
        let index = line.max(1) as usize - 1;
        let start = self.line_starts.get(index).copied().unwrap_or(self.text.len() as u32);
        let end = self.line_starts.get(index + 1).copied().unwrap_or(self.text.len() as u32);
        let line = self.text.get(start as usize..end as usize).unwrap_or("");
        (start, start + line.trim_end_matches(['\n', '\r']).len() as u32)
    }
}

fn replace_non_text(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len());
    for chunk in bytes.utf8_chunks() {
        text.push_str(chunk.valid());
        text.extend(chunk.invalid().iter().map(|_| NOT_TEXT));
    }
    text
}

fn line_starts(bytes: &[u8]) -> Vec<u32> {
    let mut starts = vec![0];
    for (i, byte) in bytes.iter().enumerate() {
        let ends = *byte == b'\n' || (*byte == b'\r' && bytes.get(i + 1) != Some(&b'\n'));
        if ends {
            starts.push(i as u32 + 1);
        }
    }
    starts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_scalars_and_every_line_end() {
        let mut sources = Sources::default();
        let id = sources.add("a.cfg", "\u{feff}a\r\nä b\rc\nd".as_bytes().to_vec());
        let file = sources.file(id);
        assert_eq!(file.lines(), 4);
        let at = |needle: &str| file.position(file.text.find(needle).unwrap() as u32);
        assert_eq!(at("b"), Position { line: 2, column: 3 });
        assert_eq!(at("c"), Position { line: 3, column: 1 });
        assert_eq!(at("d"), Position { line: 4, column: 1 });
    }

    #[test]
    fn bytes_that_are_not_text_keep_their_places() {
        let mut sources = Sources::default();
        let id = sources.add("a.cfg", b"! \xb0\xa1 x\ny".to_vec());
        let file = sources.file(id);
        assert_eq!(file.text.len(), 8);
        assert_eq!(file.raw.as_deref().map(<[u8]>::len), Some(8));
        assert_eq!(file.position(7), Position { line: 2, column: 1 });
    }
}
