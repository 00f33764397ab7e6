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

/// The long form of the comparisons of random nets: with one another, and a tenth of them with their definition.
pub(crate) fn nets(count: u32) -> Result<(), String> {
    packages::install()?;
    let test = |name: &str| {
        let mut command = cargo();
        command.args(["test", "--release", "-p", "pcl2-tests", "--locked", "--test", name, "random_nets"]);
        command.args(["--", "--nocapture"]);
        command
    };
    run(test("nets_random").env("PCL2_RANDOM_NETS", count.to_string()))?;
    // Each of these runs alone.
    run(test("nets_second_definition").env("PCL2_DEFINED_NETS", (count / 10).to_string()))
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
