//! A place/transition net as a net of the language, for pictures: places are boxes, transitions are gates.

use super::{Arc, Place, PtNet, Transition};
use pcl2_lang::decl::Decl;
use pcl2_lang::net::{self, BoxId, Gate, Kind, MAX_COUNT, Net, NetBox, Order, Tested};
use pcl2_lang::source::{FileId, Span};

/// The declaration of a net that is nowhere written in the language. The error says what it has too many of.
pub fn declared(net: &PtNet) -> Result<Decl, String> {
    for (count, what) in [(net.places.len(), "places"), (net.transitions.len(), "transitions")] {
        if count > MAX_COUNT {
            return Err(format!("expected at most {MAX_COUNT} {what}, found {count}"));
        }
    }
    let boxes = net.places.iter().map(place).collect::<Result<Vec<NetBox>, String>>()?;
    let gates = (0_u32..).zip(&net.transitions).map(|(at, transition)| gate(at, transition));
    let gates = gates.collect::<Result<Vec<Gate>, String>>()?;
    let mut decl = Decl::new(net.name.clone(), nowhere(0));
    decl.net = Some(Box::new(Net { boxes, gates, ..Net::default() }));
    Ok(decl)
}

/// A line of no file: gates stand in its order.
fn nowhere(line: u32) -> Span {
    Span { file: FileId(0), start: line, end: line }
}

fn place(place: &Place) -> Result<NetBox, String> {
    let kind = if place.capacity.is_some_and(|capacity| capacity > 1) { Kind::Capacity } else { Kind::State };
    Ok(NetBox {
        name: place.name.clone(),
        kind,
        class: None,
        capacity: place.capacity.map(number).transpose()?,
        initial: number(place.initial)?,
        presets: Vec::new(),
        order: Order::Fifo,
        span: nowhere(0),
    })
}

fn gate(at: u32, transition: &Transition) -> Result<Gate, String> {
    Ok(Gate {
        name: transition.name.clone(),
        before: arcs(&transition.takes)?,
        after: arcs(&transition.puts)?,
        reads: tested(&transition.reads)?,
        inhibits: tested(&transition.inhibits)?,
        priority: 0,
        permits: Vec::new(),
        rules: Vec::new(),
        span: nowhere(at),
    })
}

fn arcs(arcs: &[Arc]) -> Result<Vec<net::Arc>, String> {
    arcs.iter().map(|arc| Ok(net::Arc { place: BoxId(arc.place.0), weight: number(arc.weight)? })).collect()
}

fn tested(arcs: &[Arc]) -> Result<Vec<Tested>, String> {
    let one = |arc: &Arc| Ok(Tested { part: None, place: BoxId(arc.place.0), weight: number(arc.weight)? });
    arcs.iter().map(one).collect()
}

fn number(tokens: u64) -> Result<u32, String> {
    u32::try_from(tokens).map_err(|_| format!("expected numbers of tokens up to {}, found {tokens}", u32::MAX))
}
