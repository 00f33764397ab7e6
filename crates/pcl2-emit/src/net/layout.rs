//! What an instance of a net keeps beside its signals, and how its boxes are called in C.

use super::classes::{self, ClassNames};
use super::facts::{self, NetFacts};
use super::gates::GATES;
use super::modes::{self, Command, command};
use crate::NetForm;
use crate::facts::Scratch;
use crate::layout::UnitLayout;
use crate::shape::{Extent, Field, fields_extent};
use pcl2_lang::net::table::{self, Table};
use pcl2_lang::net::{BoxId, Kind, Net, PartId};
use pcl2_lang::program::{Program, Role, Unit, UnitId};
use pcl2_lang::types::Width;
use std::borrow::Cow;

/// How long a net with modes was stopped.
pub(crate) const STOOD: &str = "stood";

/// What a net with modes keeps in ints.
pub(crate) const MODE_COUNTERS: [&str; 3] = ["halted", "forced", "refused"];

/// The sets of touched boxes that are not empty, as bits of a word: kept where there are several and a word has room.
pub(crate) const MOVED: &str = "moved";

/// The layout of a net.
#[derive(Clone, Debug, Default)]
pub(crate) struct NetLayout {
    /// The first signal that the net keeps: words, then the tokens of boxes, then attributes of tokens in hand.
    pub(crate) held: usize,
    /// By box: the enumerator that stands for it.
    pub(crate) boxes: Vec<String>,
    /// The names of what tokens with attributes need in the fast form.
    pub(crate) names: ClassNames,
    /// The members of the struct `net` inside the instance.
    pub(crate) fields: Vec<Field>,
    /// What the player walks, and tokens with attributes at the start.
    pub(crate) table: Table,
    /// How many nets it is made of, itself included.
    pub(crate) nets: usize,
    /// It, or a net inside, depends on time.
    pub(crate) timed: bool,
    /// Time may stand in it, or in a net inside.
    pub(crate) clocked: bool,
    /// It has modes, or stands inside a net that has.
    pub(crate) moded: bool,
    /// Scratch of its statements.
    pub(crate) scratch: Scratch,
    /// A composite stands around it somewhere.
    pub(crate) called: bool,
    /// It is a block of the program somewhere.
    pub(crate) top: bool,
    /// Of the fast form: what its code can leave out.
    pub(crate) facts: NetFacts,
    /// Of a macro: what nets around it do with it.
    pub(crate) moves: MacroMoves,
}

/// What nets around a macro do with it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct MacroMoves {
    /// They ask whether it is vacant.
    pub(crate) asked: bool,
    /// They ask whether it is vacant but for its exit.
    pub(crate) looped: bool,
    /// They put a token into it.
    pub(crate) entered: bool,
    /// They take its token.
    pub(crate) left: bool,
    /// They empty it.
    pub(crate) emptied: bool,
}

impl MacroMoves {
    fn add(&mut self, outer: &Net, place: BoxId) {
        for gate in &outer.gates {
            let (taken, put) = [&gate.before, &gate.after].map(|arcs| arcs.iter().any(|arc| arc.place == place)).into();
            self.left |= taken;
            self.entered |= put;
            self.asked |= put && !taken;
            self.looped |= put && taken;
        }
        let mut aborts = outer.parts.iter().filter_map(|part| part.abort.as_ref());
        let put = command(outer, Command::Put).is_some();
        let target = put || aborts.any(|abort| abort.to == place);
        self.entered |= target;
        self.asked |= target;
        self.emptied |= command(outer, Command::Take).is_some();
    }
}

impl NetLayout {
    /// Whether an instance keeps a member.
    pub(crate) fn keeps(&self, name: &str) -> bool {
        self.fields.iter().any(|field| field.name == name)
    }
}

/// What stands behind the tag of a net in the names of its functions and tables, apart from functions of gates.
const SUFFIXES: &[&str] = &[
    "act",
    "active",
    "after",
    "boxes",
    "calm",
    "commit",
    "drives",
    "duration",
    "empty",
    "enter",
    "excite",
    "force",
    "force_put",
    "force_take",
    "gates",
    "hands",
    "hold",
    "inputs",
    "leave",
    "levels",
    "mode",
    "net",
    "obey",
    "outputs",
    "pass",
    "places",
    "put",
    "record",
    "scan",
    "swap",
    "table",
    "take",
    "there",
    "touch",
    "try",
    "vacant",
    "vacant_but_exit",
    "wait",
    "wake",
    "words",
    "writes",
];

/// What stands behind the tag of a net in names of what is made of it.
pub(crate) fn suffixes(net: &Net) -> Vec<String> {
    let gates = (1..=net.gates.len().div_ceil(GATES)).map(|word| format!("gates_{word}"));
    SUFFIXES.iter().map(|suffix| (*suffix).to_owned()).chain(gates).collect()
}

/// The net of a unit.
pub(crate) fn net_of<'a>(program: &'a Program, unit: &Unit) -> Option<&'a Net> {
    let (decl, _) = unit.composite.as_ref()?;
    program.decl(*decl).net.as_deref()
}

/// The unit of a net inside.
pub(crate) fn part_unit(unit: &Unit, net: &Net, part: PartId) -> Option<UnitId> {
    let statement = net.parts.get(part.0 as usize)?.statement;
    unit.blocks.get(statement.0 as usize)?.unit
}

/// Lays a net out; those inside it are known already.
pub(crate) fn layout(
    program: &Program,
    unit: &Unit,
    net: &Net,
    known: &[UnitLayout<'_>],
    scratch: Scratch,
    (boxes, names): (Vec<String>, ClassNames),
) -> NetLayout {
    let inside = |part: PartId| {
        let inner = part_unit(unit, net, part)?;
        let layout = known[inner.0 as usize].net.as_ref()?;
        Some((net_of(program, program.unit(inner))?, layout))
    };
    let table = table::table(net, &|part| inside(part).map(|(net, layout)| (net, layout.nets)));
    let parts: Vec<&NetLayout> =
        (0..net.parts.len() as u32).filter_map(|part| inside(PartId(part))).map(|(_, layout)| layout).collect();
    let held = unit.signals.iter().position(|signal| signal.role == Role::Held).unwrap_or(unit.signals.len());
    let timed = net.has_time() || parts.iter().any(|part| part.timed);
    NetLayout {
        held,
        boxes,
        names,
        nets: 1 + parts.iter().map(|part| part.nets).sum::<usize>(),
        timed,
        clocked: timed && (net.operation.is_some() || parts.iter().any(|part| part.clocked)),
        table,
        scratch,
        moded: net.operation.is_some(),
        ..NetLayout::default()
    }
}

/// Settles what an instance of each net keeps in a form.
pub(crate) fn settle(program: &Program, units: &mut [UnitLayout<'_>], form: NetForm) {
    let called = called(program, units);
    let part = parts(program, units);
    tell_parts(program, units);
    for index in 1..units.len() {
        let unit = &program.units[index];
        let (Some(net), Some(layout)) = (net_of(program, unit), units[index].net.as_mut()) else {
            continue;
        };
        (layout.called, layout.top) = called[index];
        layout.facts = facts::of(program, net, unit, layout.held, part[index]);
        // Under an operator something may happen in each scan.
        layout.facts.ticking |= layout.moded || net.blocked.is_some();
        layout.fields = match form {
            NetForm::Table => table_fields(net, layout),
            NetForm::Fast => fast_fields(net, layout),
        };
        if form == NetForm::Fast {
            let first = layout.held + net.words.len() + 1;
            let hands = classes::hands(net, &layout.names);
            name_hands(&mut units[index], first, &hands);
        }
    }
}

/// Attributes of tokens in hand are members of a struct.
fn name_hands(unit: &mut UnitLayout<'_>, first: usize, hands: &[Option<String>]) {
    for slot in &mut unit.slots {
        let hand = (slot.signal.0 as usize).checked_sub(first).and_then(|hand| hands.get(hand));
        if let Some(Some(name)) = hand {
            slot.name = Cow::Owned(name.clone());
            slot.inside = true;
        }
    }
}

/// Tells nets inside what nets around them do with them. A net stands before those inside it.
fn tell_parts(program: &Program, units: &mut [UnitLayout<'_>]) {
    for (outer, unit) in program.units.iter().enumerate() {
        let Some(net) = net_of(program, unit).filter(|_| units[outer].used) else {
            continue;
        };
        let emptied = units[outer].net.as_ref().is_some_and(|layout| layout.moves.emptied);
        let moded = units[outer].net.as_ref().is_some_and(|layout| layout.moded);
        let asked = units[outer].net.as_ref().is_some_and(|layout| layout.moves.asked || layout.moves.looped);
        for (i, part) in net.parts.iter().enumerate() {
            let inner = part_unit(unit, net, PartId(i as u32)).and_then(|inner| units[inner.0 as usize].net.as_mut());
            let Some(inner) = inner else {
                continue;
            };
            inner.moded |= moded;
            if let Some(place) = part.place {
                inner.moves.add(net, place);
                inner.moves.emptied |= emptied || part.abort.is_some();
                inner.moves.asked |= asked;
            }
        }
    }
}

/// By unit: whether it stands inside another net.
fn parts(program: &Program, units: &[UnitLayout<'_>]) -> Vec<bool> {
    let mut part = vec![false; units.len()];
    for (outer, unit) in program.units.iter().enumerate() {
        let Some(net) = net_of(program, unit).filter(|_| units[outer].used) else {
            continue;
        };
        for inner in (0..net.parts.len() as u32).filter_map(|i| part_unit(unit, net, PartId(i))) {
            part[inner.0 as usize] = true;
        }
    }
    part
}

/// By unit: whether a block of a composite stands for it, and whether one of the program does.
fn called(program: &Program, units: &[UnitLayout<'_>]) -> Vec<(bool, bool)> {
    let mut called = vec![(false, false); units.len()];
    for (index, unit) in program.units.iter().enumerate().filter(|(index, _)| units[*index].used) {
        if net_of(program, unit).is_none() {
            for inner in unit.blocks.iter().filter_map(|block| block.unit) {
                let (inside, top) = &mut called[inner.0 as usize];
                *(if index == 0 { top } else { inside }) = true;
            }
        }
    }
    called
}

#[derive(Default)]
struct Fields(Vec<Field>);

impl Fields {
    fn add(&mut self, name: &str, element: &'static str, count: Option<usize>) {
        if count != Some(0) {
            self.0.push(Field { name: name.to_owned(), element, count });
        }
    }

    fn add_if(&mut self, wanted: bool, name: &str, element: &'static str, count: Option<usize>) {
        if wanted {
            self.add(name, element, count);
        }
    }

    fn scratch(&mut self, layout: &NetLayout) {
        self.add("work", "pcl2_real", Some(layout.scratch.real));
        self.add("iwork", "int32_t", Some(layout.scratch.int));
        self.add("twork", "int64_t", Some(layout.scratch.time));
    }
}

fn table_fields(net: &Net, layout: &NetLayout) -> Vec<Field> {
    let (boxes, words, actives) = (net.boxes.len(), net.words.len(), net.actives.len());
    let mut fields = Fields::default();
    fields.add("now", "int64_t", None);
    fields.add_if(layout.timed, "period", "int64_t", None);
    fields.add_if(net.operation.is_some(), STOOD, "int64_t", None);
    fields.add("since", "int64_t", Some(boxes));
    fields.add("active_since", "int64_t", Some(actives));
    fields.add("reals", "pcl2_real", Some(layout.table.reals.len()));
    fields.add("ints", "int32_t", Some(layout.table.ints.len()));
    for name in ["taken", "filled", "used", "phase", "by", "hold"] {
        fields.add(name, "int32_t", Some(boxes));
    }
    fields.add("wrote", "int32_t", Some(words));
    fields.add("active", "int32_t", Some(actives));
    fields.add("lost", "int32_t", None);
    fields.add("conflicts", "int32_t", None);
    for name in MODE_COUNTERS {
        fields.add_if(net.operation.is_some(), name, "int32_t", None);
    }
    fields.scratch(layout);
    fields.0
}

fn fast_fields(net: &Net, layout: &NetLayout) -> Vec<Field> {
    let (boxes, facts) = (net.boxes.len(), &layout.facts);
    let any = |test: &dyn Fn(&Kind) -> bool| net.boxes.iter().any(|place| test(&place.kind));
    let acts = any(&|kind| matches!(kind, Kind::Action(_) | Kind::Process(_)));
    let times = any(&|kind| match kind {
        Kind::Time(_) => true,
        Kind::Process(process) => process.within.is_some(),
        Kind::State | Kind::Capacity | Kind::Count | Kind::Action(_) | Kind::Generation(_) | Kind::Macro(_) => false,
    });
    let generates = net.boxes.iter().any(facts::generates);
    let waits = net.boxes.iter().any(facts::waits) || generates;
    let sets = |count: usize| Some(count.div_ceil(32));
    let mut fields = Fields::default();
    fields.add_if(layout.timed, "now", "int64_t", None);
    fields.add_if(layout.timed, "period", "int64_t", None);
    fields.0.extend(modes::fields(net, layout.clocked, layout.moded));
    fields.add_if(times, "since", "int64_t", Some(boxes));
    fields.add("active_since", "int64_t", Some(net.actives.len()));
    fields.add("active", "int32_t", Some(net.actives.len()));
    fields.add("taken", "int32_t", Some(boxes));
    fields.add("filled", "int32_t", Some(boxes));
    fields.add_if(facts.loops, "used", "int32_t", Some(boxes));
    fields.add_if(waits, "phase", "int32_t", Some(boxes));
    fields.add_if(acts && facts.tracks(), "by", "int32_t", Some(boxes));
    fields.add_if(facts.tracks(), "wrote", "int32_t", Some(net.words.len()));
    fields.add_if(facts.tracks(), "conflicts", "int32_t", None);
    fields.add_if(generates, "lost", "int32_t", None);
    fields.add("ready", "uint32_t", sets(net.gates.len()));
    let begun = facts.begun.iter().any(Option::is_some);
    fields.add_if(begun, "begun", "uint32_t", sets(net.gates.len()));
    fields.add_if(facts.has_literals(), "open", "uint32_t", sets(net.gates.len()));
    fields.add("touched", "uint32_t", sets(boxes));
    fields.add_if((33..=32 * 32).contains(&boxes), MOVED, "uint32_t", None);
    fields.add_if(waits, "waiting", "uint32_t", sets(boxes));
    fields.add_if(facts.shows_late(), "shown", "uint32_t", sets(boxes));
    fields.add("drives", "int32_t", Some(facts.levels.len()));
    let follow = (0..boxes).any(|place| facts.outputs_follow(place));
    fields.add_if(follow, "outputs", "uint32_t", sets(facts.levels.len()));
    fields.add_if(waits, "waits", "int32_t", None);
    fields.add("restless", "int32_t", None);
    fields.add("go", "int32_t", None);
    fields.add_if(!net.parts.is_empty(), "inside", "int32_t", None);
    fields.scratch(layout);
    fields.0
}

/// Adds what tokens and the struct `net` take.
pub(crate) fn extent(extent: &mut Extent, net: &Net, layout: &NetLayout, form: NetForm, width: Width) {
    if form == NetForm::Fast {
        classes::extent(extent, net, width);
    }
    let mut beside = Extent::default();
    fields_extent(&mut beside, &layout.fields, width);
    extent.add(beside, 1);
}
