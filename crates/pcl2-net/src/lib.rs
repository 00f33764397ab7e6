//! Petri nets: the `.net` front end, and what is asked of a net before it runs.
//!
//! A net becomes a function code: its declaration has the head's ports, outputs and parameters, its statements as body,
//! and when they run as [`pcl2_lang::net::Net`]. Nothing here touches files, clocks or the terminal.

pub mod analysis;
mod check;
pub mod export;
pub mod flat;
pub mod pnml;
pub mod pt;
pub mod report;
pub mod space;
pub mod structure;

pub use check::{compile, wanted};
