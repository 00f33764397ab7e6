//! The box phase: timers, OPERATION, SIGNAL, PROCESS and GENERATE.

use super::Fault;
use super::expression::Expression;
use super::instance::{Hand, Instance, Mode, NOBODY};
use super::model::{Generate, Kind, Process, Statement};
use super::statements::run;
use super::tokens::World;

/// The boxes of a net in the order of the file, then those of its parts.
pub(super) fn phase(instance: &mut Instance, world: &mut World) {
    if instance.mode == Mode::Stopped {
        stand_still(instance);
    } else {
        (0..instance.boxes.len()).for_each(|place| act(instance, place, world));
    }
    let net = instance.net;
    for (at, part) in net.parts.iter().enumerate() {
        let inputs = instance.inputs_of(part, world);
        let mode = instance.mode;
        instance.parts[at].latch(inputs, mode, world);
        phase(&mut instance.parts[at], world);
    }
    instance.boxes.iter_mut().zip(&net.boxes).for_each(|(state, place)| {
        if let Kind::Macro(part) = place.kind {
            let inside = &instance.parts[part];
            let exit = inside.net.exit().map(|exit| &inside.boxes[exit]);
            state.excited = !state.tokens.is_empty() && exit.is_some_and(|exit| !exit.tokens.is_empty());
        }
    });
}

/// A box that asks for nothing but tokens is excited in a stopped net too, as a net around it may see.
fn stand_still(instance: &mut Instance) {
    for (place, state) in instance.net.boxes.iter().zip(&mut instance.boxes) {
        state.excited = match &place.kind {
            Kind::State | Kind::Entry | Kind::Exit | Kind::Capacity(..) | Kind::Generate(_) => !state.tokens.is_empty(),
            Kind::Count(size) => state.tokens.len() == *size,
            Kind::Time(_) | Kind::Operation(_) | Kind::Signal(_) | Kind::Process(_) | Kind::Macro(_) => {
                state.excited && !state.tokens.is_empty()
            }
        };
    }
}

fn act(instance: &mut Instance, place: usize, world: &mut World) {
    let net = instance.net;
    let marked = !instance.boxes[place].tokens.is_empty();
    let excited = match &net.boxes[place].kind {
        Kind::State | Kind::Entry | Kind::Exit | Kind::Capacity(..) => marked,
        Kind::Time(time) => marked && has_passed(instance, time, instance.boxes[place].since, &vec![], world),
        Kind::Count(size) => instance.boxes[place].tokens.len() == *size,
        Kind::Operation(acts) | Kind::Signal(acts) => {
            if marked && !instance.boxes[place].begun {
                begin(instance, place, acts, world);
            }
            marked
        }
        Kind::Process(process) => {
            if marked {
                go_on(instance, place, process, world);
            }
            marked && instance.boxes[place].complete
        }
        Kind::Generate(generate) => {
            make(instance, place, generate, world);
            !instance.boxes[place].tokens.is_empty()
        }
        // It follows the exit, which is known when its own net has had its phase.
        Kind::Macro(_) => false,
    };
    instance.boxes[place].excited = excited;
}

/// The token of a box, under its name.
fn own(instance: &Instance, place: usize) -> Hand {
    instance.boxes[place]
        .tokens
        .first()
        .map(|token| (instance.net.boxes[place].name.clone(), *token))
        .into_iter()
        .collect()
}

fn begin(instance: &mut Instance, place: usize, acts: &[Statement], world: &mut World) {
    let (hand, rank) = (own(instance, place), instance.boxes[place].rank);
    run(instance, acts, rank, &hand, world);
    instance.boxes[place].begun = true;
}

/// Whether so many seconds are over.
fn has_passed(instance: &Instance, time: &Expression, since: i64, hand: &Hand, world: &World) -> bool {
    let found = time.value(&|operand| instance.find(operand, hand, world));
    let nanoseconds = found.value.real() * 1e9;
    !found.bad && (instance.now - since) as f64 >= nanoseconds.round()
}

/// In the first phase it begins; from then on it is completed or is late.
fn go_on(instance: &mut Instance, place: usize, process: &Process, world: &mut World) {
    if !instance.boxes[place].begun {
        begin(instance, place, &process.begins, world);
        instance.boxes[place].timer = instance.now;
        return;
    }
    if instance.boxes[place].complete {
        return;
    }
    let hand = own(instance, place);
    let done = process.until.as_ref().is_none_or(|until| instance.holds(until, &hand, world));
    let timer = instance.boxes[place].timer;
    let late = process.within.as_ref().is_some_and(|within| has_passed(instance, within, timer, &hand, world));
    if !done && !late {
        return;
    }
    if !done {
        world.note("a process that is late");
        world.faults.push(Fault::Late);
    }
    let state = &mut instance.boxes[place];
    (state.cause, state.ready) = (i32::from(!done), true);
    let rank = state.rank;
    run(instance, &process.after, rank, &hand, world);
    let state = &mut instance.boxes[place];
    world.note(if state.ready { "a process complete" } else { "a process that waits on" });
    state.complete = state.ready;
    state.timer = instance.now;
}

/// An edge makes a token, or waits for room, or is lost. One that waited goes first; the condition was tested before.
fn make(instance: &mut Instance, place: usize, generate: &Generate, world: &mut World) {
    let holds = instance.holds(&generate.when, &[], world);
    let edge = holds && !instance.boxes[place].held;
    instance.boxes[place].held = holds;
    let got_room = instance.boxes[place].waits && has_room(instance, place, generate);
    if got_room {
        instance.boxes[place].waits = false;
        add(instance, place, generate, world);
    }
    if !edge {
        return;
    }
    if has_room(instance, place, generate) {
        add(instance, place, generate, world);
    } else if instance.boxes[place].waits {
        world.note("a lost edge");
        world.faults.push(Fault::Lost);
    } else {
        world.note("an edge that waits");
        instance.boxes[place].waits = true;
    }
}

fn has_room(instance: &Instance, place: usize, generate: &Generate) -> bool {
    instance.boxes[place].tokens.len() < generate.size
}

fn add(instance: &mut Instance, place: usize, generate: &Generate, world: &mut World) {
    world.note("a token made");
    let described = &instance.net.boxes[place];
    let class = described.class.as_ref().and_then(|class| instance.net.class(class));
    let token = world.new_token(class);
    instance.boxes[place].tokens.push(token);
    run(instance, &generate.begins, NOBODY, &[(described.name.clone(), token)], world);
}
