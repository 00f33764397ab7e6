//! Expressions, through all passes: their operators and functions, their types, the function code that each becomes.

use crate::Input;
use crate::bind::{count_word, form};
use crate::draft::{Draft, Scope};
use crate::sizes::{Found, constant_type, element, source_shape};
use pcl2_lang::ast::{Formula, Name, Term};
use pcl2_lang::codes;
use pcl2_lang::decl::{Decl, Fault, Step, TypeExpr};
use pcl2_lang::diagnostic::Diagnostic;
use pcl2_lang::program::{DeclId, SignalId, Source};
use pcl2_lang::source::{FileId, Span};
use pcl2_lang::suggest;
use pcl2_lang::types::{Real, Scalar, Shape, Type, Value};
use rustc_hash::FxHashSet;
use std::sync::LazyLock;

/// Stands for every expression until its types are known: one output without a number type of its own.
static EXPRESSION: LazyLock<Decl> =
    LazyLock::new(|| Decl::expression(Span { file: FileId(0), start: 0, end: 0 }, &[], Scalar::Real, Vec::new()));

/// An expression in the making.
pub(crate) struct Parts<'a> {
    parts: Vec<Part<'a>>,
    /// What each operand must be; known after pass 5.
    wanted: Vec<Scalar>,
    result: Scalar,
}

/// What stands for a term.
enum Part<'a> {
    Operand,
    /// The codes that it can be: with so many ports, whatever their types; after pass 5 one.
    Apply(Name, Vec<&'a Decl>),
}

/// Pass 2: operators and functions are known codes, and have as many operands as these have ports.
pub(crate) fn bind<'a>(input: &Input<'a>, draft: &mut Draft<'a>, formula: &Formula, diagnostics: &mut Vec<Diagnostic>) {
    draft.decl = Some(&*EXPRESSION);
    draft.operands = draft.statement.inputs().iter().map(Some).collect();
    draft.spoiled = formula.0.is_empty();
    let mut parts = Vec::with_capacity(formula.0.len());
    for (i, term) in formula.0.iter().enumerate() {
        let Term::Apply(name, count) = *term else {
            parts.push(Part::Operand);
            continue;
        };
        let text = input.symbols.text(name.symbol);
        let fits = |decl: &&Decl| decl.ports().count() == count as usize;
        let codes: Vec<&Decl> = input.catalogue.operators(text).filter(fits).collect();
        if codes.is_empty() {
            draft.spoiled = true;
            if !input.catalogue.is_spoiled(text) {
                let whole = i + 1 == formula.0.len() && name.span.start == draft.statement.code.span.start;
                diagnostics.push(no_function(input, draft, name, (text, count), whole));
            }
        }
        parts.push(Part::Apply(name, codes));
    }
    draft.sized = !draft.spoiled;
    draft.formula = Some(Box::new(Parts { parts, wanted: Vec::new(), result: Scalar::Real }));
}

/// `whole`: the call is all of the expression, so perhaps the `:` of a block's call is missing.
fn no_function(
    input: &Input<'_>,
    draft: &Draft<'_>,
    name: Name,
    (text, count): (&str, u32),
    whole: bool,
) -> Diagnostic {
    let mut counts: Vec<usize> = input.catalogue.operators(text).map(|decl| decl.ports().count()).collect();
    counts.sort_unstable();
    counts.dedup();
    if let Some(most) = counts.pop() {
        let some: String = counts.iter().map(|count| format!("{count} or ")).collect();
        let message = format!("expected {some}{} of `{text}`, found {count}", count_word(most, "operand"));
        let forms: Vec<String> = input.catalogue.operators(text).map(|decl| function_form(text, decl)).collect();
        let help = format!("the form is {}", forms.join(" or "));
        return Diagnostic::new(codes::INPUT_COUNT, name.span, message).help(help);
    }
    match input.catalogue.find(text) {
        Some(decl) if whole => {
            let message = format!("expected `:` behind the inputs of {text}, found the end of the line");
            let help = format!("the form is {}; only functions go without `:`", form(decl));
            Diagnostic::new(codes::NO_FUNCTION, draft.statement.colon, message).help(help)
        }
        Some(_) => {
            let message =
                format!("expected a function of expressions, found the function code `{text}`, which is none");
            let help = format!("give it a line of its own, `v = {text} ( .. : .. )`, and use v here");
            Diagnostic::new(codes::NO_FUNCTION, name.span, message).help(help)
        }
        None => {
            let message = format!("expected a function of expressions, found `{text}`");
            let mut known = input.catalogue.functions();
            known.extend(input.catalogue.decls().map(|decl| decl.name.as_str()).filter(|_| whole));
            let help = suggest::help(text, known.into_iter());
            let help = help.unwrap_or_else(|| "`pcl2 blocks` lists the function codes".to_owned());
            Diagnostic::new(codes::UNKNOWN_CODE, name.span, message).help(help)
        }
    }
}

/// `div(a, b)`
fn function_form(text: &str, decl: &Decl) -> String {
    let ports: Vec<&str> = decl.ports().map(|port| port.name.as_str()).collect();
    format!("{text}({})", ports.join(", "))
}

/// Pass 5: what is known of the result while types are searched.
pub(crate) enum Inferred {
    Known(Type),
    /// It depends on this signal.
    Waiting(SignalId),
    /// This term has operands that none of its codes takes, whatever is not known yet.
    Misfit(usize, Vec<Option<Scalar>>),
    /// An operand is spoiled: nothing is said.
    Spoiled,
}

/// The type of an expression's result. Often not all operands are needed: `0.9*y + u` is a real whatever y is.
pub(crate) fn infer(scope: &Scope<'_>, draft: &Draft<'_>, parts: &Parts<'_>) -> Inferred {
    let mut waiting = None;
    let mut results: Vec<Option<Scalar>> = Vec::new();
    let mut sources = draft.sources.iter();
    for (i, part) in parts.parts.iter().enumerate() {
        let result = match part {
            Part::Operand => match sources.next().map(|source| source_shape(scope, source)) {
                Some(Found::Type(ty)) => Some(ty.scalar),
                Some(Found::Later(signal)) => {
                    waiting = waiting.or(Some(signal));
                    None
                }
                Some(Found::Spoiled) | None => return Inferred::Spoiled,
            },
            Part::Apply(_, codes) => {
                let count = codes.first().map_or(0, |code| code.ports().count());
                let operands = results.split_off(results.len().saturating_sub(count));
                let mut fitting = codes.iter().filter(|code| conversions(code, &operands).is_some());
                let Some(first) = fitting.next() else {
                    return Inferred::Misfit(i, operands);
                };
                let result = result_of(first);
                match best(codes, &operands) {
                    Some(code) if operands.iter().all(Option::is_some) => Some(result_of(code)),
                    _ => fitting.all(|code| result_of(code) == result).then_some(result),
                }
            }
        };
        results.push(result);
    }
    match (results.last().copied().flatten(), waiting) {
        (Some(scalar), _) => Inferred::Known(scalar_type(scalar)),
        (None, Some(signal)) => Inferred::Waiting(signal),
        (None, None) => Inferred::Spoiled,
    }
}

fn scalar_type(scalar: Scalar) -> Type {
    match scalar {
        Scalar::Int => Type::INT,
        Scalar::Real => Type::REAL,
    }
}

fn result_of(code: &Decl) -> Scalar {
    match code.outputs.first().map(|output| &output.ty) {
        Some(TypeExpr::Scalar(Scalar::Int)) => Scalar::Int,
        Some(_) | None => Scalar::Real,
    }
}

/// How many ints stand where the code wants a real; `None` where a real stands for an int.
fn conversions(code: &Decl, operands: &[Option<Scalar>]) -> Option<usize> {
    let mut count = 0;
    for (operand, port) in operands.iter().zip(code.port_scalars()) {
        match (operand, port) {
            (Some(Scalar::Real), Scalar::Int) => return None,
            (Some(Scalar::Int), Scalar::Real) => count += 1,
            (Some(_) | None, _) => {}
        }
    }
    Some(count)
}

/// The code that takes the operands with the fewest conversions.
fn best<'a>(codes: &[&'a Decl], operands: &[Option<Scalar>]) -> Option<&'a Decl> {
    let fitting = codes.iter().filter_map(|code| Some((conversions(code, operands)?, *code)));
    fitting.min_by_key(|(count, _)| *count).map(|(_, code)| code)
}

/// Pass 5, when all types are known: operands are scalars, each operator becomes one code.
pub(crate) fn check<'a>(input: &Input<'a>, scope: &mut Scope<'a>, index: usize, diagnostics: &mut Vec<Diagnostic>) {
    let Some(mut parts) = scope.drafts[index].formula.take() else {
        return;
    };
    let known = operands(input, scope, index, diagnostics);
    let chosen = known.is_some_and(|known| choose(input, &scope.drafts[index], &mut parts, &known, diagnostics));
    let draft = &mut scope.drafts[index];
    draft.spoiled |= !chosen;
    for (source, wanted) in draft.sources.iter_mut().zip(&parts.wanted) {
        if let (Source::Constant(Value::Int(value)), Scalar::Real) = (&*source, wanted) {
            *source = Source::Constant(Value::Real(Real::from_int(*value)));
        }
    }
    draft.formula = Some(parts);
}

/// The number type of each operand.
fn operands<'a>(
    input: &Input<'a>,
    scope: &mut Scope<'a>,
    index: usize,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Vec<Scalar>> {
    let mut known = Vec::new();
    let mut sound = true;
    for next in 0..scope.drafts[index].sources.len() {
        let source = scope.drafts[index].sources[next].clone();
        let place = scope.drafts[index].operands.get(next).copied().flatten();
        let ty = match (&source, place) {
            (Source::Constant(value), _) => constant_type(value),
            (Source::Element(id, found), Some(place)) => {
                let whole = scope.wire(*id).ty.filter(|_| !scope.wire(*id).spoiled);
                let found =
                    whole.and_then(|ty| Some((ty, element(scope, *id, ty, (&place.value, *found), diagnostics)?)));
                let Some((whole, flat)) = found else {
                    sound = false;
                    continue;
                };
                scope.drafts[index].sources[next] = Source::Element(*id, flat);
                scalar_type(whole.scalar)
            }
            _ => match source_shape(scope, &source) {
                Found::Type(ty) => ty,
                Found::Later(_) | Found::Spoiled => {
                    sound = false;
                    continue;
                }
            },
        };
        if !ty.is_scalar() {
            sound = false;
            diagnostics.push(no_scalar(input, &scope.drafts[index], place.map(|place| place.span), ty));
        }
        known.push(ty.scalar);
    }
    sound.then_some(known)
}

fn no_scalar(input: &Input<'_>, draft: &Draft<'_>, place: Option<Span>, found: Type) -> Diagnostic {
    let span = place.unwrap_or(draft.statement.code.span);
    let text = input.sources.text(span);
    let message = format!("{}: an expression needs scalars, `{text}` is {found}", draft.title());
    let index = if matches!(found.shape, Shape::Matrix(..)) { "1,1" } else { "1" };
    let help = format!("take an element, such as `{text}[{index}]`; whole vectors and matrices have function codes");
    Diagnostic::new(codes::TYPE_DIFFERS, span, message).help(help)
}

/// Chooses a code for each operator, and what each operand must be.
fn choose(
    input: &Input<'_>,
    draft: &Draft<'_>,
    parts: &mut Parts<'_>,
    known: &[Scalar],
    diagnostics: &mut Vec<Diagnostic>,
) -> bool {
    parts.wanted = known.to_vec();
    // Each result and, where it is an operand, which.
    let mut results: Vec<(Scalar, Option<usize>)> = Vec::new();
    let mut next = known.iter().copied().enumerate();
    for part in &mut parts.parts {
        let Part::Apply(name, codes) = part else {
            results.extend(next.next().map(|(operand, scalar)| (scalar, Some(operand))));
            continue;
        };
        let count = codes.first().map_or(0, |code| code.ports().count());
        let operands = results.split_off(results.len().saturating_sub(count));
        let found: Vec<Option<Scalar>> = operands.iter().map(|(scalar, _)| Some(*scalar)).collect();
        let Some(code) = best(codes, &found) else {
            diagnostics.push(misfit(input, draft, (*name, codes), &found));
            return false;
        };
        for ((_, operand), wanted) in operands.iter().zip(code.port_scalars()) {
            if let Some(operand) = operand {
                parts.wanted[*operand] = wanted;
            }
        }
        *codes = vec![code];
        results.push((result_of(code), None));
    }
    parts.result = results.last().map_or(Scalar::Real, |(scalar, _)| *scalar);
    true
}

/// Says which term has operands that do not fit.
pub(crate) fn report_misfit(
    input: &Input<'_>,
    draft: &Draft<'_>,
    (term, operands): (usize, &[Option<Scalar>]),
    diagnostics: &mut Vec<Diagnostic>,
) {
    if let Some(Part::Apply(name, codes)) = draft.formula.as_deref().and_then(|parts| parts.parts.get(term)) {
        diagnostics.push(misfit(input, draft, (*name, codes), operands));
    }
}

fn misfit(
    input: &Input<'_>,
    draft: &Draft<'_>,
    (name, codes): (Name, &[&Decl]),
    operands: &[Option<Scalar>],
) -> Diagnostic {
    let list = |scalars: Vec<Option<Scalar>>| -> String {
        let word = |scalar: Option<Scalar>| scalar.map_or("_".to_owned(), |scalar| scalar_type(scalar).to_string());
        scalars.into_iter().map(word).collect::<Vec<String>>().join(", ")
    };
    let text = input.symbols.text(name.symbol);
    let wanted = codes.iter().map(|code| format!("({})", list(code.port_scalars().map(Some).collect())));
    let wanted: Vec<String> = wanted.collect();
    let found = list(operands.to_vec());
    let message = format!("{}: expected {} for `{text}`, found ({found})", draft.title(), wanted.join(" or "));
    Diagnostic::new(codes::TYPE_DIFFERS, name.span, message).help("a real does not fit where an int is needed")
}

/// The signal that an expression waits for.
fn waits_for(scope: &Scope<'_>, draft: &Draft<'_>) -> Option<SignalId> {
    match infer(scope, draft, draft.formula.as_deref()?) {
        Inferred::Waiting(id) => Some(id),
        Inferred::Known(_) | Inferred::Misfit(..) | Inferred::Spoiled => None,
    }
}

/// Of expressions that wait for one another: one that waits for itself, or the first that waits for no expression.
pub(crate) fn first_of_loop(scope: &Scope<'_>, block: usize) -> usize {
    let mut seen = FxHashSet::default();
    let mut here = block;
    while seen.insert(here) {
        let writers = waits_for(scope, &scope.drafts[here]).map_or(&[][..], |id| &scope.wire(id).writers);
        match writers.iter().map(|writer| writer.block.0 as usize).find(|writer| !scope.drafts[*writer].spoiled) {
            Some(writer) => here = writer,
            None => return here,
        }
    }
    here
}

/// Pass 5: nothing tells what an expression is.
pub(crate) fn unknown_type(scope: &Scope<'_>, draft: &Draft<'_>) -> Diagnostic {
    let name = waits_for(scope, draft).map_or("", |id| scope.wire(id).name.as_str());
    let message = format!(
        "{}: expected operands that tell whether the expression is an int or a real, found `{name}`, which depends on it",
        draft.title()
    );
    let help = format!("set `{name}` in INITIALIZE, to `0` for an int or to `0.` for a real");
    Diagnostic::new(codes::UNKNOWN_TYPE, draft.statement.code.span, message).help(help)
}

/// The key under which equal expressions share a code.
pub(crate) type Key = (Vec<Step>, Vec<Scalar>, Scalar);

impl<'a> Parts<'a> {
    /// What the expression is, beside its operands; `id` gives each code its index.
    pub(crate) fn key(&self, mut id: impl FnMut(&'a Decl) -> DeclId) -> Key {
        let step = |part: &Part<'a>| match part {
            Part::Operand => Some(Step::Port),
            Part::Apply(_, codes) => codes.first().map(|code| Step::Apply(id(code))),
        };
        (self.parts.iter().filter_map(step).collect(), self.wanted.clone(), self.result)
    }

    /// The expression as a code. Its fault is that of its functions.
    pub(crate) fn decl(&self, span: Span, (steps, wanted, result): &Key) -> Decl {
        let mut decl = Decl::expression(span, wanted, *result, steps.clone());
        let codes = self.parts.iter().filter_map(|part| match part {
            Part::Operand => None,
            Part::Apply(_, codes) => codes.first(),
        });
        let mut texts: Vec<&str> = Vec::new();
        for fault in codes.flat_map(|code| &code.faults) {
            if !texts.contains(&fault.text.as_str()) {
                texts.push(&fault.text);
            }
        }
        if !texts.is_empty() && *result == Scalar::Real {
            decl.faults.push(Fault { name: "domain".to_owned(), text: texts.join(", or ") });
        }
        decl
    }
}
