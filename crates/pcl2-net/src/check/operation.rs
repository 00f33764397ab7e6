//! Pass 7, and the part of pass 2 that is about modes: by which an operator works a net, and what outputs tell him.

use super::outline::Outline;
use super::{Builder, Thing, zero};
use pcl2_lang::ast::Name;
use pcl2_lang::ast::net::Halt;
use pcl2_lang::codes;
use pcl2_lang::decl::{Item, PortDecl, TypeExpr};
use pcl2_lang::net::{Operation, WordId};
use pcl2_lang::suggest;
use pcl2_lang::types::{Scalar, Value};

/// The modes, in the order of their numbers.
const MODES: [&str; 4] = ["automatic", "step", "manual", "stopped"];

/// What a value of 0 is called that stands for nothing.
const NONE: &str = "none";

/// The word that takes the mode in each scan, and those of the commands.
pub(super) fn modes(builder: &mut Builder<'_>, outline: &Outline) {
    let Some((names, more)) = outline.modes.split_first() else {
        return;
    };
    if let Some(again) = more.first().and_then(|names| names.first()) {
        builder.complain(codes::NET_LINE, again.span, "expected MODE once, found it again", "delete one of the lines");
    }
    let mut commands = [None; 4];
    let Some((mode, given)) = names.split_first() else {
        return;
    };
    for (i, name) in given.iter().enumerate() {
        let Some(command) = commands.get_mut(i) else {
            let message = "expected at most a mode and four commands, found more";
            builder.complain(codes::NET_LINE, name.span, message, "`MODE mode, go, fire, put, take`");
            break;
        };
        let text = builder.text(*name);
        if let Some(port) = builder.momentary(*name, &text) {
            *command = Some(WordId(builder.net.words.len() as u32));
            builder.command(port, &text, name.span);
        }
    }
    if let Some(port) = mode_port(builder, *mode) {
        let word = WordId(builder.net.words.len() as u32);
        builder.push_word(&builder.text(*mode), Scalar::Int, zero(Scalar::Int), mode.span);
        let (mode, stops) = ((port as u32, word), Vec::new());
        builder.net.operation = Some(Operation { mode, commands, stops });
    }
}

/// The input that is the mode: no command is.
fn mode_port(builder: &mut Builder<'_>, name: Name) -> Option<usize> {
    let text = builder.text(name);
    let int = TypeExpr::Scalar(Scalar::Int);
    let port = builder.decl.ports().position(|port| port.name == text && port.ty == int);
    let command = port.is_some_and(|port| builder.net.momentary.iter().any(|(known, _)| *known as usize == port));
    if port.is_none() || command {
        let message = format!("expected an int input as the mode, found `{text}`");
        let ints = builder.decl.ports().filter(|port| port.ty == int).map(|port| port.name.as_str());
        let help = suggest::help(&text, ints.filter(|known| *known != text));
        let help = help.unwrap_or_else(|| format!("declare it in the head: `cell int {text} = 0`"));
        builder.complain(codes::NET_LINE, name.span, message, &help);
    }
    port.filter(|_| !command)
}

/// What outputs are while the net is stopped, and the names of the values that inputs and outputs have.
pub(super) fn operation(builder: &mut Builder<'_>, outline: &Outline) {
    stops(builder, &outline.stops);
    let boxes: Vec<String> = builder.net.boxes.iter().map(|place| place.name.clone()).collect();
    if let Some(operation) = builder.net.operation.clone() {
        let gates = builder.net.numbered.iter().map(|gate| builder.net.gates[gate.0 as usize].name.clone());
        let gates: Vec<String> = gates.collect();
        name_input(builder, Some(operation.mode.0), MODES.map(str::to_owned).to_vec());
        let ports = operation.commands.map(|command| port_of(builder, command));
        name_input(builder, ports[1], behind_none(gates));
        name_input(builder, ports[2], behind_none(boxes.clone()));
        name_input(builder, ports[3], behind_none(boxes.clone()));
    }
    for active in builder.net.actives.clone() {
        let listed = active.boxes.iter().map(|place| boxes[place.0 as usize].clone());
        name_output(builder, active.step, behind_none(listed.collect()));
    }
    if let Some(word) = builder.net.blocked {
        let terms = terms(builder);
        name_output(builder, word, behind_none(terms));
    }
}

fn behind_none(names: Vec<String>) -> Vec<String> {
    std::iter::once(NONE.to_owned()).chain(names).collect()
}

/// The permissive terms in the order of their numbers.
fn terms(builder: &Builder<'_>) -> Vec<String> {
    let gates = builder.net.numbered.iter().map(|gate| &builder.net.gates[gate.0 as usize]);
    let named = |gate: &pcl2_lang::net::Gate| -> Vec<String> {
        gate.permits.iter().map(|permit| format!("{} blocked: {}", gate.name, one_line(&permit.text))).collect()
    };
    gates.flat_map(named).collect()
}

/// A term as written, without comments and new lines in it.
fn one_line(text: &str) -> String {
    let words = text.lines().flat_map(|line| line.split('!').take(1)).flat_map(str::split_whitespace);
    words.collect::<Vec<&str>>().join(" ")
}

fn port_of(builder: &Builder<'_>, command: Option<WordId>) -> Option<u32> {
    let command = command?;
    builder.net.momentary.iter().find(|(_, word)| *word == command).map(|(port, _)| *port)
}

/// Names the values of an input that has neither names nor a range of its own.
fn name_input(builder: &mut Builder<'_>, port: Option<u32>, names: Vec<String>) {
    let ports = builder.decl.items.iter_mut().filter_map(|item| match item {
        Item::Port(port) => Some(port.as_mut()),
        Item::Literal(_) | Item::Constant(_) => None,
    });
    let plain = |port: &&mut PortDecl| port.tail.names.is_empty() && port.tail.bounds.is_none();
    let port = port.and_then(|port| ports.skip(port as usize).take(1).find(plain));
    if let Some(port) = port {
        port.tail.names = names;
    }
}

fn name_output(builder: &mut Builder<'_>, word: WordId, names: Vec<String>) {
    let heads = builder.decl.outputs.iter_mut().filter(|output| !output.by_name);
    let output = heads.skip(word.0 as usize).take(1).find(|output| output.tail.names.is_empty());
    if let Some(output) = output {
        output.tail.names = names;
    }
}

/// Driven and written outputs are 0 while the net is stopped, unless a line says otherwise.
fn stops(builder: &mut Builder<'_>, halts: &[Halt]) {
    if let (None, Some(halt)) = (&builder.net.operation, halts.first()) {
        let help = "a net without modes is never stopped: `MODE mode`";
        builder.miss(codes::NET_LINE, halt.name.span, "expected a MODE in a net with STOP, found none", help);
        return;
    }
    let heads = builder.net.outputs;
    let filled = |word: usize| {
        let net = &builder.net;
        let told = net.actives.iter().flat_map(|active| [Some(active.step), active.time]).chain([net.blocked]);
        // A command goes back, cleared, by a word too.
        let commands = net.momentary.iter().map(|(_, command)| *command);
        told.flatten().chain(commands).any(|filled| filled.0 as usize == word)
    };
    let off = |word: usize| (!filled(word)).then(|| Some(zero(builder.net.words[word].scalar)));
    let mut values: Vec<Option<Option<Value>>> = (0..heads).map(off).collect();
    let mut seen = vec![false; heads];
    for halt in halts {
        let Some(word) = stopped_output(builder, halt.name, &values, &seen) else {
            continue;
        };
        seen[word] = true;
        let scalar = builder.net.words[word].scalar;
        values[word] = match halt.value {
            Some((number, span)) => builder.constant(number, span, scalar).map(Some),
            None => Some(None),
        };
    }
    let values = values.into_iter().enumerate().filter_map(|(i, value)| Some((WordId(i as u32), value?)));
    if let Some(operation) = &mut builder.net.operation {
        operation.stops = values.collect();
    }
}

/// The output of a STOP: each once, and none that the net fills itself.
fn stopped_output(
    builder: &mut Builder<'_>,
    name: Name,
    values: &[Option<Option<Value>>],
    seen: &[bool],
) -> Option<usize> {
    let text = builder.text(name);
    let word = match builder.names.get(&name.symbol).map(|(thing, _)| *thing) {
        Some(Thing::Word(word)) => word.0 as usize,
        Some(Thing::Spoiled) => return None,
        Some(Thing::Port | Thing::Param | Thing::Box(_) | Thing::Part(_)) => usize::MAX,
        None => {
            builder.unknown(name, "an output");
            return None;
        }
    };
    let (expected, help) = match (values.get(word), seen.get(word)) {
        (None, _) => ("an output", "a local is seen in the net alone"),
        (_, Some(true)) => ("each output once", "delete one of them"),
        (Some(None), _) => {
            ("an output that boxes drive or statements write", "ACTIVE, BLOCKED and commands fill the others")
        }
        (Some(Some(_)), _) => return Some(word),
    };
    let message = format!("expected {expected}, found `{text}`");
    builder.complain(codes::NET_LINE, name.span, message, help);
    None
}
