//! The text of a net.

use super::expression::{Expression, Operator, Value};
use super::model::{
    Abort, Arc, Gate, Generate, Input, Kind, Net, NetBox, Order, Part, Process, Route, Rule, Statement, Stop, Target,
    Word,
};
use std::collections::BTreeMap;

/// The files of a net and of the nets inside it: name and text.
pub fn files(net: &Net) -> BTreeMap<String, String> {
    let mut files: BTreeMap<String, String> = net.parts.iter().flat_map(|part| files(&part.net)).collect();
    files.insert(format!("{}.net", net.name), text(net));
    files
}

/// The text of one file.
fn text(net: &Net) -> String {
    let mut lines = head(net);
    let boxes: Vec<(Option<usize>, Vec<String>)> =
        net.boxes.iter().map(|place| (place.repeated, box_lines(net, place))).collect();
    lines.extend(with_repetitions(&boxes));
    let modules = net.parts.iter().filter(|part| net.boxes.iter().all(|place| place.name != part.name));
    lines.extend(modules.map(|part| format!("MODULE {}", call(part))));
    let gates: Vec<(Option<usize>, Vec<String>)> =
        net.gates.iter().map(|gate| (gate.repeated, gate_lines(gate))).collect();
    lines.extend(with_repetitions(&gates));
    lines.push("END\n".to_owned());
    lines.join("\n")
}

fn head(net: &Net) -> Vec<String> {
    let outputs = list(&net.outputs, |word| format!("{} {}", kind_of(word.first), word.name));
    let inputs = list(&net.inputs, input);
    let parameters = list(&net.parameters, declared);
    let mut lines = vec![format!("{outputs} = {} ( {inputs} : {parameters} )", net.name)];
    let started: Vec<Word> = net.outputs.iter().filter(|word| !word.first.same(word.first.zero())).cloned().collect();
    let mut clause = |word: &str, text: String| {
        if !text.is_empty() {
            lines.push(format!("{word} {text}"));
        }
    };
    clause("MOMENTARY", net.momentary.join(", "));
    clause("MODE", net.mode.join(", "));
    clause("START", list(&started, |word| format!("{} = {}", word.name, number(word.first))));
    clause("STOP", list(&net.stops, |(name, stop)| format!("{name} = {}", stopped(*stop))));
    clause("LOCAL", list(&net.locals, declared));
    clause("BLOCKED", net.blocked.clone().unwrap_or_default());
    for active in &net.active {
        let time = active.time.as_ref().map_or(String::new(), |time| format!(", {time}"));
        clause("ACTIVE", format!("{}{time} OF {}", active.step, active.of.join(", ")));
    }
    for class in &net.classes {
        clause("CLASS", format!("{} ( {} )", class.name, list(&class.attributes, declared)));
    }
    lines
}

fn list<T>(items: &[T], one: impl Fn(&T) -> String) -> String {
    items.iter().map(one).collect::<Vec<_>>().join(", ")
}

fn kind_of(value: Value) -> &'static str {
    match value {
        Value::Int(_) => "int",
        Value::Real(_) => "real",
    }
}

fn number(value: Value) -> String {
    match value {
        Value::Int(int) => int.to_string(),
        Value::Real(real) => format!("{real:?}"),
    }
}

fn declared(word: &Word) -> String {
    format!("{} {} = {}", kind_of(word.first), word.name, number(word.first))
}

fn input(input: &Input) -> String {
    let (kind, name, first) = (kind_of(input.first), &input.name, number(input.first));
    match (input.size, input.cell, input.first) {
        (Some(size), _, Value::Int(_)) => format!("ivec[{size}] {name}"),
        (Some(size), _, Value::Real(_)) => format!("vec[{size}] {name}"),
        (None, true, _) => format!("cell {kind} {name} = {first}"),
        (None, false, _) => format!("{kind} {name}"),
    }
}

fn stopped(stop: Stop) -> String {
    match stop {
        Stop::Hold => "HOLD".to_owned(),
        Stop::Is(value) => number(value),
    }
}

/// Boxes or gates of one repetition stand in the text once, with a counter for the index.
fn with_repetitions(items: &[(Option<usize>, Vec<String>)]) -> Vec<String> {
    let mut lines = Vec::new();
    for (at, (repetition, text)) in items.iter().enumerate() {
        let same = |item: &&(Option<usize>, Vec<String>)| repetition.is_some() && item.0 == *repetition;
        if items[..at].iter().any(|item| same(&item)) {
            continue;
        }
        match items.iter().filter(same).count() {
            0 => lines.extend(text.iter().cloned()),
            times => {
                lines.push(format!("FOR i = 1 TO {times}"));
                lines.extend(text.iter().map(|line| line.replace("[1]", "[i]").replace("[2]", "[i+1]")));
                lines.push("NEXT".to_owned());
            }
        }
    }
    lines
}

fn box_lines(net: &Net, place: &NetBox) -> Vec<String> {
    let (line, mut below) = match &place.kind {
        Kind::State => (format!("STATE {}", place.name), Vec::new()),
        Kind::Entry => (format!("ENTRY {}", place.name), Vec::new()),
        Kind::Exit => (format!("EXIT {}", place.name), Vec::new()),
        Kind::Capacity(size, order) => {
            let size = size.map_or(String::new(), |size| format!(" SIZE {size}"));
            (format!("CAPACITY {}{size}{}", place.name, ordered(order)), Vec::new())
        }
        Kind::Time(time) => (format!("TIME {} {}", place.name, expression(time)), Vec::new()),
        Kind::Count(size) => (format!("COUNT {} {size}", place.name), Vec::new()),
        Kind::Operation(acts) => (format!("OPERATION {}", place.name), statements("DO", acts)),
        Kind::Signal(acts) => (format!("SIGNAL {}", place.name), statements("DO", acts)),
        Kind::Process(process) => process_lines(&place.name, process),
        Kind::Generate(generate) => generate_lines(&place.name, generate),
        Kind::Macro(part) => macro_lines(&net.parts[*part]),
    };
    let mut lines = vec![line + &clauses(place)];
    lines.append(&mut below);
    lines
}

fn clauses(place: &NetBox) -> String {
    let mut text = String::new();
    if let (Some(class), false) = (&place.class, matches!(place.kind, Kind::Macro(_))) {
        text += &format!(" OF {class}");
    }
    match place.marked {
        0 => {}
        _ if !place.with.is_empty() => {
            text +=
                &format!(" MARKED ( {} )", list(&place.with, |word| format!("{} = {}", word.name, number(word.first))));
        }
        1 => text += " MARKED",
        many => text += &format!(" MARKED {many}"),
    }
    if !place.drives.is_empty() {
        text += &format!(" DRIVES {}", place.drives.join(", "));
    }
    text
}

fn ordered(order: &Order) -> String {
    match order {
        Order::Fifo => String::new(),
        Order::Lifo => " ORDER lifo".to_owned(),
        Order::Least(attribute) => format!(" ORDER least {attribute}"),
        Order::Most(attribute) => format!(" ORDER most {attribute}"),
    }
}

fn process_lines(name: &str, process: &Process) -> (String, Vec<String>) {
    let until = process.until.as_ref().map_or(String::new(), |until| format!(" UNTIL {}", expression(until)));
    let within = process.within.as_ref().map_or(String::new(), |within| format!(" WITHIN {}", expression(within)));
    let mut below = statements("DO", &process.begins);
    below.extend(statements("AFTER", &process.after));
    (format!("PROCESS {name}{until}{within}"), below)
}

fn generate_lines(name: &str, generate: &Generate) -> (String, Vec<String>) {
    let (size, order, when) = (generate.size, ordered(&generate.order), expression(&generate.when));
    (format!("GENERATE {name} SIZE {size}{order} WHEN {when}"), statements("DO", &generate.begins))
}

fn macro_lines(part: &Part) -> (String, Vec<String>) {
    let below = part.abort.iter().flat_map(|Abort { condition, to, acts }| {
        let mut lines = vec![format!("ABORT {} -> {to}", expression(condition))];
        lines.extend(statements("DO", acts));
        lines
    });
    (format!("MACRO {}", call(part)), below.collect())
}

fn call(part: &Part) -> String {
    let outputs = list(&part.outputs, |output| output.clone().unwrap_or_else(|| "_".to_owned()));
    let called =
        if part.outputs.is_empty() { format!("{} =", part.name) } else { format!("{} : {outputs} =", part.name) };
    let parameters = list(&part.parameters, |word| format!("{} = {}", word.name, number(word.first)));
    format!("{called} {} ( {} : {parameters} )", part.net.name, list(&part.inputs, expression))
}

fn statements(word: &str, statements: &[Statement]) -> Vec<String> {
    let one = |statement: &Statement| {
        let target = match &statement.target {
            Target::Word(name) => name.clone(),
            Target::Attribute(place, attribute) => format!("{place}.{attribute}"),
            Target::Ready(place) => format!("{place}.ready"),
        };
        format!("{word} {target} = {}", expression(&statement.value))
    };
    statements.iter().map(one).collect()
}

fn arcs(arcs: &[Arc]) -> String {
    list(arcs, |(place, weight)| if *weight == 1 { place.clone() } else { format!("{weight}*{place}") })
}

fn gate_lines(gate: &Gate) -> Vec<String> {
    let mut line = format!("GATE {} : {} -> {}", gate.name, arcs(&gate.before), arcs(&gate.after));
    for (word, text) in [
        ("READ", arcs(&gate.reads)),
        ("INHIBIT", arcs(&gate.inhibits)),
        ("PERMIT", list(&gate.permits, |term| guarded(term, 3))),
    ] {
        if !text.is_empty() {
            line += &format!(" {word} {text}");
        }
    }
    if gate.priority != 0 {
        line += &format!(" PRIORITY {}", gate.priority);
    }
    let mut lines = vec![line];
    for (at, rule) in gate.rules.iter().enumerate() {
        match &rule.condition {
            Some(condition) => lines.push(format!("IF {}", expression(condition))),
            None if at > 0 => lines.push("ELSE".to_owned()),
            None => {}
        }
        lines.extend(rule_lines(rule));
    }
    lines
}

fn rule_lines(rule: &Rule) -> Vec<String> {
    let route = |Route { from, to }: &Route| {
        let to = if to.is_empty() { "nothing".to_owned() } else { to.join(", ") };
        format!("THEN {} -> {to}", from.as_deref().unwrap_or("NEW"))
    };
    rule.routes.iter().map(route).chain(statements("DO", &rule.acts)).collect()
}

/// The text of an expression.
pub fn expression(expression: &Expression) -> String {
    guarded(expression, 0)
}

/// In parentheses where it binds more loosely than its surroundings.
fn guarded(expression: &Expression, surroundings: u8) -> String {
    let (text, binds) = match expression {
        Expression::Number(value) => (number(*value), 9),
        Expression::Word(name) | Expression::Tokens(name) => (name.clone(), 9),
        Expression::Attribute(place, attribute) => (format!("{place}.{attribute}"), 9),
        Expression::Cause(place) => (format!("{place}.cause"), 9),
        Expression::Minus(a) => (format!("-{}", guarded(a, 9)), 8),
        Expression::Not(a) => (format!("NOT {}", guarded(a, 3)), 3),
        Expression::Two(operator, a, b) => {
            let (sign, binds) = sign(*operator);
            // Those of one level go from the left, but comparisons do not follow one another.
            let left = if (4..=5).contains(&binds) { binds + 1 } else { binds };
            (format!("{} {sign} {}", guarded(a, left), guarded(b, binds + 1)), binds)
        }
    };
    if binds < surroundings { format!("({text})") } else { text }
}

fn sign(operator: Operator) -> (&'static str, u8) {
    match operator {
        Operator::Or => ("OR", 1),
        Operator::And => ("AND", 2),
        Operator::Equal => ("==", 4),
        Operator::Unequal => ("<>", 4),
        Operator::Below => ("<", 5),
        Operator::AtMost => ("<=", 5),
        Operator::Above => (">", 5),
        Operator::AtLeast => (">=", 5),
        Operator::Plus => ("+", 6),
        Operator::Less => ("-", 6),
        Operator::Times => ("*", 7),
        Operator::Over => ("/", 7),
    }
}
