//! A document before it is written in one notation or another.

use super::{html, markdown};

/// A document.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Document {
    /// What it is about.
    pub title: String,
    /// The first one has the title's level.
    pub sections: Vec<Section>,
}

/// A section.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Section {
    /// 1 is the document's title, 2 a chapter, 3 a section of one.
    pub level: u8,
    /// Its title.
    pub title: String,
    /// What stands in it.
    pub content: Vec<Content>,
}

/// What stands in a section.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Content {
    /// A paragraph.
    Words(String),
    /// Lines as they stand.
    Code(String),
    /// A table.
    Table(Table),
    /// The net's picture.
    Picture,
}

/// A table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    /// Titles and styles of its columns.
    pub columns: Vec<(&'static str, Style)>,
    /// As many cells each as there are columns.
    pub rows: Vec<Vec<Cell>>,
}

/// The lines of a cell.
pub type Cell = Vec<String>;

/// How a column is set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// As words.
    Words,
    /// As the language writes it.
    Code,
    /// Numbers, at the right.
    Number,
}

impl Document {
    /// The document in Markdown. `picture`: the name of the file with the picture.
    pub fn markdown(&self, picture: &str) -> String {
        markdown::write(self, picture)
    }

    /// The document as one HTML file. `picture`: the picture's SVG.
    pub fn html(&self, picture: &str) -> String {
        html::write(self, picture)
    }
}

impl Section {
    /// A section.
    pub(crate) fn new(level: u8, title: &str, content: Vec<Content>) -> Section {
        Section { level, title: title.to_owned(), content }
    }

    /// A section with a table; without rows it is empty. Columns without any text are left out.
    pub(crate) fn table(title: &str, columns: &[(&'static str, Style)], rows: Vec<Vec<Cell>>) -> Section {
        let content = if rows.is_empty() { Vec::new() } else { vec![Content::Table(table(columns, rows))] };
        Section::new(2, title, content)
    }
}

/// A table without the columns in which nothing stands.
pub(crate) fn table(columns: &[(&'static str, Style)], rows: Vec<Vec<Cell>>) -> Table {
    let used: Vec<bool> = (0..columns.len())
        .map(|i| i == 0 || rows.iter().any(|row| row[i].iter().any(|line| !line.is_empty())))
        .collect();
    let kept =
        |cells: Vec<Cell>| cells.into_iter().zip(&used).filter(|(_, used)| **used).map(|(cell, _)| cell).collect();
    let columns = columns.iter().zip(&used).filter(|(_, used)| **used).map(|(column, _)| *column).collect();
    Table { columns, rows: rows.into_iter().map(kept).collect() }
}

/// A cell of one line.
pub(crate) fn cell(text: impl Into<String>) -> Cell {
    vec![text.into()]
}
