//! What a net does, written down a second time: plain, slow, and from the page of the language alone.
//!
//! Nothing here is shared with the player of nets, neither code nor tables, so that a run can be compared with it.

pub mod expression;
pub mod model;
pub mod text;

mod arrivals;
mod boxes;
mod gates;
mod hands;
mod instance;
mod outputs;
mod rules;
mod statements;
mod tokens;

pub use instance::Run;

/// What the health record can tell of a net.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// An edge of a GENERATE box without room.
    Lost,
    /// Two different writes of one output.
    Conflict,
    /// A PROCESS box that was not complete in time.
    Late,
    /// A gate or a token that an operator forced.
    Forced,
    /// A command that was not obeyed.
    Refused,
}
