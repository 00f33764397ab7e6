//! The `.cfg` front end: a tree of statements becomes a [`Program`].
//!
//! The passes run in this order; after each one the sentence beside it is true.
//! 1. `sections`: every statement stands in a section.
//! 2. `bind`: every statement has a declaration, its constants, and an operand for each port.
//! 3. `number`: every block has its number, and blocks stand in order of execution.
//! 4. `signals`: every output has a signal, every port a source.
//! 5. `sizes`: every size and type is known, and wires fit their ports.
//! 6. `params`: every parameter has its value, in its range.
//! 7. `order`: delays are known.
//! 8. `returns`: return wires that are missing have been named.
//! 9. `onbad`: truth values that do not say what they are for a bad signal have been named.
//!
//! What is wrong is reported once and marked as spoiled; nothing that depends on it is checked.

mod alone;
mod bind;
mod composite;
mod draft;
mod files;
mod formula;
mod inner;
mod number;
mod onbad;
mod order;
mod params;
mod period;
pub mod places;
mod renumber;
mod returns;
mod seal;
mod sections;
mod signals;
mod sizes;

pub use alone::tree as net_tree;
pub use files::{FileText, wanted_files};
pub use inner::check_ranges as check_inner_ranges;
pub use period::check_period;
pub use renumber::{Edit, edited, renumber};

use composite::Composites;
use draft::Scope;
use pcl2_lang::catalogue::Catalogue;
use pcl2_lang::decl::Decl;
use pcl2_lang::diagnostic::{self, Diagnostic};
use pcl2_lang::program::Program;
use pcl2_lang::source::{FileId, Sources, Span};
use pcl2_lang::symbol::Symbols;
use pcl2_lang::syntax::Tree;
use pcl2_lang::types::Width;
use pcl2_lang::verify;
use rustc_hash::FxHashMap;

/// What the command line and the project file decide about a program.
#[derive(Clone, Debug)]
pub struct Options {
    /// The C name.
    pub name: String,
    /// The scan period in nanoseconds, if known.
    pub period: Option<i64>,
    /// The width of reals.
    pub width: Width,
    /// Numbers of blocks that stand for the plant (`--plant`).
    pub plant: Vec<u32>,
    /// PLANT's runs in each scan.
    pub substeps: u32,
    /// Which blocks keep their parameters in RAM.
    pub tunable: Tunable,
}

/// Which blocks keep their parameters in RAM.
#[derive(Clone, Debug, Default)]
pub enum Tunable {
    /// Every block.
    #[default]
    All,
    /// No block.
    None,
    /// Blocks whose identity matches one of these patterns; `*` stands for any run of characters.
    Names(Vec<String>),
}

impl Tunable {
    /// The first pattern that matches no block of a program: a slip, most likely.
    pub fn unmatched(&self, program: &Program) -> Option<&str> {
        let Tunable::Names(patterns) = self else {
            return None;
        };
        let idle = |pattern: &&String| !program.main().blocks.iter().any(|block| seal::matches(pattern, &block.name));
        patterns.iter().find(idle).map(String::as_str)
    }
}

/// What a compilation reads.
pub struct Input<'a> {
    /// All texts.
    pub sources: &'a Sources,
    /// The source's file.
    pub file: FileId,
    /// Its statements.
    pub tree: &'a Tree,
    /// All names.
    pub symbols: &'a Symbols,
    /// The known function codes.
    pub catalogue: &'a Catalogue,
    /// The parameter files that [`wanted_files`] asked for, by their name in the source.
    pub files: &'a FxHashMap<String, FileText>,
    /// What was decided elsewhere.
    pub options: &'a Options,
    /// The program is this net: its inputs come from outside, its outputs go there.
    pub alone: Option<&'a Decl>,
}

/// Compiles a tree. `None` when there are errors.
pub fn compile(input: &Input<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<Program> {
    if diagnostic::enough(diagnostics) {
        return None;
    }
    let mut sectioned = sections::read(input, diagnostics);
    let mut scope = Scope::program(input, std::mem::take(&mut sectioned.statements));
    let mut composites = Composites::default();
    complete(input, &mut scope, &mut composites, diagnostics);
    sections::check_contents(&sectioned, &scope, diagnostics);
    sections::check_border(&sectioned, &scope, diagnostics);
    if diagnostics.iter().any(Diagnostic::is_error) {
        return None;
    }
    let delays = order::delays(&sectioned, &scope, diagnostics);
    returns::missing(&scope, diagnostics);
    onbad::unsaid(&sectioned, &scope, input.symbols, diagnostics);
    let mut program = seal::seal(input, &sectioned, scope, composites, delays);
    if let Some(net) = input.alone {
        alone::name(&mut program, net);
    }
    // Pass 5 has judged the program's own blocks; composites add theirs.
    if program.units.len() > 1 && verify::bytes(&program).is_none_or(|bytes| bytes > verify::MAX_PROGRAM) {
        let whole = Span { file: input.file, start: 0, end: 0 };
        diagnostics.push(sizes::too_large(program.main().blocks.first().map_or(whole, |block| block.span)));
        return None;
    }
    inner::check_ranges(&program, diagnostics);
    Some(program)
}

/// Runs the passes 2 to 6 over a scope.
pub(crate) fn complete<'a>(
    input: &Input<'a>,
    scope: &mut Scope<'a>,
    composites: &mut Composites<'a>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    bind::bind(input, scope, diagnostics);
    number::number(scope, diagnostics);
    signals::connect(input, scope, diagnostics);
    sizes::solve(input, scope, diagnostics);
    params::read(input, scope, diagnostics);
    composite::expand(input, scope, composites, diagnostics);
}
