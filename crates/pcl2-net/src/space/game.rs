//! The token game: one marking that changes, with the transitions that are enabled in it.

use super::rules::{Rule, Rules};

/// A marking in play.
#[derive(Clone, Debug)]
pub(super) struct Game<'a> {
    pub(super) rules: &'a Rules,
    pub(super) marking: Vec<u64>,
    /// By place: the conditions on it.
    conditions: Vec<Vec<Condition>>,
    /// By transition: how many of its conditions do not hold.
    unmet: Vec<u32>,
    /// The enabled transitions, in no order of meaning.
    pub(super) enabled: Vec<u32>,
    /// By transition: where it stands among the enabled ones.
    position: Vec<u32>,
}

#[derive(Clone, Copy, Debug)]
struct Condition {
    transition: u32,
    least: u64,
    most: u64,
}

impl Condition {
    fn holds(self, tokens: u64) -> bool {
        (self.least..=self.most).contains(&tokens)
    }
}

impl<'a> Game<'a> {
    /// Begins at a marking.
    pub(super) fn new(rules: &'a Rules, marking: &[u64]) -> Game<'a> {
        let mut conditions = vec![Vec::new(); rules.places];
        for (transition, rule) in (0_u32..).zip(&rules.list) {
            for (place, least) in rule.lower() {
                conditions[place].push(Condition { transition, least, most: u64::MAX });
            }
            for (place, most) in rule.upper() {
                conditions[place].push(Condition { transition, least: 0, most });
            }
        }
        let transitions = rules.list.len();
        let (unmet, position) = (vec![0; transitions], vec![0; transitions]);
        let mut game = Game { rules, marking: Vec::new(), conditions, unmet, enabled: Vec::new(), position };
        game.set(marking);
        game
    }

    /// Goes to a marking.
    pub(super) fn set(&mut self, marking: &[u64]) {
        self.marking = marking.to_vec();
        for (unmet, rule) in self.unmet.iter_mut().zip(&self.rules.list) {
            *unmet = u32::from(rule.never);
        }
        for (conditions, tokens) in self.conditions.iter().zip(&self.marking) {
            for condition in conditions.iter().filter(|condition| !condition.holds(*tokens)) {
                self.unmet[condition.transition as usize] += 1;
            }
        }
        self.enabled.clear();
        for transition in (0_u32..).zip(&self.unmet).filter(|(_, unmet)| **unmet == 0).map(|(transition, _)| transition)
        {
            self.position[transition as usize] = self.enabled.len() as u32;
            self.enabled.push(transition);
        }
    }

    /// Fires an enabled transition. Whether the numbers stay within what is counted with.
    pub(super) fn fire(&mut self, transition: usize) -> bool {
        let rule: &'a Rule = &self.rules.list[transition];
        rule.change.iter().all(|(place, change)| self.add(*place, *change))
    }

    fn add(&mut self, place: usize, change: i64) -> bool {
        let old = self.marking[place];
        let Some(new) = old.checked_add_signed(change).filter(|new| *new <= crate::pt::MOST) else {
            return false;
        };
        self.marking[place] = new;
        for at in 0..self.conditions[place].len() {
            let condition = self.conditions[place][at];
            match (condition.holds(old), condition.holds(new)) {
                (true, false) => self.miss(condition.transition),
                (false, true) => self.meet(condition.transition),
                _ => {}
            }
        }
        true
    }

    fn miss(&mut self, transition: u32) {
        let unmet = &mut self.unmet[transition as usize];
        *unmet += 1;
        if *unmet == 1 {
            let at = self.position[transition as usize];
            self.enabled.swap_remove(at as usize);
            if let Some(moved) = self.enabled.get(at as usize) {
                self.position[*moved as usize] = at;
            }
        }
    }

    fn meet(&mut self, transition: u32) {
        let unmet = &mut self.unmet[transition as usize];
        *unmet -= 1;
        if *unmet == 0 {
            self.position[transition as usize] = self.enabled.len() as u32;
            self.enabled.push(transition);
        }
    }
}

/// Numbers that look random and are always the same (a linear congruential generator; its upper bits).
#[derive(Clone, Copy, Debug)]
pub(super) struct Dice(u64);

impl Dice {
    /// Begins a sequence.
    pub(super) fn new(seed: u64) -> Dice {
        Dice(seed)
    }

    /// A number below another one.
    pub(super) fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((u128::from(self.0) * end as u128) >> 64) as usize
    }
}

/// Steps of all walks together, where going back to the initial marking counts as steps.
const STEPS: usize = 200_000;
/// Steps of one walk.
const WALK: usize = 400;

/// How many tokens the places are expected to hold: for each place a walk that spares what it has. A guess that keeps
/// fields from becoming too narrow later; nothing else depends on it.
pub(super) fn expected(rules: &Rules, initial: &[u64]) -> Vec<u64> {
    let mut most = initial.to_vec();
    let mut game = Game::new(rules, initial);
    let mut dice = Dice::new(1);
    let steps = WALK.min(STEPS / rules.places.max(1)).max(1);
    let back = (rules.places + rules.list.len()) / 8;
    for place in (0..rules.places).take(STEPS / (steps + back)) {
        for _ in 0..steps {
            let Some(transition) = sparing(&game, place, &mut dice) else { break };
            if !game.fire(transition) {
                break;
            }
            for (changed, _) in &rules.list[transition].change {
                most[*changed] = most[*changed].max(game.marking[*changed]);
            }
        }
        game.set(initial);
    }
    most
}

/// An enabled transition that takes nothing from a place, if some throws of the dice find one; else any one.
fn sparing(game: &Game<'_>, place: usize, dice: &mut Dice) -> Option<usize> {
    let mut chosen = None;
    for _ in 0..game.enabled.len().min(8) {
        let transition = game.enabled[dice.below(game.enabled.len())] as usize;
        chosen = Some(transition);
        if !game.rules.list[transition].change.iter().any(|(at, change)| *at == place && *change < 0) {
            break;
        }
    }
    chosen
}
