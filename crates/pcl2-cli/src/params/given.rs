//! Values from a file: read, and judged as a whole before anything is done with them.

use crate::project::{MAX_PARAMETERS, read_regular};
use pcl2_lang::bounds;
use pcl2_lang::model::{self, Access, Place};
use pcl2_lang::program::{BlockId, Param, Program};
use pcl2_lang::source::MARK;
use pcl2_lang::types::{Real, Value};
use pcl2_lang::verify::verify;
use pcl2_sim::engine::{cell_refusal, judge};
use pcl2_sim::health::block_title;
use pcl2_sim::names::{self, Element, Names};
use pcl2_sim::number::{self, Number};
use pcl2_sim::stimulus::Event;
use rustc_hash::FxHashSet;
use std::path::Path;

/// More complaints than this are not printed.
const MAX_COMPLAINTS: usize = 20;

/// An element whose value is not the source's.
#[derive(Clone, Copy, Debug)]
pub(super) struct Change {
    pub(super) element: Element,
    pub(super) source: Number,
    pub(super) now: Number,
}

/// The elements that differ, in the order of the program. Complaints when the file or a value in it is refused.
pub(super) fn read(path: &Path, names: &Names<'_>) -> Result<Vec<Change>, Vec<String>> {
    let values = lines(path, names)?;
    let source = |element| Some((element, source(names, element)?));
    let values = values.into_iter().filter_map(|(element, now)| {
        let (element, source) = source(element)?;
        Some(Change { element, source, now })
    });
    let mut changes: Vec<Change> = values.filter(|change| !same(change.source, change.now)).collect();
    changes.sort_by_key(|change| change.element);
    let refused = refused(names, &changes);
    if refused.is_empty() { Ok(changes) } else { Err(refused) }
}

fn lines(path: &Path, names: &Names<'_>) -> Result<Vec<(Element, Number)>, Vec<String>> {
    let shown = path.display();
    let bytes = read_regular(path, MAX_PARAMETERS).map_err(|why| vec![format!("cannot read `{shown}`: {why}")])?;
    let text = String::from_utf8(bytes.strip_prefix(MARK).unwrap_or(&bytes).to_vec());
    let text = text.map_err(|_| vec![format!("`{shown}` is no UTF-8 text")])?;
    let mut values = Vec::new();
    let mut complaints = Vec::new();
    let mut seen = FxHashSet::default();
    for (i, line) in text.lines().enumerate() {
        let line = line.split('!').next().unwrap_or("").trim();
        if line.is_empty() {
            continue;
        }
        match value(line, names) {
            Ok((element, _)) if !seen.insert(element) => {
                complaints.push(format!("{shown}:{}: `{}` has a value already", i + 1, names.label(element)));
            }
            Ok(value) => values.push(value),
            Err(message) => complaints.push(format!("{shown}:{}: {message}", i + 1)),
        }
    }
    if complaints.is_empty() {
        return Ok(values);
    }
    let more = complaints.len().saturating_sub(MAX_COMPLAINTS);
    complaints.truncate(MAX_COMPLAINTS);
    if more > 0 {
        complaints.push(format!("{more} more lines of `{shown}` are refused: is it the file of another program?"));
    }
    Err(complaints)
}

fn value(line: &str, names: &Names<'_>) -> Result<(Element, Number), String> {
    let (name, text) = line.split_once('=').ok_or_else(|| format!("expected NAME=VALUE, found `{line}`"))?;
    let name = name.trim();
    let element = names.element(name).map_err(|message| inside(name, names).unwrap_or(message))?;
    let point = names.point(element);
    match point.access {
        Access::Tunable | Access::Operator => {}
        Access::Signal | Access::Input | Access::Image | Access::State => {
            return Err(format!("`{name}` is no parameter"));
        }
    }
    let width = names.program.width;
    let number = number::parse(text.trim(), point.ty.scalar, width, &point.names);
    number.map(|number| (element, number)).map_err(|message| format!("`{name}`: {message}"))
}

/// What a composite's body gives to the blocks in it is no parameter of the program.
fn inside(name: &str, names: &Names<'_>) -> Option<String> {
    let (tag, inner) = name.split_once('.')?;
    let called = |block: &&pcl2_lang::program::Block| block.name == tag || block.number.to_string() == tag;
    let block = names.program.main().blocks.iter().find(called)?;
    let code = &names.program.decl(block.decl).name;
    let (composite, deep) = (block.unit.is_some(), inner.contains('.'));
    (composite && deep).then(|| format!("`{name}` is set by the body of `{code}`, not by this program"))
}

/// What the source says.
fn source(names: &Names<'_>, element: Element) -> Option<Number> {
    let program = names.program;
    let value = match names.point(element).place {
        Place::Param(block, param) => model::value(&program.main().block(block).params[param as usize])?,
        Place::Cell(cell) => &program.main().cells[cell.0 as usize].initial,
        Place::Signal(_) | Place::Image(_) | Place::Inside(_) | Place::Memory(_) => return None,
    };
    element_of(value, element.element as usize, program)
}

/// One element of a value, in the width of the program.
pub(super) fn element_of(value: &Value, element: usize, program: &Program) -> Option<Number> {
    match value {
        Value::Int(value) => Some(Number::Int(*value)),
        Value::Ints(values) => values.get(element).map(|value| Number::Int(*value)),
        Value::Real(value) => Some(Number::of_real(*value, program.width)),
        Value::Reals(values) => values.get(element).map(|value| Number::of_real(*value, program.width)),
        Value::Text(_) => None,
    }
}

/// Bit for bit.
pub(super) fn same(a: Number, b: Number) -> bool {
    match (a, b) {
        (Number::Double(a), Number::Double(b)) => a.to_bits() == b.to_bits(),
        (Number::Single(a), Number::Single(b)) => a.to_bits() == b.to_bits(),
        (a, b) => a == b,
    }
}

/// What declared ranges and the kernels' checks say of the program with these values.
fn refused(names: &Names<'_>, changes: &[Change]) -> Vec<String> {
    let mut program = names.program.clone();
    let mut blocks = Vec::new();
    let mut complaints = Vec::new();
    for change in changes {
        match names.point(change.element).place {
            Place::Param(block, param) => {
                put(&mut program.units[0].blocks[block.0 as usize].params[param as usize], change);
                blocks.push(block);
            }
            Place::Cell(_) | Place::Signal(_) | Place::Image(_) | Place::Inside(_) | Place::Memory(_) => {
                let event = Event { scan: 0, element: change.element, value: change.now };
                complaints.extend(cell_refusal(names, &event).map(|refusal| refusal.to_string()));
            }
        }
    }
    blocks.dedup();
    complaints.extend(blocks.iter().filter_map(|block| out_of_range(&program, *block)));
    let mut inner = Vec::new();
    pcl2_cfg::check_inner_ranges(&program, &mut inner);
    complaints.extend(inner.into_iter().map(|diagnostic| diagnostic.message));
    if complaints.is_empty() {
        match verify(program) {
            Ok(verified) => complaints.extend(judge(&verified).iter().map(ToString::to_string)),
            Err(defect) => complaints.push(format!("the compiler contradicts itself: {defect}")),
        }
    }
    complaints
}

fn put(param: &mut Param, change: &Change) {
    let element = change.element.element as usize;
    let real = change.now.to_real();
    match (param, change.now) {
        (Param::Value(Value::Int(value)), Number::Int(now)) => *value = now,
        (Param::Value(Value::Real(value)), _) => *value = real,
        (Param::Value(Value::Ints(values)), Number::Int(now)) => set(values, element, now),
        (Param::Value(Value::Reals(values)), _) => set::<Real>(values, element, real),
        _ => {}
    }
}

fn set<T>(values: &mut [T], element: usize, now: T) {
    if let Some(value) = values.get_mut(element) {
        *value = now;
    }
}

fn out_of_range(program: &Program, id: BlockId) -> Option<String> {
    let block = program.main().block(id);
    let decl = program.decl(block.decl);
    let values: Option<Vec<Value>> = block.params.iter().map(|param| model::value(param).cloned()).collect();
    let found = bounds::check(decl, &block.sizes, &values?, program.width).err()?;
    let param = &decl.params[found.param];
    let ty = pcl2_lang::kernel::resolve(&param.ty, &block.sizes);
    let suffix = ty.map_or_else(String::new, |ty| names::suffix(ty, found.element as u32));
    let title = block_title(program, id);
    Some(format!("{title}: {}{suffix} must be {}, not {}", param.name, found.expected, found.found))
}
