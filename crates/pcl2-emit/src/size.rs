//! How much memory a program takes on a target whose types are aligned to their size. The order is that of the header:
//! padding stands between members.

use crate::code::{Code, place_elements};
use crate::facts::element_scalar;
use crate::layout::{Crossing, Layout, UnitLayout, WHOLE};
use crate::net::layout as nets;
use crate::shape::{Extent, Form, element_extent, fields_extent, kernel_extent};
use pcl2_lang::kernel;
use pcl2_lang::program::{Program, Unit};
use pcl2_lang::types::{Type, Width};

const WORD: Extent = Extent { size: 4, align: 4 };

/// What is measured: a program as it is laid out.
#[derive(Clone, Copy)]
pub(crate) struct Measured<'m, 'a> {
    /// The program.
    pub(crate) program: &'m Program,
    /// Its layout; bodies inside are measured before those that use them.
    pub(crate) layout: &'m Layout<'a>,
    /// By declaration: its code.
    pub(crate) codes: &'m [Code<'a>],
}

/// The extent of a body's instance.
pub(crate) fn body(measured: Measured<'_, '_>, index: usize) -> Extent {
    let Measured { program, layout, .. } = measured;
    let (unit, own) = (&program.units[index], &layout.units[index]);
    let mut extent = Extent::default();
    own_params(&mut extent, program, unit, own);
    members(&mut extent, measured, own, 0..own.members.len());
    let slots = own.slots.iter().filter(|slot| !slot.inside);
    slots.for_each(|slot| extent.add(of_type(unit.signal(slot.signal).ty, program.width), 1));
    if let (Some(net), Some(kept)) = (nets::net_of(program, unit), &own.net) {
        nets::extent(&mut extent, net, kept, layout.net_form, program.width);
    }
    if own.facts.status || extent.size == 0 {
        extent.add(WORD, 1);
    }
    extent
}

/// The extent of the program's instance.
pub(crate) fn main(measured: Measured<'_, '_>) -> Extent {
    let Measured { program, layout, .. } = measured;
    let own = &layout.units[0];
    let mut extent = Extent::default();
    for list in [&layout.border.inputs, &layout.border.outputs] {
        let types = list.iter().map(|(_, crossing)| of_type(crossing_type(program, *crossing), program.width));
        extent.add(together(types), 1);
    }
    let mut next = 0;
    for (index, part) in layout.parts.iter().enumerate() {
        let (first, end) = (part.first as usize, part.end as usize);
        members(&mut extent, measured, own, next..first);
        let mut inside = Extent::default();
        members(&mut inside, measured, own, first..end);
        slots(&mut inside, program, own, index as u32);
        extent.add(inside, 1);
        next = end;
    }
    members(&mut extent, measured, own, next..own.members.len());
    slots(&mut extent, program, own, WHOLE);
    extent.add(cold(measured, own), 1);
    rest(&mut extent, program, layout);
    extent
}

fn members(extent: &mut Extent, measured: Measured<'_, '_>, own: &UnitLayout<'_>, blocks: impl Iterator<Item = usize>) {
    blocks.for_each(|block| extent.add(shape(measured, own.members[block].shape), 1));
}

/// The signals with a place of their own in a part of the program's own body.
fn slots(extent: &mut Extent, program: &Program, own: &UnitLayout<'_>, part: u32) {
    for slot in own.slots.iter().filter(|slot| slot.part == part) {
        extent.add(of_type(program.main().signal(slot.signal).ty, program.width), 1);
    }
}

/// The parameters that only tune reads, and operator cells.
fn cold(measured: Measured<'_, '_>, own: &UnitLayout<'_>) -> Extent {
    let Measured { program, layout, .. } = measured;
    let colds = own.members.iter().filter_map(|member| layout.shapes[member.shape as usize].cold);
    let fields = colds.map(|cold| {
        let mut extent = Extent::default();
        fields_extent(&mut extent, &layout.colds[cold].fields, program.width);
        extent
    });
    let cells = program.main().cells.iter().map(|cell| of_type(cell.ty, program.width));
    together(fields.chain(cells))
}

fn together(members: impl Iterator<Item = Extent>) -> Extent {
    let mut extent = Extent::default();
    members.for_each(|member| extent.add(member, 1));
    extent
}

/// The extent of a signal.
fn of_type(ty: Type, width: Width) -> Extent {
    let each = element_extent(kernel::c_scalar(ty.scalar), width);
    Extent { size: each.size * ty.elements() as u64, align: each.align }
}

/// The extent of a block's instance.
fn shape(measured: Measured<'_, '_>, shape: u32) -> Extent {
    let Measured { program, layout, codes } = measured;
    let shape = &layout.shapes[shape as usize];
    let mut extent = Extent::default();
    match shape.form {
        Form::Nothing => {}
        Form::Body(unit) => extent.add(layout.units[unit.0 as usize].extent, 1),
        Form::Kernel | Form::Plain | Form::Struct => {
            let (params, others) = shape.fields.split_at(shape.params.iter().flatten().count());
            fields_extent(&mut extent, params, program.width);
            if shape.state.is_some() {
                extent.add(kernel_extent(&codes[shape.decl.0 as usize], program.width), 1);
            }
            fields_extent(&mut extent, others, program.width);
        }
    }
    extent
}

/// What the program's struct ends with: scans until sections run, scans done, health, scratch.
fn rest(extent: &mut Extent, program: &Program, layout: &Layout<'_>) {
    extent.add(WORD, 9 + layout.phases.iter().flatten().count() as u64);
    let real = Extent { size: program.width.bytes() as u64, align: program.width.bytes() as u64 };
    extent.add(real, layout.scratch.real as u64);
    extent.add(WORD, layout.scratch.int as u64);
    extent.add(Extent { size: 8, align: 8 }, layout.scratch.time as u64);
}

/// The type of a value at the border.
pub(crate) fn crossing_type(program: &Program, crossing: Crossing) -> Type {
    match crossing {
        Crossing::Signal(signal) => program.main().signal(signal).ty,
        Crossing::Image(image) => {
            Type { scalar: program.images[image.0 as usize].scalar, shape: pcl2_lang::types::Shape::Scalar }
        }
    }
}

/// The parameters that a composite's struct begins with.
fn own_params(extent: &mut Extent, program: &Program, unit: &Unit, own: &UnitLayout<'_>) {
    let Some((decl, sizes)) = &unit.composite else {
        return;
    };
    for (param, _) in program.decl(*decl).params.iter().zip(&own.facts.hot).filter(|(_, hot)| **hot) {
        let each = element_extent(kernel::c_scalar(element_scalar(&param.ty)), program.width);
        extent.add(each, place_elements(&param.ty, sizes) as u64);
    }
}
