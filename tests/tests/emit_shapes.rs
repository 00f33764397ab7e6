//! What the generated C does, seen from its user's side.

use pcl2_tests::cases::{self, Width};
use pcl2_tests::compilers::{alone, check};
use pcl2_tests::root;
use std::process::Command;

/// Exit status: the line of the check that failed.
#[test]
fn every_shape_does_what_the_source_says() {
    for width in Width::ALL {
        let built = alone(&cases::find("emit_shapes"), width);
        let program = built.path().join("emit_shapes");
        let flags = ["-std=c99", "-O1", "-ffp-contract=off", "-Wall", "-fsanitize=address,undefined"];
        built.link(&root().join("tests/c/emit_shapes.c"), &flags, &program);
        check(&mut Command::new(&program));
    }
}
