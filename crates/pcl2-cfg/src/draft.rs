//! What is known of each block while the passes run.

use crate::composite::Composites;
use crate::sections::Sectioned;
use crate::{Input, Tunable, bind, number, params, signals, sizes};
use pcl2_lang::ast::{Item, Statement};
use pcl2_lang::decl::Decl;
use pcl2_lang::diagnostic::Diagnostic;
use pcl2_lang::program::{
    Block, BlockId, Cell, DeclId, Delay, ImageWord, Param, Program, Role, Section, SectionKind, Signal, SignalId, Source, Tracked,
    Unit, UnitId, Writer,
};
use pcl2_lang::source::Span;
use pcl2_lang::symbol::Symbol;
use pcl2_lang::types::Type;
use rustc_hash::{FxHashMap, FxHashSet};

/// One block in the making.
pub(crate) struct Draft<'a> {
    pub(crate) statement: &'a Statement,
    pub(crate) section: u32,
    /// `None` when the function code is not known.
    pub(crate) decl: Option<&'a Decl>,
    pub(crate) number: u32,
    /// Something is wrong with it; what depends on it is not checked.
    pub(crate) spoiled: bool,
    /// Its constants and sizes are sound: its parameters can be read, whatever is wired to its ports.
    pub(crate) sized: bool,
    /// The values of the declaration's sizes; `None` until ports tell.
    pub(crate) sizes: Vec<Option<i32>>,
    /// The operand of each port (groups expanded); `None`: the default.
    pub(crate) operands: Vec<Option<&'a Item>>,
    pub(crate) sources: Vec<Source>,
    pub(crate) params: Vec<Param>,
    /// The signal of each output (groups expanded).
    pub(crate) outputs: Vec<SignalId>,
    pub(crate) image: Option<Box<ImageWord>>,
    pub(crate) unit: Option<usize>,
}

/// A signal in the making.
pub(crate) struct Wire {
    pub(crate) name: String,
    pub(crate) ty: Option<Type>,
    pub(crate) spoiled: bool,
    pub(crate) writers: Vec<Writer>,
    pub(crate) role: Role,
    pub(crate) span: Span,
}

/// The body that the passes work on: the program, or a composite with its sizes.
pub(crate) struct Scope<'a> {
    /// The blocks, after numbering in order of execution.
    pub(crate) drafts: Vec<Draft<'a>>,
    pub(crate) wires: Vec<Wire>,
    /// Variables and tags.
    pub(crate) by_name: NameTable,
    /// The signal of a tag's output, by the output's name.
    pub(crate) members: FxHashMap<(Symbol, String), SignalId>,
    /// Blocks and ports by number.
    pub(crate) by_number: NumberTable,
    pub(crate) cells: Vec<Cell>,
    /// Names of which nothing is known, and nothing more is said.
    pub(crate) spoiled: FxHashSet<Symbol>,
    pub(crate) spoiled_numbers: FxHashSet<u32>,
    /// For a composite: its declaration and sizes.
    pub(crate) owner: Option<(&'a Decl, Vec<i32>)>,
    /// For a composite: the signals of its outputs.
    pub(crate) outputs: Vec<SignalId>,
}

/// The signal of each name. Symbols are small numbers given in order of the text: a plain table beats a hash map.
#[derive(Default)]
pub(crate) struct NameTable(Vec<Option<SignalId>>);

impl NameTable {
    pub(crate) fn get(&self, name: Symbol) -> Option<SignalId> {
        self.0.get(name.0 as usize).copied().flatten()
    }

    pub(crate) fn insert(&mut self, name: Symbol, id: SignalId) {
        let index = name.0 as usize;
        if self.0.len() <= index {
            self.0.resize(index + 1, None);
        }
        self.0[index] = Some(id);
    }
}

/// The output behind each number: filled, then sorted, then asked.
#[derive(Default)]
pub(crate) struct NumberTable(Vec<(u32, BlockId, u32)>);

impl NumberTable {
    pub(crate) fn push(&mut self, number: u32, block: BlockId, output: u32) {
        self.0.push((number, block, output));
    }

    pub(crate) fn sort(&mut self) {
        self.0.sort_by_key(|entry| entry.0);
    }

    pub(crate) fn get(&self, number: u32) -> Option<(BlockId, u32)> {
        let first = self.0.partition_point(|entry| entry.0 < number);
        self.0.get(first).filter(|entry| entry.0 == number).map(|(_, block, output)| (*block, *output))
    }
}

impl<'a> Scope<'a> {
    /// The program's own scope.
    pub(crate) fn program(input: &Input<'a>, statements: Vec<(&'a Statement, u32)>) -> Scope<'a> {
        let mut scope = Scope::new(statements, None);
        scope.spoiled.extend(input.tree.spoiled.iter().copied());
        scope.spoiled_numbers.extend(input.tree.spoiled_numbers.iter().copied());
        scope
    }

    /// A scope over statements.
    pub(crate) fn new(statements: Vec<(&'a Statement, u32)>, owner: Option<(&'a Decl, Vec<i32>)>) -> Scope<'a> {
        let draft = |(statement, section)| Draft {
            statement,
            section,
            decl: None,
            number: 0,
            spoiled: false,
            sized: false,
            sizes: Vec::new(),
            operands: Vec::new(),
            sources: Vec::new(),
            params: Vec::new(),
            outputs: Vec::new(),
            image: None,
            unit: None,
        };
        Scope {
            drafts: statements.into_iter().map(draft).collect(),
            wires: Vec::new(),
            by_name: NameTable::default(),
            members: FxHashMap::default(),
            by_number: NumberTable::default(),
            cells: Vec::new(),
            spoiled: FxHashSet::default(),
            spoiled_numbers: FxHashSet::default(),
            owner,
            outputs: Vec::new(),
        }
    }

    /// A signal in the making.
    pub(crate) fn wire(&self, id: SignalId) -> &Wire {
        &self.wires[id.0 as usize]
    }
}

impl Draft<'_> {
    /// All sizes, once they are known.
    pub(crate) fn known_sizes(&self) -> Option<Vec<i32>> {
        self.sizes.iter().copied().collect()
    }

    /// `block 6`
    pub(crate) fn title(&self) -> String {
        format!("block {}", self.number)
    }
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
    crate::composite::expand(input, scope, composites, diagnostics);
}

/// Turns finished drafts into a program.
pub(crate) fn seal<'a>(
    input: &Input<'a>,
    sectioned: &Sectioned<'a>,
    scope: Scope<'a>,
    composites: Composites<'a>,
    delays: Vec<Delay>,
) -> Program {
    let mut decls = DeclTable::default();
    let mut images = ImageTable::default();
    let mut sections = Vec::new();
    let mut first = 0;
    for (s, (kind, span)) in sectioned.sections.iter().enumerate() {
        let end = scope.drafts.partition_point(|draft| draft.section as usize <= s) as u32;
        sections.push(Section { kind: *kind, first, end, span: *span });
        first = end;
    }
    let order = composites.order();
    let initialize = sectioned.sections.iter().position(|(kind, _)| *kind == SectionKind::Initialize);
    let choice = Choice { tunable: &input.options.tunable, initialize };
    let mut units = vec![seal_unit(&choice, scope, &order, &mut decls, &mut images)];
    for body in composites.into_bodies() {
        units.push(seal_unit(&choice, body, &order, &mut decls, &mut images));
    }
    let options = input.options;
    Program {
        name: options.name.clone(),
        period: options.period,
        width: options.width,
        decls: decls.decls,
        units,
        sections,
        images: images.words,
        substeps: options.substeps,
        delays,
        bindings: Vec::new(),
    }
}

#[derive(Default)]
struct DeclTable {
    by_name: FxHashMap<String, DeclId>,
    decls: Vec<Decl>,
}

impl DeclTable {
    fn id(&mut self, decl: &Decl) -> DeclId {
        if let Some(id) = self.by_name.get(&decl.name) {
            return *id;
        }
        let id = DeclId(self.decls.len() as u32);
        self.by_name.insert(decl.name.clone(), id);
        self.decls.push(decl.clone());
        id
    }
}

#[derive(Default)]
struct ImageTable {
    by_name: FxHashMap<String, u32>,
    words: Vec<ImageWord>,
}

impl ImageTable {
    fn id(&mut self, word: ImageWord) -> pcl2_lang::program::ImageId {
        let next = self.words.len() as u32;
        let id = *self.by_name.entry(word.name.clone()).or_insert(next);
        if id == next {
            self.words.push(word);
        }
        pcl2_lang::program::ImageId(id)
    }
}

/// `order[i]` is the unit of the i-th composite body.
fn seal_unit(
    choice: &Choice<'_>,
    scope: Scope<'_>,
    order: &[UnitId],
    decls: &mut DeclTable,
    images: &mut ImageTable,
) -> Unit {
    let equals = equals(&scope);
    let cells = scope.cells;
    let wires = &scope.wires;
    let blocks = scope.drafts.into_iter().enumerate().filter_map(|(index, draft)| {
        let decl = draft.decl?;
        let name = identity(&draft, wires, equals.get(&index));
        let in_program = scope.owner.is_none();
        Some(Block {
            number: draft.number,
            tunable: in_program && choice.is_tunable(&name, draft.section),
            name,
            decl: decls.id(decl),
            unit: draft.unit.map(|index| order[index]),
            sizes: draft.known_sizes().unwrap_or_default(),
            ports: draft.sources,
            params: draft.params,
            outputs: draft.outputs,
            image: draft.image.map(|word| images.id(*word)),
            span: draft.statement.span,
        })
    });
    let blocks = blocks.collect();
    let signals = scope.wires.into_iter().map(|wire| Signal {
        name: wire.name,
        ty: wire.ty.unwrap_or(Type::REAL),
        writers: wire.writers,
        role: wire.role,
        span: wire.span,
    });
    Unit {
        composite: scope.owner.map(|(decl, sizes)| (decls.id(decl), sizes)),
        signals: signals.collect(),
        blocks,
        cells,
        outputs: scope.outputs,
    }
}

/// The identity of a block: its first output's name or its number, and its place among equals.
fn identity(draft: &Draft<'_>, wires: &[Wire], place: Option<&usize>) -> String {
    let first = draft.outputs.first().map_or("", |id| wires[id.0 as usize].name.as_str());
    match place {
        _ if first.is_empty() => draft.number.to_string(),
        Some(place) => format!("{first}#{place}"),
        None => first.to_owned(),
    }
}

/// The blocks that share the name of their first output: their places among equals, in order of number, from 1.
fn equals(scope: &Scope<'_>) -> FxHashMap<usize, usize> {
    let mut places = FxHashMap::default();
    for wire in scope.wires.iter().filter(|wire| wire.writers.len() > 1 && !wire.name.is_empty()) {
        let first_output = wire.writers.iter().filter(|writer| writer.output == 0);
        let mut blocks: Vec<usize> = first_output.map(|writer| writer.block.0 as usize).collect();
        blocks.sort_by_key(|block| scope.drafts[*block].number);
        if blocks.len() > 1 {
            places.extend(blocks.into_iter().enumerate().map(|(i, block)| (block, i + 1)));
        }
    }
    places
}

/// Which blocks keep their parameters in RAM.
struct Choice<'a> {
    tunable: &'a Tunable,
    initialize: Option<usize>,
}

impl Choice<'_> {
    fn is_tunable(&self, name: &str, section: u32) -> bool {
        let chosen = match self.tunable {
            Tunable::All => true,
            Tunable::None => false,
            Tunable::Names(patterns) => patterns.iter().any(|pattern| matches(pattern, name)),
        };
        chosen && self.initialize != Some(section as usize)
    }
}

/// `*` stands for any run of characters.
fn matches(pattern: &str, name: &str) -> bool {
    let mut parts = pattern.split('*');
    let Some(mut rest) = name.strip_prefix(parts.next().unwrap_or("")) else {
        return false;
    };
    let parts: Vec<&str> = parts.collect();
    let Some((last, middle)) = parts.split_last() else {
        return rest.is_empty();
    };
    for part in middle {
        match rest.find(part) {
            Some(at) => rest = &rest[at + part.len()..],
            None => return false,
        }
    }
    rest.ends_with(last)
}

/// What a cell's `tracks` names.
pub(crate) fn tracked(decl: &Decl, sizes: &[i32], name: &str) -> Option<Tracked> {
    let mut expanded = 0;
    for output in &decl.outputs {
        if output.name == name {
            return Some(Tracked::Output(expanded));
        }
        expanded += pcl2_lang::kernel::count(output.group.as_ref(), sizes)? as u32;
    }
    decl.memory.iter().position(|field| field.name == name).map(|field| Tracked::Memory(field as u32))
}

#[cfg(test)]
mod tests {
    use super::matches;

    #[test]
    fn patterns_match_as_in_a_shell() {
        assert!(matches("TIC*", "TIC101"));
        assert!(matches("*.K", "a.K"));
        assert!(matches("a*b*c", "aXbYc"));
        assert!(!matches("a*b*c", "aXbY"));
        assert!(!matches("TIC", "TIC1"));
        assert!(matches("TIC", "TIC"));
    }
}
