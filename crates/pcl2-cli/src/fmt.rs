//! `pcl2 fmt`

use crate::args::{CommonArgs, FmtArgs};
use crate::console;
use crate::nets::is_net;
use crate::outcome::Outcome;
use crate::output;
use crate::project::{self, Draft};
use pcl2_lang::diagnostic::Diagnostic;
use pcl2_lang::format::{format, format_net};
use pcl2_lang::source::{FileId, MARK, Sources};
use std::path::Path;

/// Writes sources in their canonical layout.
pub(crate) fn fmt(args: &FmtArgs) -> Outcome {
    args.paths.iter().map(|path| one(path, args)).max().unwrap_or(Outcome::Done)
}

fn one(path: &Path, args: &FmtArgs) -> Outcome {
    let common = CommonArgs { blocks: args.blocks.clone(), ..CommonArgs::default() };
    let draft = project::load_draft(path, &common, args.renumber);
    let failed = draft.diagnostics.iter().any(Diagnostic::is_error);
    let Some((path, file)) = draft.source.as_ref().filter(|_| !failed) else {
        console::diagnostics(&draft.diagnostics, &draft.sources, draft.left_out);
        return Outcome::Errors;
    };
    let shown = path.display();
    let laid_out = if is_net(path) { format_net(draft.sources.file(*file)) } else { formatted(&draft, *file) };
    let Some(text) = laid_out else {
        console::error(&format!("`{shown}` is left as it is: its lines do not read the same in another layout"));
        return Outcome::Errors;
    };
    let source = draft.sources.file(*file);
    if source.bytes() == text {
        return Outcome::Done;
    }
    if args.check {
        console::err(&format!("{shown} would change"));
        return Outcome::Errors;
    }
    let bytes = if source.marked { [MARK, &text].concat() } else { text };
    match output::rewrite_file(path, &bytes) {
        Ok(()) => Outcome::Done,
        Err(error) => {
            console::error(&format!("cannot write `{shown}`: {error}"));
            Outcome::Failed
        }
    }
}

/// The source with its new numbers, in its new layout.
fn formatted(draft: &Draft, file: FileId) -> Option<Vec<u8>> {
    let source = draft.sources.file(file);
    if draft.edits.is_empty() {
        return format(source);
    }
    let mut sources = Sources::default();
    let renumbered = sources.add(source.name.clone(), pcl2_cfg::edited(source.bytes(), &draft.edits));
    format(sources.file(renumbered))
}
