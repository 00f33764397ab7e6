//! `docs/blocks.md`, made from the declarations.

use crate::shell::{root, say};
use pcl2_lang::catalogue::Catalogue;
use pcl2_lang::manual;
use pcl2_lang::source::Sources;
use pcl2_lang::symbol::Symbols;
use std::fs;

/// Writes the page.
pub(crate) fn docs() -> Result<(), String> {
    let mut diagnostics = Vec::new();
    let catalogue = Catalogue::packed(&mut Sources::default(), &mut Symbols::default(), &mut diagnostics);
    if let Some(first) = diagnostics.first() {
        return Err(format!("a declaration has a mistake: {}", first.message));
    }
    let path = root().join("docs/blocks.md");
    fs::write(&path, manual::document(&catalogue)).map_err(|error| format!("{}: {error}", path.display()))?;
    say(&format!("wrote {}", path.display()));
    Ok(())
}
