//! Pass 4: a signal for each output, a source for each port.

use crate::Input;
use crate::bind::count_word;
use crate::draft::{Draft, Scope, Wire};
use crate::number::{output_count, output_names, takes_number};
use pcl2_lang::ast::{Item as Place, Name, Number, Operand, Output};
use pcl2_lang::codes;
use pcl2_lang::decl::{Decl, PortDecl, TypeExpr};
use pcl2_lang::diagnostic::{self, Diagnostic};
use pcl2_lang::kernel;
use pcl2_lang::net::BOX_OUTPUT;
use pcl2_lang::program::{BlockId, Cell, CellId, Role, SignalId, Source, Tracked, Writer};
use pcl2_lang::source::Span;
use pcl2_lang::suggest;
use pcl2_lang::types::{Real, Type, Value, Width};

/// Connects outputs and ports of a scope.
pub(crate) fn connect<'a>(input: &Input<'a>, scope: &mut Scope<'a>, diagnostics: &mut Vec<Diagnostic>) {
    crate::alone::inputs(input, scope);
    own_ports(scope, input);
    own_words(scope, input);
    own_values(scope, input, diagnostics);
    for i in writing_order(input, scope) {
        outputs(input, scope, i, diagnostics);
    }
    scope.by_number.sort();
    for wire in scope.wires.iter_mut().filter(|wire| wire.writers.len() > 1) {
        wire.writers.sort_by_key(|writer| writer.block);
    }
    for i in 0..scope.drafts.len() {
        if diagnostic::enough(diagnostics) {
            return;
        }
        Wirer { input, scope, diagnostics, block: i }.ports();
    }
}

/// The lowest-numbered writer of a signal comes first, those of INITIALIZE before all others.
pub(crate) fn writing_order(input: &Input<'_>, scope: &Scope<'_>) -> Vec<usize> {
    let has_initialize = has_initialize(input, scope);
    let mut order: Vec<usize> = (0..scope.drafts.len()).collect();
    order.sort_by_key(|i| {
        let draft = &scope.drafts[*i];
        (draft.section != 0 || !has_initialize, draft.number)
    });
    order
}

fn has_initialize(input: &Input<'_>, scope: &Scope<'_>) -> bool {
    use pcl2_lang::ast::Line;
    scope.owner.is_none() && input.tree.lines.iter().any(|line| matches!(line, Line::Initialize(_)))
}

/// What belongs to a box of a net: it is written `box.attribute`.
fn owned(
    input: &Input<'_>,
    scope: &Scope<'_>,
    owner: Name,
    name: Name,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<SignalId> {
    let text = input.symbols.text(name.symbol);
    let found = scope.members.get(&(owner.symbol, text.to_owned())).copied();
    if found.is_none() {
        let known = attributes(scope, owner);
        let message = format!("expected an attribute of `{}`, found `{text}`", input.symbols.text(owner.symbol));
        let help = suggest::help(text, known.iter().map(String::as_str));
        let help = help.unwrap_or_else(|| match known.is_empty() {
            true => "its tokens are plain: give the box a class by OF".to_owned(),
            false => format!("its attributes are {}", known.join(", ")),
        });
        diagnostics.push(Diagnostic::new(codes::NET_NAME, name.span, message).help(help));
    }
    found
}

/// The names under which a box's attributes are known.
fn attributes(scope: &Scope<'_>, owner: Name) -> Vec<String> {
    let keys = scope.members.keys().filter(|(symbol, _)| *symbol == owner.symbol);
    let mut names: Vec<String> = keys.map(|(_, name)| name.clone()).collect();
    names.sort();
    names
}

/// What a net keeps in signals stands behind its ports; its boxes are elements of one of them.
fn own_words<'a>(scope: &mut Scope<'a>, input: &Input<'a>) {
    let Some((decl, net)) = scope.owner.as_ref().and_then(|(decl, _)| Some((*decl, decl.net.as_deref()?))) else {
        return;
    };
    for signal in net.signals() {
        let id = SignalId(scope.wires.len() as u32);
        let symbol = input.symbols.find(signal.owner.as_deref().unwrap_or(&signal.name));
        let name = match (&signal.owner, symbol) {
            (Some(owner), Some(symbol)) => {
                scope.members.insert((symbol, signal.name.clone()), id);
                format!("{owner}.{}", signal.name)
            }
            (None, Some(symbol)) => {
                scope.by_name.insert(symbol, id);
                signal.name.clone()
            }
            (_, None) => signal.name.clone(),
        };
        scope.wires.push(Wire {
            name,
            ty: Some(signal.ty),
            spoiled: false,
            writers: Vec::new(),
            role: Role::Held,
            span: decl.span,
        });
    }
    let tokens = SignalId(scope.wires.iter().position(|wire| wire.name == BOX_OUTPUT).unwrap_or(0) as u32);
    for (i, place) in net.boxes.iter().enumerate() {
        if let Some(symbol) = input.symbols.find(&place.name) {
            scope.elements.insert(symbol, (tokens, i as u32));
        }
    }
}

/// The values that a net begins with must fit into the width.
fn own_values(scope: &Scope<'_>, input: &Input<'_>, diagnostics: &mut Vec<Diagnostic>) {
    let Some((decl, net)) = scope.owner.as_ref().and_then(|(decl, _)| Some((*decl, decl.net.as_deref()?))) else {
        return;
    };
    if input.options.width == Width::F64 {
        return;
    }
    let words = net.words.iter().map(|word| (&word.initial, word.span));
    let tokens = net.boxes.iter().flat_map(|place| place.presets.iter().map(|preset| (preset, place.span)));
    let attributes = net.classes.iter().flat_map(|class| &class.attributes);
    let fresh = attributes.map(|attribute| (&attribute.initial, decl.span));
    let stops = net.operation.iter().flat_map(|operation| &operation.stops);
    let stopped = stops.filter_map(|(_, value)| Some((value.as_ref()?, decl.span)));
    for (value, span) in words.chain(tokens).chain(fresh).chain(stopped) {
        if let Value::Real(value) = value
            && !value.narrow.is_finite()
        {
            diagnostics.push(too_large(*value, span));
        }
    }
}

/// A real number that a float cannot hold.
fn too_large(value: Real, span: Span) -> Diagnostic {
    let message = format!("expected a value that a float can hold, found {:?}", value.wide);
    Diagnostic::new(codes::NUMBER_RANGE, span, message)
}

/// A composite's own ports are signals without a writer.
fn own_ports<'a>(scope: &mut Scope<'a>, input: &Input<'a>) {
    let Some((decl, sizes)) = scope.owner.clone() else {
        return;
    };
    let mut index = 0;
    for port in decl.ports() {
        for i in 0..kernel::count(port.group.as_ref(), &sizes).unwrap_or(0) {
            let name = if port.group.is_some() { format!("{}{}", port.name, i + 1) } else { port.name.clone() };
            let id = SignalId(scope.wires.len() as u32);
            if let Some(symbol) = input.symbols.find(&name) {
                scope.by_name.insert(symbol, id);
            }
            scope.wires.push(Wire {
                name,
                ty: kernel::resolve(&port.ty, &sizes),
                spoiled: false,
                writers: Vec::new(),
                role: Role::Port(index),
                span: decl.span,
            });
            index += 1;
        }
    }
}

fn outputs<'a>(input: &Input<'a>, scope: &mut Scope<'a>, index: usize, diagnostics: &mut Vec<Diagnostic>) {
    let draft = &scope.drafts[index];
    let statement = draft.statement;
    let Some(decl) = draft.decl else {
        spoil_names(scope, index);
        return;
    };
    let sizes: Vec<i32> = draft.sizes.iter().map(|size| size.unwrap_or(0)).collect();
    let count = output_count(decl, &sizes);
    if let Some(extra) = statement.outputs.get(count) {
        let message = format!(
            "expected at most {} of {}, found {}",
            count_word(count, "output"),
            decl.name,
            statement.outputs.len()
        );
        diagnostics.push(Diagnostic::new(codes::OUTPUT_COUNT, extra.span(), message));
        scope.drafts[index].spoiled = true;
        let surplus = statement.outputs[count..].iter().filter_map(|output| match output {
            Output::Name(name) => Some(name.symbol),
            Output::Member(..) | Output::Discard(_) => None,
        });
        scope.spoiled.extend(surplus);
    }
    let names = if statement.outputs.len() < count { output_names(decl, &sizes) } else { Vec::new() };
    let tag = match &statement.outputs[..] {
        [Output::Name(name)] => Some(*name),
        _ => None,
    };
    let first = match statement.outputs.first() {
        Some(Output::Name(name)) => Some(*name),
        Some(Output::Member(..) | Output::Discard(_)) | None => None,
    };
    let block = BlockId(index as u32);
    let number = scope.drafts[index].number;
    let mut ports = 0;
    let mut outputs = Vec::with_capacity(count);
    for o in 0..count {
        let port = names.get(o).map_or("", String::as_str);
        let declared = pcl2_lang::model::output_decl(decl, &sizes, o).map(|index| &decl.outputs[index]);
        let numbered = declared.is_some_and(takes_number);
        let id = match (statement.outputs.get(o), if numbered { tag } else { first }) {
            (Some(Output::Name(name)), _) => named(input, scope, *name),
            (Some(Output::Member(owner, name)), _) => match owned(input, scope, *owner, *name, diagnostics) {
                Some(id) => id,
                None => {
                    scope.drafts[index].spoiled = true;
                    push_wire(scope, String::new(), name.span)
                }
            },
            (None, Some(tag)) => member(input, scope, tag, port),
            (Some(Output::Discard(span)), _) => push_wire(scope, String::new(), *span),
            (None, None) if statement.outputs.is_empty() && numbered => {
                let number = number.saturating_add(ports);
                ports += 1;
                scope.by_number.push(number, block, o as u32);
                push_wire(scope, number.to_string(), statement.code.span)
            }
            (None, None) => push_wire(scope, String::new(), statement.code.span),
        };
        let inout = declared.is_some_and(|output| output.inout);
        let wire = &mut scope.wires[id.0 as usize];
        wire.spoiled |= scope.drafts[index].spoiled;
        wire.writers.reserve_exact(1.max(wire.writers.len()));
        wire.writers.push(Writer { block, output: o as u32, inout });
        outputs.push(id);
    }
    scope.drafts[index].outputs = outputs;
    if ports == 0 {
        scope.by_number.push(number, block, 0);
    }
}

fn spoil_names(scope: &mut Scope<'_>, index: usize) {
    let draft = &scope.drafts[index];
    let names: Vec<Name> = draft
        .statement
        .outputs
        .iter()
        .filter_map(|output| match output {
            Output::Name(name) => Some(*name),
            Output::Member(..) | Output::Discard(_) => None,
        })
        .collect();
    let number = draft.number;
    scope.spoiled.extend(names.iter().map(|name| name.symbol));
    scope.spoiled_numbers.insert(number);
}

fn named(input: &Input<'_>, scope: &mut Scope<'_>, name: Name) -> SignalId {
    if let Some(id) = scope.by_name.get(name.symbol) {
        return id;
    }
    let id = push_wire(scope, input.symbols.text(name.symbol).to_owned(), name.span);
    scope.by_name.insert(name.symbol, id);
    id
}

/// The output of a tag that has no name of its own; blocks that share the tag share it.
fn member(input: &Input<'_>, scope: &mut Scope<'_>, tag: Name, port: &str) -> SignalId {
    let key = (tag.symbol, port.to_owned());
    if let Some(id) = scope.members.get(&key) {
        return *id;
    }
    let id = push_wire(scope, format!("{}.{port}", input.symbols.text(tag.symbol)), tag.span);
    scope.members.insert(key, id);
    id
}

fn push_wire(scope: &mut Scope<'_>, name: String, span: Span) -> SignalId {
    let id = SignalId(scope.wires.len() as u32);
    scope.wires.push(Wire { name, ty: None, spoiled: false, writers: Vec::new(), role: Role::Wire, span });
    id
}

/// How many numbers a block without names may take when its code is not known.
const UNKNOWN_PORTS: u32 = 16;

struct Wirer<'w, 'a> {
    input: &'w Input<'a>,
    scope: &'w mut Scope<'a>,
    diagnostics: &'w mut Vec<Diagnostic>,
    block: usize,
}

impl<'a> Wirer<'_, 'a> {
    fn ports(&mut self) {
        let draft = &self.scope.drafts[self.block];
        let Some(decl) = draft.decl.filter(|_| !draft.spoiled) else {
            return;
        };
        if draft.formula.is_some() {
            return self.operands();
        }
        let operands = std::mem::take(&mut self.scope.drafts[self.block].operands);
        let draft = &self.scope.drafts[self.block];
        let sizes: Vec<i32> = draft.sizes.iter().map(|size| size.unwrap_or(0)).collect();
        let mut sources = Vec::with_capacity(operands.len());
        let mut next = 0;
        for port in decl.ports() {
            for _ in 0..kernel::count(port.group.as_ref(), &sizes).unwrap_or(0) {
                let operand = operands.get(next).copied().flatten();
                match self.source(decl, port, next as u32, operand) {
                    Some(source) => sources.push(source),
                    None => self.scope.drafts[self.block].spoiled = true,
                }
                next += 1;
            }
        }
        let draft = &mut self.scope.drafts[self.block];
        (draft.sources, draft.operands) = (sources, operands);
    }

    /// What stands in an expression.
    fn operands(&mut self) {
        let places: &'a [Place] = self.scope.drafts[self.block].statement.inputs();
        let mut sources = Vec::with_capacity(places.len());
        for place in places {
            let source = match &place.value {
                Operand::Name(name) => self.operand(*name),
                Operand::Element(element) => self.element(element.0, &element.1),
                Operand::Member(member) => self.member(member.0, member.1),
                Operand::Number(Number::Int(value)) => Some(Source::Constant(Value::Int(*value))),
                Operand::Number(Number::Real(value)) => self.real(*value, place.span),
                Operand::Empty | Operand::Text(_) => None,
            };
            match source {
                Some(source) => sources.push(source),
                None => self.scope.drafts[self.block].spoiled = true,
            }
        }
        self.scope.drafts[self.block].sources = sources;
    }

    /// A real number, which must fit into the width.
    fn real(&mut self, value: Real, span: Span) -> Option<Source> {
        if self.input.options.width == Width::F32 && !value.narrow.is_finite() {
            self.diagnostics.push(too_large(value, span));
            return None;
        }
        Some(Source::Constant(Value::Real(value)))
    }

    /// A variable in an expression; in a composite's body also one of its constants.
    fn operand(&mut self, name: Name) -> Option<Source> {
        if let Some(source) = self.named(name) {
            return Some(source);
        }
        let text = self.input.symbols.text(name.symbol);
        if let Some((owner, sizes)) = &self.scope.owner {
            if let Some(size) = owner.sizes.iter().position(|size| size.name == text) {
                return sizes.get(size).map(|value| Source::Constant(Value::Int(*value)));
            }
            if owner.params.iter().any(|param| param.name == text) && owner.net.is_none() {
                let message = format!("expected a variable in an expression, found the parameter `{text}`");
                let help = format!("put it on a wire: `c = msc ( : {text} )`, and use c here");
                self.diagnostics.push(Diagnostic::new(codes::VALUE_KIND, name.span, message).help(help));
                return None;
            }
        }
        if let Some(source) = self.of_net(name) {
            return Some(source);
        }
        self.unknown_variable(name, &[]);
        None
    }

    /// A box of the net, else a variable. A macro has the name of both: of its box, and of the block that it calls.
    fn named(&self, name: Name) -> Option<Source> {
        if let Some((id, element)) = self.scope.elements.get(&name.symbol) {
            return Some(Source::Element(*id, *element));
        }
        self.scope.by_name.get(name.symbol).map(Source::Signal)
    }

    /// The net's own parameter.
    fn of_net(&self, name: Name) -> Option<Source> {
        let owner = self.scope.owner.as_ref().map(|(decl, _)| *decl).filter(|decl| decl.net.is_some())?;
        let text = self.input.symbols.text(name.symbol);
        let index = owner.params.iter().position(|param| param.name == text)?;
        match owner.params[index].ty {
            TypeExpr::Scalar(scalar) => Some(Source::Own(index as u32, scalar)),
            TypeExpr::Vector(..) | TypeExpr::Matrix(..) | TypeExpr::Text | TypeExpr::Time => None,
        }
    }

    fn source(&mut self, decl: &Decl, port: &PortDecl, index: u32, operand: Option<&Place>) -> Option<Source> {
        let Some(place) = operand else {
            return self.unconnected(decl, port, index);
        };
        match &place.value {
            Operand::Empty | Operand::Text(_) => {
                let message =
                    format!("expected a variable or a block number for input `{}`, found a string", port.name);
                self.diagnostics.push(Diagnostic::new(codes::VALUE_KIND, place.span, message));
                None
            }
            Operand::Name(name) => self.name(port, *name),
            Operand::Element(element) => self.element(element.0, &element.1),
            Operand::Member(member) => self.member(member.0, member.1),
            Operand::Number(Number::Int(number)) => self.number(port, *number, place.span),
            Operand::Number(Number::Real(_)) => {
                let text = self.input.sources.text(place.span);
                let message =
                    format!("expected a variable or a block number for input `{}`, found the real `{text}`", port.name);
                let help = format!("put the number on a wire: `c = msc ( : {text} )`, and use c here");
                self.diagnostics.push(Diagnostic::new(codes::REAL_IN_PORT, place.span, message).help(help));
                None
            }
        }
    }

    /// An empty port: an operator cell, or the default.
    fn unconnected(&mut self, decl: &Decl, port: &PortDecl, index: u32) -> Option<Source> {
        let default = port.default.clone()?;
        // Pass 5 gives both their full size, when sizes are known.
        let (ty, value) = (Type::REAL, default);
        if !port.cell || self.scope.owner.is_some() {
            return Some(Source::Constant(value));
        }
        let draft = &self.scope.drafts[self.block];
        let sizes: Vec<i32> = draft.sizes.iter().map(|size| size.unwrap_or(0)).collect();
        let tag = draft.outputs.first().map(|id| self.scope.wire(*id).name.clone()).filter(|name| !name.is_empty());
        let tag = tag.unwrap_or_else(|| draft.number.to_string());
        let id = CellId(self.scope.cells.len() as u32);
        self.scope.cells.push(Cell {
            block: BlockId(self.block as u32),
            port: index,
            name: format!("{tag}.{}", port.name),
            ty,
            initial: value,
            tracks: port.tracks.as_deref().and_then(|name| tracked(decl, &sizes, name)),
        });
        Some(Source::Cell(id))
    }

    fn name(&mut self, port: &PortDecl, name: Name) -> Option<Source> {
        if let Some(source) = self.named(name) {
            return Some(source);
        }
        if let Some(source) = self.of_net(name) {
            return Some(source);
        }
        let text = self.input.symbols.text(name.symbol);
        if let Some(value) = port.tail.names.iter().position(|known| known == text) {
            return Some(Source::Constant(Value::Int(value as i32)));
        }
        self.unknown_variable(name, &port.tail.names);
        None
    }

    /// `choices`: the names that the port's values have.
    fn unknown_variable(&mut self, name: Name, choices: &[String]) {
        if self.scope.spoiled.contains(&name.symbol) {
            return;
        }
        let text = self.input.symbols.text(name.symbol);
        let or = if choices.is_empty() { String::new() } else { format!(", or one of {}", choices.join(", ")) };
        let message = format!("expected a variable that a block writes{or}, found `{text}`");
        let known = self.scope.wires.iter().map(|wire| wire.name.as_str()).filter(|name| !name.is_empty());
        let known = choices.iter().map(String::as_str).chain(known);
        let report = Diagnostic::new(codes::UNKNOWN_VARIABLE, name.span, message);
        let few = self.diagnostics.len() < diagnostic::MAX_ERRORS;
        self.diagnostics.push(match few.then(|| suggest::help(text, known)).flatten() {
            Some(help) => report.help(help),
            None => report.help(format!("no block has `{text}` as an output")),
        });
        self.scope.spoiled.insert(name.symbol);
    }

    fn element(&mut self, name: Name, indexes: &[(i32, Span)]) -> Option<Source> {
        if let Some((id, element)) = self.indexed_box(name, indexes) {
            return Some(Source::Element(id, element));
        }
        let Some(id) = self.scope.by_name.get(name.symbol) else {
            self.unknown_variable(name, &[]);
            return None;
        };
        if let Some((_, span)) = indexes.get(2) {
            let message = format!("expected one or two indexes, found {}", indexes.len());
            self.diagnostics.push(Diagnostic::new(codes::INDEX_RANGE, *span, message));
            return None;
        }
        // Pass 5 fills in the element, when the type is known.
        Some(Source::Element(id, 0))
    }

    /// In a net: the tokens of a box with an index in its name.
    fn indexed_box(&self, name: Name, indexes: &[(i32, Span)]) -> Option<(SignalId, u32)> {
        let [(index, _)] = indexes else {
            return None;
        };
        if self.scope.elements.is_empty() {
            return None;
        }
        let text = format!("{}[{index}]", self.input.symbols.text(name.symbol));
        self.input.symbols.find(&text).and_then(|symbol| self.scope.elements.get(&symbol)).copied()
    }

    /// The first block that has this name alone for all its outputs.
    fn tag(&self, tag: Name) -> Option<BlockId> {
        let writers = &self.scope.wire(self.scope.by_name.get(tag.symbol)?).writers;
        let alone = |block: BlockId| self.scope.drafts[block.0 as usize].statement.outputs.len() == 1;
        writers.iter().map(|writer| writer.block).find(|block| alone(*block))
    }

    fn member(&mut self, tag: Name, member: Name) -> Option<Source> {
        let key = (tag.symbol, self.input.symbols.text(member.symbol).to_owned());
        if let Some(id) = self.scope.members.get(&key) {
            return Some(Source::Signal(*id));
        }
        let Some(block) = self.tag(tag) else {
            if self.scope.by_name.get(tag.symbol).is_some() {
                let text = self.input.symbols.text(tag.symbol);
                let message = format!("expected the tag of a block, found `{text}`, one of several names");
                let report = Diagnostic::new(codes::UNKNOWN_MEMBER, tag.span, message);
                self.diagnostics.push(report.help("a block has a tag when one name stands for all its outputs"));
            } else {
                self.unknown_variable(tag, &[]);
            }
            return None;
        };
        let draft = &self.scope.drafts[block.0 as usize];
        let decl = draft.decl?;
        let sizes: Vec<i32> = draft.sizes.iter().map(|size| size.unwrap_or(0)).collect();
        let names = output_names(decl, &sizes);
        let text = self.input.symbols.text(member.symbol);
        if let Some(index) = names.iter().position(|name| name == text) {
            return draft.outputs.get(index).map(|id| Source::Signal(*id));
        }
        for (output, declared) in decl.outputs.iter().enumerate() {
            if let Some(element) = declared.elements.iter().position(|name| name == text) {
                return draft.outputs.get(output).map(|id| Source::Element(*id, element as u32));
            }
        }
        let message = format!("expected an output of {}, found `{text}`", decl.name);
        let help = if decl.params.iter().any(|param| param.name == text) {
            Some(format!("`{text}` is a parameter: tools and `--set` reach it, ports do not"))
        } else {
            suggest::help(text, names.iter().map(String::as_str))
        };
        let help = help.unwrap_or_else(|| format!("its outputs are {}", names.join(", ")));
        self.diagnostics.push(Diagnostic::new(codes::UNKNOWN_MEMBER, member.span, message).help(help));
        None
    }

    fn number(&mut self, port: &PortDecl, number: i32, span: Span) -> Option<Source> {
        let found = u32::try_from(number).ok().and_then(|number| self.scope.by_number.get(number));
        let Some((block, output)) = found else {
            // A block of which nothing is known may have several outputs.
            let near = |number: u32| (number.saturating_sub(UNKNOWN_PORTS)..=number).rev();
            let known = |number: &u32| self.scope.by_number.get(*number).is_some();
            let spoiled = u32::try_from(number).is_ok_and(|number| {
                near(number).take_while(|n| !known(n)).any(|n| self.scope.spoiled_numbers.contains(&n))
            });
            if !spoiled {
                let message =
                    format!("expected a variable or the number of a block for input `{}`, found {number}", port.name);
                let help = format!(
                    "no block has the number {number}; for a constant write `c = msc ( : {number}. )`, and use c here"
                );
                self.diagnostics.push(Diagnostic::new(codes::UNKNOWN_NUMBER, span, message).help(help));
            }
            return None;
        };
        let draft: &Draft<'_> = &self.scope.drafts[block.0 as usize];
        if let Some(Output::Name(name)) = draft.statement.outputs.first() {
            let text = self.input.symbols.text(name.symbol);
            let message = format!("expected the variable `{text}`, found its block's number {number}");
            let help =
                format!("did you mean the constant {number}? Then use `c = msc ( : {number}. )`; else write `{text}`");
            let report = Diagnostic::new(codes::NUMBER_OF_NAMED, span, message);
            diagnostic::warn(self.diagnostics, report.label(name.span, "the block with this number").help(help));
        }
        draft.outputs.get(output as usize).map(|id| Source::Signal(*id))
    }
}

/// What a cell's `tracks` names.
fn tracked(decl: &Decl, sizes: &[i32], name: &str) -> Option<Tracked> {
    let mut expanded = 0;
    for output in &decl.outputs {
        if output.name == name {
            return Some(Tracked::Output(expanded));
        }
        expanded += pcl2_lang::kernel::count(output.group.as_ref(), sizes)? as u32;
    }
    decl.memory.iter().position(|field| field.name == name).map(|field| Tracked::Memory(field as u32))
}

/// A default for each element of a port.
pub(crate) fn spread(value: Value, ty: Type) -> Value {
    use pcl2_lang::types::{Scalar, Shape};
    match (value, ty.scalar) {
        (Value::Int(value), Scalar::Real) => spread(Value::Real(Real::from_int(value)), ty),
        (value, _) if ty.shape == Shape::Scalar => value,
        (Value::Real(value), _) => Value::Reals(vec![value; ty.elements()].into()),
        (Value::Int(value), _) => Value::Ints(vec![value; ty.elements()].into()),
        (value, _) => value,
    }
}
