//! The manual: made from the declarations, and fresh.

use pcl2_lang::catalogue::Catalogue;
use pcl2_lang::manual;
use pcl2_lang::source::Sources;
use pcl2_lang::symbol::Symbols;
use pcl2_tests::{pcl2, root, run};
use std::fs;

fn catalogue() -> Catalogue {
    Catalogue::packed(&mut Sources::default(), &mut Symbols::default(), &mut Vec::new())
}

#[test]
fn the_page_is_fresh() {
    let page = fs::read_to_string(root().join("docs/blocks.md")).unwrap();
    assert!(page == manual::document(&catalogue()), "docs/blocks.md is old: run `cargo xtask docs`");
}

#[test]
fn the_terminal_shows_every_code() {
    let listed = run(pcl2().arg("blocks"));
    let listed = String::from_utf8(listed.stdout).unwrap();
    for decl in catalogue().decls() {
        let page = manual::page(decl);
        assert!(page.starts_with(&manual::signature(decl)), "{page}");
        assert!(page.contains("\nOutputs\n") && page.contains("\nRules\n"), "{page}");
        assert!(listed.contains(&format!("\n  {:10} {}\n", decl.name, manual::summary(decl))), "{}", decl.name);
        assert!(manual::summary(decl).len() > 10, "{}", decl.name);
    }
    let shown = run(pcl2().args(["blocks", "first"]));
    assert_eq!(String::from_utf8(shown.stdout).unwrap(), manual::page(catalogue().find("first").unwrap()));
}
