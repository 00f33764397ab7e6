//! Panels one below the other over one axis of time.

use super::panels::{self, Kind, MOST, Panel};
use super::scale::{self, Ticks};
use super::{Bucket, COLUMNS, Role, Trends, range};
use crate::svg::{self, escape};
use std::fmt::Write;

/// Colours that people with any colour vision can tell apart (Okabe and Ito).
const COLOURS: [&str; MOST] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];
/// Left of the panels: labels of ticks.
const LEFT: i32 = 84;
/// Right of them: names.
const RIGHT: i32 = 150;
const TOP: i32 = 48;
const BOTTOM: i32 = 44;
const HEIGHT: i32 = 150;
/// The height of a switch's lane.
const LANE: i32 = 26;
const GAP: i32 = 20;
const WIDTH: i32 = COLUMNS as i32;
const SIZE: i32 = 11;
/// The font size of a number of tokens.
const COUNT: i32 = 9;
/// Letters of a name that are shown.
const NAME: usize = 20;

const STYLE: &str = "\
.paper{fill:#fff}
.head{font-size:15px;font-weight:bold;fill:#1d2939}
.rate{font-weight:normal;fill:#667085}
.panel{fill:none;stroke:#98a2b3}
.grid{fill:none;stroke:#e4e7ec}
.tick{font-size:10px;fill:#475467}
.unit{font-size:10px;fill:#475467;font-style:italic}
.name{font-size:11px}
.end{text-anchor:end}.middle{text-anchor:middle}
.trace{fill:none;stroke-width:1.6;stroke-linejoin:round}
.wish{stroke-dasharray:6 3}
.bad{fill:#d92d20;fill-opacity:.16}
";

/// Beside it, where boxes of a net are drawn.
const TOKENS: &str = "\
.marked{fill-opacity:.14}
.count{font-size:9px;fill:#344054}
";

/// The whole picture.
pub(super) fn picture(trends: &Trends) -> String {
    let panels = panels::panels(&trends.signals, &trends.buckets);
    let heights: Vec<i32> = panels.iter().map(height).collect();
    let bottom = TOP + heights.iter().map(|height| height + GAP).sum::<i32>();
    let time = Time::new(trends);
    let title = format!("{}, {}", trends.title, time.length);
    let tokens = if panels.iter().any(|panel| panel.kind == Kind::Tokens) { TOKENS } else { "" };
    let mut text = svg::open(LEFT + WIDTH + RIGHT, bottom + BOTTOM, &title, &format!("{STYLE}{tokens}"));
    let _ = writeln!(
        text,
        "<text class='head' x='{LEFT}' y='26'>{}<tspan class='rate'>, {}</tspan></text>",
        escape(&trends.title),
        escape(&time.length)
    );
    let mut y = TOP;
    for (panel, height) in panels.iter().zip(&heights) {
        put_panel(&mut text, trends, panel, &time, (y, *height));
        y += height + GAP;
    }
    put_time(&mut text, &time, bottom - GAP);
    if trends.left_out > 0 {
        let (x, y) = (LEFT + WIDTH, bottom + 26);
        let _ = writeln!(text, "<text class='tick end' x='{x}' y='{y}'>and {} more signals</text>", trends.left_out);
    }
    svg::close(&mut text);
    text
}

fn height(panel: &Panel) -> i32 {
    match panel.kind {
        Kind::Real | Kind::Whole => HEIGHT,
        Kind::Switches | Kind::Tokens => LANE * i32::try_from(panel.signals.len()).unwrap_or(1),
    }
}

/// The axis of time.
struct Time {
    /// `121 scans, 30.25 s`
    length: String,
    unit: &'static str,
    /// The end, in the unit.
    end: f64,
    ticks: Ticks,
}

impl Time {
    fn new(trends: &Trends) -> Time {
        let scans = trends.scans as f64;
        let seconds = trends.period.map(|period| scans * (period as f64) / 1e9);
        let (unit, size) = seconds.map_or(("scans", 1.0), scale::unit_of_time);
        let end = seconds.unwrap_or(scans) / size;
        let length = match seconds {
            Some(seconds) => format!("{} scans, {} s", trends.scans, rounded(seconds)),
            None => format!("{} scans", trends.scans),
        };
        let end = if end > 0.0 { end } else { 1.0 };
        Time { length, unit, end, ticks: scale::ticks(0.0, end, 10, trends.period.is_none()) }
    }
}

/// A number with at most nine digits behind the point.
fn rounded(value: f64) -> String {
    let text = format!("{value:.9}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A coordinate, in tenths of a pixel.
fn tenths(tenths: i64) -> String {
    let sign = if tenths < 0 { "-" } else { "" };
    let (whole, rest) = (tenths.abs() / 10, tenths.abs() % 10);
    if rest == 0 { format!("{sign}{whole}") } else { format!("{sign}{whole}.{rest}") }
}

/// A share of a length as tenths of a pixel, from a start in pixels.
fn place(start: i32, length: i32, share: f64) -> i64 {
    i64::from(start) * 10 + (share.clamp(-1.0, 2.0) * f64::from(length) * 10.0).round() as i64
}

/// A panel's axis: values to heights.
struct Axis {
    top: i32,
    height: i32,
    low: f64,
    high: f64,
}

impl Axis {
    fn place(&self, value: f64) -> i64 {
        place(self.top, self.height, (self.high - value) / (self.high - self.low))
    }
}

fn put_panel(text: &mut String, trends: &Trends, panel: &Panel, time: &Time, (top, height): (i32, i32)) {
    text.push_str("<g class='group'>\n");
    let (low, high) = panel.range.unwrap_or((0.0, 1.0));
    let (low, high) = scale::roomy(low, high);
    let axis = Axis { top, height, low, high };
    put_grid(text, time, top, height);
    match panel.kind {
        Kind::Real | Kind::Whole => put_ticks(text, trends, panel, &axis),
        Kind::Switches | Kind::Tokens => put_lanes(text, trends, panel, &axis),
    }
    let _ = writeln!(text, "<rect class='panel' x='{LEFT}' y='{top}' width='{WIDTH}' height='{height}'/>");
    for (place, i) in panel.signals.iter().enumerate() {
        put_gaps(text, trends, *i, COLOURS[place % MOST], axes(trends, panel, &axis, *i).1);
    }
    for (place, i) in panel.signals.iter().enumerate() {
        let (own, _) = axes(trends, panel, &axis, *i);
        if panel.kind == Kind::Tokens {
            put_marked(text, trends, *i, COLOURS[place % MOST], &own);
        }
        put_trace(text, trends, *i, COLOURS[place % MOST], &own);
    }
    put_names(text, trends, panel, &axis);
    text.push_str("</g>\n");
}

/// The axis of a signal in a panel, and the height of its part.
fn axes(trends: &Trends, panel: &Panel, axis: &Axis, signal: usize) -> (Axis, (i32, i32)) {
    match panel.kind {
        Kind::Real | Kind::Whole => (Axis { ..*axis }, (axis.top, axis.height)),
        Kind::Switches | Kind::Tokens => {
            let lane = panel.signals.iter().position(|other| *other == signal).unwrap_or(0);
            let top = axis.top + LANE * i32::try_from(lane).unwrap_or(0);
            (Axis { top: top + 5, height: LANE - 10, low: 0.0, high: most(trends, signal) }, (top, LANE))
        }
    }
}

fn put_grid(text: &mut String, time: &Time, top: i32, height: i32) {
    text.push_str("<path class='grid' d='");
    for (value, _) in &time.ticks.marks {
        let x = tenths(place(LEFT, WIDTH, value / time.end));
        let _ = write!(text, "M{x} {top}v{height}");
    }
    text.push_str("'/>\n");
}

fn put_ticks(text: &mut String, trends: &Trends, panel: &Panel, axis: &Axis) {
    let first = &trends.signals[panel.signals[0]];
    let ticks = scale::ticks(axis.low, axis.high, 6, panel.kind == Kind::Whole);
    for (value, label) in &ticks.marks {
        let y = axis.place(*value);
        let named = usize::try_from(*value as i64).ok().filter(|_| *value >= 0.0).and_then(|i| first.names.get(i));
        let _ = writeln!(
            text,
            "<path class='grid' d='M{LEFT} {}h{WIDTH}'/><text class='tick end' x='{}' y='{}'>{}</text>",
            tenths(y),
            LEFT - 6,
            tenths(y + 35),
            escape(&svg::brief(named.unwrap_or(label), 12))
        );
    }
    if let Some(unit) = &first.unit {
        let (x, y) = (LEFT - 6, axis.top - 5);
        let _ = writeln!(text, "<text class='unit end' x='{x}' y='{y}'>{}</text>", escape(&svg::brief(unit, 12)));
    }
}

/// The top of a signal's lane: 1, or the most tokens.
fn most(trends: &Trends, signal: usize) -> f64 {
    range(&trends.buckets[signal]).map_or(1.0, |(_, most)| most.max(1.0))
}

/// Lines between lanes, and their lowest and highest values.
fn put_lanes(text: &mut String, trends: &Trends, panel: &Panel, axis: &Axis) {
    for (lane, signal) in panel.signals.iter().enumerate() {
        let y = axis.top + LANE * i32::try_from(lane).unwrap_or(0);
        let most = most(trends, *signal);
        let _ = writeln!(
            text,
            "<path class='grid' d='M{LEFT} {y}h{WIDTH}'/><text class='tick end' x='{x}' y='{}'>{most}</text>\
             <text class='tick end' x='{x}' y='{}'>0</text>",
            y + 11,
            y + LANE - 3,
            x = LEFT - 6
        );
        if panel.kind == Kind::Tokens && most > 1.0 {
            put_counts(text, trends, *signal, &axes(trends, panel, axis, *signal).0);
        }
    }
}

/// The number of tokens, where it stays long enough to be read.
fn put_counts(text: &mut String, trends: &Trends, signal: usize, axis: &Axis) {
    let buckets = &trends.buckets[signal];
    let constant = |bucket: &Bucket| bucket.good && !bucket.bad && bucket.least == bucket.greatest;
    let mut column = 0;
    while column < buckets.len() {
        let value = buckets[column].last;
        let same = |bucket: &&Bucket| constant(bucket) && bucket.last == value;
        let length = buckets[column..].iter().take_while(same).count();
        let (from, to) = (columns(trends, column), columns(trends, column + length));
        let number = value.to_string();
        if value != 0.0 && to - from > i64::from(svg::width(&number, COUNT) + 6) * 10 {
            let (x, y) = (from + 40, axis.place(value));
            let y = if y > i64::from(axis.top + axis.height / 2) * 10 { y - 25 } else { y + 90 };
            let _ = writeln!(text, "<text class='count' x='{}' y='{}'>{number}</text>", tenths(x), tenths(y));
        }
        column += length.max(1);
    }
}

/// Where a signal's columns begin, in tenths of a pixel.
fn columns(trends: &Trends, column: usize) -> i64 {
    let count = trends.scans.clamp(1, u64::from(COLUMNS));
    let column = i64::try_from(column).unwrap_or(0);
    i64::from(LEFT) * 10 + (column * i64::from(WIDTH) * 10) / i64::try_from(count).unwrap_or(1)
}

/// Bad samples: a band over their time, and a mark in the signal's colour above it.
fn put_gaps(text: &mut String, trends: &Trends, signal: usize, colour: &str, (top, height): (i32, i32)) {
    let buckets = &trends.buckets[signal];
    let mut column = 0;
    while column < buckets.len() {
        let length = buckets[column..].iter().take_while(|bucket| bucket.bad).count();
        if length > 0 {
            let (from, to) = (columns(trends, column), columns(trends, column + length));
            let _ = writeln!(
                text,
                "<g><title>{} is bad</title><rect class='bad' x='{}' y='{top}' width='{}' height='{height}'/>\
                 <path fill='{colour}' d='M{} {top}l-4 -6h8z'/></g>",
                escape(&trends.signals[signal].label),
                tenths(from),
                tenths(to - from),
                tenths((from + to) / 2)
            );
        }
        column += length.max(1);
    }
}

/// A line that holds each sample until the next. A column of several samples spans from the least to the greatest.
fn put_trace(text: &mut String, trends: &Trends, signal: usize, colour: &str, axis: &Axis) {
    let wish = if matches!(trends.signals[signal].role, Role::SetPoint(_)) { " wish" } else { "" };
    let label = escape(&trends.signals[signal].label);
    let _ = write!(text, "<g><title>{label}</title><path class='trace{wish}' stroke='{colour}' d='");
    let mut pen: Option<i64> = None;
    for (column, bucket) in trends.buckets[signal].iter().enumerate() {
        let x = columns(trends, column);
        if !bucket.good {
            if pen.take().is_some() {
                let _ = write!(text, "H{}", tenths(x));
            }
            continue;
        }
        pen = Some(put_bucket(text, bucket, x, pen, axis));
    }
    if pen.is_some() {
        let _ = write!(text, "H{}", tenths(columns(trends, trends.buckets[signal].len())));
    }
    text.push_str("'/></g>\n");
}

/// Goes on to a column and through its samples; gives the height where it ends.
fn put_bucket(text: &mut String, bucket: &Bucket, x: i64, pen: Option<i64>, axis: &Axis) -> i64 {
    // The nearer end first: no way is gone twice.
    let (near, far) = if bucket.first - bucket.least > bucket.greatest - bucket.first {
        (bucket.greatest, bucket.least)
    } else {
        (bucket.least, bucket.greatest)
    };
    let heights = [bucket.first, near, far, bucket.last].map(|value| axis.place(value));
    let mut at = match pen {
        None => {
            let _ = write!(text, "M{} {}", tenths(x), tenths(heights[0]));
            heights[0]
        }
        Some(at) if heights.iter().all(|height| *height == at) => return at,
        Some(at) => {
            let _ = write!(text, "H{}", tenths(x));
            at
        }
    };
    for height in heights {
        if height != at {
            let _ = write!(text, "V{}", tenths(height));
            at = height;
        }
    }
    at
}

/// Bands under a box's tokens over the time in which it is marked.
fn put_marked(text: &mut String, trends: &Trends, signal: usize, colour: &str, axis: &Axis) {
    let buckets = &trends.buckets[signal];
    let mut column = 0;
    while column < buckets.len() {
        let tokens = buckets[column].greatest;
        let same = |bucket: &&Bucket| bucket.good && bucket.greatest == tokens;
        let length = buckets[column..].iter().take_while(same).count();
        if length > 0 && tokens > 0.0 {
            let (top, bottom) = (axis.place(tokens), axis.place(0.0));
            let (from, to) = (columns(trends, column), columns(trends, column + length));
            let _ = writeln!(
                text,
                "<rect class='marked' fill='{colour}' x='{}' y='{}' width='{}' height='{}'/>",
                tenths(from),
                tenths(top),
                tenths(to - from),
                tenths(bottom - top)
            );
        }
        column += length.max(1);
    }
}

/// Names at the ends of traces, moved apart where they would overlap.
fn put_names(text: &mut String, trends: &Trends, panel: &Panel, axis: &Axis) {
    let mut names: Vec<(i64, usize, usize)> = Vec::new();
    for (place, i) in panel.signals.iter().enumerate() {
        let (own, (top, height)) = axes(trends, panel, axis, *i);
        let last = trends.buckets[*i].iter().rev().find(|bucket| bucket.good).map(|bucket| own.place(bucket.last));
        let middle = i64::from(top + height / 2) * 10;
        names.push((if panel.kind.has_lanes() { middle } else { last.unwrap_or(middle) }, place, *i));
    }
    names.sort_unstable();
    apart(&mut names, i64::from(SIZE + 3) * 10, i64::from(axis.top + axis.height) * 10);
    for (y, place, i) in names {
        let colour = COLOURS[place % MOST];
        let dash = if matches!(trends.signals[i].role, Role::SetPoint(_)) { " wish" } else { "" };
        let _ = writeln!(
            text,
            "<path class='trace{dash}' stroke='{colour}' d='M{} {}h16'/><text class='name' fill='{colour}' x='{}' y='{}'>{}</text>",
            LEFT + WIDTH + 5,
            tenths(y),
            LEFT + WIDTH + 25,
            tenths(y + 35),
            escape(&svg::brief(&trends.signals[i].label, NAME))
        );
    }
}

/// Moves sorted places apart, down first and then up from the bottom.
fn apart(names: &mut [(i64, usize, usize)], distance: i64, bottom: i64) {
    for i in 1..names.len() {
        names[i].0 = names[i].0.max(names[i - 1].0 + distance);
    }
    let mut most = bottom;
    for name in names.iter_mut().rev() {
        name.0 = name.0.min(most);
        most = name.0 - distance;
    }
}

fn put_time(text: &mut String, time: &Time, bottom: i32) {
    for (value, label) in &time.ticks.marks {
        let x = tenths(place(LEFT, WIDTH, value / time.end));
        let _ = writeln!(
            text,
            "<path class='panel' d='M{x} {bottom}v5'/><text class='tick middle' x='{x}' y='{}'>{label}</text>",
            bottom + 17
        );
    }
    let (x, y) = (LEFT + WIDTH / 2, bottom + 36);
    let caption = if time.unit == "scans" { "scans".to_owned() } else { format!("time in {}", time.unit) };
    let _ = writeln!(text, "<text class='tick middle' x='{x}' y='{y}'>{caption}</text>");
}
