//! Runs a verified program by calling the C kernels, and speaks the CSV of stimulus and trace.
//!
//! Nothing here touches files, clocks or the terminal.

pub mod clock;
pub mod engine;
mod ffi;
pub mod health;
pub mod names;
pub mod number;
pub mod stimulus;
pub mod trace;
