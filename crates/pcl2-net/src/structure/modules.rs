//! The modules of a net: the parts among which no token moves. A device is such a loop of its own; read arcs and
//! inhibitors connect modules without joining them.

use crate::pt::{PlaceId, PtNet, TransitionId};
use crate::structure::names;

/// Places and transitions that tokens connect.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Module {
    /// What its names begin with, if no other module's do, else the name of its first place.
    pub name: String,
    /// Its places, in the order of the net.
    pub places: Vec<PlaceId>,
    /// Its transitions, in the order of the net.
    pub transitions: Vec<TransitionId>,
}

/// The modules, in the order of their first places; modules without a place come last.
pub fn modules(net: &PtNet) -> Vec<Module> {
    let places = net.places.len();
    let mut groups = Groups::new(places + net.transitions.len());
    for (i, transition) in net.transitions.iter().enumerate() {
        for arc in transition.takes.iter().chain(&transition.puts) {
            groups.join(places + i, arc.place.0 as usize);
        }
    }
    let mut modules: Vec<Module> = Vec::new();
    for (node, group) in groups.numbers().into_iter().enumerate() {
        if group == modules.len() {
            modules.push(Module::default());
        }
        match node.checked_sub(places) {
            None => modules[group].places.push(PlaceId(node as u32)),
            Some(transition) => modules[group].transitions.push(TransitionId(transition as u32)),
        }
    }
    let texts = modules.iter().map(|module| {
        let places = module.places.iter().map(|id| names::place(net, *id));
        places.chain(
            module.transitions.iter().take(usize::from(module.places.is_empty())).map(|id| names::transition(net, *id)),
        )
    });
    let names = titles(texts.map(Iterator::collect).collect());
    for (module, name) in modules.iter_mut().zip(names) {
        module.name = name;
    }
    modules
}

/// A name for each group of names: what all of a group begin with, if no other group is called so, else the group's
/// first.
pub(crate) fn titles(groups: Vec<Vec<&str>>) -> Vec<String> {
    let mut used: Vec<(&str, usize)> = Vec::new();
    for (i, group) in groups.iter().enumerate() {
        used.push((common_start(group), i));
        used.extend(group.first().map(|first| (*first, i)));
    }
    used.sort_unstable();
    used.dedup();
    let alone = |name: &str| {
        let from = used.partition_point(|(other, _)| *other < name);
        used.get(from + 1).is_none_or(|(other, _)| *other != name)
    };
    let title = |group: &Vec<&str>| {
        let common = common_start(group);
        let first = group.first().copied().unwrap_or_default();
        if common.is_empty() || !alone(common) { first.to_owned() } else { common.to_owned() }
    };
    groups.iter().map(title).collect()
}

/// What all names begin with, without a dangling `_` or dot.
fn common_start<'a>(names: &[&'a str]) -> &'a str {
    let Some((first, others)) = names.split_first() else {
        return "";
    };
    let same =
        |other: &&str| first.chars().zip(other.chars()).take_while(|(a, b)| a == b).map(|(a, _)| a.len_utf8()).sum();
    let length = others.iter().map(same).min().unwrap_or(first.len());
    first[..length].trim_end_matches(['_', '.'])
}

/// Sets of nodes that are joined pair by pair.
#[derive(Clone, Debug)]
pub(crate) struct Groups {
    parents: Vec<usize>,
}

impl Groups {
    /// So many nodes, each alone.
    pub(crate) fn new(nodes: usize) -> Groups {
        Groups { parents: (0..nodes).collect() }
    }

    /// Joins the sets of two nodes.
    pub(crate) fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.parents[a.max(b)] = a.min(b);
    }

    fn root(&mut self, mut node: usize) -> usize {
        while self.parents[node] != node {
            self.parents[node] = self.parents[self.parents[node]];
            node = self.parents[node];
        }
        node
    }

    /// The number of each node's set; sets are numbered by their first nodes.
    pub(crate) fn numbers(mut self) -> Vec<usize> {
        let mut numbers = vec![0; self.parents.len()];
        let mut count = 0;
        for node in 0..self.parents.len() {
            let root = self.root(node);
            if root == node {
                numbers[node] = count;
                count += 1;
            } else {
                numbers[node] = numbers[root];
            }
        }
        numbers
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_are_named_by_what_their_names_share() {
        let groups = vec![
            vec!["S0", "S1"],
            vec!["V10", "V11"],
            vec!["x_a", "x_b"],
            vec!["x", "x1"],
            vec!["u", "w"],
            vec!["µ1", "µ2"],
        ];
        assert_eq!(titles(groups), ["S", "V1", "x_a", "x", "u", "µ"]);
        assert_eq!(titles(vec![vec![], vec!["a"]]), ["", "a"]);
    }

    #[test]
    fn sets_are_numbered_by_their_first_nodes() {
        let mut groups = Groups::new(6);
        groups.join(5, 1);
        groups.join(3, 4);
        groups.join(5, 4);
        assert_eq!(groups.numbers(), [0, 1, 2, 1, 1, 1]);
    }
}
