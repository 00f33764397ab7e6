//! Parameter files: which ones a source names, and the numbers in them.

use pcl2_lang::ast::{Line, Number, Operand};
use pcl2_lang::lexer::{Lexer, SECTION_WORDS, Token};
use pcl2_lang::source::Sources;
use pcl2_lang::syntax::{Tree, read_real};
use pcl2_lang::types::Real;

/// What the caller found under a file's name.
#[derive(Clone, Debug)]
pub enum FileText {
    /// Its content.
    Bytes(Vec<u8>),
    /// Why it cannot be used: missing, too long, not a regular file, outside the project.
    Unusable(String),
}

/// The strings that a source has for parameters, each once, in order: names of files, and perhaps plain texts.
pub fn wanted_files(tree: &Tree, sources: &Sources) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for line in &tree.lines {
        let Line::Block(statement) = line else {
            continue;
        };
        for place in statement.params() {
            if let Operand::Text(span) = place.value {
                names.push(sources.text(span).to_owned());
            }
        }
    }
    names.sort();
    names.dedup();
    names
}

/// The numbers in a parameter file: white space, commas and `!` comments between them. The content is never quoted.
pub(crate) fn numbers(bytes: &[u8], count: usize) -> Result<Vec<Number>, String> {
    let mut sources = Sources::default();
    let file = sources.add("parameters", bytes.to_vec());
    let text = &sources.file(file).text;
    let mut numbers = Vec::new();
    let mut negative: Option<bool> = None;
    for lexeme in Lexer::new(text, &SECTION_WORDS) {
        let slice = &text[lexeme.start as usize..lexeme.end as usize];
        let line = || sources.file(file).position(lexeme.start).line;
        match lexeme.token {
            Token::Newline | Token::Comma if negative.is_none() => {}
            Token::Plus | Token::Minus if negative.is_none() => negative = Some(lexeme.token == Token::Minus),
            Token::Int | Token::Real => {
                let minus = negative.take().unwrap_or(false);
                let number = number(slice, minus).ok_or_else(|| format!("a number out of range on line {}", line()))?;
                numbers.push(number);
            }
            _ => return Err(format!("something that is no number on line {}", line())),
        }
        if numbers.len() > count {
            return Err(format!("more, from line {} on", line()));
        }
    }
    if negative.is_some() {
        return Err("a sign without a number at its end".to_owned());
    }
    if numbers.len() < count { Err(numbers.len().to_string()) } else { Ok(numbers) }
}

fn number(digits: &str, negative: bool) -> Option<Number> {
    if !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        return read_real(digits, negative).map(Number::Real);
    }
    let value = digits.parse::<i64>().ok().map(|value| if negative { -value } else { value });
    match value.and_then(|value| i32::try_from(value).ok()) {
        Some(value) => Some(Number::Int(value)),
        None => read_real(digits, negative).map(|real: Real| Number::Real(real)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_with_signs_comments_and_an_exact_count() {
        let text = b"! weights \xb0\xa1\n1, -2.5 +3e1\n4";
        let read = numbers(text, 4).unwrap();
        assert_eq!(read[0], Number::Int(1));
        assert_eq!(read[1], Number::Real(Real { wide: -2.5, narrow: -2.5 }));
        assert_eq!(numbers(text, 5).unwrap_err(), "4");
        assert_eq!(numbers(text, 3).unwrap_err(), "more, from line 3 on");
        assert_eq!(numbers(b"root:x", 1).unwrap_err(), "something that is no number on line 1");
        assert!(numbers(b"1 -", 1).is_err());
    }
}
