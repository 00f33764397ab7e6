//! The whole test suite.

use crate::packages;
use crate::shell::{found, run};
use std::process::Command;

/// Formats, lints and tests everything.
pub(crate) fn test() -> Result<(), String> {
    packages::install()?;
    components()?;
    run(cargo().args(["fmt", "--all", "--check"]))?;
    run(cargo().args(["clippy", "--workspace", "--all-targets", "--locked", "--quiet", "--", "-D", "warnings"]))?;
    // Snapshots are compared, never written.
    run(cargo().args(["test", "--workspace", "--locked", "--no-fail-fast"]).env("INSTA_UPDATE", "no"))
}

/// The long form of the comparison of random nets.
pub(crate) fn nets(count: u32) -> Result<(), String> {
    packages::install()?;
    let test = ["test", "--release", "-p", "pcl2-tests", "--locked", "random_nets", "--test"];
    run(cargo().args(test).arg("nets_random").env("PCL2_RANDOM_NETS", count.to_string()))?;
    // Each of these runs alone.
    run(cargo().args(test).arg("nets_second_definition").env("PCL2_DEFINED_NETS", (count / 10).to_string()))
}

/// Adds the formatter and the linter to a toolchain that came without them.
fn components() -> Result<(), String> {
    let has = |tool: &str| cargo().args([tool, "--version"]).output().is_ok_and(|output| output.status.success());
    if (has("fmt") && has("clippy")) || !found("rustup") {
        return Ok(());
    }
    run(Command::new("rustup").args(["component", "add", "rustfmt", "clippy"]))
}

fn cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}
