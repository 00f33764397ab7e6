//! Signals over time as CSV, written row by row.

use crate::clock;
use crate::names::{Element, Names};
use crate::number::Number;
use pcl2_lang::model::Place;
use std::fmt::Write as _;
use std::io::{self, Write};

/// All variables in order of their first writer, then the boxes of nets inside, each element a column.
pub fn all_signals(names: &Names) -> Vec<Element> {
    let mut columns = Vec::new();
    for (i, point) in names.points.iter().enumerate() {
        if matches!(point.place, Place::Signal(_) | Place::Inside(_)) {
            columns.extend((0..point.ty.elements() as u32).map(|element| Element { point: i as u32, element }));
        }
    }
    columns
}

/// The columns of a list of names, separated by commas outside brackets.
pub fn select(names: &Names, list: &str) -> Result<Vec<Element>, String> {
    let mut columns = Vec::new();
    for name in split(list) {
        columns.extend(names.elements(name)?);
    }
    Ok(columns)
}

fn split(list: &str) -> Vec<&str> {
    let mut depth = 0_i32;
    let separates = |c: char| {
        depth += i32::from(matches!(c, '(' | '[')) - i32::from(matches!(c, ')' | ']'));
        c == ',' && depth <= 0
    };
    list.split(separates).map(str::trim).filter(|name| !name.is_empty()).collect()
}

/// Writes a trace: a header, then one row for each recorded scan.
#[derive(Debug)]
pub struct TraceWriter<W: Write> {
    out: W,
    period: Option<i64>,
    line: String,
}

impl<W: Write> TraceWriter<W> {
    /// Writes the header: `@k,@t`, then the columns.
    pub fn new(mut out: W, names: &Names, columns: &[Element]) -> io::Result<TraceWriter<W>> {
        let mut line = "@k,@t".to_owned();
        for column in columns {
            line.push(',');
            line.push_str(&quoted(&names.label(*column)));
        }
        line.push('\n');
        out.write_all(line.as_bytes())?;
        Ok(TraceWriter { out, period: names.program.period, line })
    }

    /// Writes what stands after a scan.
    pub fn row(&mut self, scan: u64, values: impl IntoIterator<Item = Number>) -> io::Result<()> {
        self.line.clear();
        let time = self.period.map(|period| clock::seconds(scan, period)).unwrap_or_default();
        let _ = write!(self.line, "{scan},{time}");
        for value in values {
            let _ = write!(self.line, ",{value}");
        }
        self.line.push('\n');
        self.out.write_all(self.line.as_bytes())
    }

    /// Hands the sink back, flushed.
    pub fn finish(mut self) -> io::Result<W> {
        self.out.flush()?;
        Ok(self.out)
    }
}

fn quoted(name: &str) -> String {
    if name.contains([',', '"', '\n', '\r']) { format!("\"{}\"", name.replace('"', "\"\"")) } else { name.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_separated_outside_brackets() {
        assert_eq!(split("y, m[1,2],ain(0,1,1) ,"), ["y", "m[1,2]", "ain(0,1,1)"]);
        assert_eq!(split(""), Vec::<&str>::new());
    }

    #[test]
    fn fields_with_a_comma_are_quoted() {
        assert_eq!(quoted("m[1,2]"), "\"m[1,2]\"");
        assert_eq!(quoted("y"), "y");
    }
}
