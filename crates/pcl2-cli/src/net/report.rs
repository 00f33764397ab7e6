//! `pcl2 net report`

use super::refuse;
use crate::args::CommonArgs;
use crate::console;
use crate::outcome::Outcome;
use crate::output::write_file;
use crate::project;
use clap::Args;
use pcl2_net::flat;
use pcl2_net::report::{self, Input};
use std::fs;
use std::path::{Path, PathBuf};

/// `pcl2 net report`
#[derive(Args, Debug)]
pub(crate) struct ReportArgs {
    /// A .net file, or a folder with pcl2.toml whose source is one
    path: PathBuf,
    /// The folder that takes NAME.html, NAME.md and NAME.svg
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    #[command(flatten)]
    common: CommonArgs,
}

/// Writes the documentation of a net.
pub(crate) fn report(args: &ReportArgs) -> Outcome {
    let project = match project::load(&args.path, &args.common) {
        Ok(project) => project,
        Err(outcome) => return outcome,
    };
    console::diagnostics(&project.diagnostics, &project.sources, project.left_out);
    let Some(verified) = &project.verified else {
        return Outcome::Errors;
    };
    let Some(written) = project.net() else {
        return refuse(&args.path, "expected a net, found a configuration: name the .net file");
    };
    let net = &written.nets[0];
    let flat = match flat::flat(net.decl, &project.catalogue, &project.symbols) {
        Ok(flat) => flat,
        Err(why) => return refuse(&args.path, &why),
    };
    let bindings = &verified.program().bindings;
    let document = report::report(&Input { written: &written, flat: &flat, sources: &project.sources, bindings });
    let picture = pcl2_draw::net::svg(&written);
    let name = &net.decl.name;
    let svg = format!("{name}.svg");
    write(&args.output, &format!("{name}.html"), &document.html(&picture))
        .and_then(|()| write(&args.output, &format!("{name}.md"), &document.markdown(&svg)))
        .and_then(|()| write(&args.output, &svg, &picture))
        .map_or_else(|outcome| outcome, |()| Outcome::Done)
}

fn write(folder: &Path, name: &str, text: &str) -> Result<(), Outcome> {
    let path = folder.join(name);
    let written = fs::create_dir_all(folder).and_then(|()| write_file(&path, text.as_bytes()));
    written.map_err(|error| {
        console::error(&format!("cannot write `{}`: {error}", path.display()));
        Outcome::Failed
    })
}
