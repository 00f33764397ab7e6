//! `pcl2 net compose`

use super::matrix::Kind;
use super::{load_flat, refuse};
use crate::console;
use crate::nets::is_net;
use crate::outcome::Outcome;
use crate::project::{MAX_SOURCE, read_regular};
use clap::Args;
use pcl2_net::flat::Flat;
use pcl2_net::structure::compose::{Composition, Piece, compose as composed};
use pcl2_net::structure::matrix::{Matrix, MatrixKind};
use std::path::{Path, PathBuf};

/// `pcl2 net compose`
#[derive(Args, Debug)]
pub(crate) struct ComposeArgs {
    /// .csv files with the matrices of parts, as `net matrix --csv` writes them, or one .net file with modules
    #[arg(required = true, value_name = "FILE")]
    paths: Vec<PathBuf>,
    /// Print the matrix alone, as CSV
    #[arg(long)]
    csv: bool,
    /// Of a .net file: which matrix; B = B+ - B- if not given
    #[arg(long, value_enum)]
    kind: Option<Kind>,
    /// A folder with nets
    #[arg(long, value_name = "DIR")]
    blocks: Vec<PathBuf>,
}

/// Puts a net's matrix together.
pub(crate) fn compose(args: &ComposeArgs) -> Outcome {
    let found = match args.paths.as_slice() {
        [path] if is_net(path) => {
            let kind = args.kind.unwrap_or(Kind::Change);
            load_flat(path, &args.blocks).map(|flat| pieces(&flat, kind.of()))
        }
        _ if args.kind.is_some() => {
            console::error(
                "expected one .net file with --kind, found others: a .csv file has one matrix, of its own kind",
            );
            return Outcome::Usage;
        }
        paths => paths.iter().map(|path| piece(path)).collect(),
    };
    let found = found.and_then(|pieces| {
        alike(&pieces)?;
        composed(&pieces).map_err(|why| {
            console::error(&why);
            Outcome::Errors
        })
    });
    found.map_or_else(|outcome| outcome, |composition| print(&composition, args.csv))
}

/// The matrix in a file.
fn piece(path: &Path) -> Result<Piece, Outcome> {
    if is_net(path) {
        return Err(refuse(path, "expected one .net file alone, or .csv files, found both"));
    }
    let bytes =
        read_regular(path, MAX_SOURCE).map_err(|why| refuse(path, &format!("expected a readable file: {why}")))?;
    let matrix = Matrix::read_csv(&bytes).map_err(|why| refuse(path, &why))?;
    Ok(Piece { name: path.file_stem().unwrap_or_default().to_string_lossy().into_owned(), matrix })
}

/// B, B- and B+ do not add up with each other.
fn alike(pieces: &[Piece]) -> Result<(), Outcome> {
    let Some(first) = pieces.first() else {
        return Ok(());
    };
    let Some(other) = pieces.iter().find(|piece| piece.matrix.label != first.matrix.label) else {
        return Ok(());
    };
    console::error(&format!(
        "expected matrices of one kind, found `{}` in `{}` and `{}` in `{}`",
        first.matrix.label, first.name, other.matrix.label, other.name
    ));
    Err(Outcome::Errors)
}

/// The net with its macros, and each module with those in it: no token goes from one to another.
fn pieces(flat: &Flat, kind: MatrixKind) -> Vec<Piece> {
    let mut homes: Vec<usize> = Vec::new();
    for (i, part) in flat.parts.iter().enumerate() {
        homes.push(if part.is_macro { homes[part.outer] } else { i });
    }
    let piece = |home: usize| {
        let own = || flat.parts.iter().zip(&homes).filter(|(_, other)| **other == home).map(|(part, _)| part);
        let places: Vec<_> = own().flat_map(|part| part.places.iter().copied()).collect();
        let transitions: Vec<_> = own().flat_map(|part| part.transitions.iter().copied()).collect();
        Piece { name: flat.parts[home].name.clone(), matrix: Matrix::of_part(&flat.net, kind, &places, &transitions) }
    };
    (0..flat.parts.len()).filter(|i| homes[*i] == *i).map(piece).collect()
}

fn print(composition: &Composition, csv: bool) -> Outcome {
    let mut text = Vec::new();
    let written = match csv {
        true => composition.matrix.write_csv(&mut text),
        false => {
            for module in &composition.modules {
                let copies = if module.copies == 1 { "1 copy".to_owned() } else { format!("{} copies", module.copies) };
                text.extend(format!("module {}: {copies}\n", module.module).bytes());
            }
            text.push(b'\n');
            composition.matrix.write_text(&mut text)
        }
    };
    if let Err(error) = written {
        console::error(&format!("cannot write the matrix: {error}"));
        return Outcome::Failed;
    }
    console::answer(&String::from_utf8_lossy(&text))
}
