//! An operator: modes, and what he forces in manual mode.

use super::Fault;
use super::gates::attempt;
use super::instance::{Instance, Mode, NOBODY};
use super::model::{Kind, Net};
use super::tokens::World;

/// The mode of a net: its own, else that of the net around it.
pub(super) fn mode(instance: &Instance, around: Mode) -> Mode {
    let Some(mode) = instance.net.mode.first() else { return around };
    match instance.words[mode].int() {
        0 => Mode::Automatic,
        1 => Mode::Step(command(instance, 1) != 0),
        2 => Mode::Manual,
        _ => Mode::Stopped,
    }
}

/// A command by its place in MODE: 1 go, 2 fire, 3 put, 4 take.
fn command(instance: &Instance, at: usize) -> i32 {
    instance.net.mode.get(at).map_or(0, |name| instance.words[name].int())
}

/// Every command is cleared; those that the mode does not know are refused.
pub(super) fn refuse_those_of_other_modes(instance: &mut Instance, world: &mut World) {
    let net = instance.net;
    instance.cleared.extend(net.mode.iter().skip(1).cloned());
    for at in 1..=4 {
        let known = match instance.mode {
            Mode::Automatic | Mode::Stopped => false,
            Mode::Step(_) => at == 1,
            Mode::Manual => at > 1,
        };
        if command(instance, at) != 0 && !known {
            world.faults.push(Fault::Refused);
        }
    }
}

/// Fire, put, take, in this order.
pub(super) fn commands(instance: &mut Instance, holder_is_marked: bool, world: &mut World) {
    for at in 2..=4 {
        let number = command(instance, at);
        if number != 0 {
            world.note("a command in manual mode");
            let number = usize::try_from(number).ok().and_then(|number| number.checked_sub(1));
            let done = number.is_some_and(|number| obey(instance, at, number, holder_is_marked, world));
            world.note(if done { "something forced" } else { "a command refused" });
            world.faults.push(if done { Fault::Forced } else { Fault::Refused });
        }
    }
}

fn obey(instance: &mut Instance, command: usize, at: usize, holder_is_marked: bool, world: &mut World) -> bool {
    match command {
        2 => at < instance.net.gates.len() && attempt(instance, at, true, world),
        3 => at < instance.net.boxes.len() && put(instance, at, holder_is_marked, world),
        _ => at < instance.net.boxes.len() && take(instance, at, world),
    }
}

/// Whether it is the net of a macro.
fn is_inside_a_macro(net: &Net) -> bool {
    net.entry().is_some()
}

fn is_a_door(net: &Net, place: usize) -> bool {
    matches!(net.boxes[place].kind, Kind::Entry | Kind::Exit)
}

fn put(instance: &mut Instance, place: usize, holder_is_marked: bool, world: &mut World) -> bool {
    let net = instance.net;
    if is_a_door(net, place) || (is_inside_a_macro(net) && !holder_is_marked) || !instance.has_room(place, 1, 0) {
        return false;
    }
    let class = net.boxes[place].class.as_ref().and_then(|class| net.class(class));
    let token = world.new_token(class);
    instance.put(place, token, NOBODY);
    instance.filled[place] += 1;
    true
}

fn take(instance: &mut Instance, place: usize, world: &World) -> bool {
    let net = instance.net;
    let left = |at: usize| instance.start[at].iter().filter(|token| !instance.taken.contains(*token)).count();
    let inside: usize = (0..net.boxes.len()).map(left).sum();
    if is_a_door(net, place) || (is_inside_a_macro(net) && inside + instance.arriving.len() <= 1) {
        return false;
    }
    let tokens = world.in_order(net, place, &instance.start[place]);
    let Some(token) = tokens.into_iter().find(|token| !instance.taken.contains(token)) else { return false };
    match net.part_of(place) {
        Some(_) => instance.take_all(place),
        None => drop(instance.taken.insert(token)),
    }
    true
}
