//! PNML, the interchange format of ISO/IEC 15909-2, of place/transition nets.

mod bounds;
mod error;
mod read;

pub use error::PnmlError;
pub(crate) use read::PTNET;
pub use read::read;
