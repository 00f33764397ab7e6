//! Composites: a body compiled once for each combination of sizes.

use crate::Input;
use crate::draft::Scope;
use pcl2_lang::ast::Statement;
use pcl2_lang::codes;
use pcl2_lang::decl::Decl;
use pcl2_lang::diagnostic::Diagnostic;
use pcl2_lang::net::Net;
use pcl2_lang::program::UnitId;
use pcl2_lang::types::Type;
use rustc_hash::FxHashMap;

/// Composites nest at most so deep.
const MAX_DEPTH: usize = 32;

/// The bodies in use. An inner one is finished before the one that uses it.
#[derive(Default)]
pub(crate) struct Composites<'a> {
    by_key: FxHashMap<(String, Vec<i32>), usize>,
    bodies: Vec<Scope<'a>>,
    /// The composites around the one that is being compiled.
    open: Vec<String>,
}

impl<'a> Composites<'a> {
    /// The unit of each body: outer ones come first.
    pub(crate) fn order(&self) -> Vec<UnitId> {
        let count = self.bodies.len();
        (0..count).map(|i| UnitId((count - i) as u32)).collect()
    }

    /// The bodies in the order of their units.
    pub(crate) fn into_bodies(self) -> impl Iterator<Item = Scope<'a>> {
        self.bodies.into_iter().rev()
    }
}

/// Compiles the bodies that the blocks of a scope need.
pub(crate) fn expand<'a>(
    input: &Input<'a>,
    scope: &mut Scope<'a>,
    composites: &mut Composites<'a>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    for i in 0..scope.drafts.len() {
        let draft = &scope.drafts[i];
        let Some(decl) = draft.decl.filter(|decl| decl.is_composite() && !draft.spoiled) else {
            continue;
        };
        let Some(sizes) = draft.known_sizes() else {
            continue;
        };
        scope.drafts[i].unit = body(input, decl, sizes, composites, diagnostics);
    }
}

fn body<'a>(
    input: &Input<'a>,
    decl: &'a Decl,
    sizes: Vec<i32>,
    composites: &mut Composites<'a>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<usize> {
    let key = (decl.name.clone(), sizes.clone());
    if let Some(index) = composites.by_key.get(&key) {
        return Some(*index);
    }
    if composites.open.contains(&decl.name) || composites.open.len() >= MAX_DEPTH {
        let message = format!("expected a composite that does not contain itself, found `{}` inside itself", decl.name);
        diagnostics.push(Diagnostic::new(codes::BAD_DECLARATION, decl.span, message));
        return None;
    }
    composites.open.push(decl.name.clone());
    let statements: Vec<(&Statement, u32)> = decl.body.iter().flatten().map(|statement| (statement, 0)).collect();
    let mut scope = Scope::new(statements, Some((decl, sizes)));
    crate::complete(input, &mut scope, composites, diagnostics);
    refuse_images(&scope, diagnostics);
    check_conditions(&scope, diagnostics);
    composites.open.pop();
    let index = composites.bodies.len();
    composites.bodies.push(scope);
    composites.by_key.insert(key, index);
    Some(index)
}

/// A condition of a net is a truth value.
fn check_conditions(scope: &Scope<'_>, diagnostics: &mut Vec<Diagnostic>) {
    let net = scope.owner.as_ref().and_then(|(decl, _)| decl.net.as_deref());
    for condition in net.map(Net::conditions).unwrap_or_default() {
        let Some(draft) = scope.drafts.get(condition.0 as usize).filter(|draft| !draft.spoiled) else {
            continue;
        };
        let result = draft.outputs.first().and_then(|id| scope.wire(*id).ty);
        if result.is_some_and(|ty| ty != Type::INT) {
            let message = "expected a truth value as condition, found a real";
            let report = Diagnostic::new(codes::CONDITION, draft.statement.code.span, message);
            diagnostics.push(report.help("compare it: `x > 0.`"));
        }
    }
}

/// The process image belongs to the program: a composite gets its values by ports.
fn refuse_images(scope: &Scope<'_>, diagnostics: &mut Vec<Diagnostic>) {
    for draft in &scope.drafts {
        if let Some(decl) = draft.decl.filter(|decl| decl.image.is_some()) {
            let message = format!("expected no {} in a composite, found one", decl.name);
            let report = Diagnostic::new(codes::WRONG_SECTION, draft.statement.code.span, message);
            diagnostics.push(report.help("hand the value in or out by a port"));
        }
    }
}
