//! `pcl2 net flatten`

use super::{NetPath, load_project, refuse, write};
use crate::console;
use crate::nets::is_net;
use crate::outcome::Outcome;
use crate::project::Project;
use crate::run::files::is_stdout;
use clap::Args;
use pcl2_lang::declare;
use pcl2_lang::diagnostic::Diagnostic;
use pcl2_lang::format::format_net;
use pcl2_lang::source::Sources;
use std::path::{Path, PathBuf};

/// `pcl2 net flatten`
#[derive(Args, Debug)]
pub(crate) struct FlattenArgs {
    #[command(flatten)]
    net: NetPath,
    /// The file, after which the flat net is called (`-`: to standard output, with the net's own name)
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: PathBuf,
}

/// Writes a net without macros and modules that does the same.
pub(crate) fn flatten(args: &FlattenArgs) -> Outcome {
    if !is_net(&args.net.path) {
        return refuse(&args.net.path, "expected a .net file, found another: other nets are flat already");
    }
    let mut project = match load_project(&args.net.path, &args.net.blocks) {
        Ok(project) => project,
        Err(outcome) => return outcome,
    };
    let name = name(&args.output, &project.stem);
    let Some(decl) = project.catalogue.find(&project.stem) else {
        return Outcome::Errors;
    };
    let text = pcl2_net::flat_text(decl, &name, &project.catalogue, &project.symbols, &project.sources);
    match text.and_then(|text| laid_out(&mut project, &name, text)) {
        Ok(text) => write(&args.net.path, &args.output, &text),
        Err(why) => refuse(&args.net.path, &why),
    }
}

/// A net is called after its file.
fn name(output: &Path, stem: &str) -> String {
    let own = output.file_stem().filter(|_| !is_stdout(output));
    own.map_or_else(|| stem.to_owned(), |own| own.to_string_lossy().into_owned())
}

/// The text in the layout of nets, if it is a net without mistakes: names may be too long.
fn laid_out(project: &mut Project, name: &str, text: String) -> Result<String, String> {
    let mut sources = Sources::default();
    let file = sources.add(format!("{name}.net"), text.into_bytes());
    let text = format_net(sources.file(file)).ok_or("expected a flat net that can be laid out, found another")?;
    let mut sources = Sources::default();
    let file = sources.add(format!("{name}.net"), text.clone());
    let mut diagnostics = Vec::new();
    if let Some(read) = declare::net::read(&sources, file, name, &mut project.symbols, &mut diagnostics) {
        let _ = pcl2_net::compile(read, &sources, &mut project.symbols, &project.catalogue, &mut diagnostics);
    }
    if diagnostics.iter().any(Diagnostic::is_error) {
        console::diagnostics(&diagnostics, &sources, 0);
        return Err("expected a flat net without mistakes, found them in what would be written".to_owned());
    }
    String::from_utf8(text).map_err(|error| error.to_string())
}
