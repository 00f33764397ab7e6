//! The C contract of a function code, derived from its declaration: instance struct, functions, arguments.
//!
//! Header, emitted call and simulator call all come from here, so that a kernel which drifts from its
//! declaration fails to compile.

use crate::decl::{Decl, Direction, Expr, Field, Item, OutputDecl, TypeExpr};
use crate::types::{MAX_ELEMENTS, Scalar, Shape, Type};
use std::fmt::Write;

/// The C functions that a kernel can have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Entry {
    /// `pcl2_X`: one scan.
    Step,
    /// `pcl2_X_init`: declared initial outputs and memory.
    Init,
    /// `pcl2_X_tune`: derives coefficients from parameters.
    Tune,
    /// `pcl2_X_check`: judges parameters; 0 or the number of a fault.
    Check,
}

impl Entry {
    /// All entries, in the order in which headers list them.
    pub const ALL: [Entry; 4] = [Entry::Check, Entry::Tune, Entry::Init, Entry::Step];
}

/// One argument of a kernel function; indexes are into the declaration's vectors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arg {
    /// `struct pcl2_X *self`
    Instance,
    /// A size variable ([`Decl::sizes`]), by value.
    Size(usize),
    /// An input port (n-th port): scalar by value, vectors, matrices and groups by pointer.
    Port(usize),
    /// A parameter: scalar by value, vectors and matrices by pointer.
    Param(usize),
    /// An array of [`Decl::memory`].
    Memory(usize),
    /// An array of [`Decl::tuned`].
    Tuned(usize),
    /// An array of [`Decl::work`].
    Work(usize),
    /// The image word: by value from the plant, by pointer to the plant.
    Image,
    /// The fail-safe value of a real word to the plant; a bad one stands for "hold".
    Fail,
    /// An array output; of an INLINE code with several outputs also a scalar one.
    Output(usize),
    /// `int64_t T`, nanoseconds.
    Period,
    /// `pcl2_real *left`: two reals for the fault's text.
    Left,
}

/// One member of `struct pcl2_X`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Member {
    /// A scalar of [`Decl::tuned`].
    Tuned(usize),
    /// A scalar of [`Decl::memory`].
    Memory(usize),
    /// `int32_t status`
    Status,
    /// A scalar output.
    Output(usize),
}

/// The members of the instance struct in order; empty when the kernel has none.
pub fn members(decl: &Decl) -> Vec<Member> {
    if decl.inline {
        return Vec::new();
    }
    let mut members = Vec::new();
    members.extend(scalars(&decl.tuned).map(Member::Tuned));
    members.extend(scalars(&decl.memory).map(Member::Memory));
    if !decl.faults.is_empty() {
        members.push(Member::Status);
    }
    let outputs = decl.outputs.iter().enumerate();
    members.extend(outputs.filter(|(_, output)| in_instance(output)).map(|(i, _)| Member::Output(i)));
    members
}

/// Whether the output is a member of the instance struct of an ordinary kernel.
pub fn in_instance(output: &OutputDecl) -> bool {
    output.ty.is_scalar() && output.group.is_none() && !output.inout
}

/// Whether the step returns its one scalar output by value.
pub fn returns_value(decl: &Decl) -> bool {
    decl.inline && decl.outputs.len() == 1 && in_instance(&decl.outputs[0])
}

/// Whether the executive sees the code's one fault: its result is bad although no input is. The kernel keeps no status.
pub fn faults_by_result(decl: &Decl) -> bool {
    decl.inline && !decl.faults.is_empty()
}

/// Whether the kernel has this function.
pub fn has(decl: &Decl, entry: Entry) -> bool {
    match entry {
        Entry::Step => true,
        Entry::Init => !decl.start.is_empty() || !decl.memory.is_empty(),
        Entry::Tune => !decl.tuned.is_empty(),
        Entry::Check => decl.check,
    }
}

/// The arguments of one of the kernel's functions, in order.
pub fn args(decl: &Decl, entry: Entry) -> Vec<Arg> {
    match entry {
        Entry::Step => step_args(decl),
        Entry::Init => init_args(decl),
        Entry::Tune => tune_args(decl),
        Entry::Check => check_args(decl),
    }
}

fn step_args(decl: &Decl) -> Vec<Arg> {
    let mut args = instance(decl);
    let mut port = 0;
    for item in &decl.items {
        match item {
            Item::Literal(_) => {}
            Item::Constant(constant) => args.push(Arg::Size(constant.size)),
            Item::Port(_) => {
                args.push(Arg::Port(port));
                port += 1;
            }
        }
    }
    args.extend(inferred_sizes(decl));
    if decl.tuned.is_empty() {
        args.extend(params(decl, false));
    }
    args.extend(arrays(&decl.memory).map(Arg::Memory));
    args.extend(arrays(&decl.tuned).map(Arg::Tuned));
    args.extend((0..decl.work.len()).map(Arg::Work));
    if let Some(image) = decl.image {
        args.push(Arg::Image);
        args.extend((image.direction == Direction::Out && image.scalar == Scalar::Real).then_some(Arg::Fail));
    }
    args.extend(output_args(decl));
    args
}

fn init_args(decl: &Decl) -> Vec<Arg> {
    let mut args = instance(decl);
    args.extend(all_sizes(decl));
    args.extend(params(decl, true));
    args.extend(arrays(&decl.memory).map(Arg::Memory));
    args.extend(arrays(&decl.tuned).map(Arg::Tuned));
    args.extend(output_args(decl));
    args
}

fn tune_args(decl: &Decl) -> Vec<Arg> {
    let mut args = instance(decl);
    args.extend(all_sizes(decl));
    args.extend(params(decl, false));
    if decl.period {
        args.push(Arg::Period);
    }
    args.extend(arrays(&decl.tuned).map(Arg::Tuned));
    args
}

fn check_args(decl: &Decl) -> Vec<Arg> {
    let mut args: Vec<Arg> = all_sizes(decl).collect();
    args.extend(params(decl, true));
    if decl.period {
        args.push(Arg::Period);
    }
    args.push(Arg::Left);
    args
}

fn instance(decl: &Decl) -> Vec<Arg> {
    if members(decl).is_empty() { Vec::new() } else { vec![Arg::Instance] }
}

fn all_sizes(decl: &Decl) -> impl Iterator<Item = Arg> + use<> {
    (0..decl.sizes.len()).map(Arg::Size)
}

fn inferred_sizes(decl: &Decl) -> impl Iterator<Item = Arg> {
    let sizes = decl.sizes.iter().enumerate();
    sizes.filter(|(_, size)| size.constant.is_none()).map(|(i, _)| Arg::Size(i))
}

/// Address parameters of image words are never passed.
fn params(decl: &Decl, fixed_too: bool) -> impl Iterator<Item = Arg> {
    let passed = move |fixed: bool| !fixed || (fixed_too && decl.image.is_none());
    let params = decl.params.iter().enumerate();
    params.filter(move |(_, param)| passed(param.fixed)).map(|(i, _)| Arg::Param(i))
}

fn scalars(fields: &[Field]) -> impl Iterator<Item = usize> {
    fields.iter().enumerate().filter(|(_, field)| field.ty.is_scalar()).map(|(i, _)| i)
}

fn arrays(fields: &[Field]) -> impl Iterator<Item = usize> {
    fields.iter().enumerate().filter(|(_, field)| !field.ty.is_scalar()).map(|(i, _)| i)
}

fn output_args(decl: &Decl) -> Vec<Arg> {
    let by_pointer = |output: &OutputDecl| decl.inline || !in_instance(output);
    if returns_value(decl) {
        return Vec::new();
    }
    let outputs = decl.outputs.iter().enumerate();
    outputs.filter(|(_, output)| by_pointer(output)).map(|(i, _)| Arg::Output(i)).collect()
}

/// The C name of a kernel's function.
pub fn function_name(decl: &Decl, entry: Entry) -> String {
    let suffix = match entry {
        Entry::Step => "",
        Entry::Init => "_init",
        Entry::Tune => "_tune",
        Entry::Check => "_check",
    };
    format!("pcl2_{}{suffix}", decl.name)
}

/// The C type of one element.
pub fn c_scalar(scalar: Scalar) -> &'static str {
    match scalar {
        Scalar::Int => "int32_t",
        Scalar::Real => "pcl2_real",
    }
}

/// The C type of one element of a declared place.
pub fn c_element(ty: &TypeExpr) -> &'static str {
    match ty {
        TypeExpr::Scalar(scalar) | TypeExpr::Vector(scalar, _) | TypeExpr::Matrix(scalar, ..) => c_scalar(*scalar),
        TypeExpr::Time => "int64_t",
        TypeExpr::Text => "char",
    }
}

/// The prototype of one of the kernel's functions, without the semicolon.
pub fn prototype(decl: &Decl, entry: Entry) -> String {
    let linkage = if decl.inline { "static inline" } else { "PCL2_KERNEL" };
    let result = match entry {
        Entry::Check => "int32_t",
        Entry::Step if returns_value(decl) => c_element(&decl.outputs[0].ty),
        Entry::Step | Entry::Init | Entry::Tune => "void",
    };
    let args: Vec<String> = args(decl, entry).iter().map(|arg| argument(decl, entry, *arg)).collect();
    let args = if args.is_empty() { "void".to_owned() } else { args.join(", ") };
    format!("{linkage} {result} {}({args})", function_name(decl, entry))
}

fn argument(decl: &Decl, entry: Entry, arg: Arg) -> String {
    let field = |field: &Field, constant: bool| pointer(c_element(&field.ty), &field.name, constant);
    match arg {
        Arg::Instance => format!("struct pcl2_{} *self", decl.name),
        Arg::Size(i) => format!("int32_t {}", decl.sizes[i].name),
        Arg::Port(i) => {
            decl.ports().nth(i).map_or_else(String::new, |port| value(&port.ty, &port.name, port.group.is_some()))
        }
        Arg::Param(i) => value(&decl.params[i].ty, &decl.params[i].name, false),
        Arg::Memory(i) => field(&decl.memory[i], false),
        Arg::Tuned(i) => field(&decl.tuned[i], entry == Entry::Step),
        Arg::Work(i) => field(&decl.work[i], false),
        Arg::Image => image_argument(decl),
        Arg::Fail => "pcl2_real fail".to_owned(),
        Arg::Output(i) => pointer(c_element(&decl.outputs[i].ty), &decl.outputs[i].name, false),
        Arg::Period => "int64_t T".to_owned(),
        Arg::Left => "pcl2_real *left".to_owned(),
    }
}

fn image_argument(decl: &Decl) -> String {
    match decl.image {
        Some(image) if image.direction == Direction::Out => format!("{} *word", c_scalar(image.scalar)),
        Some(image) => format!("{} word", c_scalar(image.scalar)),
        None => String::new(),
    }
}

fn value(ty: &TypeExpr, name: &str, group: bool) -> String {
    if ty.is_scalar() && !group { format!("{} {name}", c_element(ty)) } else { pointer(c_element(ty), name, true) }
}

fn pointer(element: &str, name: &str, constant: bool) -> String {
    format!("{}{element} *{name}", if constant { "const " } else { "" })
}

/// The C name of a member of the instance struct.
pub fn member_name(decl: &Decl, member: Member) -> &str {
    match member {
        Member::Tuned(i) => &decl.tuned[i].name,
        Member::Memory(i) => &decl.memory[i].name,
        Member::Status => "status",
        Member::Output(i) => &decl.outputs[i].name,
    }
}

/// The C type of a member of the instance struct.
pub fn member_type(decl: &Decl, member: Member) -> &'static str {
    match member {
        Member::Tuned(i) => c_element(&decl.tuned[i].ty),
        Member::Memory(i) => c_element(&decl.memory[i].ty),
        Member::Status => "int32_t",
        Member::Output(i) => c_element(&decl.outputs[i].ty),
    }
}

/// The generated header `pcl2_<stem>.h` of one declaration file: instance structs and prototypes.
pub fn header(stem: &str, decls: &[&Decl]) -> String {
    let guard = format!("PCL2_{}_H", stem.to_uppercase());
    let mut text =
        format!("/* Instance types and prototypes of blocks/{stem}.fc. */\n#ifndef {guard}\n#define {guard}\n\n");
    text.push_str("#include \"pcl2.h\"\n");
    for decl in decls.iter().filter(|decl| decl.has_kernel()) {
        block_interface(&mut text, decl);
    }
    if decls.iter().any(|decl| decl.inline) {
        let _ = write!(text, "\n#include \"{stem}_inline.h\"\n");
    }
    let _ = write!(text, "\n#endif\n");
    text
}

fn block_interface(text: &mut String, decl: &Decl) {
    let members = members(decl);
    if !members.is_empty() {
        let _ = write!(text, "\n/* {}: what one instance keeps. */\nstruct pcl2_{} {{\n", decl.name, decl.name);
        for member in members {
            let note = member_note(decl, member);
            let _ = writeln!(text, "    {} {}; /* {note} */", member_type(decl, member), member_name(decl, member));
        }
        text.push_str("};\n");
    }
    text.push('\n');
    for entry in Entry::ALL.into_iter().filter(|entry| has(decl, *entry)) {
        let _ = writeln!(text, "{};", prototype(decl, entry));
    }
}

fn member_note(decl: &Decl, member: Member) -> String {
    match member {
        Member::Tuned(_) => "derived by tune".to_owned(),
        Member::Memory(_) => "kept from scan to scan".to_owned(),
        Member::Status => "0, or the number of the fault of the last scan".to_owned(),
        Member::Output(i) => match &decl.outputs[i].tail.unit {
            Some(unit) => format!("output, {unit}"),
            None => "output".to_owned(),
        },
    }
}

/// The value of a size expression; `None` on overflow, a division by zero, or what is no size.
pub fn size(expr: &Expr, sizes: &[i32]) -> Option<i64> {
    let both = |a: &Expr, b: &Expr| Some((size(a, sizes)?, size(b, sizes)?));
    match expr {
        Expr::Int(value) => Some(i64::from(*value)),
        Expr::Size(index) => sizes.get(*index).map(|value| i64::from(*value)),
        Expr::Real(_) | Expr::Param(_) => None,
        Expr::Negate(a) => size(a, sizes)?.checked_neg(),
        Expr::Add(a, b) => both(a, b).and_then(|(a, b)| a.checked_add(b)),
        Expr::Subtract(a, b) => both(a, b).and_then(|(a, b)| a.checked_sub(b)),
        Expr::Multiply(a, b) => both(a, b).and_then(|(a, b)| a.checked_mul(b)),
        Expr::Divide(a, b) => both(a, b).and_then(|(a, b)| a.checked_div(b)),
    }
}

/// A declared type with its sizes filled in. `None` when a size is negative, or the whole is too large,
/// or the place is no signal (text, time).
pub fn resolve(ty: &TypeExpr, sizes: &[i32]) -> Option<Type> {
    let length = |expr: &Expr| size(expr, sizes).and_then(|n| u32::try_from(n).ok());
    let (scalar, shape) = match ty {
        TypeExpr::Scalar(scalar) => (*scalar, Shape::Scalar),
        TypeExpr::Vector(scalar, n) => (*scalar, Shape::Vector(length(n)?)),
        TypeExpr::Matrix(scalar, r, c) => (*scalar, Shape::Matrix(length(r)?, length(c)?)),
        TypeExpr::Text | TypeExpr::Time => return None,
    };
    let (rows, columns) = Type { scalar, shape }.rows_columns();
    let elements = u64::from(rows).checked_mul(u64::from(columns))?;
    (elements <= MAX_ELEMENTS).then_some(Type { scalar, shape })
}

/// The most ports in one group.
pub const MAX_PORTS: usize = 4096;

/// How many ports or outputs a place stands for: 1, or the size of its group. `None` when the group is too large.
pub fn count(group: Option<&crate::decl::Group>, sizes: &[i32]) -> Option<usize> {
    match group {
        None => Some(1),
        Some(group) => size(&group.count, sizes).and_then(|n| usize::try_from(n).ok()).filter(|n| *n <= MAX_PORTS),
    }
}

/// The number of elements of a field (memory, work or tuned) with these sizes.
pub fn field_elements(field: &Field, sizes: &[i32]) -> Option<usize> {
    match field.ty {
        TypeExpr::Time => Some(1),
        _ => resolve(&field.ty, sizes).map(Type::elements),
    }
}
