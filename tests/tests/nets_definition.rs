//! Random nets of buffers against the definition of a scan, written down here once more, and the state equation.

use pcl2_tests::dice::Dice;
use pcl2_tests::nets::{column, read, run_in};
use std::fmt::Write;
use std::fs;

/// A net of buffers: what a scan does is written down here once more, from the definition.
struct Plain {
    capacity: Vec<i64>,
    start: Vec<i64>,
    gates: Vec<PlainGate>,
}

struct PlainGate {
    takes: Vec<(usize, i64)>,
    puts: Vec<(usize, i64)>,
    reads: Vec<(usize, i64)>,
    inhibits: Vec<(usize, i64)>,
    priority: i64,
    input: Option<usize>,
}

const INPUTS: usize = 4;

impl Plain {
    fn random(dice: &mut Dice) -> Plain {
        let places = 2 + dice.roll(6) as usize;
        let capacity: Vec<i64> = (0..places).map(|_| 1 + dice.roll(4) as i64).collect();
        let start = capacity.iter().map(|most| dice.roll(*most as u64 + 1) as i64).collect();
        let arcs = |dice: &mut Dice, most: u64| {
            let mut arcs: Vec<(usize, i64)> = Vec::new();
            for _ in 0..dice.roll(most) {
                let place = dice.roll(places as u64) as usize;
                if arcs.iter().all(|(known, _)| *known != place) {
                    let weight = 1 + dice.roll(2).min(capacity[place] as u64 - 1) as i64;
                    arcs.push((place, weight));
                }
            }
            arcs
        };
        let gates = (0..1 + dice.roll(8)).map(|_| PlainGate {
            takes: arcs(dice, 3),
            puts: arcs(dice, 3),
            reads: arcs(dice, 2),
            inhibits: arcs(dice, 2),
            priority: dice.roll(3) as i64,
            input: (dice.roll(2) == 0).then(|| dice.roll(INPUTS as u64) as usize),
        });
        let gates: Vec<PlainGate> = gates.collect();
        Plain { capacity, start, gates }
    }

    fn text(&self) -> String {
        // Each gate counts its firings.
        let counts: Vec<String> = (0..self.gates.len()).map(|i| format!("int f{i}")).collect();
        let mut text = format!("{} = plain ( int x0, int x1, int x2, int x3 : )\n", counts.join(", "));
        for (i, (capacity, start)) in self.capacity.iter().zip(&self.start).enumerate() {
            let marked = if *start > 0 { format!(" MARKED {start}") } else { String::new() };
            let _ = writeln!(text, "CAPACITY p{i} SIZE {capacity}{marked}");
        }
        let list = |arcs: &[(usize, i64)]| {
            arcs.iter().map(|(place, weight)| format!("{weight}*p{place}")).collect::<Vec<_>>().join(", ")
        };
        for (i, gate) in self.gates.iter().enumerate() {
            let _ = write!(text, "GATE t{i} : {} -> {}", list(&gate.takes), list(&gate.puts));
            for (word, arcs) in [("READ", &gate.reads), ("INHIBIT", &gate.inhibits)] {
                if !arcs.is_empty() {
                    let _ = write!(text, " {word} {}", list(arcs));
                }
            }
            let _ = write!(text, " PRIORITY {}", gate.priority);
            match gate.input {
                Some(input) => drop(writeln!(text, " IF x{input}")),
                None => text.push('\n'),
            }
            let _ = writeln!(text, "DO f{i} = f{i} + 1");
        }
        text + "END\n"
    }

    /// The state equation: the marking at the start, and the firings times what each brings.
    fn after(&self, firings: &[i64]) -> Vec<i64> {
        let mut marking = self.start.clone();
        for (gate, times) in self.gates.iter().zip(firings) {
            gate.puts.iter().for_each(|(place, weight)| marking[*place] += weight * times);
            gate.takes.iter().for_each(|(place, weight)| marking[*place] -= weight * times);
        }
        marking
    }

    /// One scan from the definition: gates by priority, then in order; what was there at the start and is not taken.
    fn step(&self, start: &[i64], inputs: &[bool; INPUTS]) -> Vec<i64> {
        let mut order: Vec<usize> = (0..self.gates.len()).collect();
        order.sort_by_key(|i| -self.gates[*i].priority);
        let (mut taken, mut room, mut after) = (vec![0; start.len()], vec![0; start.len()], start.to_vec());
        for gate in order.into_iter().map(|i| &self.gates[i]) {
            let taken_by = |place: usize| gate.takes.iter().find(|(known, _)| *known == place).map_or(0, |(_, w)| *w);
            let fits = |(place, weight): &(usize, i64)| {
                let more = weight - taken_by(*place);
                more <= 0 || start[*place] + room[*place] + more <= self.capacity[*place]
            };
            let enabled = gate.takes.iter().all(|(place, weight)| start[*place] - taken[*place] >= *weight)
                && gate.reads.iter().all(|(place, weight)| start[*place] >= *weight)
                && gate.inhibits.iter().all(|(place, weight)| start[*place] < *weight)
                && gate.input.is_none_or(|input| inputs[input])
                && gate.puts.iter().all(fits);
            if !enabled {
                continue;
            }
            for (place, weight) in &gate.puts {
                room[*place] += (weight - taken_by(*place)).max(0);
                after[*place] += weight;
            }
            for (place, weight) in &gate.takes {
                taken[*place] += weight;
                after[*place] -= weight;
            }
        }
        after
    }
}

/// Random nets with weights, capacities, read and inhibitor arcs, priorities and inputs, against the definition and the
/// state equation.
#[test]
fn random_nets_do_what_the_definition_says() {
    let mut dice = Dice(20_261_129);
    let scans = 60;
    let mut moved = 0;
    for number in 0..250 {
        let net = Plain::random(&mut dice);
        let inputs: Vec<[bool; INPUTS]> = (0..scans).map(|_| std::array::from_fn(|_| dice.roll(2) == 0)).collect();
        let mut stimulus = "k,x0,x1,x2,x3\n".to_owned();
        for (k, row) in inputs.iter().enumerate() {
            let row: Vec<String> = row.iter().map(|x| u8::from(*x).to_string()).collect();
            let _ = writeln!(stimulus, "{k},{}", row.join(","));
        }
        let text = net.text();
        let folder = tempfile::tempdir().unwrap();
        let (path, values) = (folder.path().join("plain.net"), folder.path().join("stimulus.csv"));
        fs::write(&path, &text).unwrap();
        fs::write(&values, stimulus).unwrap();
        let args = ["--steps", &scans.to_string(), "--stimulus", values.to_str().unwrap()];
        let trace = read(&run_in(&path, &args, &[]));
        let mut marking = net.start.clone();
        for (scan, row) in inputs.iter().enumerate() {
            let next = net.step(&marking, row);
            moved += usize::from(next != marking);
            marking = next;
            let firings = (0..net.gates.len()).map(|i| column(&trace, &format!("f{i}"))[scan] as i64);
            assert_eq!(net.after(&firings.collect::<Vec<i64>>()), marking, "net {number}, scan {scan}: B f\n{text}");
            for (place, tokens) in marking.iter().enumerate() {
                let found = column(&trace, &format!("plain.p{place}"))[scan];
                assert!(
                    (found - *tokens as f64).abs() < 0.5,
                    "net {number}, scan {scan}, p{place}: {found}, not {tokens}\n{text}"
                );
            }
        }
    }
    assert!(moved > 500, "only {moved} scans moved a token");
}
