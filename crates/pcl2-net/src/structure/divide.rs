//! A flat net divided by the steps of its sequential function chart, after the four rules of Jeong and Yang:
//!
//! 1. The steps are the places of the main loop, in which a token really moves.
//! 2. The actions of a step are a sub-net of the step's place.
//! 3. The sub-net starts by itself when its step is marked: transitions of its modules read the step.
//! 4. The last places of the sub-net enable the transition that leaves the step.
//!
//! A sub-net holds the modules that read its step, and those on the way, from read arc to read arc, to the places that
//! the step's exit reads. In the main loop a pair stands for it: Su_k, of capacity 1, and tsu_k, which reads the step
//! and marks Su_k when the sub-net's last places are marked. The exit takes from Su_k what it read in the sub-net. What
//! no step drives, the operator's devices, stays beside the main loop.

use crate::pt::{Arc, Place, PlaceId, PtNet, Transition, TransitionId};
use crate::structure::compose::Piece;
use crate::structure::matrix::{Matrix, MatrixKind};
use crate::structure::modules::{Module, modules};
use crate::structure::names::{self, Names};
use crate::structure::part::{ArcKind, OuterArc, Part, arcs, part};
use rustc_hash::FxHashSet;
use std::collections::BTreeSet;

/// A net, divided.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Division {
    /// The main loop and what stays beside it, then the pairs of the sub-nets. The pairs are not in the whole net:
    /// `places` and `transitions` end before them.
    pub main: Part,
    /// The sub-nets, in the order of their steps.
    pub sub_nets: Vec<SubNet>,
    /// What the rules say of the net that its author may not expect.
    pub notes: Vec<String>,
}

/// The sub-net of a step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SubNet {
    /// The step, in the whole net.
    pub step: PlaceId,
    /// The transition that leaves the step, in the whole net.
    pub exit: TransitionId,
    /// Su_k, in the main net.
    pub place: PlaceId,
    /// tsu_k, in the main net.
    pub transition: TransitionId,
    /// The modules of the sub-net.
    pub part: Part,
    /// The transitions that the step starts, in the sub-net.
    pub starts: Vec<TransitionId>,
    /// The last places, in the sub-net: how many tokens the exit reads, or of how many it is inhibited.
    pub ends: Vec<(Arc, ArcKind)>,
}

impl Division {
    /// The matrices of the main loop without the pairs and of the sub-nets: they compose to the matrix of the whole net.
    pub fn pieces(&self, whole: &PtNet, kind: MatrixKind) -> Vec<Piece> {
        let parts = std::iter::once(&self.main).chain(self.sub_nets.iter().map(|sub_net| &sub_net.part));
        let piece = |part: &Part| Piece {
            name: part.net.name.clone(),
            matrix: Matrix::of_part(whole, kind, &part.places, &part.transitions),
        };
        parts.map(piece).collect()
    }
}

/// Divides a net by the names of its steps.
pub fn divide(net: &PtNet, steps: &[&str]) -> Result<Division, String> {
    let names = Names::new(net);
    let steps: Vec<PlaceId> = steps.iter().map(|name| names.place(name)).collect::<Result<_, _>>()?;
    let main_loop = MainLoop::new(net, steps)?;
    let devices = Devices::new(net, &main_loop);
    let reached: Vec<BTreeSet<usize>> =
        main_loop.steps.iter().map(|step| devices.follow(devices.started_by(net, *step), &devices.readers)).collect();
    let main = main_part(net, &main_loop, &devices, &reached);
    let mut division = Division { main, sub_nets: Vec::new(), notes: Vec::new() };
    for share in shares(net, &main_loop, &devices, &reached) {
        add_sub_net(net, &devices, share, &mut division);
    }
    free_main(net, &mut division);
    Ok(division)
}

/// The steps and what moves tokens among them.
struct MainLoop {
    steps: Vec<PlaceId>,
    /// Of each step the transition that leaves it.
    exits: Vec<TransitionId>,
    /// All transitions of the loop, in the order of the net.
    transitions: Vec<TransitionId>,
}

impl MainLoop {
    fn new(net: &PtNet, steps: Vec<PlaceId>) -> Result<MainLoop, String> {
        let mut is_step = vec![false; net.places.len()];
        for step in &steps {
            if std::mem::replace(&mut is_step[step.0 as usize], true) {
                return Err(format!("expected each step once, found `{}` again", names::place(net, *step)));
            }
        }
        if steps.is_empty() {
            return Err("expected the names of the steps, found none".to_owned());
        }
        let mut transitions = Vec::new();
        for id in names::transition_ids(net) {
            if moves_in_loop(net, id, &is_step)? {
                transitions.push(id);
            }
        }
        let exits = steps.iter().map(|step| exit(net, *step, &transitions)).collect::<Result<_, _>>()?;
        Ok(MainLoop { steps, exits, transitions })
    }
}

/// Whether a transition is one of the main loop. Then it moves tokens from step to step and nowhere else.
fn moves_in_loop(net: &PtNet, id: TransitionId, is_step: &[bool]) -> Result<bool, String> {
    let transition = &net.transitions[id.0 as usize];
    let arcs = || transition.takes.iter().chain(&transition.puts);
    if !arcs().any(|arc| is_step[arc.place.0 as usize]) {
        return Ok(false);
    }
    let name = &transition.name;
    if let Some(arc) = arcs().find(|arc| !is_step[arc.place.0 as usize]) {
        let place = names::place(net, arc.place);
        return Err(format!(
            "transition `{name}`: expected tokens to move from step to step only, found `{place}`; make it a step, or \
             read it"
        ));
    }
    for (arcs, what) in [(&transition.takes, "that it leaves"), (&transition.puts, "that it leads to")] {
        if arcs.is_empty() {
            return Err(format!(
                "transition `{name}`: expected a step {what}, found none: the main loop is open there"
            ));
        }
    }
    Ok(true)
}

/// The one transition that leaves a step.
fn exit(net: &PtNet, step: PlaceId, transitions: &[TransitionId]) -> Result<TransitionId, String> {
    let leaves = |id: &&TransitionId| net.transitions[id.0 as usize].takes.iter().any(|arc| arc.place == step);
    let mut exits = transitions.iter().filter(leaves);
    let name = names::place(net, step);
    let first = exits.next();
    let first = first.ok_or_else(|| format!("step `{name}`: expected a transition that leaves it, found none"))?;
    match exits.next() {
        None => Ok(*first),
        Some(second) => Err(format!(
            "step `{name}`: expected one transition that leaves it and ends its sub-net, found `{}` and `{}`",
            names::transition(net, *first),
            names::transition(net, *second)
        )),
    }
}

/// The modules outside the main loop, and which of them read which.
struct Devices {
    modules: Vec<Module>,
    /// The module of each place of the net; steps have none.
    of_place: Vec<Option<usize>>,
    /// Of each module those that read it.
    readers: Vec<BTreeSet<usize>>,
    /// Of each module those that it reads.
    sources: Vec<BTreeSet<usize>>,
}

impl Devices {
    fn new(net: &PtNet, main_loop: &MainLoop) -> Devices {
        let mut modules = modules(net);
        let is_device = |module: &Module| !module.places.iter().any(|place| main_loop.steps.contains(place));
        modules.retain(is_device);
        let mut of_place = vec![None; net.places.len()];
        for (i, module) in modules.iter().enumerate() {
            module.places.iter().for_each(|place| of_place[place.0 as usize] = Some(i));
        }
        let mut devices =
            Devices { readers: vec![BTreeSet::new(); modules.len()], sources: Vec::new(), modules, of_place };
        devices.sources = devices.readers.clone();
        for reader in 0..devices.modules.len() {
            let seen = devices.modules[reader].transitions.iter().flat_map(|id| looks(net, *id));
            let sources: BTreeSet<usize> = seen.filter_map(|(arc, _)| devices.of_place[arc.place.0 as usize]).collect();
            for source in sources {
                devices.readers[source].insert(reader);
                devices.sources[reader].insert(source);
            }
        }
        devices
    }

    /// The modules with a transition that reads a step.
    fn started_by(&self, net: &PtNet, step: PlaceId) -> BTreeSet<usize> {
        let reads = |id: &TransitionId| looks(net, *id).any(|(arc, _)| arc.place == step);
        (0..self.modules.len()).filter(|module| self.modules[*module].transitions.iter().any(reads)).collect()
    }

    /// Some modules, and all that can be reached from them.
    fn follow(&self, from: BTreeSet<usize>, next: &[BTreeSet<usize>]) -> BTreeSet<usize> {
        let mut open: Vec<usize> = from.iter().copied().collect();
        let mut reached = from;
        while let Some(module) = open.pop() {
            open.extend(next[module].iter().filter(|other| reached.insert(**other)));
        }
        reached
    }

    fn places(&self, modules: &BTreeSet<usize>) -> Vec<PlaceId> {
        let mut places: Vec<PlaceId> = modules.iter().flat_map(|i| &self.modules[*i].places).copied().collect();
        places.sort_unstable();
        places
    }

    fn transitions(&self, modules: &BTreeSet<usize>) -> Vec<TransitionId> {
        let mut all: Vec<TransitionId> = modules.iter().flat_map(|i| &self.modules[*i].transitions).copied().collect();
        all.sort_unstable();
        all
    }
}

/// The arcs of a transition that see tokens without moving them.
fn looks(net: &PtNet, id: TransitionId) -> impl Iterator<Item = (Arc, ArcKind)> {
    let transition = &net.transitions[id.0 as usize];
    let of_kind = |kind| arcs(transition, kind).iter().map(move |arc| (*arc, kind));
    of_kind(ArcKind::Read).chain(of_kind(ArcKind::Inhibit))
}

/// What a step gets of the devices.
struct Share {
    step: PlaceId,
    exit: TransitionId,
    modules: BTreeSet<usize>,
}

/// The shares of the steps that have one.
fn shares(net: &PtNet, main_loop: &MainLoop, devices: &Devices, reached: &[BTreeSet<usize>]) -> Vec<Share> {
    let mut shares = Vec::new();
    for ((step, exit), reached) in main_loop.steps.iter().zip(&main_loop.exits).zip(reached) {
        let awaited = looks(net, *exit).filter_map(|(arc, _)| devices.of_place[arc.place.0 as usize]);
        let awaited = awaited.filter(|module| reached.contains(module)).collect();
        let on_the_way = devices.follow(awaited, &devices.sources);
        let mut modules = devices.started_by(net, *step);
        modules.extend(reached.intersection(&on_the_way));
        shares.push(Share { step: *step, exit: *exit, modules });
    }
    // What is driven and leads to no exit goes with all that drive it.
    let placed: BTreeSet<usize> = shares.iter().flat_map(|share| &share.modules).copied().collect();
    for (share, reached) in shares.iter_mut().zip(reached) {
        share.modules.extend(reached.difference(&placed));
    }
    shares.retain(|share| !share.modules.is_empty());
    shares
}

fn main_part(net: &PtNet, main_loop: &MainLoop, devices: &Devices, reached: &[BTreeSet<usize>]) -> Part {
    let driven: BTreeSet<usize> = reached.iter().flatten().copied().collect();
    let beside: BTreeSet<usize> = (0..devices.modules.len()).filter(|module| !driven.contains(module)).collect();
    let mut places = main_loop.steps.clone();
    places.extend(devices.places(&beside));
    let mut transitions = main_loop.transitions.clone();
    transitions.extend(devices.transitions(&beside));
    transitions.sort_unstable();
    part(net, "main", places, transitions)
}

fn add_sub_net(net: &PtNet, devices: &Devices, share: Share, division: &mut Division) {
    let Share { step, exit, modules } = share;
    let (place, transition) = add_pair(net, step, division);
    let name = division.main.net.places[place.0 as usize].name.clone();
    let part = part(net, &name, devices.places(&modules), devices.transitions(&modules));
    let mut starts: Vec<TransitionId> =
        part.outer.iter().filter(|outer| outer.arc.place == step).map(|outer| outer.transition).collect();
    starts.dedup();
    let ends: Vec<(Arc, ArcKind)> = looks(net, exit)
        .filter_map(|(arc, kind)| {
            let own = part.places.iter().position(|place| *place == arc.place)?;
            Some((Arc { place: PlaceId(own as u32), weight: arc.weight }, kind))
        })
        .collect();
    if ends.is_empty() {
        let (step, exit) = (names::place(net, step), names::transition(net, exit));
        division.notes.push(format!("step `{step}`: its exit `{exit}` waits for no place of its sub-net `{name}`"));
    }
    take_at_exit(&mut division.main, exit, place, &part.places);
    division.sub_nets.push(SubNet { step, exit, place, transition, part, starts, ends });
}

/// Su_k and tsu_k, new in the main net.
fn add_pair(net: &PtNet, step: PlaceId, division: &mut Division) -> (PlaceId, TransitionId) {
    let number = division.sub_nets.len() + 1;
    let main = &mut division.main.net;
    let (place, transition) = (PlaceId(main.places.len() as u32), TransitionId(main.transitions.len() as u32));
    let known = net.places.iter().map(|place| place.name.as_str());
    let name = new_name(format!("Su{number}"), known.collect());
    main.places.push(Place { name, initial: 0, capacity: Some(1) });
    let known = net.transitions.iter().map(|transition| transition.name.as_str());
    let name = new_name(format!("tsu{number}"), known.collect());
    let own_step = division.main.places.iter().position(|place| *place == step).unwrap_or_default();
    let gates: BTreeSet<u32> = net.transitions.iter().chain(&main.transitions).map(|other| other.gate).collect();
    let gate = (0..u32::MAX).find(|gate| !gates.contains(gate)).unwrap_or(u32::MAX);
    main.transitions.push(Transition {
        name,
        puts: vec![Arc { place, weight: 1 }],
        reads: vec![Arc { place: PlaceId(own_step as u32), weight: 1 }],
        free: true,
        gate,
        ..Transition::default()
    });
    (place, transition)
}

/// A name that the net does not have.
fn new_name(mut name: String, known: FxHashSet<&str>) -> String {
    while known.contains(name.as_str()) {
        name.push('_');
    }
    name
}

/// A step's exit takes from Su_k instead of waiting for places of the sub-net.
fn take_at_exit(main: &mut Part, exit: TransitionId, pair: PlaceId, places: &[PlaceId]) {
    let Some(own) = main.transitions.iter().position(|id| *id == exit) else {
        return;
    };
    let own_id = TransitionId(own as u32);
    main.outer.retain(|outer| outer.transition != own_id || !places.contains(&outer.arc.place));
    main.net.transitions[own].takes.push(Arc { place: pair, weight: 1 });
}

/// A transition of the main net that waits for nothing outside any more is as free as in the whole net.
fn free_main(net: &PtNet, division: &mut Division) {
    for (i, id) in division.main.transitions.iter().enumerate() {
        let outer: Vec<&OuterArc> =
            division.main.outer.iter().filter(|outer| outer.transition == TransitionId(i as u32)).collect();
        division.main.net.transitions[i].free = net.transitions[id.0 as usize].free || !outer.is_empty();
        for outer in outer {
            let (name, place) = (names::transition(net, *id), names::place(net, outer.arc.place));
            division.notes.push(format!("`{name}` waits for `{place}`, to which no action of its step leads"));
        }
    }
}
