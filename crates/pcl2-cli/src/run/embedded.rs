//! The embedded engine: scans between two events or two rows run without a look around.

use super::job::Job;
use super::pace::Pace;
use super::progress::Progress;
use super::recorder::{Recorder, Recording};
use super::{Failure, Finished};
use pcl2_sim::engine::Machine;
use pcl2_sim::number::Number;

/// Runs a job.
pub(crate) fn run(job: &Job<'_>, mut machine: Machine<'_>, recorder: &mut Recorder) -> Result<Finished, Failure> {
    let columns: Vec<_> = job.columns.iter().map(|column| machine.probe(job.names, *column)).collect();
    let params: Vec<_> = job.params.iter().map(|param| machine.probe(job.names, *param)).collect();
    let mut progress = Progress::new(job.scans);
    let mut row: Vec<Number> = Vec::with_capacity(columns.len());
    let mut events = job.events.as_slice();
    let mut scan = 0;
    let pace = job.realtime.map(Pace::new);
    while scan < job.scans {
        if let Some(pace) = &pace {
            pace.wait(scan);
        }
        let due = events.partition_point(|event| event.scan <= scan);
        if due > 0 {
            if let Err(refusal) = machine.apply(job.names, &events[..due]) {
                progress.line(&refused(scan, &refusal.to_string()));
            }
            events = &events[due..];
        }
        let recorded = recorder.next(scan);
        let event = events.first().map_or(u64::MAX, |event| event.scan);
        let end = recorded.saturating_add(1).min(event).min(job.scans).min(scan.saturating_add(progress.stride()));
        let end = if pace.is_some() { scan + 1 } else { end };
        machine.run(end - scan);
        scan = end;
        if scan.checked_sub(1) == Some(recorded) {
            row.clear();
            row.extend(columns.iter().map(|probe| machine.read(*probe)));
            if recorder.row(recorded, &row)? == Recording::Closed {
                break;
            }
        }
        progress.at(scan);
    }
    Ok(Finished { health: machine.health(), params: params.iter().map(|probe| machine.read(*probe)).collect() })
}

/// The line for a refused set.
pub(crate) fn refused(scan: u64, reason: &str) -> String {
    format!("scan {scan}: set refused: {reason}")
}
