//! Pass 4: nets inside the net.

use super::gates::commands;
use super::outline::{Outline, PartLines};
use super::{Builder, Thing};
use crate::structure::names::counted;
use pcl2_lang::ast::{Name, Output};
use pcl2_lang::codes;
use pcl2_lang::net::{Abort, BoxId, Class, Drive, Kind, Level, Net, Part, PartId, WordId};

/// Connects the parts.
pub(super) fn parts(builder: &mut Builder<'_>, outline: &mut Outline) {
    for (i, lines) in std::mem::take(&mut outline.parts).into_iter().enumerate() {
        part(builder, PartId(i as u32), lines);
    }
}

fn part(builder: &mut Builder<'_>, id: PartId, lines: PartLines) {
    let PartLines { is_macro, name, mut call, abort } = lines;
    let code = call.code;
    let span = call.span;
    let inner = inner_net(builder, code);
    let targets = std::mem::replace(&mut call.outputs, Box::new([Output::Name(name.name)]));
    let place = builder.net.boxes.iter().position(|place| place.kind == Kind::Macro(id)).map(|i| BoxId(i as u32));
    let statement = builder.statement(call);
    let mut part = Part { name: builder.text(name.name), statement, place, writes: Vec::new(), abort: None, span };
    if let Some(inner) = &inner {
        if is_macro {
            macro_box(builder, id, inner, code);
        }
        connect(builder, id, inner, &targets, &mut part);
    } else {
        builder.unclassed.extend(place);
    }
    if let Some(lines) = abort {
        let clears = commands(builder, &lines.condition);
        let condition = builder.statement(lines.condition);
        let actions = lines.actions.into_iter().map(|statement| builder.action(statement)).collect();
        if let Some(to) = builder.own_box(lines.to) {
            part.abort = Some(Abort { condition, to, clears, actions });
        }
    }
    builder.net.parts.push(part);
}

/// The net behind a part's code.
fn inner_net(builder: &mut Builder<'_>, code: Name) -> Option<Net> {
    let text = builder.text(code);
    match builder.catalogue.find(&text) {
        Some(decl) => match &decl.net {
            Some(net) => return Some((**net).clone()),
            None => {
                let message = format!("expected a net, found the function code `{text}`");
                builder.complain(codes::PART, code.span, message, "call a function code with DO");
            }
        },
        None if builder.catalogue.is_spoiled(&text) => {}
        None => {
            let message = format!("expected a net, found `{text}`");
            let help = format!("there is no `{text}.net` beside this net or in a folder with blocks");
            builder.complain(codes::UNKNOWN_CODE, code.span, message, &help);
        }
    }
    None
}

/// The box of a macro takes the class of the token that goes through it.
fn macro_box(builder: &mut Builder<'_>, id: PartId, inner: &Net, code: Name) {
    let (Some(entry), Some(exit)) = (inner.entry, inner.exit) else {
        let message = format!("expected a net with ENTRY and EXIT as a macro, found `{}`", builder.text(code));
        builder.complain(codes::PART, code.span, message, "a net without them is a MODULE");
        return;
    };
    let marked = inner.boxes.iter().find(|place| place.initial > 0);
    if let Some(place) = marked {
        let message = format!("expected a macro without tokens at the start, found `{}` marked in it", place.name);
        builder.complain(codes::PART, code.span, message, "put boxes that keep tokens into a MODULE");
    }
    let classes = [entry, exit].map(|place| inner.place(place).class.map(|class| &inner.classes[class.0 as usize]));
    if classes[0].map(|class| &class.name) != classes[1].map(|class| &class.name) {
        let message = format!("expected ENTRY and EXIT of one class, found others in `{}`", builder.text(code));
        builder.complain(codes::TOKEN_CLASS, code.span, message, "the token that goes in comes out");
    }
    let class = classes[0].and_then(|class| own_class(builder, class, code));
    let presets = class.map_or(Vec::new(), |class| {
        builder.net.classes[class.0 as usize].attributes.iter().map(|attribute| attribute.initial.clone()).collect()
    });
    for place in builder.net.boxes.iter_mut().filter(|place| place.kind == Kind::Macro(id)) {
        (place.class, place.presets) = (class, presets.clone());
    }
}

/// The class of this net that is the part's.
fn own_class(builder: &mut Builder<'_>, class: &Class, code: Name) -> Option<pcl2_lang::net::ClassId> {
    let found = builder.net.classes.iter().position(|own| own.name == class.name);
    match found {
        Some(index) if builder.net.classes[index] == *class => Some(pcl2_lang::net::ClassId(index as u32)),
        Some(_) => {
            let message =
                format!("expected the class `{}` as `{}` declares it, found another", class.name, builder.text(code));
            builder.complain(codes::TOKEN_CLASS, code.span, message, "declare it alike in both nets");
            None
        }
        None => {
            builder.net.classes.push(class.clone());
            Some(pcl2_lang::net::ClassId(builder.net.classes.len() as u32 - 1))
        }
    }
}

/// Outputs of the part drive or write words of this net.
fn connect(builder: &mut Builder<'_>, id: PartId, inner: &Net, targets: &[Output], part: &mut Part) {
    for (i, target) in targets.iter().enumerate() {
        let name = match target {
            Output::Name(name) => *name,
            Output::Discard(_) => continue,
            Output::Member(name, _) => *name,
        };
        let Some(inner_word) = inner.words.get(i).filter(|_| i < inner.outputs) else {
            let most = counted(inner.outputs, "output", "outputs");
            let message = format!("expected at most {most} of the part, found {}", targets.len());
            builder.complain(codes::OUTPUT_COUNT, name.span, message, "leave the others off");
            return;
        };
        let word = match builder.names.get(&name.symbol).map(|(thing, _)| *thing) {
            Some(Thing::Word(word)) => word,
            Some(Thing::Spoiled) => continue,
            Some(Thing::Port | Thing::Param | Thing::Box(_) | Thing::Part(_)) => {
                let message = format!("expected an output or a local, found `{}`", builder.text(name));
                builder.complain(codes::NET_NAME, name.span, message, "a part gives its outputs to outputs and locals");
                continue;
            }
            None => {
                builder.unknown(name, "an output or a local");
                continue;
            }
        };
        give(builder, id, (i as u32, inner_word), word, name, part);
    }
}

fn give(
    builder: &mut Builder<'_>,
    id: PartId,
    (output, inner): (u32, &pcl2_lang::net::Word),
    word: WordId,
    name: Name,
    part: &mut Part,
) {
    let own = &builder.net.words[word.0 as usize];
    if own.scalar != inner.scalar {
        let message = format!("expected `{}` of the type of `{}`, found another", own.name, inner.name);
        builder.complain(codes::TYPE_DIFFERS, name.span, message, "declare both int or both real");
        return;
    }
    match &inner.drive {
        Drive::Level(_) => builder.levels[word.0 as usize].push(Level::Part(id, output)),
        Drive::Written => {
            builder.written[word.0 as usize].get_or_insert(name.span);
            part.writes.push((output, word));
        }
    }
}
