//! `pcl2 graph`

use crate::args::GraphArgs;
use crate::outcome::Outcome;
use crate::project;
use crate::run::files::{self, Output};

/// Draws a program. A period need not be known.
pub(crate) fn graph(args: &GraphArgs) -> Outcome {
    let (project, verified) = match project::load_checked(&args.path, &args.common) {
        Ok(loaded) => loaded,
        Err(outcome) => return outcome,
    };
    let picture = match project.net() {
        Some(net) => pcl2_draw::net::svg(&net),
        None => pcl2_draw::graph::svg(&verified),
    };
    let written = Output::open(&args.output).and_then(|mut output| {
        files::write(&args.output, &mut output, picture.as_bytes())?;
        output.keep()
    });
    written.map_or_else(|failure| failure.report(), |()| Outcome::Done)
}
