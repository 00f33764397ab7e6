//! Tokens -> statements: lines are cut and missing parentheses found before the parser sees them, and it starts
//! afresh behind a line that it does not understand, so that one mistake never hides the next.

use crate::ast::{Formula, Item, Line, Name, Number, Operand, Output, Statement, Term};
use crate::codes;
use crate::declare::raw::Expr;
use crate::diagnostic::{self, Diagnostic};
use crate::lexer::{Key, Lexeme, Token};
use crate::source::{FileId, SourceFile, Sources, Span};
use crate::symbol::{Symbol, Symbols};
use crate::types::Real;
use lalrpop_util::ParseError;

lalrpop_util::lalrpop_mod!(
    #[allow(
        clippy::all,
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        missing_docs,
        unreachable_pub,
        unused
    )]
    cfg
);
lalrpop_util::lalrpop_mod!(
    #[allow(
        clippy::all,
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        missing_docs,
        unreachable_pub,
        unused
    )]
    fc
);

mod lines;
mod nets;
mod wording;

pub(crate) use lines::{Lines, Words};
use lines::{is_comparison, negates};
pub(crate) use nets::parse_net_lines;
use wording::{HEAD, declares, form_help, list};

/// The deepest nesting of an expression.
const MAX_DEPTH: u32 = 100;

/// The longest name.
pub const MAX_NAME: usize = 63;

/// What was written in one `.cfg` file.
#[derive(Clone, Debug, Default)]
pub struct Tree {
    /// Its lines in order, END excluded.
    pub lines: Vec<Line>,
    /// Names that stand as outputs of lines which could not be parsed: not unknown, but nothing is known of them.
    pub spoiled: Vec<Symbol>,
    /// Numbers of such lines.
    pub spoiled_numbers: Vec<u32>,
    /// Where the file ends.
    pub end: Option<Span>,
}

/// What grammar actions need: the text, the names, and where to complain.
pub struct Context<'a> {
    text: &'a str,
    file: FileId,
    symbols: &'a mut Symbols,
    diagnostics: &'a mut Vec<Diagnostic>,
    lines: Vec<Line>,
    outputs: Vec<Output>,
    items: Vec<Item>,
    terms: Vec<Term>,
    /// How deep the results nest that are not used up yet.
    depths: Vec<u32>,
    too_deep: bool,
    /// The counters of the FOR lines around the line, and their values.
    counters: Vec<(Name, i32)>,
    /// How often the lines of FOR were read.
    turns: usize,
}

/// Parses a `.cfg` file.
pub fn parse(sources: &Sources, file: FileId, symbols: &mut Symbols, diagnostics: &mut Vec<Diagnostic>) -> Tree {
    let source = sources.file(file);
    let mut context = Context::new(source, file, symbols, diagnostics);
    let mut tree = Tree::default();
    if !context.is_text(source) {
        return tree;
    }
    let parser = cfg::CfgLinesParser::new();
    let mut rows = Rows::new(source, file);
    while !diagnostic::enough(context.diagnostics) {
        let parsed = parser.parse(&mut context, &mut rows);
        context.diagnostics.append(&mut rows.diagnostics);
        match (parsed, rows.stop) {
            (Err(error), _) => context.report_line(error, &rows.lines.tokens),
            (Ok(()), Stop::Broken) => {}
            (Ok(()), Stop::Word(span)) => {
                tree.end = Some(span);
                break;
            }
            (Ok(()), Stop::File) => {
                context.missing_end();
                break;
            }
        }
        context.spoil(&rows.lines.tokens, &mut tree);
        rows.next = usize::MAX;
    }
    tree.lines = context.lines;
    tree
}

/// The tokens of all lines up to END or to a line that cannot be parsed: one run of the parser takes them all.
struct Rows<'a> {
    lines: Lines<'a>,
    /// The next token of the current line; one past the last stands for its end.
    next: usize,
    /// Why the tokens ended.
    stop: Stop,
    diagnostics: Vec<Diagnostic>,
}

#[derive(Clone, Copy)]
enum Stop {
    /// At the end of the file.
    File,
    /// At the word END.
    Word(Span),
    /// At a line that is broken in a way that was already reported.
    Broken,
}

impl<'a> Rows<'a> {
    fn new(source: &'a SourceFile, file: FileId) -> Rows<'a> {
        let lines = Lines::new(source, file, Words::Program);
        Rows { lines, next: usize::MAX, stop: Stop::File, diagnostics: Vec::new() }
    }

    /// Reads the next line and returns its first token.
    fn first(&mut self) -> Option<Lexeme> {
        let full = diagnostic::enough(&self.diagnostics);
        let broken = if full { None } else { self.lines.next_line(&mut self.diagnostics) };
        let first = self.lines.tokens.first().copied().filter(|_| broken.is_some());
        self.stop = match first {
            Some(lexeme) if lexeme.token == Token::Key(Key::End) => Stop::Word(self.lines.span(lexeme)),
            _ if broken == Some(true) => Stop::Broken,
            Some(_) | None => Stop::File,
        };
        self.next = 1;
        first.filter(|_| matches!(self.stop, Stop::File))
    }
}

impl Iterator for Rows<'_> {
    type Item = Result<(u32, Token, u32), ()>;

    fn next(&mut self) -> Option<Self::Item> {
        let tokens = &self.lines.tokens;
        let lexeme = match tokens.get(self.next) {
            Some(lexeme) => {
                self.next += 1;
                *lexeme
            }
            None if self.next == tokens.len() => {
                self.next = usize::MAX;
                let end = tokens.last().map_or(0, |last| last.end);
                Lexeme { token: Token::Newline, start: end, end }
            }
            None => self.first()?,
        };
        Some(Ok((lexeme.start, lexeme.token, lexeme.end)))
    }
}

/// What a file that is no text at all looks like.
fn no_text(source: &SourceFile) -> Option<&'static str> {
    let bytes = source.raw.as_deref().unwrap_or(source.text.as_bytes());
    let head = &bytes[..bytes.len().min(4)];
    match head {
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => Some("UTF-16"),
        _ if head.contains(&0) => Some("a NUL byte at its start"),
        _ => None,
    }
}

/// Parses one line of a `.fc` file that was already cut.
pub(crate) fn parse_declaration_line(context: &mut Context<'_>, lines: &Lines<'_>) -> Option<crate::declare::raw::Raw> {
    match fc::FcLineParser::new().parse(context, lines.tokens()) {
        Ok(_) if std::mem::take(&mut context.too_deep) => {
            let last = lines.tokens.last().copied().unwrap_or(lines.tokens[0]);
            let message = format!("expected an expression at most {MAX_DEPTH} deep, found a deeper one");
            let span = context.span(lines.tokens[0].start, last.end);
            context.diagnostics.push(Diagnostic::new(codes::BAD_DECLARATION, span, message));
            None
        }
        Ok(raw) => Some(raw),
        Err(error) => {
            context.report(error, &lines.tokens);
            None
        }
    }
}

/// Parses one statement of a composite's body.
pub(crate) fn parse_body_line(context: &mut Context<'_>, lines: &Lines<'_>) -> Option<Line> {
    match cfg::CfgLineParser::new().parse(context, lines.tokens()) {
        Ok(line) => Some(line),
        Err(error) => {
            context.report_line(error, &lines.tokens);
            None
        }
    }
}

/// Whether an expression has something that only a call has, an empty place, a named one or a string: its `:` is missing.
fn is_call(tokens: &[Lexeme], error: &ParseError<u32, Token, ()>) -> bool {
    let ParseError::UnrecognizedToken { token: (start, found, _), .. } = error else {
        return false;
    };
    let behind = tokens.iter().skip_while(|lexeme| lexeme.token != Token::Becomes).skip(1);
    let head: Vec<Token> = behind.take(2).map(|lexeme| lexeme.token).collect();
    let previous = tokens.iter().take_while(|lexeme| lexeme.start < *start).last().map(|lexeme| lexeme.token);
    let empty =
        matches!(found, Token::RightParen | Token::Comma) && matches!(previous, Some(Token::LeftParen | Token::Comma));
    head == [Token::Name, Token::LeftParen] && (empty || matches!(found, Token::Equals | Token::Text))
}

impl<'a> Context<'a> {
    pub(crate) fn new(
        source: &'a SourceFile,
        file: FileId,
        symbols: &'a mut Symbols,
        diagnostics: &'a mut Vec<Diagnostic>,
    ) -> Context<'a> {
        Context {
            text: &source.text,
            file,
            symbols,
            diagnostics,
            lines: Vec::new(),
            outputs: Vec::new(),
            items: Vec::new(),
            terms: Vec::new(),
            depths: Vec::new(),
            too_deep: false,
            counters: Vec::new(),
            turns: 0,
        }
    }

    pub(crate) fn diagnostics(&mut self) -> &mut Vec<Diagnostic> {
        self.diagnostics
    }

    pub(crate) fn span(&self, start: u32, end: u32) -> Span {
        let length = self.text.len() as u32;
        let start = start.min(length);
        Span { file: self.file, start, end: end.min(length).max(start) }
    }

    pub(crate) fn text(&self, span: Span) -> &'a str {
        &self.text[span.start as usize..span.end as usize]
    }

    pub(crate) fn symbol_text(&self, symbol: Symbol) -> &str {
        self.symbols.text(symbol)
    }

    fn statement(
        &mut self,
        start: u32,
        number: Option<(u32, Span)>,
        (code, (colon, inputs)): (Name, (Span, u32)),
        end: u32,
    ) -> Box<Statement> {
        let outputs = self.outputs.drain(..).collect();
        let items = self.items.drain(..).collect();
        let mut statement = Statement::new(number, outputs, code, (items, inputs), (colon, self.span(start, end)));
        statement.counters = self.turn();
        Box::new(statement)
    }

    /// A statement whose right side, from `first` to `end`, is an expression.
    fn expression(&mut self, start: u32, number: Option<(u32, Span)>, (first, end): (u32, u32)) -> Box<Statement> {
        let place = self.span(first, end);
        self.depths.clear();
        if std::mem::take(&mut self.too_deep) {
            self.terms.clear();
            self.items.clear();
            let message = format!("expected an expression at most {MAX_DEPTH} deep, found a deeper one");
            let help = "give a part of it a line of its own";
            self.diagnostics.push(Diagnostic::new(codes::TOO_DEEP, place, message).help(help));
        }
        let formula = Formula(self.terms.drain(..).collect());
        let code = Name { symbol: self.symbols.intern(""), span: place };
        let outputs = self.outputs.drain(..).collect();
        let items: Box<[Item]> = self.items.drain(..).collect();
        let inputs = items.len() as u32;
        let last = Span { start: end.saturating_sub(1).max(first), ..place };
        let mut statement = Statement::new(number, outputs, code, (items, inputs), (last, self.span(start, end)));
        statement.formula = Some(Box::new(formula));
        statement.counters = self.turn();
        Box::new(statement)
    }

    fn operand(&mut self, value: Operand, start: u32, end: u32) {
        self.place(None, value, start, end);
        self.terms.push(Term::Operand);
        self.depths.push(0);
    }

    fn literal(&mut self, start: u32, negative: bool, first: u32, end: u32) {
        let number = self.number(start, negative, first, end);
        self.operand(Operand::Number(number), start, end);
    }

    /// The sign or name at a place is applied to the latest results.
    fn apply(&mut self, start: u32, end: u32, count: u32) {
        let span = self.span(start, end);
        let symbol = self.symbols.intern(self.text(span));
        self.apply_symbol(Name { symbol, span }, count);
    }

    /// An operator that is a word in capitals stands for the function of that name.
    fn apply_word(&mut self, start: u32, end: u32, count: u32) {
        let span = self.span(start, end);
        let symbol = self.symbols.intern(&self.text(span).to_ascii_lowercase());
        self.apply_symbol(Name { symbol, span }, count);
    }

    fn apply_symbol(&mut self, name: Name, count: u32) {
        let rest = self.depths.len().saturating_sub(count as usize);
        let depth = self.depths.drain(rest..).max().unwrap_or(0) + 1;
        self.depths.push(depth);
        self.too_deep |= depth > MAX_DEPTH;
        self.terms.push(Term::Apply(name, count));
    }

    /// Whether the file is text; if not, that is reported.
    pub(crate) fn is_text(&mut self, source: &SourceFile) -> bool {
        let Some(found) = no_text(source) else {
            return true;
        };
        let message = format!("expected ASCII or UTF-8 text, found {found}");
        let report = Diagnostic::new(codes::UNREADABLE, self.span(0, 0), message);
        self.diagnostics.push(report.help("save the file as UTF-8 or ASCII"));
        false
    }

    fn missing_end(&mut self) {
        let length = self.text.len() as u32;
        let end = self.span(length, length);
        self.diagnostics.push(
            Diagnostic::new(codes::MISSING_END, end, "expected END, found the end of the file")
                .help("the file may be cut short; if it is whole, add a line END"),
        );
    }

    fn name(&mut self, start: u32, end: u32) -> Name {
        let span = self.span(start, end);
        let text = self.text(span);
        if text.len() > MAX_NAME && self.symbols.find(text).is_none() {
            let message = format!("expected a name of at most {MAX_NAME} characters, found {}", text.len());
            self.diagnostics.push(Diagnostic::new(codes::BAD_NAME, span, message));
        }
        Name { symbol: self.symbols.intern(text), span }
    }

    fn place(&mut self, label: Option<Name>, value: Operand, start: u32, end: u32) {
        let span = self.span(start, end);
        self.items.push(Item { label: label.map(Box::new), value, span });
    }

    fn discard(&mut self, start: u32, end: u32) {
        let span = self.span(start, end);
        if end - start > 1 {
            self.diagnostics.push(underscore_name(span, self.text(span)));
        }
        self.outputs.push(Output::Discard(span));
    }

    fn natural(&mut self, start: u32, end: u32) -> (u32, Span) {
        let span = self.span(start, end);
        let value = self.text(span).parse::<i32>().unwrap_or_else(|_| {
            self.complain_int(span);
            0
        });
        (value.unsigned_abs(), span)
    }

    fn index(&mut self, start: u32, negative: bool, first: u32, end: u32) -> (i32, Span) {
        match self.number(start, negative, first, end) {
            Number::Int(value) => (value, self.span(start, end)),
            Number::Real(_) => (0, self.span(start, end)),
        }
    }

    /// A number; `first` is where its digits begin, behind a sign and perhaps blanks.
    fn number(&mut self, start: u32, negative: bool, first: u32, end: u32) -> Number {
        let span = self.span(start, end);
        let digits = self.text(self.span(first, end));
        if digits.bytes().all(|byte| byte.is_ascii_digit()) {
            let signed = digits.parse::<i64>().ok().map(|value| if negative { -value } else { value });
            return Number::Int(signed.and_then(|value| i32::try_from(value).ok()).unwrap_or_else(|| {
                self.complain_int(span);
                0
            }));
        }
        Number::Real(read_real(digits, negative).unwrap_or_else(|| {
            let message = format!("expected a real number that a double can hold, found `{}`", self.text(span));
            self.diagnostics.push(Diagnostic::new(codes::NUMBER_RANGE, span, message));
            Real::ZERO
        }))
    }

    fn complain_int(&mut self, span: Span) {
        let message = format!("expected an integer from -2147483648 to 2147483647, found `{}`", self.text(span));
        self.diagnostics.push(Diagnostic::new(codes::NUMBER_RANGE, span, message));
    }

    fn binary(&mut self, a: Expr, sign: char, b: Expr) -> Expr {
        let depth = a.depth().max(b.depth()) + 1;
        self.bounded(Expr::Binary(Box::new(a), sign, Box::new(b), depth))
    }

    fn negate(&mut self, a: Expr) -> Expr {
        let depth = a.depth() + 1;
        self.bounded(Expr::Negate(Box::new(a), depth))
    }

    /// A deep expression is reported and cut, so that nothing ever walks down a long one.
    fn bounded(&mut self, expr: Expr) -> Expr {
        if expr.depth() <= MAX_DEPTH {
            return expr;
        }
        self.too_deep = true;
        Expr::Number(Number::Int(0))
    }

    /// Reports a line of a program that cannot be parsed.
    fn report_line(&mut self, error: ParseError<u32, Token, ()>, tokens: &[Lexeme]) {
        if !is_call(tokens, &error) {
            return self.report(error, tokens);
        }
        let mut call = tokens.to_vec();
        for lexeme in call.iter_mut().filter(|lexeme| lexeme.token == Token::Becomes) {
            lexeme.token = Token::Equals;
        }
        self.forget();
        let parsed = cfg::CfgLineParser::new().parse(self, call.iter().map(|l| Ok((l.start, l.token, l.end))));
        self.report(parsed.err().unwrap_or(error), &call);
    }

    /// Drops what the parser has gathered of a line.
    fn forget(&mut self) {
        self.outputs.clear();
        self.items.clear();
        self.terms.clear();
        self.depths.clear();
        self.too_deep = false;
    }

    /// Reports a line that cannot be parsed, and drops what the parser has gathered of it.
    fn report(&mut self, error: ParseError<u32, Token, ()>, tokens: &[Lexeme]) {
        self.forget();
        let (span, found, expected) = match error {
            ParseError::UnrecognizedToken { token: (start, Token::Newline, _), expected } => {
                (self.span(start.saturating_sub(1), start), "the end of the line".to_owned(), expected)
            }
            ParseError::UnrecognizedToken { token: (start, token, end), expected } => {
                (self.span(start, end), self.describe(token, start, end), expected)
            }
            ParseError::ExtraToken { token: (start, token, end) } => {
                (self.span(start, end), self.describe(token, start, end), vec!["the end of the line".to_owned()])
            }
            ParseError::UnrecognizedEof { expected, .. } => {
                let end = tokens.last().map_or(0, |lexeme| lexeme.end);
                (self.span(end.saturating_sub(1), end), "the end of the line".to_owned(), expected)
            }
            ParseError::InvalidToken { location } => {
                (self.span(location, location + 1), "an unknown token".to_owned(), Vec::new())
            }
            ParseError::User { .. } => return,
        };
        if let Some(report) = self.bad_name(span, tokens, &expected) {
            self.diagnostics.push(report);
            return;
        }
        let allowed = |sign: &str| expected.iter().any(|token| token.trim_matches('"') == sign);
        let token = tokens.iter().find(|lexeme| lexeme.start == span.start).map(|lexeme| lexeme.token);
        let reserved = matches!(token, Some(Token::Key(_))) && allowed("NAME");
        let found = if reserved { format!("the reserved word {found}") } else { found };
        let mut wanted = list(&expected);
        if token == Some(Token::Real) && !allowed("REAL") {
            wanted = wanted.replace("a number", "an integer");
        }
        let message = format!("expected {wanted}, found {found}");
        let help = if token.is_some_and(is_comparison) && (allowed("+") || allowed("==")) {
            "comparisons do not follow one another: put one into parentheses"
        } else if found == "`=`" && allowed("==") {
            "a comparison for equality is `==`"
        } else if allowed("NAME") && allowed("(") && self.comment_follows(tokens, span) {
            "`!` begins a comment; negation is `NOT`"
        } else if allowed("vec") {
            HEAD
        } else {
            form_help(tokens)
        };
        self.diagnostics.push(Diagnostic::new(codes::UNEXPECTED, span, message).help(help));
    }

    /// Whether the line is at its end at a place, and a comment begins there that looks like a negated operand.
    fn comment_follows(&self, tokens: &[Lexeme], place: Span) -> bool {
        let end = tokens.last().map_or(0, |last| last.end);
        let behind = self.text.get(end as usize..).unwrap_or_default();
        let comment = behind.trim_start_matches([' ', '\t']).strip_prefix('!');
        place.end == end && comment.is_some_and(negates)
    }

    /// A reserved word where a new name is due, or a name that starts with `_`.
    fn bad_name(&self, span: Span, tokens: &[Lexeme], expected: &[String]) -> Option<Diagnostic> {
        let at = tokens.iter().position(|lexeme| lexeme.start == span.start)?;
        if !expected.iter().any(|token| token == "\"NAME\"") {
            return None;
        }
        let text = self.text(span);
        match tokens[at].token {
            Token::Key(key) if is_new(key, &tokens[..at], expected) => {
                let message = format!("expected a name, found the reserved word `{text}`");
                Some(Diagnostic::new(codes::BAD_NAME, span, message).help("take another name"))
            }
            Token::Underscore if text.len() > 1 => Some(underscore_name(span, text)),
            _ => None,
        }
    }

    fn describe(&self, token: Token, start: u32, end: u32) -> String {
        match token {
            Token::Newline => "the end of the line".to_owned(),
            _ => {
                let text = self.text(self.span(start, end));
                let short: String = text.chars().take(40).collect();
                let dots = if short.len() < text.len() { ".." } else { "" };
                format!("`{short}{dots}`")
            }
        }
    }

    /// Keeps what others may refer to of a line that is not understood: its section, or its number and output names.
    fn spoil(&mut self, tokens: &[Lexeme], tree: &mut Tree) {
        let first = tokens.first().map(|lexeme| (lexeme.token, self.span(lexeme.start, lexeme.end)));
        if let Some((Token::Key(_), span)) = first {
            self.lines.push(Line::UnknownSection(span));
        }
        for lexeme in tokens {
            let text = self.text(self.span(lexeme.start, lexeme.end));
            match lexeme.token {
                Token::Name => {
                    let symbol = self.symbols.intern(text);
                    tree.spoiled.push(symbol);
                }
                Token::Int => tree.spoiled_numbers.extend(text.parse::<u32>()),
                Token::Equals | Token::Becomes => return,
                _ => {}
            }
        }
    }
}

/// Whether a word stands for a new name behind these tokens, and nothing is missing before it.
fn is_new(word: Key, before: &[Lexeme], expected: &[String]) -> bool {
    let latest = before.iter().rev().find_map(|lexeme| match lexeme.token {
        Token::Key(key) => Some(key),
        _ => None,
    });
    match latest {
        Some(key) => declares(key) && expected.iter().all(|token| matches!(token.trim_matches('"'), "NAME" | "_")),
        // An operator among the inputs of a block is meant as one.
        None => {
            let outputs = !before.iter().any(|lexeme| matches!(lexeme.token, Token::Equals | Token::Becomes));
            outputs || !matches!(word, Key::And | Key::Or | Key::Not)
        }
    }
}

fn underscore_name(span: Span, text: &str) -> Diagnostic {
    Diagnostic::new(codes::BAD_NAME, span, format!("expected a name that starts with a letter, found `{text}`"))
        .help("`_` alone discards an output")
}

/// A real in both widths, each converted once from the decimal text; `None` when it overflows a double or a float
/// that should hold it.
pub fn read_real(digits: &str, negative: bool) -> Option<Real> {
    let wide: f64 = digits.parse().ok()?;
    let narrow: f32 = digits.parse().ok()?;
    let sign = if negative { -1.0 } else { 1.0 };
    wide.is_finite().then_some(Real { wide: wide * sign, narrow: narrow * sign as f32 })
}
