//! `pcl2 blocks`

use crate::args::{BlocksArgs, CommonArgs};
use crate::console;
use crate::outcome::Outcome;
use crate::project;
use pcl2_lang::catalogue::Catalogue;
use pcl2_lang::manual;
use pcl2_lang::suggest;
use std::fmt::Write;

/// Lists the catalogue, or describes one function code.
pub(crate) fn blocks(args: &BlocksArgs) -> Outcome {
    let common = CommonArgs { blocks: args.blocks.clone(), ..CommonArgs::default() };
    let Some(catalogue) = project::catalogue(&common) else {
        return Outcome::Errors;
    };
    match &args.name {
        None => console::answer(&list(&catalogue)),
        Some(name) => describe(&catalogue, name),
    }
}

fn list(catalogue: &Catalogue) -> String {
    let mut text = String::new();
    let mut group = None;
    for decl in catalogue.decls() {
        if group != Some(&decl.group) {
            let title = if decl.group.is_empty() { "your own" } else { &decl.group };
            let _ = writeln!(text, "{}{title}", if text.is_empty() { "" } else { "\n" });
            group = Some(&decl.group);
        }
        let _ = writeln!(text, "  {:10} {}", decl.name, manual::summary(decl));
    }
    text
}

fn describe(catalogue: &Catalogue, name: &str) -> Outcome {
    let Some(decl) = catalogue.find(name) else {
        let help = suggest::help(name, catalogue.decls().map(|decl| decl.name.as_str()));
        let help = help.unwrap_or_else(|| "`pcl2 blocks` lists them".to_owned());
        console::error(&format!("no function code is called `{name}`; {help}"));
        return Outcome::Usage;
    };
    console::answer(&manual::page(decl))
}
