//! Text -> blank lines, comments and statements.

use crate::lexer::{Key, Lexeme, Lexer, ReservedWords, Token};
use std::ops::Range;

/// What stands between two line ends outside parentheses.
pub(super) enum Item {
    /// One or more blank lines.
    Blank,
    /// A comment on a line of its own.
    Comment(Comment),
    /// A block, a section word with its rate, or a line of a net; and the comment behind it.
    Line(Vec<Piece>, Option<Comment>),
}

/// A comment, from `!` to the end of its line.
pub(super) struct Comment {
    /// Its bytes.
    pub(super) text: Range<usize>,
    /// It has a line of its own.
    pub(super) own_line: bool,
    /// It has a line of its own, below a comment that stands behind code and begins in the same column: it goes on.
    pub(super) continues: bool,
}

/// A token and what stands before it.
pub(super) struct Piece {
    pub(super) token: Token,
    pub(super) start: usize,
    pub(super) end: usize,
    /// Comments between the token before and this one.
    pub(super) comments: Vec<Comment>,
    /// A new line begins between the token before and this one.
    pub(super) new_line: bool,
}

/// The items before END, END itself as the last, and where the text behind END begins.
pub(super) fn items(text: &str, words: ReservedWords) -> (Vec<Item>, usize) {
    let mut reader = Reader::new(text);
    let mut previous = 0;
    for lexeme in Lexer::new(text, words) {
        reader.gap(previous, lexeme.start as usize);
        previous = lexeme.end as usize;
        if reader.token(lexeme) {
            return (reader.items, previous);
        }
    }
    reader.gap(previous, text.len());
    reader.finish_line();
    (reader.items, text.len())
}

struct Reader<'a> {
    text: &'a str,
    items: Vec<Item>,
    pieces: Vec<Piece>,
    /// Comments since the last token.
    comments: Vec<Comment>,
    new_line: bool,
    depth: u32,
    line_start: usize,
    /// Something stands on the line.
    code: bool,
    /// The column of a comment on the line above that the next one may continue.
    column: Option<usize>,
    next_column: Option<usize>,
}

impl<'a> Reader<'a> {
    fn new(text: &'a str) -> Reader<'a> {
        Reader {
            text,
            items: Vec::new(),
            pieces: Vec::new(),
            comments: Vec::new(),
            new_line: false,
            depth: 0,
            line_start: 0,
            code: false,
            column: None,
            next_column: None,
        }
    }

    /// Reads what the lexer skips: blanks, and at most one comment.
    fn gap(&mut self, start: usize, end: usize) {
        let Some(at) = self.text.get(start..end).and_then(|gap| gap.find('!')) else {
            return;
        };
        let column = start + at - self.line_start;
        let continues = !self.code && self.column == Some(column);
        self.next_column = (self.code || continues).then_some(column);
        self.comments.push(Comment { text: start + at..end, own_line: !self.code, continues });
    }

    /// Takes a token; `true` at END.
    fn token(&mut self, lexeme: Lexeme) -> bool {
        if lexeme.token == Token::Newline {
            self.newline(lexeme.end as usize);
            return false;
        }
        let ends = self.pieces.is_empty() && lexeme.token == Token::Key(Key::End);
        match lexeme.token {
            Token::LeftParen => self.depth += 1,
            Token::RightParen => self.depth = self.depth.saturating_sub(1),
            _ => {}
        }
        self.code = true;
        self.pieces.push(Piece {
            token: lexeme.token,
            start: lexeme.start as usize,
            end: lexeme.end as usize,
            comments: std::mem::take(&mut self.comments),
            new_line: std::mem::take(&mut self.new_line),
        });
        if ends {
            self.finish_line();
        }
        ends
    }

    fn newline(&mut self, line_start: usize) {
        if self.depth == 0 {
            self.finish_line();
        }
        self.new_line = self.depth > 0;
        self.code = false;
        self.line_start = line_start;
        self.column = self.next_column.take();
    }

    fn finish_line(&mut self) {
        let comment = self.comments.pop();
        match (std::mem::take(&mut self.pieces), comment) {
            (pieces, comment) if !pieces.is_empty() => self.items.push(Item::Line(pieces, comment)),
            (_, Some(comment)) => self.items.push(Item::Comment(comment)),
            (_, None) if matches!(self.items.last(), None | Some(Item::Blank)) => {}
            (_, None) => self.items.push(Item::Blank),
        }
    }
}
