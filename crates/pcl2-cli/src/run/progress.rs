//! A bar for long runs, if somebody watches.

use crate::console;
use indicatif::{ProgressBar, ProgressStyle};
use std::time::{Duration, Instant};

/// Runs shorter than this show nothing.
const PATIENCE: Duration = Duration::from_millis(700);
/// Between two looks at the clock.
const SCANS_A_LOOK: u64 = 1 << 14;

/// The progress of one run.
pub(crate) struct Progress {
    scans: u64,
    start: Instant,
    watched: bool,
    bar: Option<ProgressBar>,
}

impl Progress {
    /// Starts the clock.
    pub(crate) fn new(scans: u64) -> Progress {
        Progress { scans, start: Instant::now(), watched: console::interactive(), bar: None }
    }

    /// How many scans may run until the next call of [`Progress::at`].
    pub(crate) fn stride(&self) -> u64 {
        if self.watched { SCANS_A_LOOK } else { u64::MAX }
    }

    /// So many scans have run.
    pub(crate) fn at(&mut self, scan: u64) {
        if !self.watched || (self.bar.is_none() && self.start.elapsed() < PATIENCE) {
            return;
        }
        let scans = self.scans;
        self.bar.get_or_insert_with(|| bar(scans)).set_position(scan);
    }

    /// Clears the bar so that a line can be printed.
    pub(crate) fn line(&self, text: &str) {
        match &self.bar {
            Some(bar) => bar.suspend(|| console::err(text)),
            None => console::err(text),
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

fn bar(scans: u64) -> ProgressBar {
    let bar = ProgressBar::new(scans);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent}% of {human_len} scans, {eta} to go") {
        bar.set_style(style);
    }
    bar
}
