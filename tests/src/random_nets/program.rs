//! A program over random nets, and what comes from outside.

use crate::definition::expression::Value;
use crate::definition::model::{Input, Net};
use crate::dice::Dice;
use std::collections::BTreeMap;
use std::fmt::Write;

/// Values of inputs and commands, scan by scan.
#[derive(Clone, Debug)]
pub struct Stimulus {
    /// What is written before each scan.
    pub scans: Vec<BTreeMap<String, Value>>,
}

const REALS: [f64; 8] = [0., 0.1, 0.4, 0.9, 2.5, -1., f64::NAN, f64::INFINITY];

impl Stimulus {
    /// Values for a net that runs alone: they change now and then.
    pub fn random(dice: &mut Dice, net: &Net, scans: usize) -> Stimulus {
        let quiet = quiet(dice, scans);
        Stimulus::with_quiet(dice, net, &quiet)
    }

    /// The same with nothing in these scans.
    fn with_quiet(dice: &mut Dice, net: &Net, quiet: &[bool]) -> Stimulus {
        let mut mode = 0;
        let mut one = |scan: usize| {
            let mut writes = BTreeMap::new();
            if quiet[scan] {
                return writes;
            }
            for input in net.inputs.iter().filter(|input| !net.mode.contains(&input.name)) {
                if scan == 0 || dice.once_in(4) {
                    writes.extend(written(dice, input));
                }
            }
            if dice.once_in(10) {
                mode = [0, 0, 0, 1, 2, 2, 3][dice.below(7)];
            }
            for (at, name) in net.mode.iter().enumerate() {
                let value = if at == 0 { mode } else { command(dice, net, at, mode) };
                if at == 0 || value != 0 {
                    writes.insert(name.clone(), Value::Int(value));
                }
            }
            writes
        };
        Stimulus { scans: (0..quiet.len()).map(&mut one).collect() }
    }

    /// Each stimulus with something less: fewer scans, or one that writes less.
    pub fn smaller(&self) -> Vec<Stimulus> {
        let length = self.scans.len();
        let shorter = [length / 2, length * 3 / 4, length.saturating_sub(1)];
        let mut found: Vec<Stimulus> = shorter
            .iter()
            .filter(|to| **to > 0 && **to < length)
            .map(|to| Stimulus { scans: self.scans[..*to].to_vec() })
            .collect();
        if length > 1 {
            found.push(Stimulus { scans: self.scans[1..].to_vec() });
        }
        let mut names: Vec<&String> = self.scans.iter().flat_map(BTreeMap::keys).collect();
        names.sort();
        names.dedup();
        found.extend(names.iter().map(|name| {
            let mut fewer = self.clone();
            fewer.scans.iter_mut().for_each(|writes| {
                let _ = writes.remove(*name);
            });
            fewer
        }));
        for (scan, writes) in self.scans.iter().enumerate() {
            found.extend(writes.keys().map(|name| {
                let mut fewer = self.clone();
                fewer.scans[scan].remove(name);
                fewer
            }));
        }
        found
    }

    /// As a stimulus of a net that runs alone.
    pub fn text(&self, net: &Net) -> String {
        let mut names: Vec<String> = self.scans.iter().flat_map(BTreeMap::keys).cloned().collect();
        names.sort();
        names.dedup();
        let is_cell = |name: &String| net.inputs.iter().any(|input| input.cell && input.name == *name);
        let shown: Vec<String> = names
            .iter()
            .map(|name| if is_cell(name) { format!("{}.{name}", net.name) } else { name.clone() })
            .collect();
        let mut text = format!("k,{}\n", shown.join(","));
        for (scan, writes) in self.scans.iter().enumerate() {
            let cell = |name: &String| writes.get(name).map_or(String::new(), |value| number(*value));
            let cells: Vec<String> = names.iter().map(cell).collect();
            let _ = writeln!(text, "{scan},{}", cells.join(","));
        }
        text
    }
}

/// For each scan whether nothing changes in it: stretches of both kinds follow one another, and some have but few
/// changes between them. In the first scan all inputs get values.
fn quiet(dice: &mut Dice, scans: usize) -> Vec<bool> {
    let mut quiet = vec![false];
    let mut is_quiet = dice.once_in(2);
    while quiet.len() < scans {
        let stretch = match (is_quiet, dice.once_in(2)) {
            (true, _) => 5 + dice.below(16),
            (false, true) => 1 + dice.below(3),
            (false, false) => 10 + dice.below(21),
        };
        quiet.resize((quiet.len() + stretch).min(scans), is_quiet);
        is_quiet = !is_quiet;
    }
    quiet
}

fn number(value: Value) -> String {
    match value {
        Value::Int(int) => int.to_string(),
        Value::Real(real) if real.is_nan() => "nan".to_owned(),
        Value::Real(real) => format!("{real:?}"),
    }
}

/// One element of an input changes, or the scalar.
fn written(dice: &mut Dice, input: &Input) -> Vec<(String, Value)> {
    let name = match input.size {
        Some(size) => format!("{}[{}]", input.name, 1 + dice.below(size)),
        None => input.name.clone(),
    };
    let value = match input.first {
        Value::Int(_) => Value::Int([0, 1, 1, 2, -1][dice.below(5)]),
        Value::Real(_) => Value::Real(REALS[dice.below(REALS.len())]),
    };
    vec![(name, value)]
}

/// Commands come mostly where the mode knows them.
fn command(dice: &mut Dice, net: &Net, at: usize, mode: i32) -> i32 {
    let known = (mode == 1 && at == 1) || (mode == 2 && at > 1);
    if !dice.once_in(if known { 3 } else { 40 }) {
        return 0;
    }
    match at {
        1 => 1,
        2 => dice.below(net.gates.len()) as i32 + 1,
        _ => dice.below(net.boxes.len()) as i32 + 1,
    }
}

/// The inputs that nets have in common, and the blocks that give their values; `v` is bad while `w` is 0.1.
const SHARED: &str = "CONTROL\n1 x0 = msi ( : 0 )\n2 x1 = msi ( : 0 )\n3 x2 = msi ( : 0 )\n4 w = msc ( : 0. )\n\
                      5 v = w + 0.*w/(w - 0.1)\n6 z = setivec ( 3 : )\n7 u = setvec ( 2 : )\n8 x3 = msi ( : 0 )\n";

/// A configuration that runs nets side by side, `N0`, `N1`, .., over the same inputs. A command that is momentary is on a
/// wire in every second net, those of an operator are his cells.
pub fn configuration(nets: &[Net]) -> String {
    let mut text = SHARED.to_owned();
    for (at, net) in nets.iter().enumerate() {
        let wire = |input: &Input| match input.cell {
            true if net.mode.contains(&input.name) || at % 2 == 0 => String::new(),
            true => "x3".to_owned(),
            false => input.name.clone(),
        };
        let wires: Vec<String> = net.inputs.iter().map(wire).collect();
        let _ = writeln!(text, "{} N{at} = {} ( {} : )", at + 10, net.name, wires.join(", "));
    }
    text + "END\n"
}

/// A stimulus for such a configuration: shared inputs and the cells of each net.
pub fn shared_stimulus(dice: &mut Dice, nets: &[Net], scans: usize) -> String {
    let quiet = quiet(dice, scans);
    let cells: Vec<Stimulus> = nets.iter().map(|net| Stimulus::with_quiet(dice, net, &quiet)).collect();
    let mut columns: Vec<(String, Vec<String>)> = Vec::new();
    for name in ["x0.value", "x1.value", "x2.value", "x3.value", "z.v[1]", "z.v[2]", "z.v[3]"] {
        columns.push((name.to_owned(), sometimes(dice, &quiet, &["0", "1"])));
    }
    for name in ["w.value", "u.v[1]", "u.v[2]"] {
        let values = ["0.", "0.1", "0.4", "0.9", "2.5", "-1."];
        columns.push((name.to_owned(), sometimes(dice, &quiet, &values)));
    }
    for (at, (net, stimulus)) in nets.iter().zip(&cells).enumerate() {
        for input in net.inputs.iter().filter(|input| input.cell && (net.mode.contains(&input.name) || at % 2 == 0)) {
            let value = |writes: &BTreeMap<String, Value>| {
                writes.get(&input.name).map_or(String::new(), |value| number(*value))
            };
            columns.push((format!("N{at}.{}", input.name), stimulus.scans.iter().map(value).collect()));
        }
    }
    let names: Vec<&str> = columns.iter().map(|(name, _)| name.as_str()).collect();
    let mut text = format!("k,{}\n", names.join(","));
    for scan in 0..scans {
        let row: Vec<&str> = columns.iter().map(|(_, values)| values[scan].as_str()).collect();
        let _ = writeln!(text, "{scan},{}", row.join(","));
    }
    text
}

/// One of some values now and then, but in no quiet scan.
fn sometimes(dice: &mut Dice, quiet: &[bool], values: &[&str]) -> Vec<String> {
    let mut one = |is_quiet: &bool| match !is_quiet && dice.once_in(4) {
        true => dice.one(values).to_owned(),
        false => String::new(),
    };
    quiet.iter().map(&mut one).collect()
}
