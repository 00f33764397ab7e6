//! The canonical layout of `.cfg` and `.net` files: text to text. Blanks and line breaks change, nothing else.

mod net;
mod read;
mod space;
mod write;

use crate::lexer::{Key, Lexer, NET_WORDS, ReservedWords, SECTION_WORDS, Token};
use crate::source::SourceFile;
use read::Item;

/// The width that lines are broken at.
pub const WIDTH: usize = 100;

/// A source in its canonical layout, without a byte order mark. `None`: the result would not read as the source does,
/// which happens only to a source with mistakes.
pub fn format(source: &SourceFile) -> Option<Vec<u8>> {
    laid_out(source, &SECTION_WORDS, write::write)
}

/// The same for a net.
pub fn format_net(source: &SourceFile) -> Option<Vec<u8>> {
    laid_out(source, &NET_WORDS, net::write)
}

fn laid_out(source: &SourceFile, words: ReservedWords, write: fn(&[Item], &SourceFile) -> Vec<u8>) -> Option<Vec<u8>> {
    let (items, end) = read::items(&source.text, words);
    let bytes = source.bytes();
    let mut formatted = write(&items, source);
    let body = String::from_utf8_lossy(&formatted).into_owned();
    if outline(&body, words) != outline(&source.text, words) {
        return None;
    }
    formatted.extend_from_slice(bytes.get(end..)?);
    Some(formatted)
}

/// The tokens up to END, a newline for each run of them that ends a line.
fn outline(text: &str, words: ReservedWords) -> Vec<(Token, &str)> {
    let mut outline: Vec<(Token, &str)> = Vec::new();
    let mut depth = 0_u32;
    for lexeme in Lexer::new(text, words) {
        match lexeme.token {
            Token::Newline if depth > 0 || outline.last().is_none_or(|last| last.0 == Token::Newline) => continue,
            Token::LeftParen => depth += 1,
            Token::RightParen => depth = depth.saturating_sub(1),
            _ => {}
        }
        let text = if lexeme.token == Token::Newline { "" } else { &text[lexeme.start as usize..lexeme.end as usize] };
        outline.push((lexeme.token, text));
        if lexeme.token == Token::Key(Key::End) {
            break;
        }
    }
    outline
}

#[cfg(test)]
mod tests;
