//! The incidence matrices of a net, B-, B+ and B, and of parts of it: rows are places, columns are transitions.
//!
//! A read arc or an inhibitor moves no token and changes none of the three. Each kind has a matrix of its own.

use crate::pt::{PlaceId, PtNet, TransitionId};
use crate::structure::names;
use crate::structure::part::{ArcKind, arcs};
use rustc_hash::FxHashSet;
use std::io::{self, Write};

/// The widest column of a text, in characters; a longer name stands out.
pub const WIDEST: usize = 200;

const ONE_MATRIX: &str = "a file has one matrix: `net matrix --csv` writes one with --of and --kind";

/// Which matrix of a net.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MatrixKind {
    /// B-: what transitions take.
    Takes,
    /// B+: what transitions put.
    Puts,
    /// B = B+ - B-: what a firing changes.
    Change,
    /// What transitions read.
    Reads,
    /// The weights of inhibitor arcs.
    Inhibits,
}

impl MatrixKind {
    /// All of them, in the order of a report.
    pub const ALL: [MatrixKind; 5] =
        [MatrixKind::Takes, MatrixKind::Puts, MatrixKind::Change, MatrixKind::Reads, MatrixKind::Inhibits];

    /// What stands in the corner of a table.
    pub fn label(self) -> &'static str {
        match self {
            MatrixKind::Takes => "B-",
            MatrixKind::Puts => "B+",
            MatrixKind::Change => "B",
            MatrixKind::Reads => "read",
            MatrixKind::Inhibits => "inhibit",
        }
    }

    /// The kinds of arc that it counts, each with its sign.
    fn arcs(self) -> &'static [(ArcKind, i128)] {
        match self {
            MatrixKind::Takes => &[(ArcKind::Take, 1)],
            MatrixKind::Puts => &[(ArcKind::Put, 1)],
            MatrixKind::Change => &[(ArcKind::Take, -1), (ArcKind::Put, 1)],
            MatrixKind::Reads => &[(ArcKind::Read, 1)],
            MatrixKind::Inhibits => &[(ArcKind::Inhibit, 1)],
        }
    }
}

/// A matrix with names. Zeros are not kept.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Matrix {
    /// What stands in the corner.
    pub label: String,
    /// The places.
    pub rows: Vec<String>,
    /// The transitions.
    pub columns: Vec<String>,
    /// Of each row the column and the value of what is not zero, in order of the columns.
    entries: Vec<Vec<(u32, i128)>>,
}

impl Matrix {
    /// A matrix of zeros.
    pub fn zero(label: &str, rows: Vec<String>, columns: Vec<String>) -> Matrix {
        let entries = vec![Vec::new(); rows.len()];
        Matrix { label: label.to_owned(), rows, columns, entries }
    }

    /// A matrix of a whole net.
    pub fn of(net: &PtNet, kind: MatrixKind) -> Matrix {
        let places: Vec<PlaceId> = names::place_ids(net).collect();
        let transitions: Vec<TransitionId> = names::transition_ids(net).collect();
        Matrix::of_part(net, kind, &places, &transitions)
    }

    /// A matrix of some places and transitions, in this order, each once.
    pub fn of_part(net: &PtNet, kind: MatrixKind, places: &[PlaceId], transitions: &[TransitionId]) -> Matrix {
        let rows = places.iter().map(|id| names::place(net, *id).to_owned()).collect();
        let columns = transitions.iter().map(|id| names::transition(net, *id).to_owned()).collect();
        let mut matrix = Matrix::zero(kind.label(), rows, columns);
        let mut row_of = vec![None; net.places.len()];
        for (row, place) in places.iter().enumerate() {
            row_of[place.0 as usize] = Some(row);
        }
        for (column, id) in transitions.iter().enumerate() {
            for (arc_kind, sign) in kind.arcs() {
                for arc in arcs(&net.transitions[id.0 as usize], *arc_kind) {
                    if let Some(row) = row_of[arc.place.0 as usize] {
                        let value = matrix.entry(row, column) + sign * i128::from(arc.weight);
                        matrix.set(row, column, value);
                    }
                }
            }
        }
        matrix
    }

    /// The value in a row and a column.
    pub fn entry(&self, row: usize, column: usize) -> i128 {
        let row = &self.entries[row];
        row.binary_search_by_key(&(column as u32), |entry| entry.0).map_or(0, |at| row[at].1)
    }

    /// What is not zero in a row: columns in ascending order, and values.
    pub fn row(&self, row: usize) -> &[(u32, i128)] {
        &self.entries[row]
    }

    /// Writes one value.
    pub fn set(&mut self, row: usize, column: usize, value: i128) {
        let row = &mut self.entries[row];
        match (row.binary_search_by_key(&(column as u32), |entry| entry.0), value) {
            (Ok(at), 0) => {
                row.remove(at);
            }
            (Ok(at), _) => row[at].1 = value,
            (Err(_), 0) => {}
            (Err(at), _) => row.insert(at, (column as u32, value)),
        }
    }

    /// Writes an aligned table. A dot is a zero.
    pub fn write_text(&self, out: &mut impl Write) -> io::Result<()> {
        let names = self.rows.iter().chain([&self.label]).map(|name| width(name)).max().unwrap_or(0);
        let mut widths: Vec<usize> = self.columns.iter().map(|name| width(name)).collect();
        for (column, value) in self.entries.iter().flatten() {
            let width = &mut widths[*column as usize];
            *width = (*width).max(value.to_string().len());
        }
        let header = self.columns.iter().map(String::clone);
        write_line(out, (&self.label, names), &widths, header)?;
        for (row, name) in self.rows.iter().enumerate() {
            let mut entries = self.entries[row].iter().peekable();
            let cells = (0..self.columns.len() as u32).map(|column| match entries.next_if(|entry| entry.0 == column) {
                Some((_, value)) => value.to_string(),
                None => ".".to_owned(),
            });
            write_line(out, (name, names), &widths, cells)?;
        }
        Ok(())
    }

    /// Writes RFC 4180: the transitions in the header, a place at the beginning of each line.
    pub fn write_csv(&self, out: &mut impl Write) -> io::Result<()> {
        let mut writer = csv::Writer::from_writer(out);
        writer.write_record([&self.label].into_iter().chain(&self.columns))?;
        for (row, name) in self.rows.iter().enumerate() {
            let mut entries = self.entries[row].iter().peekable();
            writer.write_field(name)?;
            for column in 0..self.columns.len() as u32 {
                let value = entries.next_if(|entry| entry.0 == column).map_or(0, |entry| entry.1);
                writer.write_field(value.to_string())?;
            }
            writer.write_record(None::<&[u8]>)?;
        }
        writer.flush()
    }

    /// Reads what [`Matrix::write_csv`] wrote.
    pub fn read_csv(bytes: &[u8]) -> Result<Matrix, String> {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let mut reader = csv::ReaderBuilder::new().from_reader(bytes);
        let header = reader.headers().map_err(|error| text_of(&error, bytes))?.clone();
        let label = header.get(0).ok_or("expected a line with the names of transitions, found nothing")?;
        if label.trim_start().starts_with('<') {
            return Err("expected a matrix as CSV, found XML; `net matrix --csv` writes the matrix of a net".to_owned());
        }
        let columns: Vec<String> = header.iter().skip(1).map(|name| name.trim().to_owned()).collect();
        if let Some(column) = repeated(&columns) {
            return Err(format!("line 1, column {}: `{}` stands in an earlier column", column + 2, columns[column]));
        }
        let mut matrix = Matrix::zero(label.trim(), Vec::new(), columns);
        let mut seen = FxHashSet::default();
        for record in reader.records() {
            let record = record.map_err(|error| text_of(&error, bytes))?;
            let line = line_at(bytes, record.position());
            let name = record.get(0).unwrap_or("").trim().to_owned();
            if !matrix.columns.is_empty() && record.iter().skip(1).map(str::trim).eq(&matrix.columns) {
                return Err(format!("line {line}: expected a row of `{label}`, found a second matrix; {ONE_MATRIX}"));
            }
            if !seen.insert(name.clone()) {
                return Err(format!("line {line}, column 1: `{name}` stands in an earlier row"));
            }
            matrix.rows.push(name);
            let entries = entries(&record, &matrix.columns).map_err(|message| format!("line {line}, {message}"))?;
            matrix.entries.push(entries);
        }
        Ok(matrix)
    }
}

fn entries(record: &csv::StringRecord, columns: &[String]) -> Result<Vec<(u32, i128)>, String> {
    let mut entries = Vec::new();
    for (column, (cell, name)) in record.iter().skip(1).zip(columns).enumerate() {
        let value = cell.trim().parse().ok().filter(|value: &i128| value.unsigned_abs() <= u128::from(u64::MAX));
        let value = value
            .ok_or_else(|| format!("column {} ({name}): expected an integer below 2^64, found `{cell}`", column + 2))?;
        if value != 0 {
            entries.push((column as u32, value));
        }
    }
    Ok(entries)
}

fn repeated(names: &[String]) -> Option<usize> {
    let mut seen = FxHashSet::default();
    names.iter().position(|name| !seen.insert(name))
}

fn text_of(error: &csv::Error, bytes: &[u8]) -> String {
    let line = |pos: &Option<csv::Position>| line_at(bytes, pos.as_ref());
    match error.kind() {
        csv::ErrorKind::UnequalLengths { pos, expected_len, len } => {
            format!("line {}: expected {expected_len} fields, found {len}; {ONE_MATRIX}", line(pos))
        }
        csv::ErrorKind::Utf8 { pos, .. } => format!("line {}: expected UTF-8 text, found other bytes", line(pos)),
        _ => error.to_string(),
    }
}

/// The line of a record, blank ones before it counted.
fn line_at(bytes: &[u8], position: Option<&csv::Position>) -> usize {
    let start = position.map_or(0, |position| position.byte() as usize).min(bytes.len());
    let blank = bytes[start..].iter().take_while(|byte| matches!(byte, b'\r' | b'\n')).count();
    1 + bytes[..start + blank].iter().filter(|byte| **byte == b'\n').count()
}

/// In characters: names of nets from other tools need not be ASCII, nor short.
fn width(text: &str) -> usize {
    text.chars().count().min(WIDEST)
}

fn write_line(
    out: &mut impl Write,
    (name, name_width): (&str, usize),
    widths: &[usize],
    cells: impl Iterator<Item = String>,
) -> io::Result<()> {
    write!(out, "{name:name_width$}")?;
    for (cell, width) in cells.zip(widths) {
        write!(out, "  {cell:>width$}")?;
    }
    writeln!(out)
}
