//! `.net` files as written: a head in the notation of declarations, and the lines of the net.

use super::raw::{self, Clause, Raw};
use super::{comment_above, complain, head, mistakes};
use crate::ast::Name;
use crate::ast::net::NetLine;
use crate::codes;
use crate::decl::Decl;
use crate::diagnostic::Diagnostic;
use crate::source::{FileId, Sources, Span};
use crate::symbol::Symbols;
use crate::syntax::{Context, Lines, Words, parse_declaration_line, parse_net_lines};

/// What one `.net` file says.
#[derive(Clone, Debug)]
pub struct NetFile {
    /// The declaration of its inputs, outputs and parameters.
    pub decl: Decl,
    /// Where the names of the head stand.
    pub head: HeadNames,
    /// Its lines.
    pub lines: Vec<NetLine>,
    /// Nothing was said about it so far.
    pub sound: bool,
    /// All names that it declares are known, whatever was said about other lines.
    pub whole: bool,
}

/// The names in a head, in order.
#[derive(Clone, Debug, Default)]
pub struct HeadNames {
    /// Inputs.
    pub ports: Vec<Name>,
    /// Parameters.
    pub params: Vec<Name>,
    /// Outputs.
    pub outputs: Vec<Name>,
}

impl HeadNames {
    fn new(outputs: &[raw::Output], call: &raw::Call) -> HeadNames {
        let port = |item: &raw::Item| match item {
            raw::Item::Port(port) => Some(port.name),
            raw::Item::Literal(_) | raw::Item::Constant(..) => None,
        };
        HeadNames {
            ports: call.items.iter().filter_map(port).collect(),
            params: call.params.iter().map(|param| param.name).collect(),
            outputs: outputs.iter().map(|output| output.name).collect(),
        }
    }
}

/// Reads a `.net` file. `None`: its head is not understood, which was reported.
pub fn read(
    sources: &Sources,
    file: FileId,
    stem: &str,
    symbols: &mut Symbols,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<NetFile> {
    let source = sources.file(file);
    let mut context = Context::new(source, file, symbols, diagnostics);
    if !context.is_text(source) {
        return None;
    }
    let mut lines = Lines::net(source, file);
    let before = mistakes(&mut context);
    let Some(broken) = lines.next_line(context.diagnostics()) else {
        let start = context.span(0, 0);
        no_head(&mut context, start, "an empty file");
        return None;
    };
    let start = lines.tokens.first().map_or(0, |lexeme| lexeme.start);
    let first = context.span(start, lines.position());
    let mut names = HeadNames::default();
    let line = if broken { None } else { parse_declaration_line(&mut context, &lines) };
    let decl = match line {
        Some(Raw::Head(outputs, mut call)) => {
            without_constants(&mut context, &mut call);
            let mut decl = head(&mut context, &outputs, &call);
            names = HeadNames::new(&outputs, &call);
            decl.doc = comment_above(&source.text, start as usize);
            (decl.stem, decl.user) = (stem.to_owned(), true);
            Some(decl)
        }
        Some(Raw::Clause(Clause::End)) => {
            no_head(&mut context, first, "END");
            return None;
        }
        Some(Raw::Clause(_)) => {
            no_head(&mut context, first, "another line");
            None
        }
        None => None,
    };
    lines.set_words(Words::Net);
    let head_is_sound = mistakes(&mut context) == before;
    let parsed = parse_net_lines(&mut context, &mut lines);
    let mut decl = decl?;
    if decl.name != stem {
        let message = format!("expected the net `{stem}`, as its file is called, found `{}`", decl.name);
        complain(&mut context, decl.span, message);
        decl.name = stem.to_owned();
    }
    let sound = mistakes(&mut context) == before;
    let whole = head_is_sound && !parsed.contains(&NetLine::Broken(true));
    Some(NetFile { decl, head: names, lines: parsed, sound, whole })
}

/// A name alone is a constant of a block, which nets do not have: its type was forgotten.
fn without_constants(context: &mut Context<'_>, call: &mut raw::Call) {
    call.items.retain(|item| {
        let raw::Item::Constant(name, _) = item else {
            return true;
        };
        let text = context.symbol_text(name.symbol).to_owned();
        let message = format!("expected a type before `{text}`, found none");
        let help = format!("write `int {text}` or `real {text}`; a size in a net is a number: `ivec[5] done`");
        context.diagnostics().push(Diagnostic::new(codes::BAD_DECLARATION, name.span, message).help(help));
        false
    });
}

fn no_head(context: &mut Context<'_>, span: Span, found: &str) {
    let message = format!("expected the head of a net, found {found}");
    let help = "a net begins as a declaration does: `int v1, int v2 = tank ( int button, int level : )`";
    context.diagnostics().push(Diagnostic::new(codes::BAD_DECLARATION, span, message).help(help));
}
