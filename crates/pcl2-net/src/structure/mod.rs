//! What is known of a net from its arcs and its first marking, without its reachable markings; and the net taken apart
//! and put together again.

pub mod compose;
pub mod conflicts;
pub mod divide;
pub mod fire;
pub mod invariants;
pub mod matrix;
pub mod modules;
pub mod names;
pub mod part;
pub mod siphons;
pub mod step;
