//! Nets that are a little smaller than another: what is left when a comparison still fails shows why.

use crate::definition::expression::Expression;
use crate::definition::model::{Gate, Kind, Net, Statement};

/// The net without repeated lines: of those written once nothing can be taken from one alone.
pub fn written_out(net: &Net) -> Net {
    changed(net, |net| {
        net.boxes.iter_mut().for_each(|place| place.repeated = None);
        net.gates.iter_mut().for_each(|gate| gate.repeated = None);
        net.parts.iter_mut().for_each(|part| part.net = written_out(&part.net));
    })
}

/// Each net with one thing less. Some are wrong: what a removed box was named in stays.
pub fn smaller(net: &Net) -> Vec<Net> {
    let mut nets = Vec::new();
    without_one(&mut nets, net, |net| &mut net.gates);
    without_one(&mut nets, net, |net| &mut net.active);
    without_one(&mut nets, net, |net| &mut net.stops);
    without_one(&mut nets, net, |net| &mut net.momentary);
    without_one(&mut nets, net, |net| &mut net.outputs);
    without_one(&mut nets, net, |net| &mut net.locals);
    without_one(&mut nets, net, |net| &mut net.classes);
    without_one(&mut nets, net, |net| &mut net.inputs);
    without_one(&mut nets, net, |net| &mut net.parameters);
    nets.extend((0..net.boxes.len()).map(|at| without_box(net, at)));
    nets.extend((0..net.parts.len()).map(|at| without_part(net, at)));
    for at in 0..net.parts.len() {
        let inner = smaller(&net.parts[at].net);
        nets.extend(inner.into_iter().map(|inner| changed(net, |net| net.parts[at].net = inner)));
        nets.push(changed(net, |net| net.parts[at].abort = None));
        nets.push(changed(net, |net| net.parts[at].parameters.clear()));
        if let Some(abort) = &net.parts[at].abort {
            let set = |net: &mut Net, condition: Expression| {
                if let Some(abort) = &mut net.parts[at].abort {
                    abort.condition = condition;
                }
            };
            nets.extend(parts_of(&abort.condition).into_iter().map(|part| changed(net, |net| set(net, part))));
            nets.push(changed(net, |net| net.parts[at].abort.iter_mut().for_each(|abort| abort.acts.clear())));
        }
    }
    for at in 0..net.gates.len() {
        let gates = smaller_gates(&net.gates[at]);
        nets.extend(gates.into_iter().map(|gate| changed(net, |net| net.gates[at] = gate)));
    }
    for at in 0..net.boxes.len() {
        let kinds = smaller_kinds(&net.boxes[at].kind);
        nets.extend(kinds.into_iter().map(|kind| changed(net, |net| net.boxes[at].kind = kind)));
        nets.push(changed(net, |net| net.boxes[at].drives.clear()));
        nets.push(changed(net, |net| net.boxes[at].with.clear()));
        nets.push(changed(net, |net| net.boxes[at].class = None));
    }
    nets.push(changed(net, |net| net.blocked = None));
    nets.push(changed(net, |net| net.mode.clear()));
    nets
}

fn changed(net: &Net, change: impl FnOnce(&mut Net)) -> Net {
    let mut net = net.clone();
    change(&mut net);
    net
}

fn without_one<T>(nets: &mut Vec<Net>, net: &Net, list: impl Fn(&mut Net) -> &mut Vec<T>) {
    let count = list(&mut net.clone()).len();
    nets.extend((0..count).map(|at| changed(net, |net| drop(list(net).remove(at)))));
}

/// A box goes, and its arcs with it.
fn without_box(net: &Net, at: usize) -> Net {
    changed(net, |net| {
        let name = net.boxes.remove(at).name;
        for gate in &mut net.gates {
            for arcs in [&mut gate.before, &mut gate.after, &mut gate.reads, &mut gate.inhibits] {
                arcs.retain(|(known, _)| *known != name);
            }
            for rule in &mut gate.rules {
                rule.routes.iter_mut().for_each(|route| route.to.retain(|known| *known != name));
                rule.routes.retain(|route| route.from.as_ref() != Some(&name));
            }
        }
        net.active.iter_mut().for_each(|active| active.of.retain(|known| *known != name));
    })
}

fn without_part(net: &Net, at: usize) -> Net {
    let holder = net.boxes.iter().position(|place| matches!(place.kind, Kind::Macro(part) if part == at));
    let mut net = holder.map_or_else(|| net.clone(), |place| without_box(net, place));
    net.parts.remove(at);
    for place in &mut net.boxes {
        if let Kind::Macro(part) = &mut place.kind {
            *part -= usize::from(*part > at);
        }
    }
    net
}

fn smaller_gates(gate: &Gate) -> Vec<Gate> {
    let mut gates = Vec::new();
    let mut add = |change: &dyn Fn(&mut Gate)| {
        let mut gate = gate.clone();
        change(&mut gate);
        gates.push(gate);
    };
    (0..gate.before.len()).for_each(|at| add(&|gate| drop(gate.before.remove(at))));
    (0..gate.after.len()).for_each(|at| add(&|gate| drop(gate.after.remove(at))));
    (0..gate.reads.len()).for_each(|at| add(&|gate| drop(gate.reads.remove(at))));
    (0..gate.inhibits.len()).for_each(|at| add(&|gate| drop(gate.inhibits.remove(at))));
    (0..gate.permits.len()).for_each(|at| add(&|gate| drop(gate.permits.remove(at))));
    add(&|gate| gate.priority = 0);
    for (at, term) in gate.permits.iter().enumerate() {
        parts_of(term).into_iter().for_each(|part| add(&|gate| gate.permits[at] = part.clone()));
    }
    for at in 0..gate.rules.len() {
        if gate.rules.len() > 1 {
            add(&|gate| drop(gate.rules.remove(at)));
        }
        add(&|gate| gate.rules[at].routes.clear());
        (0..gate.rules[at].routes.len()).for_each(|route| add(&|gate| drop(gate.rules[at].routes.remove(route))));
        for acts in smaller_acts(&gate.rules[at].acts) {
            add(&|gate| gate.rules[at].acts.clone_from(&acts));
        }
        if let Some(condition) = &gate.rules[at].condition {
            add(&|gate| gate.rules[at].condition = None);
            parts_of(condition).into_iter().for_each(|part| add(&|gate| gate.rules[at].condition = Some(part.clone())));
        }
    }
    gates
}

fn smaller_acts(acts: &[Statement]) -> Vec<Vec<Statement>> {
    let mut lists = Vec::new();
    for at in 0..acts.len() {
        let mut fewer = acts.to_vec();
        fewer.remove(at);
        lists.push(fewer);
        for part in parts_of(&acts[at].value) {
            let mut simpler = acts.to_vec();
            simpler[at].value = part;
            lists.push(simpler);
        }
    }
    lists
}

fn smaller_kinds(kind: &Kind) -> Vec<Kind> {
    let mut kinds = Vec::new();
    match kind {
        Kind::State | Kind::Entry | Kind::Exit | Kind::Macro(_) => return kinds,
        Kind::Capacity(..) | Kind::Time(_) | Kind::Count(_) => {}
        Kind::Operation(acts) => kinds.extend(smaller_acts(acts).into_iter().map(Kind::Operation)),
        Kind::Signal(acts) => kinds.extend(smaller_acts(acts).into_iter().map(Kind::Signal)),
        Kind::Process(process) => {
            let with = |begins: &[Statement], after: &[Statement]| {
                let mut process = process.clone();
                (process.begins, process.after) = (begins.to_vec(), after.to_vec());
                Kind::Process(process)
            };
            kinds.extend(smaller_acts(&process.begins).iter().map(|begins| with(begins, &process.after)));
            kinds.extend(smaller_acts(&process.after).iter().map(|after| with(&process.begins, after)));
            for until in process.until.iter().flat_map(parts_of).map(Some).chain([None]) {
                let mut process = process.clone();
                process.until = until;
                kinds.push(Kind::Process(process));
            }
            let mut process = process.clone();
            process.within = None;
            kinds.push(Kind::Process(process));
        }
        Kind::Generate(generate) => {
            for begins in smaller_acts(&generate.begins) {
                let mut generate = generate.clone();
                generate.begins = begins;
                kinds.push(Kind::Generate(generate));
            }
            for when in parts_of(&generate.when) {
                let mut generate = generate.clone();
                generate.when = when;
                kinds.push(Kind::Generate(generate));
            }
        }
    }
    kinds.push(Kind::State);
    kinds
}

fn parts_of(expression: &Expression) -> Vec<Expression> {
    match expression {
        Expression::Not(a) | Expression::Minus(a) => vec![(**a).clone()],
        Expression::Two(_, a, b) => vec![(**a).clone(), (**b).clone()],
        Expression::Number(_)
        | Expression::Word(_)
        | Expression::Tokens(_)
        | Expression::Attribute(..)
        | Expression::Cause(_) => Vec::new(),
    }
}
