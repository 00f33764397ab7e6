//! The `.net` front end: the lines of a net become a declaration.
//!
//! The passes run in this order; after each one the sentence beside it is true.
//! 1. `outline`: every line stands with the box, part or gate that it belongs to.
//! 2. `names`: every word, class, box and part has its place, and no two have one name.
//! 3. `boxes`: every box knows its tokens and what it does.
//! 4. `parts`: every part is connected.
//! 5. `gates`: every token that a gate takes goes somewhere, and every one that it puts comes from somewhere.
//! 6. `words`: every output is driven or written.
//! 7. `operation`: an operator's modes and commands, and the names of what outputs tell, are known.
//! 8. `operands`: every name that conditions and statements read is one of the net.
//!
//! Types of statements are not looked into here: the body of the declaration is compiled as a composite's is.

mod boxes;
mod gates;
mod names;
mod operands;
mod operation;
mod outline;
mod parts;
mod words;

use pcl2_lang::ast::net::BoxName;
use pcl2_lang::ast::net::NetLine;
use pcl2_lang::ast::{Name, Number, Operand, Output, Statement};
use pcl2_lang::catalogue::Catalogue;
use pcl2_lang::codes::{self, Code};
use pcl2_lang::decl::{BadRule, Decl, Fault};
use pcl2_lang::declare::net::NetFile;
use pcl2_lang::diagnostic::{self, Diagnostic};
use pcl2_lang::net::{BOX_OUTPUT, BoxId, Level, MAX_COUNT, MAX_WRITES, Net, PartId, StatementId, Touched, WordId};
use pcl2_lang::source::{Sources, Span};
use pcl2_lang::suggest;
use pcl2_lang::symbol::{Symbol, Symbols};
use pcl2_lang::types::{Real, Scalar, Value};
use rustc_hash::{FxHashMap, FxHashSet};

/// What can go wrong in a scan of any net, in the order of the player's statuses.
const FAULTS: [(&str, &str); 5] = [
    ("lost", "a token was to be made while another waited for room: it is lost"),
    ("conflict", "two different values were written to an output in one scan: the gate of higher priority wins"),
    ("late", "a process was not complete within its supervision time"),
    ("forced", "an operator forced a gate or a token"),
    ("refused", "a command of an operator was refused: the mode, the tokens or the room did not let it"),
];

/// The nets that a net takes in: the codes of its parts.
pub fn wanted(file: &NetFile) -> Vec<Name> {
    let part = |line: &NetLine| match line {
        NetLine::Part(_, _, call) => Some(call.code),
        _ => None,
    };
    file.lines.iter().filter_map(part).collect()
}

/// Checks a net. Its parts stand in the catalogue. `None`: something is wrong, which was reported.
pub fn compile(
    file: NetFile,
    sources: &Sources,
    symbols: &mut Symbols,
    catalogue: &Catalogue,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Decl> {
    let before = mistakes(diagnostics);
    let NetFile { decl, head, lines, sound, whole } = file;
    let mut builder = Builder::new((decl, sound, whole), sources, symbols, catalogue, diagnostics);
    let mut outline = outline::outline(&mut builder, lines);
    names::collect(&mut builder, &head, &outline);
    boxes::boxes(&mut builder, &mut outline);
    parts::parts(&mut builder, &mut outline);
    gates::gates(&mut builder, &mut outline);
    words::words(&mut builder, &outline);
    operation::operation(&mut builder, &outline);
    operands::operands(&mut builder);
    let whole = builder.finish();
    (sound && mistakes(diagnostics) == before).then_some(whole)
}

fn mistakes(diagnostics: &[Diagnostic]) -> usize {
    diagnostics.iter().filter(|diagnostic| diagnostic.is_error()).count()
}

/// A net in the making.
pub(crate) struct Builder<'a> {
    pub(crate) decl: Decl,
    pub(crate) net: Net,
    /// All lines were understood.
    sound: bool,
    /// All lines that declare names were understood.
    whole: bool,
    /// Mistakes that were told before this net.
    before: usize,
    /// Boxes whose class is not known, which was reported.
    unclassed: FxHashSet<BoxId>,
    sources: &'a Sources,
    symbols: &'a mut Symbols,
    catalogue: &'a Catalogue,
    diagnostics: &'a mut Vec<Diagnostic>,
    statements: Vec<Statement>,
    names: FxHashMap<Symbol, (Thing, Span)>,
    /// By word: statements write it, and where the first of them stands.
    written: Vec<Option<Span>>,
    /// By word: what drives it.
    levels: Vec<Vec<Level>>,
}

/// What a name stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Thing {
    Port,
    Param,
    Word(WordId),
    Box(BoxId),
    /// A module; a macro is a box.
    Part(PartId),
    /// Something with mistakes of its own.
    Spoiled,
}

impl<'a> Builder<'a> {
    fn new(
        (mut decl, sound, whole): (Decl, bool, bool),
        sources: &'a Sources,
        symbols: &'a mut Symbols,
        catalogue: &'a Catalogue,
        diagnostics: &'a mut Vec<Diagnostic>,
    ) -> Builder<'a> {
        decl.bad = Some(BadRule::Logic);
        symbols.intern(BOX_OUTPUT);
        Builder {
            decl,
            net: Net::default(),
            sound,
            whole,
            before: mistakes(diagnostics),
            unclassed: FxHashSet::default(),
            sources,
            symbols,
            catalogue,
            diagnostics,
            statements: Vec::new(),
            names: FxHashMap::default(),
            written: Vec::new(),
            levels: Vec::new(),
        }
    }

    fn finish(self) -> Decl {
        let mut decl = self.decl;
        decl.period = self.net.has_time();
        let fault = |(name, text): &(&str, &str)| Fault { name: (*name).to_owned(), text: (*text).to_owned() };
        decl.faults = FAULTS.iter().map(fault).collect();
        decl.body = Some(self.statements);
        decl.net = Some(Box::new(self.net));
        decl
    }

    pub(crate) fn complain(&mut self, code: Code, span: Span, message: impl Into<String>, help: &str) {
        self.diagnostics.push(Diagnostic::new(code, span, message).help(help));
    }

    /// As [`Builder::complain`], of what no line declares: one that was not understood may do so.
    pub(crate) fn miss(&mut self, code: Code, span: Span, message: impl Into<String>, help: &str) {
        if self.whole {
            self.complain(code, span, message, help);
        }
    }

    /// A number that does not fit. One too large to be read is 0, which was reported.
    pub(crate) fn out_of_range(&mut self, number: u32, span: Span, message: impl Into<String>, help: &str) {
        let written = self.written_text(span);
        if number != 0 || written.chars().all(|digit| digit == '0') {
            self.complain(codes::OUT_OF_RANGE, span, message, help);
        }
    }

    fn text(&self, name: Name) -> String {
        self.symbols.text(name.symbol).to_owned()
    }

    fn written_text(&self, span: Span) -> &'a str {
        self.sources.text(span)
    }

    /// Adds a statement to the body.
    fn statement(&mut self, mut statement: Statement) -> StatementId {
        let id = StatementId(self.statements.len() as u32);
        if self.statements.len() == MAX_COUNT {
            let message = format!("expected at most {MAX_COUNT} statements in a net, found more");
            self.complain(codes::TOO_LARGE, statement.span, message, "divide the net");
        }
        self.name_elements(&mut statement);
        let touched = self.touched(&statement);
        if touched.writes.len() + touched.counts.len() > MAX_WRITES {
            let message = format!("expected at most {MAX_WRITES} outputs of a statement, found more");
            self.complain(codes::TOO_LARGE, statement.span, message, "divide the statement");
        }
        self.net.touched.push(touched);
        statement.number = Some((id.0, statement.span));
        if statement.outputs.is_empty() {
            statement.outputs = Box::new([Output::Discard(statement.span)]);
        }
        self.statements.push(statement);
        id
    }

    /// `n[3]` is a word where one has that name, else the element of a vector or a box.
    fn name_elements(&mut self, statement: &mut Statement) {
        for item in statement.inputs_mut() {
            let Operand::Element(element) = &item.value else {
                continue;
            };
            let (name, [(index, _)]) = (element.0, element.1.as_slice()) else {
                continue;
            };
            let symbol = self.symbols.intern(&format!("{}[{index}]", self.text(name)));
            if let Some((Thing::Word(_) | Thing::Spoiled, _)) = self.names.get(&symbol) {
                item.value = Operand::Name(Name { symbol, span: item.span });
            }
        }
    }

    /// Adds a statement that writes words or attributes.
    fn action(&mut self, statement: Statement) -> StatementId {
        for output in &statement.outputs {
            let Output::Name(name) = *output else {
                continue;
            };
            match self.names.get(&name.symbol).map(|(thing, _)| *thing) {
                Some(Thing::Word(word)) => {
                    self.written[word.0 as usize].get_or_insert(name.span);
                }
                Some(Thing::Spoiled) => {}
                Some(Thing::Port | Thing::Param | Thing::Box(_) | Thing::Part(_)) => {
                    let message = format!("expected an output or a local, found `{}`", self.text(name));
                    self.complain(codes::NET_NAME, name.span, message, "inputs, parameters and boxes are not written");
                }
                None => self.unknown(name, "an output or a local"),
            }
        }
        self.no_net(&statement);
        self.statement(statement)
    }

    /// A net goes on from scan to scan: a statement, which is run now and then, cannot call one.
    fn no_net(&mut self, statement: &Statement) {
        if self.holds_net(statement.code) {
            let code = self.text(statement.code);
            let message = format!("expected a function code without a net, found `{code}`");
            let help = "a net inside stands in a line of its own: MACRO or MODULE";
            self.complain(codes::NET_LINE, statement.code.span, message, help);
        }
    }

    /// Whether a code is a net, or a composite with one inside. Each code is looked at once.
    fn holds_net(&self, code: Name) -> bool {
        let mut codes = vec![code.symbol];
        let mut next = 0;
        while let Some(code) = codes.get(next).copied() {
            next += 1;
            let Some(decl) = self.catalogue.find(self.symbols.text(code)) else {
                continue;
            };
            if decl.net.is_some() {
                return true;
            }
            for statement in decl.body.iter().flatten() {
                if !codes.contains(&statement.code.symbol) {
                    codes.push(statement.code.symbol);
                }
            }
        }
        false
    }

    /// What a statement touches. One that reads what it writes counts on, and is in no conflict.
    fn touched(&self, statement: &Statement) -> Touched {
        let mut touched = Touched::default();
        let reads: Vec<Symbol> = statement.inputs().iter().filter_map(|item| named(&item.value)).collect();
        let place = |owner: &Name| match self.names.get(&owner.symbol) {
            Some((Thing::Box(place), _)) => Some(*place),
            _ => None,
        };
        let read = statement.inputs().iter().filter_map(|item| match &item.value {
            Operand::Member(member) => place(&member.0),
            Operand::Name(_) | Operand::Empty | Operand::Element(_) | Operand::Number(_) | Operand::Text(_) => None,
        });
        let mut looks: Vec<BoxId> = read.collect();
        for output in &statement.outputs {
            match output {
                Output::Member(owner, _) => looks.extend(place(owner)),
                Output::Name(name) => {
                    let Some((Thing::Word(word), _)) = self.names.get(&name.symbol) else {
                        continue;
                    };
                    let list = if reads.contains(&name.symbol) { &mut touched.counts } else { &mut touched.writes };
                    list.extend(Some(*word).filter(|word| (word.0 as usize) < self.net.outputs));
                }
                Output::Discard(_) => {}
            }
        }
        looks.sort_unstable();
        looks.dedup();
        touched.looks = looks;
        touched
    }

    fn unknown(&mut self, name: Name, expected: &str) {
        let text = self.text(name);
        let message = format!("expected {expected}, found `{text}`");
        // Of more mistakes nobody is shown.
        let few = self.diagnostics.len() < diagnostic::MAX_ERRORS;
        let help = few.then(|| suggest::help(&text, self.known().into_iter())).flatten();
        let help = help.unwrap_or_else(|| format!("nothing in the net is called `{text}`"));
        self.miss(codes::NET_NAME, name.span, message, &help);
        self.names.insert(name.symbol, (Thing::Spoiled, name.span));
    }

    /// The names of the net, in order.
    fn known(&self) -> Vec<&str> {
        let sound = self.names.iter().filter(|(_, (thing, _))| *thing != Thing::Spoiled);
        let mut known: Vec<&str> = sound.map(|(symbol, _)| self.symbols.text(*symbol)).collect();
        known.sort_unstable();
        known
    }

    /// The box of the net itself that a name stands for.
    fn own_box(&mut self, name: BoxName) -> Option<BoxId> {
        if name.part.is_some() {
            let message = format!("expected a box of this net, found `{}`", self.written_text(name.span()));
            self.complain(
                codes::NET_NAME,
                name.span(),
                message,
                "boxes of a part are read only: READ, INHIBIT or a condition",
            );
            return None;
        }
        match self.names.get(&name.name.symbol).map(|(thing, _)| *thing) {
            Some(Thing::Box(id)) => Some(id),
            Some(Thing::Spoiled) => None,
            Some(Thing::Port | Thing::Param | Thing::Word(_) | Thing::Part(_)) => {
                let message = format!("expected a box, found `{}`", self.text(name.name));
                self.complain(codes::NET_NAME, name.name.span, message, "tokens move between boxes only");
                None
            }
            None => {
                self.unknown(name.name, "a box");
                None
            }
        }
    }

    /// A first value in the number type of its place.
    fn constant(&mut self, number: Number, span: Span, scalar: Scalar) -> Option<Value> {
        match (number, scalar) {
            (Number::Int(value), Scalar::Int) => Some(Value::Int(value)),
            (Number::Int(value), Scalar::Real) => Some(Value::Real(Real::from_int(value))),
            (Number::Real(value), Scalar::Real) => Some(Value::Real(value)),
            (Number::Real(_), Scalar::Int) => {
                let message = format!("expected an int, found the real `{}`", self.written_text(span));
                self.complain(codes::VALUE_KIND, span, message, "write it without a dot, or declare a real");
                None
            }
        }
    }
}

/// The variable that stands in a place.
fn named(operand: &Operand) -> Option<Symbol> {
    match operand {
        Operand::Name(name) => Some(name.symbol),
        Operand::Empty | Operand::Element(_) | Operand::Member(_) | Operand::Number(_) | Operand::Text(_) => None,
    }
}

/// What a scalar is before anybody writes it.
fn zero(scalar: Scalar) -> Value {
    match scalar {
        Scalar::Int => Value::Int(0),
        Scalar::Real => Value::Real(Real::ZERO),
    }
}
