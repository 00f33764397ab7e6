//! Where everything lives: members, slots, parts, cold parameters, the border.

use crate::NetForm;
use crate::code::Code;
use crate::facts::{self, Facts, Scratch};
use crate::names::Namer;
use crate::net::classes;
use crate::net::layout::{self as nets, NetLayout};
use crate::shape::{self, Cold, Extent, Form, Key, Shape};
use crate::size::{self, Measured};
use pcl2_lang::decl::{Direction, Step};
use pcl2_lang::model;
use pcl2_lang::net::Net;
use pcl2_lang::program::{
    Block, DeclId, ImageId, Param, Program, Role, Section, SectionKind, Signal, SignalId, Source, Unit, UnitId,
};
use pcl2_lang::types::Type;
use rustc_hash::FxHashMap;
use std::borrow::Cow;

/// The blocks of one function: a longer section is cut.
pub(crate) const PART: u32 = 64;
/// Stands for "in no part".
pub(crate) const WHOLE: u32 = u32::MAX;

/// Where a block's instance is.
#[derive(Clone, Debug)]
pub(crate) struct Member<'a> {
    /// The member's name; of a local variable its name; empty when the block keeps nothing.
    pub(crate) name: Cow<'a, str>,
    /// Its shape.
    pub(crate) shape: u32,
    /// Its part, or [`WHOLE`].
    pub(crate) part: u32,
}

/// Where a signal is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Store {
    /// In its only writer's instance: block and expanded output.
    Own(u32, u32),
    /// In a slot of its own: an index into [`UnitLayout::slots`].
    Slot(u32),
    /// Among the inputs: an index into [`Border::inputs`].
    Input(u32),
    /// In a composite: an argument of the function.
    Port(u32),
    /// In a composite: a local variable, named as the block.
    Local(u32),
}

/// The place of a signal that several blocks write.
#[derive(Clone, Debug)]
pub(crate) struct Slot<'a> {
    /// The member's name.
    pub(crate) name: Cow<'a, str>,
    /// The signal.
    pub(crate) signal: SignalId,
    /// Its part, or [`WHOLE`].
    pub(crate) part: u32,
    /// It stands in a struct that is declared apart.
    pub(crate) inside: bool,
}

/// The layout of one body.
#[derive(Clone, Debug, Default)]
pub(crate) struct UnitLayout<'a> {
    /// The struct's tag and the start of its functions' names.
    pub(crate) tag: String,
    /// By block.
    pub(crate) members: Vec<Member<'a>>,
    /// By signal.
    pub(crate) stores: Vec<Store>,
    /// Signals with a place of their own.
    pub(crate) slots: Vec<Slot<'a>>,
    /// For a composite: the arguments for its ports, groups expanded, and their types.
    pub(crate) ports: Vec<(String, Type)>,
    /// For a composite: the names of its own parameters.
    pub(crate) params: Vec<String>,
    /// What its caller must hand over.
    pub(crate) facts: Facts,
    /// Some block of the program uses it.
    pub(crate) used: bool,
    /// How many blocks stand for it.
    pub(crate) calls: usize,
    /// Size and alignment.
    pub(crate) extent: Extent,
    /// Of a net: what it keeps beside.
    pub(crate) net: Option<NetLayout>,
}

/// A run of blocks of a long section, with a struct and functions of its own.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Part {
    /// Its first block.
    pub(crate) first: u32,
    /// One past its last block.
    pub(crate) end: u32,
}

/// A value that crosses the border.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Crossing {
    /// A signal.
    Signal(SignalId),
    /// A word of the process image.
    Image(ImageId),
}

/// The members of `self->in` and `self->out`.
#[derive(Clone, Debug, Default)]
pub(crate) struct Border<'a> {
    /// Inputs.
    pub(crate) inputs: Vec<(Cow<'a, str>, Crossing)>,
    /// Outputs.
    pub(crate) outputs: Vec<(Cow<'a, str>, Crossing)>,
    /// By image word: its place among inputs or outputs.
    pub(crate) images: Vec<u32>,
}

/// The layout of a program.
#[derive(Clone, Debug, Default)]
pub(crate) struct Layout<'a> {
    /// By unit.
    pub(crate) units: Vec<UnitLayout<'a>>,
    /// The instances' shapes.
    pub(crate) shapes: Vec<Shape>,
    /// The structs of cold parameters.
    pub(crate) colds: Vec<Cold>,
    /// The parts of long sections.
    pub(crate) parts: Vec<Part>,
    /// By part: the name of its member.
    pub(crate) part_names: Vec<String>,
    /// What crosses the border.
    pub(crate) border: Border<'a>,
    /// By block of the program: the member of its cold parameters.
    pub(crate) cold_names: Vec<Option<Cow<'a, str>>>,
    /// By cell: its member among the cold ones.
    pub(crate) cell_names: Vec<Cow<'a, str>>,
    /// By section: the member that counts its scans, if it does not run in each.
    pub(crate) phases: Vec<Option<String>>,
    /// Scratch of the whole program.
    pub(crate) scratch: Scratch,
    /// Size and alignment of the whole.
    pub(crate) extent: Extent,
    /// How its nets become C.
    pub(crate) net_form: NetForm,
    /// By part: the tag of its struct and the name of its function.
    pub(crate) part_tags: Vec<String>,
    /// The names at file scope that are taken.
    pub(crate) tags: Namer<'static>,
    /// By block of the program: of a net, the function that makes its scan when something may happen.
    pub(crate) net_scans: Vec<Option<String>>,
    /// Operator cells that follow something: block and cell, in order of the block.
    pub(crate) tracking: Vec<(u32, u32)>,
}

/// Members of the program's struct that no block can have.
const RESERVED: &[&str] = &["in", "out", "cold", "health", "scan", "work", "iwork", "twork"];
/// Names inside a composite's functions that no block, port or parameter can have.
const RESERVED_INSIDE: &[&str] = &[
    "T",
    "bad",
    "changed",
    "cold",
    "hand",
    "hot",
    "left",
    "net",
    "nets",
    "self",
    "statement",
    "status",
    "iwork",
    "tokens",
    "twork",
    "work",
];

/// What stands behind the program's name in names that are always there.
const RESERVED_TAGS: &[&str] = &[
    "init", "step", "tune", "in", "out", "cold", "map", "points", "rows", "marks", "codes", "table", "initial",
    "status", "statuses", "fault",
];

/// What stands behind the tag of a composite, or of a net, in names of what is made of it.
fn behind_tag(net: Option<&Net>) -> Vec<String> {
    let mut suffixes: Vec<String> = ["init", "tune", "check"].map(str::to_owned).into();
    suffixes.extend(net.into_iter().flat_map(nets::suffixes));
    suffixes
}

/// Lays a program out.
pub(crate) fn layout<'a>(program: &'a Program, name: &str, codes: &[Code<'a>], form: NetForm) -> Layout<'a> {
    let mut builder = Builder::new(program, name, codes);
    builder.layout.net_form = form;
    builder.mark_used();
    for unit in (1..program.units.len()).rev() {
        builder.body(unit);
    }
    nets::settle(program, &mut builder.layout.units, form);
    builder.main();
    builder.tag_shapes();
    builder.measure();
    builder.layout
}

struct Builder<'a, 'c> {
    program: &'a Program,
    name: &'c str,
    codes: &'c [Code<'a>],
    kernels: Vec<Facts>,
    layout: Layout<'a>,
    shapes: FxHashMap<Key, u32>,
    structs: classes::Structs,
}

impl<'a, 'c> Builder<'a, 'c> {
    fn new(program: &'a Program, name: &'c str, codes: &'c [Code<'a>]) -> Builder<'a, 'c> {
        let units = program.units.iter().map(|_| UnitLayout::default()).collect();
        let mut tags = Namer::default();
        for suffix in RESERVED_TAGS {
            tags.made(&format!("{name}_{suffix}"));
        }
        let kernels = codes.iter().map(facts::of_kernel).collect();
        let layout = Layout { units, tags, ..Layout::default() };
        Builder { program, name, codes, kernels, layout, shapes: FxHashMap::default(), structs: Vec::new() }
    }

    fn mark_used(&mut self) {
        self.layout.units[0].used = true;
        for unit in 0..self.program.units.len() {
            if self.layout.units[unit].used {
                for inner in self.program.units[unit].blocks.iter().filter_map(|block| block.unit) {
                    self.layout.units[inner.0 as usize].used = true;
                    self.layout.units[inner.0 as usize].calls += 1;
                }
            }
        }
    }

    fn tag(&mut self, suffix: &str) -> String {
        let wanted = format!("{}_{suffix}", self.name);
        self.layout.tags.made(&wanted)
    }

    fn body(&mut self, index: usize) {
        let program: &'a Program = self.program;
        let unit = &program.units[index];
        let Some((decl, sizes)) = unit.composite.as_ref().filter(|_| self.layout.units[index].used) else {
            return;
        };
        let decl = program.decl(*decl);
        let mut facts = facts::of_body(program, unit, self.codes, &self.layout.units, &self.kernels);
        let mut namer = Namer::new(RESERVED_INSIDE);
        namer.reserve(self.name);
        let ports = port_names(decl, sizes, &mut namer);
        let params = decl.params.iter().map(|param| namer.made(&param.name)).collect();
        let net = decl.net.as_deref();
        let stores = stores_inside(unit, self.codes, net.is_some());
        let members = self.members(unit, &stores, &mut namer, |_| WHOLE);
        let (stores, slots) = slots(unit, stores, &mut namer, &members, &ports);
        let tag = format!("{}_{}", self.name, decl.name);
        let tag = self.layout.tags.family(&tag, &behind_tag(net));
        let net = net.map(|net| {
            let scratch = std::mem::take(&mut facts.scratch);
            let boxes = net.boxes.iter().map(|place| self.layout.tags.made(&format!("{tag}_{}", place.name))).collect();
            let names = classes::names(net, (self.name, &tag), &mut self.structs, &mut self.layout.tags);
            let layout = nets::layout(program, unit, net, &self.layout.units, scratch, (boxes, names));
            facts.of_net(layout.timed);
            layout
        });
        let calls = self.layout.units[index].calls;
        self.layout.units[index] = UnitLayout {
            tag,
            members,
            stores,
            slots,
            ports,
            params,
            facts,
            used: true,
            calls,
            extent: Extent::default(),
            net,
        };
    }

    fn main(&mut self) {
        let program: &'a Program = self.program;
        let unit = program.main();
        let mut namer = Namer::new(RESERVED);
        self.layout.parts = parts(&program.sections);
        self.layout.part_names = (1..=self.layout.parts.len()).map(|n| namer.made(&format!("c{n}"))).collect();
        self.layout.part_tags = (1..=self.layout.parts.len()).map(|n| self.tag(&format!("c{n}"))).collect();
        self.layout.phases = phases(&program.sections, &mut namer);
        self.layout.border = border(program);
        let stores = stores_of_main(unit, &self.layout.border);
        let part_of = part_table(unit.blocks.len(), &self.layout.parts);
        let members = self.members(unit, &stores, &mut namer, |block| part_of[block]);
        let (stores, slots) = slots(unit, stores, &mut namer, &members, &[]);
        self.layout.net_scans = self.net_scans(unit, &members);
        self.cold(unit, &members);
        self.layout.scratch = self.scratch(unit);
        self.layout.tracking = tracking(unit);
        let main = &mut self.layout.units[0];
        *main = UnitLayout { tag: self.name.to_owned(), members, stores, slots, used: true, ..UnitLayout::default() };
    }

    fn members(
        &mut self,
        unit: &'a Unit,
        stores: &[Store],
        namer: &mut Namer<'a>,
        part: impl Fn(usize) -> u32,
    ) -> Vec<Member<'a>> {
        let mut members = Vec::with_capacity(unit.blocks.len());
        for (b, block) in unit.blocks.iter().enumerate() {
            let local = stores_local(block, stores);
            let shape = if local { self.nothing(block) } else { self.shape(unit, block, stores) };
            let named = local || self.layout.shapes[shape as usize].form != Form::Nothing;
            let name = if named { namer.name(&block.name) } else { Cow::Borrowed("") };
            members.push(Member { name, shape, part: part(b) });
        }
        members
    }

    /// A block whose output is a local variable: as one that writes elsewhere.
    fn nothing(&mut self, block: &Block) -> u32 {
        let key = Key {
            decl: block.decl,
            unit: None,
            sizes: block.sizes.clone().into(),
            tunable: false,
            elsewhere: (0..self.codes[block.decl.0 as usize].decl.outputs.len() as u32).collect(),
        };
        self.intern(key, block)
    }

    fn shape(&mut self, unit: &Unit, block: &Block, stores: &[Store]) -> u32 {
        let key = Key {
            decl: block.decl,
            unit: block.unit,
            sizes: block.sizes.clone().into(),
            tunable: block.tunable && unit.composite.is_none(),
            elsewhere: self.elsewhere(unit, block, stores).into(),
        };
        self.intern(key, block)
    }

    fn intern(&mut self, key: Key, block: &Block) -> u32 {
        if let Some(shape) = self.shapes.get(&key) {
            return *shape;
        }
        let code = &self.codes[key.decl.0 as usize];
        let mut shape = match key.unit {
            Some(inner) => shape::of_body(inner, key.decl),
            None => shape::of_kernel(code, block, &key),
        };
        if key.tunable {
            let hot = match key.unit {
                Some(inner) => &self.layout.units[inner.0 as usize].facts.hot,
                None => &self.kernels[key.decl.0 as usize].hot,
            };
            if let Some(cold) = shape::cold(code, block, hot) {
                shape.cold = Some(self.layout.colds.len());
                self.layout.colds.push(cold);
            }
        }
        let index = self.layout.shapes.len() as u32;
        self.layout.shapes.push(shape);
        self.shapes.insert(key, index);
        index
    }

    /// The declared outputs that the call writes straight to their signal's own place, and those that nobody hears.
    fn elsewhere(&self, unit: &Unit, block: &Block, stores: &[Store]) -> Vec<u32> {
        let code = &self.codes[block.decl.0 as usize];
        let open = |output: &u32| model::is_open(unit, block, code.decl, *output as usize);
        let mut elsewhere: Vec<u32> = (0..code.decl.outputs.len() as u32).filter(open).collect();
        if block.unit.is_some() || !(code.decl.inline || code.decl.outputs.iter().any(|output| output.inout)) {
            return elsewhere;
        }
        for (i, signal) in block.outputs.iter().enumerate() {
            let (declared, _) = code.output(i, &block.sizes);
            let own = matches!(stores[signal.0 as usize], Store::Own(..));
            if !own && writes_through(code, declared) {
                elsewhere.push(declared as u32);
            }
        }
        elsewhere
    }

    fn net_scans(&mut self, unit: &Unit, members: &[Member<'_>]) -> Vec<Option<String>> {
        let mut scans = Vec::with_capacity(unit.blocks.len());
        for (block, member) in unit.blocks.iter().zip(members) {
            let is_net = |unit: UnitId| self.layout.units[unit.0 as usize].net.is_some();
            let net = self.layout.net_form == NetForm::Fast && block.unit.is_some_and(is_net);
            scans.push(net.then(|| self.tag(&format!("scan_{}", member.name))));
        }
        scans
    }

    fn cold(&mut self, unit: &'a Unit, members: &[Member<'a>]) {
        let mut namer = Namer::default();
        self.layout.cold_names = Vec::with_capacity(unit.blocks.len());
        for (block, member) in unit.blocks.iter().zip(members) {
            let cold = self.layout.shapes[member.shape as usize].cold.is_some();
            self.layout.cold_names.push(cold.then(|| namer.name(&block.name)));
        }
        self.layout.cell_names = unit.cells.iter().map(|cell| namer.name(&cell.name)).collect();
    }

    fn scratch(&self, unit: &Unit) -> Scratch {
        let mut scratch = Scratch::default();
        for block in &unit.blocks {
            let inner = block.unit.map_or_else(Scratch::default, |u| self.layout.units[u.0 as usize].facts.scratch);
            scratch = scratch.max(facts::of_block(unit, block, &self.codes[block.decl.0 as usize], inner));
        }
        scratch
    }

    fn tag_shapes(&mut self) {
        for i in 0..self.layout.shapes.len() {
            let name = &self.program.decl(self.layout.shapes[i].decl).name;
            if self.layout.shapes[i].form == Form::Struct {
                let twin = self.twin(i);
                self.layout.shapes[i].declared = twin.is_none();
                self.layout.shapes[i].tag = match twin {
                    Some(twin) => self.layout.shapes[twin].tag.clone(),
                    None => self.tag(name),
                };
            }
            if let Some(cold) = self.layout.shapes[i].cold {
                self.layout.colds[cold].tag = self.tag(&format!("{name}_cold"));
            }
        }
    }

    /// An earlier shape of the same code with the same fields.
    fn twin(&self, index: usize) -> Option<usize> {
        let shape = &self.layout.shapes[index];
        let same = |other: &Shape| {
            other.decl == shape.decl
                && other.form == Form::Struct
                && other.fields == shape.fields
                && other.params.iter().flatten().count() == shape.params.iter().flatten().count()
        };
        self.layout.shapes[..index].iter().position(same)
    }

    fn measure(&mut self) {
        for index in (1..self.program.units.len()).rev() {
            if self.layout.units[index].used {
                self.layout.units[index].extent = size::body(self.measured(), index);
            }
        }
        self.layout.extent = size::main(self.measured());
    }

    fn measured(&self) -> Measured<'_, 'a> {
        Measured { program: self.program, layout: &self.layout, codes: self.codes }
    }
}

/// Whether the call writes this output to the signal's own place, even if other blocks write it too.
pub(crate) fn writes_through(code: &Code<'_>, output: usize) -> bool {
    let declared = &code.decl.outputs[output];
    declared.inout || (code.decl.inline && declared.group.is_none())
}

fn stores_local(block: &Block, stores: &[Store]) -> bool {
    block.outputs.iter().any(|signal| matches!(stores[signal.0 as usize], Store::Local(_)))
}

fn port_names(decl: &pcl2_lang::decl::Decl, sizes: &[i32], namer: &mut Namer<'_>) -> Vec<(String, Type)> {
    let mut names = Vec::new();
    for port in decl.ports() {
        let ty = pcl2_lang::kernel::resolve(&port.ty, sizes).unwrap_or(Type::REAL);
        let count = pcl2_lang::kernel::count(port.group.as_ref(), sizes).unwrap_or(0);
        for i in 1..=count {
            let name =
                if port.group.is_some() { namer.made(&format!("{}_{i}", port.name)) } else { namer.made(&port.name) };
            names.push((name, ty));
        }
    }
    names
}

fn parts(sections: &[Section]) -> Vec<Part> {
    let mut parts = Vec::new();
    for section in sections.iter().filter(|section| section.end - section.first > PART) {
        let length = section.end - section.first;
        let each = length.div_ceil(length.div_ceil(PART));
        for first in (section.first..section.end).step_by(each as usize) {
            parts.push(Part { first, end: section.end.min(first + each) });
        }
    }
    parts
}

fn part_table(blocks: usize, parts: &[Part]) -> Vec<u32> {
    let mut table = vec![WHOLE; blocks];
    for (p, part) in parts.iter().enumerate() {
        table[part.first as usize..part.end as usize].fill(p as u32);
    }
    table
}

fn phases(sections: &[Section], namer: &mut Namer<'_>) -> Vec<Option<String>> {
    let mut number = 0;
    let mut phase = |section: &Section| match section.kind {
        SectionKind::Control { every, .. } if every > 1 => {
            number += 1;
            Some(namer.made(&format!("due{number}")))
        }
        SectionKind::Control { .. } | SectionKind::Initialize | SectionKind::Plant => None,
    };
    sections.iter().map(&mut phase).collect()
}

fn border(program: &Program) -> Border<'_> {
    let mut border = Border::default();
    let (mut inputs, mut outputs) = (Namer::default(), Namer::default());
    for (i, signal) in program.main().signals.iter().enumerate() {
        let crossing = Crossing::Signal(SignalId(i as u32));
        match signal.role {
            Role::Input => border.inputs.push((inputs.name(&signal.name), crossing)),
            Role::Output => border.outputs.push((outputs.name(&signal.name), crossing)),
            Role::Wire | Role::Port(_) | Role::Held => {}
        }
    }
    for (i, image) in program.images.iter().enumerate() {
        let (names, list) = match image.direction {
            Direction::In => (&mut inputs, &mut border.inputs),
            Direction::Out => (&mut outputs, &mut border.outputs),
        };
        border.images.push(list.len() as u32);
        list.push((names.name(&image.name), Crossing::Image(ImageId(i as u32))));
    }
    border
}

fn stores_of_main(unit: &Unit, border: &Border<'_>) -> Vec<Store> {
    let mut stores: Vec<Store> = unit.signals.iter().map(store_of).collect();
    for (i, (_, crossing)) in border.inputs.iter().enumerate() {
        if let Crossing::Signal(signal) = crossing {
            stores[signal.0 as usize] = Store::Input(i as u32);
        }
    }
    stores
}

/// A signal with one whole writer is that writer's output; any other has a slot, numbered later.
fn store_of(signal: &Signal) -> Store {
    match signal.writers.as_slice() {
        [writer] if !writer.inout => Store::Own(writer.block.0, writer.output),
        _ => Store::Slot(0),
    }
}

fn stores_inside(unit: &Unit, codes: &[Code<'_>], net: bool) -> Vec<Store> {
    let early = read_early(unit);
    let store = |(i, signal): (usize, &Signal)| match (signal.role, store_of(signal)) {
        (Role::Port(port), _) if !net => Store::Port(port),
        (Role::Port(_) | Role::Held, _) => Store::Slot(0),
        // Conditions and times of nets: the player asks for their values.
        (Role::Wire, Store::Own(block, _)) if net && is_temporary(unit, codes, block) => Store::Local(block),
        (Role::Wire, Store::Own(block, _)) if !early[i] && is_temporary(unit, codes, block) => Store::Local(block),
        (Role::Wire | Role::Input | Role::Output, store) => store,
    };
    unit.signals.iter().enumerate().map(store).collect()
}

/// Signals that must outlive the call: outputs of the composite, and those read before they are written. One that
/// nobody reads stays in the instance too: as a local variable it would be an unused one.
fn read_early(unit: &Unit) -> Vec<bool> {
    let mut early = vec![false; unit.signals.len()];
    let mut read = vec![false; unit.signals.len()];
    for signal in &unit.outputs {
        early[signal.0 as usize] = true;
    }
    for (b, block) in unit.blocks.iter().enumerate() {
        for id in block.ports.iter().filter_map(Source::signal) {
            let first = unit.signal(id).writers.first();
            early[id.0 as usize] |= first.is_none_or(|writer| writer.block.0 as usize >= b);
            read[id.0 as usize] = true;
        }
    }
    early.iter().zip(read).map(|(early, read)| *early || !read).collect()
}

fn is_temporary(unit: &Unit, codes: &[Code<'_>], block: u32) -> bool {
    codes[unit.blocks[block as usize].decl.0 as usize].returns
}

fn slots<'a>(
    unit: &'a Unit,
    mut stores: Vec<Store>,
    namer: &mut Namer<'a>,
    members: &[Member<'a>],
    ports: &[(String, Type)],
) -> (Vec<Store>, Vec<Slot<'a>>) {
    let mut slots = Vec::new();
    for (i, signal) in unit.signals.iter().enumerate() {
        if matches!(stores[i], Store::Slot(_)) {
            stores[i] = Store::Slot(slots.len() as u32);
            let part = signal.writers.first().map_or(WHOLE, |writer| members[writer.block.0 as usize].part);
            // A net keeps its inputs under the names of the arguments.
            let name = match signal.role {
                Role::Port(port) => Cow::Owned(ports[port as usize].0.clone()),
                Role::Wire | Role::Input | Role::Output | Role::Held => namer.name(&signal.name),
            };
            slots.push(Slot { name, signal: SignalId(i as u32), part, inside: false });
        }
    }
    slots.sort_by_key(|slot: &Slot<'_>| (slot.part != WHOLE, slot.part));
    for (i, slot) in slots.iter().enumerate() {
        stores[slot.signal.0 as usize] = Store::Slot(i as u32);
    }
    (stores, slots)
}

fn tracking(unit: &Unit) -> Vec<(u32, u32)> {
    let cells = unit.cells.iter().enumerate().filter(|(_, cell)| cell.tracks.is_some());
    let mut tracking: Vec<(u32, u32)> = cells.map(|(i, cell)| (cell.block.0, i as u32)).collect();
    tracking.sort_unstable();
    tracking
}

/// The value of a parameter where every value is known; `None` for a composite's own.
pub(crate) fn known_value(param: &Param) -> Option<&pcl2_lang::types::Value> {
    pcl2_lang::model::value(param)
}

/// The function codes behind a block's: those of an expression, else itself.
pub(crate) fn codes_of(program: &Program, decl: DeclId) -> Vec<DeclId> {
    let code = |step: &Step| match step {
        Step::Port => None,
        Step::Apply(code) => Some(*code),
    };
    match &program.decl(decl).formula {
        Some(formula) => formula.iter().filter_map(code).collect(),
        None => vec![decl],
    }
}

/// The declarations that blocks of the program use, each once, in order of first use.
pub(crate) fn used_decls(program: &Program, layout: &Layout<'_>) -> Vec<DeclId> {
    let mut seen = vec![false; program.decls.len()];
    let mut used = Vec::new();
    for (unit, _) in program.units.iter().zip(&layout.units).filter(|(_, layout)| layout.used) {
        for block in &unit.blocks {
            if std::mem::replace(&mut seen[block.decl.0 as usize], true) {
                continue;
            }
            for code in codes_of(program, block.decl) {
                if code == block.decl || !std::mem::replace(&mut seen[code.0 as usize], true) {
                    used.push(code);
                }
            }
        }
    }
    used
}

/// Bodies in an order in which each comes after those it uses.
pub(crate) fn bodies<'l>(layout: &'l Layout<'_>) -> impl Iterator<Item = UnitId> + use<'l> {
    (1..layout.units.len()).rev().filter(|unit| layout.units[*unit].used).map(|unit| UnitId(unit as u32))
}
