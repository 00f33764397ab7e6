//! PNML, after ISO/IEC 15909-2.

use super::names::Namer;
use super::plain::plain;
use crate::pnml::PTNET;
use crate::pt::PtNet;
use std::fmt::Write;

/// A net as PNML. Capacities, read arcs and inhibitors, which place/transition nets do not have there, become places
/// and arcs. Names that are no XML ids stand beside ids of their own.
pub fn pnml(net: &PtNet) -> Result<String, String> {
    let net = plain(net)?;
    let mut namer = Namer::new(|letter| letter.is_ascii_alphanumeric() || "_.-".contains(letter), |_| false);
    let places = namer.names(net.places.iter().map(|place| place.name.as_str()));
    let transitions = namer.names(net.transitions.iter().map(|transition| transition.name.as_str()));
    let (id, page) = (namer.names(["net"].into_iter()), namer.names(["page"].into_iter()));
    let mut text = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    let _ = writeln!(text, "<pnml xmlns=\"http://www.pnml.org/version-2009/grammar/pnml\">");
    let _ = writeln!(text, "  <net id=\"{}\" type=\"{PTNET}\">", id.concat());
    let _ = writeln!(text, "    <name><text>{}</text></name>", escaped(&net.name));
    let _ = writeln!(text, "    <page id=\"{}\">", page.concat());
    for (place, id) in net.places.iter().zip(&places) {
        let _ = writeln!(text, "      <place id=\"{id}\">");
        let _ = writeln!(text, "        <name><text>{}</text></name>", escaped(&place.name));
        if place.initial > 0 {
            let _ = writeln!(text, "        <initialMarking><text>{}</text></initialMarking>", place.initial);
        }
        text.push_str("      </place>\n");
    }
    for (transition, id) in net.transitions.iter().zip(&transitions) {
        let name = escaped(&transition.name);
        let _ = writeln!(text, "      <transition id=\"{id}\"><name><text>{name}</text></name></transition>");
    }
    arcs(&net, &places, &transitions, &mut namer, &mut text);
    text.push_str("    </page>\n  </net>\n</pnml>\n");
    Ok(text)
}

fn arcs(net: &PtNet, places: &[String], transitions: &[String], namer: &mut Namer, text: &mut String) {
    for (transition, own) in net.transitions.iter().zip(transitions) {
        let takes = transition.takes.iter().map(|arc| (arc, true));
        for (arc, is_take) in takes.chain(transition.puts.iter().map(|arc| (arc, false))) {
            let place = &places[arc.place.0 as usize];
            let (source, target) = if is_take { (place, own) } else { (own, place) };
            let id = namer.names([format!("{source}-{target}").as_str()].into_iter()).concat();
            let _ = write!(text, "      <arc id=\"{id}\" source=\"{source}\" target=\"{target}\"");
            let _ = match arc.weight {
                1 => writeln!(text, "/>"),
                weight => writeln!(text, "><inscription><text>{weight}</text></inscription></arc>"),
            };
        }
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
