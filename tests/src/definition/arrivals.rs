//! The end of the gate phase: what was taken is gone, what was put arrives.

use super::instance::{Arrival, Instance};
use super::tokens::World;

/// For a net, then for those inside.
pub(super) fn arrive(instance: &mut Instance, world: &mut World) {
    for state in &mut instance.boxes {
        state.tokens.retain(|token| !instance.taken.contains(token));
    }
    for Arrival { place, token, rank } in std::mem::take(&mut instance.arriving) {
        let state = &mut instance.boxes[place];
        state.tokens.push(token);
        (state.rank, state.since) = (rank, instance.now);
        (state.begun, state.complete) = (false, false);
        if let Some(part) = instance.net.part_of(place) {
            let inside = &mut instance.parts[part];
            if let Some(entry) = inside.net.entry() {
                world.note("a macro entered");
                let copy = world.copy(token);
                inside.arriving.push(Arrival { place: entry, token: copy, rank });
            }
        }
    }
    instance.parts.iter_mut().for_each(|part| arrive(part, world));
}
