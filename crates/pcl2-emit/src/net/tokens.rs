//! Tokens with attributes as code: which one a statement sees, which one a gate takes, where they go.

use super::classes::{self, HAND, TOKENS};
use super::{NetBody, fast, statements};
use crate::statics::Statics;
use pcl2_lang::net::{BoxId, Kind, Order, StatementId};
use pcl2_lang::program::SignalId;
use pcl2_lang::types::Scalar;
use std::fmt::Write;

/// The token in hand of a box while a statement is run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Held {
    /// None: the first is lent.
    No,
    /// That of a place, which stays there.
    At(String),
    /// It is on its way.
    OnItsWay,
}

/// What is in the hands of a gate or a box.
pub(super) type Hands = [(BoxId, Held)];

impl NetBody<'_, '_, '_> {
    /// Whether tokens of a box carry anything.
    pub(super) fn carries(&self, id: BoxId) -> bool {
        classes::carries(self.net, self.net.place(id))
    }

    /// The token in hand of a box.
    pub(super) fn hand(&self, id: BoxId) -> String {
        format!("self->{HAND}.{}", self.member(id))
    }

    /// The tokens of a box.
    pub(super) fn tokens(&self, id: BoxId) -> String {
        format!("self->{TOKENS}.{}", self.member(id))
    }

    pub(super) fn member(&self, id: BoxId) -> &str {
        &self.layout.names.boxes[id.0 as usize]
    }

    /// How many tokens a box has that can still be taken.
    pub(super) fn left(&self, id: BoxId) -> String {
        let name = self.place(id);
        match self.layout.facts.late[id.0 as usize] {
            true => format!("self->box[{name}] - self->net.taken[{name}]"),
            false => format!("self->box[{name}]"),
        }
    }

    /// How many tokens a box has that can still be taken, or that came in this gate phase.
    fn there(&self, id: BoxId) -> String {
        format!("{}_there(self, {})", self.tag(), self.place(id))
    }

    /// Whether a box has at most one token.
    pub(super) fn is_single(&self, id: BoxId) -> bool {
        self.net.place(id).capacity == Some(1)
    }

    /// Of a macro: what is true while its exit is marked, and the token there.
    fn in_exit(&self, id: BoxId) -> Option<(String, String)> {
        let Kind::Macro(part) = self.net.place(id).kind else {
            return None;
        };
        let inner = fast::inner(self, part.0 as usize)?;
        let inside = NetBody::of(&inner)?;
        let exit = inside.net.exit?;
        let root = format!("self->{}.", fast::member(self, part.0 as usize));
        let token = format!("{root}{TOKENS}.{}[0]", inside.member(exit));
        Some((format!("{root}box[{}] > 0", inside.place(exit)), token))
    }

    /// The token of a box that has one and no room for more; of a macro that in its exit, before that as it came in.
    pub(super) fn sole_token(&self, id: BoxId) -> String {
        match self.in_exit(id) {
            Some((marked, token)) => format!("({marked} ? {token} : {}[0])", self.tokens(id)),
            None => format!("{}[0]", self.tokens(id)),
        }
    }

    /// The place of the first token of a box; negative where there is none.
    fn first(&self, id: BoxId) -> String {
        match &self.layout.names.next[id.0 as usize] {
            Some(next) if !self.is_single(id) => format!("{next}(self, -1)"),
            _ if classes::is_lifo(self.net, id) && !self.is_single(id) => format!("{} - 1", self.left(id)),
            _ => format!("{} > 0 ? 0 : -1", self.left(id)),
        }
    }

    /// The constant that is a new token of a box.
    fn fresh(&self, id: BoxId) -> &str {
        self.net.place(id).class.map_or("", |class| &self.layout.names.classes[class.0 as usize].fresh)
    }

    /// The boxes with attributes that a statement looks at.
    pub(super) fn looks(&self, statement: StatementId) -> Vec<BoxId> {
        let looks = &self.net.touched[statement.0 as usize].looks;
        looks.iter().copied().filter(|place| self.carries(*place)).collect()
    }

    /// Whether a statement writes an attribute of a box.
    fn writes(&self, statement: StatementId, id: BoxId) -> bool {
        let outputs = &self.body.unit.blocks[statement.0 as usize].outputs;
        outputs.iter().any(|signal| self.owner(*signal) == Some(id))
    }

    /// The box that a signal is an attribute of.
    fn owner(&self, signal: SignalId) -> Option<BoxId> {
        let mut first = self.layout.held + self.net.words.len() + 1;
        for (i, place) in self.net.boxes.iter().enumerate() {
            let attributes = self.net.attributes(place).len();
            if (first..first + attributes).contains(&(signal.0 as usize)) {
                return Some(BoxId(i as u32));
            }
            first += attributes + if place.asks() { 2 } else { 0 };
        }
        None
    }

    /// The members of a box's token.
    fn attributes(&self, id: BoxId) -> &[String] {
        self.net.place(id).class.map_or(&[], |class| &self.layout.names.classes[class.0 as usize].members)
    }
}

/// What is in the hand of a box.
fn held(hands: &Hands, id: BoxId) -> &Held {
    hands.iter().find(|(known, _)| *known == id).map_or(&Held::No, |(_, held)| held)
}

/// The boxes that lend a statement their first token.
pub(super) fn lenders(net: &NetBody<'_, '_, '_>, statement: StatementId, hands: &Hands) -> Vec<BoxId> {
    net.looks(statement).into_iter().filter(|place| *held(hands, *place) == Held::No).collect()
}

/// Writes how boxes lend a statement their first token; where there is none, a new one is in hand.
pub(super) fn lend(
    out: &mut String,
    net: &NetBody<'_, '_, '_>,
    statement: StatementId,
    lenders: &[BoxId],
    indent: &str,
) {
    for id in lenders {
        let (hand, tokens, fresh) = (net.hand(*id), net.tokens(*id), net.fresh(*id));
        if net.is_single(*id) {
            let _ = writeln!(out, "{indent}{hand} = {} > 0 ? {} : {fresh};", net.left(*id), net.sole_token(*id));
            continue;
        }
        let at = lent(net, statement, *id);
        let _ = writeln!(out, "{indent}const int32_t {at} = {};", net.first(*id));
        let _ = writeln!(out, "{indent}{hand} = {at} >= 0 ? {tokens}[{at}] : {fresh};");
    }
}

/// The local variable with the place of the token that a box lent to a statement.
fn lent(net: &NetBody<'_, '_, '_>, statement: StatementId, id: BoxId) -> String {
    format!("at{}_{}", statement.0, net.member(id))
}

/// The local variable with the place of the token that a gate takes from a box.
pub(super) fn at(net: &NetBody<'_, '_, '_>, id: BoxId) -> String {
    format!("at_{}", net.member(id))
}

/// Writes a condition's locals after its tokens are lent, and returns the condition.
pub(super) fn condition(
    out: &mut String,
    statics: &mut Statics,
    net: &NetBody<'_, '_, '_>,
    statement: StatementId,
    hands: &Hands,
    indent: &str,
) -> String {
    lend(out, net, statement, &lenders(net, statement, hands), indent);
    statements::condition(out, statics, net, statement, indent)
}

/// Writes what a time computes on its way after its tokens are lent, and returns it in nanoseconds.
pub(super) fn time(
    out: &mut String,
    statics: &mut Statics,
    net: &NetBody<'_, '_, '_>,
    statement: StatementId,
    indent: &str,
) -> String {
    lend(out, net, statement, &lenders(net, statement, &[]), indent);
    statements::time(out, statics, net, statement, indent)
}

/// Writes a statement between tokens lent and given back; `body` writes the statement.
pub(super) fn around(
    out: &mut String,
    net: &NetBody<'_, '_, '_>,
    statement: StatementId,
    hands: &Hands,
    indent: &str,
    body: impl FnOnce(&mut String, &str),
) {
    let lenders = lenders(net, statement, hands);
    let inner = format!("{indent}    ");
    if !lenders.is_empty() {
        let _ = writeln!(out, "{indent}{{");
        lend(out, net, statement, &lenders, &inner);
    }
    body(out, if lenders.is_empty() { indent } else { &inner });
    for id in net.looks(statement).into_iter().filter(|id| net.writes(statement, *id)) {
        let (hand, tokens) = (net.hand(id), net.tokens(id));
        let _ = match held(hands, id) {
            Held::OnItsWay => Ok(()),
            Held::At(_) if net.is_single(id) => {
                give_back(out, net, id, indent);
                Ok(())
            }
            Held::At(place) => writeln!(out, "{indent}{tokens}[{place}] = {hand};"),
            Held::No if net.is_single(id) => {
                let _ = writeln!(out, "{inner}if ({} > 0) {{", net.left(id));
                give_back(out, net, id, &format!("{inner}    "));
                writeln!(out, "{inner}}}")
            }
            Held::No => {
                let at = lent(net, statement, id);
                writeln!(out, "{inner}if ({at} >= 0) {{\n{inner}    {tokens}[{at}] = {hand};\n{inner}}}")
            }
        };
    }
    if !lenders.is_empty() {
        let _ = writeln!(out, "{indent}}}");
    }
}

/// Writes how the token in hand of a box that has one gets back.
fn give_back(out: &mut String, net: &NetBody<'_, '_, '_>, id: BoxId, indent: &str) {
    let (hand, tokens) = (net.hand(id), net.tokens(id));
    let _ = match net.in_exit(id) {
        Some((marked, token)) => write!(
            out,
            "{indent}if ({marked}) {{
{indent}    {token} = {hand};
{indent}}} else {{
{indent}    {tokens}[0] = {hand};
{indent}}}
"
        ),
        None => writeln!(out, "{indent}{tokens}[0] = {hand};"),
    };
}

/// Writes how a token gets into hand: that of a place, else the first; and how it leaves its box.
pub(super) fn take(out: &mut String, net: &NetBody<'_, '_, '_>, id: BoxId, hands: &Hands, indent: &str) {
    if !net.carries(id) {
        return;
    }
    let (hand, tokens) = (net.hand(id), net.tokens(id));
    if net.is_single(id) {
        if *held(hands, id) == Held::No {
            let _ = writeln!(out, "{indent}{hand} = {};", net.sole_token(id));
        }
        return;
    }
    let place = match held(hands, id) {
        Held::At(place) => place.clone(),
        Held::No | Held::OnItsWay => {
            let ordered = net.layout.names.next[id.0 as usize].is_some() || classes::is_lifo(net.net, id);
            let place = if ordered { at(net, id) } else { "0".to_owned() };
            if ordered {
                let _ = writeln!(out, "{indent}const int32_t {place} = {};", net.first(id));
            }
            let _ = writeln!(out, "{indent}{hand} = {tokens}[{place}];");
            place
        }
    };
    let there = net.there(id);
    let _ = writeln!(out, "{indent}pcl2_net_close_gap({tokens}, sizeof {tokens}[0], {place}, {there});");
}

/// Writes how a new token gets into hand.
pub(super) fn make(out: &mut String, net: &NetBody<'_, '_, '_>, id: BoxId, indent: &str) {
    if net.carries(id) {
        let _ = writeln!(out, "{indent}{} = {};", net.hand(id), net.fresh(id));
    }
}

/// Writes how the token in the hand of one box is laid into another, before that counts it.
pub(super) fn lay(out: &mut String, net: &NetBody<'_, '_, '_>, from: BoxId, to: BoxId, indent: &str) {
    if !net.carries(to) {
        return;
    }
    let (hand, tokens) = (net.hand(from), net.tokens(to));
    let place = match net.is_single(to) {
        true => "0".to_owned(),
        false => net.there(to),
    };
    let _ = writeln!(out, "{indent}{tokens}[{place}] = {hand};");
}

/// What a token carries on its way into a macro's net, or out of it.
pub(super) struct Crossing<'x, 'b, 'c, 'a> {
    /// The box with the token in hand.
    pub(super) hand: BoxId,
    /// The macro's net.
    pub(super) inside: &'x NetBody<'b, 'c, 'a>,
    /// Its entry or its exit.
    pub(super) end: BoxId,
    /// What stands before the members of that net.
    pub(super) root: &'x str,
    /// Into it.
    pub(super) into: bool,
}

/// Writes how what a token carries crosses the border of a macro.
pub(super) fn cross(out: &mut String, net: &NetBody<'_, '_, '_>, way: &Crossing<'_, '_, '_, '_>, indent: &str) {
    if !net.carries(way.hand) {
        return;
    }
    let (hand, token) = (net.hand(way.hand), format!("{}{TOKENS}.{}[0]", way.root, way.inside.member(way.end)));
    let _ = match way.into {
        true => writeln!(out, "{indent}{token} = {hand};"),
        false => writeln!(out, "{indent}{hand} = {token};"),
    };
}

/// Writes the functions that find the next token of boxes with an order by an attribute, those that `text` uses.
pub(super) fn next_functions(out: &mut String, net: &NetBody<'_, '_, '_>, text: &str) {
    let tag = net.tag();
    for (i, place) in net.net.boxes.iter().enumerate() {
        let Some(next) = net.layout.names.next[i].as_ref().filter(|next| text.contains(&format!(" {next}("))) else {
            continue;
        };
        let (sign, attribute) = match place.order {
            Order::Least(attribute) => ("", attribute),
            Order::Most(attribute) => ("-", attribute),
            Order::Fifo | Order::Lifo => continue,
        };
        let id = BoxId(i as u32);
        let scalar = net.net.attributes(place)[attribute as usize].scalar;
        let key = |at: &str| {
            let value = format!("{}[{at}].{}", net.tokens(id), net.attributes(id)[attribute as usize]);
            match scalar {
                Scalar::Int => format!("{sign}(int64_t){value}"),
                Scalar::Real => format!("pcl2_net_key({sign}{value})"),
            }
        };
        let ty = match scalar {
            Scalar::Int => "int64_t",
            Scalar::Real => "pcl2_real",
        };
        let _ = write!(
            out,
            "/* The place of the token of {name} that goes after another, -1: that of the first; -1: there is none. */
static int32_t {next}(const struct {tag} *self, int32_t after)
{{
    const int32_t n = {left};
    const {ty} last = after < 0 ? 0 : {last};
    {ty} least = 0;
    int32_t next = -1;
    for (int32_t i = 0; i < n; i++) {{
        const {ty} key = {key};
        const int32_t later = after < 0 || key > last || (key == last && i > after);
        if (later && (next < 0 || key < least)) {{
            next = i;
            least = key;
        }}
    }}
    return next;
}}

",
            name = place.name,
            left = net.left(id),
            last = key("after"),
            key = key("i"),
        );
    }
}
