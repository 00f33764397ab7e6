//! A page as the terminal shows it.

use super::facts::{Row, faults, program, rules, shows, signature, tables};
use crate::decl::Decl;
use std::fmt::Write;

/// The page of one function code.
pub fn page(decl: &Decl) -> String {
    let mut text = format!("{}\n\n", signature(decl));
    for line in decl.doc.lines() {
        let _ = writeln!(text, "{}", format!("  {line}").trim_end());
    }
    for table in tables(decl) {
        section(&mut text, table.title, &table.rows);
    }
    let mut words: Vec<(&str, String)> = rules(decl);
    words.extend(faults(decl).into_iter().map(|(name, says)| (name, format!("Fault: {says}."))));
    let width = words.iter().map(|(word, _)| word.len()).max().unwrap_or(0);
    if !words.is_empty() {
        text.push_str("\nRules\n");
    }
    for (word, says) in words {
        let _ = writeln!(text, "  {word:width$}  {says}");
    }
    for example in &decl.examples {
        let _ = writeln!(text, "\nExample, {}", shows(example));
        for line in program(example) {
            let _ = writeln!(text, "  {line}");
        }
    }
    text
}

fn section(text: &mut String, title: &str, rows: &[Row]) {
    let _ = writeln!(text, "\n{title}");
    let shown = |row: &Row| {
        let [name, ty, unit, default, range, note] = row;
        let default = if default.is_empty() { String::new() } else { format!("= {default}") };
        [name.clone(), ty.clone(), default, unit.clone(), range.clone(), note.clone()]
    };
    let rows: Vec<Row> = rows.iter().map(shown).collect();
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..rows.first().map_or(0, |row| row.len())).map(width).collect();
    for row in &rows {
        let mut line = String::new();
        for (cell, width) in row.iter().zip(&widths).filter(|(_, width)| **width > 0) {
            let _ = write!(line, "  {cell:width$}");
        }
        let _ = writeln!(text, "{}", line.trim_end());
    }
}
