//! What the parser expected, in the words of the language.

use super::lines::is_sign;
use crate::lexer::{Key, Lexeme, Token};

pub(super) fn form_help(tokens: &[Lexeme]) -> &'static str {
    match tokens.first().map(|lexeme| lexeme.token) {
        Some(Token::Key(key)) => key_help(key),
        _ if calls_in_expression(tokens) => {
            "a call with `:` has a line of its own: give its output a name, and use that in the expression"
        }
        _ if tokens.iter().any(|lexeme| lexeme.token == Token::Becomes) => {
            "a block is `[number] [outputs] = code ( inputs : parameters )`, or without `:` an expression"
        }
        _ => "a block is `[number] [outputs] = code ( inputs : parameters )`",
    }
}

/// The form of a line that begins with this word.
fn key_help(key: Key) -> &'static str {
    match key {
        Key::Control => "a section is `CONTROL [n [offset]]`",
        Key::Initialize | Key::Plant | Key::End | Key::Body | Key::Else | Key::Next => {
            "this word stands alone on its line"
        }
        Key::Int | Key::Real | Key::Ivec | Key::Vec | Key::Imat | Key::Mat | Key::Text | Key::Time => HEAD,
        Key::Inout | Key::Cell | Key::Fixed | Key::From | Key::Above | Key::To | Key::Tracks => HEAD,
        Key::Memory | Key::Work | Key::Tuned => "such a line is `MEMORY type NAME, ..`, also with WORK or TUNED",
        Key::Start => "a line is `START name, ..` in a declaration, `START name = 1, ..` in a net",
        Key::Retain | Key::Return | Key::Momentary => "such a line is `WORD name, ..`",
        Key::Period | Key::Check | Key::Bad | Key::Inline | Key::Simulated | Key::Operator | Key::Image => {
            "the language reference lists the clauses of declarations"
        }
        Key::Faults => "such a line is `FAULTS name \"text\", ..`",
        Key::Example => "an example is `EXAMPLE name = value, .. [AFTER n] [PERIOD t]`",
        Key::State | Key::Entry | Key::Exit => "a box is `STATE name [MARKED] [DRIVES output, ..]`",
        Key::Capacity => "a box is `CAPACITY name [SIZE n] [OF class] [ORDER fifo] [MARKED n] [DRIVES output, ..]`",
        Key::Timer => "a box is `TIME name seconds [MARKED] [DRIVES output, ..]`",
        Key::Count => "a box is `COUNT name tokens [MARKED n] [DRIVES output, ..]`",
        Key::Operation | Key::Signal => "a box is `SIGNAL name [MARKED] [DRIVES output, ..] DO output = value`",
        Key::Process => "a box is `PROCESS name [UNTIL condition] [WITHIN seconds] [MARKED] [DRIVES output, ..]`",
        Key::Generate => "a box is `GENERATE name [OF class] [SIZE n] WHEN condition`",
        Key::Macro | Key::Module => "a net inside is `MACRO name : outputs = net ( inputs : parameters )`",
        Key::Gate => {
            "a gate is `GATE name : before, .. -> after, .. [READ ..] [INHIBIT ..] [PERMIT ..] [PRIORITY n] [IF condition]`"
        }
        Key::If => "a rule begins with `IF condition`; equality is `==`",
        Key::Then => "tokens move by `THEN box -> box, ..`, `THEN NEW -> box` or `THEN box -> nothing`",
        Key::Do | Key::After => "a statement is `DO output = value` or `DO outputs = code ( inputs : parameters )`",
        Key::Abort => "a macro is emptied by `ABORT condition -> box`",
        Key::Active => "such a line is `ACTIVE step, time OF box, ..`; the time may be left off",
        Key::Blocked => "such a line is `BLOCKED output`",
        Key::Class => "a class is `CLASS name ( int a = 0, real b )`",
        Key::Local => "such a line is `LOCAL int n = 0, real x`",
        Key::Mode => "such a line is `MODE mode, go, fire, put, take`; later ones may be left off",
        Key::Stop => "such a line is `STOP output = 1, output = HOLD`",
        Key::For => "lines are repeated by `FOR i = 1 TO n`, up to `NEXT`",
        Key::And | Key::Or | Key::Not | Key::New | Key::Nothing | Key::Of | Key::Size | Key::Order => INSIDE,
        Key::Marked | Key::Drives | Key::Read | Key::Inhibit | Key::Priority | Key::Permit => INSIDE,
        Key::Until | Key::Within | Key::When | Key::Upto | Key::Hold => INSIDE,
    }
}

pub(super) const HEAD: &str = "a head is `type output, .. = name ( type input, .. : type parameter = value, .. )`";
pub(super) const LINES: &str = "such as STATE, TIME, GATE, IF or DO: `pcl2 explain P0002`";
const INSIDE: &str = "no line begins with this word";

/// Where words belong that begin no line of a net.
const PLACES: [(&[Key], &str); 4] = [
    (&[Key::Read, Key::Inhibit, Key::Permit, Key::Priority], "it stands in the line of a gate, behind the boxes"),
    (
        &[Key::Of, Key::Size, Key::Order, Key::Marked, Key::Drives, Key::Until, Key::Within, Key::When],
        "it stands in the line of a box, behind the name",
    ),
    (&[Key::And, Key::Or, Key::Not], "a condition goes on in the next line only inside parentheses"),
    (&[Key::Int, Key::Real], "a net has one head, in its first line; a word of the net's own is `LOCAL int name`"),
];

pub(super) fn inside_help(key: Key) -> &'static str {
    PLACES.iter().find(|(keys, _)| keys.contains(&key)).map_or(LINES, |(_, help)| help)
}

/// Whether names behind the word are new ones.
pub(super) fn declares(key: Key) -> bool {
    let types =
        matches!(key, Key::Int | Key::Real | Key::Ivec | Key::Vec | Key::Imat | Key::Mat | Key::Text | Key::Time);
    let steps = matches!(key, Key::Operation | Key::Signal | Key::Process | Key::Generate);
    let boxes = matches!(key, Key::State | Key::Capacity | Key::Timer | Key::Count | Key::Entry | Key::Exit);
    let parts = matches!(key, Key::Macro | Key::Module | Key::Gate | Key::Class | Key::For | Key::Faults);
    types || steps || boxes || parts
}

/// Whether what stands between `=` and `:` looks like an expression.
fn calls_in_expression(tokens: &[Lexeme]) -> bool {
    let mut rest =
        tokens.iter().map(|lexeme| lexeme.token).skip_while(|token| *token != Token::Equals).skip(1).peekable();
    let operand = matches!(rest.peek(), Some(Token::LeftParen | Token::Int | Token::Real));
    let call = rest.clone().any(|token| token == Token::LeftParen);
    call && (operand || rest.take_while(|token| *token != Token::LeftParen).any(|token| is_sign(&token)))
}

/// `a`, `b` or `c`, in the words of the language.
pub(super) fn list(expected: &[String]) -> String {
    let mut words: Vec<&str> = expected.iter().map(|token| readable(token)).collect();
    words.sort_unstable_by_key(|word| (word.starts_with('`'), *word));
    words.dedup();
    let names_number = words.contains(&"a name") && words.contains(&"a number");
    if names_number {
        words.retain(|word| !matches!(*word, "`+`" | "`-`" | "`NOT`" | "a string" | "`_`"));
    }
    if words.contains(&"`*`") {
        words.retain(|word| !is_operator(word));
        words.push("an operator");
    }
    if words.contains(&"a clause word") {
        words.retain(|word| *word != "a section word");
    }
    match words.as_slice() {
        [] => "the end of the line".to_owned(),
        ["a clause word"] if expected.len() == 1 => format!("`{}`", expected[0].trim_matches('"')),
        [one] => (*one).to_owned(),
        [most @ .., last] => format!("{} or {last}", most.join(", ")),
    }
}

fn is_operator(word: &str) -> bool {
    matches!(word, "`+`" | "`-`" | "`*`" | "`/`" | "`<`" | "`<=`" | "`>`" | "`>=`" | "`==`" | "`<>`" | "`AND`" | "`OR`")
}

fn readable(token: &str) -> &str {
    match token.trim_matches('"') {
        "NEWLINE" => "the end of the line",
        "NAME" => "a name",
        "INT" => "a number",
        "REAL" => "a number",
        "TEXT" => "a string",
        "(" => "`(`",
        ")" => "`)`",
        "[" => "`[`",
        "]" => "`]`",
        "{" => "`{`",
        "}" => "`}`",
        "," => "`,`",
        ":" => "`:`",
        "=" | "becomes" => "`=`",
        "<" => "`<`",
        "<=" => "`<=`",
        ">" => "`>`",
        ">=" => "`>=`",
        "==" => "`==`",
        "<>" => "`<>`",
        "." => "`.`",
        "+" => "`+`",
        "-" => "`-`",
        "*" => "`*`",
        "/" => "`/`",
        "_" => "`_`",
        "AND" => "`AND`",
        "OR" => "`OR`",
        "NOT" => "`NOT`",
        "->" => "`->`",
        "INITIALIZE" | "PLANT" | "CONTROL" | "END" => "a section word",
        "int" | "real" | "ivec" | "vec" | "imat" | "mat" | "text" | "time" | "inout" => "a type",
        _ => "a clause word",
    }
}
