//! How large a text may be. The tree of a text takes several times its size, and some of the work on one element grows
//! with the square of what it has, so both are held before a tree is made.

use super::error::PnmlError;
use roxmltree::TextPos;

/// The longest text.
const BYTES: usize = 64 << 20;
/// Tags, comments and the like: what begins with `<`.
const TAGS: usize = 1_500_000;
/// Attributes of all elements.
const ATTRIBUTES: usize = 1_500_000;
/// Attributes of one element.
const ATTRIBUTES_OF_ONE: usize = 64;
/// Declarations of name-space prefixes.
const PREFIXES: usize = 16;

/// Text between two of these is of no interest.
const SKIPPED: [(&str, &str); 3] = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>")];

/// Checks a text.
pub(super) fn check(text: &str) -> Result<(), PnmlError> {
    if text.len() > BYTES {
        return Err(too_large(text, 0, format!("at most {} MiB", BYTES >> 20), format!("{} MiB", text.len() >> 20)));
    }
    let mut counts = Counts::default();
    let mut at = 0;
    while let Some(next) = text[at..].find('<') {
        at += next;
        counts.tags += 1;
        let end = match SKIPPED.iter().find(|(start, _)| text[at..].starts_with(start)) {
            Some((_, end)) => text[at..].find(end).map(|length| at + length + end.len()),
            None => counts.tag(text, at)?,
        };
        counts.check(text, at)?;
        let Some(end) = end else { break };
        at = end;
    }
    Ok(())
}

#[derive(Default)]
struct Counts {
    tags: usize,
    attributes: usize,
    prefixes: usize,
}

impl Counts {
    /// Counts the attributes of the tag that begins here; where it ends.
    fn tag(&mut self, text: &str, start: usize) -> Result<Option<usize>, PnmlError> {
        let bytes = text.as_bytes();
        let (mut at, mut mine) = (start + 1, 0);
        while let Some(byte) = bytes.get(at) {
            match byte {
                b'>' => return Ok(Some(at + 1)),
                b'<' => return Ok(Some(at)),
                b'"' | b'\'' => {
                    mine += 1;
                    self.attributes += 1;
                    self.prefixes += usize::from(declares_prefix(&bytes[start..at]));
                    if mine > ATTRIBUTES_OF_ONE {
                        let most = format!("at most {ATTRIBUTES_OF_ONE} attributes in an element");
                        return Err(too_large(text, start, most, "more".to_owned()));
                    }
                    let rest = bytes[at + 1..].iter().position(|other| other == byte);
                    let Some(length) = rest else { return Ok(None) };
                    at += length + 2;
                }
                _ => at += 1,
            }
        }
        Ok(None)
    }

    fn check(&self, text: &str, at: usize) -> Result<(), PnmlError> {
        let most = [
            (self.tags, TAGS, "tags"),
            (self.attributes, ATTRIBUTES, "attributes"),
            (self.prefixes, PREFIXES, "name-space prefixes"),
        ];
        match most.iter().find(|(count, most, _)| count > most) {
            Some((_, most, what)) => Err(too_large(text, at, format!("at most {most} {what}"), "more".to_owned())),
            None => Ok(()),
        }
    }
}

/// Whether a tag, up to a value, ends in `xmlns:prefix =`.
fn declares_prefix(tag: &[u8]) -> bool {
    let blank = |byte: &u8| byte.is_ascii_whitespace() || *byte == b'=';
    let end = tag.iter().rposition(|byte| !blank(byte)).map_or(0, |last| last + 1);
    let start = tag[..end].iter().rposition(blank).map_or(0, |before| before + 1);
    tag[start..end].starts_with(b"xmlns:")
}

fn too_large(text: &str, at: usize, expected: String, found: String) -> PnmlError {
    let before = &text[..at];
    let line = before.matches('\n').count() + 1;
    let column = before.chars().rev().take_while(|letter| *letter != '\n').count() + 1;
    let short = |number: usize| u32::try_from(number).unwrap_or(u32::MAX);
    let at = TextPos { row: short(line), col: short(column) };
    PnmlError::new(at, format!("expected {expected}, found {found}"), "leave out graphics, or divide the net")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ordinary_text_passes_and_large_text_is_told_by_its_place() {
        assert_eq!(check("<?xml a='='?><!-- <a b='c'> --><a b=\"'>\" c='\"'><![CDATA[<d e='f'>]]></a>"), Ok(()));
        let wide = format!("<a>\n<b {}/></a>", "x='1' ".repeat(65));
        let error = check(&wide).unwrap_err();
        assert_eq!((error.line, error.column), (2, 1));
        let prefixes: String = (0..17).map(|i| format!("<a xmlns:p{i} = 'u'/>")).collect();
        assert!(check(&prefixes).unwrap_err().message.contains("prefixes"));
        assert!(check(&"<a b='1'/>".repeat(1_500_001)).unwrap_err().message.contains("tags"));
    }
}
