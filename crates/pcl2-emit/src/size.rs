//! How much memory a program takes on a target whose types are aligned to their size.

use crate::code::{Code, place_elements};
use crate::facts::{Facts, element_scalar};
use crate::layout::{Crossing, Layout};
use crate::shape::{Extent, Form, element_extent, fields_extent, kernel_extent};
use pcl2_lang::kernel;
use pcl2_lang::program::{Program, Unit};
use pcl2_lang::types::{Type, Width};

/// The extent of a signal.
pub(crate) fn of_type(ty: Type, width: Width) -> Extent {
    let each = element_extent(kernel::c_scalar(ty.scalar), width);
    Extent { size: each.size * ty.elements() as u64, align: each.align }
}

/// The extent of a block's instance.
pub(crate) fn shape(layout: &Layout<'_>, codes: &[Code<'_>], shape: u32, width: Width) -> Extent {
    let shape = &layout.shapes[shape as usize];
    let code = &codes[shape.decl.0 as usize];
    let mut extent = Extent::default();
    match shape.form {
        Form::Nothing => {}
        Form::Body(unit) => extent.add(layout.units[unit.0 as usize].extent, 1),
        Form::Kernel | Form::Plain | Form::Struct => {
            fields_extent(&mut extent, &shape.fields, width);
            if shape.state.is_some() {
                extent.add(kernel_extent(code, width), 1);
            }
        }
    }
    extent
}

/// What the program's struct has beside blocks, slots and cells.
pub(crate) fn rest(extent: &mut Extent, program: &Program, layout: &Layout<'_>) {
    for (_, crossing) in layout.border.inputs.iter().chain(&layout.border.outputs) {
        let ty = crossing_type(program, *crossing);
        extent.add(of_type(ty, program.width), 1);
    }
    let real = Extent { size: program.width.bytes() as u64, align: program.width.bytes() as u64 };
    extent.add(real, layout.scratch.real as u64);
    extent.add(Extent { size: 4, align: 4 }, layout.scratch.int as u64);
    extent.add(Extent { size: 8, align: 8 }, layout.scratch.time as u64);
    extent.add(Extent { size: 4, align: 4 }, 9 + layout.phases.iter().flatten().count() as u64);
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

/// What a composite's struct has beside blocks and slots.
pub(crate) fn own_params(extent: &mut Extent, program: &Program, unit: &Unit, facts: &Facts) {
    let Some((decl, sizes)) = &unit.composite else {
        return;
    };
    for (param, _) in program.decl(*decl).params.iter().zip(&facts.hot).filter(|(_, hot)| **hot) {
        let each = element_extent(kernel::c_scalar(element_scalar(&param.ty)), program.width);
        extent.add(each, place_elements(&param.ty, sizes) as u64);
    }
    extent.add(Extent { size: 4, align: 4 }, 1);
}
