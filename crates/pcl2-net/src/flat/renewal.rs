//! What GENERATE boxes do between two scans.

use super::{Flat, read};
use crate::pt::{Arc, PlaceId, PtNet, Transition};

/// The most GENERATE boxes from which a transition takes: each may have made another token by the next scan, or not.
const MAX_GENERATIONS: usize = 4;

impl Flat {
    /// The net for steps of whole scans. A GENERATE box that was full has a new token in the next scan before any gate
    /// sees it empty: beside each transition that takes from such a box stands one that leaves it full.
    pub fn for_scans(&self) -> Result<PtNet, String> {
        let mut net = PtNet { transitions: Vec::new(), ..self.net.clone() };
        for transition in &self.net.transitions {
            net.transitions.extend(self.renewed(transition)?);
        }
        Ok(net)
    }

    fn renewed(&self, transition: &Transition) -> Result<Vec<Transition>, String> {
        let makes = |arc: &&Arc| {
            self.generations.binary_search(&arc.place).is_ok()
                && transition.puts.iter().all(|put| put.place != arc.place)
        };
        let taken: Vec<Arc> = transition.takes.iter().filter(makes).copied().collect();
        if taken.len() > MAX_GENERATIONS {
            let (name, found) = (&transition.name, taken.len());
            return Err(format!(
                "`{name}`: expected to take from at most {MAX_GENERATIONS} GENERATE boxes, found {found}"
            ));
        }
        let mut rows = Vec::new();
        for chosen in (0..1_usize << taken.len()).rev() {
            let mut row = transition.clone();
            for (_, arc) in taken.iter().enumerate().filter(|(i, _)| chosen & (1 << i) != 0) {
                self.renew(*arc, &mut row);
            }
            rows.push(row);
        }
        Ok(rows)
    }

    fn renew(&self, taken: Arc, row: &mut Transition) {
        let place: PlaceId = taken.place;
        let known = &self.net.places[place.0 as usize];
        row.name = format!("{}+{}", row.name, known.name);
        row.puts.push(Arc { place, weight: 1 });
        row.free = true;
        if let Some(weight) = known.capacity.filter(|capacity| *capacity > taken.weight) {
            read(row, Arc { place, weight });
        }
    }
}
