//! What a run shows on the terminal: the last values, and a line drawing of each scalar signal.

use super::job::Job;
use super::recorder::{History, SHOWN};
use pcl2_sim::clock;
use pcl2_sim::number::Number;
use std::fmt::Write;

const LEVELS: [char; 8] = ['▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];

/// The summary of a run.
pub(crate) fn text(job: &Job<'_>, history: &History) -> String {
    let mut text = format!("{} scans", job.scans);
    if let Some(period) = job.names.program.period {
        let _ = write!(text, ", {} s", clock::seconds(job.scans, period));
    }
    text.push('\n');
    let Some(last) = history.samples.last() else {
        return text;
    };
    let labels: Vec<String> = job.columns.iter().take(SHOWN).map(|column| job.names.label(*column)).collect();
    let values: Vec<String> = last.iter().map(|value| brief(*value)).collect();
    let label_width = labels.iter().map(|label| label.chars().count()).max().unwrap_or(0);
    let value_width = values.iter().map(|value| value.chars().count()).max().unwrap_or(0);
    for (i, (label, value)) in labels.iter().zip(&values).enumerate() {
        let point = job.names.point(job.columns[i]);
        let drawing = if point.ty.is_scalar() { drawing(history, i) } else { String::new() };
        let name = name(last[i], &point.names);
        let line = format!("  {label:label_width$}  {value:>value_width$}  {drawing}  {name}");
        let _ = writeln!(text, "{}", line.trim_end());
    }
    if job.columns.len() > labels.len() {
        let _ = writeln!(text, "  and {} more (--record, --trace)", job.columns.len() - labels.len());
    }
    text
}

/// What a value is called where values have names.
fn name(value: Number, names: &[String]) -> &str {
    let name = match value {
        Number::Int(value) => usize::try_from(value).ok().and_then(|value| names.get(value)),
        Number::Double(_) | Number::Single(_) | Number::Time(_) => None,
    };
    name.map_or("", String::as_str)
}

/// Six digits are enough to look at.
fn brief(value: Number) -> String {
    match value {
        Number::Double(_) | Number::Single(_) => {
            let value = value.to_f64();
            let rounded = format!("{value:.5e}").parse().unwrap_or(value);
            Number::Double(rounded).to_string()
        }
        Number::Int(_) | Number::Time(_) => value.to_string(),
    }
}

/// One character a sample, from the least to the greatest value; what is not finite is a blank.
fn drawing(history: &History, column: usize) -> String {
    let values = || history.samples.iter().filter_map(|row| row.get(column)).map(|value| value.to_f64());
    let finite = || values().filter(|value| value.is_finite());
    let least = finite().fold(f64::INFINITY, f64::min);
    let span = finite().fold(f64::NEG_INFINITY, f64::max) - least;
    let level = |value: f64| {
        let share = if span > 0.0 { (value - least) / span } else { 0.0 };
        LEVELS[((share * 7.0).round() as usize).min(7)]
    };
    values().map(|value| if value.is_finite() { level(value) } else { ' ' }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drawings_span_from_the_least_to_the_greatest_value() {
        let row = |value: f64| vec![Number::Double(value)];
        let history = History { samples: [0.0, 0.5, 1.0, f64::NAN, -1.0].map(row).to_vec() };
        assert_eq!(drawing(&history, 0), "▅▆█ ▁");
        let flat = History { samples: vec![row(3.0), row(3.0)] };
        assert_eq!(drawing(&flat, 0), "▁▁");
    }

    #[test]
    fn values_with_names_tell_them() {
        let names = ["none".to_owned(), "g1 blocked: ok".to_owned()];
        assert_eq!(name(Number::Int(1), &names), "g1 blocked: ok");
        assert_eq!(name(Number::Int(2), &names), "");
        assert_eq!(name(Number::Int(-1), &names), "");
        assert_eq!(name(Number::Int(1), &[]), "");
    }

    #[test]
    fn last_values_have_six_digits() {
        assert_eq!(brief(Number::Double(0.123_456_789)), "0.123457");
        assert_eq!(brief(Number::Double(f64::NAN)), "nan");
        assert_eq!(brief(Number::Int(1_234_567_890)), "1234567890");
    }
}
