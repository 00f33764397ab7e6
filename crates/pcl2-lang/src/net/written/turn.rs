//! Statements of repeated lines: the counters of FOR stand in indexes, each with its value in this turn.

use crate::ast::Name;
use crate::lexer::{Lexeme, Lexer, NET_WORDS, Token};
use crate::source::Sources;

/// A statement with the values of its counters: `call[2]` for `call[i]`.
pub(super) fn counted(text: String, counters: &[(Name, i32)], sources: &Sources) -> String {
    if counters.is_empty() {
        return text;
    }
    let counters: Vec<(&str, i32)> = counters.iter().map(|(name, value)| (sources.text(name.span), *value)).collect();
    replaced(&text, &counters)
}

fn replaced(text: &str, counters: &[(&str, i32)]) -> String {
    let lexemes: Vec<Lexeme> = Lexer::new(text, &NET_WORDS).collect();
    let written = |lexeme: &Lexeme| &text[lexeme.start as usize..lexeme.end as usize];
    let (mut shown, mut next, mut inside) = (String::new(), 0, false);
    for (i, lexeme) in lexemes.iter().enumerate() {
        match lexeme.token {
            Token::LeftBracket => inside = true,
            Token::RightBracket => inside = false,
            _ => {}
        }
        let counter = counters.iter().rev().find(|(name, _)| inside && *name == written(lexeme));
        let Some((_, value)) = counter else {
            continue;
        };
        let more = lexemes.get(i + 2).and_then(|more| written(more).parse::<i64>().ok()).unwrap_or(0);
        let (more, last) = match lexemes.get(i + 1).map(|sign| sign.token) {
            Some(Token::Plus) => (more, i + 2),
            Some(Token::Minus) => (-more, i + 2),
            Some(_) | None => (0, i),
        };
        shown.push_str(&text[next..lexeme.start as usize]);
        shown.push_str(&(i64::from(*value) + more).to_string());
        next = lexemes.get(last).map_or(text.len(), |last| last.end as usize);
    }
    shown.push_str(&text[next..]);
    shown
}

#[cfg(test)]
mod tests {
    use super::replaced;

    #[test]
    fn counters_in_indexes_have_their_values() {
        let shown = replaced("i = m[i+1,j] + call[i - 1] * V[ k ].x", &[("i", 1), ("j", 7), ("i", 4)]);
        assert_eq!(shown, "i = m[5,7] + call[3] * V[ k ].x");
    }
}
