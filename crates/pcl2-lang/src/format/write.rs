//! Items -> lines.

use super::WIDTH;
use super::read::{Comment, Item, Piece};
use super::space::{Around, around, call};
use crate::lexer::Token;
use crate::source::SourceFile;
use std::ops::Range;

/// Output lists that are longer do not move the `=` of other lines.
const WIDEST_OUTPUTS: usize = 32;
/// Lines that are longer do not move the comments of other lines.
const WIDEST_COMMENTED: usize = 72;
/// Lists that begin further right go on below the start of the statement.
const WIDEST_START: usize = 80;
const HANGING: usize = 4;
/// Blanks before an aligned comment.
const BEFORE_COMMENT: usize = 2;

/// A line in the making.
#[derive(Default)]
pub(super) struct Row {
    pub(super) text: String,
    /// The bytes of the comment behind it, and whether it goes on with the one above.
    pub(super) comment: Option<(Range<usize>, bool)>,
    /// Rows before and behind are not aligned with each other.
    pub(super) ends_run: bool,
    /// The row and those above it are not aligned with each other.
    pub(super) begins_run: bool,
}

impl Row {
    /// A comment on a line of its own.
    pub(super) fn of_comment(comment: &Comment) -> Row {
        let ends_run = !comment.continues;
        let comment = Some((comment.text.clone(), comment.continues));
        Row { text: String::new(), comment, ends_run, begins_run: false }
    }
}

/// Writes items up to END, whose line end is left to what follows it.
pub(super) fn write(items: &[Item], source: &SourceFile) -> Vec<u8> {
    let mut writer = Writer { text: &source.text, rows: Vec::new() };
    let mut digits = 0;
    let mut equals = 0;
    for (i, item) in items.iter().enumerate() {
        match item {
            Item::Blank => writer.rows.push(Row { ends_run: true, ..Row::default() }),
            Item::Comment(comment) => writer.comment(comment),
            Item::Line(pieces, comment) if is_section(pieces) => {
                digits = widest_number(&items[i + 1..]);
                writer.section(pieces, comment.as_ref());
            }
            Item::Line(pieces, comment) => {
                if i == 0 || ends_run(&items[i - 1]) {
                    equals = place_of_equals(&items[i..], digits, &source.text);
                }
                writer.statement(pieces, comment.as_ref(), digits, equals);
            }
        }
    }
    align(&writer.rows, source.bytes(), line_end(&source.text))
}

fn is_section(pieces: &[Piece]) -> bool {
    pieces.first().is_some_and(|piece| matches!(piece.token, Token::Key(_)))
}

/// Blank lines, comments on their own and sections end the run of lines that are aligned with each other.
fn ends_run(item: &Item) -> bool {
    match item {
        Item::Blank => true,
        Item::Comment(comment) => !comment.continues,
        Item::Line(pieces, _) => is_section(pieces),
    }
}

/// The ending of the first line stands for all.
pub(super) fn line_end(text: &str) -> &'static str {
    match text.find(['\r', '\n']) {
        Some(at) if text[at..].starts_with("\r\n") => "\r\n",
        Some(at) if text[at..].starts_with('\r') => "\r",
        Some(_) | None => "\n",
    }
}

/// The most digits of a number in the section that begins here.
fn widest_number(items: &[Item]) -> usize {
    let lines = items.iter().filter_map(|item| match item {
        Item::Line(pieces, _) => Some(pieces),
        Item::Blank | Item::Comment(_) => None,
    });
    let numbers = lines.take_while(|pieces| !is_section(pieces)).filter_map(|pieces| number(pieces));
    numbers.map(|piece| piece.end - piece.start).max().unwrap_or(0)
}

fn number(pieces: &[Piece]) -> Option<&Piece> {
    pieces.first().filter(|piece| piece.token == Token::Int)
}

/// The column of the `=` in the run that begins here.
fn place_of_equals(items: &[Item], digits: usize, text: &str) -> usize {
    let run = items.iter().take_while(|item| !ends_run(item));
    let widths = run.filter_map(|item| match item {
        Item::Line(pieces, _) => Some(outputs(pieces, text)),
        Item::Blank | Item::Comment(_) => None,
    });
    let indent = |outputs: String| if outputs.is_empty() { digits } else { start_of_outputs(digits) + outputs.len() };
    widths.filter(|outputs| outputs.len() <= WIDEST_OUTPUTS).map(indent).max().unwrap_or(0)
}

fn start_of_outputs(digits: usize) -> usize {
    if digits == 0 { 0 } else { digits + 1 }
}

/// `a, b`
pub(super) fn outputs(pieces: &[Piece], text: &str) -> String {
    let mut outputs = String::new();
    let skip = usize::from(number(pieces).is_some());
    for piece in pieces.iter().skip(skip).take_while(|piece| piece.token != Token::Equals) {
        let blank = !outputs.is_empty() && piece.token != Token::Comma;
        outputs.extend([if blank { " " } else { "" }, &text[piece.start..piece.end]]);
    }
    outputs
}

struct Writer<'a> {
    text: &'a str,
    rows: Vec<Row>,
}

impl Writer<'_> {
    fn comment(&mut self, comment: &Comment) {
        self.rows.push(Row::of_comment(comment));
    }

    fn section(&mut self, pieces: &[Piece], comment: Option<&Comment>) {
        let words: Vec<&str> = pieces.iter().map(|piece| &self.text[piece.start..piece.end]).collect();
        let comment = comment.map(|comment| (comment.text.clone(), false));
        self.rows.push(Row { text: words.join(" "), comment, ends_run: false, begins_run: true });
    }

    fn statement(&mut self, pieces: &[Piece], comment: Option<&Comment>, digits: usize, equals: usize) {
        let outputs = outputs(pieces, self.text);
        let number = number(pieces).map_or("", |piece| &self.text[piece.start..piece.end]);
        let mut head = format!("{number:>digits$}");
        if !outputs.is_empty() {
            head = format!("{head:indent$}{outputs}", indent = start_of_outputs(digits));
        }
        head = format!("{head:equals$}");
        let first = pieces.iter().position(|piece| piece.token == Token::Equals).unwrap_or(0);
        let calls: Vec<usize> = call(pieces).into_iter().collect();
        let around = around(pieces, &calls);
        let breaks = breaks(pieces, &around);
        let body = Body { text: self.text, pieces: &pieces[first..], around: &around[first..], head: &head };
        self.rows.append(&mut body.laid_out(breaks[first..].to_vec(), comment));
    }
}

/// Which tokens begin a line because they did: breaks behind a comma stay, those at the `:` stand before it.
pub(super) fn breaks(pieces: &[Piece], around: &[Around]) -> Vec<bool> {
    let mut breaks = vec![false; pieces.len()];
    for (i, piece) in pieces.iter().enumerate().filter(|(_, piece)| piece.new_line) {
        let previous = i.checked_sub(1).map(|previous| around[previous]);
        let place = match (piece.token, previous) {
            // A comma stands on the line of its item; that of an empty place has none.
            (Token::Comma, _) if !around[i].may_break => i + 1,
            (_, Some(previous)) if previous.colon => i - 1,
            _ => i,
        };
        if let Some(kept) = breaks.get_mut(place).filter(|_| around.get(place).is_some_and(|around| around.may_break)) {
            *kept = true;
        }
    }
    breaks
}

/// A statement from its `=` on; a line of a net behind what is aligned in it.
pub(super) struct Body<'a> {
    pub(super) text: &'a str,
    pub(super) pieces: &'a [Piece],
    pub(super) around: &'a [Around],
    pub(super) head: &'a str,
}

impl Body<'_> {
    /// The lines of the statement, in the width that there is.
    pub(super) fn laid_out(&self, mut breaks: Vec<bool>, comment: Option<&Comment>) -> Vec<Row> {
        let mut rows = self.rows(&breaks, false);
        // Where the list begins beyond the width, breaks in it do not help.
        if self.head.len() < WIDTH && rows.iter().any(|row| row.text.len() > WIDTH) {
            if let Some(colon) = self.around.iter().position(|around| around.colon) {
                breaks[colon] = true;
            }
            rows = self.rows(&breaks, true);
        }
        if let (Some(row), Some(comment)) = (rows.last_mut(), comment) {
            row.comment = Some((comment.text.clone(), false));
        }
        rows
    }

    /// The lines of the statement, broken where it is asked for, at comments, and, to fill lines, where they get too
    /// long.
    fn rows(&self, breaks: &[bool], fill: bool) -> Vec<Row> {
        let mut rows = Vec::new();
        let mut row = Row { text: self.head.to_owned(), ..Row::default() };
        let mut indent = 0;
        let mut far = false;
        let broken = breaks.iter().any(|breaks| *breaks) || self.pieces.iter().any(|piece| !piece.comments.is_empty());
        for (i, piece) in self.pieces.iter().enumerate() {
            let commented = !piece.comments.is_empty();
            let full = fill && self.around[i].may_break && row.text.len() + 1 + self.rigid(i) > WIDTH;
            let first = std::mem::take(&mut far);
            if i > 0 && (breaks[i] || commented || full || first) {
                self.comments(piece, indent, &mut row, &mut rows);
                rows.push(std::mem::take(&mut row));
                let hang = if self.around[i].colon { 2 } else { 0 };
                row.text = " ".repeat(indent.max(hang) - hang);
            } else if i == 0 || self.around[i].blank {
                row.text.push(' ');
            }
            row.text.push_str(&self.text[piece.start..piece.end]);
            if indent == 0 && piece.token == Token::LeftParen {
                let wide = self.around.get(i + 1).is_some_and(|around| around.blank);
                indent = row.text.len() + usize::from(wide);
                far = indent > WIDEST_START && broken;
                indent = if far { HANGING } else { indent };
            }
        }
        rows.push(row);
        rows
    }

    /// Ends a row with the comments before a token: the first may stand behind code, others have rows of their own.
    fn comments(&self, piece: &Piece, indent: usize, row: &mut Row, rows: &mut Vec<Row>) {
        for comment in &piece.comments {
            if comment.own_line || row.comment.is_some() {
                rows.push(std::mem::take(row));
                row.text = if comment.continues { String::new() } else { " ".repeat(indent) };
            }
            row.comment = Some((comment.text.clone(), comment.continues));
        }
    }

    /// The length of what cannot be broken, from a token on.
    fn rigid(&self, first: usize) -> usize {
        let mut length = 0;
        for (i, piece) in self.pieces.iter().enumerate().skip(first) {
            if i > first && (self.around[i].may_break || !piece.comments.is_empty()) {
                break;
            }
            length += piece.end - piece.start + usize::from(i > first && self.around[i].blank);
        }
        length
    }
}

/// Puts the comments behind the rows, run by run.
pub(super) fn align(rows: &[Row], bytes: &[u8], line_end: &str) -> Vec<u8> {
    let mut text = Vec::with_capacity(bytes.len() + bytes.len() / 4);
    let mut start = 0;
    while start < rows.len() {
        let same = rows[start + 1..].iter().take_while(|row| !row.ends_run && !row.begins_run).count();
        let run = if rows[start].ends_run { &rows[start..=start] } else { &rows[start..=start + same] };
        start += run.len();
        write_run(run, bytes, line_end, &mut text);
    }
    text.truncate(text.len().saturating_sub(line_end.len()));
    text
}

fn write_run(run: &[Row], bytes: &[u8], line_end: &str, text: &mut Vec<u8>) {
    let aligned = |row: &&Row| row.comment.is_some() && row.text.len() <= WIDEST_COMMENTED && !is_blank(row);
    let column = run.iter().filter(aligned).map(|row| row.text.len() + BEFORE_COMMENT).max().unwrap_or(0);
    let mut above = column;
    for row in run {
        text.extend_from_slice(row.text.as_bytes());
        if let Some((comment, continues)) = &row.comment {
            let place = match (*continues, is_blank(row)) {
                (true, _) => above,
                (false, true) => row.text.len(),
                (false, false) => column.max(row.text.len() + 1),
            };
            above = place;
            text.extend(std::iter::repeat_n(b' ', place - row.text.len()));
            text.extend_from_slice(&bytes[comment.clone()]);
        }
        text.extend_from_slice(line_end.as_bytes());
    }
}

/// A row without code.
fn is_blank(row: &Row) -> bool {
    row.text.bytes().all(|byte| byte == b' ')
}
