//! Where a blank stands between two tokens of a statement, and where a line may be broken.

use super::read::Piece;
use crate::lexer::Token;

/// What surrounds each token of a statement.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Around {
    /// A blank stands before it.
    pub(super) blank: bool,
    /// A line may be broken before it.
    pub(super) may_break: bool,
    /// It is the `:` of the call.
    pub(super) colon: bool,
}

/// What a parenthesis or bracket encloses.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Nest {
    /// The lists of a call of a function code.
    Call,
    /// A part of an expression.
    Group,
    /// An index.
    Index,
}

/// Looks at the tokens of one statement. `calls`: the parentheses that open lists.
pub(super) fn around(pieces: &[Piece], calls: &[usize]) -> Vec<Around> {
    let mut nests: Vec<Nest> = Vec::new();
    let mut around = Vec::with_capacity(pieces.len());
    let mut sign = false;
    for (i, piece) in pieces.iter().enumerate() {
        let previous = i.checked_sub(1).map(|previous| pieces[previous].token);
        let nest = nests.last().copied();
        let blank = previous.is_some_and(|previous| !sign && blank(previous, piece.token, nest, calls.contains(&i)));
        sign = is_sign(previous, piece.token);
        let colon = piece.token == Token::Colon && nests == [Nest::Call];
        let inside = matches!(nest, Some(Nest::Call | Nest::Group));
        let binary = matches!(piece.token, Token::Plus | Token::Minus) && !sign;
        let may_break = inside && (previous == Some(Token::Comma) || colon || binary);
        around.push(Around { blank, may_break, colon });
        match piece.token {
            Token::LeftParen if calls.contains(&i) => nests.push(Nest::Call),
            Token::LeftParen => nests.push(Nest::Group),
            Token::LeftBracket => nests.push(Nest::Index),
            Token::RightParen | Token::RightBracket => drop(nests.pop()),
            _ => {}
        }
    }
    around
}

/// The parenthesis that opens the lists of a call: a `:` stands in it, or nothing.
pub(super) fn call(pieces: &[Piece]) -> Option<usize> {
    let equals = pieces.iter().position(|piece| piece.token == Token::Equals)?;
    let open = equals + 2;
    if pieces.get(open)?.token != Token::LeftParen {
        return None;
    }
    let mut depth = 0_u32;
    let colon = pieces[open..].iter().any(|piece| {
        match piece.token {
            Token::LeftParen => depth += 1,
            Token::RightParen => depth = depth.saturating_sub(1),
            _ => {}
        }
        depth == 1 && piece.token == Token::Colon
    });
    colon.then_some(open)
}

/// A `+` or `-` that belongs to what follows it.
fn is_sign(previous: Option<Token>, token: Token) -> bool {
    let operand = matches!(
        previous,
        Some(Token::Name | Token::Int | Token::Real | Token::RightParen | Token::RightBracket | Token::Dot)
    );
    matches!(token, Token::Plus | Token::Minus) && !operand
}

fn blank(previous: Token, token: Token, nest: Option<Nest>, opens_call: bool) -> bool {
    match (previous, token) {
        _ if nest == Some(Nest::Index) => false,
        (Token::LeftParen, _) => nest == Some(Nest::Call),
        (_, Token::LeftParen) if previous == Token::Name => opens_call,
        (_, Token::RightParen) => nest == Some(Nest::Call),
        (Token::Comma, _) => nest != Some(Nest::Index),
        (Token::Colon, Token::Comma) => true,
        (_, Token::Comma) => false,
        (Token::Dot | Token::LeftBracket, _) | (_, Token::Dot | Token::LeftBracket | Token::RightBracket) => false,
        (Token::Star | Token::Slash, _) | (_, Token::Star | Token::Slash) => false,
        _ => true,
    }
}
