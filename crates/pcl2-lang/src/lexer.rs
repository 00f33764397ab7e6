//! Text -> tokens. The lexer cannot fail: what it does not know becomes [`Token::Bad`].

use logos::Logos;

/// A token of `.cfg`, `.fc` and `.net` files. Values stand in the text.
#[derive(Logos, Clone, Copy, Debug, PartialEq, Eq)]
#[logos(skip r"[ \t]+")]
#[logos(skip(r"![^\r\n]*", allow_greedy = true))]
pub enum Token {
    /// LF, CR LF or CR.
    #[regex(r"\r\n|\n|\r")]
    Newline,
    /// A name.
    #[regex(r"[A-Za-z][A-Za-z0-9_]*")]
    Name,
    /// `_`, or a name that wrongly starts with it.
    #[regex(r"_[A-Za-z0-9_]*")]
    Underscore,
    /// Digits.
    #[regex(r"[0-9]+")]
    Int,
    /// A number with a dot or an exponent; no sign outside the exponent.
    #[regex(r"[0-9]+\.[0-9]*([eE][+-]?[0-9]+)?")]
    #[regex(r"\.[0-9]+([eE][+-]?[0-9]+)?")]
    #[regex(r"[0-9]+[eE][+-]?[0-9]+")]
    Real,
    /// `"..."`
    #[regex(r#""[^"\r\n]*""#)]
    Text,
    /// A string without its closing quote.
    #[regex(r#""[^"\r\n]*"#)]
    OpenText,
    /// `(`
    #[token("(")]
    LeftParen,
    /// `)`
    #[token(")")]
    RightParen,
    /// `[`
    #[token("[")]
    LeftBracket,
    /// `]`
    #[token("]")]
    RightBracket,
    /// `{`
    #[token("{")]
    LeftBrace,
    /// `}`
    #[token("}")]
    RightBrace,
    /// `,`
    #[token(",")]
    Comma,
    /// `:`
    #[token(":")]
    Colon,
    /// `=`
    #[token("=")]
    Equals,
    /// `.`
    #[token(".")]
    Dot,
    /// `+`
    #[token("+")]
    Plus,
    /// `-`
    #[token("-")]
    Minus,
    /// `*`
    #[token("*")]
    Star,
    /// `/`
    #[token("/")]
    Slash,
    /// `<`
    #[token("<")]
    Less,
    /// `<=`
    #[token("<=")]
    LessEqual,
    /// `>`
    #[token(">")]
    Greater,
    /// `>=`
    #[token(">=")]
    GreaterEqual,
    /// `==`
    #[token("==")]
    Same,
    /// `<>`
    #[token("<>")]
    Differ,
    /// `->`
    #[token("->")]
    Arrow,
    /// The `=` before an expression; never produced by the lexer itself.
    Becomes,
    /// A reserved word of the file's kind; never produced by the lexer itself.
    Key(Key),
    /// Anything else.
    Bad,
}

/// Reserved words: the sections of `.cfg`, the words of `.fc` and of `.net`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Key {
    Initialize,
    Plant,
    Control,
    End,
    Int,
    Real,
    Ivec,
    Vec,
    Imat,
    Mat,
    Text,
    Time,
    Inout,
    Cell,
    Fixed,
    From,
    Above,
    To,
    Tracks,
    Memory,
    Work,
    Tuned,
    Start,
    Retain,
    Return,
    Period,
    Check,
    Image,
    Faults,
    Bad,
    Inline,
    Simulated,
    Operator,
    Example,
    After,
    Body,
    And,
    Or,
    Not,
    Momentary,
    Local,
    Class,
    State,
    Capacity,
    Timer,
    Count,
    Operation,
    Signal,
    Process,
    Generate,
    Entry,
    Exit,
    Macro,
    Module,
    Gate,
    If,
    Else,
    Then,
    New,
    Nothing,
    Do,
    Until,
    Within,
    When,
    Of,
    Size,
    Order,
    Marked,
    Drives,
    Read,
    Inhibit,
    Priority,
    Permit,
    Abort,
    Active,
    For,
    Next,
    Upto,
    Mode,
    Stop,
    Hold,
    Blocked,
}

impl Key {
    /// Whether the word is written in capitals: it begins a line, a section or a clause.
    pub fn begins_line(self) -> bool {
        match self {
            Key::Int | Key::Real | Key::Ivec | Key::Vec | Key::Imat | Key::Mat | Key::Text | Key::Time => false,
            Key::Inout | Key::Cell | Key::Fixed | Key::From | Key::Above | Key::To | Key::Tracks => false,
            Key::Initialize | Key::Plant | Key::Control | Key::End | Key::Memory | Key::Work | Key::Tuned => true,
            Key::Start | Key::Retain | Key::Return | Key::Period | Key::Check | Key::Image | Key::Faults | Key::Bad => {
                true
            }
            Key::Inline | Key::Simulated | Key::Operator | Key::Example | Key::After | Key::Body => true,
            Key::And | Key::Or | Key::Not | Key::New | Key::Nothing | Key::Of | Key::Size | Key::Order => false,
            Key::Marked | Key::Drives | Key::Read | Key::Inhibit | Key::Priority | Key::Permit => false,
            Key::Until | Key::Within | Key::When | Key::Upto | Key::Hold => false,
            Key::Momentary | Key::Local | Key::Class | Key::Mode | Key::Stop | Key::Blocked => true,
            Key::State | Key::Capacity | Key::Timer | Key::Count | Key::Operation | Key::Signal | Key::Process => true,
            Key::Generate | Key::Entry | Key::Exit | Key::Macro | Key::Module | Key::Gate | Key::If | Key::Else => true,
            Key::Then | Key::Do | Key::Abort | Key::Active | Key::For | Key::Next => true,
        }
    }
}

/// The section words and those of expressions: reserved in `.cfg` files.
pub const SECTION_WORDS: [(&str, Key); 7] = [
    ("INITIALIZE", Key::Initialize),
    ("PLANT", Key::Plant),
    ("CONTROL", Key::Control),
    ("END", Key::End),
    ("AND", Key::And),
    ("OR", Key::Or),
    ("NOT", Key::Not),
];

/// The words of declarations: reserved in `.fc` files.
pub const DECLARATION_WORDS: [(&str, Key); 33] = [
    ("END", Key::End),
    ("int", Key::Int),
    ("real", Key::Real),
    ("ivec", Key::Ivec),
    ("vec", Key::Vec),
    ("imat", Key::Imat),
    ("mat", Key::Mat),
    ("text", Key::Text),
    ("time", Key::Time),
    ("inout", Key::Inout),
    ("cell", Key::Cell),
    ("fixed", Key::Fixed),
    ("from", Key::From),
    ("above", Key::Above),
    ("to", Key::To),
    ("tracks", Key::Tracks),
    ("MEMORY", Key::Memory),
    ("WORK", Key::Work),
    ("TUNED", Key::Tuned),
    ("START", Key::Start),
    ("RETAIN", Key::Retain),
    ("RETURN", Key::Return),
    ("PERIOD", Key::Period),
    ("CHECK", Key::Check),
    ("IMAGE", Key::Image),
    ("FAULTS", Key::Faults),
    ("BAD", Key::Bad),
    ("INLINE", Key::Inline),
    ("SIMULATED", Key::Simulated),
    ("OPERATOR", Key::Operator),
    ("EXAMPLE", Key::Example),
    ("AFTER", Key::After),
    ("BODY", Key::Body),
];

/// The words of nets: reserved in `.net` files.
pub const NET_WORDS: [(&str, Key); 51] = [
    ("END", Key::End),
    ("int", Key::Int),
    ("real", Key::Real),
    ("AFTER", Key::After),
    ("TO", Key::Upto),
    ("MOMENTARY", Key::Momentary),
    ("MODE", Key::Mode),
    ("START", Key::Start),
    ("STOP", Key::Stop),
    ("HOLD", Key::Hold),
    ("LOCAL", Key::Local),
    ("CLASS", Key::Class),
    ("STATE", Key::State),
    ("CAPACITY", Key::Capacity),
    ("TIME", Key::Timer),
    ("COUNT", Key::Count),
    ("OPERATION", Key::Operation),
    ("SIGNAL", Key::Signal),
    ("PROCESS", Key::Process),
    ("GENERATE", Key::Generate),
    ("ENTRY", Key::Entry),
    ("EXIT", Key::Exit),
    ("MACRO", Key::Macro),
    ("MODULE", Key::Module),
    ("GATE", Key::Gate),
    ("IF", Key::If),
    ("ELSE", Key::Else),
    ("THEN", Key::Then),
    ("NEW", Key::New),
    ("nothing", Key::Nothing),
    ("DO", Key::Do),
    ("UNTIL", Key::Until),
    ("WITHIN", Key::Within),
    ("WHEN", Key::When),
    ("OF", Key::Of),
    ("SIZE", Key::Size),
    ("ORDER", Key::Order),
    ("MARKED", Key::Marked),
    ("DRIVES", Key::Drives),
    ("READ", Key::Read),
    ("INHIBIT", Key::Inhibit),
    ("PRIORITY", Key::Priority),
    ("PERMIT", Key::Permit),
    ("ABORT", Key::Abort),
    ("ACTIVE", Key::Active),
    ("BLOCKED", Key::Blocked),
    ("FOR", Key::For),
    ("NEXT", Key::Next),
    ("AND", Key::And),
    ("OR", Key::Or),
    ("NOT", Key::Not),
];

/// The reserved words of a kind of file.
pub type ReservedWords = &'static [(&'static str, Key)];

/// A token and its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lexeme {
    /// The token.
    pub token: Token,
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

/// The tokens of a text, with the reserved words of its kind recognised.
#[derive(Clone)]
pub struct Lexer<'a> {
    inner: logos::Lexer<'a, Token>,
    words: &'static [(&'static str, Key)],
}

impl<'a> Lexer<'a> {
    /// Starts at the text's beginning.
    pub fn new(text: &'a str, words: &'static [(&'static str, Key)]) -> Lexer<'a> {
        Lexer { inner: Token::lexer(text), words }
    }

    /// Changes which words are reserved from here on.
    pub fn set_words(&mut self, words: &'static [(&'static str, Key)]) {
        self.words = words;
    }

    /// Goes on at a byte of the text.
    pub fn jump(&mut self, byte: u32) {
        let text = self.inner.source();
        let mut byte = (byte as usize).min(text.len());
        while !text.is_char_boundary(byte) {
            byte += 1;
        }
        let mut inner = Token::lexer(text);
        inner.bump(byte);
        self.inner = inner;
    }
}

impl Iterator for Lexer<'_> {
    type Item = Lexeme;

    fn next(&mut self) -> Option<Lexeme> {
        let token = self.inner.next()?.unwrap_or(Token::Bad);
        let span = self.inner.span();
        let token = match token {
            Token::Name => reserved(self.inner.slice(), self.words),
            other => other,
        };
        Some(Lexeme { token, start: span.start as u32, end: span.end as u32 })
    }
}

fn reserved(name: &str, words: &[(&str, Key)]) -> Token {
    let longest = 10;
    if name.len() > longest {
        return Token::Name;
    }
    words.iter().find(|(word, _)| *word == name).map_or(Token::Name, |(_, key)| Token::Key(*key))
}

/// The ASCII character that a full-width or ideographic one stands for.
pub fn ascii_of(character: char) -> Option<char> {
    match character {
        '\u{3000}' | '\u{a0}' => Some(' '),
        '\u{3001}' | '\u{ff64}' => Some(','),
        '\u{3002}' => Some('.'),
        '\u{ff01}'..='\u{ff5e}' => char::from_u32(character as u32 - 0xff01 + 0x21),
        '\u{201c}' | '\u{201d}' => Some('"'),
        '\u{2212}' | '\u{2013}' => Some('-'),
        _ => None,
    }
}

/// The same for two bytes of EUC-KR, EUC-JP or Shift-JIS.
pub fn ascii_of_bytes(first: u8, second: u8) -> Option<char> {
    match (first, second) {
        (0xa1, 0xa1) | (0x81, 0x40) => Some(' '),
        (0xa3, 0xa1..=0xfe) => Some(char::from(second & 0x7f)),
        (0x81, 0x43) => Some(','),
        (0x81, 0x44) => Some('.'),
        (0x81, 0x46) => Some(':'),
        (0x81, 0x69) => Some('('),
        (0x81, 0x6a) => Some(')'),
        (0x81, 0x81) => Some('='),
        _ => None,
    }
}

/// What is written in ASCII for a sign of mathematics, and its token.
pub fn sign_of(character: char) -> Option<(&'static str, Token)> {
    match character {
        '→' | '⇒' => Some(("->", Token::Arrow)),
        '≠' => Some(("<>", Token::Differ)),
        '≤' => Some(("<=", Token::LessEqual)),
        '≥' => Some((">=", Token::GreaterEqual)),
        _ => None,
    }
}

/// The token of one ASCII punctuation character.
pub fn token_of(character: char) -> Option<Token> {
    match character {
        '(' => Some(Token::LeftParen),
        ')' => Some(Token::RightParen),
        '[' => Some(Token::LeftBracket),
        ']' => Some(Token::RightBracket),
        ',' => Some(Token::Comma),
        ':' => Some(Token::Colon),
        '=' => Some(Token::Equals),
        '.' => Some(Token::Dot),
        '+' => Some(Token::Plus),
        '-' => Some(Token::Minus),
        '*' => Some(Token::Star),
        '/' => Some(Token::Slash),
        '<' => Some(Token::Less),
        '>' => Some(Token::Greater),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tokens(text: &str) -> Vec<Token> {
        Lexer::new(text, &SECTION_WORDS).map(|lexeme| lexeme.token).collect()
    }

    #[test]
    fn numbers_have_no_sign_and_a_dot_may_end_them() {
        assert_eq!(
            tokens("100. -1.5e-3 .5 1e5 7"),
            [Token::Real, Token::Minus, Token::Real, Token::Real, Token::Real, Token::Int]
        );
        assert_eq!(tokens("1.5.,"), [Token::Real, Token::Dot, Token::Comma]);
    }

    #[test]
    fn anything_lexes() {
        assert_eq!(tokens("\u{1a}"), [Token::Bad]);
        assert_eq!(tokens("\"abc\n"), [Token::OpenText, Token::Newline]);
        assert_eq!(tokens("a ! \u{1a}\u{1a} b\rEND"), [Token::Name, Token::Newline, Token::Key(Key::End)]);
        assert_eq!(tokens("_ _x"), [Token::Underscore, Token::Underscore]);
    }

    #[test]
    fn full_width_characters_have_an_ascii_twin() {
        assert_eq!(ascii_of('（'), Some('('));
        assert_eq!(ascii_of('：'), Some(':'));
        assert_eq!(ascii_of_bytes(0xa3, 0xa8), Some('('));
    }
}
