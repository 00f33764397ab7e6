//! The whole test suite.

use crate::packages;
use crate::shell::run;
use std::process::Command;

/// Formats, lints and tests everything.
pub(crate) fn test() -> Result<(), String> {
    packages::install()?;
    run(cargo().args(["fmt", "--all", "--check"]))?;
    run(cargo().args(["clippy", "--workspace", "--all-targets", "--quiet", "--", "-D", "warnings"]))?;
    run(cargo().args(["test", "--workspace"]))
}

fn cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}
