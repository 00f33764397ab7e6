//! What an instance of a net keeps beside its signals, and how its boxes are called in C.

use crate::facts::Scratch;
use crate::layout::UnitLayout;
use crate::shape::{Extent, Field, fields_extent};
use pcl2_lang::net::table::{self, Table};
use pcl2_lang::net::{Net, PartId};
use pcl2_lang::program::{Program, Role, Unit, UnitId};
use pcl2_lang::types::Width;

/// How long a net with modes was stopped.
pub(crate) const STOOD: &str = "stood";

/// What a net with modes keeps in ints.
pub(crate) const MODE_COUNTERS: [&str; 3] = ["halted", "forced", "refused"];

/// The layout of a net.
#[derive(Clone, Debug, Default)]
pub(crate) struct NetLayout {
    /// The first signal that the net keeps: words, then the tokens of boxes, then attributes of tokens in hand.
    pub(crate) held: usize,
    /// By box: the enumerator that stands for it.
    pub(crate) boxes: Vec<String>,
    /// The members of the struct `net` inside the instance.
    pub(crate) fields: Vec<Field>,
    /// What the player walks.
    pub(crate) table: Table,
    /// How many nets it is made of, itself included.
    pub(crate) nets: usize,
    /// It, or a net inside, depends on time.
    pub(crate) timed: bool,
    /// Scratch of its statements.
    pub(crate) scratch: Scratch,
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
    boxes: Vec<String>,
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
    let mut layout = NetLayout {
        held,
        boxes,
        nets: 1 + parts.iter().map(|part| part.nets).sum::<usize>(),
        timed: net.has_time() || parts.iter().any(|part| part.timed),
        table,
        scratch,
        fields: Vec::new(),
    };
    layout.fields = fields(net, &layout);
    layout
}

fn fields(net: &Net, layout: &NetLayout) -> Vec<Field> {
    let (boxes, words, actives) = (net.boxes.len(), net.words.len(), net.actives.len());
    let mut fields = Vec::new();
    let mut add = |name: &str, element: &'static str, count: Option<usize>| {
        if count != Some(0) {
            fields.push(Field { name: name.to_owned(), element, count });
        }
    };
    add("now", "int64_t", None);
    if layout.timed {
        add("period", "int64_t", None);
    }
    if net.operation.is_some() {
        add(STOOD, "int64_t", None);
    }
    add("since", "int64_t", Some(boxes));
    add("active_since", "int64_t", Some(actives));
    add("reals", "pcl2_real", Some(layout.table.reals.len()));
    add("ints", "int32_t", Some(layout.table.ints.len()));
    for name in ["taken", "filled", "used", "phase", "by", "hold"] {
        add(name, "int32_t", Some(boxes));
    }
    add("wrote", "int32_t", Some(words));
    add("active", "int32_t", Some(actives));
    add("lost", "int32_t", None);
    add("conflicts", "int32_t", None);
    for name in MODE_COUNTERS.iter().filter(|_| net.operation.is_some()) {
        add(name, "int32_t", None);
    }
    add("work", "pcl2_real", Some(layout.scratch.real));
    add("iwork", "int32_t", Some(layout.scratch.int));
    add("twork", "int64_t", Some(layout.scratch.time));
    fields
}

/// Adds what the struct `net` takes.
pub(crate) fn extent(extent: &mut Extent, layout: &NetLayout, width: Width) {
    fields_extent(extent, &layout.fields, width);
}
