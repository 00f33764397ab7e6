//! What comes from outside: stimulus rows and single sets, as events in order of the scan.

use crate::clock::{Instant, NoInstant};
use crate::names::{Element, Names};
use crate::number::{self, Number};
use pcl2_lang::model::{Access, Point};
use rustc_hash::FxHashSet;
use std::fmt;

/// One element gets a value before a scan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event {
    /// Before this scan.
    pub scan: u64,
    /// What is written.
    pub element: Element,
    /// The value.
    pub value: Number,
}

/// A stimulus, read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stimulus {
    /// In order of the scan; within one scan a later event wins.
    pub events: Vec<Event>,
    /// The scan of the last row.
    pub last: Option<u64>,
}

/// What is wrong with a stimulus or a set.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum InputError {
    /// An unknown or illegal name, a clock that needs a period: the command was used wrongly.
    Usage(String),
    /// The rows are not what they should be.
    Data(String),
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            InputError::Usage(message) | InputError::Data(message) => write!(f, "{message}"),
        }
    }
}

impl std::error::Error for InputError {}

use InputError::{Data, Usage};

#[derive(Clone, Copy)]
enum Clock {
    Scan,
    Seconds(i64),
}

/// Reads a stimulus: RFC 4180, the first column the clock, the others points that the outside writes.
pub fn parse(bytes: &[u8], names: &Names, width: pcl2_lang::types::Width) -> Result<Stimulus, InputError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut reader = csv::ReaderBuilder::new().from_reader(bytes);
    let header = reader.headers().map_err(|error| Data(text_of(&error)))?.clone();
    let clock = clock(header.get(0).unwrap_or("").trim(), names.program.period)?;
    let columns = columns(&header, names)?;
    let mut stimulus = Stimulus::default();
    let mut previous = None;
    for record in reader.records() {
        let record = record.map_err(|error| Data(text_of(&error)))?;
        let row = record.position().map_or(0, csv::Position::line);
        let cell = record.get(0).unwrap_or("").trim();
        let at = instant(cell, clock).map_err(|message| Data(format!("row {row}, column 1: {message}")))?;
        if previous.is_some_and(|previous| at.order <= previous) {
            return Err(Data(format!("row {row}, column 1: the clock must ascend, `{cell}` does not")));
        }
        previous = Some(at.order);
        stimulus.last = Some(at.scan);
        for (column, (element, text)) in columns.iter().zip(record.iter().skip(1)).enumerate() {
            let text = text.trim();
            if text.is_empty() {
                continue;
            }
            let value = value(text, names.point(*element), width).map_err(|message| {
                Data(format!("row {row}, column {} ({}): {message}", column + 2, names.label(*element)))
            })?;
            stimulus.events.push(Event { scan: at.scan, element: *element, value });
        }
    }
    Ok(stimulus)
}

/// Reads one set: `NAME=VALUE` or `NAME=VALUE@SECONDS`.
pub fn parse_set(text: &str, names: &Names, width: pcl2_lang::types::Width) -> Result<Event, InputError> {
    let (name, rest) =
        text.split_once('=').ok_or_else(|| Usage(format!("`{text}`: expected NAME=VALUE or NAME=VALUE@SECONDS")))?;
    let element = writable(name.trim(), names)?;
    let (cell, at) = rest.split_once('@').map_or((rest, None), |(cell, at)| (cell, Some(at.trim())));
    let scan = match at {
        None => 0,
        Some(at) => {
            let period =
                names.program.period.ok_or_else(|| Usage(format!("`{text}`: a time needs a period (--period)")))?;
            let at = instant(at, Clock::Seconds(period)).map_err(|message| Usage(format!("`{text}`: {message}")))?;
            at.scan
        }
    };
    let value =
        value(cell.trim(), names.point(element), width).map_err(|message| Usage(format!("`{text}`: {message}")))?;
    Ok(Event { scan, element, value })
}

/// One list in order of the scan. Within a scan the sets come after the stimulus and win: of several events for one
/// element the last stays.
pub fn merge(stimulus: Vec<Event>, sets: impl IntoIterator<Item = Event>) -> Vec<Event> {
    let mut events = stimulus;
    events.extend(sets);
    events.sort_by_key(|event| event.scan);
    let mut seen = FxHashSet::default();
    let mut kept: Vec<Event> =
        events.into_iter().rev().filter(|event| seen.insert((event.scan, event.element))).collect();
    kept.reverse();
    kept
}

/// What the csv reader says, in our counting.
fn text_of(error: &csv::Error) -> String {
    match error.kind() {
        csv::ErrorKind::UnequalLengths { pos, expected_len, len } => {
            let row = pos.as_ref().map_or(0, csv::Position::line);
            format!("row {row}: expected {expected_len} fields, found {len}")
        }
        csv::ErrorKind::Utf8 { pos, .. } => {
            format!("row {}: not UTF-8 text", pos.as_ref().map_or(0, csv::Position::line))
        }
        _ => error.to_string(),
    }
}

fn clock(header: &str, period: Option<i64>) -> Result<Clock, InputError> {
    match (header, period) {
        ("k", _) => Ok(Clock::Scan),
        ("t", Some(period)) => Ok(Clock::Seconds(period)),
        ("t", None) => Err(Usage("a clock `t` needs a period (--period)".to_owned())),
        _ => Err(Usage(format!("the first column is the clock, headed `k` (scan) or `t` (seconds); found `{header}`"))),
    }
}

fn columns(header: &csv::StringRecord, names: &Names) -> Result<Vec<Element>, InputError> {
    let mut seen = FxHashSet::default();
    let mut columns = Vec::new();
    for (i, name) in header.iter().enumerate().skip(1) {
        let element = writable(name.trim(), names).map_err(|error| Usage(format!("column {}: {error}", i + 1)))?;
        if !seen.insert(element) {
            return Err(Usage(format!("column {}: `{}` stands in an earlier column", i + 1, name.trim())));
        }
        columns.push(element);
    }
    Ok(columns)
}

fn writable(name: &str, names: &Names) -> Result<Element, InputError> {
    let element = names.element(name).map_err(Usage)?;
    let point = names.point(element);
    match point.access {
        Access::Input | Access::Image | Access::Tunable | Access::Operator => Ok(element),
        Access::Signal => Err(Usage(format!("`{name}` is written by a block"))),
        Access::State => Err(Usage(format!("`{name}` is memory of a block"))),
    }
}

fn value(text: &str, point: &Point, width: pcl2_lang::types::Width) -> Result<Number, String> {
    number::parse(text, point.ty.scalar, width, &point.names)
}

/// A clock's reading: what must ascend, and the scan.
struct Reading {
    order: Order,
    scan: u64,
}

#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Order {
    Scan(u64),
    Time(Instant),
}

fn instant(text: &str, clock: Clock) -> Result<Reading, String> {
    match clock {
        Clock::Scan => {
            let scan = text.parse().map_err(|_| format!("expected a scan number, found `{text}`"))?;
            Ok(Reading { order: Order::Scan(scan), scan })
        }
        Clock::Seconds(period) => {
            let time = Instant::parse(text).map_err(|reason| match reason {
                NoInstant::Unreadable => format!("expected seconds, found `{text}`"),
                NoInstant::TooLarge => format!("`{text}` is too late"),
            })?;
            if time.is_negative() {
                return Err(format!("`{text}` is before the first scan"));
            }
            let scan = time.scan(period).ok_or_else(|| format!("`{text}` is too late"))?;
            Ok(Reading { order: Order::Time(time), scan })
        }
    }
}
