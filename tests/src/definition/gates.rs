//! The gate phase: every ABORT, then gates by priority.

use super::expression::{Expression, Value};
use super::hands;
use super::instance::{Arrival, Hand, Instance, Mode, NOBODY, Rank};
use super::model::{Gate, Kind, Net, Rule};
use super::statements::run;
use super::tokens::{Token, World};

/// Whether gates are tried in this scan.
fn are_tried(mode: Mode) -> bool {
    match mode {
        Mode::Automatic | Mode::Step(true) => true,
        Mode::Step(false) | Mode::Manual | Mode::Stopped => false,
    }
}

/// Empties macros whose ABORT holds.
pub(super) fn aborts(instance: &mut Instance, world: &mut World) {
    if are_tried(instance.mode) {
        (0..instance.boxes.len()).for_each(|place| abort(instance, place, world));
    }
    instance.parts.iter_mut().for_each(|part| aborts(part, world));
}

fn abort(instance: &mut Instance, place: usize, world: &mut World) {
    let net = instance.net;
    let Some(at) = net.part_of(place) else { return };
    let Some(abort) = &net.parts[at].abort else { return };
    let to = net.place(&abort.to);
    // One that was emptied from outside in this scan has none left.
    let Some(token) = instance.first_left(place, world) else { return };
    if !instance.holds(&abort.condition, &[], world) || !instance.has_room(to, 1, 0) {
        return;
    }
    let rank = NOBODY;
    world.note("a macro aborted");
    instance.take_all(place);
    instance.clear_commands(&abort.condition);
    run(instance, &abort.acts, rank, &[(net.boxes[place].name.clone(), token)], world);
    instance.put(to, token, rank);
    instance.filled[to] += 1;
}

/// Gates that can fire do; in manual mode the operator's commands are obeyed instead. Then the same in the nets inside.
pub(super) fn gates(instance: &mut Instance, holder_is_marked: bool, world: &mut World) {
    let net = instance.net;
    if instance.mode == Mode::Step(true) {
        world.note("a step");
    }
    if are_tried(instance.mode) {
        for gate in in_order(net) {
            attempt(instance, gate, false, world);
        }
    }
    if instance.mode == Mode::Manual {
        hands::commands(instance, holder_is_marked, world);
    }
    for at in 0..net.parts.len() {
        let holder = net.boxes.iter().position(|place| matches!(place.kind, Kind::Macro(part) if part == at));
        let is_there = |place: usize| instance.start[place].iter().any(|token| !instance.taken.contains(token));
        let marked = holder.is_none_or(is_there);
        gates(&mut instance.parts[at], marked, world);
    }
}

/// By priority, then in the order of the file.
fn in_order(net: &Net) -> Vec<usize> {
    let mut order: Vec<usize> = (0..net.gates.len()).collect();
    order.sort_by_key(|at| -net.gates[*at].priority);
    order
}

/// The gate that is tried first of all.
pub(super) fn first_rank(net: &Net) -> Rank {
    in_order(net).first().map_or(NOBODY, |at| rank_of(net, *at))
}

fn rank_of(net: &Net, gate: usize) -> Rank {
    (net.gates[gate].priority, -i64::try_from(gate).unwrap_or(i64::MAX))
}

/// Fires a gate if it can; one that is forced asks neither conditions nor permissives.
pub(super) fn attempt(instance: &mut Instance, at: usize, forced: bool, world: &mut World) -> bool {
    let gate = &instance.net.gates[at];
    if !instance.is_enabled(gate, world) {
        return false;
    }
    let rule = instance.rule_that_holds(gate, world);
    let first = || gate.rules.first().map(|rule| (rule, instance.hands(gate, rule, world).swap_remove(0)));
    let Some((rule, hand)) = (if forced { rule.or_else(first) } else { rule }) else { return false };
    let deposits = deposits(instance.net, gate, rule);
    let gains: Vec<(usize, usize)> =
        deposits.iter().map(|(place, weight)| (*place, instance.gain(gate, *place, *weight))).collect();
    if !gains.iter().all(|(place, gain)| instance.has_room(*place, *gain, taken_from(instance.net, gate, *place))) {
        return false;
    }
    let permits = |term: &Expression| instance.holds(term, &hand, world);
    if let (false, Some(term)) = (forced, gate.permits.iter().position(|term| !permits(term))) {
        world.note("a permissive that holds a gate back");
        if instance.held_back == 0 {
            instance.held_back = number_of(instance.net, at, term);
        }
        return false;
    }
    gains.iter().for_each(|(place, gain)| instance.filled[*place] += gain);
    note_firing(instance, gate, rule, &hand, world);
    fire(instance, gate, rule, &hand, rank_of(instance.net, at), world);
    true
}

fn note_firing(instance: &Instance, gate: &Gate, rule: &Rule, hand: &Hand, world: &World) {
    let net = instance.net;
    world.note("a firing");
    if !std::ptr::eq(rule, &gate.rules[0]) {
        world.note("a firing by a later rule");
    }
    if !gate.reads.is_empty() {
        world.note("a firing with READ");
    }
    for (name, weight) in &gate.before {
        let place = net.place(name);
        if net.part_of(place).is_some() {
            world.note("a macro left");
        }
        if matches!(net.boxes[place].kind, Kind::Count(_)) {
            world.note("COUNT emptied");
        }
        if *weight > 1 {
            world.note("a firing with a weight");
        }
        if net.boxes[place].class.is_some() {
            world.note("a token with attributes taken");
            let first = instance.to_take(place, world).first().copied();
            if hand.iter().any(|(from, token)| from == name && Some(*token) != first) {
                world.note("a token taken that is not the first");
            }
        }
    }
}

/// The number of a permissive, from 1, in the order of the file.
fn number_of(net: &Net, gate: usize, term: usize) -> i32 {
    let before: usize = net.gates[..gate].iter().map(|gate| gate.permits.len()).sum();
    i32::try_from(before + term + 1).unwrap_or(i32::MAX)
}

/// How many tokens a gate takes from a box.
fn taken_from(net: &Net, gate: &Gate, place: usize) -> usize {
    let arc = gate.before.iter().find(|(name, _)| net.place(name) == place);
    match (arc, &net.boxes[place].kind) {
        (None, _) => 0,
        (Some(_), Kind::Count(size)) => *size,
        (Some((_, weight)), _) => *weight,
    }
}

/// How many tokens a rule puts into which boxes.
fn deposits(net: &Net, gate: &Gate, rule: &Rule) -> Vec<(usize, usize)> {
    let named = |name: &String| rule.routes.iter().any(|route| route.to.contains(name));
    let filled = gate.after.iter().filter(|(name, _)| rule.routes.is_empty() || named(name));
    filled.map(|(name, weight)| (net.place(name), *weight)).collect()
}

fn fire(instance: &mut Instance, gate: &Gate, rule: &Rule, hand: &Hand, rank: Rank, world: &mut World) {
    let net = instance.net;
    for (name, weight) in &gate.before {
        let place = net.place(name);
        let held = hand.iter().find(|(from, _)| from == name).map(|(_, token)| *token);
        let rest = instance.to_take(place, world).into_iter().filter(|token| Some(*token) != held);
        let tokens: Vec<Token> = held.into_iter().chain(rest).take(*weight).collect();
        instance.take(place, &tokens);
    }
    if let Some(condition) = &rule.condition {
        instance.clear_commands(condition);
    }
    let fresh = fresh(net, rule, world);
    run(instance, &rule.acts, rank, &with_fresh(gate, hand, &fresh), world);
    let in_hand = |name: &str| hand.iter().find(|(from, _)| from == name).map(|(_, token)| *token);
    if rule.routes.is_empty() {
        let source = gate.before.first();
        let to: Vec<String> = gate.after.iter().map(|(name, _)| name.clone()).collect();
        route(
            instance,
            gate,
            source.map(|(name, _)| name.as_str()),
            &to,
            source.and_then(|(name, _)| in_hand(name)),
            rank,
            world,
        );
    }
    for routed in &rule.routes {
        match routed.from.as_deref() {
            Some(source) => route(instance, gate, Some(source), &routed.to, in_hand(source), rank, world),
            None => routed.to.iter().for_each(|name| put_fresh(instance, gate, name, &fresh, rank, world)),
        }
    }
}

/// The tokens that THEN NEW makes, by their boxes.
fn fresh(net: &Net, rule: &Rule, world: &mut World) -> Hand {
    let new = rule.routes.iter().filter(|route| route.from.is_none()).flat_map(|route| &route.to);
    let class = |name: &String| net.boxes[net.place(name)].class.as_ref().and_then(|class| net.class(class));
    new.map(|name| (name.clone(), world.new_token(class(name)))).collect()
}

/// Statements see new tokens by the names of their boxes, but for a box before the gate the token that was taken.
fn with_fresh(gate: &Gate, hand: &Hand, fresh: &Hand) -> Hand {
    let seen: Hand =
        fresh.iter().filter(|(name, _)| !gate.before.iter().any(|(before, _)| before == name)).cloned().collect();
    let is_new = |name: &String| seen.iter().any(|(new, _)| new == name);
    let held: Hand = hand.iter().filter(|(name, _)| !is_new(name)).cloned().collect();
    held.into_iter().chain(seen).collect()
}

fn put_fresh(instance: &mut Instance, gate: &Gate, name: &str, fresh: &Hand, rank: Rank, world: &mut World) {
    let place = instance.net.place(name);
    let token = fresh.iter().find(|(to, _)| to == name).map(|(_, token)| *token);
    let more = gate.after.iter().find(|(to, _)| to == name).map_or(0, |(_, weight)| weight.saturating_sub(1));
    token.into_iter().for_each(|token| instance.put(place, token, rank));
    for _ in 0..more {
        // Only plain tokens go several at once.
        let token = world.new_token(None);
        instance.put(place, token, rank);
    }
}

/// Puts a token, and copies of it, or new ones.
fn route(
    instance: &mut Instance,
    gate: &Gate,
    from: Option<&str>,
    to: &[String],
    token: Option<Token>,
    rank: Rank,
    world: &mut World,
) {
    let net = instance.net;
    let class_from = from.and_then(|name| net.boxes[net.place(name)].class.as_ref());
    let mut unused = token;
    for (name, weight) in gate.after.iter().filter(|(name, _)| to.contains(name)) {
        let place = net.place(name);
        let class = net.boxes[place].class.as_ref();
        for _ in 0..*weight {
            let put = match token.filter(|_| class_from == class) {
                Some(token) => unused.take().unwrap_or_else(|| world.copy(token)),
                None => world.new_token(class.and_then(|class| net.class(class))),
            };
            instance.put(place, put, rank);
        }
    }
}

impl Instance<'_> {
    /// Whether it began the phase without tokens, but for a box, and its macros, too.
    fn is_empty_but(&self, but: Option<usize>) -> bool {
        let own = (0..self.start.len()).all(|at| Some(at) == but || self.start[at].is_empty());
        let macros = (0..self.start.len()).filter_map(|at| self.net.part_of(at));
        own && macros.into_iter().all(|part| self.parts[part].is_empty_but(None))
    }

    /// Whether so much room was free at the start and was not filled since; a box that gives `back` keeps its own.
    pub(super) fn has_room(&self, place: usize, gain: usize, back: usize) -> bool {
        if let Some(part) = self.net.part_of(place) {
            // No token enters while anything inside is marked, but that which leaves at the exit.
            let inside = &self.parts[part];
            let leaves = if back > 0 { inside.net.exit() } else { None };
            if !inside.is_empty_but(leaves) {
                return false;
            }
        }
        gain == 0 || self.net.room(place).is_none_or(|room| self.start[place].len() + self.filled[place] + gain <= room)
    }

    /// How many tokens more a box has when a gate fires.
    fn gain(&self, gate: &Gate, place: usize, weight: usize) -> usize {
        weight.saturating_sub(taken_from(self.net, gate, place))
    }

    /// Takes tokens out of a box: of COUNT all, of a macro the one at its exit.
    fn take(&mut self, place: usize, tokens: &[Token]) {
        match self.net.boxes[place].kind {
            Kind::Macro(part) => {
                self.taken.extend(self.start[place].iter().copied());
                self.parts[part].taken.extend(tokens.iter().copied());
            }
            Kind::Count(_) => self.taken.extend(self.start[place].iter().copied()),
            Kind::State
            | Kind::Entry
            | Kind::Exit
            | Kind::Capacity(..)
            | Kind::Time(_)
            | Kind::Operation(_)
            | Kind::Signal(_)
            | Kind::Process(_)
            | Kind::Generate(_) => self.taken.extend(tokens.iter().copied()),
        }
    }

    /// Takes what is in a box; a macro with all that is inside.
    pub(super) fn take_all(&mut self, place: usize) {
        self.taken.extend(self.start[place].iter().copied());
        if let Some(part) = self.net.part_of(place) {
            let inside = &mut self.parts[part];
            (0..inside.boxes.len()).for_each(|at| inside.take_all(at));
        }
    }

    pub(super) fn put(&mut self, place: usize, token: Token, rank: Rank) {
        self.arriving.push(Arrival { place, token, rank });
    }

    /// Commands that a condition reads become 0 at once.
    fn clear_commands(&mut self, condition: &Expression) {
        for name in self.net.momentary.iter().filter(|name| condition.reads(name)) {
            self.words.insert(name.clone(), Value::Int(0));
            self.cleared.push(name.clone());
        }
    }
}
