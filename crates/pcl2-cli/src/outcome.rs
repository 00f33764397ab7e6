//! Exit statuses.

/// How a command ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Outcome {
    /// Done; warnings and refused sets included.
    Done,
    /// The program has errors.
    Errors,
    /// Wrong usage.
    Usage,
    /// Stimulus, output, compiler, emulator or board failed.
    Failed,
}

impl Outcome {
    /// Goes on after what is done, and ends with anything else.
    pub(crate) fn done(self) -> Result<(), Outcome> {
        if self == Outcome::Done { Ok(()) } else { Err(self) }
    }

    /// The exit status.
    pub(crate) fn code(self) -> u8 {
        match self {
            Outcome::Done => 0,
            Outcome::Errors => 1,
            Outcome::Usage => 2,
            Outcome::Failed => 3,
        }
    }
}
