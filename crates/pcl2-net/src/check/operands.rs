//! Pass 8: every name that conditions and statements read is one of the net.

use super::{Builder, Thing};
use pcl2_lang::ast::{Name, Operand, Output, Statement};
use pcl2_lang::codes;
use pcl2_lang::net::{BoxId, CAUSE, Kind, READY};
use pcl2_lang::source::Span;
use pcl2_lang::suggest;
use pcl2_lang::symbol::Symbol;

/// Looks at the operands of all statements.
pub(super) fn operands(builder: &mut Builder<'_>) {
    for statement in builder.statements.clone() {
        if !may_name_choices(builder, &statement) {
            statement.inputs().iter().for_each(|item| operand(builder, &item.value, &statement));
        }
        for output in &statement.outputs {
            if let Output::Member(owner, member) = output {
                written(builder, *owner, *member);
            }
        }
    }
    for place in builder.net.boxes.clone() {
        if let Kind::Time(time) = place.kind {
            no_box_as_time(builder, time.0 as usize);
        }
        if let Kind::Process(process) = place.kind {
            process.within.into_iter().for_each(|within| no_box_as_time(builder, within.0 as usize));
        }
    }
}

/// Whether a name that is read may be that of an input's value.
fn may_name_choices(builder: &Builder<'_>, statement: &Statement) -> bool {
    let code = builder.text(statement.code);
    let called = statement.formula.is_none() && !code.is_empty();
    let choices = builder.catalogue.find(&code).is_none_or(|decl| decl.ports().any(|port| !port.tail.names.is_empty()));
    called && choices
}

fn operand(builder: &mut Builder<'_>, operand: &Operand, statement: &Statement) {
    match operand {
        Operand::Name(name) => named(builder, *name, statement),
        Operand::Element(element) => {
            let (name, indexes) = (element.0, element.1.as_slice());
            let known = builder.names.contains_key(&name.symbol) || indexes.len() != 1;
            if !known && indexed(builder, name, indexes).is_none() {
                builder.unknown(name, EXPECTED);
            }
        }
        Operand::Member(member) => self::member(builder, member.0, member.1),
        Operand::Empty | Operand::Number(_) | Operand::Text(_) => {}
    }
}

const EXPECTED: &str = "an input, a parameter, an output, a local or a box";

fn named(builder: &mut Builder<'_>, name: Name, statement: &Statement) {
    if builder.names.contains_key(&name.symbol) {
        return;
    }
    if statement.counters.iter().any(|(counter, _)| counter.symbol == name.symbol) {
        let message = format!("expected {EXPECTED}, found the counter `{}`", builder.text(name));
        builder.complain(codes::NET_NAME, name.span, message, "counters stand in indexes only");
        return;
    }
    builder.unknown(name, EXPECTED);
}

/// `idle[3]` as the name of a box or a word, if there is one.
fn indexed(builder: &Builder<'_>, name: Name, indexes: &[(i32, Span)]) -> Option<Symbol> {
    let text = builder.text(name);
    let whole = indexes.first().and_then(|(index, _)| builder.symbols.find(&format!("{text}[{index}]")));
    whole.filter(|symbol| builder.names.contains_key(symbol))
}

/// An attribute of a box; what a part has is found out when its body is compiled.
fn member(builder: &mut Builder<'_>, owner: Name, member: Name) {
    match builder.names.get(&owner.symbol).map(|(thing, _)| *thing) {
        Some(Thing::Box(place)) if !matches!(builder.net.place(place).kind, Kind::Macro(_)) => {
            attribute(builder, place, member);
        }
        Some(Thing::Box(_) | Thing::Part(_) | Thing::Spoiled) => {}
        Some(Thing::Port | Thing::Param | Thing::Word(_)) => {
            let message =
                format!("expected a box, a macro or a module before the dot, found `{}`", builder.text(owner));
            builder.complain(codes::NET_NAME, owner.span, message, "only tokens have attributes, and only parts boxes");
        }
        None => builder.unknown(owner, "a box, a macro or a module"),
    }
}

fn attribute(builder: &mut Builder<'_>, place: BoxId, member: Name) {
    let text = builder.text(member);
    let described = builder.net.place(place);
    let mut known: Vec<&str> = builder.net.attributes(described).iter().map(|known| known.name.as_str()).collect();
    let asks = described.asks();
    if asks {
        known.extend([CAUSE, READY]);
    }
    if known.contains(&text.as_str()) || builder.unclassed.contains(&place) {
        return;
    }
    let help = match known.as_slice() {
        _ if text == CAUSE || text == READY => "only a PROCESS with AFTER has a cause".to_owned(),
        [] => "its tokens are plain: give the box a class by OF".to_owned(),
        known => suggest::help(&text, known.iter().copied())
            .unwrap_or_else(|| format!("the attributes are {}", known.join(", "))),
    };
    let message = format!("expected an attribute of the tokens of `{}`, found `{text}`", described.name);
    builder.complain(codes::NET_NAME, member.span, message, &help);
}

/// A statement writes attributes, and whether a process is ready: its cause is given.
fn written(builder: &mut Builder<'_>, owner: Name, member: Name) {
    self::member(builder, owner, member);
    let Some((Thing::Box(place), _)) = builder.names.get(&owner.symbol).copied() else {
        return;
    };
    let is_cause = builder.net.place(place).asks() && builder.text(member) == CAUSE;
    if is_cause {
        let message = format!("expected an attribute or `{READY}`, found `{CAUSE}`");
        builder.complain(codes::NET_NAME, member.span, message, "the cause of a process is read only");
    }
}

/// A number of tokens is no time.
fn no_box_as_time(builder: &mut Builder<'_>, statement: usize) {
    let Some(item) = builder.statements[statement].inputs().first().cloned() else {
        return;
    };
    let thing = |name: Name| builder.names.get(&name.symbol).map(|(thing, _)| *thing);
    let is_box = match &item.value {
        Operand::Name(name) => matches!(thing(*name), Some(Thing::Box(_))),
        Operand::Element(element) => {
            let whole = indexed(builder, element.0, &element.1);
            whole.is_some_and(|symbol| matches!(builder.names.get(&symbol), Some((Thing::Box(_), _))))
        }
        Operand::Member(member) => matches!(thing(member.0), Some(Thing::Part(_))),
        Operand::Empty | Operand::Number(_) | Operand::Text(_) => false,
    };
    if is_box {
        let message = format!("expected a time in seconds, found the box `{}`", builder.written_text(item.span));
        builder.complain(codes::NET_NAME, item.span, message, "take a number, a parameter, an input or an output");
    }
}
