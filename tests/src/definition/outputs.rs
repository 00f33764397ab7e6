//! The end of a scan: outputs follow the marking.

use super::Fault;
use super::expression::Value;
use super::instance::{Instance, Mode, Rank};
use super::model::Stop;
use super::tokens::World;

/// Gates of nets inside come after those of the net around them.
const AFTER_ALL: Rank = (i64::MIN, 0);

/// For the nets inside, then for the one around them.
pub(super) fn follow(instance: &mut Instance, world: &mut World) {
    instance.parts.iter_mut().for_each(|part| follow(part, world));
    from_parts(instance, world);
    driven(instance);
    if instance.mode == Mode::Stopped {
        stopped(instance, world);
        return;
    }
    active(instance);
    blocked(instance, world);
    let net = instance.net;
    instance.shown = net.outputs.iter().map(|word| (word.name.clone(), instance.words[&word.name])).collect();
}

/// What is not named is 0; that of ACTIVE stays.
fn stopped(instance: &mut Instance, world: &World) {
    world.note("a stop");
    let net = instance.net;
    if let Some(name) = &net.blocked {
        instance.words.insert(name.clone(), Value::Int(0));
    }
    for output in &net.outputs {
        let named = net.stops.iter().find(|(name, _)| *name == output.name).map(|(_, stop)| *stop);
        let is_active = net.active.iter().any(|active| active.fills(&output.name));
        match named {
            Some(Stop::Is(value)) => drop(instance.shown.insert(output.name.clone(), value)),
            Some(Stop::Hold) => world.note("HOLD"),
            None if is_active => {}
            None => drop(instance.shown.insert(output.name.clone(), output.first.zero())),
        }
    }
}

/// Values that nets inside write, when they do; those of ACTIVE always, and those that a stop changes. Of two writes of an
/// output that of the net around comes first, then that of the part that stands first.
fn from_parts(instance: &mut Instance, world: &mut World) {
    let net = instance.net;
    for (part, inside) in net.parts.iter().zip(&instance.parts) {
        for (output, to) in part.net.outputs.iter().zip(&part.outputs) {
            let Some(to) = to else { continue };
            let is_active = part.net.active.iter().any(|active| active.fills(&output.name));
            // A stop writes when it begins, and when it ends what was there before it.
            let stops = !part.net.mode.is_empty() && (inside.before == Mode::Stopped) != (inside.mode == Mode::Stopped);
            if is_active || stops || inside.touched.contains(&output.name) {
                let value = inside.shown[&output.name].like(instance.words[to]);
                // What counts inside is a write of this net's word all the same.
                let is_written = !is_active && !part.net.is_driven(&output.name);
                if is_written && net.outputs.iter().any(|output| output.name == *to) {
                    if instance.written.contains_key(to) {
                        if !instance.words[to].same(value) {
                            world.note("two different writes across nets");
                            world.faults.push(Fault::Conflict);
                        }
                        continue;
                    }
                    instance.written.insert(to.clone(), (value, AFTER_ALL));
                }
                instance.words.insert(to.clone(), value);
                instance.touched.insert(to.clone());
            }
        }
    }
}

/// 1 while any of its boxes is marked, here or in a net inside.
fn driven(instance: &mut Instance) {
    let net = instance.net;
    for word in net.outputs.iter().chain(&net.locals).filter(|word| net.is_driven(&word.name)) {
        let drives = |place: &super::model::NetBox| place.drives.contains(&word.name);
        let here =
            net.boxes.iter().zip(&instance.boxes).any(|(place, state)| drives(place) && !state.tokens.is_empty());
        let inside = net.parts.iter().zip(&instance.parts).any(|(part, inside)| {
            part.bound(&word.name).any(|output| part.net.is_driven(output) && inside.shown[output].int() != 0)
        });
        instance.words.insert(word.name.clone(), Value::Int(i32::from(here || inside)));
    }
}

fn active(instance: &mut Instance) {
    for (at, active) in instance.net.active.iter().enumerate() {
        let (step, since) = (instance.first_marked(&active.of), instance.active[at]);
        if step != since.0 {
            instance.active[at] = (step, instance.now);
        }
        instance.words.insert(active.step.clone(), Value::Int(step));
        if let Some(time) = &active.time {
            let nanoseconds = instance.now - instance.active[at].1;
            instance.words.insert(time.clone(), Value::Real(nanoseconds as f64 / 1e9));
        }
    }
}

/// Between steps it stays.
fn blocked(instance: &mut Instance, world: &World) {
    if let (Some(name), false) = (&instance.net.blocked, instance.mode == Mode::Step(false)) {
        if instance.held_back != 0 {
            world.note("BLOCKED tells");
        }
        instance.words.insert(name.clone(), Value::Int(instance.held_back));
    }
}
