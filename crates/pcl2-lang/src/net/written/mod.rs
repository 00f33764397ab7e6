//! A net as its author wrote it: what pictures and reports show beside what the compiler knows.

mod turn;
mod words;

pub use words::weighted;

use super::Net;
use crate::ast::Statement;
use crate::catalogue::Catalogue;
use crate::decl::Decl;
use crate::source::{Sources, Span};

/// A net and those inside it, each once.
#[derive(Clone, Debug)]
pub struct Written<'a> {
    /// The net itself comes first.
    pub nets: Vec<WrittenNet<'a>>,
}

/// A net with its texts.
#[derive(Clone, Debug)]
pub struct WrittenNet<'a> {
    /// Its head.
    pub decl: &'a Decl,
    /// Its boxes and gates.
    pub net: &'a Net,
    /// Its statements as written, each on one line, with numbers for the counters of FOR.
    pub statements: Vec<String>,
    /// By box: the word that its line begins with.
    pub words: Vec<String>,
    /// By part: the net behind it, an index into [`Written::nets`].
    pub parts: Vec<usize>,
}

/// Reads the texts of a net. `None`: it is no net, or a part of it is none.
pub fn read<'a>(decl: &'a Decl, sources: &Sources, catalogue: &'a Catalogue) -> Option<Written<'a>> {
    let mut nets: Vec<WrittenNet<'a>> = vec![texts(decl, sources)?];
    let mut next = 0;
    while next < nets.len() {
        for part in &nets[next].net.parts {
            let statement = decl_body(nets[next].decl).get(part.statement.0 as usize)?;
            let code = sources.text(statement.code.span);
            let found = nets.iter().position(|known| known.decl.name == code);
            let index = found.unwrap_or(nets.len());
            if found.is_none() {
                nets.push(texts(catalogue.find(code)?, sources)?);
            }
            nets[next].parts.push(index);
        }
        next += 1;
    }
    Some(Written { nets })
}

fn decl_body(decl: &Decl) -> &[Statement] {
    decl.body.as_deref().unwrap_or(&[])
}

fn texts<'a>(decl: &'a Decl, sources: &Sources) -> Option<WrittenNet<'a>> {
    let net = decl.net.as_deref()?;
    let line = |span: Span| one_line(sources.text(span));
    let word = |span: Span| line(span).split(' ').next().unwrap_or_default().to_owned();
    let statement = |statement: &Statement| turn::counted(line(statement.span), &statement.counters, sources);
    Some(WrittenNet {
        decl,
        net,
        statements: decl_body(decl).iter().map(statement).collect(),
        words: net.boxes.iter().map(|place| word(place.span)).collect(),
        parts: Vec::new(),
    })
}

/// A text without comments and line ends.
fn one_line(text: &str) -> String {
    let code = text.lines().map(|line| {
        let mut quoted = false;
        let comment = line.char_indices().find(|(_, letter)| {
            quoted ^= *letter == '"';
            *letter == '!' && !quoted
        });
        comment.map_or(line, |(at, _)| &line[..at])
    });
    code.flat_map(str::split_whitespace).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::one_line;

    #[test]
    fn a_statement_stands_on_one_line() {
        assert_eq!(one_line("y = f ( a, ! the \"first\"\r\n\t  \"b ! c\" : )"), "y = f ( a, \"b ! c\" : )");
    }
}
