//! `pcl2 net export`

use super::{NetPath, load, refuse};
use crate::outcome::Outcome;
use crate::run::files::{self, Output};
use clap::{Args, ValueEnum};
use pcl2_net::export;
use std::path::{Path, PathBuf};

/// `pcl2 net export`
#[derive(Args, Debug)]
pub(crate) struct ExportArgs {
    #[command(flatten)]
    net: NetPath,
    /// The format
    #[arg(long, value_enum)]
    to: Format,
    /// The file (`-`: to standard output)
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: PathBuf,
}

/// What other tools read.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Format {
    /// PNML, ISO/IEC 15909-2
    Pnml,
    /// The low-level nets of LoLA
    Lola,
    /// C for LTSmin's PINS interface
    Ltsmin,
}

/// Writes a net for another tool.
pub(crate) fn export(args: &ExportArgs) -> Outcome {
    let net = match load(&args.net.path, &args.net.blocks) {
        Ok(net) => net,
        Err(outcome) => return outcome,
    };
    let text = match args.to {
        Format::Pnml => export::pnml(&net),
        Format::Lola => export::lola(&net),
        Format::Ltsmin => export::ltsmin(&net),
    };
    match text {
        Ok(text) => write(&args.net.path, &args.output, &text),
        Err(why) => refuse(&args.net.path, &why),
    }
}

/// Writes a text that was made of a source to a file or to standard output.
pub(crate) fn write(source: &Path, path: &Path, text: &str) -> Outcome {
    if let (Ok(source), Ok(file)) = (source.canonicalize(), path.canonicalize())
        && source == file
    {
        return refuse(path, "expected another file than the source for the output, found the source");
    }
    let written = Output::open(path).and_then(|mut output| {
        files::write(path, &mut output, text.as_bytes())?;
        output.keep()
    });
    written.map_or_else(|failure| failure.report(), |()| Outcome::Done)
}
