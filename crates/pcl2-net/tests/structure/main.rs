//! The structure of nets: the paper's measuring tank, nets with known answers, and small nets with all answers tried.
#![expect(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

mod composing;
mod conflicts;
mod dividing;
mod firing;
mod invariants;
mod nets;
mod siphons;
mod tank;
