//! A part of a net: some of its places and transitions as a net of its own.

use crate::pt::{Arc, PlaceId, PtNet, Transition, TransitionId};

/// Some places and transitions of a net.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// The net of these places and transitions, with the arcs between them. A transition that waits for a place outside
    /// is free: what stands outside decides when it fires.
    pub net: PtNet,
    /// The places in the whole net, in the order of the part's own.
    pub places: Vec<PlaceId>,
    /// The transitions in the whole net, in the order of the part's own.
    pub transitions: Vec<TransitionId>,
    /// The arcs that end outside, by transition, takes first, then puts, reads and inhibitors.
    pub outer: Vec<OuterArc>,
}

/// An arc of a part's transition to or from a place outside the part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OuterArc {
    /// The part's transition.
    pub transition: TransitionId,
    /// The place in the whole net, and the weight.
    pub arc: Arc,
    /// What the arc does.
    pub kind: ArcKind,
}

/// What an arc does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ArcKind {
    /// Takes tokens.
    Take,
    /// Puts tokens.
    Put,
    /// Needs tokens that stay.
    Read,
    /// Needs that tokens are missing.
    Inhibit,
}

/// All kinds, in the order of [`Part::outer`].
pub const ARC_KINDS: [ArcKind; 4] = [ArcKind::Take, ArcKind::Put, ArcKind::Read, ArcKind::Inhibit];

/// The arcs of a kind.
pub fn arcs(transition: &Transition, kind: ArcKind) -> &[Arc] {
    match kind {
        ArcKind::Take => &transition.takes,
        ArcKind::Put => &transition.puts,
        ArcKind::Read => &transition.reads,
        ArcKind::Inhibit => &transition.inhibits,
    }
}

fn arcs_mut(transition: &mut Transition, kind: ArcKind) -> &mut Vec<Arc> {
    match kind {
        ArcKind::Take => &mut transition.takes,
        ArcKind::Put => &mut transition.puts,
        ArcKind::Read => &mut transition.reads,
        ArcKind::Inhibit => &mut transition.inhibits,
    }
}

/// The part of a net with these places and transitions, in this order.
pub fn part(whole: &PtNet, name: &str, places: Vec<PlaceId>, transitions: Vec<TransitionId>) -> Part {
    let mut own = vec![None; whole.places.len()];
    for (i, place) in places.iter().enumerate() {
        own[place.0 as usize] = Some(PlaceId(i as u32));
    }
    let mut net = PtNet { name: name.to_owned(), ..PtNet::default() };
    net.places = places.iter().map(|place| whole.places[place.0 as usize].clone()).collect();
    let mut outer = Vec::new();
    for (i, id) in transitions.iter().enumerate() {
        let from = outer.len();
        let mut transition = whole.transitions[id.0 as usize].clone();
        for kind in ARC_KINDS {
            let all = std::mem::take(arcs_mut(&mut transition, kind));
            for arc in all {
                match own[arc.place.0 as usize] {
                    Some(place) => arcs_mut(&mut transition, kind).push(Arc { place, weight: arc.weight }),
                    None => outer.push(OuterArc { transition: TransitionId(i as u32), arc, kind }),
                }
            }
        }
        transition.free |= outer[from..].iter().any(|outer| outer.kind != ArcKind::Put);
        net.transitions.push(transition);
    }
    Part { net, places, transitions, outer }
}
