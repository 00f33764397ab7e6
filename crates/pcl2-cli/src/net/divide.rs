//! `pcl2 net divide`

use super::{NetPath, load, refuse};
use crate::console;
use crate::outcome::Outcome;
use clap::Args;
use pcl2_net::pt::{Arc, PtNet, Transition};
use pcl2_net::structure::divide::{Division, SubNet, divide as divided};
use pcl2_net::structure::names::size;
use pcl2_net::structure::part::ArcKind;
use std::fmt::Write;

/// `pcl2 net divide`
#[derive(Args, Debug)]
pub(crate) struct DivideArgs {
    #[command(flatten)]
    net: NetPath,
    /// The places of the main loop
    #[arg(long, required = true, value_name = "NAME,..", value_delimiter = ',')]
    steps: Vec<String>,
}

/// Divides a flat net by its steps into a main loop and sub-nets.
pub(crate) fn divide(args: &DivideArgs) -> Outcome {
    let net = match load(&args.net.path, &args.net.blocks) {
        Ok(net) => net,
        Err(outcome) => return outcome,
    };
    let steps: Vec<&str> = args.steps.iter().map(|step| step.trim()).collect();
    match divided(&net, &steps) {
        Ok(division) => console::answer(&text(&net, &division)),
        Err(why) => refuse(&args.net.path, &why),
    }
}

fn text(net: &PtNet, division: &Division) -> String {
    let mut text = String::new();
    let main = &division.main.net;
    heading(&mut text, "main", main);
    for transition in &main.transitions {
        let _ = writeln!(text, "  {}", line(main, transition));
    }
    for sub_net in &division.sub_nets {
        text.push('\n');
        self::sub_net(&mut text, net, main, sub_net);
    }
    if !division.notes.is_empty() {
        text.push('\n');
    }
    for note in &division.notes {
        let _ = writeln!(text, "note: {note}");
    }
    text
}

fn heading(text: &mut String, name: &str, net: &PtNet) {
    let _ = writeln!(text, "{name}: {}", size(net.places.len(), net.transitions.len()));
    let names: Vec<&str> = net.places.iter().map(|place| place.name.as_str()).collect();
    let _ = writeln!(text, "  places {}", names.join(" "));
}

fn sub_net(text: &mut String, net: &PtNet, main: &PtNet, sub_net: &SubNet) {
    let own = &sub_net.part.net;
    heading(text, &main.places[sub_net.place.0 as usize].name, own);
    let step = &net.places[sub_net.step.0 as usize].name;
    let exit = &net.transitions[sub_net.exit.0 as usize].name;
    let starts = sub_net.starts.iter().map(|id| own.transitions[id.0 as usize].name.as_str());
    let _ = writeln!(text, "  step {step} starts {}", starts.collect::<Vec<_>>().join(" "));
    let ends = sub_net.ends.iter().map(|(arc, kind)| {
        let not = if *kind == ArcKind::Inhibit { "no " } else { "" };
        format!("{not}{}", term(own, arc))
    });
    let ends = ends.collect::<Vec<_>>().join(" ");
    let ends = if ends.is_empty() { "nothing in it" } else { &ends };
    let _ = writeln!(text, "  {exit} waits for {ends}");
    for transition in &own.transitions {
        let _ = writeln!(text, "  {}", line(own, transition));
    }
}

/// A transition in the notation of nets.
fn line(net: &PtNet, transition: &Transition) -> String {
    let list = |arcs: &[Arc]| arcs.iter().map(|arc| term(net, arc)).collect::<Vec<_>>().join(", ");
    let mut text = format!("{} : {} -> {}", transition.name, list(&transition.takes), list(&transition.puts));
    for (word, arcs) in [("READ", &transition.reads), ("INHIBIT", &transition.inhibits)] {
        if !arcs.is_empty() {
            let _ = write!(text, " {word} {}", list(arcs));
        }
    }
    text
}

fn term(net: &PtNet, arc: &Arc) -> String {
    let name = &net.places[arc.place.0 as usize].name;
    if arc.weight == 1 { name.clone() } else { format!("{}*{name}", arc.weight) }
}
