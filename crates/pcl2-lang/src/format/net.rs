//! Items of a net -> lines. The `:` of gates that follow one another stand below each other, and so do the first
//! clauses behind their arcs.

use super::read::{Item, Piece};
use super::space::{around, call};
use super::write::{Body, Row, align, breaks, line_end, outputs};
use crate::lexer::{Key, Token};
use crate::source::SourceFile;

/// Names and arcs that are longer do not move those of other gates.
const WIDEST_COLUMN: usize = 32;

/// Blanks before the first clause of a gate.
const BEFORE_CLAUSE: usize = 2;

/// Writes items up to END, whose line end is left to what follows it.
pub(super) fn write(items: &[Item], source: &SourceFile) -> Vec<u8> {
    let mut writer = Writer { text: &source.text, rows: Vec::new() };
    let mut columns = Columns::default();
    let mut is_head = true;
    for (i, item) in items.iter().enumerate() {
        match item {
            Item::Blank => writer.rows.push(Row { ends_run: true, ..Row::default() }),
            Item::Comment(comment) => writer.rows.push(Row::of_comment(comment)),
            Item::Line(pieces, comment) => {
                if i == 0 || !continues(&items[i - 1]) {
                    columns = Columns::of(&items[i..], &source.text);
                }
                let (head, first) = match (std::mem::take(&mut is_head), is_gate(pieces)) {
                    (true, _) => writer.declared(pieces),
                    (false, true) => writer.gate(pieces, &columns),
                    (false, false) => writer.word(pieces),
                };
                writer.line(pieces, comment.as_ref(), &head, first);
            }
        }
    }
    align(&writer.rows, source.bytes(), line_end(&source.text))
}

fn is_gate(pieces: &[Piece]) -> bool {
    first_key(pieces) == Some(Key::Gate)
}

fn first_key(pieces: &[Piece]) -> Option<Key> {
    match pieces.first()?.token {
        Token::Key(key) => Some(key),
        _ => None,
    }
}

/// Gates and what stands below them are a run.
fn continues(item: &Item) -> bool {
    match item {
        Item::Line(pieces, _) => {
            matches!(first_key(pieces), Some(Key::Gate | Key::If | Key::Else | Key::Then | Key::Do))
        }
        Item::Comment(comment) => comment.continues,
        Item::Blank => false,
    }
}

/// Where the parts of a run of gates stand.
#[derive(Default)]
struct Columns {
    name: usize,
    arcs: usize,
}

impl Columns {
    fn of(items: &[Item], text: &str) -> Columns {
        let mut columns = Columns::default();
        for item in items.iter().take_while(|item| continues(item)) {
            let Item::Line(pieces, _) = item else {
                continue;
            };
            if let Some(parts) = GateParts::of(pieces, text) {
                if parts.name.len() <= WIDEST_COLUMN {
                    columns.name = columns.name.max(parts.name.len());
                }
                if parts.clause < pieces.len() && parts.arcs.len() <= WIDEST_COLUMN {
                    columns.arcs = columns.arcs.max(parts.arcs.len());
                }
            }
        }
        columns
    }
}

/// `GATE name`, `: before -> after`, and where the first clause begins.
struct GateParts {
    name: String,
    arcs: String,
    clause: usize,
}

impl GateParts {
    fn of(pieces: &[Piece], text: &str) -> Option<GateParts> {
        if !is_gate(pieces) {
            return None;
        }
        let colon = pieces.iter().position(|piece| piece.token == Token::Colon)?;
        let behind = pieces[colon..].iter().position(|piece| matches!(piece.token, Token::Key(_)));
        let clause = behind.map_or(pieces.len(), |behind| colon + behind);
        let (name, arcs) = (joined(&pieces[..colon], text), joined(&pieces[colon..clause], text));
        Some(GateParts { name, arcs, clause })
    }
}

/// Tokens outside parentheses with their blanks.
fn joined(pieces: &[Piece], text: &str) -> String {
    let mut joined = String::new();
    for (piece, around) in pieces.iter().zip(around(pieces, &[])) {
        joined.extend([if around.blank { " " } else { "" }, &text[piece.start..piece.end]]);
    }
    joined
}

/// The parentheses that open lists: those with a `:` in them, of a class, of a token.
fn lists(pieces: &[Piece]) -> Vec<usize> {
    let opens = |i: &usize| {
        let before = |back: usize| i.checked_sub(back).map(|at| pieces[at].token);
        let declares = before(1) == Some(Token::Key(Key::Marked)) || before(2) == Some(Token::Key(Key::Class));
        pieces[*i].token == Token::LeftParen && (declares || has_colon(&pieces[*i..]))
    };
    (0..pieces.len()).filter(opens).collect()
}

/// Whether a `:` stands in a pair of parentheses, outside those in it.
fn has_colon(pieces: &[Piece]) -> bool {
    let mut depth = 0_u32;
    for piece in pieces {
        match piece.token {
            Token::LeftParen => depth += 1,
            Token::RightParen => depth = depth.saturating_sub(1),
            Token::Colon if depth == 1 => return true,
            _ => {}
        }
        if depth == 0 {
            return false;
        }
    }
    false
}

struct Writer<'a> {
    text: &'a str,
    rows: Vec<Row>,
}

impl Writer<'_> {
    /// What stands before the `=` of a head, or the `=` itself.
    fn declared(&self, pieces: &[Piece]) -> (String, usize) {
        let outputs = outputs(pieces, self.text);
        match pieces.iter().position(|piece| piece.token == Token::Equals) {
            Some(equals) if equals > 0 => (outputs, equals),
            Some(_) | None => self.word(pieces),
        }
    }

    /// The first word of a line.
    fn word(&self, pieces: &[Piece]) -> (String, usize) {
        (pieces.first().map_or(String::new(), |piece| self.text[piece.start..piece.end].to_owned()), 1)
    }

    /// A gate up to its first clause.
    fn gate(&self, pieces: &[Piece], columns: &Columns) -> (String, usize) {
        let Some(parts) = GateParts::of(pieces, self.text) else {
            return self.word(pieces);
        };
        let (name, arcs) = (columns.name, columns.arcs);
        let mut head = format!("{:name$} {}", parts.name, parts.arcs);
        if parts.clause < pieces.len() {
            head = format!("{:name$} {:arcs$}", parts.name, parts.arcs);
            head.push_str(&" ".repeat(BEFORE_CLAUSE - 1));
        }
        (head, parts.clause)
    }

    /// A line whose first tokens stand in its head already.
    fn line(&mut self, pieces: &[Piece], comment: Option<&super::read::Comment>, head: &str, first: usize) {
        let lists = call(pieces).into_iter().chain(lists(pieces)).collect::<Vec<_>>();
        let around = around(pieces, &lists);
        let breaks = breaks(pieces, &around);
        if first >= pieces.len() {
            let comment = comment.map(|comment| (comment.text.clone(), false));
            self.rows.push(Row { text: head.to_owned(), comment, ..Row::default() });
            return;
        }
        let body = Body { text: self.text, pieces: &pieces[first..], around: &around[first..], head };
        self.rows.append(&mut body.laid_out(breaks[first..].to_vec(), comment));
    }
}
