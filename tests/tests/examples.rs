//! Every EXAMPLE of every declaration, in both engines.

use pcl2_lang::catalogue::Catalogue;
use pcl2_lang::decl::{Decl, Example};
use pcl2_lang::source::Sources;
use pcl2_lang::symbol::Symbols;
use pcl2_tests::table::{Table, number};
use pcl2_tests::{compilers, none, pcl2};
use std::fs;
use std::path::Path;

const SECTIONS: [&str; 3] = ["INITIALIZE", "PLANT", "CONTROL"];

fn catalogue() -> Catalogue {
    let mut diagnostics = Vec::new();
    let catalogue = Catalogue::packed(&mut Sources::default(), &mut Symbols::default(), &mut diagnostics);
    let said: Vec<&str> = diagnostics.iter().map(|diagnostic| diagnostic.message.as_str()).collect();
    assert!(said.is_empty(), "{said:?}");
    catalogue
}

#[test]
fn every_function_code_has_an_example() {
    let without: Vec<String> =
        catalogue().decls().filter(|decl| decl.examples.is_empty()).map(|decl| decl.name.clone()).collect();
    none(&without);
}

#[test]
fn the_embedded_engine_gives_the_values_of_the_examples() {
    examples("embedded");
}

#[test]
fn the_compiled_engine_gives_the_values_of_the_examples() {
    examples("cc");
}

fn examples(engine: &str) {
    let folder = compilers::folder();
    let mut complaints = Vec::new();
    for decl in catalogue().decls() {
        for example in &decl.examples {
            complaints.extend(one(decl, example, engine, folder.path()).err());
        }
    }
    none(&complaints);
}

fn one(decl: &Decl, example: &Example, engine: &str, folder: &Path) -> Result<(), String> {
    let path = folder.join("example.cfg");
    fs::write(&path, program(&example.program)).map_err(|error| error.to_string())?;
    let mut command = pcl2();
    command.arg("run").arg(&path).args(["--engine", engine, "--trace", "-", "--record", &example.signal]);
    command.args(["--steps", &example.after.to_string()]);
    if let Some(period) = &example.period {
        command.args(["--period", period]);
    }
    let trace = Table::read(&compilers::check(&mut command));
    let last = trace.rows.last().ok_or("no scan")?;
    let found: Vec<&String> = last.iter().skip(2).collect();
    let near = found.len() == example.values.len()
        && found.iter().zip(&example.values).all(|(found, written)| is_near(number(found), written));
    let values = &example.values;
    if near { Ok(()) } else { Err(format!("{} ({engine}): expected {values:?}, found {found:?}", decl.name)) }
}

/// An example may leave the sections out: then it is all CONTROL.
fn program(text: &str) -> String {
    let named = text.lines().any(|line| SECTIONS.iter().any(|word| line.trim_start().starts_with(word)));
    let start = if named { "" } else { "CONTROL\n" };
    let end = if text.lines().any(|line| line.trim() == "END") { "" } else { "END\n" };
    format!("{start}{text}\n{end}")
}

/// Half a unit of the last digit written.
fn is_near(value: f64, written: &str) -> bool {
    let (mantissa, exponent) = written.split_once(['e', 'E']).unwrap_or((written, "0"));
    let digits = mantissa.split_once('.').map_or(0, |(_, digits)| digits.len());
    let unit = 10_f64.powi(exponent.parse::<i32>().unwrap_or(0) - digits as i32);
    let exact = !written.contains(['.', 'e', 'E']);
    let expected = number(written);
    if exact { value == expected } else { (value - expected).abs() <= 0.5 * unit * (1.0 + 1e-9) }
}

#[test]
fn half_a_unit_of_the_last_digit_is_near() {
    assert!(is_near(0.0204, "0.020") && !is_near(0.0206, "0.020"));
    assert!(is_near(1250.0, "1.3e3") && !is_near(1249.0, "1.3e3"));
    assert!(is_near(7.0, "7") && !is_near(7.4, "7"));
    assert!(is_near(4.3, "4.") && !is_near(4.6, "4."));
}
