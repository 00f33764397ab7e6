//! Pass 6: every output is driven or written, never both.

use super::outline::Outline;
use super::{Builder, Thing};
use pcl2_lang::ast::Name;
use pcl2_lang::ast::net::ActiveLine;
use pcl2_lang::codes;
use pcl2_lang::diagnostic::Diagnostic;
use pcl2_lang::net::{Active, Drive, WordId};
use pcl2_lang::types::Scalar;

/// Settles where each word's value comes from.
pub(super) fn words(builder: &mut Builder<'_>, outline: &Outline) {
    for active in &outline.actives {
        self::active(builder, active);
    }
    for name in &outline.blocked {
        blocked(builder, *name);
    }
    for i in 0..builder.net.words.len() {
        drive(builder, i);
    }
}

fn drive(builder: &mut Builder<'_>, index: usize) {
    let levels = std::mem::take(&mut builder.levels[index]);
    let word = &builder.net.words[index];
    let (name, span) = (word.name.clone(), word.span);
    let symbol = builder.symbols.intern(&name);
    if builder.names.get(&symbol).is_some_and(|(thing, _)| *thing == Thing::Spoiled) {
        return;
    }
    match (levels.is_empty(), builder.written[index]) {
        (false, Some(place)) => {
            let message = format!("expected `{name}` driven by boxes or written by statements, found both");
            let help = "a level is true while a box is marked; what a statement writes stays: take two outputs";
            builder.complain(codes::DRIVE, place, message, help);
        }
        (false, None) if word.scalar == Scalar::Real => {
            let message = format!("expected an int for `{name}`, which boxes drive, found a real");
            builder.complain(codes::DRIVE, span, message, "declare it int, or write it by SIGNAL boxes");
        }
        (false, None) => builder.net.words[index].drive = Drive::Level(levels),
        (true, Some(_)) => {}
        // What drives it may be wrong otherwise, which was reported.
        (true, None) if !builder.sound || super::mistakes(builder.diagnostics) > builder.before => {}
        (true, None) if index < builder.net.outputs => {
            let message = format!("expected a box that drives `{name}` or a statement that writes it, found none");
            let help = format!("say `DRIVES {name}` at a box, or `DO {name} = ..`");
            builder.miss(codes::DRIVE, span, message, &help);
        }
        // A local that nobody writes is a constant.
        (true, None) => {}
    }
}

fn active(builder: &mut Builder<'_>, line: &ActiveLine) {
    let step = output(builder, line.step, Scalar::Int, "ACTIVE");
    let time = line.time.map(|name| output(builder, name, Scalar::Real, "ACTIVE"));
    let mut boxes = Vec::new();
    for name in &line.boxes {
        let place = builder.own_box(*name);
        if place.is_some_and(|place| boxes.contains(&place)) {
            let message = format!("expected each box once, found `{}` again", builder.written_text(name.span()));
            builder.complain(codes::NET_LINE, name.span(), message, "the output gives the place of a box in the list");
        }
        boxes.extend(place);
    }
    let (Some(step), Some(time)) = (step, time.map_or(Some(None), |time| time.map(Some))) else {
        return;
    };
    builder.net.actives.push(Active { step, time, boxes });
}

fn blocked(builder: &mut Builder<'_>, name: Name) {
    if builder.net.blocked.is_some() {
        builder.complain(
            codes::NET_LINE,
            name.span,
            "expected BLOCKED once, found it again",
            "one output tells of all permissives of a net",
        );
    }
    builder.net.blocked = output(builder, name, Scalar::Int, "BLOCKED");
}

/// An output that the net fills itself.
fn output(builder: &mut Builder<'_>, name: Name, scalar: Scalar, clause: &str) -> Option<WordId> {
    match builder.names.get(&name.symbol).map(|(thing, _)| *thing) {
        Some(Thing::Word(word)) if builder.net.words[word.0 as usize].scalar == scalar => {
            if let Some(place) = builder.written[word.0 as usize].replace(name.span) {
                let message = format!("expected `{}` written by {clause} alone, found more", builder.text(name));
                let report = Diagnostic::new(codes::DRIVE, name.span, message);
                builder.diagnostics.push(report.label(place, "the other").help("take two outputs"));
            }
            Some(word)
        }
        Some(Thing::Word(_)) => {
            let wanted = if scalar == Scalar::Int { "an int" } else { "a real" };
            let message = format!("expected {wanted} here, found `{}`", builder.text(name));
            let help = match clause {
                "ACTIVE" => "ACTIVE gives the place of the marked box as an int, and the time in it as a real",
                _ => "BLOCKED gives the number of a permissive term as an int",
            };
            builder.complain(codes::TYPE_DIFFERS, name.span, message, help);
            None
        }
        Some(Thing::Spoiled) => None,
        Some(Thing::Port | Thing::Param | Thing::Box(_) | Thing::Part(_)) => {
            let message = format!("expected an output, found `{}`", builder.text(name));
            builder.complain(codes::NET_NAME, name.span, message, &format!("{clause} fills outputs"));
            None
        }
        None => {
            builder.unknown(name, "an output");
            None
        }
    }
}
