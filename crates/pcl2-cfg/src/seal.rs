//! Finished drafts become the program.

use crate::composite::Composites;
use crate::draft::{Draft, Scope, Wire};
use crate::formula::{self, Parts};
use crate::sections::Sectioned;
use crate::{Input, Tunable};
use pcl2_lang::decl::{Decl, RETURN_OUTPUT};
use pcl2_lang::model;
use pcl2_lang::program::{
    Block, DeclId, Delay, ImageId, ImageWord, Program, Section, SectionKind, Signal, Source, Unit, UnitId,
};
use pcl2_lang::source::Span;
use pcl2_lang::types::Type;
use rustc_hash::FxHashMap;

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
    expressions: FxHashMap<formula::Key, DeclId>,
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

    /// Expressions that differ in their operands alone share a code.
    fn expression(&mut self, parts: &Parts<'_>, span: Span) -> DeclId {
        let key = parts.key(|code| self.id(code));
        if let Some(id) = self.expressions.get(&key) {
            return *id;
        }
        let id = DeclId(self.decls.len() as u32);
        self.decls.push(parts.decl(span, &key));
        self.expressions.insert(key, id);
        id
    }
}

#[derive(Default)]
struct ImageTable {
    by_name: FxHashMap<String, u32>,
    words: Vec<ImageWord>,
}

impl ImageTable {
    fn id(&mut self, word: ImageWord) -> ImageId {
        let next = self.words.len() as u32;
        let id = *self.by_name.entry(word.name.clone()).or_insert(next);
        if id == next {
            self.words.push(word);
        }
        ImageId(id)
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
    let open = open_returns(&scope);
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
            decl: match draft.formula.as_deref() {
                Some(parts) => decls.expression(parts, draft.statement.code.span),
                None => decls.id(decl),
            },
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
    let signals = scope.wires.into_iter().zip(open).map(|(wire, open)| Signal {
        name: if open { String::new() } else { wire.name },
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

/// By wire: whether it is a return wire under its tag's name that nobody reads. There is no such signal then, and a
/// loop that is closed on its valve pays nothing for it.
fn open_returns(scope: &Scope<'_>) -> Vec<bool> {
    let answers = |draft: &Draft<'_>| draft.decl.is_some_and(|decl| decl.returns.is_some() && !decl.is_composite());
    let mut open = vec![false; scope.wires.len()];
    if !scope.drafts.iter().any(answers) {
        return open;
    }
    let mut heard = vec![false; scope.wires.len()];
    let sources = scope.drafts.iter().flat_map(|draft| &draft.sources);
    for id in sources.filter_map(Source::signal).chain(scope.outputs.iter().copied()) {
        heard[id.0 as usize] = true;
    }
    for draft in scope.drafts.iter().filter(|draft| answers(draft)) {
        let Some(decl) = draft.decl else {
            continue;
        };
        let sizes = draft.known_sizes().unwrap_or_default();
        for (i, id) in draft.outputs.iter().enumerate() {
            let declared = model::output_decl(decl, &sizes, i).map(|index| &decl.outputs[index]);
            let returns = declared.is_some_and(|output| output.name == RETURN_OUTPUT && output.group.is_none());
            let wire = scope.wire(*id);
            let own_name = !wire.name.is_empty() && !wire.name.contains('.');
            open[id.0 as usize] = returns && !heard[id.0 as usize] && wire.writers.len() == 1 && !own_name;
        }
    }
    open
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
pub(crate) fn matches(pattern: &str, name: &str) -> bool {
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
