//! Pieces of C text: literals, comments, strings.

use pcl2_lang::types::{Real, Scalar, Value, Width};
use std::fmt::Write;

/// The longest comment over a call; statements with many numbers are cut.
const MAX_COMMENT: usize = 160;

/// A real literal in shortest round-trip form.
pub(crate) fn real(out: &mut String, value: Real, width: Width) {
    if value.wide.is_nan() {
        out.push_str("PCL2_BAD");
        return;
    }
    number_text(out, value, width);
    if width == Width::F32 {
        out.push('f');
    }
}

/// A real as the shortest decimal that reads back in its width, with a dot or an exponent.
pub(crate) fn number_text(out: &mut String, value: Real, width: Width) {
    let mut buffer = zmij::Buffer::new();
    out.push_str(match width {
        Width::F64 => buffer.format(value.wide),
        Width::F32 => buffer.format(value.narrow),
    });
}

/// An int literal; C has no literal for the smallest.
pub(crate) fn int(out: &mut String, value: i32) {
    if value == i32::MIN {
        out.push_str("(-2147483647 - 1)");
    } else {
        let _ = write!(out, "{value}");
    }
}

/// One element of a value. A single value stands for each element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Number {
    /// An int.
    Int(i32),
    /// A real.
    Real(Real),
}

impl Number {
    /// Whether all bits are zero, so that nothing needs to be written.
    pub(crate) fn is_zero(self) -> bool {
        match self {
            Number::Int(value) => value == 0,
            Number::Real(value) => value.wide.to_bits() == 0 && value.narrow.to_bits() == 0,
        }
    }
}

/// An element of a value.
pub(crate) fn number(value: &Value, element: usize) -> Number {
    match value {
        Value::Int(value) => Number::Int(*value),
        Value::Real(value) => Number::Real(*value),
        Value::Ints(values) => Number::Int(values.get(element).copied().unwrap_or(0)),
        Value::Reals(values) => Number::Real(values.get(element).copied().unwrap_or(Real::ZERO)),
        Value::Text(_) => Number::Int(0),
    }
}

/// An element of a value as a literal of the type of its place.
pub(crate) fn element(out: &mut String, value: &Value, element: usize, scalar: Scalar, width: Width) {
    match (number(value, element), scalar) {
        (Number::Int(value), Scalar::Int) => int(out, value),
        (Number::Int(value), Scalar::Real) => real(out, Real::from_int(value), width),
        (Number::Real(value), Scalar::Real) => real(out, value, width),
        (Number::Real(value), Scalar::Int) => int(out, value.wide as i32),
    }
}

/// The elements of a value, separated by commas, eight to a line.
pub(crate) fn elements(out: &mut String, value: &Value, count: usize, scalar: Scalar, width: Width) {
    for i in 0..count {
        match i {
            0 => {}
            _ if i % 8 == 0 => out.push_str(",\n    "),
            _ => out.push_str(", "),
        }
        element(out, value, i, scalar, width);
    }
}

/// A number of something, without the formatting machinery.
pub(crate) fn count(out: &mut String, value: usize) {
    let mut digits = [0_u8; 20];
    let mut first = digits.len();
    let mut rest = value;
    loop {
        first -= 1;
        digits[first] = b'0' + (rest % 10) as u8;
        rest /= 10;
        if rest == 0 {
            break;
        }
    }
    out.push_str(std::str::from_utf8(&digits[first..]).unwrap_or_default());
}

/// A string literal.
pub(crate) fn string(out: &mut String, text: &str) {
    out.push('"');
    if text.bytes().all(|byte| matches!(byte, b' '..=b'~') && !matches!(byte, b'"' | b'\\' | b'?')) {
        out.push_str(text);
        out.push('"');
        return;
    }
    for byte in text.bytes() {
        match byte {
            b'"' | b'\\' | b'?' => {
                out.push('\\');
                out.push(char::from(byte));
            }
            b' '..=b'~' => out.push(char::from(byte)),
            _ => {
                let _ = write!(out, "\\{byte:03o}");
            }
        }
    }
    out.push('"');
}

/// A statement as a comment line: its own comments and line breaks become one blank, nothing in it ends the comment.
pub(crate) fn comment(out: &mut String, indent: &str, statement: &str) {
    out.push_str(indent);
    out.push_str("/* ");
    let start = out.len();
    fold(out, statement);
    let end = out.trim_end_matches([' ', '\\']).len();
    out.truncate(end.max(start));
    out.push_str(" */\n");
}

fn fold(out: &mut String, statement: &str) {
    let start = out.len();
    let plain = plain_length(statement.as_bytes());
    let kept = if plain == statement.len() { plain } else { plain.saturating_sub(1) };
    if kept > 0 && plain <= MAX_COMMENT {
        out.push_str(&statement[..kept]);
        fold_rest(out, start, &statement[kept..]);
    } else {
        fold_rest(out, start, statement);
    }
}

/// How far a statement can be taken as it is.
fn plain_length(bytes: &[u8]) -> usize {
    let mut last = b' ';
    for (i, byte) in bytes.iter().enumerate() {
        let plain =
            matches!(byte, b'#'..=b'~' | b' ') && !matches!((last, *byte), (b' ', b' ') | (_, b'*' | b'/' | b'?'));
        if !plain {
            return i;
        }
        last = *byte;
    }
    bytes.len()
}

fn fold_rest(out: &mut String, start: usize, statement: &str) {
    let mut quoted = false;
    let mut skipping = false;
    let mut last = out[start..].bytes().next_back().unwrap_or(b' ');
    for byte in statement.bytes() {
        if out.len() - start >= MAX_COMMENT {
            out.push_str(" ..");
            return;
        }
        let line_end = byte == b'\n' || byte == b'\r';
        quoted = (quoted ^ (byte == b'"' && !skipping)) && !line_end;
        skipping = (skipping || (byte == b'!' && !quoted)) && !line_end;
        let shown = if skipping { b' ' } else { shown(byte) };
        let splits =
            (last == b'*' && shown == b'/') || (last == b'/' && shown == b'*') || (last == b'?' && shown == b'?');
        if splits {
            out.push(' ');
        }
        if shown != b' ' || last != b' ' {
            out.push(char::from(shown));
        }
        last = shown;
    }
}

fn shown(byte: u8) -> u8 {
    match byte {
        b'!'..=b'~' => byte,
        0x80.. => b'?',
        _ => b' ',
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folded(text: &str) -> String {
        let mut out = String::new();
        comment(&mut out, "", text);
        out
    }

    #[test]
    fn comments_are_neutral() {
        assert_eq!(folded("1 y = f ( a, ! in */ here\n  b\t: 1. )"), "/* 1 y = f ( a, b : 1. ) */\n");
        assert_eq!(folded("f ( \"a*/b/*c??/!\" : ) \\"), "/* f ( \"a* /b/ *c? ?/!\" : ) */\n");
        assert_eq!(folded(&"1., ".repeat(100)).len(), 160 + 3 + 3 + 4);
    }

    #[test]
    fn literals_read_back() {
        let mut out = String::new();
        for value in [0.1, 1e22, -0.0, 5e-324, 100.0, 1e16] {
            real(&mut out, Real { wide: value, narrow: value as f32 }, Width::F64);
            out.push(' ');
        }
        real(&mut out, Real { wide: 0.1, narrow: 0.1 }, Width::F32);
        int(&mut out, i32::MIN);
        assert_eq!(out, "0.1 1e+22 -0.0 5e-324 100.0 1e+16 0.1f(-2147483647 - 1)");
    }

    #[test]
    fn strings_are_escaped() {
        let mut out = String::new();
        string(&mut out, "a\"\\??=\né");
        assert_eq!(out, "\"a\\\"\\\\\\?\\?=\\012\\303\\251\"");
    }
}
