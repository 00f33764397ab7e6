//! Where each name of a net stands: on which lines it is declared, read, written.

use super::document::{Cell, Section, Style, cell};
use pcl2_lang::lexer::{Key, Lexeme, Lexer, NET_WORDS, Token};
use pcl2_lang::net::written::WrittenNet;
use pcl2_lang::source::{SourceFile, Sources};
use std::collections::{BTreeMap, BTreeSet};

const COLUMNS: [(&str, Style); 5] = [
    ("name", Style::Code),
    ("is", Style::Words),
    ("declared", Style::Number),
    ("read or used on lines", Style::Words),
    ("written on lines", Style::Words),
];

/// The cross-reference of a net. A name with an index stands under the name alone.
pub(super) fn section(sources: &Sources, net: &WrittenNet<'_>) -> Section {
    let file = sources.file(net.decl.span.file);
    let mut names = names(net);
    Scanner::new(file).scan(&mut names);
    let rows = names.into_iter().map(|(name, seen)| row(name, &seen)).collect();
    Section::table("Cross-reference", &COLUMNS, rows)
}

/// What is known of a name.
struct Seen {
    what: &'static str,
    declared: Option<u32>,
    used: BTreeSet<u32>,
    written: BTreeSet<u32>,
}

fn row(name: String, seen: &Seen) -> Vec<Cell> {
    let lines = |lines: &BTreeSet<u32>| lines.iter().map(u32::to_string).collect::<Vec<_>>().join(", ");
    let declared = seen.declared.map_or_else(String::new, |line| line.to_string());
    vec![cell(name), cell(seen.what), cell(declared), cell(lines(&seen.used)), cell(lines(&seen.written))]
}

/// The names that a net declares. Gates and classes have names apart: a gate that is called as something else is not
/// listed, as nothing refers to it.
fn names(net: &WrittenNet<'_>) -> BTreeMap<String, Seen> {
    let mut names = BTreeMap::new();
    let mut add = |name: &str, what: &'static str| {
        let name = name.split('[').next().unwrap_or(name).to_owned();
        let (used, written) = (BTreeSet::new(), BTreeSet::new());
        names.entry(name).or_insert(Seen { what, declared: None, used, written });
    };
    net.net.parts.iter().filter(|part| part.place.is_none()).for_each(|part| add(&part.name, "module"));
    net.net.boxes.iter().for_each(|place| add(&place.name, "box"));
    net.decl.ports().for_each(|port| add(&port.name, "input"));
    net.decl.params.iter().for_each(|param| add(&param.name, "parameter"));
    let outputs = net.net.outputs;
    net.net.words.iter().take(outputs).for_each(|word| add(&word.name, "output"));
    net.net.words.iter().skip(outputs).for_each(|word| add(&word.name, "local"));
    names
}

/// Words behind which one name is declared: a box, a part.
const BOXES: [Key; 10] = [
    Key::State,
    Key::Capacity,
    Key::Timer,
    Key::Count,
    Key::Operation,
    Key::Signal,
    Key::Process,
    Key::Generate,
    Key::Entry,
    Key::Exit,
];
const PARTS: [Key; 2] = [Key::Macro, Key::Module];

/// Words behind which names are written, and words behind which they belong to something else.
const WRITES: [Key; 3] = [Key::Drives, Key::Active, Key::Start];
const OTHERS: [Key; 3] = [Key::Gate, Key::Class, Key::Order];

/// Words that change nothing.
const INNER: [Key; 5] = [Key::Int, Key::Real, Key::And, Key::Or, Key::Not];

/// What names are in a place of a line.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Mode {
    /// They are declared.
    Declares,
    /// The next one is declared, those behind it are used.
    DeclaresBox,
    /// The next one is declared, those behind the colon are written.
    DeclaresPart,
    /// They are used.
    Uses,
    /// They are written.
    Writes,
    /// They belong to something else: the names of gates, of classes and of their attributes.
    Other,
}

/// Goes through the tokens of a net.
struct Scanner<'a> {
    file: &'a SourceFile,
    lexemes: Vec<Lexeme>,
    mode: Mode,
    depth: usize,
}

impl<'a> Scanner<'a> {
    fn new(file: &'a SourceFile) -> Scanner<'a> {
        let lexemes = Lexer::new(&file.text, &NET_WORDS).collect();
        Scanner { file, lexemes, mode: Mode::Declares, depth: 0 }
    }

    fn token(&self, at: usize) -> Option<Token> {
        self.lexemes.get(at).map(|lexeme| lexeme.token)
    }

    fn scan(&mut self, names: &mut BTreeMap<String, Seen>) {
        let mut head = true;
        for at in 0..self.lexemes.len() {
            let Lexeme { token, start, end } = self.lexemes[at];
            match token {
                Token::LeftParen => self.depth += 1,
                Token::RightParen => self.depth = self.depth.saturating_sub(1),
                Token::Newline if head && self.depth == 0 => head = self.is_empty_so_far(at),
                Token::Key(key) if !head => self.enter(key, at),
                Token::Equals if self.depth == 0 && !head => self.mode = self.after_equals(),
                Token::Colon if self.depth == 0 && !head => self.mode = self.after_colon(),
                Token::Name if !self.is_foreign(at, head) => {
                    let text = self.file.text.get(start as usize..end as usize).unwrap_or("");
                    let line = self.file.position(start).line;
                    if let Some(seen) = names.get_mut(text) {
                        seen.see(self.mode, line);
                    }
                    if self.mode == Mode::DeclaresBox {
                        self.mode = Mode::Uses;
                    }
                }
                _ => {}
            }
        }
    }

    /// Whether nothing stands before a token but line ends.
    fn is_empty_so_far(&self, at: usize) -> bool {
        self.lexemes[..at].iter().all(|lexeme| lexeme.token == Token::Newline)
    }

    /// A name that is no name of the net: behind a dot, of a function code, a label, a default's name in the head.
    fn is_foreign(&self, at: usize, head: bool) -> bool {
        let before = at.checked_sub(1).and_then(|before| self.token(before));
        let after = self.token(at + 1);
        let is_code = after == Some(Token::LeftParen);
        let is_label = !head && self.depth > 0 && after == Some(Token::Equals);
        before == Some(Token::Dot) || is_code || is_label || self.mode == Mode::Other
    }

    /// What names are behind a word.
    fn enter(&mut self, key: Key, at: usize) {
        let has = |keys: &[Key]| keys.contains(&key);
        self.mode = match key {
            Key::Local => Mode::Declares,
            Key::Do | Key::After if self.has_equals(at) => Mode::Writes,
            Key::Of if !self.is_active(at) => Mode::Other,
            _ if has(&BOXES) => Mode::DeclaresBox,
            _ if has(&PARTS) => Mode::DeclaresPart,
            _ if has(&WRITES) => Mode::Writes,
            _ if has(&OTHERS) => Mode::Other,
            _ if has(&INNER) => self.mode,
            _ => Mode::Uses,
        };
    }

    /// Whether an OF belongs to ACTIVE: boxes stand behind it, and no class.
    fn is_active(&self, at: usize) -> bool {
        let line = self.lexemes[..at].iter().rev().take_while(|lexeme| lexeme.token != Token::Newline);
        line.last().is_some_and(|first| first.token == Token::Key(Key::Active))
    }

    /// Whether a statement has outputs.
    fn has_equals(&self, at: usize) -> bool {
        let line = self.lexemes[at..].iter().take_while(|lexeme| lexeme.token != Token::Newline);
        line.into_iter().any(|lexeme| lexeme.token == Token::Equals)
    }

    fn after_equals(&self) -> Mode {
        match self.mode {
            Mode::Writes | Mode::DeclaresPart => Mode::Uses,
            Mode::Declares | Mode::DeclaresBox | Mode::Uses | Mode::Other => self.mode,
        }
    }

    /// Behind the name of a gate its boxes stand, behind that of a part its outputs.
    fn after_colon(&self) -> Mode {
        match self.mode {
            Mode::DeclaresPart => Mode::Writes,
            Mode::Declares | Mode::DeclaresBox | Mode::Other | Mode::Uses | Mode::Writes => Mode::Uses,
        }
    }
}

impl Seen {
    fn see(&mut self, mode: Mode, line: u32) {
        match mode {
            Mode::Declares | Mode::DeclaresBox | Mode::DeclaresPart if self.declared.is_none() => {
                self.declared = Some(line);
            }
            Mode::Writes => {
                self.written.insert(line);
            }
            Mode::Declares | Mode::DeclaresBox | Mode::DeclaresPart | Mode::Uses | Mode::Other => {
                self.used.insert(line);
            }
        }
    }
}
