//! Nets without capacities, read arcs and inhibitors: complement places stand for room.

use crate::pt::{Arc, Place, PlaceId, PtNet, Transition};
use crate::structure::invariants::{p_invariants, weighted_tokens};
use rustc_hash::FxHashSet;

/// The most rows that the search for invariants may hold.
const MOST_ROWS: usize = 20_000;

/// The same net with arcs that take and put alone: one transition at a time it has the same markings. An error where an
/// inhibitor stands at a place without a limit.
pub fn plain(net: &PtNet) -> Result<PtNet, String> {
    let limits = limits(net);
    let mut plain = PtNet { name: net.name.clone(), places: Vec::new(), transitions: Vec::new() };
    plain.places.extend(net.places.iter().map(|place| Place { capacity: None, ..place.clone() }));
    let rooms = rooms(net, &limits, &mut plain)?;
    for transition in &net.transitions {
        plain.transitions.push(plain_transition(transition, &rooms));
    }
    Ok(plain)
}

/// By place: the most tokens that it ever holds, as far as invariants and capacities tell, and whether the capacity is
/// needed for it.
fn limits(net: &PtNet) -> Vec<(Option<u64>, bool)> {
    let mut implied: Vec<Option<u64>> = vec![None; net.places.len()];
    for invariant in p_invariants(net, MOST_ROWS).unwrap_or_default() {
        let Some(tokens) = weighted_tokens(net, &invariant) else {
            continue;
        };
        for (place, weight) in &invariant {
            let most = u64::try_from(tokens / u128::from(*weight)).unwrap_or(u64::MAX);
            let known = &mut implied[place.0 as usize];
            *known = Some(known.map_or(most, |known| known.min(most)));
        }
    }
    let limit = |(place, implied): (&Place, Option<u64>)| match (place.capacity, implied) {
        (Some(capacity), Some(implied)) if implied <= capacity => (Some(implied), false),
        (Some(capacity), _) => (Some(capacity), true),
        (None, implied) => (implied, false),
    };
    net.places.iter().zip(implied).map(limit).collect()
}

/// The complement place of a place, and the tokens of both together.
#[derive(Clone, Copy)]
struct Room {
    place: PlaceId,
    total: u64,
}

/// Makes the complement places that are needed.
fn rooms(net: &PtNet, limits: &[(Option<u64>, bool)], plain: &mut PtNet) -> Result<Vec<Option<Room>>, String> {
    let mut needed: Vec<bool> = limits.iter().map(|(_, needed)| *needed).collect();
    for transition in &net.transitions {
        for arc in &transition.inhibits {
            needed[arc.place.0 as usize] = true;
        }
    }
    let mut names: FxHashSet<String> = net.places.iter().map(|place| place.name.clone()).collect();
    let mut rooms = vec![None; net.places.len()];
    for (i, place) in net.places.iter().enumerate().filter(|(i, _)| needed[*i]) {
        let total = limits[i].0.ok_or_else(|| unlimited(net, i))?;
        let mut name = format!("{}.room", place.name);
        while !names.insert(name.clone()) {
            name.push('_');
        }
        rooms[i] = Some(Room { place: PlaceId(plain.places.len() as u32), total });
        plain.places.push(Place { name, initial: total.saturating_sub(place.initial), capacity: None });
    }
    Ok(rooms)
}

fn unlimited(net: &PtNet, place: usize) -> String {
    let inhibited = |transition: &&Transition| transition.inhibits.iter().any(|arc| arc.place.0 as usize == place);
    let transition = net.transitions.iter().find(inhibited).map_or("", |transition| transition.name.as_str());
    format!(
        "`{transition}`: expected a limit of the tokens in `{}`, which inhibits it, found none; the format has no \
         inhibitors: give the box a SIZE",
        net.places[place].name
    )
}

/// Tokens that are asked for, taken and put back or not.
struct Flow {
    place: PlaceId,
    needs: u64,
    takes: u64,
    puts: u64,
}

#[derive(Default)]
struct Flows(Vec<Flow>);

impl Flows {
    fn of(&mut self, place: PlaceId) -> &mut Flow {
        let at = self.0.iter().position(|flow| flow.place == place).unwrap_or(self.0.len());
        if at == self.0.len() {
            self.0.push(Flow { place, needs: 0, takes: 0, puts: 0 });
        }
        &mut self.0[at]
    }
}

fn plain_transition(transition: &Transition, rooms: &[Option<Room>]) -> Transition {
    let room = |arc: &Arc| rooms[arc.place.0 as usize];
    let mut flows = Flows::default();
    for arc in &transition.takes {
        flows.of(arc.place).takes = arc.weight;
    }
    for arc in &transition.puts {
        flows.of(arc.place).puts = arc.weight;
    }
    for arc in &transition.reads {
        flows.of(arc.place).needs = arc.weight;
    }
    let moved: Vec<(Room, u64, u64)> = flows
        .0
        .iter()
        .filter_map(|flow| Some((rooms[flow.place.0 as usize]?, flow.takes, flow.puts)))
        .filter(|(_, takes, puts)| takes != puts)
        .collect();
    for (room, takes, puts) in moved {
        let flow = flows.of(room.place);
        (flow.takes, flow.puts) = (puts.saturating_sub(takes), takes.saturating_sub(puts));
    }
    for arc in &transition.inhibits {
        // Fewer than w tokens are there when the room is more than what is left beside them.
        if let Some(room) = room(arc).filter(|room| arc.weight <= room.total) {
            let flow = flows.of(room.place);
            flow.needs = flow.needs.max(room.total - arc.weight + 1);
        }
    }
    let mut plain = Transition { name: transition.name.clone(), gate: transition.gate, ..Transition::default() };
    plain.free = transition.free;
    for flow in flows.0 {
        let back = flow.needs.saturating_sub(flow.takes);
        let (takes, puts) = (flow.takes + back, flow.puts + back);
        plain.takes.extend((takes > 0).then_some(Arc { place: flow.place, weight: takes }));
        plain.puts.extend((puts > 0).then_some(Arc { place: flow.place, weight: puts }));
    }
    plain
}
