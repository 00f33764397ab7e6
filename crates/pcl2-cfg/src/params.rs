//! Pass 6: the value of every parameter, in its range.

use crate::Input;
use crate::bind::{count_word, form};
use crate::draft::Scope;
use crate::files::{self, FileText};
use crate::signals::spread;
use pcl2_lang::ast::{Item as Place, Number, Operand, Statement};
use pcl2_lang::bounds;
use pcl2_lang::codes;
use pcl2_lang::decl::{Decl, Expr, ParamDecl, TypeExpr};
use pcl2_lang::diagnostic::{self, Diagnostic};
use pcl2_lang::kernel;
use pcl2_lang::program::{ImageWord, Param};
use pcl2_lang::source::Span;
use pcl2_lang::suggest;
use pcl2_lang::types::{Real, Scalar, Type, Value, Width};

/// Reads the parameters of every block of a scope.
pub(crate) fn read<'a>(input: &Input<'a>, scope: &mut Scope<'a>, diagnostics: &mut Vec<Diagnostic>) {
    let owner = scope.owner.clone();
    for draft in &mut scope.drafts {
        let Some(decl) = draft.decl.filter(|_| draft.sized) else {
            continue;
        };
        let Some(sizes) = draft.known_sizes() else {
            continue;
        };
        if diagnostic::enough(diagnostics) {
            return;
        }
        let before = diagnostics.len();
        let (owner, owner_sizes) = owner.as_ref().map_or((None, &[][..]), |(decl, sizes)| (Some(*decl), sizes));
        let statement = draft.statement;
        let mut reader = Reader { input, owner, owner_sizes, decl, sizes: &sizes, statement, diagnostics };
        let params = reader.read();
        if reader.diagnostics.len() == before {
            reader.check_ranges(&params);
        }
        draft.image = image_word(decl, &params);
        draft.params = params;
        draft.spoiled |= diagnostics[before..].iter().any(Diagnostic::is_error);
    }
}

fn image_word(decl: &Decl, params: &[Param]) -> Option<Box<ImageWord>> {
    let image = decl.image?;
    let address = decl.params.iter().zip(params).filter(|(place, _)| place.fixed).map(|(_, param)| match param {
        Param::Value(Value::Int(value)) => *value,
        Param::Value(_) | Param::Own(_) => 0,
    });
    let address: Vec<i32> = address.collect();
    let texts: Vec<String> = address.iter().map(i32::to_string).collect();
    let name = format!("{}({})", decl.name, texts.join(","));
    Some(Box::new(ImageWord { name, direction: image.direction, scalar: image.scalar, address, fail: None }))
}

struct Reader<'r, 'a> {
    input: &'r Input<'a>,
    owner: Option<&'a Decl>,
    owner_sizes: &'r [i32],
    decl: &'a Decl,
    sizes: &'r [i32],
    statement: &'a Statement,
    diagnostics: &'r mut Vec<Diagnostic>,
}

impl<'a> Reader<'_, 'a> {
    fn read(&mut self) -> Vec<Param> {
        let places = self.statement.params();
        let empty = matches!(places, [only] if only.label().is_none() && only.value == Operand::Empty);
        let positional =
            if empty { 0 } else { places.iter().position(|p| p.label().is_some()).unwrap_or(places.len()) };
        let (by_position, named) = places.split_at(positional);
        let named = if empty { &[] } else { named };
        if let Some(params) = self.whole_list_file(by_position, named) {
            return params;
        }
        let mut params = self.positional(by_position, empty || !named.is_empty());
        self.named(named, &mut params);
        params.into_iter().enumerate().map(|(i, param)| param.unwrap_or_else(|| self.default(i))).collect()
    }

    fn elements(&self, param: &ParamDecl) -> usize {
        kernel::resolve(&param.ty, self.sizes).map_or(1, Type::elements)
    }

    /// A string alone stands for the whole list, unless it is the one text parameter.
    fn whole_list_file(&mut self, places: &[Place], named: &[Place]) -> Option<Vec<Param>> {
        let ([place], []) = (places, named) else {
            return None;
        };
        let Operand::Text(span) = place.value else {
            return None;
        };
        if self.decl.params.iter().any(|param| param.ty == TypeExpr::Text) {
            return None;
        }
        let total: usize = self.decl.params.iter().map(|param| self.elements(param)).sum();
        let Some(numbers) = self.file(span, place.span, total, "the whole list") else {
            return Some(self.decl.params.iter().map(|_| Param::Value(Value::Int(0))).collect());
        };
        let mut numbers = numbers.into_iter();
        let params = &self.decl.params;
        let mut values = Vec::new();
        for param in params {
            let count = self.elements(param);
            let part: Vec<Number> = numbers.by_ref().take(count).collect();
            values.push(Param::Value(self.convert(param, &part, &|_| place.span)));
        }
        Some(values)
    }

    /// Values by position; `open` when the rest may stay away.
    fn positional(&mut self, places: &[Place], open: bool) -> Vec<Option<Param>> {
        let decl = self.decl;
        let mut next = places.iter();
        let mut params = Vec::with_capacity(decl.params.len());
        for (i, param) in decl.params.iter().enumerate() {
            if next.as_slice().is_empty() {
                if !open {
                    self.too_few(i);
                    return decl.params.iter().map(|_| None).collect();
                }
                params.push(None);
                continue;
            }
            params.push(self.one_positional(i, param, &mut next));
        }
        if let Some(extra) = next.next() {
            let total: usize = decl.params.iter().map(|param| self.elements(param)).sum();
            let message =
                format!("expected {} of {}, found {}", count_word(total, "parameter"), decl.name, places.len());
            self.diagnostics.push(Diagnostic::new(codes::PARAM_COUNT, extra.span, message).help(self.form()));
        }
        params
    }

    fn one_positional(
        &mut self,
        index: usize,
        param: &ParamDecl,
        next: &mut std::slice::Iter<'_, Place>,
    ) -> Option<Param> {
        let count = self.elements(param);
        if count == 0 {
            return None;
        }
        let first = next.as_slice().first()?;
        if let Operand::Text(span) = first.value {
            next.next();
            return self.text(param, span, first.span);
        }
        if let Some(own) = self.own(param, first) {
            next.next();
            return Some(own);
        }
        if count == 1 && first.value != Operand::Empty {
            next.next();
            return self.single(param, first).map(Param::Value);
        }
        let available = next.as_slice().len().min(count);
        let places: Vec<&Place> = next.take(available).collect();
        let empty = places.iter().all(|place| place.value == Operand::Empty);
        if empty && available == count && param.default.is_some() {
            return None;
        }
        if available < count {
            self.too_few(index);
            return None;
        }
        self.values(param, &places)
    }

    /// The value of a place with one element.
    fn single(&mut self, param: &ParamDecl, place: &Place) -> Option<Value> {
        let number = self.number(param, place)?;
        if !param.ty.is_scalar() {
            return Some(self.convert(param, &[number], &|_| place.span));
        }
        Some(match scalar_of(param)? {
            Scalar::Int => Value::Int(self.int_of(param, number, place.span)),
            Scalar::Real => Value::Real(self.real_of(param, number, place.span)),
        })
    }

    fn too_few(&mut self, index: usize) {
        let param = &self.decl.params[index];
        let total: usize = self.decl.params.iter().map(|param| self.elements(param)).sum();
        let found = self.statement.params().len();
        let end = self.statement.span.end;
        let at = Span { start: end.saturating_sub(1), ..self.statement.span };
        let expected = count_word(total, "parameter");
        let message = format!("expected {expected} of {}, found {found}: `{}` is missing", self.decl.name, param.name);
        let help = format!("{}; an empty place keeps its comma, an empty list is all defaults", self.form());
        self.diagnostics.push(Diagnostic::new(codes::PARAM_COUNT, at, message).help(help));
    }

    fn values(&mut self, param: &ParamDecl, places: &[&Place]) -> Option<Param> {
        let mut numbers = Vec::with_capacity(places.len());
        for (element, place) in places.iter().enumerate() {
            match self.number(param, place) {
                Some(number) => numbers.push(number),
                None if place.value == Operand::Empty => numbers.push(self.default_number(param, element, place)?),
                None => return None,
            }
        }
        Some(Param::Value(self.convert(param, &numbers, &|element| places[element].span)))
    }

    fn default_number(&mut self, param: &ParamDecl, element: usize, place: &Place) -> Option<Number> {
        match &param.default {
            Some(Value::Int(value)) => Some(Number::Int(*value)),
            Some(Value::Real(value)) => Some(Number::Real(*value)),
            Some(Value::Ints(values)) => values.get(element).map(|value| Number::Int(*value)),
            Some(Value::Reals(values)) => values.get(element).map(|value| Number::Real(*value)),
            Some(Value::Text(_)) | None => {
                let message = format!(
                    "expected a value for `{}` of {}, which has no default, found nothing",
                    param.name, self.decl.name
                );
                self.diagnostics.push(Diagnostic::new(codes::PARAM_COUNT, place.span, message).help(self.form()));
                None
            }
        }
    }

    /// The number in a place; a mistake is reported, an empty place is not.
    fn number(&mut self, param: &ParamDecl, place: &Place) -> Option<Number> {
        let message = match &place.value {
            Operand::Number(number) => return Some(*number),
            Operand::Empty => return None,
            Operand::Name(name) => {
                let text = self.input.symbols.text(name.symbol);
                if let Some(value) = param.tail.names.iter().position(|known| known == text) {
                    return Some(Number::Int(value as i32));
                }
                if !param.tail.names.is_empty() {
                    self.unknown_choice(param, text, place.span);
                    return None;
                }
                format!("expected a number for `{}` of {}, found `{text}`", param.name, self.decl.name)
            }
            Operand::Element(..) | Operand::Member(..) | Operand::Text(_) => {
                let text = self.input.sources.text(place.span);
                format!("expected a number for `{}` of {}, found `{text}`", param.name, self.decl.name)
            }
        };
        let help = "a parameter is a number; what changes from scan to scan comes in by a port, before the `:`";
        self.diagnostics.push(Diagnostic::new(codes::VALUE_KIND, place.span, message).help(help));
        None
    }

    fn unknown_choice(&mut self, param: &ParamDecl, text: &str, span: Span) {
        let names = &param.tail.names;
        let message =
            format!("expected one of {} for `{}` of {}, found `{text}`", names.join(", "), param.name, self.decl.name);
        let report = Diagnostic::new(codes::VALUE_KIND, span, message);
        self.diagnostics.push(match suggest::help(text, names.iter().map(String::as_str)) {
            Some(help) => report.help(help),
            None => report,
        });
    }

    /// In a composite's body: one of its own parameters or constants.
    fn own(&mut self, param: &ParamDecl, place: &Place) -> Option<Param> {
        let Operand::Name(name) = &place.value else {
            return None;
        };
        let owner = self.owner?;
        let text = self.input.symbols.text(name.symbol);
        let index = owner.params.iter().position(|own| own.name == text)?;
        if param.fixed && !owner.params[index].fixed {
            let message = format!(
                "expected a fixed parameter for `{}` of {}, found `{text}`, which can be tuned",
                param.name, self.decl.name
            );
            self.diagnostics.push(
                Diagnostic::new(codes::VALUE_KIND, place.span, message).help(format!("declare `fixed .. {text}`")),
            );
        }
        let (found, wanted) = (self.own_type(&owner.params[index]), self.place_type(param));
        if found != wanted {
            let message = format!(
                "expected {wanted} for `{}` of {}, found `{text}`, which is {found}",
                param.name, self.decl.name
            );
            self.diagnostics.push(Diagnostic::new(codes::VALUE_KIND, place.span, message));
        }
        Some(Param::Own(index as u32))
    }

    /// The type of the composite's own parameter.
    fn own_type(&self, param: &ParamDecl) -> String {
        shown(&param.ty, self.owner_sizes)
    }

    fn place_type(&self, param: &ParamDecl) -> String {
        shown(&param.ty, self.sizes)
    }

    fn named(&mut self, places: &[Place], params: &mut [Option<Param>]) {
        for place in places {
            let Some(label) = place.label() else {
                let message = format!(
                    "expected a named parameter after the named ones of {}, found one without a name",
                    self.decl.name
                );
                self.diagnostics.push(Diagnostic::new(codes::PARAM_COUNT, place.span, message));
                continue;
            };
            let text = self.input.symbols.text(label.symbol);
            let Some(index) = self.decl.params.iter().position(|param| param.name == text) else {
                self.unknown_param(text, label.span);
                continue;
            };
            if params[index].is_some() {
                let message = format!("expected parameter `{text}` once, found it a second time");
                self.diagnostics.push(Diagnostic::new(codes::NAMED_TWICE, label.span, message));
                continue;
            }
            params[index] = self.one_named(index, place);
        }
    }

    fn one_named(&mut self, index: usize, place: &Place) -> Option<Param> {
        let decl = self.decl;
        let param = &decl.params[index];
        if let Operand::Text(span) = place.value {
            return self.text(param, span, place.span);
        }
        if let Some(own) = self.own(param, place) {
            return Some(own);
        }
        let number = self.number(param, place)?;
        let scalar = Type { shape: pcl2_lang::types::Shape::Scalar, scalar: scalar_of(param)? };
        let value =
            self.convert(&ParamDecl { ty: TypeExpr::Scalar(scalar.scalar), ..param.clone() }, &[number], &|_| {
                place.span
            });
        kernel::resolve(&param.ty, self.sizes).map(|ty| Param::Value(spread(value, ty)))
    }

    fn unknown_param(&mut self, text: &str, span: Span) {
        let message = format!("expected the name of a parameter of {}, found `{text}`", self.decl.name);
        let is_port = self.decl.ports().any(|port| port.name == text);
        let help = if is_port {
            Some(format!("`{text}` is an input: it stands before the `:`"))
        } else {
            suggest::help(text, self.decl.params.iter().map(|param| param.name.as_str()))
        };
        let help = help.unwrap_or_else(|| self.form());
        self.diagnostics.push(Diagnostic::new(codes::UNKNOWN_MEMBER, span, message).help(help));
    }

    /// A string: the value of a text parameter, or a file with the numbers of one parameter.
    fn text(&mut self, param: &ParamDecl, span: Span, place: Span) -> Option<Param> {
        if param.ty == TypeExpr::Text {
            return Some(Param::Value(Value::Text(self.input.sources.text(span).into())));
        }
        let numbers = self.file(span, place, self.elements(param), &format!("`{}`", param.name))?;
        Some(Param::Value(self.convert(param, &numbers, &|_| place)))
    }

    fn file(&mut self, span: Span, place: Span, count: usize, what: &str) -> Option<Vec<Number>> {
        let name = self.input.sources.text(span);
        let text = match self.input.files.get(name) {
            Some(FileText::Bytes(bytes)) => bytes,
            Some(FileText::Unusable(why)) => {
                let message = format!("expected a parameter file inside the project's folder, found `{name}`: {why}");
                self.diagnostics.push(Diagnostic::new(codes::PARAM_FILE, place, message));
                return None;
            }
            None => {
                let message = format!("expected a parameter file, found `{name}`, which was not read");
                self.diagnostics.push(Diagnostic::new(codes::PARAM_FILE, place, message));
                return None;
            }
        };
        match files::numbers(text, count) {
            Ok(numbers) => Some(numbers),
            Err(why) => {
                let message = format!("expected {} for {what} in `{name}`, found {why}", count_word(count, "number"));
                self.diagnostics.push(Diagnostic::new(codes::PARAM_FILE, place, message));
                None
            }
        }
    }

    /// Numbers as the parameter's type; an int fits a real place, never the reverse.
    fn convert(&mut self, param: &ParamDecl, numbers: &[Number], span_of: &dyn Fn(usize) -> Span) -> Value {
        let scalar = scalar_of(param).unwrap_or(Scalar::Real);
        let single = param.ty.is_scalar();
        match scalar {
            Scalar::Int => {
                let numbers = numbers.iter().enumerate();
                let ints: Vec<i32> = numbers.map(|(i, number)| self.int_of(param, *number, span_of(i))).collect();
                if single { Value::Int(ints.first().copied().unwrap_or(0)) } else { Value::Ints(ints.into()) }
            }
            Scalar::Real => {
                let numbers = numbers.iter().enumerate();
                let reals: Vec<Real> = numbers.map(|(i, number)| self.real_of(param, *number, span_of(i))).collect();
                if single {
                    Value::Real(reals.first().copied().unwrap_or(Real::ZERO))
                } else {
                    Value::Reals(reals.into())
                }
            }
        }
    }

    fn int_of(&mut self, param: &ParamDecl, number: Number, span: Span) -> i32 {
        match number {
            Number::Int(value) => value,
            Number::Real(_) => {
                let (name, found) = (&param.name, self.found(span));
                let message = format!("expected an integer for `{name}` of {}, found {found}", self.decl.name);
                self.diagnostics.push(Diagnostic::new(codes::VALUE_KIND, span, message));
                0
            }
        }
    }

    fn real_of(&mut self, param: &ParamDecl, number: Number, span: Span) -> Real {
        let real = match number {
            Number::Int(value) => Real::from_int(value),
            Number::Real(value) => value,
        };
        if self.input.options.width == Width::F32 && !real.narrow.is_finite() {
            let message = format!(
                "expected a value that a float can hold for `{}` of {}, found {:?}",
                param.name, self.decl.name, real.wide
            );
            self.diagnostics.push(Diagnostic::new(codes::NUMBER_RANGE, span, message));
        }
        real
    }

    fn default(&mut self, index: usize) -> Param {
        let decl = self.decl;
        let param = &decl.params[index];
        let ty = kernel::resolve(&param.ty, self.sizes);
        match (&param.default, ty) {
            (Some(Value::Text(text)), _) => Param::Value(Value::Text(text.clone())),
            (Some(value), Some(ty)) => Param::Value(spread(value.clone(), ty)),
            (None, Some(ty)) if ty.elements() == 0 => Param::Value(Value::Reals(Box::default())),
            (default, _) => {
                let known = self.diagnostics.last().is_some_and(|last| {
                    last.is_error()
                        && last.span.start >= self.statement.span.start
                        && last.span.end <= self.statement.span.end
                });
                if default.is_none() && !known {
                    let at = Span { start: self.statement.span.end.saturating_sub(1), ..self.statement.span };
                    let message = format!(
                        "expected a value for `{}` of {}, which has no default, found none",
                        param.name, decl.name
                    );
                    self.diagnostics.push(Diagnostic::new(codes::PARAM_COUNT, at, message).help(self.form()));
                }
                Param::Value(Value::Int(0))
            }
        }
    }

    fn check_ranges(&mut self, params: &[Param]) {
        let has_range = |param: &ParamDecl| param.tail.bounds.is_some() || !param.tail.names.is_empty();
        if !self.decl.params.iter().any(has_range) || params.iter().any(|param| matches!(param, Param::Own(_))) {
            return;
        }
        let values: Vec<Value> = params.iter().filter_map(pcl2_lang::model::value).cloned().collect();
        let Err(violation) = bounds::check(self.decl, self.sizes, &values, self.input.options.width) else {
            return;
        };
        let param = &self.decl.params[violation.param];
        let element = if param.ty.is_scalar() { String::new() } else { format!("[{}]", violation.element + 1) };
        let span = self.place_of(violation.param, violation.element);
        let (expected, found) = if self.is_file(span) {
            ("in its declared range".to_owned(), self.found(span))
        } else {
            (violation.expected, violation.found)
        };
        let (name, code) = (&param.name, &self.decl.name);
        let message = format!("expected `{name}{element}` of {code} {expected}, found {found}");
        let mut report = Diagnostic::new(codes::OUT_OF_RANGE, span, message);
        let bounds = param.tail.bounds.as_ref();
        let ends = bounds.map(|bounds| [bounds.lower.as_ref(), bounds.upper.as_ref()]);
        for end in ends.into_iter().flatten().flatten() {
            if let Expr::Param(other) = end {
                let place = self.place_of(*other, 0);
                let message = format!("`{}` stands here", self.decl.params[*other].name);
                report = if place == span { report } else { report.label(place, message) };
            }
        }
        self.diagnostics.push(report);
    }

    /// A file, or a composite's own parameter, stands for all elements of a parameter.
    fn is_one_place(&self, place: Option<&Place>) -> bool {
        place.is_some_and(|place| matches!(place.value, Operand::Text(_) | Operand::Name(_)))
    }

    fn is_file(&self, span: Span) -> bool {
        self.input.sources.text(span).starts_with('"')
    }

    /// What stands in a place. The content of a file is never quoted.
    fn found(&self, span: Span) -> String {
        let text = self.input.sources.text(span);
        if self.is_file(span) { format!("another number in {text}") } else { format!("`{text}`") }
    }

    /// Where the value of a parameter stands.
    fn place_of(&self, param: usize, element: usize) -> Span {
        let places = self.statement.params();
        let name = &self.decl.params[param].name;
        let labelled = places
            .iter()
            .find(|place| place.label().is_some_and(|label| self.input.symbols.text(label.symbol) == *name));
        let mut first = 0;
        for earlier in &self.decl.params[..param] {
            first += if self.is_one_place(places.get(first)) { 1 } else { self.elements(earlier) };
        }
        let element = if self.is_one_place(places.get(first)) { 0 } else { element };
        let alone = places.len() == 1 && self.is_one_place(places.first());
        let by_position = if alone { places.first() } else { places.get(first + element) };
        let by_position = by_position.filter(|place| place.label().is_none());
        labelled.or(by_position).map_or(self.statement.code.span, |place| place.span)
    }

    fn form(&self) -> String {
        format!("the form is {}", form(self.decl))
    }
}

/// A parameter's type as messages show it.
fn shown(ty: &TypeExpr, sizes: &[i32]) -> String {
    match ty {
        TypeExpr::Text => "text".to_owned(),
        _ => kernel::resolve(ty, sizes).map_or_else(|| "of unknown size".to_owned(), |ty| ty.to_string()),
    }
}

fn scalar_of(param: &ParamDecl) -> Option<Scalar> {
    match param.ty {
        TypeExpr::Scalar(scalar) | TypeExpr::Vector(scalar, _) | TypeExpr::Matrix(scalar, ..) => Some(scalar),
        TypeExpr::Text | TypeExpr::Time => None,
    }
}
