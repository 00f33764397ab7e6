//! Values of the nets inside: each becomes a LOCAL, or the value of the net around to which it goes.

use super::Flattener;
use pcl2_lang::ast::{Operand, Output, Statement};
use pcl2_lang::decl::PortDecl;
use pcl2_lang::net::{Drive, Kind, Level, PartId, WordId};
use pcl2_lang::types::{Scalar, Value};
use rustc_hash::FxHashSet;
use std::fmt::Write;

/// What became of a word.
#[derive(Clone, Debug, Default)]
pub(super) struct Word {
    /// What it is called in the flat net.
    pub(super) name: String,
    /// It needs a LOCAL line.
    local: bool,
    /// The words of the flat net that are 1 while it is, itself included.
    drives: Vec<String>,
    /// The words of the flat net that take its value when it is written.
    pub(super) copies: Vec<String>,
}

impl Flattener<'_> {
    /// Settles all words, those of outer nets first.
    pub(super) fn words(&self) -> Result<Vec<Vec<Word>>, String> {
        let mut words: Vec<Vec<Word>> = Vec::new();
        for scope in 0..self.scopes.len() {
            let own = 0..self.scopes[scope].net.words.len();
            let own = own.map(|i| self.word(scope, WordId(i as u32), &words)).collect::<Result<_, _>>()?;
            words.push(own);
        }
        for scope in 1..self.scopes.len() {
            self.inputs_keep(scope)?;
        }
        Ok(words)
    }

    fn word(&self, scope: usize, id: WordId, words: &[Vec<Word>]) -> Result<Word, String> {
        let own = &self.scopes[scope];
        let word = &own.net.words[id.0 as usize];
        let local = id.0 as usize >= own.net.outputs;
        if own.net.operation.is_some() || own.net.blocked.is_some() {
            return Err(format!("`{}`: expected a net without MODE and BLOCKED, found one of them", self.path(scope)));
        }
        let name = format!("{}{}", self.names.prefixes[scope], word.name);
        if scope == 0 {
            return Ok(Word { drives: vec![name.clone()], name, local, copies: Vec::new() });
        }
        if !own.net.momentary.is_empty() {
            return Err(format!("`{}`: expected no MOMENTARY in a net inside another, found it", self.path(scope)));
        }
        let targets = self.targets(scope, id);
        let read = self.reads(scope).contains(word.name.as_str());
        match &word.drive {
            Drive::Level(_) => {
                let mut drives: Vec<String> =
                    targets.iter().flat_map(|target| words[own.outer][target.0 as usize].drives.clone()).collect();
                let needed = read || drives.is_empty();
                drives.extend(needed.then(|| name.clone()));
                Ok(Word { name, local: needed, drives, copies: Vec::new() })
            }
            Drive::Written => {
                for target in &targets {
                    self.written_once(scope, &word.name, *target)?;
                }
                let copies: Vec<String> = targets
                    .iter()
                    .flat_map(|target| {
                        let outer = &words[own.outer][target.0 as usize];
                        std::iter::once(outer.name.clone()).chain(outer.copies.clone())
                    })
                    .collect();
                match (read, copies.as_slice()) {
                    (false, [first, others @ ..]) => {
                        Ok(Word { name: first.clone(), local: false, drives: Vec::new(), copies: others.to_vec() })
                    }
                    _ => Ok(Word { name, local: true, drives: Vec::new(), copies }),
                }
            }
        }
    }

    /// The words of the net around that a word goes to.
    fn targets(&self, scope: usize, id: WordId) -> Vec<WordId> {
        let own = &self.scopes[scope];
        let outer = &self.scopes[own.outer];
        let Some(index) = outer.parts.iter().position(|part| *part == scope) else {
            return Vec::new();
        };
        let part = &outer.net.parts[index];
        let written = part.writes.iter().filter(|(output, _)| *output == id.0).map(|(_, word)| *word);
        let level = Level::Part(PartId(index as u32), id.0);
        let driven = (0..outer.net.words.len() as u32).map(WordId).filter(|word| {
            match &outer.net.words[word.0 as usize].drive {
                Drive::Level(levels) => levels.contains(&level),
                Drive::Written => false,
            }
        });
        written.chain(driven).collect()
    }

    /// What statements of a scope read, those that connect parts included.
    fn reads(&self, scope: usize) -> FxHashSet<&str> {
        self.scopes[scope].body().iter().flat_map(|statement| self.read_names(statement)).collect()
    }

    /// What a statement reads.
    pub(super) fn read_names(&self, statement: &Statement) -> Vec<&str> {
        let operands = statement.inputs().iter().chain(statement.params());
        let name = |operand: &Operand| match operand {
            Operand::Name(name) => Some(self.symbols.text(name.symbol)),
            Operand::Element(element) => Some(self.symbols.text(element.0.symbol)),
            Operand::Empty | Operand::Member(_) | Operand::Number(_) | Operand::Text(_) => None,
        };
        operands.filter_map(|item| name(&item.value)).collect()
    }

    /// What a net inside writes is seen outside in the next scan: so nobody may look at it before.
    fn written_once(&self, scope: usize, name: &str, target: WordId) -> Result<(), String> {
        let outer = self.scopes[scope].outer;
        let net = self.scopes[outer].net;
        let word = &net.words[target.0 as usize].name;
        let statements = self.scopes[outer].body().iter().filter(|statement| self.writes(statement, word)).count();
        let parts = net.parts.iter().flat_map(|part| &part.writes).filter(|(_, written)| *written == target).count();
        let active = net.actives.iter().any(|active| active.step == target || active.time == Some(target));
        let part = self.path(scope);
        if statements + parts > 1 || active {
            return Err(format!(
                "`{part}`: expected `{word}` to be written by its `{name}` alone, found other statements that write it"
            ));
        }
        if self.reads(outer).contains(word.as_str()) {
            return Err(format!(
                "`{part}`: expected nobody to read `{word}`, found statements that do: what its `{name}` writes is \
                 seen outside in the next scan, and in a flat net at once"
            ));
        }
        let inner = self.scopes[scope].net;
        let own = |id: WordId| inner.words[id.0 as usize].name == name;
        if inner.actives.iter().any(|active| own(active.step) || active.time.is_some_and(own)) {
            return Err(format!("`{part}`: expected `{name}`, which ACTIVE fills, to go to no value outside"));
        }
        Ok(())
    }

    fn writes(&self, statement: &Statement, word: &str) -> bool {
        let is = |output: &Output| matches!(output, Output::Name(name) if self.symbols.text(name.symbol) == word);
        // A statement that connects a part names the part.
        statement.outputs.iter().any(is)
    }

    /// A net inside takes its inputs at the start of a scan: they may not change until its end.
    fn inputs_keep(&self, scope: usize) -> Result<(), String> {
        let (own, outer) = (&self.scopes[scope], &self.scopes[self.scopes[scope].outer]);
        for (port, operand) in own.decl.ports().zip(self.given(scope)) {
            let part = self.path(scope);
            match operand {
                Operand::Name(name) => self.keeps(own.outer, self.symbols.text(name.symbol), (&part, &port.name))?,
                Operand::Member(member) => {
                    let (owner, name) = (self.symbols.text(member.0.symbol), self.symbols.text(member.1.symbol));
                    let inner = outer.part(owner).map(|id| &self.scopes[outer.parts[id.0 as usize]]);
                    let place = inner.and_then(|inner| Some(inner.net.place(inner.find(name)?)));
                    if place.is_none_or(|place| matches!(place.kind, Kind::Generation(_))) {
                        return Err(format!(
                            "`{part}`: expected its input `{}` to follow a value, found `{owner}.{name}`, which a flat \
                             net sees at another time",
                            port.name
                        ));
                    }
                }
                Operand::Empty | Operand::Element(_) | Operand::Number(_) | Operand::Text(_) => {}
            }
            self.same_type(scope, port, operand)?;
        }
        Ok(())
    }

    fn keeps(&self, scope: usize, word: &str, (part, port): (&str, &str)) -> Result<(), String> {
        let net = self.scopes[scope].net;
        let Some(index) = net.words.iter().position(|known| known.name == word) else {
            return Ok(());
        };
        let id = WordId(index as u32);
        let rules = net.gates.iter().flat_map(|gate| &gate.rules).flat_map(|rule| &rule.actions);
        let aborts = net.parts.iter().filter_map(|part| part.abort.as_ref()).flat_map(|abort| &abort.actions);
        let mut late = rules.chain(aborts).map(|id| self.scopes[scope].statement(*id));
        let changes = net.momentary.iter().any(|(_, command)| *command == id)
            || net.parts.iter().any(|part| part.writes.iter().any(|(_, written)| *written == id))
            || net.actives.iter().any(|active| active.step == id || active.time == Some(id))
            || late.any(|statement| self.writes(statement, word));
        match changes {
            true => Err(format!(
                "`{part}`: expected its input `{port}` to keep its value in a scan, found `{word}`, which gates or parts \
                 write: the net inside sees that in the next scan, and a flat net at once"
            )),
            false => Ok(()),
        }
    }

    /// An int and a real are computed with in other ways.
    fn same_type(&self, scope: usize, port: &PortDecl, operand: &Operand) -> Result<(), String> {
        let outer = &self.scopes[self.scopes[scope].outer];
        let Operand::Name(name) = operand else {
            return Ok(());
        };
        let name = self.symbols.text(name.symbol);
        let given = outer.decl.ports().find(|other| other.name == name).map(|other| other.ty.clone());
        let word = || outer.net.words.iter().find(|word| word.name == name).map(|word| scalar(word.scalar));
        let count = || outer.find(name).map(|_| scalar(Scalar::Int));
        let given = given.or_else(word).or_else(count);
        match given.filter(|given| *given != port.ty) {
            Some(_) => Err(format!(
                "`{}`: expected its input `{}` to have the type of `{name}`, found another",
                self.path(scope),
                port.name
            )),
            None => Ok(()),
        }
    }

    /// START, MOMENTARY, LOCAL and CLASS lines.
    pub(super) fn values(&mut self) {
        let mut text = String::new();
        let net = self.scopes[0].net;
        let ports = net.momentary.iter().map(|(_, word)| *word).collect::<Vec<_>>();
        let starts = net.words.iter().enumerate().take(net.outputs);
        let starts = starts.filter(|(i, word)| !is_zero(&word.initial) && !ports.contains(&WordId(*i as u32)));
        let starts: Vec<String> = starts.map(|(_, word)| format!("{} = {}", word.name, shown(&word.initial))).collect();
        if !starts.is_empty() {
            let _ = writeln!(text, "START {}", starts.join(", "));
        }
        for id in ports {
            let _ = writeln!(text, "MOMENTARY {}", net.words[id.0 as usize].name);
        }
        for (scope, words) in self.scopes.iter().zip(&self.words) {
            for (word, known) in scope.net.words.iter().zip(words).filter(|(_, known)| known.local) {
                let ty = if word.scalar == Scalar::Int { "int" } else { "real" };
                let _ = writeln!(text, "LOCAL {ty} {} = {}", known.name, shown(&word.initial));
            }
        }
        let mut declared = FxHashSet::default();
        for (i, scope) in self.scopes.iter().enumerate() {
            for (class, name) in scope.net.classes.iter().zip(&self.names.classes[i]) {
                if declared.insert(name) {
                    let attribute = |attribute: &pcl2_lang::net::Attribute| {
                        let ty = if attribute.scalar == Scalar::Int { "int" } else { "real" };
                        let unit = attribute.unit.as_ref().map(|unit| format!(" \"{unit}\"")).unwrap_or_default();
                        format!("{ty} {} = {}{unit}", attribute.name, shown(&attribute.initial))
                    };
                    let attributes: Vec<String> = class.attributes.iter().map(attribute).collect();
                    let _ = writeln!(text, "CLASS {name} ( {} )", attributes.join(", "));
                }
            }
        }
        self.text.push_str(&text);
    }

    /// The words that a box drives.
    pub(super) fn driven(&self, scope: usize, id: pcl2_lang::net::BoxId) -> Vec<&str> {
        let words = self.scopes[scope].net.words.iter().zip(&self.words[scope]);
        let driven = words.filter(|(word, _)| match &word.drive {
            Drive::Level(levels) => levels.contains(&Level::Box(id)),
            Drive::Written => false,
        });
        let mut names: Vec<&str> = Vec::new();
        for name in driven.flat_map(|(_, known)| &known.drives) {
            if !names.contains(&name.as_str()) {
                names.push(name);
            }
        }
        names
    }
}

fn scalar(scalar: Scalar) -> pcl2_lang::decl::TypeExpr {
    pcl2_lang::decl::TypeExpr::Scalar(scalar)
}

fn is_zero(value: &Value) -> bool {
    matches!(value, Value::Int(0)) || matches!(value, Value::Real(real) if real.wide.to_bits() == 0)
}

/// A number as it is written.
pub(super) fn shown(value: &Value) -> String {
    match value {
        Value::Int(value) => value.to_string(),
        Value::Real(real) => format!("{:?}", real.wide),
        Value::Text(text) => format!("\"{text}\""),
        Value::Ints(_) | Value::Reals(_) => String::new(),
    }
}
