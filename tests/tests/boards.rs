//! The same bits on a microcontroller: golden cases on emulated boards.

use pcl2_tests::cases::{self, Width};
use pcl2_tests::none;
use pcl2_tests::table::same_text;

/// Cases that between them use every kind of kernel and every function of the mathematics.
const CASES: [&str; 7] =
    ["flc_surface", "first_lags", "gpc_adaptive", "matrix_reals", "nn_train", "rls_self_tuning", "tf_plants"];

fn same_on(board: &str, width: Width) {
    let differs = |name: &&str| {
        let case = cases::find(name);
        let same = case.trace(case.run("embedded", width)).and_then(|here| {
            let there = case.trace(case.run_on(board, width))?;
            same_text(&format!("{name}: here and on {board}"), &here, &there)
        });
        same.err()
    };
    none(&CASES.iter().filter_map(differs).collect::<Vec<_>>());
}

#[test]
fn doubles_are_the_same_on_a_cortex_m4() {
    same_on("cortex-m4", Width::F64);
}

#[test]
fn floats_are_the_same_on_a_cortex_m4() {
    same_on("cortex-m4", Width::F32);
}

#[test]
fn floats_are_the_same_without_a_floating_point_unit() {
    same_on("cortex-m3", Width::F32);
}

#[test]
fn doubles_are_the_same_with_a_double_unit() {
    same_on("cortex-m7", Width::F64);
}
