//! Pass 8: controllers that drive another block which can hand back what it follows, and do not listen.

use crate::draft::{Draft, Scope};
use pcl2_lang::codes;
use pcl2_lang::decl::{BadRule, Decl, RETURN_OUTPUT, RETURN_PORT};
use pcl2_lang::diagnostic::{self, Diagnostic};
use pcl2_lang::kernel;
use pcl2_lang::program::{BlockId, Source};

/// Warns of each link whose driver has an open return port.
pub(crate) fn missing(scope: &Scope<'_>, diagnostics: &mut Vec<Diagnostic>) {
    for follower in &scope.drafts {
        let Some((decl, first, count)) = answered(follower) else {
            continue;
        };
        if !judges(follower, decl) {
            continue;
        }
        for link in 0..count {
            let Some(Source::Signal(signal)) = follower.sources.get(first + link) else {
                continue;
            };
            for writer in &scope.wire(*signal).writers {
                if is_deaf(&scope.drafts[writer.block.0 as usize], writer.output) {
                    warn(scope, follower, decl, writer.block, (first, link, count), diagnostics);
                }
            }
        }
    }
}

/// The ports that a block's return wires answer: the first, and how many.
fn answered<'a>(draft: &Draft<'a>) -> Option<(&'a Decl, usize, usize)> {
    let decl = draft.decl?;
    let port = decl.returns?;
    let sizes = draft.known_sizes()?;
    let counts: Vec<usize> =
        decl.ports().map(|port| kernel::count(port.group.as_ref(), &sizes)).collect::<Option<_>>()?;
    Some((decl, counts[..port].iter().sum(), counts[port]))
}

/// Whether following is more than passing on: a controller or a selector decides, and so does what waits downstream.
fn judges(draft: &Draft<'_>, decl: &Decl) -> bool {
    matches!(decl.bad, Some(BadRule::Manual | BadRule::Select)) || return_source(draft, 0).is_some_and(is_wired)
}

/// Whether a block has a return port for this output, and nothing is wired to it.
fn is_deaf(draft: &Draft<'_>, output: u32) -> bool {
    return_source(draft, output).is_some_and(|source| !is_wired(source))
}

fn is_wired(source: &Source) -> bool {
    !matches!(source, Source::Constant(_))
}

/// What is wired to the return port of an output: `back`, or `back1`, `back2`, .. of a block that drives several.
fn return_source<'d>(draft: &'d Draft<'_>, output: u32) -> Option<&'d Source> {
    let decl = draft.decl?;
    let sizes = draft.known_sizes()?;
    let own = format!("{RETURN_PORT}{}", output + 1);
    let index = decl.ports().position(|port| (output == 0 && port.name == RETURN_PORT) || port.name == own)?;
    let before: Option<usize> = decl.ports().take(index).map(|port| kernel::count(port.group.as_ref(), &sizes)).sum();
    draft.sources.get(before?)
}

fn warn(
    scope: &Scope<'_>,
    follower: &Draft<'_>,
    decl: &Decl,
    driver: BlockId,
    (first, link, count): (usize, usize, usize),
    diagnostics: &mut Vec<Diagnostic>,
) {
    let driving = &scope.drafts[driver.0 as usize];
    let place =
        follower.operands.get(first + link).copied().flatten().map_or(follower.statement.span, |item| item.span);
    let wire = if count > 1 { format!("{RETURN_OUTPUT}{}", link + 1) } else { RETURN_OUTPUT.to_owned() };
    let tag = follower.outputs.first().map(|id| scope.wire(*id).name.as_str()).unwrap_or_default();
    let message = format!(
        "expected {} to hear whether {} ({}) follows it, found its `{RETURN_PORT}` open",
        driving.title(),
        follower.title(),
        decl.name
    );
    let report = Diagnostic::new(codes::MISSING_RETURN, place, message)
        .label(driving.statement.code.span, format!("wire `{RETURN_PORT} = {tag}.{wire}` here"))
        .help("without the return wire the driving block winds up while it is not followed, and the takeover bumps");
    diagnostic::warn(diagnostics, report);
}
