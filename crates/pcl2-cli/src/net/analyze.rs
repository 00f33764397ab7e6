//! `pcl2 net analyze`

use super::AnalyzeArgs;
use super::answers::Report;
use crate::console;
use crate::nets::is_net;
use crate::outcome::Outcome;
use clap::ValueEnum;
use indicatif::{ProgressBar, ProgressStyle};
use pcl2_net::analysis;
use pcl2_net::pt::PtNet;
use pcl2_net::space::{Limit, Semantics};
use std::fs;

/// What may happen at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Choice {
    /// All that fires in one scan
    Step,
    /// One transition
    Interleaving,
}

impl Choice {
    fn semantics(self) -> Semantics {
        match self {
            Choice::Step => Semantics::Step,
            Choice::Interleaving => Semantics::Interleaving,
        }
    }
}

/// Analyses a net.
pub(crate) fn analyze(net: &PtNet, args: &AnalyzeArgs) -> Outcome {
    let usual = if is_net(&args.net.path) { Choice::Step } else { Choice::Interleaving };
    let semantics = args.semantics.unwrap_or(usual).semantics();
    let limit = args.limit.map_or_else(|| Limit::bytes(free_memory() / 2), Limit::markings);
    let bar = bar();
    let analysis = analysis::analyze(net, semantics, limit, &mut |markings| bar.set_position(markings));
    bar.finish_and_clear();
    let report = Report { net, semantics, analysis: &analysis };
    console::answer(&if args.json { format!("{}\n", report.json()) } else { report.text() })
}

/// A bar for a search whose end nobody knows, if somebody watches.
fn bar() -> ProgressBar {
    if !console::interactive() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new_spinner();
    if let Ok(style) = ProgressStyle::with_template("{spinner} {human_pos} markings {elapsed}") {
        bar.set_style(style);
    }
    bar
}

/// Bytes that nobody uses; without an answer of the system as many as a small machine has.
fn free_memory() -> u64 {
    let text = fs::read_to_string("/proc/meminfo").unwrap_or_default();
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"));
    let kilobytes = line.and_then(|line| line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok());
    kilobytes.map_or(1 << 30, |kilobytes| kilobytes.saturating_mul(1024))
}
