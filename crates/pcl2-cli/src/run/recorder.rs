//! Takes rows from an engine: into the trace, into the trends that are plotted, and a few of them into the history
//! that the summary draws.

use super::Failure;
use super::files::{self, Output};
use super::job::Job;
use pcl2_draw::plot::{self, Trends};
use pcl2_sim::number::Number;
use pcl2_sim::trace::TraceWriter;
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

/// So many samples of a signal are drawn.
const SAMPLES: u64 = 48;
/// So many signals are shown.
pub(crate) const SHOWN: usize = 40;

/// The recorder of one run.
pub(crate) struct Recorder {
    trace: Option<TraceWriter<BufWriter<Output>>>,
    trends: Option<Trends>,
    path: PathBuf,
    scans: u64,
    history: History,
}

/// Samples of the recorded signals.
#[derive(Debug, Default)]
pub(crate) struct History {
    /// One list of values for each sample, the first columns only.
    pub(crate) samples: Vec<Vec<Number>>,
}

/// What a run leaves behind.
pub(crate) struct Recorded {
    pub(crate) history: History,
    pub(crate) trends: Option<Trends>,
    /// The complete trace; it takes its place when it is kept.
    pub(crate) trace: Option<Output>,
}

/// How recording went.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Recording {
    /// More can come.
    Open,
    /// Whoever reads standard output has seen enough.
    Closed,
}

impl Recorder {
    /// Opens the trace, if one is wanted.
    pub(crate) fn new(job: &Job<'_>, path: Option<&Path>, plotted: bool) -> Result<Recorder, Failure> {
        let mut trace = None;
        if let Some(path) = path {
            let output = BufWriter::with_capacity(1 << 16, Output::open(path)?);
            let writer = TraceWriter::new(output, job.names, &job.columns);
            trace = Some(writer.map_err(|error| files::cannot_write(path, &error))?);
        }
        let path = path.map(Path::to_path_buf).unwrap_or_default();
        let trends = plotted.then(|| trends(job));
        Ok(Recorder { trace, trends, path, scans: job.scans, history: History::default() })
    }

    /// The next scan, not before this one, whose row is wanted.
    pub(crate) fn next(&self, scan: u64) -> u64 {
        if self.takes_all() { scan } else { self.next_sample(scan) }
    }

    fn takes_all(&self) -> bool {
        self.trace.is_some() || self.trends.is_some()
    }

    /// The samples are spread evenly, the last scan is one of them.
    fn next_sample(&self, scan: u64) -> u64 {
        if self.scans <= SAMPLES {
            return scan;
        }
        let (scans, count) = (u128::from(self.scans), u128::from(SAMPLES));
        let index = ((u128::from(scan) + 1) * count).div_ceil(scans);
        u64::try_from(index * scans / count).map_or(u64::MAX, |end| end.saturating_sub(1)).max(scan)
    }

    /// The scans whose rows are wanted; `None` for every scan.
    pub(crate) fn samples(&self) -> Option<Vec<u64>> {
        if self.takes_all() {
            return None;
        }
        let first = self.next_sample(0);
        let following = |scan: &u64| scan.checked_add(1).map(|scan| self.next_sample(scan));
        Some(std::iter::successors(Some(first), following).take_while(|scan| *scan < self.scans).collect())
    }

    /// Takes what stands after a scan.
    pub(crate) fn row(&mut self, scan: u64, values: &[Number]) -> Result<Recording, Failure> {
        if self.next_sample(scan) == scan {
            self.history.samples.push(values.iter().take(SHOWN).copied().collect());
        }
        if let Some(trends) = &mut self.trends {
            trends.row(scan, values.iter().map(|value| value.to_f64()));
        }
        let Some(trace) = &mut self.trace else {
            return Ok(Recording::Open);
        };
        match trace.row(scan, values.iter().copied()) {
            Ok(()) => Ok(Recording::Open),
            Err(error) => self.broken(&error).map(|()| Recording::Closed),
        }
    }

    fn broken(&self, error: &io::Error) -> Result<(), Failure> {
        let closed = error.kind() == io::ErrorKind::BrokenPipe && files::is_stdout(&self.path);
        if closed { Ok(()) } else { Err(files::cannot_write(&self.path, error)) }
    }

    /// Completes the trace.
    pub(crate) fn finish(mut self) -> Result<Recorded, Failure> {
        let trace = match self.trace.take() {
            Some(trace) => self.complete(trace)?,
            None => None,
        };
        Ok(Recorded { history: self.history, trends: self.trends, trace })
    }

    fn complete(&self, trace: TraceWriter<BufWriter<Output>>) -> Result<Option<Output>, Failure> {
        match trace.finish().map(BufWriter::into_inner) {
            Ok(Ok(output)) => Ok(Some(output)),
            Ok(Err(error)) => self.broken(error.error()).map(|()| None),
            Err(error) => self.broken(&error).map(|()| None),
        }
    }
}

fn trends(job: &Job<'_>) -> Trends {
    let program = job.names.program;
    let points = job.columns.iter().map(|column| (job.names.point(*column), job.names.label(*column)));
    Trends::new(&program.name, job.scans, program.period, plot::signals(program, points))
}
