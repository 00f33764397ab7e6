//! Pass 2: words, classes, boxes and parts have their places and names of their own.

use super::outline::{Outline, Placed};
use super::{Builder, Thing, operation, zero};
use pcl2_lang::ast::Name;
use pcl2_lang::ast::net::{BoxKind, BoxLine, Preset, Typed};
use pcl2_lang::codes;
use pcl2_lang::decl::{Item, OutputDecl, PortDecl, Tail, TypeExpr};
use pcl2_lang::declare::net::HeadNames;
use pcl2_lang::net::{
    Attribute, BOX_OUTPUT, BoxId, Class, Drive, Kind, MAX_COUNT, NetBox, Order, PartId, Word, WordId,
};
use pcl2_lang::source::Span;
use pcl2_lang::suggest;
use pcl2_lang::types::{Scalar, Value};

/// Gives everything its place.
pub(super) fn collect(builder: &mut Builder<'_>, names: &HeadNames, outline: &Outline) {
    head(builder, names);
    commands(builder, outline);
    operation::modes(builder, outline);
    for local in &outline.locals {
        builder.local(local);
    }
    for (name, attributes) in &outline.classes {
        builder.class(*name, attributes);
    }
    placed(builder, outline);
    builder.presets(&outline.starts);
}

/// Ports, parameters and outputs of the head.
fn head(builder: &mut Builder<'_>, names: &HeadNames) {
    let span = builder.decl.span;
    let ports: Vec<PortDecl> = builder.decl.ports().cloned().collect();
    if builder.decl.items.len() != ports.len() || ports.iter().any(|port| port.group.is_some()) {
        let message = "expected ports only in the head of a net, found a constant or a group";
        builder.complain(codes::BAD_DECLARATION, span, message, "a net has one size; take a vector: `ivec[5] done`");
    }
    names.ports.iter().for_each(|name| builder.declare_name(*name, Thing::Port));
    names.params.iter().for_each(|name| builder.declare_name(*name, Thing::Param));
    for (output, name) in builder.decl.outputs.clone().into_iter().zip(&names.outputs) {
        let TypeExpr::Scalar(scalar) = output.ty else {
            let message =
                format!("expected an int or a real as output of a net, found another type for `{}`", output.name);
            builder.complain(codes::BAD_DECLARATION, name.span, message, "give each element an output of its own");
            builder.names.insert(name.symbol, (Thing::Spoiled, name.span));
            continue;
        };
        builder.word(&output.name, scalar, zero(scalar), name.span);
    }
    builder.net.outputs = builder.net.words.len();
}

/// Commands that a gate clears: a word takes the port's value in each scan, and stands for its name.
fn commands(builder: &mut Builder<'_>, outline: &Outline) {
    for name in &outline.momentary {
        let text = builder.text(*name);
        if let Some(port) = builder.momentary(*name, &text) {
            builder.command(port, &text, name.span);
        }
    }
}

fn placed(builder: &mut Builder<'_>, outline: &Outline) {
    for placed in &outline.order {
        match placed {
            Placed::Box(index) => {
                let line = &outline.boxes[*index].line;
                builder.place(line.name.name, kind_of(line), line.span);
            }
            Placed::Part(index) => {
                let part = &outline.parts[*index];
                let id = PartId(*index as u32);
                match part.is_macro {
                    true => builder.place(part.name.name, Kind::Macro(id), part.name.span()),
                    false => builder.declare_name(part.name.name, Thing::Part(id)),
                }
            }
        }
    }
    let names: Vec<String> = builder.net.boxes.iter().map(|place| place.name.clone()).collect();
    let count = names.len() as i32;
    let ty = TypeExpr::Vector(Scalar::Int, pcl2_lang::decl::Expr::Int(count));
    let name = BOX_OUTPUT.to_owned();
    let tail = Tail { unit: Some("tokens".to_owned()), ..Tail::default() };
    builder.decl.outputs.push(OutputDecl { name, ty, inout: false, group: None, tail, by_name: true, elements: names });
}

/// The kind as far as the line's first word tells; the third pass fills it in.
fn kind_of(line: &BoxLine) -> Kind {
    match line.kind {
        BoxKind::State | BoxKind::Entry | BoxKind::Exit => Kind::State,
        BoxKind::Count => Kind::Count,
        BoxKind::Operation | BoxKind::Signal => Kind::Action(Vec::new()),
        BoxKind::Process => Kind::Process(Box::default()),
        BoxKind::Capacity | BoxKind::Time | BoxKind::Generation => Kind::Capacity,
    }
}

impl Builder<'_> {
    fn declare(&mut self, name: &str, thing: Thing, span: Span) {
        let symbol = self.symbols.intern(name);
        self.declare_name(Name { symbol, span }, thing);
    }

    fn declare_name(&mut self, name: Name, thing: Thing) {
        let text = self.text(name);
        if text == BOX_OUTPUT {
            let message =
                format!("expected another name than `{BOX_OUTPUT}`, which every net has for the tokens of its boxes");
            self.complain(codes::NET_NAME_TAKEN, name.span, message, "take another name");
            self.names.insert(name.symbol, (Thing::Spoiled, name.span));
            return;
        }
        if let Some((_, other)) = self.port_of(&text) {
            let message = format!("expected a name of its own, found `{text}`, an element of an input");
            let report = pcl2_lang::diagnostic::Diagnostic::new(codes::NET_NAME_TAKEN, name.span, message);
            self.diagnostics.push(report.label(other, "the input").help("take another name"));
        }
        match self.names.get(&name.symbol) {
            Some((_, other)) => {
                let message = format!("expected a name of its own, found `{text}` a second time");
                let report = pcl2_lang::diagnostic::Diagnostic::new(codes::NET_NAME_TAKEN, name.span, message);
                let other = *other;
                self.diagnostics.push(report.label(other, "the first").help("take another name"));
                // Which of the two is meant where it is used is not known.
                self.names.insert(name.symbol, (Thing::Spoiled, other));
            }
            None => {
                self.names.insert(name.symbol, (thing, name.span));
            }
        }
    }

    /// The input whose element is called so.
    fn port_of(&self, text: &str) -> Option<(Thing, Span)> {
        let (owner, _) = text.split_once('[')?;
        let known = self.names.get(&self.symbols.find(owner)?).copied();
        known.filter(|(thing, _)| *thing == Thing::Port)
    }

    fn word(&mut self, name: &str, scalar: Scalar, initial: Value, span: Span) {
        let id = WordId(self.net.words.len() as u32);
        self.declare(name, Thing::Word(id), span);
        self.push_word(name, scalar, initial, span);
    }

    pub(super) fn push_word(&mut self, name: &str, scalar: Scalar, initial: Value, span: Span) {
        let (name, drive) = (name.to_owned(), Drive::Written);
        self.net.words.push(Word { name, scalar, initial, drive, span });
        self.written.push(None);
        self.levels.push(Vec::new());
    }

    fn local(&mut self, local: &Typed) {
        let initial = match local.value {
            Some((number, span)) => self.constant(number, span, local.scalar),
            None => Some(zero(local.scalar)),
        };
        let name = self.text(local.name);
        self.word(&name, local.scalar, initial.unwrap_or_else(|| zero(local.scalar)), local.name.span);
    }

    /// The port of a command: one that a net can clear, and that is no command yet.
    pub(super) fn momentary(&mut self, name: Name, text: &str) -> Option<usize> {
        let int = TypeExpr::Scalar(Scalar::Int);
        let port = self.decl.ports().position(|port| port.name == text && port.cell && port.ty == int);
        if port.is_some_and(|port| self.net.momentary.iter().any(|(known, _)| *known as usize == port)) {
            let message = format!("expected each command once, found `{text}` again");
            self.complain(codes::NET_LINE, name.span, message, "a command is for one thing");
            return None;
        }
        if port.is_none() {
            let message = format!("expected an input that is declared `cell int`, found `{text}`");
            let cells = self.decl.ports().filter(|port| port.cell && port.ty == int).map(|port| port.name.as_str());
            let help = suggest::help(text, cells);
            let help = help.unwrap_or_else(|| format!("declare it in the head: `cell int {text} = 0`"));
            self.complain(codes::NET_LINE, name.span, message, &help);
        }
        port
    }

    pub(super) fn command(&mut self, port: usize, name: &str, span: Span) {
        let id = WordId(self.net.words.len() as u32);
        let symbol = self.symbols.intern(name);
        self.names.insert(symbol, (Thing::Word(id), span));
        self.push_word(name, Scalar::Int, Value::Int(0), span);
        self.written[id.0 as usize] = Some(span);
        let ports = self.decl.items.iter_mut().filter_map(|item| match item {
            Item::Port(port) => Some(port),
            Item::Literal(_) | Item::Constant(_) => None,
        });
        for declared in ports.skip(port).take(1) {
            declared.tracks = Some(name.to_owned());
        }
        let ty = TypeExpr::Scalar(Scalar::Int);
        let (name, tail, elements) = (name.to_owned(), Tail::default(), Vec::new());
        self.decl.outputs.push(OutputDecl { name, ty, inout: false, group: None, tail, by_name: true, elements });
        self.net.outputs += 1;
        self.net.momentary.push((port as u32, id));
    }

    fn class(&mut self, name: Name, attributes: &[Typed]) {
        let text = self.text(name);
        if self.net.classes.iter().any(|class| class.name == text) {
            let message = format!("expected a class of its own name, found `{text}` a second time");
            self.complain(codes::NET_NAME_TAKEN, name.span, message, "take another name");
            return;
        }
        let mut class = Class { name: text, attributes: Vec::new() };
        for attribute in attributes {
            let text = self.text(attribute.name);
            if class.attributes.iter().any(|known| known.name == text) {
                let message = format!("expected an attribute of its own name, found `{text}` a second time");
                self.complain(codes::NET_NAME_TAKEN, attribute.name.span, message, "take another name");
                continue;
            }
            let initial = match attribute.value {
                Some((number, span)) => self.constant(number, span, attribute.scalar),
                None => Some(zero(attribute.scalar)),
            };
            let unit = attribute.unit.map(|span| self.written_text(span).to_owned());
            let initial = initial.unwrap_or_else(|| zero(attribute.scalar));
            class.attributes.push(Attribute { name: text, scalar: attribute.scalar, initial, unit });
        }
        self.net.classes.push(class);
    }

    fn place(&mut self, name: Name, kind: Kind, span: Span) {
        let id = BoxId(self.net.boxes.len() as u32);
        if id.0 as usize == MAX_COUNT {
            let message = format!("expected at most {MAX_COUNT} boxes in a net, found more");
            self.complain(codes::TOO_LARGE, span, message, "divide the net");
        }
        self.declare_name(name, Thing::Box(id));
        let name = self.text(name);
        let (class, capacity, initial) = (None, Some(1), 0);
        let (presets, order) = (Vec::new(), Order::Fifo);
        self.net.boxes.push(NetBox { name, kind, class, capacity, initial, presets, order, span });
    }

    fn presets(&mut self, presets: &[Preset]) {
        for preset in presets {
            let word = match self.names.get(&preset.name.symbol).map(|(thing, _)| *thing) {
                Some(Thing::Word(word)) => word.0 as usize,
                Some(Thing::Spoiled) => continue,
                Some(Thing::Port | Thing::Param | Thing::Box(_) | Thing::Part(_)) => {
                    let message = format!("expected an output, found `{}`", self.text(preset.name));
                    self.complain(codes::NET_NAME, preset.name.span, message, "only outputs have such values");
                    continue;
                }
                None => {
                    self.unknown(preset.name, "an output");
                    continue;
                }
            };
            let scalar = self.net.words[word].scalar;
            if let Some(value) = self.constant(preset.value, preset.span, scalar) {
                self.net.words[word].initial = value;
            }
        }
    }
}
