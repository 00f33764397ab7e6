//! Text, diagnostics, declarations and the intermediate form of PCL2.
//!
//! Nothing here touches files, clocks or the terminal. Parsing and checking cannot fail: they return what
//! they understood together with diagnostics.

pub mod ast;
pub mod border;
pub mod bounds;
pub mod catalogue;
pub mod codes;
pub mod decl;
pub mod declare;
pub mod diagnostic;
pub mod format;
pub mod kernel;
pub mod lexer;
pub mod manual;
pub mod model;
pub mod net;
pub mod program;
pub mod render;
pub mod source;
pub mod suggest;
pub mod symbol;
pub mod syntax;
pub mod types;
pub mod verify;
