//! CSV tables: traces and references.

use crate::cases::Tolerance;

/// A table with named columns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    /// The names of the columns.
    pub header: Vec<String>,
    /// The rows.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// Reads a CSV file's text.
    ///
    /// # Panics
    /// When it is none.
    pub fn read(text: &str) -> Table {
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let fields = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect::<Vec<_>>();
        let header = fields(reader.headers().expect("a header"));
        let rows = reader.records().map(|record| fields(&record.expect("a row"))).collect();
        Table { header, rows }
    }

    /// The place of a column.
    pub fn column(&self, name: &str) -> Option<usize> {
        self.header.iter().position(|known| known == name)
    }

    /// The values of a column.
    ///
    /// # Panics
    /// When there is no such column, or it has something else than numbers.
    pub fn values(&self, name: &str) -> Vec<f64> {
        let column = self.column(name).unwrap_or_else(|| panic!("no column {name} in {:?}", self.header));
        self.rows.iter().map(|row| number(&row[column])).collect()
    }
}

/// A field as a number.
///
/// # Panics
/// When it is none.
pub fn number(field: &str) -> f64 {
    field.parse().unwrap_or_else(|_| panic!("`{field}` is no number"))
}

impl Tolerance {
    /// Whether a value is as near to the reference as it must be; all NaNs are one value.
    pub fn accepts(self, value: f64, reference: f64) -> bool {
        value == reference
            || (value.is_nan() && reference.is_nan())
            || (value - reference).abs() <= self.absolute + self.relative * reference.abs()
    }
}

/// Compares the columns that a reference names. Its first column is the scan's number.
///
/// # Errors
/// The first difference of each column.
pub fn compare(trace: &Table, reference: &Table, tolerance: Tolerance) -> Result<(), String> {
    let mut differences = Vec::new();
    if reference.rows.is_empty() || reference.header.len() < 2 {
        return Err("the reference is empty".to_owned());
    }
    for (i, name) in reference.header.iter().enumerate().skip(1) {
        let Some(column) = trace.column(name) else {
            differences.push(format!("the trace has no column {name}"));
            continue;
        };
        let difference = reference.rows.iter().find_map(|row| {
            let Some(found) = row[0].parse::<usize>().ok().and_then(|scan| trace.rows.get(scan)) else {
                return Some(format!("the trace has no scan {}", row[0]));
            };
            let (value, expected) = (number(&found[column]), number(&row[i]));
            let near = tolerance.accepts(value, expected);
            (!near).then(|| format!("{name} in scan {}: expected {expected:?}, found {value:?}", row[0]))
        });
        differences.extend(difference);
    }
    if differences.is_empty() { Ok(()) } else { Err(differences.join("\n")) }
}

/// Says where two texts differ first.
///
/// # Errors
/// The first line that differs.
pub fn same_text(what: &str, left: &str, right: &str) -> Result<(), String> {
    if left == right {
        return Ok(());
    }
    let lines = left.lines().zip(right.lines()).enumerate();
    let first = lines.into_iter().find(|(_, (a, b))| a != b);
    let (ends, length) = ("one is longer".to_owned(), (left.len(), right.len()));
    let shown = first.map_or(ends, |(i, (a, b))| format!("line {}:\n  {a}\n  {b}", i + 1));
    Err(format!("{what}: they differ ({length:?} bytes): {shown}"))
}
