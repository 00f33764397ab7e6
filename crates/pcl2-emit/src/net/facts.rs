//! What the code of a net can leave out: how often each box and output is touched, and by whom.

use pcl2_lang::net::{BoxId, Drive, Gate, Kind, Net, NetBox, StatementId};
use pcl2_lang::program::{Source, Unit};

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
    /// A statement reads the time of an ACTIVE line: each scan changes what the net does.
    pub(crate) ticking: bool,
}

/// Whether a net can become code of its own: tokens without attributes, no operator.
pub(crate) fn is_plain(net: &Net) -> bool {
    !net.operated()
        && net.boxes.iter().all(|place| place.class.is_none())
        && net.touched.iter().all(|touched| plain_looks(net, &touched.looks))
}

/// A process box may look at its cause and answer ready.
fn plain_looks(net: &Net, looks: &[BoxId]) -> bool {
    looks.iter().all(|place| matches!(net.place(*place).kind, Kind::Process(_)))
}

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
pub(crate) fn of(net: &Net, unit: &Unit, held: usize, part: bool) -> NetFacts {
    let mut facts = NetFacts {
        takers: vec![0; net.boxes.len()],
        putters: vec![0; net.boxes.len()],
        tracked: vec![false; net.words.len()],
        ..NetFacts::default()
    };
    for gate in &net.gates {
        gate.before.iter().for_each(|arc| facts.takers[arc.place.0 as usize] += 1);
        gate.after.iter().for_each(|arc| facts.putters[arc.place.0 as usize] += 1);
        facts.loops |= is_loop(gate);
    }
    for abort in net.parts.iter().filter_map(|part| part.abort.as_ref()) {
        facts.putters[abort.to.0 as usize] += 1;
    }
    track(&mut facts, net, part);
    let driven = |word: &&usize| matches!(net.words[**word].drive, Drive::Level(_));
    facts.levels = (0..net.words.len()).collect::<Vec<_>>().iter().filter(driven).copied().collect();
    let timers: Vec<usize> = net.actives.iter().filter_map(|active| active.time).map(|word| word.0 as usize).collect();
    let reads = |word: usize| {
        let mut ports = unit.blocks.iter().flat_map(|block| &block.ports).filter_map(Source::signal);
        ports.any(|signal| signal.0 as usize == held + word)
    };
    facts.ticking = timers.iter().any(|word| part || reads(*word));
    facts
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
