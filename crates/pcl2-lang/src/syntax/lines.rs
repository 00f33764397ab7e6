//! Logical lines: a newline inside parentheses is white space, a missing parenthesis is found here, and so are characters
//! without a meaning.

use crate::codes;
use crate::diagnostic::{self, Diagnostic};
use crate::lexer::{
    DECLARATION_WORDS, Key, Lexeme, Lexer, NET_WORDS, SECTION_WORDS, Token, ascii_of, ascii_of_bytes, sign_of, token_of,
};
use crate::source::{FileId, NOT_TEXT, SourceFile, Span};

/// Which words are reserved in the lines that come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Words {
    /// Statements of a program.
    Program,
    /// Declarations.
    Declarations,
    /// The head of a net, a declaration that lines of a net follow.
    Head,
    /// A net below its head.
    Net,
}

impl Words {
    fn table(self) -> &'static [(&'static str, Key)] {
        match self {
            Words::Program => &SECTION_WORDS,
            Words::Declarations | Words::Head => &DECLARATION_WORDS,
            Words::Net => &NET_WORDS,
        }
    }

    /// Whether statements come, and no declarations.
    fn are_statements(self) -> bool {
        match self {
            Words::Program | Words::Net => true,
            Words::Declarations | Words::Head => false,
        }
    }
}

/// Cuts a file into logical lines: a newline inside parentheses is white space.
pub(crate) struct Lines<'a> {
    source: &'a SourceFile,
    file: FileId,
    lexer: Lexer<'a>,
    pending: Option<Lexeme>,
    words: Words,
    /// The tokens of the current line.
    pub(crate) tokens: Vec<Lexeme>,
}

impl<'a> Lines<'a> {
    pub(super) fn new(source: &'a SourceFile, file: FileId, words: Words) -> Lines<'a> {
        let lexer = Lexer::new(&source.text, words.table());
        Lines { source, file, lexer, pending: None, words, tokens: Vec::new() }
    }

    pub(crate) fn declarations(source: &'a SourceFile, file: FileId) -> Lines<'a> {
        Lines::new(source, file, Words::Declarations)
    }

    pub(crate) fn net(source: &'a SourceFile, file: FileId) -> Lines<'a> {
        Lines::new(source, file, Words::Head)
    }

    /// Switches to other words, for a composite's body or a net below its head.
    pub(crate) fn set_words(&mut self, words: Words) {
        self.words = words;
        self.lexer.set_words(words.table());
    }

    /// The rest of the text after the current line.
    pub(crate) fn position(&self) -> u32 {
        self.tokens.last().map_or(0, |lexeme| lexeme.end)
    }

    /// Goes on at a byte of the text.
    pub(crate) fn jump(&mut self, byte: u32) {
        self.pending = None;
        self.lexer.jump(byte);
    }

    /// Reads the next line that is not blank. `Some(true)`: it is broken in a way that was already reported.
    pub(crate) fn next_line(&mut self, diagnostics: &mut Vec<Diagnostic>) -> Option<bool> {
        self.tokens.clear();
        let mut open: Vec<Lexeme> = Vec::new();
        let mut open_text = false;
        let mut bad = Bad::default();
        let (mut equals, mut colon) = (None, false);
        let mut not_equal = None;
        while let Some(lexeme) = self.pending.take().or_else(|| self.lexer.next()) {
            if lexeme.token == Token::Newline {
                not_equal = not_equal.or_else(|| self.not_equal());
            }
            match lexeme.token {
                Token::Newline if open.is_empty() && (self.tokens.is_empty() || self.goes_on()) => continue,
                Token::Newline if open.is_empty() => break,
                Token::Newline if self.starts_statement() => break,
                Token::Newline => continue,
                Token::LeftParen => open.push(lexeme),
                Token::RightParen => drop(open.pop()),
                Token::Colon => colon = true,
                Token::Equals if open.is_empty() && equals.is_none() => equals = Some(self.tokens.len()),
                Token::Key(Key::End) if self.tokens.is_empty() => {
                    self.tokens.push(lexeme);
                    return Some(false);
                }
                Token::OpenText => {
                    open_text = true;
                    diagnostics.push(unclosed_text(self.span(lexeme)));
                }
                Token::Bad => {
                    let token = bad.meet(lexeme, self, diagnostics);
                    self.push_replacement(token, lexeme, &mut open);
                    if bad.skip > lexeme.end {
                        self.jump(bad.skip);
                    }
                    continue;
                }
                Token::Dot if self.is_stray_dot(lexeme) => {
                    diagnostic::warn(diagnostics, stray_dot(self.span(lexeme)));
                    continue;
                }
                _ => {}
            }
            self.tokens.push(lexeme);
        }
        if self.tokens.is_empty() {
            return None;
        }
        let statements = self.words.are_statements();
        let mut holds_expression = self.ends_in_condition() || (statements && !open.is_empty());
        if let (Some(equals), false, true) = (equals.and_then(|i| self.tokens.get_mut(i)), colon, statements) {
            equals.token = Token::Becomes;
            holds_expression = true;
        }
        let not_equal = not_equal.or_else(|| self.not_equal()).filter(|_| holds_expression);
        diagnostics.extend(not_equal.map(comment_for_not_equal));
        // A string without its end, or such a comment, has swallowed the parenthesis.
        if let (Some(first), false, None) = (open.first(), open_text, not_equal) {
            self.report_unclosed(*first, diagnostics);
        }
        Some(bad.unknown || open_text || !open.is_empty())
    }

    /// Whether what stands last in a line of a net is a condition or a statement.
    fn ends_in_condition(&self) -> bool {
        let signs = [Key::And, Key::Or, Key::Not];
        let words = self.tokens.iter().rev().filter_map(|lexeme| match lexeme.token {
            Token::Key(key) if !signs.contains(&key) => Some(key),
            _ => None,
        });
        let begins = [Key::If, Key::Until, Key::When, Key::Permit, Key::Abort, Key::Do, Key::After];
        self.words == Words::Net && words.take(1).any(|word| begins.contains(&word))
    }

    /// `a != b` is `a` and a comment; whoever writes it behind an operand means another thing.
    fn not_equal(&self) -> Option<Span> {
        let last = self.tokens.last().filter(|last| ends_operand(last.token))?;
        let behind = self.source.text.get(last.end as usize..)?;
        let comment = behind.trim_start_matches([' ', '\t']);
        let start = last.end + (behind.len() - comment.len()) as u32;
        let meant = comment.starts_with("!=") && !comment.starts_with("!==");
        meant.then_some(Span { file: self.file, start, end: start + 2 })
    }

    /// The tokens as lalrpop wants them.
    pub(super) fn tokens(&self) -> impl Iterator<Item = Result<(u32, Token, u32), ()>> + '_ {
        self.tokens.iter().map(|lexeme| Ok((lexeme.start, lexeme.token, lexeme.end)))
    }

    pub(super) fn span(&self, lexeme: Lexeme) -> Span {
        Span { file: self.file, start: lexeme.start, end: lexeme.end }
    }

    /// Whether a declaration goes on behind the end of a line: a list has a comma there.
    fn goes_on(&self) -> bool {
        let comma = self.tokens.last().is_some_and(|last| last.token == Token::Comma);
        comma && !self.words.are_statements() && !self.starts_clause()
    }

    /// Whether a clause word comes next.
    fn starts_clause(&self) -> bool {
        let next = self.lexer.clone().map(|lexeme| lexeme.token).find(|token| *token != Token::Newline);
        matches!(next, Some(Token::Key(key)) if key.begins_line())
    }

    /// Whether the first line of a net below its head comes next.
    fn starts_net(&self) -> bool {
        let next = self.lexer.clone().next().filter(|_| self.words == Words::Head);
        let text = next.and_then(|next| self.source.text.get(next.start as usize..next.end as usize));
        NET_WORDS.iter().any(|(word, key)| key.begins_line() && text == Some(*word))
    }

    fn push_replacement(&mut self, token: Option<Token>, lexeme: Lexeme, open: &mut Vec<Lexeme>) {
        let Some(token) = token else {
            return;
        };
        match token {
            Token::LeftParen => open.push(lexeme),
            Token::RightParen => drop(open.pop()),
            _ => {}
        }
        self.tokens.push(Lexeme { token, ..lexeme });
    }

    fn is_stray_dot(&self, dot: Lexeme) -> bool {
        self.tokens.last().is_some_and(|last| last.token == Token::Real && last.end == dot.start)
    }

    /// Whether what follows a newline inside parentheses looks like a new statement:
    /// `[number] [names] = code (`, `number [names] =`, a section or a clause word.
    fn starts_statement(&self) -> bool {
        let mut ahead = self.lexer.clone().map(|lexeme| lexeme.token).peekable();
        if let Some(Token::Key(key)) = ahead.peek() {
            return key.begins_line();
        }
        if self.starts_net() {
            return true;
        }
        let numbered = ahead.next_if_eq(&Token::Int).is_some();
        while ahead.next_if(|token| matches!(token, Token::Name | Token::Underscore)).is_some() {
            if ahead.next_if_eq(&Token::Comma).is_none() {
                break;
            }
        }
        let equals = ahead.next_if_eq(&Token::Equals).is_some();
        equals && (numbered || !is_named_argument(ahead))
    }

    fn report_unclosed(&self, open: Lexeme, diagnostics: &mut Vec<Diagnostic>) {
        let message = "expected `)`, found the next statement or the end of the file";
        let help = match self.comment_closes() {
            true => "close this parenthesis; `!` begins a comment, negation is `NOT`",
            false => "close this parenthesis",
        };
        diagnostics.push(Diagnostic::new(codes::UNCLOSED, self.span(open), message).help(help));
    }

    /// Whether a comment behind the line looks like a negated operand and its parenthesis.
    fn comment_closes(&self) -> bool {
        let behind = self.source.text.get(self.position() as usize..).unwrap_or_default();
        let line = behind.split(['\r', '\n']).next().unwrap_or_default();
        let comment = line.trim_start_matches([' ', '\t']).strip_prefix('!');
        comment.is_some_and(|comment| negates(comment) && comment.contains(')'))
    }
}

/// Whether a comment, its `!` left off, begins as an operand does.
pub(super) fn negates(comment: &str) -> bool {
    comment.starts_with(|first: char| first.is_ascii_alphanumeric() || first == '(')
}

/// Whether what stands behind `K =` is the value of a named argument, and neither a call nor an expression.
fn is_named_argument(mut ahead: std::iter::Peekable<impl Iterator<Item = Token>>) -> bool {
    let signed = ahead.next_if(|token| matches!(token, Token::Plus | Token::Minus)).is_some();
    match ahead.next() {
        Some(Token::Name) if signed => false,
        Some(Token::Name) => !matches!(ahead.peek(), Some(Token::LeftParen)) && !ahead.peek().is_some_and(is_sign),
        Some(Token::Int | Token::Real) => !ahead.peek().is_some_and(is_sign),
        Some(Token::LeftParen) => false,
        Some(_) | None => true,
    }
}

/// Whether a token between two operands makes an expression of them.
pub(super) fn is_sign(token: &Token) -> bool {
    match token {
        Token::Plus | Token::Minus | Token::Star | Token::Slash => true,
        _ => is_comparison(*token),
    }
}

pub(super) fn is_comparison(token: Token) -> bool {
    matches!(token, Token::Less | Token::LessEqual | Token::Greater | Token::GreaterEqual | Token::Same | Token::Differ)
}

/// Whether an operand may end with a token.
fn ends_operand(token: Token) -> bool {
    matches!(token, Token::Name | Token::Int | Token::Real | Token::RightParen | Token::RightBracket)
}

fn comment_for_not_equal(span: Span) -> Diagnostic {
    let message = "expected `<>` for not equal, found `!=`, and `!` begins a comment";
    Diagnostic::new(codes::NOT_EQUAL, span, message).help("write `<>`; or put a blank behind the `!` of a comment")
}

fn unclosed_text(span: Span) -> Diagnostic {
    Diagnostic::new(codes::UNCLOSED_STRING, span, "expected a closing `\"` on the same line, found the end of the line")
        .help("close the string")
}

fn stray_dot(span: Span) -> Diagnostic {
    Diagnostic::new(codes::STRAY_DOT, span, "expected `,` or `)` after a real, found a second dot")
        .help("the dot is ignored; delete it")
}

/// Characters without a meaning, reported once for each run of them.
#[derive(Default)]
struct Bad {
    last_end: Option<u32>,
    /// One past the second byte of a character of two bytes.
    skip: u32,
    unknown: bool,
}

impl Bad {
    /// Reports the character and returns the ASCII token it stands for.
    fn meet(&mut self, lexeme: Lexeme, lines: &Lines<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<Token> {
        let continues = self.last_end == Some(lexeme.start);
        self.last_end = Some(lexeme.end);
        let text = &lines.source.text[lexeme.start as usize..];
        let character = text.chars().next().unwrap_or(NOT_TEXT);
        if let Some((sign, token)) = sign_of(character) {
            diagnostics.push(other_sign(character, sign, lines.span(lexeme)));
            return Some(token);
        }
        let twin = if character == NOT_TEXT { self.bytes_twin(lexeme, lines.source) } else { ascii_of(character) };
        let token = twin.and_then(token_of);
        self.unknown |= token.is_none() && twin != Some(' ');
        if !continues || twin.is_some() {
            let end = if character == NOT_TEXT && twin.is_some() { self.skip } else { lexeme.end };
            diagnostics.push(bad_character(character, twin, lines.span(Lexeme { end, ..lexeme }), lines.source));
        }
        self.arrow(token, lexeme, text)
    }

    /// The token, an arrow where `>` follows a minus or a dash.
    fn arrow(&mut self, token: Option<Token>, lexeme: Lexeme, text: &str) -> Option<Token> {
        let length = (lexeme.end - lexeme.start) as usize;
        if token != Some(Token::Minus) || !text.get(length..).is_some_and(|behind| behind.starts_with('>')) {
            return token;
        }
        self.skip = lexeme.end + 1;
        Some(Token::Arrow)
    }

    fn bytes_twin(&mut self, lexeme: Lexeme, source: &SourceFile) -> Option<char> {
        let raw = source.raw.as_deref()?;
        let first = *raw.get(lexeme.start as usize)?;
        let twin = ascii_of_bytes(first, *raw.get(lexeme.start as usize + 1)?)?;
        self.skip = lexeme.start + 2;
        Some(twin)
    }
}

fn bad_character(character: char, twin: Option<char>, span: Span, source: &SourceFile) -> Diagnostic {
    let found = match character {
        NOT_TEXT => match source.raw.as_deref().and_then(|raw| raw.get(span.start as usize)) {
            Some(byte) => format!("the byte 0x{byte:02x}"),
            None => "a control character".to_owned(),
        },
        c if c.is_control() => format!("the control character 0x{:02x}", c as u32),
        c if c.is_whitespace() => format!("U+{:04X}", c as u32),
        c => format!("`{c}`"),
    };
    match twin {
        Some(' ') => {
            Diagnostic::new(codes::BAD_CHARACTER, span, format!("expected an ASCII blank, found another one ({found})"))
                .help("type an ordinary blank; any text is free in comments, after `!`")
        }
        Some(twin) if !is_full_width(character) => other_sign(character, &twin.to_string(), span),
        Some(twin) => Diagnostic::new(
            codes::BAD_CHARACTER,
            span,
            format!("expected ASCII `{twin}`, found its full-width form ({found})"),
        )
        .help(format!("type `{twin}` with the input method off")),
        None => Diagnostic::new(
            codes::BAD_CHARACTER,
            span,
            format!("expected a name, a number or punctuation, found {found}"),
        )
        .help("outside comments only ASCII letters, digits and punctuation have a meaning"),
    }
}

/// Whether a twin of an ASCII character differs from it in its width alone.
fn is_full_width(character: char) -> bool {
    matches!(character, NOT_TEXT | '\u{3001}' | '\u{3002}' | '\u{ff01}'..='\u{ff64}')
}

/// A sign that an editor, or a font, puts in the place of an ASCII one.
fn other_sign(character: char, sign: &str, span: Span) -> Diagnostic {
    let message = format!("expected ASCII `{sign}`, found another sign (`{character}`, U+{:04X})", character as u32);
    Diagnostic::new(codes::BAD_CHARACTER, span, message).help(format!("type `{sign}`"))
}
