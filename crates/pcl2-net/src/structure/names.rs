//! Places and transitions by the names that their author gave them.

use crate::pt::{PlaceId, PtNet, TransitionId};
use pcl2_lang::suggest;
use rustc_hash::FxHashMap;

/// The names of a net.
#[derive(Clone, Debug)]
pub struct Names<'a> {
    net: &'a PtNet,
    places: FxHashMap<&'a str, PlaceId>,
    transitions: FxHashMap<&'a str, TransitionId>,
}

impl<'a> Names<'a> {
    /// The names of this net. Of equal names the first counts.
    pub fn new(net: &'a PtNet) -> Names<'a> {
        let places = net.places.iter().enumerate().rev().map(|(i, place)| (place.name.as_str(), PlaceId(i as u32)));
        let transitions = net.transitions.iter().enumerate().rev();
        let transitions = transitions.map(|(i, transition)| (transition.name.as_str(), TransitionId(i as u32)));
        Names { net, places: places.collect(), transitions: transitions.collect() }
    }

    /// The place of this name.
    pub fn place(&self, name: &str) -> Result<PlaceId, String> {
        let known = || self.net.places.iter().map(|place| place.name.as_str());
        self.places.get(name).copied().ok_or_else(|| unknown("place", name, suggest::help(name, known())))
    }

    /// The transition of this name.
    pub fn transition(&self, name: &str) -> Result<TransitionId, String> {
        let known = || self.net.transitions.iter().map(|transition| transition.name.as_str());
        self.transitions.get(name).copied().ok_or_else(|| unknown("transition", name, suggest::help(name, known())))
    }
}

/// A number of things: `1 place`, `2 places`.
pub fn counted(count: usize, one: &str, several: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { several })
}

/// How large a net or a part of one is.
pub fn size(places: usize, transitions: usize) -> String {
    let transitions = counted(transitions, "transition", "transitions");
    format!("{}, {transitions}", counted(places, "place", "places"))
}

fn unknown(what: &str, name: &str, help: Option<String>) -> String {
    let help = help.map(|help| format!(" ({help})")).unwrap_or_default();
    format!("expected a {what} of the net, found `{name}`{help}")
}

/// The name of a place.
pub(crate) fn place(net: &PtNet, id: PlaceId) -> &str {
    &net.places[id.0 as usize].name
}

/// The name of a transition.
pub(crate) fn transition(net: &PtNet, id: TransitionId) -> &str {
    &net.transitions[id.0 as usize].name
}

/// All places of a net.
pub(crate) fn place_ids(net: &PtNet) -> impl Iterator<Item = PlaceId> + use<> {
    (0..net.places.len() as u32).map(PlaceId)
}

/// All transitions of a net.
pub(crate) fn transition_ids(net: &PtNet) -> impl Iterator<Item = TransitionId> + use<> {
    (0..net.transitions.len() as u32).map(TransitionId)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pt::{Place, Transition};

    #[test]
    fn names_are_found_and_slips_are_helped() {
        let place = |name: &str| Place { name: name.to_owned(), ..Place::default() };
        let transition = Transition { name: "start".to_owned(), ..Transition::default() };
        let net =
            PtNet { places: vec![place("full"), place("empty")], transitions: vec![transition], ..PtNet::default() };
        let names = Names::new(&net);
        assert_eq!(names.place("empty"), Ok(PlaceId(1)));
        assert_eq!(names.transition("start"), Ok(TransitionId(0)));
        let message = "expected a place of the net, found `emtpy` (did you mean `empty`?)";
        assert_eq!(names.place("emtpy"), Err(message.to_owned()));
        assert_eq!(names.transition("xyz"), Err("expected a transition of the net, found `xyz`".to_owned()));
    }
}
