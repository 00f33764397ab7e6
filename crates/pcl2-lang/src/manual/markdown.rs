//! The whole catalogue as one document.

use super::facts::{HEADS, Table, faults, program, rules, shows, signature, tables};
use super::{explanation, summary};
use crate::catalogue::Catalogue;
use crate::decl::Decl;
use std::fmt::Write;

const HEAD: &str = "\
# Function codes

This page is made from the declarations in `blocks`; `cargo xtask docs` writes it. `pcl2 blocks NAME` shows the same on
the terminal, with all examples. Every example is tested.

A call is `outputs = code ( inputs : parameters )`. An input in `[ ]` is optional; left empty it has its default, and an
operator cell is written by the operator. A name with `..` stands for a group of ports. A fixed parameter is known when
the program is compiled; all others can be tuned while it runs. `language.md` has the rules of the language, and what a
bad signal is.

";

/// The manual page of the catalogue.
pub fn document(catalogue: &Catalogue) -> String {
    let decls: Vec<&Decl> = catalogue.decls().filter(|decl| !decl.user).collect();
    let mut text = HEAD.to_owned();
    for decls in groups(&decls) {
        let _ = writeln!(text, "**{}**\n", title(&decls[0].group));
        text.push_str("| code | |\n|---|---|\n");
        for decl in decls {
            let _ = writeln!(text, "| [`{}`](#{}) | {} |", decl.name, anchor(decl), escaped(&summary(decl)));
        }
        text.push('\n');
    }
    for decls in groups(&decls) {
        let _ = writeln!(text, "## {}\n", title(&decls[0].group));
        for decl in decls {
            describe(&mut text, decl);
        }
    }
    text.truncate(text.trim_end().len());
    text.push('\n');
    text
}

fn groups<'d>(decls: &'d [&'d Decl]) -> impl Iterator<Item = &'d [&'d Decl]> {
    decls.chunk_by(|a, b| a.group == b.group)
}

fn title(group: &str) -> String {
    let mut letters = group.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// Headings of groups may have the same words as codes; places of codes have a prefix.
fn anchor(decl: &Decl) -> String {
    format!("code-{}", decl.name)
}

fn describe(text: &mut String, decl: &Decl) {
    let _ = writeln!(text, "<a id=\"{}\"></a>\n\n### {}\n", anchor(decl), decl.name);
    let _ = writeln!(text, "```\n{}\n```\n\n{}\n", signature(decl), escaped(&summary(decl)));
    let explanation = explanation(decl);
    if !explanation.is_empty() {
        let _ = writeln!(text, "```text\n{explanation}\n```\n");
    }
    for table in tables(decl) {
        table_text(text, &table);
    }
    for (word, says) in rules(decl) {
        let _ = writeln!(text, "- **{word}.** {}", escaped(&says));
    }
    for (name, says) in faults(decl) {
        let _ = writeln!(text, "- **Fault `{name}`.** {}.", escaped(says));
    }
    let _ = writeln!(text, "- **Declared in** [`{0}`](../{0}).", place(decl));
    text.push('\n');
    if let Some(example) = decl.examples.first() {
        // An example without section words is all CONTROL.
        let section = if program(example).any(|line| line == "CONTROL") { "" } else { "CONTROL\n" };
        let _ = write!(text, "Example, {}:\n\n```pcl2\n{section}", escaped(&shows(example)));
        for line in program(example) {
            let _ = writeln!(text, "{line}");
        }
        text.push_str("END\n```\n\n");
    }
}

fn place(decl: &Decl) -> String {
    format!("blocks/{}/{}.fc", decl.group, decl.stem)
}

/// A table without its empty columns.
fn table_text(text: &mut String, table: &Table) {
    let filled = |column: &usize| *column == 0 || table.rows.iter().any(|row| !row[*column].is_empty());
    let columns: Vec<usize> = (0..HEADS.len()).filter(filled).collect();
    let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    let heads = columns.iter().map(|column| if *column == 0 { table.title } else { HEADS[*column] }.to_owned());
    text.push_str(&line(heads.collect()));
    text.push_str(&format!("|{}\n", "---|".repeat(columns.len())));
    for row in &table.rows {
        let cell = |column: &usize| match (*column, row[*column].as_str()) {
            (_, "") => String::new(),
            (0 | 1 | 3, cell) => format!("`{cell}`"),
            (_, cell) => escaped(cell),
        };
        text.push_str(&line(columns.iter().map(cell).collect()));
    }
    text.push('\n');
}

/// Text in which no character is a sign of Markdown; what stands between back quotes stays.
fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for (i, part) in text.split('`').enumerate() {
        if i > 0 {
            escaped.push('`');
        }
        for letter in part.chars() {
            if i % 2 == 0 && matches!(letter, '\\' | '*' | '_' | '<' | '>' | '[' | ']' | '|' | '#' | '~') {
                escaped.push('\\');
            }
            escaped.push(letter);
        }
    }
    escaped
}
