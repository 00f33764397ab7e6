//! What a benchmark main in C printed: times of several contenders, round by round.

use super::child::median;
use super::table::Row;
use super::tools::text;
use std::process::Command;

/// Nanoseconds a turn of each contender.
pub(crate) struct Times(Vec<(String, Vec<f64>)>);

impl Times {
    /// Runs a benchmark main.
    pub(crate) fn of(program: &mut Command) -> Result<Times, String> {
        Ok(Times(text(program)?.lines().filter_map(line).collect()))
    }

    /// The median of one contender.
    pub(crate) fn median(&self, name: &str) -> f64 {
        median(self.rounds(name).to_vec())
    }

    /// The median of one contender over another, round by round.
    pub(crate) fn ratio(&self, name: &str, other: &str) -> f64 {
        median(self.pairs(name, other).map(|(a, b)| a / b).collect())
    }

    /// The median of one contender less another, round by round.
    pub(crate) fn difference(&self, name: &str, other: &str) -> f64 {
        median(self.pairs(name, other).map(|(a, b)| a - b).collect())
    }

    /// A line of the table: one contender over another.
    pub(crate) fn row(&self, what: impl Into<String>, name: &str, peer: &str) -> Row {
        Row::value(what, self.median(name), "ns").peer(self.median(peer), self.ratio(name, peer))
    }

    fn pairs(&self, name: &str, other: &str) -> impl Iterator<Item = (f64, f64)> {
        self.rounds(name).iter().copied().zip(self.rounds(other).iter().copied())
    }

    fn rounds(&self, name: &str) -> &[f64] {
        self.0.iter().find(|(known, _)| known == name).map_or(&[], |(_, times)| times)
    }
}

fn line(text: &str) -> Option<(String, Vec<f64>)> {
    let mut words = text.split_whitespace();
    let name = words.next()?.to_owned();
    Some((name, words.filter_map(|word| word.parse().ok()).collect()))
}
