//! What every phase reads: the program, its codes and its layout.

use crate::NetForm;
use crate::calls::{self, Telling};
use crate::code::Code;
use crate::layout::{Layout, UnitLayout};
use crate::net::layout::NetLayout;
use crate::shape::Shape;
use pcl2_lang::program::{BlockId, DeclId, Program, UnitId};
use pcl2_lang::source::Sources;

/// Everything known of the program before C is written.
#[derive(Debug)]
pub(crate) struct Context<'a> {
    /// The program.
    pub(crate) program: &'a Program,
    /// The text of its statements.
    pub(crate) sources: &'a Sources,
    /// Its C name.
    pub(crate) name: String,
    /// By declaration.
    pub(crate) codes: Vec<Code<'a>>,
    /// Where everything lives.
    pub(crate) layout: Layout<'a>,
    /// The program's blocks whose struct has a status.
    pub(crate) statuses: Vec<u32>,
}

impl<'a> Context<'a> {
    /// Looks everything up.
    pub(crate) fn new(program: &'a Program, sources: &'a Sources, form: NetForm) -> Context<'a> {
        let name = crate::names::settled_program_name(&program.name);
        let codes: Vec<Code<'a>> = program.decls.iter().map(Code::new).collect();
        let layout = crate::layout::layout(program, &name, &codes, form);
        let mut context = Context { program, sources, name, codes, layout, statuses: Vec::new() };
        let blocks = (0..program.main().blocks.len() as u32).map(BlockId);
        let status = |block: &BlockId| calls::telling(&context, UnitId(0), *block) == Telling::Status;
        context.statuses = blocks.filter(status).map(|block| block.0).collect();
        context
    }

    /// Whether the program uses nets.
    pub(crate) fn has_nets(&self) -> bool {
        self.nets().next().is_some()
    }

    /// The header that its nets need.
    pub(crate) fn net_header(&self) -> Option<&'static str> {
        let header = match self.layout.net_form {
            NetForm::Fast => "pcl2_net_step.h",
            NetForm::Table => "pcl2_net.h",
        };
        self.has_nets().then_some(header)
    }

    /// What the nets of the program keep.
    pub(crate) fn nets(&self) -> impl Iterator<Item = &NetLayout> {
        self.layout.units.iter().filter_map(|unit| unit.net.as_ref())
    }

    /// A function code.
    pub(crate) fn code(&self, decl: DeclId) -> &Code<'a> {
        &self.codes[decl.0 as usize]
    }

    /// The layout of a body.
    pub(crate) fn unit_layout(&self, unit: UnitId) -> &UnitLayout<'a> {
        &self.layout.units[unit.0 as usize]
    }

    /// The shape of a block's instance.
    pub(crate) fn shape_of(&self, unit: UnitId, block: BlockId) -> &Shape {
        &self.layout.shapes[self.unit_layout(unit).members[block.0 as usize].shape as usize]
    }
}
