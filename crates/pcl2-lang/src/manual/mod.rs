//! The manual: what a declaration says, as pages for the terminal and as one document.

mod facts;
mod markdown;
mod terminal;
mod words;

pub use facts::{HEADS, Row, Table, signature, tables};
pub use markdown::document;
pub use terminal::page;
pub use words::{range, value_text};

use crate::decl::Decl;

/// The first sentence of the comment.
pub fn summary(decl: &Decl) -> String {
    let joined = first_paragraph(&decl.doc);
    match end_of_sentence(&joined) {
        Some(end) => joined[..end].to_owned(),
        None => joined,
    }
}

/// What the comment says behind its first sentence, line by line.
fn explanation(decl: &Decl) -> String {
    let summary = summary(decl);
    let mut rest = decl.doc.as_str();
    for word in summary.split_whitespace() {
        rest = rest.trim_start().strip_prefix(word).unwrap_or(rest);
    }
    rest.trim().to_owned()
}

fn first_paragraph(doc: &str) -> String {
    doc.lines().take_while(|line| !line.trim().is_empty()).map(str::trim).collect::<Vec<_>>().join(" ")
}

/// Words that end in a dot and end no sentence.
const SHORT: [&str; 8] = ["g", "e", "cf", "ch", "no", "vol", "pp", "eq"];

/// One past the dot that ends a sentence: not that of an initial, of a number or of a short form.
fn end_of_sentence(text: &str) -> Option<usize> {
    let ends = |at: usize| {
        let start = text[..at].rfind(|c: char| !c.is_alphanumeric()).map_or(0, |before| before + 1);
        let word = &text[start..at];
        let initial = word.len() == 1 && word.bytes().all(|byte| byte.is_ascii_uppercase());
        let form = SHORT.contains(&word) && (word.len() > 1 || text[..start].ends_with('.'));
        let closed = !word.is_empty() || text[..at].ends_with([')', ']', '%', '\'', '`']);
        closed && !initial && !form && text[at + 2..].chars().next().is_some_and(|c| !c.is_ascii_digit())
    };
    text.match_indices(". ").map(|(at, _)| at).find(|at| ends(*at)).map(|at| at + 1)
}

#[cfg(test)]
mod tests {
    use super::end_of_sentence;

    #[test]
    fn a_sentence_ends_at_its_dot() {
        assert_eq!(end_of_sentence("A lag. It waits."), Some(6));
        assert_eq!(end_of_sentence("From A. Smith, ch. 3. 4, e.g. all. More"), Some(34));
        assert_eq!(end_of_sentence("Sum: y = a + b. A bad one"), Some(15));
        assert_eq!(end_of_sentence("From (a1 .. an) up (x). So"), Some(23));
        assert_eq!(end_of_sentence("A lag b/(s + a)."), None);
    }
}
