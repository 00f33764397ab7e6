//! What is known of each block while the passes run.

use crate::Input;
use crate::formula::Parts;
use pcl2_lang::ast::{Item, Statement};
use pcl2_lang::decl::Decl;
use pcl2_lang::program::{BlockId, Cell, ImageWord, Param, Role, SignalId, Source, Writer};
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
    /// Of an expression.
    pub(crate) formula: Option<Box<Parts<'a>>>,
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
    /// Of a net: names that stand for an element of a signal, as those of its boxes do.
    pub(crate) elements: FxHashMap<Symbol, (SignalId, u32)>,
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
            formula: None,
        };
        Scope {
            drafts: statements.into_iter().map(draft).collect(),
            wires: Vec::new(),
            by_name: NameTable::default(),
            members: FxHashMap::default(),
            elements: FxHashMap::default(),
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

    /// Where its first output stands.
    pub(crate) fn first_output(&self) -> Span {
        self.statement.outputs.first().map_or(self.statement.code.span, |output| output.span())
    }

    /// `block 6`; in a net, whose statements have no numbers that a reader sees, `the statement`.
    pub(crate) fn title(&self) -> String {
        match self.statement.number {
            Some((_, span)) if span == self.statement.span => "the statement".to_owned(),
            _ => format!("block {}", self.number),
        }
    }
}
