//! A net as other tools read it: PNML, LoLA, LTSmin.

mod lola;
mod ltsmin;
mod names;
mod plain;
mod pnml;

pub use lola::lola;
pub use ltsmin::ltsmin;
pub use plain::plain;
pub use pnml::pnml;
