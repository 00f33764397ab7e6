//! Signals over time as trends.
//!
//! Samples come in one by one while a program runs. Each signal keeps as many buckets as the picture has columns, so a
//! run of any length takes the same room: a bucket has the first, the last, the least and the greatest of its samples.

mod panels;
mod render;
mod scale;
mod signals;

pub use signals::{Role, Signal, signals};

/// The columns of a panel.
const COLUMNS: u32 = 800;
/// So many signals are drawn.
pub const DRAWN: usize = 40;
/// So many boxes of nets are drawn.
const BOXES: usize = 400;
/// What lies beyond is drawn at the edge: spans stay finite.
const LIMIT: f64 = 1e300;

/// The trends of one run.
#[derive(Debug)]
pub struct Trends {
    title: String,
    scans: u64,
    /// In nanoseconds.
    period: Option<i64>,
    signals: Vec<Signal>,
    /// By signal of the run: whether it is drawn.
    drawn: Vec<bool>,
    left_out: usize,
    /// For each signal that is drawn its buckets.
    buckets: Vec<Vec<Bucket>>,
}

/// The samples of one signal in one column.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Bucket {
    first: f64,
    last: f64,
    least: f64,
    greatest: f64,
    /// It has a sample.
    good: bool,
    /// It has a bad sample.
    bad: bool,
}

impl Bucket {
    const EMPTY: Bucket = Bucket { first: 0.0, last: 0.0, least: 0.0, greatest: 0.0, good: false, bad: false };

    fn take(&mut self, value: f64) {
        if !value.is_finite() {
            self.bad = true;
            return;
        }
        let value = value.clamp(-LIMIT, LIMIT);
        if !self.good {
            *self = Bucket { first: value, last: value, least: value, greatest: value, good: true, bad: self.bad };
        }
        self.last = value;
        self.least = self.least.min(value);
        self.greatest = self.greatest.max(value);
    }
}

impl Trends {
    /// Trends of a run of so many scans, with a period in nanoseconds if it has one.
    pub fn new(title: &str, scans: u64, period: Option<i64>, mut signals: Vec<Signal>) -> Trends {
        let (mut others, mut boxes) = (DRAWN, BOXES);
        let drawn: Vec<bool> = signals
            .iter()
            .map(|signal| {
                let room = if signal.tokens { &mut boxes } else { &mut others };
                let fits = *room > 0;
                *room = room.saturating_sub(1);
                fits
            })
            .collect();
        let left_out = drawn.iter().filter(|drawn| !**drawn).count();
        let mut fits = drawn.iter();
        signals.retain(|_| fits.next().is_some_and(|fits| *fits));
        let columns = usize::try_from(scans.min(u64::from(COLUMNS))).unwrap_or(0);
        let buckets = vec![vec![Bucket::EMPTY; columns]; signals.len()];
        Trends { title: title.to_owned(), scans, period, signals, drawn, left_out, buckets }
    }

    /// Takes what stands after a scan: a value for each signal.
    pub fn row(&mut self, scan: u64, values: impl IntoIterator<Item = f64>) {
        let column = if self.scans <= u64::from(COLUMNS) {
            scan
        } else {
            let column = u128::from(scan) * u128::from(COLUMNS) / u128::from(self.scans);
            u64::try_from(column).unwrap_or(u64::MAX)
        };
        let column = usize::try_from(column).unwrap_or(usize::MAX);
        let values = values.into_iter().zip(&self.drawn).filter(|(_, drawn)| **drawn).map(|(value, _)| value);
        for (buckets, value) in self.buckets.iter_mut().zip(values) {
            if let Some(bucket) = buckets.get_mut(column) {
                bucket.take(value);
            }
        }
    }

    /// The picture.
    pub fn svg(&self) -> String {
        render::picture(self)
    }
}

/// The least and the greatest good sample.
fn range(buckets: &[Bucket]) -> Option<(f64, f64)> {
    let good = || buckets.iter().filter(|bucket| bucket.good);
    let least = good().map(|bucket| bucket.least).reduce(f64::min)?;
    let greatest = good().map(|bucket| bucket.greatest).reduce(f64::max)?;
    Some((least, greatest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bucket_has_the_ends_of_its_samples() {
        let mut bucket = Bucket::EMPTY;
        for value in [2.0, f64::NAN, -1.0, 7.0, 3.0, f64::INFINITY] {
            bucket.take(value);
        }
        assert_eq!(bucket, Bucket { first: 2.0, last: 3.0, least: -1.0, greatest: 7.0, good: true, bad: true });
    }
}
