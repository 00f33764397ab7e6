//! Processor time and peak memory of a program.

use std::process::{Command, Stdio};
use wait4::Wait4;

/// What a program used, with the programs it started.
#[derive(Clone, Copy)]
pub(crate) struct Usage {
    /// User and system time, seconds.
    pub(crate) seconds: f64,
    /// Peak resident memory, bytes.
    pub(crate) bytes: f64,
}

/// Runs a program whose output does not matter.
pub(crate) fn usage(command: &mut Command) -> Result<Usage, String> {
    let name = command.get_program().to_string_lossy().into_owned();
    let mut child =
        command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().map_err(|error| format!("{name}: {error}"))?;
    let used = child.wait4().map_err(|error| format!("{name}: {error}"))?;
    if !used.status.success() {
        return Err(format!("{command:?} ended with {}", used.status));
    }
    let time = used.rusage.utime + used.rusage.stime;
    Ok(Usage { seconds: time.as_secs_f64(), bytes: used.rusage.maxrss as f64 })
}

/// Runs several programs in turn, so often; for each the medians.
pub(crate) fn in_turn(rounds: usize, commands: &mut [Command]) -> Result<Vec<Usage>, String> {
    let mut all = vec![Vec::new(); commands.len()];
    for _ in 0..rounds {
        for (command, seen) in commands.iter_mut().zip(&mut all) {
            seen.push(usage(command)?);
        }
    }
    let over = |seen: &[Usage], part: fn(&Usage) -> f64| median(seen.iter().map(part).collect());
    Ok(all
        .iter()
        .map(|seen| Usage { seconds: over(seen, |one| one.seconds), bytes: over(seen, |one| one.bytes) })
        .collect())
}

/// The middle value; 0 of nothing.
pub(crate) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}
