//! The instance structs: what one block keeps, by function code and sizes.

use crate::code::{Code, place_elements};
use crate::names::Namer;
use pcl2_lang::kernel;
use pcl2_lang::program::{Block, DeclId, UnitId};
use pcl2_lang::types::Width;
use std::fmt::Write;

/// One field of a generated struct.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Field {
    /// The C name.
    pub(crate) name: String,
    /// The C type of an element.
    pub(crate) element: &'static str,
    /// `Some` for an array.
    pub(crate) count: Option<usize>,
}

/// What a member of the program's struct is in C.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// The block keeps nothing.
    Nothing,
    /// A plain `struct pcl2_X`.
    Kernel,
    /// A plain number or array: the output of an inline code.
    Plain,
    /// A struct of parameters, state and outputs.
    Struct,
    /// The struct of a composite's body.
    Body(UnitId),
}

/// The instance of a block: one for all blocks with equal code, sizes and wiring of outputs.
#[derive(Clone, Debug)]
pub(crate) struct Shape {
    /// The function code.
    pub(crate) decl: DeclId,
    /// What it is in C.
    pub(crate) form: Form,
    /// The struct's tag, for [`Form::Struct`].
    pub(crate) tag: String,
    /// The struct is declared with this shape; false where an earlier one has the same fields.
    pub(crate) declared: bool,
    /// The fields beside the kernel's struct.
    pub(crate) fields: Vec<Field>,
    /// The name of the kernel's struct among them, if there is one.
    pub(crate) state: Option<String>,
    /// By parameter: its field, if the step reads it from RAM.
    pub(crate) params: Vec<Option<usize>>,
    /// By memory field: its array.
    pub(crate) memory: Vec<Option<usize>>,
    /// By tuned field: its array.
    pub(crate) tuned: Vec<Option<usize>>,
    /// By declared output: its field. None: it is in the kernel's struct, or stands elsewhere.
    pub(crate) outputs: Vec<Option<usize>>,
    /// The parameters that only tune reads.
    pub(crate) cold: Option<usize>,
}

/// The struct of the parameters that only tune reads.
#[derive(Clone, Debug)]
pub(crate) struct Cold {
    /// Its tag.
    pub(crate) tag: String,
    /// The fields.
    pub(crate) fields: Vec<Field>,
    /// By parameter: its field.
    pub(crate) params: Vec<Option<usize>>,
}

/// What distinguishes the instances of blocks of one code.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Key {
    /// The function code.
    pub(crate) decl: DeclId,
    /// The body of a composite.
    pub(crate) unit: Option<UnitId>,
    /// The values of its size variables.
    pub(crate) sizes: Box<[i32]>,
    /// Its parameters stay in RAM.
    pub(crate) tunable: bool,
    /// Declared outputs that the call writes to another place.
    pub(crate) elsewhere: Box<[u32]>,
}

/// Builds the shape of a kernel's instance.
pub(crate) fn of_kernel(code: &Code<'_>, block: &Block, key: &Key) -> Shape {
    let decl = code.decl;
    let mut fields = Fields::default();
    let params = decl.params.iter().enumerate();
    let params: Vec<Option<usize>> = params
        .map(|(i, param)| {
            let hot = key.tunable && !param.fixed && code.step_takes(i);
            if hot { fields.add(&param.name, &param.ty, 1, &block.sizes) } else { None }
        })
        .collect();
    let array = |fields: &mut Fields, field: &pcl2_lang::decl::Field| {
        if field.ty.is_scalar() { None } else { fields.add(&field.name, &field.ty, 1, &block.sizes) }
    };
    let memory = decl.memory.iter().map(|field| array(&mut fields, field)).collect();
    let tuned = decl.tuned.iter().map(|field| array(&mut fields, field)).collect();
    let outputs = (0..decl.outputs.len()).map(|i| output_field(&mut fields, code, block, key, i)).collect();
    let state = code.state.then(|| fields.namer().made("s"));
    let single = decl.inline && fields.list.len() == 1 && params_none(&params);
    let form = match (fields.list.len(), &state) {
        (0, None) => Form::Nothing,
        (0, Some(_)) => Form::Kernel,
        (1, None) if single => Form::Plain,
        _ => Form::Struct,
    };
    Shape {
        decl: key.decl,
        form,
        tag: String::new(),
        declared: false,
        fields: fields.list,
        state,
        params,
        memory,
        tuned,
        outputs,
        cold: None,
    }
}

fn params_none(params: &[Option<usize>]) -> bool {
    params.iter().all(Option::is_none)
}

fn output_field(fields: &mut Fields, code: &Code<'_>, block: &Block, key: &Key, output: usize) -> Option<usize> {
    let declared = &code.decl.outputs[output];
    let inside = kernel::in_instance(declared) && !code.decl.inline;
    if inside || key.elsewhere.contains(&(output as u32)) {
        return None;
    }
    let count = kernel::count(declared.group.as_ref(), &block.sizes).unwrap_or(0);
    match declared.group {
        Some(_) => fields.add_array(&declared.name, &declared.ty, count, &block.sizes),
        None => fields.add(&declared.name, &declared.ty, count, &block.sizes),
    }
}

/// The shape of a composite's instance.
pub(crate) fn of_body(unit: UnitId, decl: DeclId) -> Shape {
    Shape {
        decl,
        form: Form::Body(unit),
        tag: String::new(),
        declared: false,
        fields: Vec::new(),
        state: None,
        params: Vec::new(),
        memory: Vec::new(),
        tuned: Vec::new(),
        outputs: Vec::new(),
        cold: None,
    }
}

/// The parameters of a tunable block that only tune reads.
pub(crate) fn cold(code: &Code<'_>, block: &Block, hot: &[bool]) -> Option<Cold> {
    let mut fields = Fields::default();
    let params = code.decl.params.iter().enumerate();
    let params = params
        .map(
            |(i, param)| if param.fixed || hot[i] { None } else { fields.add(&param.name, &param.ty, 1, &block.sizes) },
        )
        .collect();
    (!fields.list.is_empty()).then(|| Cold { tag: String::new(), fields: fields.list, params })
}

#[derive(Default)]
struct Fields {
    list: Vec<Field>,
    namer: Namer<'static>,
}

impl Fields {
    fn add(&mut self, name: &str, ty: &pcl2_lang::decl::TypeExpr, times: usize, sizes: &[i32]) -> Option<usize> {
        if ty.is_scalar() && times == 1 {
            let name = self.namer.made(name);
            self.list.push(Field { name, element: kernel::c_element(ty), count: None });
            return Some(self.list.len() - 1);
        }
        self.add_array(name, ty, times, sizes)
    }

    fn add_array(&mut self, name: &str, ty: &pcl2_lang::decl::TypeExpr, times: usize, sizes: &[i32]) -> Option<usize> {
        let count = place_elements(ty, sizes) * times;
        if count == 0 {
            return None;
        }
        let name = self.namer.made(name);
        self.list.push(Field { name, element: kernel::c_element(ty), count: Some(count) });
        Some(self.list.len() - 1)
    }

    fn namer(&mut self) -> &mut Namer<'static> {
        &mut self.namer
    }
}

/// A field's declaration.
pub(crate) fn field(out: &mut String, indent: &str, field: &Field) {
    let _ = match field.count {
        None => writeln!(out, "{indent}{} {};", field.element, field.name),
        Some(count) => writeln!(out, "{indent}{} {}[{count}];", field.element, field.name),
    };
}

/// Size and alignment in bytes, where every type is aligned to its size.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Extent {
    /// Bytes, without the padding at the end.
    pub(crate) size: u64,
    /// The largest alignment inside.
    pub(crate) align: u64,
}

impl Extent {
    /// Appends something so many times.
    pub(crate) fn add(&mut self, other: Extent, times: u64) {
        if times == 0 {
            return;
        }
        let align = other.align.max(1);
        let each = other.size.next_multiple_of(align);
        self.size = self.size.next_multiple_of(align) + each * times;
        self.align = self.align.max(align);
    }

    /// The size with the padding at the end.
    pub(crate) fn padded(self) -> u64 {
        self.size.next_multiple_of(self.align.max(1))
    }
}

/// The extent of a C type.
pub(crate) fn element_extent(element: &str, width: Width) -> Extent {
    let size = match element {
        "pcl2_real" => width.bytes() as u64,
        "int64_t" => 8,
        _ => 4,
    };
    Extent { size, align: size }
}

/// The extent of some fields.
pub(crate) fn fields_extent(extent: &mut Extent, fields: &[Field], width: Width) {
    for field in fields {
        extent.add(element_extent(field.element, width), field.count.unwrap_or(1) as u64);
    }
}

/// The extent of a kernel's struct.
pub(crate) fn kernel_extent(code: &Code<'_>, width: Width) -> Extent {
    let mut extent = Extent::default();
    for member in kernel::members(code.decl) {
        extent.add(element_extent(kernel::member_type(code.decl, member), width), 1);
    }
    extent
}
