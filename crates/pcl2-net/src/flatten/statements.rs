//! Statements of the nets inside, in the names of the flat net.

use super::words::shown;
use super::{Flattener, words::Word};
use pcl2_lang::ast::{Item, Operand, Output, Statement};
use pcl2_lang::decl::TypeExpr;
use pcl2_lang::lexer::{Lexer, NET_WORDS, Token};
use pcl2_lang::net::{CAUSE, Kind, READY, StatementId};
use pcl2_lang::source::Span;

/// What stands in a place of a list; nothing.
const EMPTY: &Operand = &Operand::Empty;

impl Flattener<'_> {
    /// What each input of a scope is connected to, in the names of the net around.
    pub(super) fn given(&self, scope: usize) -> Vec<&Operand> {
        let ports = self.scopes[scope].decl.ports().map(|port| port.name.as_str());
        self.connection(scope).map_or(Vec::new(), |part| self.placed(part.inputs(), ports.collect()))
    }

    /// The statement that connects a scope.
    fn connection(&self, scope: usize) -> Option<&Statement> {
        let outer = &self.scopes[self.scopes[scope].outer];
        let index = outer.parts.iter().position(|part| *part == scope)?;
        Some(outer.statement(outer.net.parts[index].statement))
    }

    /// The items of a list, by position and by name.
    fn placed<'i>(&self, items: &'i [Item], names: Vec<&str>) -> Vec<&'i Operand> {
        let labelled =
            |item: &&Item, name: &str| item.label().is_some_and(|label| self.symbols.text(label.symbol) == name);
        let one = |(i, name): (usize, &str)| {
            let named = items.iter().find(|item| labelled(item, name));
            let placed = items.get(i).filter(|item| item.label().is_none() && !item.is_empty());
            named.or(placed).map_or(EMPTY, |item| &item.value)
        };
        names.into_iter().enumerate().map(one).collect()
    }

    /// A value, a box or a parameter of a scope in the flat net. `None`: the name is none of them.
    fn named(&self, scope: usize, name: &str) -> Result<Option<String>, String> {
        let own = &self.scopes[scope];
        if let Some(index) = own.net.words.iter().position(|word| word.name == name) {
            return Ok(Some(self.words[scope][index].name.clone()));
        }
        if let Some(id) = own.find(name) {
            return Ok(Some(self.names.place(scope, id).to_owned()));
        }
        if scope == 0 {
            let mut head =
                own.decl.ports().map(|port| &port.name).chain(own.decl.params.iter().map(|param| &param.name));
            return Ok(head.any(|known| known == name).then(|| name.to_owned()));
        }
        if let Some(index) = own.decl.ports().position(|port| port.name == name) {
            return self.input(scope, index).map(Some);
        }
        match own.decl.params.iter().position(|param| param.name == name) {
            Some(index) => self.param(scope, index).map(Some),
            None => Ok(None),
        }
    }

    fn input(&self, scope: usize, index: usize) -> Result<String, String> {
        let default = self.scopes[scope].decl.ports().nth(index).and_then(|port| port.default.clone());
        let given = self.given(scope);
        match given.get(index).copied().unwrap_or(EMPTY) {
            Operand::Empty => Ok(shown(&default.unwrap_or(pcl2_lang::types::Value::Int(0)))),
            operand => self.operand(self.scopes[scope].outer, operand)?.ok_or_else(|| self.unknown_input(scope, index)),
        }
    }

    fn unknown_input(&self, scope: usize, index: usize) -> String {
        let name = self.scopes[scope].decl.ports().nth(index).map_or("", |port| port.name.as_str());
        format!("`{}`: expected a value of the net around for its input `{name}`, found another", self.path(scope))
    }

    fn param(&self, scope: usize, index: usize) -> Result<String, String> {
        let own = &self.scopes[scope];
        let declared = &own.decl.params[index];
        let TypeExpr::Scalar(_) = declared.ty else {
            let (part, name) = (self.path(scope), &declared.name);
            return Err(format!("`{part}`: expected a number as parameter `{name}`, found another type"));
        };
        let names = own.decl.params.iter().map(|param| param.name.as_str()).collect();
        let given = self.connection(scope).map_or(Vec::new(), |part| self.placed(part.params(), names));
        match given.get(index).copied().unwrap_or(EMPTY) {
            Operand::Empty => Ok(declared.default.as_ref().map(shown).unwrap_or_default()),
            Operand::Number(pcl2_lang::ast::Number::Int(value)) => Ok(match declared.ty {
                TypeExpr::Scalar(pcl2_lang::types::Scalar::Real) => format!("{value}."),
                _ => value.to_string(),
            }),
            Operand::Number(pcl2_lang::ast::Number::Real(value)) => Ok(format!("{:?}", value.wide)),
            operand => self.operand(own.outer, operand)?.ok_or_else(|| {
                format!("`{}`: expected a number or a parameter for `{}`", self.path(scope), declared.name)
            }),
        }
    }

    /// An operand in the flat net. `None`: it stays as it is written.
    fn operand(&self, scope: usize, operand: &Operand) -> Result<Option<String>, String> {
        match operand {
            Operand::Name(name) => self.named(scope, self.symbols.text(name.symbol)),
            Operand::Element(element) => {
                let (name, indexes) = (self.symbols.text(element.0.symbol), &element.1);
                let numbers: Vec<String> = indexes.iter().map(|(index, _)| index.to_string()).collect();
                let numbers = numbers.join(",");
                if let Some(id) = self.scopes[scope].find(&format!("{name}[{numbers}]")) {
                    return Ok(Some(self.names.place(scope, id).to_owned()));
                }
                let base = self.named(scope, name)?.unwrap_or_else(|| name.to_owned());
                match base.ends_with(']') {
                    true => Err(format!("`{}`: expected a vector as `{name}`, found `{base}`", self.path(scope))),
                    false => Ok(Some(format!("{base}[{numbers}]"))),
                }
            }
            Operand::Member(member) => {
                self.member(scope, self.symbols.text(member.0.symbol), self.symbols.text(member.1.symbol)).map(Some)
            }
            Operand::Empty | Operand::Number(_) | Operand::Text(_) => Ok(None),
        }
    }

    /// An attribute of a box's token, or a box of a part.
    fn member(&self, scope: usize, owner: &str, member: &str) -> Result<String, String> {
        let own = &self.scopes[scope];
        if let Some(id) = own.find(owner) {
            let place = own.net.place(id);
            let told = place.asks() && [CAUSE, READY].contains(&member);
            if told || own.net.attributes(place).iter().any(|attribute| attribute.name == member) {
                if matches!(place.kind, Kind::Macro(_)) {
                    return Err(format!(
                        "`{owner}.{member}`: expected an attribute of another box, found one of a macro's token, which \
                         stands in the macro's net"
                    ));
                }
                return Ok(format!("{}.{member}", self.names.place(scope, id)));
            }
        }
        let inner = own.part(owner).map(|part| own.parts[part.0 as usize]);
        let found = inner.and_then(|inner| Some((inner, self.scopes[inner].find(member)?)));
        let (inner, id) = found.ok_or_else(|| format!("expected a box of a part, found `{owner}.{member}`"))?;
        Ok(self.names.place(inner, id).to_owned())
    }

    /// A condition, or a value that is asked for.
    pub(super) fn condition(&self, scope: usize, id: StatementId) -> Result<String, String> {
        self.rewritten(scope, self.scopes[scope].statement(id))
    }

    /// DO lines of a statement that writes, and of what takes the values that it wrote.
    pub(super) fn action(&self, scope: usize, id: StatementId, word: &str) -> Result<String, String> {
        let statement = self.scopes[scope].statement(id);
        let mut text = format!("{word} {}\n", self.rewritten(scope, statement)?);
        for output in &statement.outputs {
            let Output::Name(name) = output else {
                continue;
            };
            let name = self.symbols.text(name.symbol);
            let index = self.scopes[scope].net.words.iter().position(|word| word.name == name);
            let known: Option<&Word> = index.map(|index| &self.words[scope][index]);
            for copy in known.map_or(&[][..], |known| &known.copies) {
                let from = known.map_or("", |known| known.name.as_str());
                text.push_str(&format!("{word} {copy} = {from}\n"));
            }
        }
        Ok(text)
    }

    /// A statement as it is written, with other names.
    fn rewritten(&self, scope: usize, statement: &Statement) -> Result<String, String> {
        let mut changes: Vec<(Span, String)> = Vec::new();
        for item in statement.inputs().iter().chain(statement.params()) {
            changes.extend(self.operand(scope, &item.value)?.map(|text| (item.span, text)));
        }
        for output in &statement.outputs {
            let text = match output {
                Output::Name(name) => self.named(scope, self.symbols.text(name.symbol))?,
                Output::Member(owner, name) => {
                    Some(self.member(scope, self.symbols.text(owner.symbol), self.symbols.text(name.symbol))?)
                }
                Output::Discard(_) => None,
            };
            changes.extend(text.map(|text| (output.span(), text)));
        }
        changes.sort_by_key(|(span, _)| span.start);
        Ok(self.replaced(statement.span, &changes))
    }

    /// The tokens of a text, some of them replaced; without comments and line ends.
    fn replaced(&self, span: Span, changes: &[(Span, String)]) -> String {
        let mut changes = changes.iter().peekable();
        let mut words: Vec<&str> = Vec::new();
        let mut next = 0;
        let text = self.sources.text(span);
        for lexeme in Lexer::new(text, &NET_WORDS) {
            let (start, end) = (span.start + lexeme.start, span.start + lexeme.end);
            if lexeme.token == Token::Newline || start < next {
                continue;
            }
            match changes.next_if(|(place, _)| place.start == start) {
                Some((place, change)) => {
                    words.push(change);
                    next = place.end;
                }
                None => words.push(&text[(start - span.start) as usize..(end - span.start) as usize]),
            }
        }
        words.join(" ")
    }
}
