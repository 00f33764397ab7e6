//! Changed values back into the literals of the source.

use super::ParamsArgs;
use super::given::{Change, element_of, same};
use crate::console;
use crate::outcome::Outcome;
use crate::output;
use crate::project::{self, Project};
use pcl2_cfg::Edit;
use pcl2_cfg::places::{Written, is_empty, written};
use pcl2_lang::ast::{Line, Statement};
use pcl2_lang::decl::Decl;
use pcl2_lang::model::{self, Place};
use pcl2_lang::program::{Block, BlockId, Program};
use pcl2_lang::source::{MARK, Span};
use pcl2_lang::symbol::Symbols;
use pcl2_lang::syntax::{self, Tree};
use pcl2_sim::names::{Element, Names};
use pcl2_sim::number::Number;
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;

/// Writes changed values into the source, and says which it cannot write.
pub(super) fn save(
    args: &ParamsArgs,
    project: &Project,
    names: &Names<'_>,
    changes: &[Change],
) -> Result<Outcome, String> {
    let Some((path, file)) = &project.source else {
        return Err("there is no source to save in".to_owned());
    };
    let source = project.sources.file(*file);
    let mut symbols = Symbols::default();
    let tree = syntax::parse(&project.sources, *file, &mut symbols, &mut Vec::new());
    let plan = plan(names, changes, &tree, &symbols, &source.text);
    let shown = path.display();
    for (element, why) in &plan.left {
        console::err(&format!("not saved: {}: {why}", names.label(*element)));
    }
    if !plan.edits.is_empty() {
        let text = pcl2_cfg::edited(source.bytes(), &plan.edits);
        let anew = project::load_replaced(&args.path, &args.common, text.clone())
            .map_err(|_| format!("`{shown}` is left as it is: it cannot be read again"))?;
        let wanted = |change: &&Change| !plan.left.iter().any(|(element, _)| *element == change.element);
        let kept: Vec<&Change> = changes.iter().filter(wanted).collect();
        let program = anew.verified.as_ref().map(|verified| verified.program());
        if !program.is_some_and(|program| is_saved(names, program, &kept)) {
            return Err(format!("`{shown}` is left as it is: with these values it would mean something else"));
        }
        let bytes = if source.marked { [MARK, &text].concat() } else { text };
        output::rewrite_file(path, &bytes).map_err(|error| format!("cannot write `{shown}`: {error}"))?;
    }
    console::err(&format!("saved {} of {} in {shown}", changes.len() - plan.left.len(), changes.len()));
    Ok(if plan.left.is_empty() { Outcome::Done } else { Outcome::Errors })
}

/// Whether a program has the new values, and all others as before.
fn is_saved(names: &Names<'_>, program: &Program, changes: &[&Change]) -> bool {
    let wanted: FxHashMap<Element, Number> = changes.iter().map(|change| (change.element, change.now)).collect();
    let (old, new) = (&names.program.main().blocks, &program.main().blocks);
    let mut points = names.points.iter().enumerate();
    old.len() == new.len()
        && points.all(|(p, point)| {
            let Place::Param(block, param) = point.place else {
                return true;
            };
            let value = |blocks: &[Block], program, element: u32| {
                let value = model::value(&blocks[block.0 as usize].params[param as usize])?;
                element_of(value, element as usize, program)
            };
            (0..point.ty.elements() as u32).all(|element| {
                let asked = wanted.get(&Element { point: p as u32, element }).copied();
                let expected = asked.or_else(|| value(old, names.program, element));
                expected.zip(value(new, program, element)).is_some_and(|(a, b)| same(a, b))
            })
        })
}

/// What is written where, and what cannot be.
#[derive(Default)]
struct Plan {
    edits: Vec<Edit>,
    left: Vec<(Element, String)>,
}

/// The changes of one parameter.
struct Param<'c> {
    index: usize,
    changes: Vec<&'c Change>,
    /// All its elements as they shall be.
    values: Vec<String>,
    /// Its value in the words of the source, if all elements have the same.
    one: Option<String>,
}

fn plan(names: &Names<'_>, changes: &[Change], tree: &Tree, symbols: &Symbols, text: &str) -> Plan {
    let mut plan = Plan::default();
    let mut blocks: BTreeMap<BlockId, BTreeMap<u32, Vec<&Change>>> = BTreeMap::new();
    for change in changes {
        match names.point(change.element).place {
            Place::Param(block, param) => {
                blocks.entry(block).or_default().entry(param).or_default().push(change);
            }
            Place::Cell(_) | Place::Signal(_) | Place::Image(_) | Place::Inside(_) | Place::Memory(_) => {
                plan.left.push((change.element, "an operator cell has no literal".to_owned()));
            }
        }
    }
    let statements: FxHashMap<Span, &Statement> = tree
        .lines
        .iter()
        .filter_map(|line| match line {
            Line::Block(statement) => Some((statement.span, &**statement)),
            _ => None,
        })
        .collect();
    for (id, params) in blocks {
        let block = names.program.main().block(id);
        let params: Vec<Param<'_>> = params.into_iter().map(|(index, list)| param(names, block, index, list)).collect();
        match statements.get(&block.span) {
            Some(statement) => {
                let decl = names.program.decl(block.decl);
                Writer { statement, symbols, decl, sizes: &block.sizes, text, plan: &mut plan }.write(&params);
            }
            None => {
                let all = params.iter().flat_map(|param| &param.changes);
                plan.left.extend(all.map(|change| (change.element, "it has no literal of its own".to_owned())));
            }
        }
    }
    plan.edits.sort_by_key(|edit| edit.span);
    plan.edits.dedup();
    plan.left.sort();
    plan
}

fn param<'c>(names: &Names<'_>, block: &Block, index: u32, changes: Vec<&'c Change>) -> Param<'c> {
    let program = names.program;
    let choices = &program.decl(block.decl).params[index as usize].tail.names;
    let elements = changes.first().map_or(0, |change| names.point(change.element).ty.elements());
    let old = model::value(&block.params[index as usize]);
    let mut values: Vec<String> = (0..elements)
        .map(|element| old.and_then(|old| element_of(old, element, program)))
        .map(|number| number.map_or_else(String::new, |number| literal(number, choices)))
        .collect();
    for change in &changes {
        values[change.element.element as usize] = literal(change.now, choices);
    }
    let one = values.first().filter(|first| values.iter().all(|value| value == *first)).cloned();
    Param { index: index as usize, changes, values, one }
}

/// A value as sources write it.
fn literal(number: Number, choices: &[String]) -> String {
    match number {
        Number::Int(value) => {
            let name = usize::try_from(value).ok().and_then(|value| choices.get(value));
            name.map_or_else(|| value.to_string(), String::clone)
        }
        Number::Time(_) | Number::Double(_) | Number::Single(_) => {
            let text = number.to_string();
            text.strip_suffix(".0").map_or(text.clone(), |whole| format!("{whole}."))
        }
    }
}

struct Writer<'a> {
    statement: &'a Statement,
    symbols: &'a Symbols,
    decl: &'a Decl,
    sizes: &'a [i32],
    text: &'a str,
    plan: &'a mut Plan,
}

impl Writer<'_> {
    fn write(&mut self, params: &[Param<'_>]) {
        let mut placeless = Vec::new();
        for param in params {
            let mut has_places = true;
            for change in &param.changes {
                let element = change.element.element as usize;
                let at = (param.index, element);
                match written(self.statement, self.symbols, self.decl, self.sizes, at) {
                    Written::Here(span) => self.edit(span, param.values[element].clone()),
                    Written::Empty(span) => self.insert(span.start, &param.values[element]),
                    Written::ForAll(span) => match &param.one {
                        Some(value) => self.edit(span, value.clone()),
                        None => self.leave(change, "one value stands for all its elements"),
                    },
                    Written::File(span) => {
                        let file = &self.text[span.start as usize..span.end as usize];
                        self.leave(change, &format!("its value comes from the file {file}"));
                    }
                    Written::Nowhere => has_places = false,
                }
            }
            if !has_places {
                placeless.push(param);
            }
        }
        self.defaults(&placeless);
    }

    /// Values that were defaults become named arguments; where elements differ, an empty list gets its places.
    fn defaults(&mut self, params: &[&Param<'_>]) {
        let named: Option<Vec<String>> = params
            .iter()
            .map(|param| Some(format!("{} = {}", self.decl.params[param.index].name, param.one.as_ref()?)))
            .collect();
        let places = self.statement.params();
        match (named, is_empty(self.statement)) {
            (Some(named), _) if named.is_empty() => {}
            (Some(named), true) => self.insert(places[0].span.start, &named.join(", ")),
            (Some(named), false) => {
                let end = places.last().map_or(self.statement.colon.end, |place| place.span.end);
                self.edit(Span { start: end, end, ..self.statement.span }, format!(", {}", named.join(", ")));
            }
            (None, true) => self.insert(places[0].span.start, &self.list(params)),
            (None, false) => {
                for param in params {
                    let why = "its elements have no places behind named parameters";
                    param.changes.iter().for_each(|change| self.leave(change, why));
                }
            }
        }
    }

    /// The whole list by position; what does not change stays empty.
    fn list(&self, params: &[&Param<'_>]) -> String {
        let mut places = Vec::new();
        for (index, decl) in self.decl.params.iter().enumerate() {
            match params.iter().find(|param| param.index == index) {
                Some(param) => places.extend(param.values.iter().cloned()),
                None => {
                    let ty = pcl2_lang::kernel::resolve(&decl.ty, self.sizes);
                    places.extend(std::iter::repeat_n(String::new(), ty.map_or(1, pcl2_lang::types::Type::elements)));
                }
            }
        }
        places.join(", ")
    }

    fn leave(&mut self, change: &Change, why: &str) {
        self.plan.left.push((change.element, why.to_owned()));
    }

    fn edit(&mut self, span: Span, text: String) {
        self.plan.edits.push(Edit { span, text });
    }

    /// Puts a value before a byte, with a blank on either side but before a comma.
    fn insert(&mut self, at: u32, value: &str) {
        let blank = |c: &char| c.is_ascii_whitespace();
        let before = self.text[..at as usize].chars().next_back().filter(|c| !blank(c) && *c != '(');
        let behind = self.text[at as usize..].chars().next().filter(|c| !blank(c) && *c != ',');
        let text = format!("{}{value}{}", before.map_or("", |_| " "), behind.map_or("", |_| " "));
        self.edit(Span { start: at, end: at, ..self.statement.span }, text);
    }
}
