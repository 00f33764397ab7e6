//! The lines of a net below its head. The lines between FOR and NEXT are parsed once for each value of the counter.

use super::wording::{LINES, declares, inside_help};
use super::{Context, Lines, cfg};
use crate::ast::net::NetLine;
use crate::ast::{Name, Operand, Statement};
use crate::codes;
use crate::diagnostic::{self, Diagnostic};
use crate::lexer::{Key, Lexeme, NET_WORDS, Token};
use crate::source::Span;
use crate::suggest;
use lalrpop_util::ParseError;

/// The most lines of one net, those of FOR counted as often as they run.
const MAX_LINES: usize = 1 << 17;

/// FOR lines nest at most this deep.
const MAX_LOOPS: usize = 8;

/// Parses what follows a net's head, up to END.
pub(crate) fn parse_net_lines(context: &mut Context<'_>, lines: &mut Lines<'_>) -> Vec<NetLine> {
    let mut rows: Vec<Vec<Lexeme>> = Vec::new();
    let mut ended = false;
    while !diagnostic::enough(context.diagnostics) {
        let Some(broken) = lines.next_line(context.diagnostics) else {
            break;
        };
        rows.push(if broken { Vec::new() } else { lines.tokens.clone() });
        if is_first(&lines.tokens, Key::End) {
            ended = true;
            break;
        }
    }
    if !ended {
        context.missing_end();
    }
    let mut parsed = Vec::new();
    block(context, &rows, &mut parsed);
    parsed
}

fn is_first(row: &[Lexeme], key: Key) -> bool {
    row.first().is_some_and(|lexeme| lexeme.token == Token::Key(key))
}

/// Parses a run of lines.
fn block(context: &mut Context<'_>, rows: &[Vec<Lexeme>], parsed: &mut Vec<NetLine>) {
    let mut next = 0;
    while let Some(row) = rows.get(next) {
        next += 1;
        match parse(context, row) {
            NetLine::For(name, from, to) => {
                let Some(length) = body_length(&rows[next..]) else {
                    context.no_next(name.span);
                    parsed.push(NetLine::Broken(true));
                    return;
                };
                repeat(context, &rows[next..next + length], (name, from, to), parsed);
                next += length + 1;
            }
            NetLine::Broken(_) if is_first(row, Key::For) => {
                parsed.push(NetLine::Broken(true));
                next = body_length(&rows[next..]).map_or(rows.len(), |length| next + length + 1);
            }
            NetLine::Next(span) => {
                context.complain(codes::SECTION, span, "expected a FOR before NEXT, found none", "delete this NEXT");
            }
            line => parsed.push(line),
        }
        if parsed.len() > MAX_LINES {
            let place = row.first().map_or(0, |lexeme| lexeme.start);
            let place = context.span(place, row.last().map_or(place, |lexeme| lexeme.end));
            context.too_many(place);
        }
        if context.turns > MAX_LINES {
            return;
        }
    }
}

/// How many lines stand before the NEXT that closes a FOR.
fn body_length(rows: &[Vec<Lexeme>]) -> Option<usize> {
    let mut open = 0;
    for (i, row) in rows.iter().enumerate() {
        if is_first(row, Key::For) {
            open += 1;
        } else if is_first(row, Key::Next) {
            if open == 0 {
                return Some(i);
            }
            open -= 1;
        }
    }
    None
}

fn repeat(
    context: &mut Context<'_>,
    rows: &[Vec<Lexeme>],
    (name, from, to): (Name, (u32, Span), (u32, Span)),
    parsed: &mut Vec<NetLine>,
) {
    if context.counters.len() == MAX_LOOPS {
        let message = format!("expected FOR at most {MAX_LOOPS} deep, found a deeper one");
        context.complain(codes::TOO_DEEP, name.span, message, "write a part of the lines out");
        return;
    }
    if let Some((outer, _)) = context.counters.iter().find(|(outer, _)| outer.symbol == name.symbol) {
        let text = context.symbols.text(name.symbol);
        let message = format!("expected a counter of its own for each FOR, found `{text}` a second time");
        let report = Diagnostic::new(codes::NET_NAME_TAKEN, name.span, message).help("take another name");
        let report = report.label(outer.span, "it counts these lines already");
        context.diagnostics.push(report);
        return;
    }
    if from.0 > to.0 {
        let message = format!("expected at least {} behind TO, found {}", from.0, to.0);
        context.complain(codes::OUT_OF_RANGE, to.1, message, "count upwards");
        return;
    }
    for value in from.0..=to.0 {
        let before = context.diagnostics.iter().filter(|diagnostic| diagnostic.is_error()).count();
        context.counters.push((name, value as i32));
        block(context, rows, parsed);
        context.counters.pop();
        let after = context.diagnostics.iter().filter(|diagnostic| diagnostic.is_error()).count();
        context.turns += 1;
        if context.turns >= MAX_LINES {
            context.too_many(name.span);
            return;
        }
        // The next turn would say the same again.
        if after > before {
            return;
        }
    }
}

fn parse(context: &mut Context<'_>, row: &[Lexeme]) -> NetLine {
    let Some(first) = row.first() else {
        return NetLine::Broken(true);
    };
    if !matches!(first.token, Token::Key(key) if key.begins_line()) {
        context.no_net_line(*first);
        return NetLine::Broken(may_declare(first.token));
    }
    let tokens = row.iter().map(|lexeme| Ok((lexeme.start, lexeme.token, lexeme.end)));
    match cfg::NetLineParser::new().parse(context, tokens) {
        Ok(line) => line,
        Err(error) => {
            match second_statement(row, &error) {
                Some(second) => context.one_statement(second),
                None => context.report(error, row),
            }
            NetLine::Broken(may_declare(first.token))
        }
    }
}

/// Whether a line that begins so declares something that other lines name. Gates are named by none.
fn may_declare(first: Token) -> bool {
    match first {
        Token::Key(Key::Gate) => false,
        Token::Key(key) => declares(key) || key == Key::Local,
        _ => true,
    }
}

/// Where a line goes on with another statement behind the one of its DO.
fn second_statement(row: &[Lexeme], error: &ParseError<u32, Token, ()>) -> Option<Lexeme> {
    let is_do = |lexeme: &&Lexeme| matches!(lexeme.token, Token::Key(Key::Do | Key::After));
    let first = row.iter().find(is_do)?;
    if let Some(second) = row.iter().filter(is_do).nth(1) {
        return Some(*second);
    }
    let ParseError::UnrecognizedToken { token: (start, Token::Comma, _), .. } = error else {
        return None;
    };
    let before = row.iter().filter(|lexeme| lexeme.start > first.start && lexeme.start < *start);
    let count = |wanted: &[Token]| before.clone().filter(|lexeme| wanted.contains(&lexeme.token)).count();
    let whole = count(&[Token::LeftParen]) == count(&[Token::RightParen]);
    let comma = row.iter().find(|lexeme| lexeme.start == *start);
    comma.copied().filter(|_| whole && count(&[Token::Equals, Token::Becomes]) > 0)
}

impl Context<'_> {
    fn complain(&mut self, code: codes::Code, span: Span, message: impl Into<String>, help: &str) {
        self.diagnostics.push(Diagnostic::new(code, span, message).help(help));
    }

    fn no_next(&mut self, place: Span) {
        let message = "expected NEXT after FOR, found the end of the net";
        self.complain(codes::UNCLOSED, place, message, "close the repeated lines with NEXT");
    }

    /// A line of a net begins with a word of its own.
    fn no_net_line(&mut self, first: Lexeme) {
        let found = self.describe(first.token, first.start, first.end);
        let help = match first.token {
            Token::Key(key) => inside_help(key).to_owned(),
            _ => {
                let words = NET_WORDS.iter().filter(|(_, key)| key.begins_line()).map(|(word, _)| *word);
                suggest::help(found.trim_matches('`'), words).unwrap_or_else(|| LINES.to_owned())
            }
        };
        let message = format!("expected a word that begins a line of a net, found {found}");
        self.complain(codes::UNEXPECTED, self.span(first.start, first.end), message, &help);
    }

    fn one_statement(&mut self, second: Lexeme) {
        self.forget();
        let found = self.describe(second.token, second.start, second.end);
        let message = format!("expected the end of the line behind one statement, found {found}");
        let help = "a DO has one statement: put the next one on a line of its own below, `DO output = value`";
        self.complain(codes::UNEXPECTED, self.span(second.start, second.end), message, help);
    }

    /// There are too many lines, or turns of FOR: no more is read.
    fn too_many(&mut self, place: Span) {
        if self.turns <= MAX_LINES {
            let message =
                format!("expected at most {MAX_LINES} lines in a net, those of FOR counted in each turn, found more");
            self.complain(codes::TOO_LARGE, place, message, "divide the net, or repeat less often");
            self.turns = MAX_LINES + 1;
        }
    }

    /// The value of a FOR counter, and something more.
    pub(super) fn counter(&mut self, name: Name, more: i64) -> (i32, Span) {
        let known = self.counters.iter().rev().find(|(counter, _)| counter.symbol == name.symbol);
        let Some((_, value)) = known else {
            let text = self.symbols.text(name.symbol);
            let message = format!("expected a number, found `{text}`");
            let help =
                if self.counters.is_empty() { "indexes are numbers" } else { "take a number or the counter of a FOR" };
            self.complain(codes::UNEXPECTED, name.span, message, help);
            return (1, name.span);
        };
        let index = i64::from(*value) + more;
        let fits = i32::try_from(index).unwrap_or_else(|_| {
            let message = format!("expected an index of at most {}, found {index}", i32::MAX);
            self.complain(codes::NUMBER_RANGE, name.span, message, "count from a smaller number");
            0
        });
        (fits, name.span)
    }

    /// A value that is asked for.
    pub(super) fn value(&mut self, operand: Operand, start: u32, end: u32) -> Box<Statement> {
        let code = Name { symbol: self.symbols.intern(""), span: self.span(start, end) };
        let mut statement = Statement::value(operand, code);
        statement.counters = self.turn();
        Box::new(statement)
    }

    /// The values of the counters, for a statement.
    pub(super) fn turn(&self) -> Box<[(Name, i32)]> {
        self.counters.as_slice().into()
    }

    /// `idle[3]` as one name.
    pub(super) fn indexed(&mut self, name: Name, (index, _): (i32, Span), start: u32, end: u32) -> Name {
        let text = format!("{}[{index}]", self.symbols.text(name.symbol));
        Name { symbol: self.symbols.intern(&text), span: self.span(start, end) }
    }

    /// The same where several indexes could stand.
    pub(super) fn owner(&mut self, name: Name, indexes: Vec<(i32, Span)>, start: u32, end: u32) -> Name {
        match indexes.as_slice() {
            [index] => self.indexed(name, *index, start, end),
            _ => name,
        }
    }
}
