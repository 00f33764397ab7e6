//! The runtime's mathematics against tables of a multiple-precision tool: at most 1 ulp, and monotone. Floats also
//! against the doubles of the C library, all over the range.

use pcl2_tests::compilers::{check, files, folder};
use pcl2_tests::root;
use std::fs;
use std::process::Command;

fn tables(width: &str, real: &str, literal: &str) {
    let work = folder();
    let config = format!("#define PCL2_REAL_BITS {}\n#define PCL2_R(x) {literal}\n", &width[1..]);
    let config = format!("#ifndef PCL2_CONFIG_H\n#define PCL2_CONFIG_H\ntypedef {real} pcl2_real;\n{config}#endif\n");
    fs::write(work.path().join("pcl2_config.h"), config).unwrap();
    let program = work.path().join("math_ulp");
    let math = root().join("runtime-c/src/math");
    let mut compile = Command::new("gcc");
    compile.args(["-std=c99", "-O2", "-ffp-contract=off", "-I"]).arg(work.path());
    compile.arg("-I").arg(root().join("runtime-c/include")).arg("-I").arg(&math);
    compile.arg(root().join("tests/c/math_ulp.c")).args(files(&math, "c")).arg("-lm").arg("-o").arg(&program);
    check(&mut compile);

    let names = String::from_utf8(Command::new(&program).output().unwrap().stdout).unwrap();
    assert!(names.lines().count() > 10, "{names}");
    for name in names.lines() {
        let table = root().join(format!("tests/reference/math/{name}.{width}.csv"));
        assert!(fs::read_to_string(&table).unwrap().lines().count() > 100, "{} is short", table.display());
        check(Command::new(&program).arg(name).arg(&table));
    }
}

#[test]
fn doubles_are_at_most_one_ulp_from_the_truth() {
    tables("f64", "double", "x");
}

#[test]
fn floats_are_at_most_one_ulp_from_the_truth() {
    tables("f32", "float", "x##f");
}
