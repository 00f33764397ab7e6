//! Range, unit and retention of points, as their declarations have them.

use crate::context::Context;
use pcl2_lang::bounds;
use pcl2_lang::decl::{Bounds, Tail};
use pcl2_lang::model::{Place, Point};
use pcl2_lang::program::{Block, BlockId, UnitId};

/// What a declaration says of a point.
#[derive(Debug, Default)]
pub(crate) struct Tag<'a> {
    /// Range or names.
    pub(crate) tail: Option<&'a Tail>,
    /// The sizes that the range may speak of.
    pub(crate) sizes: &'a [i32],
    /// Kept over power loss.
    pub(crate) retain: bool,
}

/// What the declaration behind a point says of it.
pub(crate) fn tag<'a>(cx: &Context<'a>, point: &Point) -> Tag<'a> {
    let unit = cx.program.main();
    match point.place {
        Place::Signal(id) => match unit.signal(id).writers.first() {
            Some(writer) => {
                let block = unit.block(writer.block);
                let (output, _) = cx.code(block.decl).output(writer.output as usize, &block.sizes);
                of_output(cx, block, output)
            }
            None => Tag::default(),
        },
        Place::Param(block, param) => {
            let block = unit.block(block);
            let decl = cx.code(block.decl).decl;
            Tag { tail: Some(&decl.params[param as usize].tail), sizes: &block.sizes, retain: false }
        }
        Place::Cell(id) => {
            let cell = &unit.cells[id.0 as usize];
            let block = unit.block(cell.block);
            let code = cx.code(block.decl);
            let inside = |port: &usize| {
                let (first, count) = code.port_range(*port, &block.sizes);
                (first..first + count).contains(&(cell.port as usize))
            };
            let port = (0..code.ports.len()).find(inside);
            Tag { tail: port.map(|port| &code.ports[port].tail), sizes: &block.sizes, retain: false }
        }
        Place::Image(_) => Tag::default(),
        Place::Memory(field) => Tag { tail: None, sizes: &[], retain: retained(cx, &point.path, field) },
    }
}

fn of_output<'a>(cx: &Context<'a>, block: &'a Block, output: usize) -> Tag<'a> {
    let decl = cx.code(block.decl).decl;
    let declared = &decl.outputs[output];
    Tag { tail: Some(&declared.tail), sizes: &block.sizes, retain: decl.retain.contains(&declared.name) }
}

fn retained(cx: &Context<'_>, path: &[BlockId], field: u32) -> bool {
    let block = innermost(cx, path);
    block.is_some_and(|(unit, id)| {
        let decl = cx.code(cx.program.unit(unit).block(id).decl).decl;
        decl.memory.get(field as usize).is_some_and(|field| decl.retain.contains(&field.name))
    })
}

/// The body and the block that a path leads to.
pub(crate) fn innermost(cx: &Context<'_>, path: &[BlockId]) -> Option<(UnitId, BlockId)> {
    let (last, outer) = path.split_last()?;
    let mut unit = UnitId(0);
    for id in outer {
        unit = cx.program.unit(unit).block(*id).unit?;
    }
    Some((unit, *last))
}

/// The range in numbers, as far as it does not depend on parameters.
pub(crate) fn range(tag: &Tag<'_>) -> (Option<f64>, Option<f64>) {
    let Some(tail) = tag.tail else {
        return (None, None);
    };
    if !tail.names.is_empty() {
        return (Some(0.0), Some(tail.names.len() as f64 - 1.0));
    }
    let Some(Bounds { lower, upper, .. }) = &tail.bounds else {
        return (None, None);
    };
    let number = |bound: &Option<_>| bound.as_ref().and_then(|bound| bounds::evaluate(bound, tag.sizes, None));
    (number(lower), number(upper))
}
