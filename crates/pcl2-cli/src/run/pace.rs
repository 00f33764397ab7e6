//! Scans at the pace of the clock on the wall.

use std::time::{Duration, Instant};

/// Holds scans back until they are due.
pub(crate) struct Pace {
    start: Instant,
    period: Duration,
}

impl Pace {
    /// Starts now, with a scan period in nanoseconds.
    pub(crate) fn new(period: i64) -> Pace {
        Pace { start: Instant::now(), period: Duration::from_nanos(period.unsigned_abs()) }
    }

    /// Waits until a scan is due. A run that fell behind does not wait.
    pub(crate) fn wait(&self, scan: u64) {
        let due = self.period.as_nanos().saturating_mul(u128::from(scan));
        let due = Duration::from_nanos(u64::try_from(due).unwrap_or(u64::MAX));
        std::thread::sleep(due.saturating_sub(self.start.elapsed()));
    }
}
