//! Pass 5: every size and type; wires fit their ports.

use crate::Input;
use crate::draft::{Draft, Scope};
use crate::formula;
use crate::signals::{spread, writing_order};
use pcl2_lang::ast::Operand;
use pcl2_lang::codes;
use pcl2_lang::decl::{Decl, Expr, PortDecl, TypeExpr};
use pcl2_lang::diagnostic::{self, Diagnostic};
use pcl2_lang::kernel;
use pcl2_lang::net::BOX_OUTPUT;
use pcl2_lang::program::{Role, SignalId, Source};
use pcl2_lang::source::Span;
use pcl2_lang::types::{MAX_ELEMENTS, Shape, Type, Value};
use pcl2_lang::verify::{MAX_PROGRAM, declared_bytes, fits};
use rustc_hash::FxHashMap;
use std::collections::VecDeque;

/// Finds all sizes, then checks all ports.
pub(crate) fn solve<'a>(input: &Input<'a>, scope: &mut Scope<'a>, diagnostics: &mut Vec<Diagnostic>) {
    let order = writing_order(input, scope);
    for i in &order {
        declare_outputs(input, scope, *i, diagnostics);
    }
    let mut search = Search { ready: order.into(), waiting: FxHashMap::default() };
    search.run(input, scope, diagnostics);
    search.declare(input, scope);
    search.run(input, scope, diagnostics);
    while let (Some(i), false) = (search.first_waiting(scope), diagnostic::enough(diagnostics)) {
        let i = formula::first_of_loop(scope, i);
        if scope.drafts[i].formula.is_some() {
            diagnostics.push(formula::unknown_type(scope, &scope.drafts[i]));
            spoil(scope, i);
        } else {
            let help = "set one variable of the loop in INITIALIZE, for instance with setmat";
            report_unknown_size(scope, i, ("a loop of blocks that wait for each other", help), diagnostics);
        }
        search.wake(scope, i);
        search.run(input, scope, diagnostics);
    }
    for i in 0..scope.drafts.len() {
        if diagnostic::enough(diagnostics) {
            return;
        }
        check_ports(input, scope, i, diagnostics);
    }
    check_written(input, scope, diagnostics);
    check_total(scope, diagnostics);
}

/// A program beyond the limit is refused before its parameters are spread out.
fn check_total(scope: &mut Scope<'_>, diagnostics: &mut Vec<Diagnostic>) {
    let mut total: u64 = 0;
    for draft in scope.drafts.iter_mut().filter(|draft| draft.sized) {
        let (Some(decl), Some(sizes)) = (draft.decl, draft.known_sizes()) else {
            continue;
        };
        let was = total;
        total = declared_bytes(decl, &sizes).map_or(u64::MAX, |bytes| total.saturating_add(bytes));
        draft.sized = total <= MAX_PROGRAM;
        if !draft.sized && was <= MAX_PROGRAM {
            diagnostics.push(too_large(draft.statement.code.span));
        }
    }
}

/// The message for a program whose data exceed the limit.
pub(crate) fn too_large(span: Span) -> Diagnostic {
    let message =
        format!("expected a program with at most {MAX_PROGRAM} bytes of variables, parameters and memory, found more");
    Diagnostic::new(codes::TOO_LARGE, span, message)
}

/// Gives signals the types that constants alone tell, the lowest-numbered writer first.
fn declare_outputs(input: &Input<'_>, scope: &mut Scope<'_>, index: usize, diagnostics: &mut Vec<Diagnostic>) {
    let draft = &scope.drafts[index];
    let Some(decl) = draft.decl.filter(|_| !draft.spoiled) else {
        return spoil(scope, index);
    };
    if draft.formula.is_some() {
        let _ = settle_expression(input, scope, index, diagnostics);
        return;
    }
    if draft.sizes.iter().all(Option::is_some) {
        return settle_outputs(scope, index, decl, diagnostics);
    }
    let sizes = draft.sizes.clone();
    let known: Vec<i32> = sizes.iter().map(|size| size.unwrap_or(0)).collect();
    let mut next = 0;
    for output in &decl.outputs {
        let count = kernel::count(output.group.as_ref(), &known).unwrap_or(0);
        if let (true, Some(ty)) = (is_known(&output.ty, &sizes), kernel::resolve(&output.ty, &known)) {
            for o in next..next + count {
                set_type(scope, index, o, ty, diagnostics);
            }
        }
        next += count;
    }
}

fn is_known(ty: &TypeExpr, sizes: &[Option<i32>]) -> bool {
    fn known(expr: &Expr, sizes: &[Option<i32>]) -> bool {
        match expr {
            Expr::Int(_) | Expr::Real(_) | Expr::Param(_) => true,
            Expr::Size(i) => sizes.get(*i).is_some_and(Option::is_some),
            Expr::Negate(a) => known(a, sizes),
            Expr::Add(a, b) | Expr::Subtract(a, b) | Expr::Multiply(a, b) | Expr::Divide(a, b) => {
                known(a, sizes) && known(b, sizes)
            }
        }
    }
    match ty {
        TypeExpr::Vector(_, n) => known(n, sizes),
        TypeExpr::Matrix(_, r, c) => known(r, sizes) && known(c, sizes),
        TypeExpr::Scalar(_) | TypeExpr::Text | TypeExpr::Time => true,
    }
}

/// Blocks whose sizes come from ports wait until the signal at the port has its type.
struct Search {
    ready: VecDeque<usize>,
    waiting: FxHashMap<SignalId, Vec<usize>>,
}

impl Search {
    fn run(&mut self, input: &Input<'_>, scope: &mut Scope<'_>, diagnostics: &mut Vec<Diagnostic>) {
        while let Some(i) = self.ready.pop_front() {
            match settle(input, scope, i, diagnostics) {
                Some(signal) => self.waiting.entry(signal).or_default().push(i),
                None => self.wake(scope, i),
            }
        }
    }

    /// The outputs of a block have their types: who waits for them goes on.
    fn wake(&mut self, scope: &Scope<'_>, index: usize) {
        if self.waiting.is_empty() {
            return;
        }
        for output in &scope.drafts[index].outputs {
            self.ready.extend(self.waiting.remove(output).into_iter().flatten());
        }
    }

    /// What blocks of a composite's body still wait for may be its outputs: their types are declared.
    fn declare(&mut self, input: &Input<'_>, scope: &mut Scope<'_>) {
        let Some((decl, sizes)) = scope.owner.clone().filter(|_| !self.waiting.is_empty()) else {
            return;
        };
        for (i, name) in crate::number::output_names(decl, &sizes).iter().enumerate() {
            let id = input.symbols.find(name).and_then(|symbol| scope.by_name.get(symbol));
            let Some(id) = id.filter(|id| scope.wire(*id).ty.is_none() && !scope.wire(*id).spoiled) else {
                continue;
            };
            let declared = pcl2_lang::model::output_decl(decl, &sizes, i);
            scope.wires[id.0 as usize].ty = declared.and_then(|o| kernel::resolve(&decl.outputs[o].ty, &sizes));
            self.ready.extend(self.waiting.remove(&id).into_iter().flatten());
        }
    }

    /// The first of the blocks that wait for each other.
    fn first_waiting(&self, scope: &Scope<'_>) -> Option<usize> {
        self.waiting.values().flatten().copied().filter(|i| !scope.drafts[*i].spoiled).min()
    }
}

/// Tries to find the sizes of a block. `Some`: the signal whose type is still missing.
fn settle(
    input: &Input<'_>,
    scope: &mut Scope<'_>,
    index: usize,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<SignalId> {
    let draft = &scope.drafts[index];
    let Some(decl) = draft.decl.filter(|_| !draft.spoiled) else {
        spoil(scope, index);
        return None;
    };
    if draft.formula.is_some() {
        return settle_expression(input, scope, index, diagnostics);
    }
    if draft.sizes.iter().all(Option::is_some) {
        return None;
    }
    match infer(scope, decl, index) {
        Inferred::All(sizes) => {
            scope.drafts[index].sizes = sizes;
            settle_outputs(scope, index, decl, diagnostics);
            None
        }
        Inferred::Waiting(signal) => Some(signal),
        Inferred::Unwired => {
            let found = ("no variable at a port with it", "wire one of the ports whose type has this size");
            report_unknown_size(scope, index, found, diagnostics);
            None
        }
        Inferred::Spoiled => {
            spoil(scope, index);
            None
        }
    }
}

/// Tries to find the type of an expression. `Some`: the signal whose type is still missing.
fn settle_expression(
    input: &Input<'_>,
    scope: &mut Scope<'_>,
    index: usize,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<SignalId> {
    let draft = &scope.drafts[index];
    match formula::infer(scope, draft, draft.formula.as_deref()?) {
        formula::Inferred::Known(ty) => {
            set_type(scope, index, 0, ty, diagnostics);
            None
        }
        formula::Inferred::Waiting(signal) => Some(signal),
        formula::Inferred::Misfit(term, operands) => {
            formula::report_misfit(input, draft, (term, &operands), diagnostics);
            spoil(scope, index);
            None
        }
        formula::Inferred::Spoiled => {
            spoil(scope, index);
            None
        }
    }
}

/// With all sizes known: checks the sizes of all fields and gives the outputs their types.
fn settle_outputs(scope: &mut Scope<'_>, index: usize, decl: &Decl, diagnostics: &mut Vec<Diagnostic>) {
    let sizes = scope.drafts[index].known_sizes().unwrap_or_default();
    if !check_fields(scope, index, decl, &sizes, diagnostics) {
        scope.drafts[index].sized = false;
        return spoil(scope, index);
    }
    let mut next = 0;
    for output in &decl.outputs {
        for _ in 0..kernel::count(output.group.as_ref(), &sizes).unwrap_or(0) {
            if let Some(ty) = kernel::resolve(&output.ty, &sizes) {
                set_type(scope, index, next, ty, diagnostics);
            }
            next += 1;
        }
    }
}

enum Inferred {
    All(Vec<Option<i32>>),
    Waiting(SignalId),
    /// The ports that would tell are left empty.
    Unwired,
    Spoiled,
}

/// A size that is no constant comes from the first port that has it alone.
fn infer(scope: &Scope<'_>, decl: &Decl, index: usize) -> Inferred {
    let draft = &scope.drafts[index];
    let mut sizes = draft.sizes.clone();
    let known: Vec<i32> = sizes.iter().map(|size| size.unwrap_or(0)).collect();
    let mut waiting = None;
    let mut next = 0;
    for port in decl.ports() {
        let count = kernel::count(port.group.as_ref(), &known).unwrap_or(0);
        let source = draft.sources.get(next).filter(|_| draft.operands.get(next).is_some_and(Option::is_some));
        next += count;
        let (Some(source), true) = (source, names_unknown(&port.ty, &sizes)) else {
            continue;
        };
        match source_shape(scope, source) {
            Found::Type(ty) => take_sizes(&port.ty, ty, &mut sizes),
            Found::Later(signal) => waiting = waiting.or(Some(signal)),
            Found::Spoiled => return Inferred::Spoiled,
        }
    }
    match (sizes.iter().all(Option::is_some), waiting) {
        (true, _) => Inferred::All(sizes),
        (false, Some(signal)) => Inferred::Waiting(signal),
        (false, None) => Inferred::Unwired,
    }
}

fn names_unknown(ty: &TypeExpr, sizes: &[Option<i32>]) -> bool {
    let unknown = |expr: &Expr| matches!(expr, Expr::Size(i) if sizes.get(*i) == Some(&None));
    match ty {
        TypeExpr::Vector(_, n) => unknown(n),
        TypeExpr::Matrix(_, r, c) => unknown(r) || unknown(c),
        TypeExpr::Scalar(_) | TypeExpr::Text | TypeExpr::Time => false,
    }
}

fn take_sizes(declared: &TypeExpr, found: Type, sizes: &mut [Option<i32>]) {
    let (rows, columns) = found.rows_columns();
    let mut take = |expr: &Expr, value: u32| {
        if let Expr::Size(i) = expr {
            let size = &mut sizes[*i];
            *size = size.or(i32::try_from(value).ok());
        }
    };
    match declared {
        TypeExpr::Vector(_, n) => take(n, rows.saturating_mul(columns)),
        TypeExpr::Matrix(_, r, c) => {
            take(r, rows);
            take(c, columns);
        }
        TypeExpr::Scalar(_) | TypeExpr::Text | TypeExpr::Time => {}
    }
}

/// What is known of the type at a port.
pub(crate) enum Found {
    Type(Type),
    Later(SignalId),
    Spoiled,
}

/// The type of what is wired to a port.
pub(crate) fn source_shape(scope: &Scope<'_>, source: &Source) -> Found {
    let of = |id: &SignalId| {
        let wire = scope.wire(*id);
        match wire.ty {
            _ if wire.spoiled => Found::Spoiled,
            Some(ty) => Found::Type(ty),
            None => Found::Later(*id),
        }
    };
    match source {
        Source::Signal(id) | Source::Copied(id) => of(id),
        Source::Element(id, _) => match of(id) {
            Found::Type(ty) => Found::Type(Type { scalar: ty.scalar, shape: Shape::Scalar }),
            other => other,
        },
        Source::Constant(value) => Found::Type(constant_type(value)),
        Source::Own(_, scalar) => Found::Type(Type { scalar: *scalar, shape: Shape::Scalar }),
        Source::Cell(id) => Found::Type(scope.cells[id.0 as usize].ty),
    }
}

/// The type of a literal or default.
pub(crate) fn constant_type(value: &pcl2_lang::types::Value) -> Type {
    use pcl2_lang::types::{Scalar, Value};
    match value {
        Value::Int(_) | Value::Text(_) => Type::INT,
        Value::Real(_) => Type::REAL,
        Value::Ints(values) => Type { scalar: Scalar::Int, shape: Shape::Vector(values.len() as u32) },
        Value::Reals(values) => Type { scalar: Scalar::Real, shape: Shape::Vector(values.len() as u32) },
    }
}

/// All variables and all memory of the block must have a size that can be.
fn check_fields(
    scope: &Scope<'_>,
    index: usize,
    decl: &Decl,
    sizes: &[i32],
    diagnostics: &mut Vec<Diagnostic>,
) -> bool {
    let fields = decl.memory.iter().chain(&decl.work).chain(&decl.tuned).map(|field| (&field.name, &field.ty));
    let places = decl.outputs.iter().map(|output| (&output.name, &output.ty));
    let params = decl.params.iter().map(|param| (&param.name, &param.ty));
    let ports = decl.ports().map(|port| (&port.name, &port.ty));
    for (name, ty) in places.chain(params).chain(ports).chain(fields) {
        let sized = matches!(ty, TypeExpr::Text | TypeExpr::Time) || kernel::resolve(ty, sizes).is_some();
        if !sized {
            let draft = &scope.drafts[index];
            let message = format!(
                "expected `{name}` of {} with 0 to {MAX_ELEMENTS} elements, found {}",
                decl.name,
                size_text(ty, sizes)
            );
            diagnostics.push(Diagnostic::new(codes::TOO_LARGE, draft.statement.code.span, message));
            return false;
        }
    }
    true
}

fn size_text(ty: &TypeExpr, sizes: &[i32]) -> String {
    let value = |expr: &Expr| kernel::size(expr, sizes).map_or("no size".to_owned(), |n| n.to_string());
    match ty {
        TypeExpr::Vector(_, n) => value(n),
        TypeExpr::Matrix(_, r, c) => format!("{} x {}", value(r), value(c)),
        TypeExpr::Scalar(_) | TypeExpr::Text | TypeExpr::Time => "1".to_owned(),
    }
}

fn set_type(scope: &mut Scope<'_>, index: usize, output: usize, ty: Type, diagnostics: &mut Vec<Diagnostic>) {
    let Some(id) = scope.drafts[index].outputs.get(output).copied() else {
        return;
    };
    let wire = &mut scope.wires[id.0 as usize];
    match wire.ty {
        None => wire.ty = Some(ty),
        Some(known) if known == ty || wire.spoiled => {}
        Some(known) => {
            let others = wire.writers.iter().map(|writer| writer.block.0 as usize).filter(|other| *other != index);
            let first = others.min_by_key(|other| scope.drafts[*other].number);
            let wire = &mut scope.wires[id.0 as usize];
            let name = wire.name.clone();
            wire.spoiled = true;
            let draft = &scope.drafts[index];
            let at = draft.statement.outputs.get(output).map_or(draft.statement.code.span, |o| o.span());
            let first = first.map(|first| &scope.drafts[first]);
            let is = if first.is_some() { "is elsewhere" } else { "is declared" };
            let message = format!("{}: expected {known} for `{name}`, as it {is}, found {ty}", draft.title());
            let report = Diagnostic::new(codes::TYPE_DIFFERS, at, message);
            let report = match first {
                Some(first) => report.label(writer_span(first, id), format!("{} makes it {known}", first.title())),
                None => report,
            };
            diagnostics.push(report.help("a variable has one type and size in the whole file"));
        }
    }
}

fn writer_span(draft: &Draft<'_>, id: SignalId) -> Span {
    let output = draft.outputs.iter().position(|output| *output == id).unwrap_or(0);
    draft.statement.outputs.get(output).map_or(draft.statement.code.span, |output| output.span())
}

fn spoil(scope: &mut Scope<'_>, index: usize) {
    scope.drafts[index].spoiled = true;
    for id in &scope.drafts[index].outputs {
        scope.wires[id.0 as usize].spoiled = true;
    }
}

fn report_unknown_size(
    scope: &mut Scope<'_>,
    index: usize,
    (found, help): (&str, &str),
    diagnostics: &mut Vec<Diagnostic>,
) {
    let draft = &scope.drafts[index];
    let Some(decl) = draft.decl else {
        return;
    };
    let missing = draft.sizes.iter().position(Option::is_none).map_or("", |i| decl.sizes[i].name.as_str());
    let message =
        format!("{}: expected ports that tell the size `{missing}` of {}, found {found}", draft.title(), decl.name);
    let report = Diagnostic::new(codes::UNKNOWN_SIZE, draft.statement.code.span, message);
    diagnostics.push(report.help(help));
    spoil(scope, index);
}

fn check_ports<'a>(input: &Input<'a>, scope: &mut Scope<'a>, index: usize, diagnostics: &mut Vec<Diagnostic>) {
    let draft = &scope.drafts[index];
    let Some(decl) = draft.decl.filter(|_| !draft.spoiled) else {
        return;
    };
    if draft.formula.is_some() {
        return formula::check(input, scope, index, diagnostics);
    }
    let Some(sizes) = draft.known_sizes() else {
        return;
    };
    let mut next = 0;
    for port in decl.ports() {
        let want = kernel::resolve(&port.ty, &sizes);
        for _ in 0..kernel::count(port.group.as_ref(), &sizes).unwrap_or(0) {
            if let Some(want) = want {
                check_port(input, scope, index, next, port, want, diagnostics);
            }
            next += 1;
        }
    }
}

fn check_port<'a>(
    input: &Input<'a>,
    scope: &mut Scope<'a>,
    index: usize,
    next: usize,
    port: &PortDecl,
    want: Type,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let Some(source) = scope.drafts[index].sources.get(next).cloned() else {
        return;
    };
    let operand = scope.drafts[index].operands.get(next).copied().flatten();
    if let (None, Some(default)) = (operand, &port.default) {
        return fill(scope, &source, (index, next), spread(default.clone(), want), want);
    }
    let Found::Type(mut found) = source_shape(scope, &source) else {
        return;
    };
    if let (Source::Element(id, known), Some(place)) = (&source, operand) {
        let Some(whole) = scope.wire(*id).ty else {
            return;
        };
        let Some(element) = element(scope, *id, whole, (&place.value, *known), diagnostics) else {
            scope.drafts[index].spoiled = true;
            return;
        };
        scope.drafts[index].sources[next] = Source::Element(*id, element);
        found = Type { scalar: whole.scalar, shape: Shape::Scalar };
    }
    if let Source::Signal(id) = source {
        if !found.is_scalar() && scope.drafts[index].outputs.contains(&id) {
            scope.drafts[index].sources[next] = Source::Copied(id);
        }
    }
    if !fits(found, want) {
        let report = misfit(input, scope, index, port, (want, found), &source, operand.map(|place| place.span));
        diagnostics.push(report);
        scope.drafts[index].spoiled = true;
    }
}

/// An unconnected port takes its default in full size, now that sizes are known.
fn fill(scope: &mut Scope<'_>, source: &Source, (index, port): (usize, usize), value: Value, ty: Type) {
    if let Source::Cell(id) = source {
        let cell = &mut scope.cells[id.0 as usize];
        (cell.ty, cell.initial) = (ty, value);
    } else {
        scope.drafts[index].sources[port] = Source::Constant(value);
    }
}

/// The flat place of `a[1]` or `m[1,2]`.
pub(crate) fn element(
    scope: &Scope<'_>,
    id: SignalId,
    whole: Type,
    (operand, known): (&Operand, u32),
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<u32> {
    let wire = scope.wire(id);
    // The elements of what a net keeps have names of their own, and were found by them.
    let Operand::Element(element) = operand else {
        return Some(known);
    };
    if wire.name == BOX_OUTPUT && wire.role == Role::Held {
        return Some(known);
    }
    let (name, indexes) = &**element;
    let mut complain = |span: Span, message: String| {
        diagnostics.push(
            Diagnostic::new(codes::INDEX_RANGE, span, message).label(wire.span, format!("`{}` is {whole}", wire.name)),
        );
    };
    let dimensions: &[u32] = match whole.shape {
        Shape::Scalar => &[],
        Shape::Vector(n) => &[n],
        Shape::Matrix(r, c) => &[r, c],
    };
    if dimensions.len() != indexes.len() {
        let message = match dimensions.len() {
            0 => format!("expected `{}` without an index, found one", wire.name),
            n => format!(
                "expected {n} index{} for `{}`, found {}",
                if n == 1 { "" } else { "es" },
                wire.name,
                indexes.len()
            ),
        };
        complain(name.span, message);
        return None;
    }
    let mut flat = 0;
    for ((index, span), dimension) in indexes.iter().zip(dimensions) {
        let Some(zero_based) = u32::try_from(*index).ok().and_then(|i| i.checked_sub(1)).filter(|i| i < dimension)
        else {
            complain(*span, format!("expected an index from 1 to {dimension}, found {index}"));
            return None;
        };
        flat = flat * dimension + zero_based;
    }
    Some(flat)
}

fn misfit<'a>(
    input: &Input<'a>,
    scope: &Scope<'a>,
    index: usize,
    port: &PortDecl,
    (want, found): (Type, Type),
    source: &Source,
    place: Option<Span>,
) -> Diagnostic {
    let draft = &scope.drafts[index];
    let code = draft.decl.map_or("", |decl| decl.name.as_str());
    let span = place.unwrap_or(draft.statement.code.span);
    let text = input.sources.text(span);
    let message = format!("{}: `{}` of {code} needs {want}, `{text}` is {found}", draft.title(), port.name);
    let mut report = Diagnostic::new(codes::TYPE_DIFFERS, span, message);
    if let Some(id) = source.signal() {
        let wire = scope.wire(id);
        if let Some(writer) = wire.writers.first().map(|writer| &scope.drafts[writer.block.0 as usize]) {
            report = report.label(writer_span(writer, id), format!("{} makes it {found}", writer.title()));
        }
    }
    let int_to_real = want.scalar != found.scalar && want.is_scalar() && found.is_scalar();
    if int_to_real {
        report = report.help("a real does not fit an int port: an int port takes truth values, counts and choices");
    }
    report
}

/// In a composite, each output must be written under its name.
fn check_written<'a>(input: &Input<'a>, scope: &mut Scope<'a>, diagnostics: &mut Vec<Diagnostic>) {
    let Some((decl, sizes)) = scope.owner.clone() else {
        return;
    };
    for name in crate::number::output_names(decl, &sizes) {
        let id = input.symbols.find(&name).and_then(|symbol| scope.by_name.get(symbol));
        let written = |id: &SignalId| {
            let wire = scope.wire(*id);
            !wire.writers.is_empty() || wire.spoiled || wire.role == Role::Held
        };
        let Some(id) = id.filter(written) else {
            let message = format!("expected a statement that writes the output `{name}` of {}, found none", decl.name);
            diagnostics.push(Diagnostic::new(codes::BAD_DECLARATION, decl.span, message));
            continue;
        };
        let index = scope.outputs.len();
        scope.outputs.push(id);
        let want = pcl2_lang::model::output_decl(decl, &sizes, index)
            .and_then(|o| kernel::resolve(&decl.outputs[o].ty, &sizes));
        let found = scope.wire(id).ty;
        if let (Some(want), Some(found)) = (want, found.filter(|_| !scope.wire(id).spoiled)) {
            if want != found {
                let message = format!("expected {want} for the output `{name}` of {}, found {found}", decl.name);
                diagnostics.push(
                    Diagnostic::new(codes::TYPE_DIFFERS, scope.wire(id).span, message)
                        .label(decl.span, "declared here"),
                );
            }
        }
    }
}
