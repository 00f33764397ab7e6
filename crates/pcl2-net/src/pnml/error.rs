//! Why a text is no place/transition net.

use roxmltree::{Node, TextPos};
use std::fmt;

/// What is wrong with a PNML text, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PnmlError {
    /// The line, from 1.
    pub line: u32,
    /// The column, from 1.
    pub column: u32,
    /// What was expected and what was found.
    pub message: String,
    /// What to do.
    pub help: String,
}

impl PnmlError {
    pub(super) fn new(at: TextPos, message: impl Into<String>, help: impl Into<String>) -> PnmlError {
        PnmlError { line: at.row, column: at.col, message: message.into(), help: help.into() }
    }

    pub(super) fn at(node: Node<'_, '_>, message: impl Into<String>, help: impl Into<String>) -> PnmlError {
        PnmlError::new(node.document().text_pos_at(node.range().start), message, help)
    }
}

impl fmt::Display for PnmlError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}:{}: {}; {}", self.line, self.column, self.message, self.help)
    }
}

/// Text of the file as it is quoted in a message: short, on one line.
pub(super) fn quoted(text: &str) -> String {
    const MOST: usize = 40;
    let mut short: String =
        text.chars().take(MOST).map(|letter| if letter.is_control() { ' ' } else { letter }).collect();
    if text.chars().nth(MOST).is_some() {
        short.push_str("..");
    }
    format!("`{short}`")
}
