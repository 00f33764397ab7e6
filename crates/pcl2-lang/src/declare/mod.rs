//! `.fc` files -> declarations.

pub mod net;
pub mod raw;

use crate::ast::{Line, Name, Number, Operand, Statement};
use crate::bounds;
use crate::codes;
use crate::decl::{
    BadRule, Bounds, ConstantDecl, Decl, Direction, Example, Expr, Fault, Field, Group, Image, Item, OutputDecl,
    ParamDecl, PortDecl, RETURN_OUTPUT, SizeVar, Tail, TypeExpr,
};
use crate::diagnostic::Diagnostic;
use crate::kernel;
use crate::lexer::{Key, Token};
use crate::source::{FileId, Sources, Span};
use crate::symbol::Symbols;
use crate::syntax::{Context, Lines, Words, parse_body_line, parse_declaration_line};
use crate::types::{Real, Scalar, Value, Width};
use raw::Raw;

/// What one file declares.
#[derive(Clone, Debug, Default)]
pub struct Declared {
    /// The declarations without mistakes.
    pub decls: Vec<Decl>,
    /// The names of those with mistakes: not unknown, but nothing is known of them.
    pub spoiled: Vec<String>,
}

/// Reads the declarations of one file. `group` and `stem` say where it stands.
pub fn read(
    sources: &Sources,
    file: FileId,
    group: &str,
    stem: &str,
    symbols: &mut Symbols,
    diagnostics: &mut Vec<Diagnostic>,
) -> Declared {
    let source = sources.file(file);
    let mut context = Context::new(source, file, symbols, diagnostics);
    let mut lines = Lines::declarations(source, file);
    let mut declared = Declared::default();
    if !context.is_text(source) {
        declared.spoiled.push(stem.to_owned());
        return declared;
    }
    let mut current: Option<Decl> = None;
    let mut sound = mistakes(&mut context);
    while let Some(broken) = lines.next_line(context.diagnostics()) {
        let (first, start) = (lines.tokens[0].token, lines.tokens[0].start);
        let line = if broken { None } else { parse_declaration_line(&mut context, &lines) };
        match (line, &mut current) {
            (Some(Raw::Head(outputs, call)), _) => {
                finish(&mut context, current.take(), &mut sound, &mut declared);
                let mut decl = head(&mut context, &outputs, &call);
                decl.doc = comment_above(&source.text, start as usize);
                (decl.group, decl.stem) = (group.to_owned(), stem.to_owned());
                current = Some(decl);
            }
            (Some(Raw::Clause(found)), Some(decl)) => clause(&mut context, &mut lines, decl, found),
            (Some(Raw::Clause(found)), None) => {
                if declared.decls.is_empty() && declared.spoiled.is_empty() {
                    let span = context.span(start, lines.position());
                    complain(&mut context, span, "expected a declaration before its clauses, found a clause");
                    declared.spoiled.push(String::new());
                }
                skip_program(&mut context, &mut lines, matches!(found, raw::Clause::Example(..) | raw::Clause::Body));
            }
            (None, _) if is_clause_word(first) => {
                skip_program(&mut context, &mut lines, matches!(first, Token::Key(Key::Example | Key::Body)));
            }
            (None, _) => {
                finish(&mut context, current.take(), &mut sound, &mut declared);
                declared.spoiled.extend(head_name(&context, &lines));
                sound = mistakes(&mut context);
            }
        }
    }
    finish(&mut context, current, &mut sound, &mut declared);
    declared
}

/// Ends a declaration: it is known if nothing was said about it since `sound`.
fn finish(context: &mut Context<'_>, decl: Option<Decl>, sound: &mut usize, declared: &mut Declared) {
    let Some(decl) = decl else {
        return;
    };
    if mistakes(context) == *sound {
        check(context, &decl);
    }
    let before = std::mem::replace(sound, mistakes(context));
    if *sound == before {
        declared.decls.push(decl);
    } else {
        declared.spoiled.push(decl.name);
    }
}

/// How many errors there are so far; a warning is no mistake.
fn mistakes(context: &mut Context<'_>) -> usize {
    context.diagnostics().iter().filter(|diagnostic| diagnostic.is_error()).count()
}

fn is_clause_word(token: Token) -> bool {
    matches!(token, Token::Key(key) if key.begins_line())
}

/// The name before the parenthesis of a head that could not be read.
fn head_name(context: &Context<'_>, lines: &Lines<'_>) -> Option<String> {
    let paren = lines.tokens.iter().position(|lexeme| lexeme.token == Token::LeftParen)?;
    let name = lines.tokens.get(paren.checked_sub(1)?)?;
    (name.token == Token::Name).then(|| context.text(context.span(name.start, name.end)).to_owned())
}

/// Leaves out the program of an example or a body whose declaration is not understood.
fn skip_program(context: &mut Context<'_>, lines: &mut Lines<'_>, has_program: bool) {
    if has_program {
        let span = context.span(lines.tokens[0].start, lines.position());
        text_until_end(context, lines, span);
    }
}

fn complain(context: &mut Context<'_>, span: Span, message: impl Into<String>) {
    context.diagnostics().push(Diagnostic::new(codes::BAD_DECLARATION, span, message));
}

/// The `!` lines that stand directly above a place, without the `!`.
fn comment_above(text: &str, start: usize) -> String {
    let above = text[..start].trim_end_matches([' ', '\t']);
    let mut lines: Vec<&str> = Vec::new();
    for line in above.lines().rev() {
        let Some(comment) = line.trim().strip_prefix('!') else {
            break;
        };
        lines.push(comment.strip_prefix(' ').unwrap_or(comment).trim_end());
    }
    lines.reverse();
    lines.join("\n")
}

fn head(context: &mut Context<'_>, outputs: &[raw::Output], call: &raw::Call) -> Decl {
    let name = context.symbol_text(call.name.symbol).to_owned();
    let mut decl = Decl::new(name, call.name.span);
    declare_sizes(context, &mut decl, call);
    for item in &call.items {
        let item = declare_item(context, &decl, item);
        decl.items.push(item);
    }
    for param in &call.params {
        let ty = declare_type(context, &decl, &param.ty);
        let tail = declare_tail(context, &decl, &param.tail);
        let default = param.default.as_ref().and_then(|v| default_value(context, v, &ty, &tail));
        let name = context.symbol_text(param.name.symbol).to_owned();
        decl.params.push(ParamDecl { name, ty, fixed: param.fixed, default, tail });
    }
    check_defaults(context, &decl, call);
    for output in outputs {
        let ty = declare_type(context, &decl, &output.ty);
        let tail = declare_tail(context, &decl, &output.tail);
        let group = declare_group(context, &decl, output.group.as_ref());
        let name = context.symbol_text(output.name.symbol).to_owned();
        decl.outputs.push(OutputDecl {
            by_name: name == RETURN_OUTPUT,
            name,
            ty,
            inout: output.inout,
            group,
            tail,
            elements: Vec::new(),
        });
    }
    decl
}

/// A default must be in its own range, as far as that is known without sizes and without values for other places.
fn check_defaults(context: &mut Context<'_>, decl: &Decl, call: &raw::Call) {
    let unknown = || Value::Text("".into());
    let values: Vec<Value> = decl.params.iter().map(|param| param.default.clone().unwrap_or_else(unknown)).collect();
    if let Err(found) = bounds::check(decl, &[], &values, Width::F64) {
        let name = &decl.params[found.param].name;
        let message = format!("expected a default of `{name}` {}, found {}", found.expected, found.found);
        complain(context, call.params[found.param].name.span, message);
    }
    for (item, written) in decl.items.iter().zip(&call.items) {
        let (Item::Port(port), raw::Item::Port(written)) = (item, written) else {
            continue;
        };
        let value = match port.default {
            Some(Value::Int(value)) => f64::from(value),
            Some(Value::Real(value)) if value.wide.is_finite() => value.wide,
            _ => continue,
        };
        if let Some(expected) = bounds::check_value(&port.tail, value, &[]) {
            let message = format!("expected a default of `{}` {expected}, found {}", port.name, bounds::show(value));
            complain(context, written.name.span, message);
        }
    }
}

/// Constants first, in order, then names that only port types mention.
fn declare_sizes(context: &mut Context<'_>, decl: &mut Decl, call: &raw::Call) {
    for (i, item) in call.items.iter().enumerate() {
        if let raw::Item::Constant(name, _) = item {
            decl.sizes.push(SizeVar { name: context.symbol_text(name.symbol).to_owned(), constant: Some(i) });
        }
    }
    for item in &call.items {
        let raw::Item::Port(port) = item else {
            continue;
        };
        let mut names = Vec::new();
        match &port.ty {
            raw::Type::Vec(n) | raw::Type::Ivec(n) => size_names(n, &mut names),
            raw::Type::Mat(r, c) | raw::Type::Imat(r, c) => {
                size_names(r, &mut names);
                size_names(c, &mut names);
            }
            raw::Type::Int | raw::Type::Real | raw::Type::Text | raw::Type::Time => {}
        }
        for name in names {
            let text = context.symbol_text(name.symbol);
            if !decl.sizes.iter().any(|size| size.name == text) {
                decl.sizes.push(SizeVar { name: text.to_owned(), constant: None });
            }
        }
    }
}

/// A size that stands alone can be taken from the port.
fn size_names(expr: &raw::Expr, names: &mut Vec<Name>) {
    if let raw::Expr::Name(name) = expr {
        names.push(*name);
    }
}

fn declare_item(context: &mut Context<'_>, decl: &Decl, item: &raw::Item) -> Item {
    match item {
        raw::Item::Literal(value) => Item::Literal(*value),
        raw::Item::Constant(name, bounds) => {
            let text = context.symbol_text(name.symbol).to_owned();
            let size = decl.sizes.iter().position(|size| size.name == text).unwrap_or(0);
            let bounds = declare_bounds(context, decl, bounds.as_ref());
            Item::Constant(ConstantDecl { name: text, size, bounds })
        }
        raw::Item::Port(port) => {
            let ty = declare_type(context, decl, &port.ty);
            let tail = declare_tail(context, decl, &port.tail);
            let default = port.default.as_ref().and_then(|v| port_default(context, v, &ty, &tail));
            let group = declare_group(context, decl, port.group.as_ref());
            if port.cell && default.is_none() {
                complain(context, port.name.span, "expected a default for an operator cell, found none");
            }
            Item::Port(Box::new(PortDecl {
                name: context.symbol_text(port.name.symbol).to_owned(),
                ty,
                cell: port.cell,
                group,
                default,
                tail,
                tracks: port.tracks.map(|name| context.symbol_text(name.symbol).to_owned()),
            }))
        }
    }
}

fn declare_group(
    context: &mut Context<'_>,
    decl: &Decl,
    group: Option<&(raw::Expr, Option<raw::Range>)>,
) -> Option<Group> {
    let (count, bounds) = group?;
    let count = declare_size(context, decl, count);
    Some(Group { count, bounds: declare_bounds(context, decl, bounds.as_ref()) })
}

fn declare_type(context: &mut Context<'_>, decl: &Decl, ty: &raw::Type) -> TypeExpr {
    let mut expr = |e: &raw::Expr| declare_size(context, decl, e);
    match ty {
        raw::Type::Int => TypeExpr::Scalar(Scalar::Int),
        raw::Type::Real => TypeExpr::Scalar(Scalar::Real),
        raw::Type::Text => TypeExpr::Text,
        raw::Type::Time => TypeExpr::Time,
        raw::Type::Ivec(n) => TypeExpr::Vector(Scalar::Int, expr(n)),
        raw::Type::Vec(n) => TypeExpr::Vector(Scalar::Real, expr(n)),
        raw::Type::Imat(r, c) => TypeExpr::Matrix(Scalar::Int, expr(r), expr(c)),
        raw::Type::Mat(r, c) => TypeExpr::Matrix(Scalar::Real, expr(r), expr(c)),
    }
}

/// An expression over literals and sizes: what a type needs is known before any parameter.
fn declare_size(context: &mut Context<'_>, decl: &Decl, expr: &raw::Expr) -> Expr {
    let before = context.diagnostics().len();
    let size = declare_expr(context, decl, expr);
    if context.diagnostics().len() == before && !is_size(&size) {
        complain(
            context,
            decl.span,
            "expected a size of integers, constants and sizes of ports, found a parameter or a real in it",
        );
    }
    size
}

fn is_size(expr: &Expr) -> bool {
    match expr {
        Expr::Int(_) | Expr::Size(_) => true,
        Expr::Real(_) | Expr::Param(_) => false,
        Expr::Negate(a) => is_size(a),
        Expr::Add(a, b) | Expr::Subtract(a, b) | Expr::Multiply(a, b) | Expr::Divide(a, b) => is_size(a) && is_size(b),
    }
}

fn declare_tail(context: &mut Context<'_>, decl: &Decl, tail: &raw::Tail) -> Tail {
    Tail {
        unit: tail.unit.map(|span| context.text(span).to_owned()),
        bounds: declare_bounds(context, decl, tail.bounds.as_ref()),
        names: tail.names.iter().map(|name| context.symbol_text(name.symbol).to_owned()).collect(),
    }
}

fn declare_bounds(context: &mut Context<'_>, decl: &Decl, range: Option<&raw::Range>) -> Option<Bounds> {
    let range = range?;
    let lower = range.lower.as_ref().map(|bound| declare_expr(context, decl, &bound.expr));
    let upper = range.upper.as_ref().map(|expr| declare_expr(context, decl, expr));
    Some(Bounds { lower, above: range.lower.as_ref().is_some_and(|bound| bound.above), upper })
}

fn declare_expr(context: &mut Context<'_>, decl: &Decl, expr: &raw::Expr) -> Expr {
    match expr {
        raw::Expr::Number(Number::Int(value)) => Expr::Int(*value),
        raw::Expr::Number(Number::Real(value)) => Expr::Real(*value),
        raw::Expr::Name(name) => declare_name(context, decl, *name),
        raw::Expr::Negate(a, _) => Expr::Negate(Box::new(declare_expr(context, decl, a))),
        raw::Expr::Binary(a, sign, b, _) => {
            let a = Box::new(declare_expr(context, decl, a));
            let b = Box::new(declare_expr(context, decl, b));
            match sign {
                '+' => Expr::Add(a, b),
                '-' => Expr::Subtract(a, b),
                '*' => Expr::Multiply(a, b),
                _ => Expr::Divide(a, b),
            }
        }
    }
}

fn declare_name(context: &mut Context<'_>, decl: &Decl, name: Name) -> Expr {
    let text = context.symbol_text(name.symbol);
    if let Some(size) = decl.sizes.iter().position(|size| size.name == text) {
        return Expr::Size(size);
    }
    if let Some(param) = decl.params.iter().position(|param| param.name == text) {
        return Expr::Param(param);
    }
    let message = format!("expected a constant, a port's size or an earlier parameter, found `{text}`");
    complain(context, name.span, message);
    Expr::Int(0)
}

/// The default of a real port may be the bad signal: nothing is wired, or no operator wrote yet.
fn port_default(context: &mut Context<'_>, value: &raw::Value, ty: &TypeExpr, tail: &Tail) -> Option<Value> {
    match value {
        raw::Value::Name(name) if is_real(ty) && context.symbol_text(name.symbol) == "bad" => {
            Some(Value::Real(Real::BAD))
        }
        _ => default_value(context, value, ty, tail),
    }
}

fn is_real(ty: &TypeExpr) -> bool {
    match ty {
        TypeExpr::Scalar(scalar) | TypeExpr::Vector(scalar, _) | TypeExpr::Matrix(scalar, ..) => {
            *scalar == Scalar::Real
        }
        TypeExpr::Text | TypeExpr::Time => false,
    }
}

/// A default value. One value for a vector stands for each element, so it stays a scalar here.
fn default_value(context: &mut Context<'_>, value: &raw::Value, ty: &TypeExpr, tail: &Tail) -> Option<Value> {
    let scalar = match ty {
        TypeExpr::Scalar(scalar) | TypeExpr::Vector(scalar, _) | TypeExpr::Matrix(scalar, ..) => Some(*scalar),
        TypeExpr::Text | TypeExpr::Time => None,
    };
    match (value, scalar) {
        (raw::Value::Number(Number::Int(value), _), Some(Scalar::Int)) => Some(Value::Int(*value)),
        (raw::Value::Number(Number::Int(value), _), Some(Scalar::Real)) => Some(Value::Real(Real::from_int(*value))),
        (raw::Value::Number(Number::Real(value), _), Some(Scalar::Real)) => Some(Value::Real(*value)),
        (raw::Value::Text(span), None) => Some(Value::Text(context.text(*span).into())),
        (raw::Value::Name(name), Some(Scalar::Int)) => {
            let text = context.symbol_text(name.symbol).to_owned();
            let index = tail.names.iter().position(|known| *known == text);
            if index.is_none() {
                complain(context, name.span, format!("expected one of the names of the enumeration, found `{text}`"));
            }
            index.map(|index| Value::Int(index as i32))
        }
        (raw::Value::Name(name), _) => {
            complain(context, name.span, "expected a number, found a name");
            None
        }
        (raw::Value::Text(span), Some(_)) => {
            complain(context, *span, "expected a number, found a text");
            None
        }
        (raw::Value::Number(_, span), found) => {
            let expected = if found == Some(Scalar::Int) { "an integer" } else { "a text" };
            let message = format!("expected {expected}, found `{}`", context.text(*span));
            complain(context, *span, message);
            None
        }
    }
}

fn clause(context: &mut Context<'_>, lines: &mut Lines<'_>, decl: &mut Decl, clause: raw::Clause) {
    match clause {
        raw::Clause::Memory(list) => decl.memory.extend(fields(context, decl, &list)),
        raw::Clause::Work(list) => decl.work.extend(fields(context, decl, &list)),
        raw::Clause::Tuned(list) => decl.tuned.extend(fields(context, decl, &list)),
        raw::Clause::Start(names) => start(context, decl, &names),
        raw::Clause::Retain(names) => retain(context, decl, &names),
        raw::Clause::Return(name) => returns(context, decl, name),
        raw::Clause::Period => decl.period = true,
        raw::Clause::Check => decl.check = true,
        raw::Clause::Image(direction, scalar) => image(context, decl, direction, scalar),
        raw::Clause::Faults(faults) => {
            decl.faults.extend(faults.iter().map(|(name, text)| Fault {
                name: context.symbol_text(name.symbol).to_owned(),
                text: context.text(*text).to_owned(),
            }));
        }
        raw::Clause::Bad(name) => bad(context, decl, name),
        raw::Clause::Inline => decl.inline = true,
        raw::Clause::Simulated => decl.simulated = true,
        raw::Clause::Operator(sign) => {
            let text = sign.map(|span| context.text(span).trim_start_matches("OPERATOR").trim().trim_matches('"'));
            decl.operator = Some(text.unwrap_or("").to_owned());
        }
        raw::Clause::Example(span, signal, values, after, period) => {
            let example = Example {
                signal: signal_name(context, &signal),
                values: values.iter().map(|span| context.text(*span).split_whitespace().collect()).collect(),
                after: after.unwrap_or(1),
                period: period.map(|span| context.text(span).to_owned()),
                program: text_until_end(context, lines, span),
                span,
            };
            decl.examples.push(example);
        }
        raw::Clause::Body => decl.body = Some(body(context, lines)),
        raw::Clause::End => complain(context, decl.span, "expected a clause, found END without BODY or EXAMPLE"),
    }
}

fn fields(context: &mut Context<'_>, decl: &Decl, list: &[raw::Field]) -> Vec<Field> {
    list.iter()
        .map(|field| Field {
            name: context.symbol_text(field.name.symbol).to_owned(),
            ty: declare_type(context, decl, &field.ty),
        })
        .collect()
}

fn start(context: &mut Context<'_>, decl: &mut Decl, names: &[Name]) {
    for name in names {
        let text = context.symbol_text(name.symbol).to_owned();
        match decl.outputs.iter().position(|output| output.name == text) {
            Some(index) => decl.start.push(index),
            None => complain(context, name.span, format!("expected the name of an output, found `{text}`")),
        }
    }
}

fn retain(context: &mut Context<'_>, decl: &mut Decl, names: &[Name]) {
    for name in names {
        let text = context.symbol_text(name.symbol).to_owned();
        let known =
            decl.outputs.iter().any(|output| output.name == text) || decl.memory.iter().any(|field| field.name == text);
        if !known {
            complain(context, name.span, format!("expected the name of an output or of memory, found `{text}`"));
        }
        decl.retain.push(text);
    }
}

/// The port that `bk` answers: as many of one as of the other.
fn returns(context: &mut Context<'_>, decl: &mut Decl, name: Name) {
    let text = context.symbol_text(name.symbol).to_owned();
    let Some(index) = decl.ports().position(|port| port.name == text) else {
        return complain(context, name.span, format!("expected the name of a port, found `{text}`"));
    };
    let count = |group: Option<&Group>| group.map(|group| group.count.clone());
    let port = decl.ports().nth(index).map(|port| (port.ty.clone(), count(port.group.as_ref())));
    let pair = TypeExpr::Vector(Scalar::Real, Expr::Int(2));
    let wire = decl.outputs.iter().find(|output| output.name == RETURN_OUTPUT && output.ty == pair);
    let answers = |(ty, group): (TypeExpr, Option<Expr>)| {
        ty == TypeExpr::Scalar(Scalar::Real) && wire.is_some_and(|wire| count(wire.group.as_ref()) == group)
    };
    if port.is_some_and(answers) {
        decl.returns = Some(index);
    } else {
        let message =
            format!("expected a real port and as many outputs vec[2] {RETURN_OUTPUT} for RETURN, found others");
        complain(context, name.span, message);
    }
}

fn image(context: &mut Context<'_>, decl: &mut Decl, name: Name, scalar: Scalar) {
    let direction = match context.symbol_text(name.symbol) {
        "in" => Direction::In,
        "out" => Direction::Out,
        _ => return complain(context, name.span, "expected `in` or `out`, found another word"),
    };
    decl.image = Some(Image { direction, scalar });
}

fn bad(context: &mut Context<'_>, decl: &mut Decl, name: Name) {
    decl.bad = match context.symbol_text(name.symbol) {
        "A" => Some(BadRule::Algebraic),
        "H" => Some(BadRule::Hold),
        "S" => Some(BadRule::Select),
        "M" => Some(BadRule::Manual),
        "F" => Some(BadRule::Freeze),
        "L" => Some(BadRule::Logic),
        "O" => Some(BadRule::Output),
        _ => None,
    };
    if decl.bad.is_none() {
        complain(context, name.span, "expected one of the letters A, H, S, M, F, L and O, found another word");
    }
}

fn signal_name(context: &Context<'_>, signal: &Operand) -> String {
    match signal {
        Operand::Member(member) => {
            format!("{}.{}", context.symbol_text(member.0.symbol), context.symbol_text(member.1.symbol))
        }
        Operand::Name(name) => context.symbol_text(name.symbol).to_owned(),
        Operand::Empty | Operand::Element(..) | Operand::Number(_) | Operand::Text(_) => String::new(),
    }
}

/// The lines of an example, up to its END; the END belongs to them.
fn text_until_end(context: &mut Context<'_>, lines: &mut Lines<'_>, span: Span) -> String {
    let from = lines.position();
    let rest = context.text(context.span(from, u32::MAX));
    let mut length = 0;
    for line in rest.split_inclusive(['\n', '\r']) {
        length += line.len();
        if line.split('!').next().unwrap_or("").trim() == "END" {
            lines.jump(from + length as u32);
            return rest[..length].trim_start_matches(['\r', '\n']).to_owned();
        }
    }
    complain(context, span, "expected END after an example, found the end of the file");
    lines.jump(u32::MAX);
    String::new()
}

fn body(context: &mut Context<'_>, lines: &mut Lines<'_>) -> Vec<Statement> {
    let mut statements = Vec::new();
    lines.set_words(Words::Program);
    let mut ended = false;
    while let Some(broken) = lines.next_line(context.diagnostics()) {
        if broken {
            continue;
        }
        match parse_body_line(context, lines) {
            Some(Line::Block(statement)) => statements.push(*statement),
            Some(Line::End(_)) => {
                ended = true;
                break;
            }
            Some(Line::Initialize(span) | Line::Plant(span) | Line::Control(span, _) | Line::UnknownSection(span)) => {
                complain(context, span, "expected a statement or END in a BODY, found a section word");
            }
            None => {}
        }
    }
    if !ended {
        let span = context.span(u32::MAX, u32::MAX);
        complain(context, span, "expected END after BODY, found the end of the file");
    }
    lines.set_words(Words::Declarations);
    statements
}

/// What a declaration must not contradict.
fn check(context: &mut Context<'_>, decl: &Decl) {
    let mut names: Vec<&str> = decl.ports().map(|port| port.name.as_str()).collect();
    names.extend(decl.params.iter().map(|param| param.name.as_str()));
    names.extend(decl.outputs.iter().map(|output| output.name.as_str()));
    names.extend(decl.sizes.iter().map(|size| size.name.as_str()));
    names.extend(decl.memory.iter().chain(&decl.work).chain(&decl.tuned).map(|field| field.name.as_str()));
    names.sort_unstable();
    if let Some(twice) = names.windows(2).find(|pair| pair[0] == pair[1]) {
        complain(context, decl.span, format!("expected each name once in a declaration, found `{}` twice", twice[0]));
    }
    let places = decl.outputs.iter().map(|output| (&output.name, &output.ty));
    let places: Vec<_> = places.chain(decl.ports().map(|port| (&port.name, &port.ty))).collect();
    for (name, _) in places.into_iter().filter(|(_, ty)| matches!(ty, TypeExpr::Text | TypeExpr::Time)) {
        let message = format!("expected a number, a vector or a matrix for the port `{name}`, found text or time");
        complain(context, decl.span, message);
    }
    for param in decl.params.iter().filter(|param| param.ty == TypeExpr::Time) {
        let message = format!("expected a number, a vector, a matrix or text for `{}`, found time", param.name);
        complain(context, decl.span, message);
    }
    if decl.period && decl.tuned.is_empty() {
        complain(context, decl.span, "expected TUNED beside PERIOD, to keep what the step needs, found none");
    }
    if decl.check && decl.faults.is_empty() {
        complain(context, decl.span, "expected FAULTS beside CHECK, to say what is refused, found none");
    }
    if decl.inline {
        check_inline(context, decl);
    }
    if decl.operator.is_some() {
        check_operator(context, decl);
    }
    check_tracks(context, decl);
}

/// The signs that expressions have, and with how many operands.
const SIGNS: [(&str, &[usize]); 10] = [
    ("+", &[2]),
    ("-", &[1, 2]),
    ("*", &[2]),
    ("/", &[2]),
    ("<", &[2]),
    ("<=", &[2]),
    (">", &[2]),
    (">=", &[2]),
    ("==", &[2]),
    ("<>", &[2]),
];

/// An operator is a pure function of scalars.
fn check_operator(context: &mut Context<'_>, decl: &Decl) {
    let port = |item: &Item| match item {
        Item::Port(port) => matches!(port.ty, TypeExpr::Scalar(_)) && port.group.is_none() && !port.cell,
        Item::Literal(_) | Item::Constant(_) => false,
    };
    let param = |param: &ParamDecl| matches!(param.ty, TypeExpr::Scalar(_)) && param.default.is_some();
    let scalar = kernel::returns_value(decl) && matches!(decl.outputs[0].ty, TypeExpr::Scalar(_));
    let pure = decl.has_kernel() && decl.image.is_none() && !decl.simulated && decl.work.is_empty();
    let places = !decl.items.is_empty() && decl.items.iter().all(port) && decl.params.iter().all(param);
    if !(scalar && pure && places) {
        let message = "expected an INLINE code with scalar ports, parameters with defaults and one scalar output for OPERATOR, found another";
        complain(context, decl.span, message);
    }
    let sign = decl.operator.as_deref().unwrap_or_default();
    let word = sign.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
        && !sign.starts_with(|first: char| !first.is_ascii_alphabetic());
    match SIGNS.iter().find(|(known, _)| *known == sign) {
        Some((_, counts)) if counts.contains(&decl.ports().count()) => {}
        None if word => {}
        Some(_) => {
            complain(context, decl.span, format!("expected as many ports as `{sign}` has operands, found others"))
        }
        None => {
            let signs: Vec<&str> = SIGNS.iter().map(|(sign, _)| *sign).collect();
            let message = format!("expected a name or one of {} for OPERATOR, found `{sign}`", signs.join(" "));
            complain(context, decl.span, message);
        }
    }
}

/// An INLINE code keeps nothing. Its one fault, if it has any, is that its result is bad although no input is.
fn check_inline(context: &mut Context<'_>, decl: &Decl) {
    if !(decl.memory.is_empty() && decl.tuned.is_empty()) {
        complain(context, decl.span, "expected an INLINE code without MEMORY and TUNED, found one of them");
    }
    if decl.faults.is_empty() {
        return;
    }
    let plain = decl.ports().all(|port| port.ty.is_scalar() && port.group.is_none());
    let real = kernel::returns_value(decl) && decl.outputs[0].ty == TypeExpr::Scalar(Scalar::Real);
    if decl.faults.len() > 1 || decl.check || !plain || !real {
        let message =
            "expected one fault, scalar ports and one real output of an INLINE code with FAULTS, found something else";
        complain(context, decl.span, message);
    }
}

fn check_tracks(context: &mut Context<'_>, decl: &Decl) {
    for port in decl.ports() {
        let tracked = port.tracks.as_ref();
        let known = tracked.is_none_or(|name| {
            decl.outputs.iter().any(|output| output.name == *name)
                || decl.memory.iter().any(|field| field.name == *name)
        });
        if !known {
            complain(context, decl.span, format!("expected `{}` to track an output or memory", port.name));
        }
    }
}
