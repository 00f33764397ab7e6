//! Nets as C: a scan against a table player with guard functions, code of a gate, growth.

use super::child::in_turn;
use super::compare::Times;
use super::m4;
use super::table::{Bar, Row, Table};
use super::tools::{Tools, bench_folder, compiler, output, runtime_sources, write};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

/// K-NET's reference size.
const BOXES: usize = 284;
const GATES: usize = 281;
const INPUTS: usize = 32;
const OUTPUTS: usize = 31;
/// Boxes of a loop.
const LOOP: usize = 8;
const LOOPS: usize = 35;
/// Loops whose input changes in each busy scan.
const MOVING: usize = 13;

pub(crate) fn measure(tools: &Tools, table: &mut Table) -> Result<(), String> {
    let folder = built(tools, "nets/one", 1)?;
    scans(tools, table, &folder)?;
    code(tools, table, &folder)?;
    growth(tools, table)
}

/// Loops of eight states each, a gate between two of them asks an input; two loops share a key now and then; and a lamp.
/// `copies` times the reference size.
struct Plant {
    boxes: Vec<(String, bool, Option<usize>)>,
    gates: Vec<Gate>,
}

struct Gate {
    before: Vec<usize>,
    after: Vec<usize>,
    /// An input, and whether it must be 1.
    guard: Vec<(usize, bool)>,
}

impl Plant {
    fn new(copies: usize) -> Plant {
        let mut plant = Plant { boxes: Vec::new(), gates: Vec::new() };
        for copy in 0..copies {
            plant.copy(copy);
        }
        plant
    }

    fn copy(&mut self, copy: usize) {
        let first = self.boxes.len();
        for l in 0..LOOPS {
            for s in 0..LOOP {
                // Every fifth state drives an output, as do the first states of some loops.
                let output = (s % 5 == 1).then_some((l + copy) % (OUTPUTS - 1));
                self.boxes.push((format!("s{copy}_{l}_{s}"), s == 0, output));
            }
        }
        let extra = self.boxes.len();
        self.boxes.push((format!("key{copy}_0"), true, None));
        self.boxes.push((format!("key{copy}_1"), true, None));
        self.boxes.push((format!("dark{copy}"), true, None));
        self.boxes.push((format!("lit{copy}"), false, Some(OUTPUTS - 1)));
        for l in 0..LOOPS {
            for s in 0..LOOP {
                self.gates.push(gate(first, extra, l, s));
            }
        }
        let lamp = Gate { before: vec![extra + 2], after: vec![extra + 3], guard: vec![(30, true), (31, true)] };
        self.gates.push(lamp);
    }

    /// The net.
    fn text(&self) -> String {
        let list = |names: &[String]| names.join(", ");
        let outputs: Vec<String> = (0..OUTPUTS).map(|i| format!("int y{i}")).collect();
        let inputs: Vec<String> = (0..INPUTS).map(|i| format!("int x{i}")).collect();
        let mut text = format!("{} = plant ( {} : )\n", list(&outputs), list(&inputs));
        for (name, marked, output) in &self.boxes {
            let marked = if *marked { " MARKED" } else { "" };
            let drives = output.map(|output| format!(" DRIVES y{output}")).unwrap_or_default();
            let _ = writeln!(text, "STATE {name}{marked}{drives}");
        }
        let names = |boxes: &[usize]| list(&boxes.iter().map(|i| self.boxes[*i].0.clone()).collect::<Vec<_>>());
        for (i, gate) in self.gates.iter().enumerate() {
            let guard: Vec<String> =
                gate.guard.iter().map(|(x, one)| format!("{}x{x}", if *one { "" } else { "NOT " })).collect();
            let guard = if guard.is_empty() { String::new() } else { format!(" IF {}", guard.join(" AND ")) };
            let _ = writeln!(text, "GATE g{i} : {} -> {}{guard}", names(&gate.before), names(&gate.after));
        }
        text + "END\n"
    }

    /// The same as the table of the peer.
    fn peer(&self) -> String {
        let mut text = format!(
            "#define INPUTS {INPUTS}\n#define OUTPUTS {OUTPUTS}\n#define MOVING {MOVING}\n\
             static const uint8_t peer_tokens[{}] = {{",
            self.boxes.len()
        );
        text.extend(self.boxes.iter().map(|(_, marked, _)| format!("{}, ", u8::from(*marked))));
        text.push_str("};\n");
        for (i, gate) in self.gates.iter().enumerate().filter(|(_, gate)| !gate.guard.is_empty()) {
            let tests: Vec<String> =
                gate.guard.iter().map(|(x, one)| format!("inputs[{x}] {} 0", if *one { "!=" } else { "==" })).collect();
            let _ =
                writeln!(text, "static int32_t guard{i}(const int32_t *inputs) {{ return {}; }}", tests.join(" && "));
        }
        text.push_str("static const struct net_gate peer_gates[] = {\n");
        let three = |boxes: &[usize]| {
            let place = |i: usize| boxes.get(i).map_or("-1".to_owned(), usize::to_string);
            format!("{{{}, {}, {}}}", place(0), place(1), place(2))
        };
        for (i, gate) in self.gates.iter().enumerate() {
            let guard = if gate.guard.is_empty() { "NULL".to_owned() } else { format!("guard{i}") };
            let _ = writeln!(text, "    {{{guard}, {}, {}}},", three(&gate.before), three(&gate.after));
        }
        text.push_str("};\nstatic const struct net_level peer_levels[] = {\n");
        let levels = self.boxes.iter().enumerate().filter_map(|(i, (_, _, output))| Some((i, (*output)?)));
        let mut count = 0;
        for (place, output) in levels {
            let _ = writeln!(text, "    {{{output}, {place}}},");
            count += 1;
        }
        let _ = writeln!(
            text,
            "}};\nstatic const struct net_table peer_table = {{peer_gates, peer_levels, {}, {}, {count}, {OUTPUTS}}};",
            self.boxes.len(),
            self.gates.len()
        );
        text
    }
}

fn gate(first: usize, extra: usize, l: usize, s: usize) -> Gate {
    let state = |s: usize| first + l * LOOP + s % LOOP;
    let (mut before, mut after) = (vec![state(s)], vec![state(s + 1)]);
    // Two pairs of loops share a key from their third state to their sixth.
    if !(MOVING..MOVING + 4).contains(&l) {
        return Gate { before, after, guard: vec![(l % INPUTS, s % 2 == 0)] };
    }
    let key = extra + (l - MOVING) / 2;
    if s == 2 {
        before.push(key);
    }
    if s == 5 {
        after.push(key);
    }
    Gate { before, after, guard: vec![(l % INPUTS, s % 2 == 0)] }
}

fn built(tools: &Tools, name: &str, copies: usize) -> Result<PathBuf, String> {
    let folder = tools.folder(name)?;
    let plant = Plant::new(copies);
    if copies == 1 && (plant.boxes.len(), plant.gates.len()) != (BOXES, GATES) {
        return Err(format!("the net has {} boxes and {} gates", plant.boxes.len(), plant.gates.len()));
    }
    write(&folder.join("plant.net"), &plant.text())?;
    write(&folder.join("peer.h"), &plant.peer())?;
    output(&mut tools.build(&folder.join("plant.net"), &folder.join("out"), &[]))?;
    Ok(folder)
}

fn scans(tools: &Tools, table: &mut Table, folder: &Path) -> Result<(), String> {
    let (bench, out) = (bench_folder(), folder.join("out"));
    let program = folder.join("scan");
    let mut command = compiler("gcc", &["-O2"], &out)?;
    command.arg("-I").arg(&bench).arg("-I").arg(folder).arg("-o").arg(&program);
    command.args(["c/nets.c", "c/compare.c", "hand/net_table.c"].map(|file| bench.join(file)));
    output(
        command.args(["plant.c", "plant_map.c"].map(|file| out.join(file))).args(runtime_sources(&out)?).arg("-lm"),
    )?;
    let times = Times::of(Command::new(program).arg(tools.rounds(2001).to_string()))?;
    let fired = times.median("fired");
    let size = format!("{BOXES} boxes, {GATES} gates");
    table.add(Row::value(format!("{size}: an idle scan"), times.median("idle"), "ns").bar(Bar::AtMost(5.0)));
    let peer = "peer: table player with guard functions";
    let row = times.row(format!("{size}: an idle scan, {peer}"), "idle", "peer_idle");
    table.add(row.bar(Bar::Ratio(1.0 / 20.0)));
    table.add(times.row(format!("{size}: a scan with {fired:.1} firings, {peer}"), "busy", "peer_busy"));
    let each = times.difference("busy", "idle") / fired;
    table.add(Row::value(format!("{size}: a firing, over an idle scan"), each, "ns").bar(Bar::AtMost(2.0)));
    Ok(())
}

/// Bytes of code and constants for a gate, on the host and on a Cortex-M4, in both forms.
fn code(tools: &Tools, table: &mut Table, folder: &Path) -> Result<(), String> {
    let source = folder.join("plant.net");
    for form in ["fast", "table"] {
        let out = folder.join(form);
        output(&mut tools.build(&source, &out, &["--net-form", form]))?;
        let object = out.join("host.o");
        output(compiler("gcc", &["-O2", "-c"], &out)?.arg("-o").arg(&object).arg(out.join("plant.c")))?;
        let host = m4::code(Command::new("size").arg("-A").arg(&object))?;
        let row = Row::value(format!("code of a gate, host -O2, {form}"), host / GATES as f64, "B");
        table.add(if form == "fast" { row.bar(Bar::AtMost(100.0)) } else { row });
        let out = folder.join(format!("{form}-f32"));
        output(&mut tools.build(&source, &out, &["--net-form", form, "--real", "f32"]))?;
        let object = m4::object(&out, &out.join("plant.c"))?;
        let small = m4::code(Command::new("arm-none-eabi-size").arg("-A").arg(&object))?;
        table.add(Row::value(format!("code of a gate, Cortex-M4 -Os, {form}"), small / GATES as f64, "B"));
    }
    Ok(())
}

/// The C compiler's time on twice the net.
fn growth(tools: &Tools, table: &mut Table) -> Result<(), String> {
    let mut commands = Vec::new();
    for copies in [1, 2, 4] {
        let out = built(tools, &format!("nets/grown{copies}"), copies)?.join("out");
        let mut command = compiler("gcc", &["-O2", "-c"], &out)?;
        command.arg("-o").arg(out.join("plant.o")).arg(out.join("plant.c"));
        commands.push(command);
    }
    let used = in_turn(tools.rounds(7), &mut commands)?;
    for (copies, pair) in [2, 4].into_iter().zip(used.windows(2)) {
        let what = format!("gcc -O2 on {copies} times the net, peer: half of it");
        let row = Row::value(what, pair[1].seconds, "s");
        table.add(row.peer(pair[0].seconds, pair[1].seconds / pair[0].seconds).bar(Bar::Ratio(2.2)));
    }
    Ok(())
}
