//! `pcl2 net report`

use super::refuse;
use crate::args::CommonArgs;
use crate::outcome::Outcome;
use crate::output::Pending;
use crate::project;
use crate::run::Failure;
use crate::run::files::cannot_write;
use clap::Args;
use pcl2_net::flat;
use pcl2_net::report::{self, Input};
use std::fs;
use std::io::{self, Write};
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
    let (project, verified) = match project::load_checked(&args.path, &args.common) {
        Ok(loaded) => loaded,
        Err(outcome) => return outcome,
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
    let files = [
        (format!("{name}.html"), document.html(&picture)),
        (format!("{name}.md"), document.markdown(&svg)),
        (svg, picture),
    ];
    match write(&args.output, &files) {
        Ok(()) => Outcome::Done,
        Err(failure) => failure.report(),
    }
}

/// Writes all files, or none where one cannot be written.
fn write(folder: &Path, files: &[(String, String)]) -> Result<(), Failure> {
    fs::create_dir_all(folder).map_err(|error| cannot_write(folder, &error))?;
    let mut pending = Vec::with_capacity(files.len());
    for (name, text) in files {
        let path = folder.join(name);
        if path.is_dir() {
            return Err(cannot_write(&path, &io::Error::from(io::ErrorKind::IsADirectory)));
        }
        let mut file = Pending::new(&path).map_err(|error| cannot_write(&path, &error))?;
        file.write_all(text.as_bytes()).map_err(|error| cannot_write(&path, &error))?;
        pending.push((path, file));
    }
    pending.into_iter().try_for_each(|(path, file)| file.keep().map_err(|error| cannot_write(&path, &error)))
}
