//! What the parser expected, in the words of the language.

use super::lines::is_sign;
use crate::lexer::{Key, Lexeme, Token};

pub(super) fn form_help(tokens: &[Lexeme]) -> &'static str {
    match tokens.first().map(|lexeme| lexeme.token) {
        Some(Token::Key(Key::Control)) => "a section is `CONTROL [n [offset]]`",
        Some(Token::Key(_)) => "a section word stands alone on its line",
        _ if calls_in_expression(tokens) => {
            "a call with `:` has a line of its own: give its output a name, and use that in the expression"
        }
        _ if tokens.iter().any(|lexeme| lexeme.token == Token::Becomes) => {
            "a block is `[number] [outputs] = code ( inputs : parameters )`, or without `:` an expression"
        }
        _ => "a block is `[number] [outputs] = code ( inputs : parameters )`",
    }
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
