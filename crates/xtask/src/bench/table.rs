//! The table of what was measured.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

/// What a measurement is held against.
#[derive(Clone, Copy)]
pub(crate) enum Bar {
    /// The measured value is at least this.
    AtLeast(f64),
    /// The measured value is at most this.
    AtMost(f64),
    /// Measured over peer is at most this.
    Ratio(f64),
}

/// One line.
pub(crate) struct Row {
    /// What was measured.
    pub(crate) what: String,
    /// The unit of measured and peer.
    pub(crate) unit: &'static str,
    /// Ours.
    pub(crate) measured: f64,
    /// The peer's or the hand-written C's.
    pub(crate) peer: Option<f64>,
    /// Measured over peer, where a better one is known than the quotient.
    pub(crate) ratio: Option<f64>,
    /// None: for information.
    pub(crate) bar: Option<Bar>,
}

impl Row {
    /// A value for itself.
    pub(crate) fn value(what: impl Into<String>, measured: f64, unit: &'static str) -> Row {
        Row { what: what.into(), unit, measured, peer: None, ratio: None, bar: None }
    }

    /// With a bar.
    pub(crate) fn bar(self, bar: Bar) -> Row {
        Row { bar: Some(bar), ..self }
    }

    /// With a peer.
    pub(crate) fn peer(self, peer: f64, ratio: f64) -> Row {
        Row { peer: Some(peer), ratio: Some(ratio), ..self }
    }

    fn met(&self) -> Option<bool> {
        match self.bar? {
            Bar::AtLeast(bar) => Some(self.measured >= bar),
            Bar::AtMost(bar) => Some(self.measured <= bar),
            Bar::Ratio(bar) => self.ratio.map(|ratio| ratio <= bar),
        }
    }

    fn cells(&self, area: &str) -> [String; 7] {
        let bar = match self.bar {
            None => String::new(),
            Some(Bar::AtLeast(bar)) => format!(">= {}", short(bar)),
            Some(Bar::AtMost(bar)) => format!("<= {}", short(bar)),
            Some(Bar::Ratio(bar)) => format!("ratio <= {bar}"),
        };
        let verdict = match self.met() {
            None => "",
            Some(true) => "met",
            Some(false) => "missed",
        };
        [
            area.to_owned(),
            self.what.clone(),
            format!("{} {}", short(self.measured), self.unit).trim_end().to_owned(),
            self.peer.map(|peer| format!("{} {}", short(peer), self.unit)).unwrap_or_default(),
            self.ratio.map(|ratio| format!("{ratio:.2}")).unwrap_or_default(),
            bar,
            verdict.to_owned(),
        ]
    }
}

/// Three digits, and a letter for thousands and millions.
fn short(value: f64) -> String {
    let size = value.abs();
    match size {
        _ if size >= 1e6 => format!("{:.1} M", value / 1e6),
        _ if size >= 1e4 => format!("{:.0} k", value / 1e3),
        _ if size >= 100.0 || size.fract() == 0.0 => format!("{value:.0}"),
        _ if size >= 10.0 => format!("{value:.1}"),
        _ => format!("{value:.2}"),
    }
}

const HEAD: [&str; 7] = ["area", "what", "measured", "peer", "ratio", "bar", "verdict"];

/// All lines.
#[derive(Default)]
pub(crate) struct Table {
    area: &'static str,
    rows: Vec<[String; 7]>,
}

impl Table {
    /// What follows belongs to this area.
    pub(crate) fn area(&mut self, name: &'static str) {
        self.area = name;
    }

    /// Adds a line.
    pub(crate) fn add(&mut self, row: Row) {
        self.rows.push(row.cells(self.area));
    }

    /// Prints the table to standard output.
    pub(crate) fn print(&self) -> Result<(), String> {
        let mut out = std::io::stdout().lock();
        out.write_all(self.text().as_bytes()).map_err(|error| format!("standard output: {error}"))
    }

    /// Writes the table as CSV.
    pub(crate) fn save(&self, file: &Path) -> Result<(), String> {
        let lines = std::iter::once(HEAD.join(",")).chain(self.rows.iter().map(csv));
        let text: String = lines.map(|line| line + "\n").collect();
        std::fs::write(file, text).map_err(|error| format!("{}: {error}", file.display()))
    }

    fn text(&self) -> String {
        let head = HEAD.map(str::to_owned);
        let lines: Vec<&[String; 7]> = std::iter::once(&head).chain(&self.rows).collect();
        let width = |column: usize| lines.iter().map(|line| line[column].chars().count()).max().unwrap_or(0);
        let widths: Vec<usize> = (0..HEAD.len()).map(width).collect();
        let mut text = String::new();
        for line in lines {
            let mut row = String::new();
            for (cell, width) in line.iter().zip(&widths) {
                let _ = write!(row, "{cell:<width$}  ");
            }
            let _ = writeln!(text, "{}", row.trim_end());
        }
        text
    }
}

fn csv(row: &[String; 7]) -> String {
    let quoted = |cell: &String| if cell.contains(',') { format!("\"{cell}\"") } else { cell.clone() };
    row.each_ref().map(quoted).join(",")
}
