//! Text, diagnostics, declarations and the intermediate form of PCL2.
//!
//! Nothing here touches files, clocks or the terminal. Parsing and checking cannot fail: they return what
//! they understood together with diagnostics.

pub mod ast;
pub mod codes;
pub mod decl;
pub mod diagnostic;
pub mod kernel;
pub mod model;
pub mod program;
pub mod render;
pub mod source;
pub mod symbol;
pub mod types;
pub mod verify;
