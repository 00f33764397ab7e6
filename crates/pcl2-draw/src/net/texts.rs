//! What is written beside boxes and gates, and in their tooltips.

use crate::svg;
use pcl2_lang::net::written::WrittenNet;
use pcl2_lang::net::{Abort, Gate, NetBox, Part};

/// Letters of a name, and of a line below it, that are shown.
pub(crate) const NAME: usize = 20;
const LINE: usize = 30;
/// Lines that are shown below a name.
const LINES: usize = 4;

/// The lines below a box's name, and its tooltip.
pub(crate) fn place(written: &WrittenNet<'_>, index: usize, place: &NetBox) -> (Vec<String>, String) {
    let mut lines = written.clauses(place);
    let drives = written.drives(index);
    if !drives.is_empty() {
        lines.push(format!("DRIVES {}", drives.join(", ")));
    }
    let room = match place.capacity {
        None => "any number of tokens".to_owned(),
        Some(1) => "at most 1 token".to_owned(),
        Some(room) => format!("at most {room} tokens"),
    };
    let head = format!("{} {}: {room}, {} at the start", written.words[index], place.name, place.initial);
    let tip = std::iter::once(head).chain(lines.clone()).collect::<Vec<_>>().join("\n");
    (few(lines), tip)
}

/// The same of a gate. `tested`: what READ and INHIBIT name.
pub(crate) fn gate(written: &WrittenNet<'_>, gate: &Gate, tested: [String; 2]) -> (Vec<String>, String) {
    let rules = written.rules(gate);
    let (before, after) = (written.arcs(&gate.before), written.arcs(&gate.after));
    let mut tip = vec![format!("GATE {}: {before} -> {after}", gate.name)];
    for (word, tested) in ["READ", "INHIBIT"].iter().zip(tested) {
        tip.extend((!tested.is_empty()).then(|| format!("{word} {tested}")));
    }
    tip.extend((gate.priority != 0).then(|| format!("PRIORITY {}", gate.priority)));
    tip.extend(rules.iter().cloned());
    (few(rules), tip.join("\n"))
}

/// The same of what empties a macro.
pub(crate) fn abort(written: &WrittenNet<'_>, part: &Part, abort: &Abort) -> (Vec<String>, String) {
    let lines = written.abort(abort);
    let to = &written.net.place(abort.to).name;
    let tip = format!("ABORT: {} -> {to}\n{}", part.name, lines.join("\n"));
    (few(lines), tip)
}

/// The first lines, each brief.
fn few(lines: Vec<String>) -> Vec<String> {
    let count = lines.len();
    let mut shown: Vec<String> = lines.into_iter().take(LINES).map(|line| svg::brief(&line, LINE)).collect();
    if let (Some(last), true) = (shown.last_mut(), count > LINES) {
        "…".clone_into(last);
    }
    shown
}
