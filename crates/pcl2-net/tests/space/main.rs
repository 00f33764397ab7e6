//! The state space and the analysis of nets, against searches that are written down plainly.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

mod agreement;
mod coverability;
mod deadlocks;
mod nets;
mod plain;
mod reachable;
