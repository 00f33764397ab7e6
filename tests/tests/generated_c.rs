//! The generated C under every compiler.

use pcl2_tests::cases::{self, Case, Width};
use pcl2_tests::compilers::{self, Built, CORTEX_M, STRICT};
use pcl2_tests::{expect, none};
use std::process::Command;

fn all(width: Width) -> Vec<Built> {
    let builds = |case: &Case| !expect::expected(case).iter().any(|found| found.contains(" error "));
    let cases: Vec<Case> = cases::with_examples().into_iter().filter(builds).collect();
    let built = compilers::build(&cases, width);
    assert_eq!(built.iter().map(|built| built.cases.len()).sum::<usize>(), cases.len());
    built
}

fn strict(compiler: &str, width: Width) {
    for built in all(width) {
        let objects = built.compile(compiler, &STRICT);
        assert_eq!(compilers::files(objects.path(), "o").len(), built.sources().len());
        built.counts_bytes();
    }
}

#[test]
fn gcc_has_nothing_to_say_about_doubles() {
    strict("gcc", Width::F64);
}

#[test]
fn gcc_has_nothing_to_say_about_floats() {
    strict("gcc", Width::F32);
}

#[test]
fn clang_has_nothing_to_say_about_doubles() {
    strict("clang", Width::F64);
}

#[test]
fn clang_has_nothing_to_say_about_floats() {
    strict("clang", Width::F32);
}

/// The undefined symbols of the objects for a microcontroller, as `nm -A` lists them; examples are left out.
fn cortex_m(width: Width) -> Vec<String> {
    let flags: Vec<&str> = STRICT.iter().filter(|flag| **flag != "-O2").chain(&CORTEX_M).copied().collect();
    let mut symbols = Vec::new();
    for built in all(width) {
        let objects = built.compile("arm-none-eabi-gcc", &flags);
        let objects = compilers::files(objects.path(), "o");
        assert_eq!(objects.len(), built.sources().len());
        let text = compilers::check(Command::new("arm-none-eabi-nm").args(["-A", "-u"]).args(&objects));
        symbols.extend(text.lines().filter(|line| !line.contains("_example.o")).map(str::to_owned));
    }
    symbols
}

/// The generated C calls nothing of the C library but what compilers make of plain C, and the functions whose results
/// IEEE 754 fixes to the last bit.
fn calls_no_library(symbols: &[String]) {
    let memory = ["memcpy", "memset", "memmove", "memcmp"];
    let exact = ["sqrt", "floor", "ceil", "trunc"];
    let is_exact =
        |name: &str| exact.contains(&name) || name.strip_suffix('f').is_some_and(|name| exact.contains(&name));
    let cases = cases::with_examples();
    let own = |name: &str| name.contains("pcl2_") || cases.iter().any(|case| name.contains(&case.name));
    let foreign = |line: &&String| {
        let name = line.rsplit(' ').next().unwrap_or_default();
        !name.starts_with("__aeabi_") && !memory.contains(&name) && !is_exact(name) && !own(name)
    };
    let found: Vec<String> = symbols.iter().filter(foreign).cloned().collect();
    none(&found);
}

#[test]
fn a_microcontroller_takes_doubles() {
    let symbols = cortex_m(Width::F64);
    assert!(symbols.iter().any(|line| line.contains("__aeabi_d")), "no double arithmetic at all");
    calls_no_library(&symbols);
}

/// Not one instruction in double where reals are float.
#[test]
fn a_microcontroller_takes_floats_without_double_arithmetic() {
    let symbols = cortex_m(Width::F32);
    let doubles = ["__aeabi_d", "__aeabi_f2d", "__aeabi_i2d", "__aeabi_ui2d", "__aeabi_l2d", "__aeabi_ul2d"];
    let found = symbols.iter().filter(|line| doubles.iter().any(|name| line.contains(name)));
    none(&found.cloned().collect::<Vec<_>>());
    assert!(symbols.iter().any(|line| line.contains("__aeabi_f")), "no float arithmetic at all");
    calls_no_library(&symbols);
}
