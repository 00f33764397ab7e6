//! What one call needs to know of its function code: looked up once per declaration, not once per block.

use pcl2_lang::decl::{Decl, PortDecl, TypeExpr};
use pcl2_lang::kernel::{self, Arg, Entry};
use pcl2_lang::program::Block;
use pcl2_lang::types::Type;

/// A declaration with its C contract at hand.
#[derive(Debug)]
pub(crate) struct Code<'a> {
    /// The declaration.
    pub(crate) decl: &'a Decl,
    /// Its input ports.
    pub(crate) ports: Vec<&'a PortDecl>,
    /// It keeps a `struct pcl2_X`.
    pub(crate) state: bool,
    /// Its step returns the output.
    pub(crate) returns: bool,
    functions: [Function; 4],
}

#[derive(Debug, Default)]
struct Function {
    exists: bool,
    name: String,
    args: Vec<Arg>,
}

impl<'a> Code<'a> {
    /// Looks a declaration up.
    pub(crate) fn new(decl: &'a Decl) -> Code<'a> {
        let function = |entry| Function {
            exists: decl.has_kernel() && kernel::has(decl, entry),
            name: kernel::function_name(decl, entry),
            args: kernel::args(decl, entry),
        };
        Code {
            decl,
            ports: decl.ports().collect(),
            state: !kernel::members(decl).is_empty() && !decl.is_composite(),
            returns: kernel::returns_value(decl),
            functions: [Entry::Step, Entry::Init, Entry::Tune, Entry::Check].map(function),
        }
    }

    /// Whether the kernel has this function.
    pub(crate) fn has(&self, entry: Entry) -> bool {
        self.function(entry).exists
    }

    /// The function's C name.
    pub(crate) fn name(&self, entry: Entry) -> &str {
        &self.function(entry).name
    }

    /// The function's arguments.
    pub(crate) fn args(&self, entry: Entry) -> &[Arg] {
        &self.function(entry).args
    }

    fn function(&self, entry: Entry) -> &Function {
        match entry {
            Entry::Step => &self.functions[0],
            Entry::Init => &self.functions[1],
            Entry::Tune => &self.functions[2],
            Entry::Check => &self.functions[3],
        }
    }

    /// Whether the step is handed this parameter.
    pub(crate) fn step_takes(&self, param: usize) -> bool {
        self.function(Entry::Step).args.contains(&Arg::Param(param))
    }

    /// The expanded places of a port: the first, and how many.
    pub(crate) fn port_range(&self, port: usize, sizes: &[i32]) -> (usize, usize) {
        let count = |port: &PortDecl| kernel::count(port.group.as_ref(), sizes).unwrap_or(0);
        let first = self.ports[..port].iter().map(|port| count(port)).sum();
        (first, count(self.ports[port]))
    }

    /// The declared output of an expanded one, and its place in the group.
    pub(crate) fn output(&self, expanded: usize, sizes: &[i32]) -> (usize, usize) {
        let mut first = 0;
        for (i, output) in self.decl.outputs.iter().enumerate() {
            let count = kernel::count(output.group.as_ref(), sizes).unwrap_or(0);
            if expanded < first + count {
                return (i, expanded - first);
            }
            first += count;
        }
        (0, 0)
    }

    /// The first expanded place of a declared output, and how many it has.
    pub(crate) fn output_range(&self, output: usize, sizes: &[i32]) -> (usize, usize) {
        let count = |i: usize| kernel::count(self.decl.outputs[i].group.as_ref(), sizes).unwrap_or(0);
        ((0..output).map(count).sum(), count(output))
    }
}

/// The type of a place with a block's sizes; text and times have none.
pub(crate) fn place_type(ty: &TypeExpr, block: &Block) -> Option<Type> {
    kernel::resolve(ty, &block.sizes)
}

/// The elements of a place with a block's sizes; a text has none.
pub(crate) fn place_elements(ty: &TypeExpr, sizes: &[i32]) -> usize {
    match ty {
        TypeExpr::Time => 1,
        TypeExpr::Text => 0,
        TypeExpr::Scalar(_) | TypeExpr::Vector(..) | TypeExpr::Matrix(..) => {
            kernel::resolve(ty, sizes).map_or(0, Type::elements)
        }
    }
}
