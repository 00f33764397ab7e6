//! Nets beside a program: a code that nobody declared may be a net, in a file of its name.

use crate::project::{Loader, MAX_SOURCE, read_regular};
use pcl2_lang::ast::{Line, Name, Statement};
use pcl2_lang::catalogue::Catalogue;
use pcl2_lang::codes;
use pcl2_lang::declare::net::{self, NetFile};
use pcl2_lang::diagnostic::Diagnostic;
use pcl2_lang::source::FileId;
use pcl2_lang::syntax::Tree;
use rustc_hash::FxHashSet;
use std::path::Path;

/// Nets stand in one another at most so deep.
const MAX_DEPTH: usize = 32;

/// Whether a source is a net and no configuration.
pub(crate) fn is_net(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "net")
}

/// Whether a file has the interchange format of nets.
pub(crate) fn is_pnml(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "pnml")
}

/// Reads a net that is a program of its own, and those in it. `None`: there is nothing to compile.
pub(crate) fn tree(loader: &mut Loader, file: FileId, stem: &str, catalogue: &mut Catalogue) -> Option<Tree> {
    let read = net::read(&loader.sources, file, stem, &mut loader.symbols, &mut loader.diagnostics)?;
    add(loader, read, catalogue, &mut vec![stem.to_owned()]);
    let net = catalogue.find(stem).filter(|decl| decl.net.is_some())?;
    Some(pcl2_cfg::net_tree(net, &mut loader.symbols))
}

/// Reads the nets that the blocks of a program call, and those of composites among them.
pub(crate) fn wanted(loader: &mut Loader, tree: &Tree, catalogue: &mut Catalogue) {
    let called = |statement: &Statement| statement.formula.is_none().then_some(statement.code);
    let lines = tree.lines.iter().filter_map(|line| {
        let Line::Block(statement) = line else {
            return None;
        };
        called(statement)
    });
    let (mut codes, mut seen): (Vec<Name>, _) = (lines.collect(), FxHashSet::default());
    let mut next = 0;
    while let Some(code) = codes.get(next).copied() {
        next += 1;
        if seen.insert(code.symbol) {
            let decl = catalogue.find(loader.symbols.text(code.symbol)).filter(|decl| decl.user);
            codes.extend(decl.iter().flat_map(|decl| &decl.body).flatten().filter_map(called));
            find(loader, code, catalogue, &mut Vec::new());
        }
    }
}

/// Compiles a net after those in it. `open`: the nets around it.
fn add(loader: &mut Loader, file: NetFile, catalogue: &mut Catalogue, open: &mut Vec<String>) {
    for part in pcl2_net::wanted(&file) {
        find(loader, part, catalogue, open);
    }
    let name = file.decl.name.clone();
    let (sources, symbols, diagnostics) = (&loader.sources, &mut loader.symbols, &mut loader.diagnostics);
    match pcl2_net::compile(file, sources, symbols, catalogue, diagnostics) {
        Some(decl) => catalogue.add_net(decl, diagnostics),
        None => catalogue.spoil(&name),
    }
}

/// Looks for the net of a code, which wins over a function code of the catalogue.
fn find(loader: &mut Loader, code: Name, catalogue: &mut Catalogue, open: &mut Vec<String>) {
    let name = loader.symbols.text(code.symbol).to_owned();
    if open.contains(&name) || open.len() > MAX_DEPTH {
        let message = format!("expected a net that does not contain itself, found `{name}` inside itself");
        let report = Diagnostic::new(codes::PART, code.span, message);
        loader.diagnostics.push(report.help("nets are taken in as a whole: none can stand in itself"));
        catalogue.spoil(&name);
        return;
    }
    if catalogue.find(&name).is_some_and(|decl| decl.user) || catalogue.is_spoiled(&name) {
        return;
    }
    let folders = loader.net_folders.clone();
    let path = folders.iter().map(|folder| folder.join(format!("{name}.net"))).find(|path| path.is_file());
    let Some(path) = path else {
        return;
    };
    let shown = path.display().to_string();
    match read_regular(&path, MAX_SOURCE) {
        Ok(bytes) => {
            let file = loader.sources.add(shown, bytes);
            let read = net::read(&loader.sources, file, &name, &mut loader.symbols, &mut loader.diagnostics);
            match read {
                Some(read) => {
                    open.push(name);
                    add(loader, read, catalogue, open);
                    open.pop();
                }
                None => catalogue.spoil(&name),
            }
        }
        Err(why) => {
            let message = format!("expected a readable file, found `{shown}`: {why}");
            loader.diagnostics.push(Diagnostic::new(codes::UNREADABLE, code.span, message));
            catalogue.spoil(&name);
        }
    }
}
