//! What every function code promises for special values, by the letter of its declaration.

use pcl2_lang::catalogue::Catalogue;
use pcl2_lang::decl::{BadRule, Decl};
use pcl2_lang::source::Sources;
use pcl2_lang::symbol::Symbols;
use pcl2_lang::types::Scalar;
use pcl2_tests::special::{Bench, Probe, SCANS, Timeline};
use pcl2_tests::table::{Table, number, same_text};
use pcl2_tests::{compilers, none, pcl2, run};
use std::fs;
use std::path::{Path, PathBuf};

/// A special real in double and in float, with the special int of the same run.
const SPECIAL: [(&str, &str, i32); 15] = [
    ("nan", "nan", 0),
    ("inf", "inf", 1),
    ("-inf", "-inf", -1),
    ("0.0", "0.0", i32::MIN),
    ("-0.0", "-0.0", i32::MAX),
    ("5e-324", "1e-45", 2),
    ("-5e-324", "-1e-45", 3),
    ("2.225073858507201e-308", "1.1754942e-38", 7),
    ("2.2250738585072014e-308", "1.1754944e-38", -7),
    ("-2.2250738585072014e-308", "-1.1754944e-38", 33),
    ("1.0", "1.0", 64),
    ("-1.0", "-1.0", 1000),
    ("1.7976931348623157e308", "3.4028235e38", 65536),
    ("-1.7976931348623157e308", "-3.4028235e38", -65536),
    ("1e18", "1e18", 1_000_000_007),
];

fn catalogue() -> Vec<Decl> {
    Catalogue::packed(&mut Sources::default(), &mut Symbols::default(), &mut Vec::new()).decls().cloned().collect()
}

/// The programs that run the bench: the embedded engine, gcc, gcc with sanitizers. A compiler is asked once.
fn engines(folder: &Path) -> Vec<(&'static str, Option<PathBuf>)> {
    let flags = [("gcc", ""), ("sanitizers", "-fsanitize=address,undefined -fno-sanitize-recover=all")];
    let mut engines = vec![("embedded", None)];
    for (name, flags) in flags {
        let (script, kept) = (folder.join(format!("{name}.sh")), folder.join(format!("{name}.bin")));
        let text = format!(
            "for last do out=$next; next=$last; case $out in -o) file=$last;; esac; done\n\
             [ -f {kept} ] || gcc {flags} \"$@\" -O1 && {{ [ -f {kept} ] || cp \"$file\" {kept}; }} && cp {kept} \"$file\"\n",
            kept = kept.display()
        );
        fs::write(&script, text).unwrap();
        engines.push((name, Some(script)));
    }
    engines
}

struct Runs {
    folder: tempfile::TempDir,
    bench: Bench,
    real: &'static str,
}

impl Runs {
    fn new(real: &'static str, decls: &[Decl]) -> Runs {
        let folder = compilers::folder();
        let bench = Bench::new(decls.iter());
        fs::write(folder.path().join("main.cfg"), bench.program()).unwrap();
        Runs { folder, bench, real }
    }

    fn run(&self, special: (&str, &str, i32), compiler: Option<&Path>) -> (String, String) {
        let value = if self.real == "f64" { special.0 } else { special.1 };
        let stimulus = self.folder.path().join("stimulus.csv");
        fs::write(&stimulus, self.bench.stimulus(value, special.2)).unwrap();
        let mut command = pcl2();
        command.arg("run").arg(self.folder.path().join("main.cfg")).args(["--period", "0.1", "--real", self.real]);
        command.args(["--steps", &SCANS.to_string(), "--trace", "-", "--stimulus"]).arg(&stimulus);
        let names = self.bench.probes.iter().map(|probe| probe.tag.clone()).chain(self.bench.memory.iter().cloned());
        command.args(["--record", &names.collect::<Vec<_>>().join(",")]).env("ASAN_OPTIONS", "detect_leaks=0");
        if let Some(script) = compiler {
            command.args(["--engine", "cc"]).env("CC", format!("sh {}", script.display()));
        }
        let output = run(&mut command);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{special:?}: {}", said.lines().rev().take(30).collect::<Vec<_>>().join("\n"));
        (String::from_utf8_lossy(&output.stdout).into_owned(), said)
    }
}

fn promises_hold(real: &'static str) {
    let decls = catalogue();
    let runs = Runs::new(real, &decls);
    let engines = engines(runs.folder.path());
    let mut complaints = Vec::new();
    for special in SPECIAL {
        let (text, said) = runs.run(special, None);
        for (name, compiler) in &engines[1..] {
            let (other, other_said) = runs.run(special, compiler.as_deref());
            complaints.extend(same_text(&format!("{special:?}: embedded and {name}"), &text, &other).err());
            complaints.extend(same_text(&format!("{special:?}: faults, {name}"), &said, &other_said).err());
        }
        let trace = Table::read(&text);
        let judge = Judge { trace: &trace, bench: &runs.bench, decls: &decls, special: special.0 };
        complaints.extend(judge.complaints());
    }
    complaints.truncate(60);
    none(&complaints);
}

#[test]
fn every_code_keeps_its_promise_in_double() {
    promises_hold("f64");
}

#[test]
fn every_code_keeps_its_promise_in_float() {
    promises_hold("f32");
}

#[test]
fn every_code_with_an_input_is_on_the_bench() {
    let decls = catalogue();
    let bench = Bench::new(decls.iter());
    let missing = |decl: &&Decl| !decl.is_composite() && !bench.probes.iter().any(|probe| probe.code == decl.name);
    let without_ports = |decl: &&Decl| decl.ports().next().is_some();
    none(&decls.iter().filter(missing).filter(without_ports).map(|decl| decl.name.clone()).collect::<Vec<_>>());
}

#[test]
fn every_code_has_a_letter() {
    none(
        &catalogue()
            .iter()
            .filter(|decl| decl.bad.is_none() && decl.ports().next().is_some())
            .map(|decl| decl.name.clone())
            .collect::<Vec<_>>(),
    );
}

struct Judge<'a> {
    trace: &'a Table,
    bench: &'a Bench,
    decls: &'a [Decl],
    special: &'a str,
}

impl Judge<'_> {
    fn complaints(&self) -> Vec<String> {
        let mut complaints = Vec::new();
        let mut clean: &Probe = &self.bench.probes[0];
        for probe in &self.bench.probes {
            if probe.port.is_none() {
                clean = probe;
            } else if let Some(decl) = self.decls.iter().find(|decl| decl.name == probe.code) {
                self.judge(decl, probe, clean, &mut complaints);
            }
        }
        complaints
    }

    fn judge(&self, decl: &Decl, probe: &Probe, clean: &Probe, complaints: &mut Vec<String>) {
        let Some((port, ty)) = &probe.port else {
            return;
        };
        let bad = matches!(self.special, "nan" | "inf" | "-inf") && ty.scalar == Scalar::Real;
        for (column, name) in self.trace.header.iter().enumerate() {
            let Some(rest) =
                name.strip_prefix(&probe.tag).filter(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
            else {
                continue;
            };
            let reference = self.trace.column(&format!("{}{rest}", clean.tag));
            let reference = reference.map(|index| self.column(index)).unwrap_or_default();
            let values = self.column(column);
            let is_memory =
                self.bench.memory.iter().any(|memory| name == memory || name.starts_with(&format!("{memory}[")));
            let mut complain = |scan: usize, what: &str| {
                complaints.push(format!(
                    "{} ({:?}), {port} = {} ({:?}): {name} at scan {scan} is {}, {what}",
                    decl.name, decl.bad, self.special, probe.timeline, values[scan]
                ));
            };
            let last = SCANS - 1;
            if !values[last].is_finite() && reference.get(last).is_none_or(|clean| clean.is_finite()) {
                complain(last, "long after the special value: poisoned");
            }
            if is_memory || !bad {
                continue;
            }
            for scan in (0..SCANS).filter(|scan| probe.timeline.special(*scan)) {
                let before = if scan == 0 { None } else { values.get(scan - 1) };
                let same_as_clean = same(values[scan], reference[scan]);
                let held = before.is_none_or(|before| same(values[scan], *before));
                match decl.bad {
                    Some(BadRule::Hold | BadRule::Manual | BadRule::Freeze | BadRule::Select | BadRule::Output)
                        if !values[scan].is_finite() && reference[scan].is_finite() =>
                    {
                        complain(scan, "not finite");
                    }
                    Some(BadRule::Hold) if probe.timeline == Timeline::Running && !held && !same_as_clean => {
                        complain(scan, "not held");
                    }
                    Some(BadRule::Algebraic)
                        if self.special == "nan"
                            && values[scan].is_finite()
                            && !same_as_clean
                            && is_real_output(decl, rest) =>
                    {
                        complain(scan, "good from a bad input");
                    }
                    _ => {}
                }
            }
        }
    }

    fn column(&self, index: usize) -> Vec<f64> {
        self.trace.rows.iter().map(|row| number(&row[index])).collect()
    }
}

fn same(a: f64, b: f64) -> bool {
    a == b || (a.is_nan() && b.is_nan())
}

/// Whether the column is a real output of the code; what is handed back says itself whether it is good.
fn is_real_output(decl: &Decl, rest: &str) -> bool {
    let name = rest.trim_start_matches('.').split('[').next().unwrap_or("");
    let name = name.trim_end_matches(|digit: char| digit.is_ascii_digit());
    let output = decl
        .outputs
        .iter()
        .find(|output| !name.is_empty() && output.name.trim_end_matches(|digit: char| digit.is_ascii_digit()) == name);
    let output = output.or(decl.outputs.first().filter(|_| name.is_empty()));
    output.is_some_and(|output| pcl2_lang::kernel::c_element(&output.ty) == "pcl2_real" && output.name != "bk")
}
