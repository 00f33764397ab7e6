//! Pass 3: what each box holds and does.

use super::outline::{BoxLines, Outline, Placed};
use super::{Builder, Thing};
use crate::structure::names::counted;
use pcl2_lang::ast::net::{BoxClause, BoxKind, BoxLine, Preset};
use pcl2_lang::ast::{Name, Number, Operand, Statement};
use pcl2_lang::codes;
use pcl2_lang::net::{BoxId, CAUSE, ClassId, Generation, Kind, Level, MAX_COUNT, Order, Process, READY, StatementId};
use pcl2_lang::source::Span;
use pcl2_lang::suggest;
use pcl2_lang::types::{MAX_ELEMENTS, Value};

/// Completes the boxes.
pub(super) fn boxes(builder: &mut Builder<'_>, outline: &mut Outline) {
    let mut id = 0;
    for i in 0..outline.order.len() {
        match outline.order[i] {
            Placed::Box(index) => {
                let lines = &mut outline.boxes[index];
                let (enter, after) = (std::mem::take(&mut lines.enter), std::mem::take(&mut lines.after));
                let (line, broken) = (lines.line.clone(), lines.broken);
                Filler { builder: &mut *builder, id: BoxId(id), line: &line }.fill(BoxLines {
                    line: line.clone(),
                    broken,
                    enter,
                    after,
                });
                id += 1;
            }
            Placed::Part(index) if outline.parts[index].is_macro => id += 1,
            Placed::Part(_) => {}
        }
    }
    whole(builder, outline.parts.is_empty());
}

/// A net has boxes or nets inside, and the tokens fit into memory.
fn whole(builder: &mut Builder<'_>, without_parts: bool) {
    let span = builder.decl.span;
    if builder.net.boxes.is_empty() && without_parts {
        builder.miss(
            codes::NET_LINE,
            span,
            "expected boxes in the net, found none",
            "a net has a box at least: `STATE idle MARKED`",
        );
    }
    let found = builder.net.attribute_places();
    if found > MAX_ELEMENTS {
        let message = format!("expected at most {MAX_ELEMENTS} attributes of all tokens of a net, found {found}");
        builder.complain(codes::TOO_LARGE, span, message, "let boxes hold fewer tokens, or tokens fewer attributes");
    }
}

/// `1 token`, `2 tokens`
pub(super) fn tokens(count: u32) -> String {
    counted(count as usize, "token", "tokens")
}

/// Which boxes have a clause.
fn owners(clause: &BoxClause) -> &'static str {
    match clause {
        BoxClause::Of(_) => "tokens of a COUNT box are plain",
        BoxClause::Marked(..) => "a GENERATE box makes its tokens itself",
        BoxClause::Size(..) | BoxClause::Order(..) => "CAPACITY and GENERATE boxes have it",
        BoxClause::Until(_) | BoxClause::Within(_) => "PROCESS boxes have it",
        BoxClause::When(_) => "GENERATE boxes have it",
        BoxClause::Drives(_) | BoxClause::Do(_) => "all boxes have it",
    }
}

struct Filler<'b, 'a> {
    builder: &'b mut Builder<'a>,
    id: BoxId,
    line: &'b BoxLine,
}

impl Filler<'_, '_> {
    fn fill(&mut self, lines: BoxLines) {
        self.clauses();
        self.capacity();
        self.marking();
        self.kind(lines);
        self.ends();
    }

    fn place(&mut self) -> &mut pcl2_lang::net::NetBox {
        &mut self.builder.net.boxes[self.id.0 as usize]
    }

    /// Whether the kind may have such a clause.
    fn takes(&self, clause: &BoxClause) -> bool {
        let kind = self.line.kind;
        match clause {
            BoxClause::Of(_) => kind != BoxKind::Count,
            BoxClause::Marked(..) => kind != BoxKind::Generation,
            BoxClause::Drives(_) | BoxClause::Do(_) => true,
            BoxClause::Size(..) | BoxClause::Order(..) => matches!(kind, BoxKind::Capacity | BoxKind::Generation),
            BoxClause::Until(_) | BoxClause::Within(_) => kind == BoxKind::Process,
            BoxClause::When(_) => kind == BoxKind::Generation,
        }
    }

    fn clauses(&mut self) {
        let mut seen: Vec<&str> = Vec::new();
        for clause in &self.line.clauses {
            let (word, span) = self.clause_word(clause);
            if !self.takes(clause) {
                let message = format!("expected a clause that a box of this kind has, found {word}");
                self.builder.complain(codes::NET_LINE, span, message, owners(clause));
                if matches!(clause, BoxClause::Of(_)) {
                    self.builder.unclassed.insert(self.id);
                }
                continue;
            } else if seen.contains(&word) {
                let message = format!("expected {word} once, found it again");
                self.builder.complain(codes::NET_LINE, span, message, "delete one of them");
            }
            seen.push(word);
            match clause {
                BoxClause::Of(name) => self.class(*name),
                BoxClause::Drives(names) => names.iter().for_each(|name| self.drives(*name)),
                BoxClause::Size(..) | BoxClause::Order(..) | BoxClause::Marked(..) | BoxClause::Until(_) => {}
                BoxClause::When(_) | BoxClause::Within(_) | BoxClause::Do(_) => {}
            }
        }
        for clause in &self.line.clauses {
            if let BoxClause::Order(word, attribute) = clause {
                self.order(*word, *attribute);
            }
        }
    }

    fn clause_word(&self, clause: &BoxClause) -> (&'static str, Span) {
        let line = self.line.span;
        match clause {
            BoxClause::Of(name) => ("OF", name.span),
            BoxClause::Size(_, span) => ("SIZE", *span),
            BoxClause::Order(name, _) => ("ORDER", name.span),
            BoxClause::Marked(_, _, span) => ("MARKED", *span),
            BoxClause::Drives(names) => ("DRIVES", names.first().map_or(line, |name| name.span)),
            BoxClause::Until(condition) => ("UNTIL", condition.span),
            BoxClause::When(condition) => ("WHEN", condition.span),
            BoxClause::Within(value) => ("WITHIN", value.span),
            BoxClause::Do(statement) => ("DO", statement.span),
        }
    }

    fn class(&mut self, name: Name) {
        let text = self.builder.text(name);
        match self.builder.net.classes.iter().position(|class| class.name == text) {
            Some(class) => self.place().class = Some(ClassId(class as u32)),
            None => {
                let known = self.builder.net.classes.iter().map(|class| class.name.as_str());
                let help = suggest::help(&text, known);
                let help = help.unwrap_or_else(|| format!("declare it: `CLASS {text} ( int kind = 0 )`"));
                let message = format!("expected a class, found `{text}`");
                self.builder.miss(codes::NET_NAME, name.span, message, &help);
                self.builder.unclassed.insert(self.id);
            }
        }
    }

    fn drives(&mut self, name: Name) {
        match self.builder.names.get(&name.symbol).map(|(thing, _)| *thing) {
            Some(Thing::Word(word)) => self.builder.levels[word.0 as usize].push(Level::Box(self.id)),
            Some(Thing::Spoiled) => {}
            Some(Thing::Port | Thing::Param | Thing::Box(_) | Thing::Part(_)) => {
                let message = format!("expected an output, found `{}`", self.builder.text(name));
                self.builder.complain(codes::NET_NAME, name.span, message, "a box drives outputs and locals");
            }
            None => self.builder.unknown(name, "an output"),
        }
    }

    fn order(&mut self, word: Name, attribute: Option<Name>) {
        let text = self.builder.text(word);
        let index = attribute.and_then(|name| self.attribute(name));
        let order = match (text.as_str(), attribute, index) {
            ("fifo", None, _) => Order::Fifo,
            ("lifo", None, _) => Order::Lifo,
            ("least", Some(_), Some(index)) => Order::Least(index),
            ("most", Some(_), Some(index)) => Order::Most(index),
            (_, Some(_), None) => return,
            _ => {
                let message = format!("expected fifo, lifo, or least or most and an attribute, found `{text}`");
                self.builder.complain(codes::NET_LINE, word.span, message, "such as `ORDER fifo` or `ORDER least due`");
                return;
            }
        };
        self.place().order = order;
    }

    /// The index of an attribute of the box's class.
    fn attribute(&mut self, name: Name) -> Option<u32> {
        if self.builder.unclassed.contains(&self.id) {
            return None;
        }
        let text = self.builder.text(name);
        let place = self.builder.net.place(self.id);
        let attributes = self.builder.net.attributes(place);
        let found = attributes.iter().position(|attribute| attribute.name == text);
        if found.is_none() {
            let known: Vec<String> = attributes.iter().map(|attribute| attribute.name.clone()).collect();
            let message = format!("expected an attribute of the tokens of `{}`, found `{text}`", place.name);
            let help = match known.is_empty() {
                true => "its tokens are plain: give the box a class by OF".to_owned(),
                false => format!("the attributes are {}", known.join(", ")),
            };
            self.builder.complain(codes::NET_NAME, name.span, message, &help);
        }
        found.map(|index| index as u32)
    }

    fn capacity(&mut self) {
        let size = self.line.clauses.iter().find_map(|clause| match clause {
            BoxClause::Size(size, span) => Some((*size, *span)),
            _ => None,
        });
        let capacity = match (self.line.kind, size) {
            (BoxKind::Capacity | BoxKind::Generation, Some((size, span))) => {
                let fits = size > 0 && size as usize <= MAX_COUNT;
                if !fits {
                    let message = format!("expected a size from 1 to {MAX_COUNT}, found {size}");
                    self.builder.out_of_range(size, span, message, "say how many tokens the box can hold");
                }
                Some(size).filter(|_| fits)
            }
            (BoxKind::Capacity, None) if self.builder.net.place(self.id).class.is_none() => None,
            (BoxKind::Capacity | BoxKind::Generation, None) => {
                self.builder.complain(codes::NET_LINE, self.line.name.span(), "expected SIZE, found none", "say how many tokens the box can hold: `SIZE 10`; only plain tokens of a CAPACITY box need no limit");
                Some(1)
            }
            (BoxKind::Count, _) => self.count(),
            _ => Some(1),
        };
        self.place().capacity = capacity;
    }

    /// The number of tokens of a counting box.
    fn count(&mut self) -> Option<u32> {
        let quantity = self.line.quantity.as_ref()?;
        let span = quantity.span;
        match quantity.inputs().first()?.value {
            Operand::Number(Number::Int(value)) if value >= 1 && value as usize <= MAX_COUNT => {
                return Some(value.unsigned_abs());
            }
            _ => {
                let found = self.builder.written_text(span);
                let message = format!("expected a number of tokens from 1 to {MAX_COUNT}, found `{found}`");
                self.builder.complain(
                    codes::OUT_OF_RANGE,
                    span,
                    message,
                    "the number is known when the net is compiled",
                );
            }
        }
        Some(1)
    }

    fn marking(&mut self) {
        let marked = self.line.clauses.iter().find_map(|clause| match clause {
            BoxClause::Marked(count, presets, span) => Some((*count, presets.as_slice(), *span)),
            _ => None,
        });
        let place = self.builder.net.place(self.id);
        let mut values: Vec<Value> = self.builder.net.attributes(place).iter().map(|a| a.initial.clone()).collect();
        let Some((count, presets, span)) = marked else {
            self.place().presets = values;
            return;
        };
        let tokens = count.map_or(1, |(count, _)| count);
        if let Some(capacity) = place.capacity.filter(|capacity| tokens > *capacity) {
            let message = format!("expected at most {} in `{}`, found {tokens}", self::tokens(capacity), place.name);
            let span = count.map_or(span, |(_, span)| span);
            self.builder.complain(codes::CAPACITY, span, message, "mark it with fewer, or make it larger");
        }
        for (i, preset) in presets.iter().enumerate() {
            if presets[..i].iter().any(|known| known.name.symbol == preset.name.symbol) {
                let message = format!("expected each attribute once, found `{}` again", self.builder.text(preset.name));
                self.builder.complain(codes::NET_LINE, preset.name.span, message, "delete one of them");
            }
            self.preset(preset, &mut values);
        }
        let place = self.place();
        (place.initial, place.presets) = (tokens, values);
    }

    fn preset(&mut self, preset: &Preset, values: &mut [Value]) {
        let Some(index) = self.attribute(preset.name) else {
            return;
        };
        let place = self.builder.net.place(self.id);
        let scalar = self.builder.net.attributes(place)[index as usize].scalar;
        if let Some(value) = self.builder.constant(preset.value, preset.span, scalar) {
            values[index as usize] = value;
        }
    }

    fn kind(&mut self, lines: BoxLines) {
        let BoxLines { line, broken, enter, after } = lines;
        let has_statements =
            matches!(line.kind, BoxKind::Operation | BoxKind::Signal | BoxKind::Process | BoxKind::Generation);
        if let (false, Some(statement)) = (has_statements, enter.first()) {
            let help = "take an OPERATION, SIGNAL, PROCESS or GENERATE box";
            self.builder.complain(
                codes::NET_LINE,
                statement.span,
                "expected a box that runs statements above DO, found another",
                help,
            );
        }
        if let (false, Some(statement)) = (line.kind == BoxKind::Process, after.first()) {
            self.builder.complain(
                codes::NET_LINE,
                statement.span,
                "expected a PROCESS box above AFTER, found another",
                "AFTER runs when a process is complete or late",
            );
        }
        let kind = match line.kind {
            BoxKind::State | BoxKind::Entry | BoxKind::Exit => Kind::State,
            BoxKind::Capacity => Kind::Capacity,
            BoxKind::Count => Kind::Count,
            BoxKind::Time => match line.quantity.clone() {
                Some(time) => Kind::Time(self.time(*time)),
                None => Kind::State,
            },
            BoxKind::Operation | BoxKind::Signal => self.action(&line, enter, broken),
            BoxKind::Process => self.process(&line, enter, after),
            BoxKind::Generation => self.generation(&line, enter),
        };
        self.place().kind = kind;
    }

    fn action(&mut self, line: &BoxLine, enter: Vec<Statement>, broken: bool) -> Kind {
        if enter.is_empty() && !broken {
            self.builder.complain(
                codes::NET_LINE,
                line.name.span(),
                "expected DO in or below the line, found none",
                "such as `SIGNAL open DO v1 = 1`",
            );
        }
        Kind::Action(enter.into_iter().map(|statement| self.builder.action(statement)).collect())
    }

    fn process(&mut self, line: &BoxLine, enter: Vec<Statement>, after: Vec<Statement>) -> Kind {
        let mut process = Process::default();
        for name in [CAUSE, READY] {
            let place = self.builder.net.place(self.id);
            if !after.is_empty() && self.builder.net.attributes(place).iter().any(|attribute| attribute.name == name) {
                let message = format!("expected a class without the attribute `{name}`, which AFTER has for itself");
                self.builder.complain(codes::NET_NAME_TAKEN, line.name.span(), message, "call the attribute otherwise");
            }
        }
        process.enter = enter.into_iter().map(|statement| self.builder.action(statement)).collect();
        process.after = after.into_iter().map(|statement| self.builder.action(statement)).collect();
        for clause in &line.clauses {
            match clause {
                BoxClause::Until(condition) => process.until = Some(self.builder.statement((**condition).clone())),
                BoxClause::Within(time) => process.within = Some(self.time((**time).clone())),
                _ => {}
            }
        }
        Kind::Process(Box::new(process))
    }

    fn time(&mut self, time: Statement) -> StatementId {
        let below_zero = match time.inputs().first().map(|item| &item.value) {
            Some(Operand::Number(Number::Int(value))) => *value < 0,
            Some(Operand::Number(Number::Real(value))) => value.wide < 0.,
            Some(Operand::Empty | Operand::Name(_) | Operand::Element(_) | Operand::Member(_) | Operand::Text(_)) => {
                false
            }
            None => false,
        };
        if below_zero {
            let message = format!("expected a time from 0, found `{}`", self.builder.written_text(time.span));
            self.builder.complain(codes::OUT_OF_RANGE, time.span, message, "times are in seconds");
        }
        self.builder.statement(time)
    }

    fn generation(&mut self, line: &BoxLine, enter: Vec<Statement>) -> Kind {
        let when = line.clauses.iter().find_map(|clause| match clause {
            BoxClause::When(condition) => Some((**condition).clone()),
            _ => None,
        });
        let Some(when) = when else {
            self.builder.complain(
                codes::NET_LINE,
                line.name.span(),
                "expected WHEN, found none",
                "a token is made when a condition becomes true: `WHEN request`",
            );
            return Kind::Capacity;
        };
        let when = self.builder.statement(when);
        let enter = enter.into_iter().map(|statement| self.builder.action(statement)).collect();
        Kind::Generation(Box::new(Generation { when, enter }))
    }

    /// Entry and exit boxes.
    fn ends(&mut self) {
        let span = self.line.name.span();
        let id = self.id;
        let end = match self.line.kind {
            BoxKind::Entry => &mut self.builder.net.entry,
            BoxKind::Exit => &mut self.builder.net.exit,
            _ => return,
        };
        if end.replace(id).is_some() {
            self.builder.complain(
                codes::NET_LINE,
                span,
                "expected one ENTRY and one EXIT, found a second",
                "a macro's token comes in at one box and goes out at one",
            );
        }
    }
}
