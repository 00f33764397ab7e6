//! What the code of a net can leave out: how often each box and output is touched, and by whom.

use super::gates::GATES;
use pcl2_lang::decl::Step;
use pcl2_lang::net::{BoxId, Drive, Gate, Kind, Level, Net, NetBox, StatementId};
use pcl2_lang::program::{Program, Role, SignalId, Source, Unit};
use pcl2_lang::types::Type;

/// Facts of a net for its code.
#[derive(Clone, Debug, Default)]
pub(crate) struct NetFacts {
    /// By box: how many gates take from it.
    pub(crate) takers: Vec<usize>,
    /// By box: how many gates and ABORT lines put into it.
    pub(crate) putters: Vec<usize>,
    /// By word: who wrote it in a scan must be known.
    pub(crate) tracked: Vec<bool>,
    /// Some gate takes from a box and puts into it: then room is not what was put.
    pub(crate) loops: bool,
    /// By level of the words that boxes drive: the word.
    pub(crate) levels: Vec<usize>,
    /// By level: no statement of the net reads the word.
    pub(crate) unread: Vec<bool>,
    /// By gate: the input that must be 1, or 0, so that it can fire.
    pub(crate) literals: Vec<Option<Literal>>,
    /// Inputs and the gates that wait for them, in order.
    waiting: Vec<(u32, usize)>,
    /// By box: the last gate that puts into it.
    last_putter: Vec<Option<usize>>,
    /// By box: the last gate that takes from it and has another first box.
    last_taker: Vec<Option<usize>>,
    /// By box: the last gate that looks at its tokens without moving them.
    last_watcher: Vec<Option<usize>>,
    /// By box: the last gate with a statement that looks at what its tokens carry.
    last_looker: Vec<Option<usize>>,
    /// By box: the gates that it is the first box of, as words of a set.
    pub(crate) readied: Vec<Vec<(usize, u32)>>,
    /// By box whose token is taken at once although a later gate asks for its room: the gate, as a word of a set, that
    /// is ready when the phase begins exactly if the box is marked.
    pub(crate) begun: Vec<Option<(usize, u32)>>,
    /// By box: the end of the gate phase may have to look at it.
    pub(crate) late: Vec<bool>,
    /// By box: the outputs that it drives, as places among `levels`.
    pub(crate) driven: Vec<Vec<usize>>,
    /// A statement reads the time of an ACTIVE line: each scan changes what the net does.
    pub(crate) ticking: bool,
}

/// An input as a condition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Literal {
    /// The input's signal.
    pub(crate) input: SignalId,
    /// What it must be: not 0, or 0.
    pub(crate) truth: bool,
}

/// The operator that makes the opposite of a condition.
const NEGATION: &str = "NOT";

/// Whether a box does something in the box phase after its token came, and is excited after that.
pub(crate) fn waits(place: &NetBox) -> bool {
    match place.kind {
        Kind::Time(_) | Kind::Action(_) | Kind::Process(_) => true,
        Kind::State | Kind::Capacity | Kind::Count | Kind::Generation(_) | Kind::Macro(_) => false,
    }
}

/// Whether a box is looked at in each box phase, marked or not.
pub(crate) fn generates(place: &NetBox) -> bool {
    matches!(place.kind, Kind::Generation(_))
}

/// The facts of a net; `part`: it stands inside another net.
pub(crate) fn of(program: &Program, net: &Net, unit: &Unit, held: usize, part: bool) -> NetFacts {
    let mut facts = NetFacts {
        takers: vec![0; net.boxes.len()],
        putters: vec![0; net.boxes.len()],
        tracked: vec![false; net.words.len()],
        ..NetFacts::default()
    };
    let none = || vec![None; net.boxes.len()];
    (facts.last_putter, facts.last_taker, facts.last_watcher) = (none(), none(), none());
    facts.last_looker = none();
    (facts.readied, facts.driven) = (vec![Vec::new(); net.boxes.len()], vec![Vec::new(); net.boxes.len()]);
    net.gates.iter().enumerate().for_each(|(i, gate)| facts.gate(i, gate));
    for abort in net.parts.iter().filter_map(|part| part.abort.as_ref()) {
        facts.putters[abort.to.0 as usize] += 1;
    }
    track(&mut facts, net, part);
    // BLOCKED tells of a permissive that does not hold: it must be tried.
    let told = net.blocked.is_some();
    facts.literals = net.gates.iter().map(|gate| gate_literal(program, unit, gate, told)).collect();
    let waiting =
        facts.literals.iter().enumerate().filter_map(|(gate, literal)| Some((literal.as_ref()?.input.0, gate)));
    facts.waiting = waiting.collect();
    facts.waiting.sort_unstable();
    facts.watch(net, unit, held + net.words.len());
    let driven = |word: &&usize| matches!(net.words[**word].drive, Drive::Level(_));
    facts.levels = (0..net.words.len()).collect::<Vec<_>>().iter().filter(driven).copied().collect();
    facts.drive(net);
    let timers: Vec<usize> = net.actives.iter().filter_map(|active| active.time).map(|word| word.0 as usize).collect();
    let reads = |word: usize| {
        let mut ports = unit.blocks.iter().flat_map(|block| &block.ports).filter_map(Source::signal);
        ports.any(|signal| signal.0 as usize == held + word)
    };
    facts.unread = facts.levels.iter().map(|word| !reads(*word)).collect();
    facts.begun = (0..net.boxes.len()).map(|place| facts.find_begun(net, BoxId(place as u32))).collect();
    facts.late = facts.find_late(net);
    facts.ticking = timers.iter().any(|word| part || reads(*word));
    facts
}

/// An input that must be so whatever else holds: the condition of the only rule, or a permissive.
fn gate_literal(program: &Program, unit: &Unit, gate: &Gate, told: bool) -> Option<Literal> {
    let sole = match gate.rules.as_slice() {
        [rule] => rule.condition,
        _ => None,
    };
    let permits = gate.permits.iter().filter(|_| !told).map(|permit| permit.condition);
    let mut conditions = sole.into_iter().chain(permits);
    conditions.find_map(|condition| literal(program, unit, condition))
}

/// A condition that is an input, or the opposite of one.
pub(crate) fn literal(program: &Program, unit: &Unit, condition: StatementId) -> Option<Literal> {
    let block = unit.blocks.get(condition.0 as usize)?;
    let formula = program.decl(block.decl).formula.as_deref()?;
    let truth = match formula {
        [Step::Port] => true,
        [Step::Port, Step::Apply(code)] if program.decl(*code).operator.as_deref() == Some(NEGATION) => false,
        _ => return None,
    };
    let input = block.ports.first().and_then(Source::signal)?;
    let signal = unit.signal(input);
    let port = matches!(signal.role, Role::Port(_)) && signal.ty == Type::INT;
    port.then_some(Literal { input, truth })
}

/// Adds a gate, which comes behind those that are there, to the words of a set.
pub(super) fn add_gate(sets: &mut Vec<(usize, u32)>, gate: usize) {
    let (set, bit) = (gate / GATES, 1 << (gate % GATES));
    match sets.last_mut().filter(|(known, _)| *known == set) {
        Some((_, gates)) => *gates |= bit,
        None => sets.push((set, bit)),
    }
}

fn is_loop(gate: &Gate) -> bool {
    gate.before.iter().any(|arc| gate.after.iter().any(|other| other.place == arc.place))
}

/// Outputs that several statements write, and those of a net inside: the net around it asks who wrote them.
fn track(facts: &mut NetFacts, net: &Net, part: bool) {
    let mut writers = vec![0; net.words.len()];
    for touched in &net.touched {
        touched.writes.iter().chain(&touched.counts).for_each(|word| writers[word.0 as usize] += 1);
    }
    for (_, word) in net.parts.iter().flat_map(|part| &part.writes) {
        writers[word.0 as usize] += 1;
    }
    for (word, tracked) in facts.tracked.iter_mut().enumerate() {
        let written = matches!(net.words[word].drive, Drive::Written);
        *tracked = written && (writers[word] > 1 || (part && word < net.outputs));
    }
}

impl NetFacts {
    fn gate(&mut self, index: usize, gate: &Gate) {
        for (i, arc) in gate.before.iter().enumerate() {
            let place = arc.place.0 as usize;
            self.takers[place] += 1;
            if i > 0 {
                self.last_taker[place] = Some(index);
            }
        }
        for arc in &gate.after {
            self.putters[arc.place.0 as usize] += 1;
            self.last_putter[arc.place.0 as usize] = Some(index);
        }
        self.loops |= is_loop(gate);
        if let Some(first) = gate.before.first() {
            add_gate(&mut self.readied[first.place.0 as usize], index);
        }
    }

    /// Gates that read a box or that it inhibits, and those whose statements look at its tokens.
    fn watch(&mut self, net: &Net, unit: &Unit, tokens: usize) {
        for (i, gate) in net.gates.iter().enumerate() {
            for tested in gate.reads.iter().chain(&gate.inhibits).filter(|tested| tested.part.is_none()) {
                self.last_watcher[tested.place.0 as usize] = Some(i);
            }
            let rules = gate.rules.iter().flat_map(|rule| rule.condition.iter().chain(&rule.actions));
            for statement in rules.chain(gate.permits.iter().map(|permit| &permit.condition)) {
                for place in &net.touched[statement.0 as usize].looks {
                    self.last_looker[place.0 as usize] = Some(i);
                }
                for source in &unit.blocks[statement.0 as usize].ports {
                    if let Source::Element(signal, element) = source
                        && signal.0 as usize == tokens
                    {
                        self.last_watcher[*element as usize] = Some(i);
                    }
                }
            }
        }
    }

    fn drive(&mut self, net: &Net) {
        for (level, word) in self.levels.iter().enumerate() {
            if let Drive::Level(levels) = &net.words[*word].drive {
                for item in levels {
                    if let Level::Box(place) = item {
                        self.driven[place.0 as usize].push(level);
                    }
                }
            }
        }
    }

    /// What tells of a box for one token, when a gate has taken that at once, that it was marked when the phase began. The
    /// net around a macro may empty its boxes.
    fn find_begun(&self, net: &Net, place: BoxId) -> Option<(usize, u32)> {
        let (set, gates) = *self.readied[place.0 as usize].first()?;
        let early = |(gate, _): &(usize, &Gate)| {
            self.is_movable(net, *gate, place) && self.last_putter[place.0 as usize].is_some_and(|last| last > *gate)
        };
        let mut takers =
            net.gates.iter().enumerate().filter(|(_, gate)| gate.before.iter().any(|arc| arc.place == place));
        let sole = net.place(place).capacity == Some(1) && net.exit.is_none();
        (sole && takers.any(|taker| early(&taker))).then_some((set, gates & gates.wrapping_neg()))
    }

    /// Boxes whose tokens do not all come and go at once. The net around a macro may empty all its boxes, and an operator
    /// may put a token into any box.
    fn find_late(&self, net: &Net) -> Vec<bool> {
        let plain = |place: &NetBox| matches!(place.kind, Kind::State | Kind::Capacity);
        let mut late: Vec<bool> = net.boxes.iter().map(|place| !plain(place)).collect();
        for (i, gate) in net.gates.iter().enumerate() {
            for arc in &gate.before {
                late[arc.place.0 as usize] |= !self.takes_at_once(net, i, arc.place);
            }
            for arc in &gate.after {
                late[arc.place.0 as usize] |= !self.puts_at_once(net, i, arc.place);
            }
        }
        for abort in net.parts.iter().filter_map(|part| part.abort.as_ref()) {
            late[abort.to.0 as usize] = true;
        }
        if net.exit.is_some() || net.operation.is_some() { vec![true; late.len()] } else { late }
    }

    /// The gates that wait for an input.
    pub(crate) fn waiting_for(&self, input: SignalId) -> impl Iterator<Item = usize> {
        let first = self.waiting.partition_point(|(known, _)| *known < input.0);
        self.waiting[first..].iter().take_while(move |(known, _)| *known == input.0).map(|(_, gate)| *gate)
    }

    /// Whether a box drives outputs and is not looked at when the phase ends: gates count for it.
    pub(crate) fn counts_at_once(&self, place: usize) -> bool {
        !self.driven[place].is_empty() && !self.late[place]
    }

    /// Whether a box counts at once for an output that follows when the phase ends.
    pub(crate) fn outputs_follow(&self, place: usize) -> bool {
        self.counts_at_once(place) && self.driven[place].iter().any(|level| !self.unread[*level])
    }

    /// Whether a box drives outputs and is looked at when the phase ends.
    pub(crate) fn shows_late(&self) -> bool {
        self.driven.iter().zip(&self.late).any(|(driven, late)| !driven.is_empty() && *late)
    }

    /// Whether any gate waits for an input.
    pub(crate) fn has_literals(&self) -> bool {
        self.literals.iter().any(Option::is_some)
    }

    /// Whether a gate may take from a box at once, before the end of the phase: no gate after it in a scan asks how many
    /// tokens the box had at the start, or what room without being told.
    pub(crate) fn takes_at_once(&self, net: &Net, gate: usize, place: BoxId) -> bool {
        let told = self.begun[place.0 as usize].is_some();
        self.is_movable(net, gate, place)
            && (told || self.last_putter[place.0 as usize].is_none_or(|last| last <= gate))
    }

    /// Whether a gate may put into a box at once: no gate after it in a scan could take the token, or asks for it. Gates
    /// that the box is the first box of were chosen when the phase began.
    pub(crate) fn puts_at_once(&self, net: &Net, gate: usize, place: BoxId) -> bool {
        let sole = net.place(place).capacity == Some(1);
        sole && self.is_movable(net, gate, place) && self.last_taker[place.0 as usize].is_none_or(|last| last <= gate)
    }

    fn is_movable(&self, net: &Net, gate: usize, place: BoxId) -> bool {
        let plain = matches!(net.place(place).kind, Kind::State | Kind::Capacity);
        let (before, after) = (&net.gates[gate].before, &net.gates[gate].after);
        let stays = before.iter().any(|arc| arc.place == place) && after.iter().any(|arc| arc.place == place);
        // What a statement of the gate itself sees is in hand, or there as before.
        let unseen = self.last_looker[place.0 as usize].is_none_or(|last| last <= gate);
        let operated = net.operation.is_some();
        plain && !operated && !stays && unseen && self.last_watcher[place.0 as usize].is_none_or(|last| last < gate)
    }

    /// Whether any write is tracked.
    pub(crate) fn tracks(&self) -> bool {
        self.tracked.contains(&true)
    }

    /// Whether a statement writes a tracked word.
    pub(crate) fn tracks_statement(&self, net: &Net, statement: StatementId) -> bool {
        let touched = &net.touched[statement.0 as usize];
        touched.writes.iter().chain(&touched.counts).any(|word| self.tracked[word.0 as usize])
    }
}
