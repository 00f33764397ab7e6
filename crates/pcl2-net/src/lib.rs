//! Petri nets: what is asked of a net before it runs.
//!
//! Nothing here touches files, clocks or the terminal.

pub mod pt;
pub mod structure;
