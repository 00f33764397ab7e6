//! A place/transition net: what the analysis works on, wherever the net was written.

mod declared;

pub use declared::declared;

/// The largest number of tokens and the largest weight that is counted with.
pub const MOST: u64 = (1 << 62) - 1;

/// A net with weights, capacities, read and inhibitor arcs. Its transitions stand in the order in which a scan tries
/// them: by priority, then by declaration.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PtNet {
    /// Its name.
    pub name: String,
    /// The places.
    pub places: Vec<Place>,
    /// The transitions.
    pub transitions: Vec<Transition>,
}

/// An index into [`PtNet::places`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PlaceId(pub u32);

/// An index into [`PtNet::transitions`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TransitionId(pub u32);

/// A place.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// The name in reports; of PNML the id.
    pub name: String,
    /// Tokens at the start.
    pub initial: u64,
    /// The most tokens it can hold. `None`: any number.
    pub capacity: Option<u64>,
}

/// A transition.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Transition {
    /// The name in reports; of PNML the id.
    pub name: String,
    /// Tokens that it takes.
    pub takes: Vec<Arc>,
    /// Tokens that it puts.
    pub puts: Vec<Arc>,
    /// At least so many tokens must be there; they stay.
    pub reads: Vec<Arc>,
    /// Fewer than so many tokens must be there.
    pub inhibits: Vec<Arc>,
    /// Something outside the net (an input, a timer, an attribute) decides whether it fires when it is enabled.
    /// Otherwise it must fire.
    pub free: bool,
    /// Transitions of one gate are its alternatives: at most one of them fires in a scan.
    pub gate: u32,
}

/// An arc to or from a place, at most one of a kind for each place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Arc {
    /// The place.
    pub place: PlaceId,
    /// How many tokens, at least 1.
    pub weight: u64,
}
