//! What a run is to do, before any engine is involved.

use super::{Failure, RunArgs};
use pcl2_lang::model::Access;
use pcl2_sim::clock::Instant;
use pcl2_sim::names::{Element, Names};
use pcl2_sim::number::Number;
use pcl2_sim::stimulus::{self, Event, InputError, Stimulus};
use pcl2_sim::trace;
use std::fmt::Write;
use std::path::Path;

/// A stimulus makes no run longer than this: its last time is a slip, most likely.
const MAX_IMPLIED: u64 = 1_000_000_000;

/// A run, prepared.
pub(crate) struct Job<'a> {
    pub(crate) names: &'a Names<'a>,
    /// What comes from outside, in order of the scan.
    pub(crate) events: Vec<Event>,
    /// How many scans.
    pub(crate) scans: u64,
    /// What is recorded.
    pub(crate) columns: Vec<Element>,
    /// The tunable parameters.
    pub(crate) params: Vec<Element>,
    /// The period to keep to, in nanoseconds.
    pub(crate) realtime: Option<i64>,
}

impl<'a> Job<'a> {
    /// Reads stimulus, sets, length and columns of a run.
    pub(crate) fn new(args: &RunArgs, names: &'a Names<'a>) -> Result<Job<'a>, Failure> {
        let stimulus = match &args.stimulus {
            Some(path) => read_stimulus(path, names)?,
            None => Stimulus::default(),
        };
        let set = |text: &String| stimulus::parse_set(text, names, names.program.width);
        let sets = args.sets.iter().map(set).collect::<Result<Vec<_>, _>>();
        let sets = sets.map_err(|error| Failure::usage(format!("--set {error}")))?;
        let scans = scans(args, names.program.period, stimulus.last)?;
        let columns = match args.record.as_slice() {
            [] => trace::all_signals(names),
            lists => {
                trace::select(names, &lists.join(",")).map_err(|error| Failure::usage(format!("--record: {error}")))?
            }
        };
        let realtime = match (args.realtime, names.program.period) {
            (true, None) => return Err(Failure::usage("--realtime needs a period: give --period")),
            (true, period) => period,
            (false, _) => None,
        };
        Ok(Job {
            names,
            realtime,
            events: stimulus::merge(stimulus.events, sets),
            scans,
            columns,
            params: params(names),
        })
    }

    /// Lines `NAME=VALUE` of the tunable parameters.
    pub(crate) fn params_text(&self, values: &[Number]) -> String {
        let mut text = String::new();
        for (element, value) in self.params.iter().zip(values) {
            let _ = writeln!(text, "{}={value}", self.names.label(*element));
        }
        text
    }
}

fn read_stimulus(path: &Path, names: &Names<'_>) -> Result<Stimulus, Failure> {
    let shown = path.display();
    let bytes = std::fs::read(path).map_err(|error| Failure::failed(format!("cannot read `{shown}`: {error}")))?;
    stimulus::parse(&bytes, names, names.program.width).map_err(|error| match error {
        InputError::Usage(message) => Failure::usage(format!("{shown}: {message}")),
        InputError::Data(message) => Failure::failed(format!("{shown}: {message}")),
    })
}

fn scans(args: &RunArgs, period: Option<i64>, last: Option<u64>) -> Result<u64, Failure> {
    if let Some(steps) = args.steps {
        return Ok(steps);
    }
    let Some(until) = &args.until else {
        if let Some(last) = last.filter(|last| *last >= MAX_IMPLIED) {
            let message =
                format!("the last row of the stimulus is before scan {last}: a run so long needs --steps or --until");
            return Err(Failure::usage(message));
        }
        let last = last.and_then(|last| last.checked_add(1));
        return last.ok_or_else(|| Failure::usage("how long? Give --steps, --until, or a --stimulus with rows"));
    };
    let period = period.ok_or_else(|| Failure::usage("--until needs a period (--period)"))?;
    let end = Instant::parse(until).ok().filter(|end| !end.is_negative()).and_then(|end| end.scan(period));
    end.ok_or_else(|| Failure::usage(format!("--until needs seconds from 0, found `{until}`")))
}

fn params(names: &Names<'_>) -> Vec<Element> {
    let mut params = Vec::new();
    for (i, point) in names.points.iter().enumerate().filter(|(_, point)| point.access == Access::Tunable) {
        params.extend((0..point.ty.elements() as u32).map(|element| Element { point: i as u32, element }));
    }
    params
}
