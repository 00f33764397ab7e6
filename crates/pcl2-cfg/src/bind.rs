//! Pass 2: the declaration of each statement, its constants, and an operand for each port.

use crate::Input;
use crate::draft::{Draft, Scope};
use crate::formula;
use pcl2_lang::ast::{Item as Place, Number, Operand};
use pcl2_lang::bounds;
use pcl2_lang::codes;
use pcl2_lang::decl::{ConstantDecl, Decl, Item, PortDecl};
use pcl2_lang::diagnostic::{self, Diagnostic};
use pcl2_lang::kernel;
use pcl2_lang::source::Span;
use pcl2_lang::suggest;

/// Binds every statement of a scope.
pub(crate) fn bind<'a>(input: &Input<'a>, scope: &mut Scope<'a>, diagnostics: &mut Vec<Diagnostic>) {
    let owner = scope.owner.clone();
    let owner = owner.as_ref().map(|(decl, sizes)| (*decl, sizes.as_slice()));
    for draft in &mut scope.drafts {
        if diagnostic::enough(diagnostics) {
            draft.spoiled = true;
            continue;
        }
        if let Some(formula) = draft.statement.formula.as_deref() {
            formula::bind(input, draft, formula, diagnostics);
            continue;
        }
        let name = input.symbols.text(draft.statement.code.symbol);
        if input.catalogue.is_spoiled(name) {
            draft.spoiled = true;
            continue;
        }
        let Some(decl) = input.catalogue.find(name) else {
            diagnostics.push(unknown_code(input, name, draft.statement.code.span));
            draft.spoiled = true;
            continue;
        };
        draft.decl = Some(decl);
        let before = diagnostics.len();
        Binder { input, owner, diagnostics, decl, draft, constants: Vec::new() }.inputs();
        draft.spoiled = diagnostics[before..].iter().any(Diagnostic::is_error);
        draft.sized = !draft.spoiled;
    }
}

fn unknown_code(input: &Input<'_>, name: &str, span: Span) -> Diagnostic {
    let message = format!("expected a function code, found `{name}`");
    let help = suggest::help(name, input.catalogue.decls().map(|decl| decl.name.as_str()));
    let help = help.unwrap_or_else(|| "`pcl2 blocks` lists the function codes".to_owned());
    Diagnostic::new(codes::UNKNOWN_CODE, span, message).help(help)
}

struct Binder<'b, 'a> {
    input: &'b Input<'a>,
    owner: Option<(&'a Decl, &'b [i32])>,
    diagnostics: &'b mut Vec<Diagnostic>,
    decl: &'a Decl,
    draft: &'b mut Draft<'a>,
    /// The constants that were read: declaration, value, place.
    constants: Vec<(&'a ConstantDecl, i32, Span)>,
}

impl<'a> Binder<'_, 'a> {
    fn inputs(&mut self) {
        self.draft.sizes = vec![None; self.decl.sizes.len()];
        let places = self.draft.statement.inputs();
        let positional = match places {
            [only] if only.label().is_none() && only.value == Operand::Empty => 0,
            _ => places.iter().position(|place| place.label().is_some()).unwrap_or(places.len()),
        };
        let (by_position, named) = places.split_at(positional);
        let named = if positional == 0 && places.len() == 1 && places[0].label().is_none() { &[] } else { named };
        self.constants_behind_groups(by_position);
        if self.group_fits(by_position) {
            self.walk(by_position, named);
        }
    }

    /// A group's size may stand behind it: what follows the last group is counted from the end.
    fn constants_behind_groups(&mut self, places: &'a [Place]) {
        let is_group = |item: &Item| matches!(item, Item::Port(port) if port.group.is_some());
        let Some(last_group) = self.decl.items.iter().rposition(is_group) else {
            return;
        };
        let behind: Vec<&Item> = self.decl.items[last_group + 1..].iter().filter(|item| !is_optional(item)).collect();
        for (back, item) in behind.iter().rev().enumerate() {
            let (Item::Constant(constant), Some(index)) = (item, places.len().checked_sub(back + 1)) else {
                continue;
            };
            self.draft.sizes[constant.size] = self.integer(&places[index]);
        }
    }

    /// Whether a lone group gets as many ports as the constant behind it says.
    fn group_fits(&mut self, places: &[Place]) -> bool {
        let mut groups = self.decl.ports().filter(|port| port.group.is_some());
        let (Some(port), None) = (groups.next(), groups.next()) else {
            return true;
        };
        let sizes: Vec<i32> = self.draft.sizes.iter().map(|size| size.unwrap_or(0)).collect();
        let is_behind = |item: &&Item| !matches!(item, Item::Port(port) if port.group.is_some());
        let first = self.decl.items.iter().take_while(is_behind).count();
        let others = first + self.decl.items[first + 1..].iter().filter(|item| !is_optional(item)).count();
        let constant_behind = self.decl.items[first + 1..]
            .iter()
            .any(|item| matches!(item, Item::Constant(constant) if self.draft.sizes[constant.size].is_some()));
        let (Some(count), true) = (kernel::count(port.group.as_ref(), &sizes), constant_behind) else {
            return true;
        };
        let found = places.len().saturating_sub(others);
        if found != count {
            let message = format!(
                "expected {} `{}` of {}, as the constant behind them says, found {found}",
                count_word(count, "input"),
                port.name,
                self.decl.name
            );
            let at = places.get(first + count.min(found)).map_or(self.draft.statement.colon, |place| place.span);
            self.push(Diagnostic::new(codes::INPUT_COUNT, at, message).help(self.form()));
        }
        found == count
    }

    fn walk(&mut self, places: &'a [Place], named: &'a [Place]) {
        let decl = self.decl;
        self.draft.operands.reserve_exact(places.len() + named.len());
        let mut next = places.iter();
        let mut labels: Vec<(&str, &'a Place)> = Vec::new();
        for place in named {
            self.label(place, &mut labels);
        }
        let mut after_group = false;
        for item in &decl.items {
            match item {
                Item::Literal(value) => self.literal(*value, next.next()),
                Item::Constant(constant) => {
                    let place = next.next().or_else(|| take(&mut labels, &constant.name));
                    self.constant(constant, place);
                }
                Item::Port(port) if port.group.is_some() => {
                    if !self.group(port, &mut next) {
                        return;
                    }
                    after_group = true;
                }
                Item::Port(port) => {
                    let by_position = if after_group && port.default.is_some() { None } else { next.next() };
                    let by_name = take(&mut labels, &port.name);
                    self.port(port, by_position, by_name);
                }
            }
        }
        self.rest(next.as_slice(), &labels);
        self.ranges();
    }

    fn label(&mut self, place: &'a Place, labels: &mut Vec<(&'a str, &'a Place)>) {
        let Some(label) = place.label() else {
            let message =
                format!("expected a named input after the named ones of {}, found one without a name", self.decl.name);
            self.push(Diagnostic::new(codes::INPUT_COUNT, place.span, message));
            return;
        };
        let symbols = self.input.symbols;
        let text = symbols.text(label.symbol);
        if labels.iter().any(|(known, _)| *known == text) {
            let message = format!("expected each input once, found `{text}` a second time");
            self.push(Diagnostic::new(codes::NAMED_TWICE, label.span, message));
        }
        labels.push((text, place));
    }

    fn literal(&mut self, value: i32, place: Option<&'a Place>) {
        match place {
            Some(place) if place.value == Operand::Number(Number::Int(value)) => {}
            Some(place) => {
                let message =
                    format!("expected the constant {value} of {}, found {}", self.decl.name, self.show(place));
                self.push(Diagnostic::new(codes::CONSTANT_NEEDED, place.span, message).help(self.form()));
            }
            None => self.missing(&format!("the constant {value}")),
        }
    }

    fn constant(&mut self, constant: &'a ConstantDecl, place: Option<&'a Place>) {
        let Some(place) = place else {
            return self.missing(&format!("the constant `{}`", constant.name));
        };
        let Some(value) = self.integer(place) else {
            let message = format!(
                "expected an integer for the constant `{}` of {}, found {}",
                constant.name,
                self.decl.name,
                self.show(place)
            );
            self.push(Diagnostic::new(codes::CONSTANT_NEEDED, place.span, message).help(self.form()));
            return;
        };
        self.draft.sizes[constant.size] = Some(value);
        self.constants.push((constant, value, place.span));
    }

    /// Ranges of constants, which may speak of one another.
    fn ranges(&mut self) {
        let known: Vec<i32> = self.draft.sizes.iter().map(|size| size.unwrap_or(0)).collect();
        for (constant, value, span) in std::mem::take(&mut self.constants) {
            if let Some(expected) = bounds::check_constant(constant.bounds.as_ref(), i64::from(value), &known) {
                let message = format!("expected `{}` of {} {expected}, found {value}", constant.name, self.decl.name);
                self.push(Diagnostic::new(codes::OUT_OF_RANGE, span, message).help(self.form()));
                return;
            }
        }
        let decl = self.decl;
        let ports = decl.ports().map(|port| (&port.name, port.group.as_ref()));
        let outputs = decl.outputs.iter().map(|output| (&output.name, output.group.as_ref()));
        for (name, group) in ports.chain(outputs) {
            let count = group.and_then(|group| Some((group, kernel::size(&group.count, &known)?)));
            let refused =
                count.and_then(|(group, n)| Some((n, bounds::check_constant(group.bounds.as_ref(), n, &known)?)));
            if let Some((n, expected)) = refused {
                let message = format!("expected {expected} ports `{name}` of {}, found {n}", decl.name);
                self.push(
                    Diagnostic::new(codes::OUT_OF_RANGE, self.draft.statement.code.span, message).help(self.form()),
                );
                return;
            }
        }
    }

    /// A literal, or in a composite's body one of its constants.
    fn integer(&self, place: &Place) -> Option<i32> {
        match &place.value {
            Operand::Number(Number::Int(value)) => Some(*value),
            Operand::Name(name) => {
                let (owner, sizes) = self.owner?;
                let text = self.input.symbols.text(name.symbol);
                let index = owner.sizes.iter().position(|size| size.name == text)?;
                sizes.get(index).copied()
            }
            Operand::Empty | Operand::Number(_) | Operand::Element(..) | Operand::Member(..) | Operand::Text(_) => None,
        }
    }

    /// Reads a group of ports. `false`: what follows cannot be told apart from it.
    fn group(&mut self, port: &PortDecl, next: &mut std::slice::Iter<'a, Place>) -> bool {
        let sizes: Vec<i32> = self.draft.sizes.iter().map(|size| size.unwrap_or(0)).collect();
        let Some(count) = kernel::count(port.group.as_ref(), &sizes) else {
            let message = format!(
                "expected 0 to {} ports `{}` of {}, found another number",
                kernel::MAX_PORTS,
                port.name,
                self.decl.name
            );
            self.push(Diagnostic::new(codes::TOO_LARGE, self.draft.statement.code.span, message).help(self.form()));
            return false;
        };
        for _ in 0..count {
            let place = next.next();
            if place.is_none() {
                self.missing(&format!("one of the {count} inputs `{}`", port.name));
                return false;
            }
            self.port(port, place, None);
        }
        true
    }

    fn port(&mut self, port: &PortDecl, by_position: Option<&'a Place>, by_name: Option<&'a Place>) {
        let given = by_position.filter(|place| place.value != Operand::Empty);
        if let (Some(_), Some(named)) = (given, by_name) {
            let message = format!("expected input `{}` once, found it by position and by name", port.name);
            self.push(Diagnostic::new(codes::NAMED_TWICE, named.span, message));
        }
        let operand = given.or(by_name);
        if operand.is_none() && port.default.is_none() {
            match by_position {
                Some(empty) => {
                    let message = format!("expected input `{}` of {}, found nothing", port.name, self.decl.name);
                    self.push(Diagnostic::new(codes::INPUT_COUNT, empty.span, message).help(self.form()));
                }
                None => self.missing(&format!("input `{}`", port.name)),
            }
        }
        self.draft.operands.push(operand);
    }

    fn missing(&mut self, what: &str) {
        let message = format!("expected {what} of {}, found the end of the inputs", self.decl.name);
        let report = Diagnostic::new(codes::INPUT_COUNT, self.draft.statement.colon, message);
        self.push(report.help(self.form()));
    }

    /// Inputs that are left over.
    fn rest(&mut self, places: &[Place], labels: &[(&str, &'a Place)]) {
        if let Some(place) = places.first() {
            let count = self.draft.statement.inputs().len();
            let expected = count_word(count - places.len(), "input");
            let message = format!("expected {expected} of {}, found {count}", self.decl.name);
            self.push(Diagnostic::new(codes::INPUT_COUNT, place.span, message).help(self.form()));
        }
        for (name, place) in labels {
            let message = format!("expected the name of an input of {}, found `{name}`", self.decl.name);
            let span = place.label().map_or(place.span, |label| label.span);
            let help = if self.decl.params.iter().any(|param| param.name == *name) {
                Some(format!("`{name}` is a parameter: it stands behind the `:`"))
            } else {
                suggest::help(name, self.decl.ports().map(|port| port.name.as_str()))
            };
            let help = help.unwrap_or_else(|| self.form());
            self.push(Diagnostic::new(codes::UNKNOWN_MEMBER, span, message).help(help));
        }
    }

    fn show(&self, place: &Place) -> String {
        match place.value {
            Operand::Empty => "nothing".to_owned(),
            _ => format!("`{}`", self.input.sources.text(place.span)),
        }
    }

    fn push(&mut self, diagnostic: Diagnostic) {
        self.diagnostics.push(diagnostic);
    }

    fn form(&self) -> String {
        format!("the form is {}", form(self.decl))
    }
}

/// `1 input`, `2 inputs`
pub(crate) fn count_word(count: usize, noun: &str) -> String {
    if count == 1 { format!("1 {noun}") } else { format!("{count} {noun}s") }
}

fn is_optional(item: &Item) -> bool {
    matches!(item, Item::Port(port) if port.default.is_some())
}

fn take<'a>(labels: &mut Vec<(&str, &'a Place)>, name: &str) -> Option<&'a Place> {
    let index = labels.iter().position(|(label, _)| *label == name)?;
    Some(labels.swap_remove(index).1)
}

/// `gpc2 ( w, y, p, sw, d, N2, Nu : u0, umin, umax, lambda )`
pub(crate) fn form(decl: &Decl) -> String {
    let item = |item: &Item| match item {
        Item::Literal(value) => value.to_string(),
        Item::Constant(constant) => constant.name.clone(),
        Item::Port(port) if port.group.is_some() => format!("{}..", port.name),
        Item::Port(port) if port.default.is_some() => format!("[{}]", port.name),
        Item::Port(port) => port.name.clone(),
    };
    let items: Vec<String> = decl.items.iter().map(item).collect();
    let params: Vec<&str> = decl.params.iter().map(|param| param.name.as_str()).collect();
    let padded = |list: String| if list.is_empty() { list } else { format!("{list} ") };
    format!("{} ( {}: {})", decl.name, padded(items.join(", ")), padded(params.join(", ")))
}
