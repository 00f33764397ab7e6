//! Pass 1: each line stands with the box, part or gate that it belongs to.

use super::Builder;
use pcl2_lang::ast::net::{
    ActiveLine, BoxClause, BoxLine, BoxName, GateClause, GateLine, Halt, NetLine, Preset, Route, Typed,
};
use pcl2_lang::ast::{Name, Statement};
use pcl2_lang::codes;
use pcl2_lang::source::Span;

/// The lines of a net, sorted by what they are.
#[derive(Default)]
pub(super) struct Outline {
    pub(super) starts: Vec<Preset>,
    pub(super) stops: Vec<Halt>,
    pub(super) momentary: Vec<Name>,
    pub(super) modes: Vec<Vec<Name>>,
    pub(super) locals: Vec<Typed>,
    pub(super) classes: Vec<(Name, Vec<Typed>)>,
    pub(super) boxes: Vec<BoxLines>,
    pub(super) parts: Vec<PartLines>,
    pub(super) gates: Vec<GateLines>,
    pub(super) actives: Vec<ActiveLine>,
    pub(super) blocked: Vec<Name>,
    /// Boxes and parts in order of declaration.
    pub(super) order: Vec<Placed>,
}

/// An index into [`Outline::boxes`] or [`Outline::parts`].
#[derive(Clone, Copy)]
pub(super) enum Placed {
    Box(usize),
    Part(usize),
}

/// A box with its statements.
pub(super) struct BoxLines {
    pub(super) line: BoxLine,
    /// A line below it was not understood.
    pub(super) broken: bool,
    pub(super) enter: Vec<Statement>,
    pub(super) after: Vec<Statement>,
}

/// A part with what empties it.
pub(super) struct PartLines {
    pub(super) is_macro: bool,
    pub(super) name: BoxName,
    pub(super) call: Statement,
    pub(super) abort: Option<AbortLines>,
}

/// What empties a macro.
pub(super) struct AbortLines {
    pub(super) condition: Statement,
    pub(super) to: BoxName,
    pub(super) actions: Vec<Statement>,
}

/// A gate with its rules.
pub(super) struct GateLines {
    pub(super) line: GateLine,
    /// A line below it was not understood.
    pub(super) broken: bool,
    pub(super) rules: Vec<RuleLines>,
}

/// An IF part with its THEN parts.
pub(super) struct RuleLines {
    pub(super) condition: Option<Statement>,
    pub(super) routes: Vec<Route>,
    pub(super) actions: Vec<Statement>,
    pub(super) span: Span,
}

/// What a DO line belongs to.
#[derive(Clone, Copy)]
enum Current {
    None,
    /// A line that was not understood: nothing is known of those below it.
    Broken,
    Box,
    Abort,
    Part,
    Gate,
}

/// Sorts the lines.
pub(super) fn outline(builder: &mut Builder<'_>, lines: Vec<NetLine>) -> Outline {
    let mut outline = Outline::default();
    let mut current = Current::None;
    for line in lines {
        current = outline.take(builder, line, current);
    }
    outline
}

impl Outline {
    fn take(&mut self, builder: &mut Builder<'_>, line: NetLine, current: Current) -> Current {
        match line {
            NetLine::Start(presets) => self.starts.extend(presets),
            NetLine::Stop(halts) => self.stops.extend(halts),
            NetLine::Momentary(names) => self.momentary.extend(names),
            NetLine::Mode(names) => self.modes.push(names),
            NetLine::Local(locals) => self.locals.extend(locals),
            NetLine::Class(name, attributes) => self.classes.push((name, attributes)),
            NetLine::Active(active) => self.actives.push(active),
            NetLine::Blocked(name) => self.blocked.push(name),
            NetLine::For(..) | NetLine::Next(_) | NetLine::End(_) => {}
            NetLine::Broken(_) => return self.broken(current),
            NetLine::Box(line) => return self.place(*line),
            NetLine::Part(is_macro, name, call) => {
                self.order.push(Placed::Part(self.parts.len()));
                self.parts.push(PartLines { is_macro, name, call: *call, abort: None });
                return Current::Part;
            }
            NetLine::Gate(line) => return self.gate(*line),
            NetLine::Abort(..) if matches!(current, Current::Broken) => return current,
            NetLine::Abort(condition, to) => return self.abort(builder, *condition, to, current),
            NetLine::If(_) | NetLine::Else(_) | NetLine::Then(_) | NetLine::Do(_) | NetLine::After(_) => {
                self.below(builder, line, current);
                return current;
            }
        }
        Current::None
    }

    /// What the line says of the box or gate above is not known, nor what the lines below it belong to.
    fn broken(&mut self, current: Current) -> Current {
        match current {
            Current::Box => self.boxes.last_mut().into_iter().for_each(|lines| lines.broken = true),
            Current::Gate => self.gates.last_mut().into_iter().for_each(|lines| lines.broken = true),
            Current::None | Current::Broken | Current::Abort | Current::Part => {}
        }
        Current::Broken
    }

    /// A line that belongs to the one above it.
    fn below(&mut self, builder: &mut Builder<'_>, line: NetLine, current: Current) {
        if matches!(current, Current::Broken) {
            return;
        }
        match line {
            NetLine::If(condition) => self.rule(builder, Some(*condition), current),
            NetLine::Else(span) => self.other(builder, span, current),
            NetLine::Then(route) => self.route(builder, route, current),
            NetLine::Do(statement) => self.action(builder, *statement, current),
            NetLine::After(statement) => self.after(builder, *statement, current),
            _ => {}
        }
    }

    fn place(&mut self, mut line: BoxLine) -> Current {
        let mut enter = Vec::new();
        line.clauses.retain_mut(|clause| {
            let BoxClause::Do(statement) = clause else {
                return true;
            };
            enter.push((**statement).clone());
            false
        });
        self.order.push(Placed::Box(self.boxes.len()));
        self.boxes.push(BoxLines { line, broken: false, enter, after: Vec::new() });
        Current::Box
    }

    fn gate(&mut self, mut line: GateLine) -> Current {
        let mut rules = Vec::new();
        line.clauses.retain_mut(|clause| match clause {
            GateClause::If(condition) => {
                let span = condition.span;
                let (routes, actions) = (Vec::new(), Vec::new());
                rules.push(RuleLines { condition: Some((**condition).clone()), routes, actions, span });
                false
            }
            GateClause::Read(_) | GateClause::Inhibit(_) | GateClause::Priority(..) | GateClause::Permit(_) => true,
        });
        self.gates.push(GateLines { line, broken: false, rules });
        Current::Gate
    }

    fn abort(&mut self, builder: &mut Builder<'_>, condition: Statement, to: BoxName, current: Current) -> Current {
        let span = condition.span;
        match (current, self.parts.last_mut()) {
            (Current::Part, Some(part)) if part.is_macro => {
                part.abort = Some(AbortLines { condition, to, actions: Vec::new() });
                Current::Abort
            }
            _ => {
                builder.complain(
                    codes::NET_LINE,
                    span,
                    "expected ABORT below the MACRO that it empties, found it elsewhere",
                    "put it on the line behind the macro, once",
                );
                Current::None
            }
        }
    }

    fn rule(&mut self, builder: &mut Builder<'_>, condition: Option<Statement>, current: Current) {
        let span = condition.as_ref().map(|condition| condition.span);
        match (current, self.gates.last_mut()) {
            (Current::Gate, Some(gate)) => {
                let span = span.unwrap_or(gate.line.span);
                gate.rules.push(RuleLines { condition, routes: Vec::new(), actions: Vec::new(), span });
            }
            _ => self.lost(builder, span, "IF below a gate"),
        }
    }

    fn other(&mut self, builder: &mut Builder<'_>, span: Span, current: Current) {
        match (current, self.gates.last_mut()) {
            (Current::Gate, Some(gate)) if gate.rules.iter().any(|rule| rule.condition.is_some()) => {
                gate.rules.push(RuleLines { condition: None, routes: Vec::new(), actions: Vec::new(), span });
            }
            _ => self.lost(builder, Some(span), "ELSE below an IF"),
        }
    }

    fn route(&mut self, builder: &mut Builder<'_>, route: Route, current: Current) {
        match (current, self.gates.last_mut()) {
            (Current::Gate, Some(gate)) => gate.last_rule().routes.push(route),
            _ => self.lost(builder, Some(route.span), "THEN below a gate"),
        }
    }

    fn action(&mut self, builder: &mut Builder<'_>, statement: Statement, current: Current) {
        let span = statement.span;
        match current {
            Current::Box => {
                if let Some(place) = self.boxes.last_mut() {
                    place.enter.push(statement);
                }
            }
            Current::Abort => {
                if let Some(abort) = self.parts.last_mut().and_then(|part| part.abort.as_mut()) {
                    abort.actions.push(statement);
                }
            }
            Current::Gate => {
                if let Some(gate) = self.gates.last_mut() {
                    gate.last_rule().actions.push(statement);
                }
            }
            Current::Broken => {}
            Current::Part | Current::None => self.lost(builder, Some(span), "DO below a box, a gate, THEN or ABORT"),
        }
    }

    fn after(&mut self, builder: &mut Builder<'_>, statement: Statement, current: Current) {
        match (current, self.boxes.last_mut()) {
            (Current::Box, Some(place)) => place.after.push(statement),
            _ => self.lost(builder, Some(statement.span), "AFTER below a process box"),
        }
    }

    fn lost(&self, builder: &mut Builder<'_>, span: Option<Span>, expected: &str) {
        let span = span.unwrap_or(builder.decl.span);
        let message = format!("expected {expected}, found it elsewhere");
        builder.complain(codes::NET_LINE, span, message, "lines belong to the box or gate above them");
    }
}

impl GateLines {
    /// A gate without IF has one rule, that always holds.
    fn last_rule(&mut self) -> &mut RuleLines {
        if self.rules.is_empty() {
            let span = self.line.span;
            self.rules.push(RuleLines { condition: None, routes: Vec::new(), actions: Vec::new(), span });
        }
        let last = self.rules.len() - 1;
        &mut self.rules[last]
    }
}
