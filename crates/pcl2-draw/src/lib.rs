//! Pictures as SVG text: a verified program as a block diagram, a net as a net, signals over time as trends.
//!
//! All of it is arithmetic on the input: no font is measured, no file, clock or terminal is touched, and the same
//! input gives the same bytes.

pub mod graph;
pub mod net;
pub mod plot;
pub mod svg;
