//! Statements: who writes what, and what of it stays.

use super::Fault;
use super::expression::Value;
use super::gates;
use super::instance::{Instance, Rank};
use super::model::{Statement, Target};
use super::tokens::{Token, World};

/// Runs statements one after the other; each sees what those before it wrote.
pub(super) fn run(
    instance: &mut Instance,
    acts: &[Statement],
    rank: Rank,
    hand: &[(String, Token)],
    world: &mut World,
) {
    for Statement { target, value } in acts {
        let new = value.value(&|operand| instance.find(operand, hand, world)).value;
        match target {
            Target::Word(name) => {
                let new = new.like(instance.words[name]);
                write(instance, name, new, value.reads(name), rank, world);
            }
            Target::Attribute(name, attribute) => {
                if let Some(token) = instance.token_called(name, hand, world) {
                    world.set_attribute(token, attribute, new);
                }
            }
            Target::Ready(name) => {
                let place = instance.net.place(name);
                instance.boxes[place].ready = new.int() != 0;
            }
        }
    }
}

/// Two different writes of an output are a fault, and that of the higher rank stays; one that reads what it writes is
/// in no conflict.
fn write(instance: &mut Instance, name: &str, value: Value, reads_itself: bool, rank: Rank, world: &mut World) {
    let rank = rank.min(gates::first_rank(instance.net));
    let is_output = instance.net.outputs.iter().any(|output| output.name == name);
    if is_output && !reads_itself {
        if let Some((_, whose)) = instance.written.get(name).copied() {
            // It may have been counted on since.
            if !instance.words[name].same(value) {
                world.note("two different writes");
                world.faults.push(Fault::Conflict);
            }
            // Of equal ones that which came first.
            if whose >= rank {
                return;
            }
        }
        instance.written.insert(name.to_owned(), (value, rank));
    }
    instance.touched.insert(name.to_owned());
    instance.words.insert(name.to_owned(), value);
}
