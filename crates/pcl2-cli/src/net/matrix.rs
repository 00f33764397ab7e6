//! `pcl2 net matrix`

use super::{NetPath, load, load_flat};
use crate::console;
use crate::nets::is_net;
use crate::outcome::Outcome;
use clap::{Args, ValueEnum};
use pcl2_net::flat::{Flat, FlatPart};
use pcl2_net::pt::{PlaceId, PtNet, TransitionId};
use pcl2_net::structure::matrix::{Matrix, MatrixKind};
use pcl2_net::structure::modules::modules;
use pcl2_net::structure::names::size;
use std::collections::BTreeSet;

/// `pcl2 net matrix`
#[derive(Args, Debug)]
pub(crate) struct MatrixArgs {
    #[command(flatten)]
    net: NetPath,
    /// Print CSV: transitions in the header, a place at the start of each line
    #[arg(long)]
    csv: bool,
    /// The matrices of this part or module alone
    #[arg(long, value_name = "NAME")]
    of: Option<String>,
    /// This matrix alone
    #[arg(long, value_enum)]
    kind: Option<Kind>,
}

/// Which matrix.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Kind {
    /// B-: what transitions take
    Takes,
    /// B+: what transitions put
    Puts,
    /// B = B+ - B-
    Change,
    /// What transitions read
    Read,
    /// The weights of inhibitor arcs
    Inhibit,
}

impl Kind {
    /// As the library knows it.
    pub(super) fn of(self) -> MatrixKind {
        match self {
            Kind::Takes => MatrixKind::Takes,
            Kind::Puts => MatrixKind::Puts,
            Kind::Change => MatrixKind::Change,
            Kind::Read => MatrixKind::Reads,
            Kind::Inhibit => MatrixKind::Inhibits,
        }
    }
}

/// Places and transitions with a title.
struct Section {
    what: &'static str,
    name: String,
    places: Vec<PlaceId>,
    transitions: Vec<TransitionId>,
}

/// Prints the matrices of a net and of its parts.
pub(crate) fn matrix(args: &MatrixArgs) -> Outcome {
    let (net, parts) = match parts_of(&args.net) {
        Ok(found) => found,
        Err(outcome) => return outcome,
    };
    let mut sections = sections(&net, &parts);
    if let Some(name) = &args.of {
        let names: Vec<String> = sections.iter().map(|section| section.name.clone()).collect();
        sections.retain(|section| section.name == *name);
        sections.truncate(1);
        if sections.is_empty() {
            console::error(&format!("expected one of {} behind --of, found `{name}`", names.join(", ")));
            return Outcome::Usage;
        }
    }
    let mut text = Vec::new();
    let written = sections.iter().try_for_each(|section| write(&net, section, args, &mut text));
    if let Err(error) = written {
        console::error(&format!("cannot write the matrices: {error}"));
        return Outcome::Failed;
    }
    console::answer(&String::from_utf8_lossy(&text))
}

fn parts_of(path: &NetPath) -> Result<(PtNet, Vec<FlatPart>), Outcome> {
    if is_net(&path.path) {
        let Flat { net, parts, .. } = load_flat(&path.path, &path.blocks)?;
        return Ok((net, parts));
    }
    Ok((load(&path.path, &path.blocks)?, Vec::new()))
}

/// The whole, the nets inside it, and the modules among which no token moves.
fn sections(net: &PtNet, parts: &[FlatPart]) -> Vec<Section> {
    let places = (0..net.places.len() as u32).map(PlaceId).collect();
    let transitions = (0..net.transitions.len() as u32).map(TransitionId).collect();
    let mut sections = vec![Section { what: "net", name: net.name.clone(), places, transitions }];
    for part in parts.iter().skip(1) {
        let what = if part.is_macro { "macro" } else { "module" };
        let (places, transitions) = (part.places.clone(), part.transitions.clone());
        sections.push(Section { what, name: part.name.clone(), places, transitions });
    }
    let known: BTreeSet<Vec<PlaceId>> = sections.iter().map(|section| section.places.clone()).collect();
    let loops = modules(net).into_iter().filter(|module| !module.places.is_empty() && !known.contains(&module.places));
    sections.extend(loops.map(|module| Section {
        what: "loop",
        name: module.name,
        places: module.places,
        transitions: module.transitions,
    }));
    sections
}

fn write(net: &PtNet, section: &Section, args: &MatrixArgs, text: &mut Vec<u8>) -> std::io::Result<()> {
    if !args.csv {
        let size = size(section.places.len(), section.transitions.len());
        let heading = format!("{} {}, {size}", section.what, section.name);
        text.extend(format!("{}{heading}\n", if text.is_empty() { "" } else { "\n" }).bytes());
    }
    for kind in MatrixKind::ALL {
        let matrix = Matrix::of_part(net, kind, &section.places, &section.transitions);
        let asked = args.kind.map(Kind::of);
        let is_empty = (0..matrix.rows.len()).all(|row| matrix.row(row).is_empty());
        let shown = asked.map_or(!is_empty || matches!(kind, MatrixKind::Change), |asked| asked == kind);
        if !shown {
            continue;
        }
        if !text.is_empty() {
            text.push(b'\n');
        }
        match args.csv {
            true => matrix.write_csv(text)?,
            false => matrix.write_text(text)?,
        }
    }
    Ok(())
}
