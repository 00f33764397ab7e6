//! A document in Markdown, as most readers of it understand it: tables with pipes, breaks within cells.

use super::document::{Cell, Content, Document, Style, Table};
use std::fmt::Write;

/// Writes a document.
pub(super) fn write(document: &Document, picture: &str) -> String {
    let mut text = String::new();
    for section in &document.sections {
        let _ = writeln!(text, "{} {}\n", "#".repeat(usize::from(section.level)), words(&section.title));
        for content in &section.content {
            match content {
                Content::Words(paragraph) => {
                    let _ = writeln!(text, "{}\n", words(paragraph));
                }
                Content::Code(lines) => {
                    let _ = writeln!(text, "```text\n{}\n```\n", lines.trim_end());
                }
                Content::Table(table) => put_table(&mut text, table),
                Content::Picture => {
                    let _ = writeln!(text, "![{}]({})\n", words(&document.title), address(picture));
                }
            }
        }
    }
    text.truncate(text.trim_end().len());
    text.push('\n');
    text
}

fn put_table(text: &mut String, table: &Table) {
    let heads = table.columns.iter().map(|(head, _)| words(head));
    let _ = writeln!(text, "| {} |", heads.collect::<Vec<_>>().join(" | "));
    let rules = table.columns.iter().map(|(_, style)| if *style == Style::Number { "---:" } else { "---" });
    let _ = writeln!(text, "|{}|", rules.collect::<Vec<_>>().join("|"));
    for row in &table.rows {
        let cells = row.iter().zip(&table.columns).map(|(cell, (_, style))| cell_text(cell, *style));
        let _ = writeln!(text, "| {} |", cells.collect::<Vec<_>>().join(" | "));
    }
    text.push('\n');
}

fn cell_text(cell: &Cell, style: Style) -> String {
    let line = |line: &String| match style {
        Style::Words | Style::Number => words(line),
        Style::Code if line.is_empty() => String::new(),
        Style::Code => code(line),
    };
    cell.iter().map(line).collect::<Vec<_>>().join("<br>")
}

/// A code span. A pipe would end the cell; the fence is longer than any run of its sign within.
fn code(text: &str) -> String {
    let longest = text.split(|letter| letter != '`').map(str::len).max().unwrap_or(0);
    let fence = "`".repeat(longest + 1);
    let room = if longest > 0 { " " } else { "" };
    format!("{fence}{room}{}{room}{fence}", text.replace('|', "\\|"))
}

/// Words in which no sign means anything.
fn words(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        if matches!(letter, '\\' | '`' | '*' | '_' | '[' | ']' | '<' | '>' | '&' | '#' | '|' | '~' | '!' | '$') {
            escaped.push('\\');
        }
        escaped.push(if letter.is_control() { ' ' } else { letter });
    }
    escaped
}

/// A file's name as the address of a picture.
fn address(name: &str) -> String {
    let mut address = String::new();
    for byte in name.bytes() {
        if byte.is_ascii_alphanumeric() || matches!(byte, b'.' | b'-' | b'_' | b'/') {
            address.push(char::from(byte));
        } else {
            let _ = write!(address, "%{byte:02X}");
        }
    }
    address
}

#[cfg(test)]
mod tests {
    use super::{address, code, words};

    #[test]
    fn signs_mean_nothing_in_words() {
        assert_eq!(words("a_b <c> *d* | e"), "a\\_b \\<c\\> \\*d\\* \\| e");
        assert_eq!(code("a | b"), "`a \\| b`");
        assert_eq!(code("a `` b"), "``` a `` b ```");
        assert_eq!(address("a b.svg"), "a%20b.svg");
    }
}
