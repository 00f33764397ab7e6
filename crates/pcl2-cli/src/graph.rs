//! `pcl2 graph`

use crate::args::GraphArgs;
use crate::net;
use crate::nets::is_pnml;
use crate::outcome::Outcome;
use crate::project;
use pcl2_lang::net::Kind;
use pcl2_lang::net::written::{Written, WrittenNet};
use std::path::Path;

/// Draws a program, or a net of another tool. A period need not be known.
pub(crate) fn graph(args: &GraphArgs) -> Outcome {
    let picture = if is_pnml(&args.path) { pnml(&args.path) } else { program(args) };
    picture.map_or_else(|outcome| outcome, |picture| net::write(&args.path, &args.output, &picture))
}

fn program(args: &GraphArgs) -> Result<String, Outcome> {
    let (project, verified) = project::load_checked(&args.path, &args.common)?;
    Ok(match project.net() {
        Some(net) => pcl2_draw::net::svg(&net),
        None => pcl2_draw::graph::svg(&verified),
    })
}

/// A place/transition net: there are no lines, so places are boxes of the kind that they are like.
fn pnml(path: &Path) -> Result<String, Outcome> {
    let declared = pcl2_net::pt::declared(&net::load_pnml(path)?);
    let decl = declared.map_err(|why| net::refuse(path, &why))?;
    let net = decl.net.as_deref().ok_or(Outcome::Errors)?;
    let word = |kind: &Kind| if matches!(kind, Kind::Capacity) { "CAPACITY" } else { "STATE" }.to_owned();
    let words = net.boxes.iter().map(|place| word(&place.kind)).collect();
    let written = WrittenNet { decl: &decl, net, statements: Vec::new(), words, parts: Vec::new() };
    Ok(pcl2_draw::net::svg(&Written { nets: vec![written] }))
}
