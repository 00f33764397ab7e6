//! Pass 5: gates in the order in which a scan tries them, with every token's way.

use super::boxes::tokens;
use super::outline::{GateLines, Outline, RuleLines};
use super::{Builder, Thing};
use pcl2_lang::ast::net::{ArcTerm, BoxName, GateClause, Route};
use pcl2_lang::ast::{Operand, Output, Statement};
use pcl2_lang::codes;
use pcl2_lang::diagnostic::{self, Diagnostic};
use pcl2_lang::net::{Arc, BoxId, Gate, GateId, Kind, MAX_COUNT, Move, PartId, Permit, Rule, Tested, WordId};
use pcl2_lang::source::Span;
use pcl2_lang::suggest;
use pcl2_lang::symbol::Symbol;
use rustc_hash::FxHashMap;

/// Reads the gates.
pub(super) fn gates(builder: &mut Builder<'_>, outline: &mut Outline) {
    let mut seen: FxHashMap<Symbol, Span> = FxHashMap::default();
    let mut gates: Vec<Gate> = Vec::new();
    for lines in std::mem::take(&mut outline.gates) {
        let name = lines.line.name.name;
        if let Some(first) = seen.insert(name.symbol, name.span) {
            let message = format!("expected a gate of its own name, found `{}` a second time", builder.text(name));
            let report = Diagnostic::new(codes::NET_NAME_TAKEN, name.span, message);
            builder.diagnostics.push(report.label(first, "the first").help("take another name"));
        }
        gates.extend(Reader { builder: &mut *builder }.gate(lines));
        if gates.len() > MAX_COUNT {
            let message = format!("expected at most {MAX_COUNT} gates in a net, found more");
            builder.complain(codes::TOO_LARGE, name.span, message, "divide the net");
            return;
        }
    }
    let mut order: Vec<usize> = (0..gates.len()).collect();
    order.sort_by_key(|i| -i64::from(gates[*i].priority));
    let mut numbered = vec![GateId(0); gates.len()];
    for (place, i) in order.into_iter().enumerate() {
        numbered[i] = GateId(place as u32);
    }
    gates.sort_by_key(|gate| -i64::from(gate.priority));
    (builder.net.gates, builder.net.numbered) = (gates, numbered);
}

/// The commands that a condition reads.
pub(super) fn commands(builder: &Builder<'_>, condition: &Statement) -> Vec<WordId> {
    let mut commands = Vec::new();
    for item in condition.inputs() {
        let Operand::Name(name) = &item.value else {
            continue;
        };
        if let Some((Thing::Word(word), _)) = builder.names.get(&name.symbol).copied() {
            let command = builder.net.momentary.iter().any(|(_, command)| *command == word);
            if command && !commands.contains(&word) {
                commands.push(word);
            }
        }
    }
    commands
}

struct Reader<'b, 'a> {
    builder: &'b mut Builder<'a>,
}

impl Reader<'_, '_> {
    fn gate(&mut self, lines: GateLines) -> Option<Gate> {
        let GateLines { line, broken, rules } = lines;
        let told = super::mistakes(self.builder.diagnostics);
        let (before, after) = (self.arcs(&line.before), self.arcs(&line.after));
        let name = self.builder.text(line.name.name);
        let mut gate = Gate {
            name,
            before: before.unwrap_or_default(),
            after: after.unwrap_or_default(),
            reads: Vec::new(),
            inhibits: Vec::new(),
            priority: 0,
            permits: Vec::new(),
            rules: Vec::new(),
            span: line.span,
        };
        let mut clauses = Vec::new();
        for clause in line.clauses {
            self.clause(&mut gate, clause, &mut clauses);
        }
        if gate.before.len() != line.before.len() || gate.after.len() != line.after.len() {
            return None;
        }
        self.weights(&gate, &line.before, true);
        self.weights(&gate, &line.after, false);
        let rules = if rules.is_empty() {
            vec![RuleLines { condition: None, routes: Vec::new(), actions: Vec::new(), span: line.span }]
        } else {
            rules
        };
        for rule in rules {
            let rule = self.rule(&gate, rule, (&line.after, broken));
            gate.rules.push(rule);
        }
        if super::mistakes(self.builder.diagnostics) == told && !broken {
            self.unfilled(&gate);
        }
        Some(gate)
    }

    /// A box after the gate that no THEN fills would never get a token.
    fn unfilled(&mut self, gate: &Gate) {
        for (i, arc) in gate.after.iter().enumerate() {
            let filled = |rule: &Rule| rule.moves.iter().any(|way| way.to.contains(&(i as u32)));
            if !gate.rules.iter().any(filled) {
                let name = self.builder.net.place(arc.place).name.clone();
                let message = format!("expected a THEN with a token for `{name}`, found none");
                let help = format!("let a token go there, or make one: `THEN NEW -> {name}`");
                self.builder.complain(codes::ROUTE, gate.span, message, &help);
            }
        }
    }

    fn clause(&mut self, gate: &mut Gate, clause: GateClause, seen: &mut Vec<&'static str>) {
        let (word, span) = match &clause {
            GateClause::Read(arcs) => ("READ", arcs.first().map(|arc| arc.place.span())),
            GateClause::Inhibit(arcs) => ("INHIBIT", arcs.first().map(|arc| arc.place.span())),
            GateClause::Priority(_, span) => ("PRIORITY", Some(*span)),
            GateClause::Permit(terms) => ("PERMIT", terms.first().map(|term| term.span)),
            GateClause::If(condition) => ("IF", Some(condition.span)),
        };
        if seen.contains(&word) {
            let message = format!("expected {word} once, found it again");
            let help = if word == "PRIORITY" || word == "IF" { "delete one of them" } else { "put all into one list" };
            self.builder.complain(codes::NET_LINE, span.unwrap_or(gate.span), message, help);
        }
        seen.push(word);
        match clause {
            GateClause::Read(arcs) => {
                gate.reads = self.tested(&arcs);
                self.readable(&arcs);
            }
            GateClause::Inhibit(arcs) => gate.inhibits = self.tested(&arcs),
            GateClause::Priority(priority, _) => gate.priority = priority,
            GateClause::Permit(terms) => {
                for term in terms {
                    let text = self.builder.written_text(term.span).to_owned();
                    let condition = self.builder.statement(term);
                    gate.permits.push(Permit { text, condition });
                }
            }
            GateClause::If(_) => {}
        }
    }

    fn arcs(&mut self, terms: &[ArcTerm]) -> Option<Vec<Arc>> {
        let mut arcs: Vec<Arc> = Vec::new();
        for term in terms {
            let place = self.builder.own_box(term.place)?;
            if arcs.iter().any(|arc| arc.place == place) {
                let message =
                    format!("expected each box once, found `{}` again", self.builder.written_text(term.place.span()));
                self.builder.complain(codes::NET_LINE, term.place.span(), message, "write a weight: `2*box`");
            }
            arcs.push(Arc { place, weight: self.weight(term) });
        }
        Some(arcs)
    }

    fn weight(&mut self, term: &ArcTerm) -> u32 {
        match term.weight {
            Some((0, span)) => {
                let message = "expected a weight from 1, found 0";
                self.builder.out_of_range(0, span, message, "leave the box out, or write INHIBIT");
                1
            }
            Some((weight, _)) => weight,
            None => 1,
        }
    }

    /// Boxes that are looked at, of the net itself or of a part.
    fn tested(&mut self, terms: &[ArcTerm]) -> Vec<Tested> {
        let mut tested = Vec::new();
        for term in terms {
            let weight = self.weight(term);
            match term.place.part {
                None => {
                    tested.extend(self.builder.own_box(term.place).map(|place| Tested { part: None, place, weight }))
                }
                Some(_) => tested.extend(self.inner(term.place).map(|(part, place)| Tested {
                    part: Some(part),
                    place,
                    weight,
                })),
            }
        }
        tested
    }

    /// A box of the net itself that must hold more tokens than it can would never let the gate fire.
    fn readable(&mut self, terms: &[ArcTerm]) {
        for term in terms.iter().filter(|term| term.place.part.is_none()) {
            let Some((Thing::Box(id), _)) = self.builder.names.get(&term.place.name.symbol).copied() else {
                continue;
            };
            let weight = term.weight.map_or(1, |(weight, _)| weight);
            let place = self.builder.net.place(id);
            if let Some(most) = place.capacity.filter(|most| weight > *most) {
                let message = format!("expected at most {} in `{}`, found {weight}", tokens(most), place.name);
                let span = term.weight.map_or(term.place.span(), |(_, span)| span);
                self.builder.complain(codes::CAPACITY, span, message, "the gate could never fire");
            }
        }
    }

    /// A box of a part.
    fn inner(&mut self, name: BoxName) -> Option<(PartId, BoxId)> {
        let part = name.part?;
        let id = match self.builder.names.get(&part.symbol).map(|(thing, _)| *thing) {
            Some(Thing::Part(id)) => id,
            Some(Thing::Box(place)) => match self.builder.net.place(place).kind {
                Kind::Macro(id) => id,
                _ => {
                    let message = format!("expected a macro or a module, found the box `{}`", self.builder.text(part));
                    self.builder.complain(codes::NET_NAME, part.span, message, "only parts have boxes of their own");
                    return None;
                }
            },
            Some(Thing::Spoiled) => return None,
            Some(Thing::Port | Thing::Param | Thing::Word(_)) | None => {
                self.builder.unknown(part, "a macro or a module");
                return None;
            }
        };
        let statement = self.builder.net.parts.get(id.0 as usize)?.statement;
        let code = self.builder.statements[statement.0 as usize].code;
        let code = self.builder.text(code);
        let inner = self.builder.catalogue.find(&code).and_then(|decl| decl.net.as_deref())?;
        let text = self.builder.text(name.name);
        let found = inner.boxes.iter().position(|place| place.name == text);
        if found.is_none() {
            let known: Vec<&str> = inner.boxes.iter().map(|place| place.name.as_str()).collect();
            let help = suggest::help(&text, known.iter().copied())
                .unwrap_or_else(|| format!("its boxes are {}", known.join(", ")));
            let message = format!("expected a box of `{code}`, found `{text}`");
            self.builder.complain(codes::NET_NAME, name.name.span, message, &help);
        }
        found.map(|place| (id, BoxId(place as u32)))
    }

    fn weights(&mut self, gate: &Gate, terms: &[ArcTerm], takes: bool) {
        let arcs = if takes { &gate.before } else { &gate.after };
        for (arc, term) in arcs.iter().zip(terms) {
            let place = self.builder.net.place(arc.place);
            let most = match (place.capacity, &place.kind) {
                (_, Kind::Count) if takes => Some(1),
                (capacity, _) => capacity,
            };
            if let Some(most) = most.filter(|most| arc.weight > *most) {
                let message =
                    format!("expected at most {} from or to `{}`, found {}", tokens(most), place.name, arc.weight);
                let span = term.weight.map_or(term.place.span(), |(_, span)| span);
                self.builder.complain(codes::CAPACITY, span, message, "the gate could never fire");
            }
            let place = self.builder.net.place(arc.place);
            if arc.weight > 1 && place.class.is_some() {
                let message =
                    format!("expected one token of a class through an arc, found {} of `{}`", arc.weight, place.name);
                self.builder.complain(
                    codes::TOKEN_CLASS,
                    term.place.span(),
                    message,
                    "tokens with attributes move one by one",
                );
            }
        }
    }

    fn rule(&mut self, gate: &Gate, lines: RuleLines, (after, broken): (&[ArcTerm], bool)) -> Rule {
        let RuleLines { condition, routes, actions, span } = lines;
        let (looks, clears) =
            condition.as_ref().map_or((Vec::new(), Vec::new()), |condition| self.reads(gate, condition));
        let moves =
            if routes.is_empty() { self.plain_moves(gate, after) } else { self.moves(gate, &routes, (span, broken)) };
        actions.iter().for_each(|statement| self.not_there_yet(gate, &moves, statement));
        let condition = condition.map(|condition| self.builder.statement(condition));
        let actions = actions.into_iter().map(|statement| self.builder.action(statement)).collect();
        Rule { condition, looks, clears, moves, actions, span }
    }

    /// A box that takes one token is empty when a gate puts its token there: what a statement of the gate writes to it is
    /// lost.
    fn not_there_yet(&mut self, gate: &Gate, moves: &[Move], statement: &Statement) {
        for output in &statement.outputs {
            let Output::Member(owner, member) = output else {
                continue;
            };
            let Some((Thing::Box(id), _)) = self.builder.names.get(&owner.symbol).copied() else {
                continue;
            };
            let at_hand = gate.before.iter().any(|arc| arc.place == id);
            let index = gate.after.iter().position(|arc| arc.place == id && !at_hand).map(|index| index as u32);
            let from = index.and_then(|index| moves.iter().find(|way| way.to.contains(&index))?.from);
            let place = self.builder.net.place(id);
            if let Some(from) = from.filter(|_| place.capacity == Some(1)) {
                let source = &self.builder.net.place(gate.before[from as usize].place).name;
                let message =
                    format!("expected a box that has a token, found `{}`, which gets it by this gate", place.name);
                let help = format!("the token is still that of `{source}`: `{source}.{}`", self.builder.text(*member));
                let warning = Diagnostic::new(codes::LOST_WRITE, owner.span, message).help(help);
                diagnostic::warn(self.builder.diagnostics, warning);
            }
        }
    }

    /// The boxes whose tokens a condition looks at, and the commands that it reads.
    fn reads(&mut self, gate: &Gate, condition: &Statement) -> (Vec<BoxId>, Vec<WordId>) {
        let mut looks = Vec::new();
        for item in condition.inputs() {
            let Operand::Member(member) = &item.value else {
                continue;
            };
            let Some((Thing::Box(place), _)) = self.builder.names.get(&member.0.symbol).copied() else {
                continue;
            };
            let before = gate.before.iter().any(|arc| arc.place == place);
            let read = gate.reads.iter().any(|tested| tested.part.is_none() && tested.place == place);
            // The cause of a process box is its own, whatever becomes of the token.
            let carries = self.builder.net.place(place).class.is_some();
            if (before || read) && carries && !looks.contains(&place) {
                looks.push(place);
            }
        }
        (looks, commands(self.builder, condition))
    }

    /// Without THEN: one before and one after, and the token moves; else each box after the gate gets the token of the
    /// first box before it.
    fn plain_moves(&mut self, gate: &Gate, after: &[ArcTerm]) -> Vec<Move> {
        let mut moves: Vec<Move> =
            (0..gate.before.len() as u32).map(|from| Move { from: Some(from), to: Vec::new() }).collect();
        let first = gate.before.first().map(|arc| self.builder.net.place(arc.place).class);
        for (i, (arc, term)) in gate.after.iter().zip(after).enumerate() {
            let place = self.builder.net.place(arc.place);
            match (place.class, first) {
                _ if self.is_vague(arc) || gate.before.first().is_some_and(|arc| self.is_vague(arc)) => {
                    moves.push(Move { from: None, to: vec![i as u32] });
                }
                (None, Some(_)) if first == Some(None) => moves[0].to.push(i as u32),
                (None, _) => moves.push(Move { from: None, to: vec![i as u32] }),
                (Some(class), Some(Some(own))) if class == own => moves[0].to.push(i as u32),
                (Some(class), _) => {
                    let classes = &self.builder.net.classes;
                    let class = &classes[class.0 as usize].name;
                    let found = match first {
                        Some(Some(other)) => format!("one of `{}`", classes[other.0 as usize].name),
                        Some(None) => "a plain one".to_owned(),
                        None => "none".to_owned(),
                    };
                    let message = format!(
                        "expected a token of the class `{class}` for `{}`, found {found} before the gate",
                        place.name
                    );
                    let help = self.route_help(gate, arc.place);
                    self.builder.complain(codes::TOKEN_CLASS, term.place.span(), message, &help);
                }
            }
        }
        moves
    }

    /// Whether the class of a box was a mistake.
    fn is_vague(&self, arc: &Arc) -> bool {
        self.builder.unclassed.contains(&arc.place)
    }

    /// The THEN lines that give a box a token of its class.
    fn route_help(&self, gate: &Gate, to: BoxId) -> String {
        let net = &self.builder.net;
        let (class, name) = (net.place(to).class, &net.place(to).name);
        let before = || gate.before.iter().map(|arc| net.place(arc.place));
        if let Some(from) = before().find(|place| place.class == class) {
            let others = before().filter(|place| place.name != from.name);
            let vanish: String = others.map(|place| format!(", `THEN {} -> nothing`", place.name)).collect();
            return format!("say with THEN which token goes where: `THEN {} -> {name}`{vanish}", from.name);
        }
        let vanish = before().map(|place| format!("`THEN {} -> nothing`, ", place.name)).collect::<String>();
        format!("make a new one: {vanish}`THEN NEW -> {name}`")
    }

    fn moves(&mut self, gate: &Gate, routes: &[Route], (span, broken): (Span, bool)) -> Vec<Move> {
        let mut moves = Vec::new();
        let mut filled = vec![false; gate.after.len()];
        let mut used = vec![false; gate.before.len()];
        for route in routes {
            let from = match route.from {
                Some(name) => match self.place_of(name, &gate.before, "before") {
                    Some(index) => Some(index),
                    None => continue,
                },
                None => None,
            };
            if let Some(from) = from {
                if std::mem::replace(&mut used[from as usize], true) {
                    self.builder.complain(
                        codes::ROUTE,
                        route.span,
                        "expected each box before the gate in one THEN, found it again",
                        "name all its destinations in one THEN",
                    );
                }
            }
            let mut to = Vec::new();
            for name in &route.to {
                let Some(index) = self.place_of(*name, &gate.after, "after") else {
                    continue;
                };
                if std::mem::replace(&mut filled[index as usize], true) {
                    self.builder.complain(
                        codes::ROUTE,
                        name.span(),
                        "expected one source for each box after the gate, found a second",
                        "a box gets one token",
                    );
                }
                self.classes(gate, from, index, name.span());
                to.push(index);
            }
            moves.push(Move { from, to });
        }
        if !broken {
            self.missing(gate, &used, span);
        }
        moves
    }

    fn classes(&mut self, gate: &Gate, from: Option<u32>, to: u32, span: Span) {
        let class = |builder: &Builder<'_>, arc: &Arc| builder.net.place(arc.place).class;
        let target = class(self.builder, &gate.after[to as usize]);
        let source = match from {
            Some(from) => class(self.builder, &gate.before[from as usize]),
            None => target,
        };
        let vague = |arc: &Arc| self.is_vague(arc);
        let unknown = vague(&gate.after[to as usize]) || from.is_some_and(|from| vague(&gate.before[from as usize]));
        if source != target && !unknown {
            self.builder.complain(
                codes::TOKEN_CLASS,
                span,
                "expected a box of the token's class, found one of another",
                "let the token go to `nothing` and make one by `THEN NEW ->`",
            );
        }
    }

    fn missing(&mut self, gate: &Gate, used: &[bool], span: Span) {
        for (arc, used) in gate.before.iter().zip(used) {
            if !used {
                let name = self.builder.net.place(arc.place).name.clone();
                let message = format!("expected a THEN for each box before the gate, found none for `{name}`");
                self.builder.complain(
                    codes::ROUTE,
                    span,
                    message,
                    &format!("say where its token goes: `THEN {name} -> nothing`"),
                );
            }
        }
    }

    fn place_of(&mut self, name: BoxName, arcs: &[Arc], side: &str) -> Option<u32> {
        let place = self.builder.own_box(name)?;
        let index = arcs.iter().position(|arc| arc.place == place);
        if index.is_none() {
            let message = format!("expected a box {side} the gate, found `{}`", self.builder.written_text(name.span()));
            self.builder.complain(codes::ROUTE, name.span(), message, "THEN speaks of the boxes in the GATE line");
        }
        index.map(|index| index as u32)
    }
}
