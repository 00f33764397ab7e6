//! `pcl2 build`

use crate::args::BuildArgs;
use crate::outcome::Outcome;
use crate::project;

/// Compiles programs to C.
pub(crate) fn build(args: &BuildArgs) -> Outcome {
    for path in &args.paths {
        if let Err(outcome) = project::load_verified(path, &args.common) {
            return outcome;
        }
    }
    Outcome::Done
}
