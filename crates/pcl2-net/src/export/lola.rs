//! The low-level nets of LoLA.

use super::names::Namer;
use super::plain::plain;
use crate::pt::{Arc, PtNet};
use std::fmt::Write;

/// A net as LoLA reads it. Capacities, read arcs and inhibitors become places and arcs.
pub fn lola(net: &PtNet) -> Result<String, String> {
    let net = plain(net)?;
    let mut namer = Namer::new(is_allowed, is_reserved);
    let places = namer.names(net.places.iter().map(|place| place.name.as_str()));
    let transitions = namer.names(net.transitions.iter().map(|transition| transition.name.as_str()));
    let mut text = String::new();
    let _ = writeln!(text, "PLACE\n  {};\n", places.join(",\n  "));
    let marked = net.places.iter().zip(&places).filter(|(place, _)| place.initial > 0);
    let marked: Vec<String> = marked.map(|(place, name)| format!("{name} : {}", place.initial)).collect();
    let _ = writeln!(text, "MARKING\n  {};", marked.join(",\n  "));
    for (transition, name) in net.transitions.iter().zip(&transitions) {
        let _ = writeln!(text, "\nTRANSITION {name}");
        let _ = writeln!(text, "CONSUME {};", list(&transition.takes, &places));
        let _ = writeln!(text, "PRODUCE {};", list(&transition.puts, &places));
    }
    Ok(text)
}

fn list(arcs: &[Arc], places: &[String]) -> String {
    let arc = |arc: &Arc| format!("{} : {}", places[arc.place.0 as usize], arc.weight);
    arcs.iter().map(arc).collect::<Vec<_>>().join(", ")
}

/// Both of its versions take such names.
fn is_allowed(letter: char) -> bool {
    letter.is_ascii_alphanumeric() || "_.[]".contains(letter)
}

/// Its keywords are words in capitals, and so are those of its formulas.
fn is_reserved(name: &str) -> bool {
    name.len() > 1 && name.bytes().all(|letter| letter.is_ascii_uppercase())
}
