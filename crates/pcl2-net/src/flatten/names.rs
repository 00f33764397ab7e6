//! The names of the flat net: `D_come` for `come` of the part `D`, each once.

use crate::flat::scopes::Scope;
use pcl2_lang::net::BoxId;
use rustc_hash::FxHashMap;

/// The names of boxes, classes and parts.
pub(super) struct Names {
    /// By scope: `D_V_`.
    pub(super) prefixes: Vec<String>,
    /// By scope and box.
    boxes: Vec<Vec<String>>,
    /// By scope and class.
    pub(super) classes: Vec<Vec<String>>,
}

impl Names {
    pub(super) fn new(scopes: &[Scope<'_>]) -> Result<Names, String> {
        let prefixes: Vec<String> =
            scopes.iter().map(|scope| scope.prefix.replace(['.', '['], "_").replace(']', "")).collect();
        let boxes = scopes
            .iter()
            .zip(&prefixes)
            .map(|(scope, prefix)| scope.net.boxes.iter().map(|place| format!("{prefix}{}", place.name)).collect());
        let names = Names { boxes: boxes.collect(), classes: classes(scopes, &prefixes), prefixes };
        names.boxes_and_values(scopes)?;
        names.gates(scopes)?;
        Ok(names)
    }

    /// A box.
    pub(super) fn place(&self, scope: usize, id: BoxId) -> &str {
        &self.boxes[scope][id.0 as usize]
    }

    /// Boxes and values share their names.
    fn boxes_and_values(&self, scopes: &[Scope<'_>]) -> Result<(), String> {
        let mut seen = Seen::default();
        let outer = &scopes[0];
        let ports = outer.decl.ports().map(|port| port.name.as_str());
        let head = ports.chain(outer.decl.params.iter().map(|param| param.name.as_str()));
        for name in head {
            seen.heads.insert(name.to_owned(), name.to_owned());
        }
        for (i, scope) in scopes.iter().enumerate() {
            for place in &scope.net.boxes {
                seen.take(&self.prefixes[i], &scope.prefix, &place.name)?;
            }
            for word in &scope.net.words {
                // A command is a port and a word.
                if i > 0 || !seen.heads.contains_key(&word.name) {
                    seen.take(&self.prefixes[i], &scope.prefix, &word.name)?;
                }
            }
        }
        Ok(())
    }

    fn gates(&self, scopes: &[Scope<'_>]) -> Result<(), String> {
        let mut seen = Seen::default();
        for (i, scope) in scopes.iter().enumerate() {
            for gate in &scope.net.gates {
                seen.take(&self.prefixes[i], &scope.prefix, &gate.name)?;
            }
        }
        Ok(())
    }
}

#[derive(Default)]
struct Seen {
    heads: FxHashMap<String, String>,
    names: FxHashMap<String, String>,
}

impl Seen {
    /// No other thing has the flat name.
    fn take(&mut self, prefix: &str, path: &str, name: &str) -> Result<(), String> {
        let (flat, own) = (format!("{prefix}{name}"), format!("{path}{name}"));
        let known = self.heads.get(&flat).or(self.names.get(&flat));
        if let Some(other) = known.filter(|other| **other != own) {
            return Err(format!(
                "expected a name of its own for `{own}` in the flat net, found `{flat}`, which `{other}` has; rename one \
                 of them"
            ));
        }
        self.names.insert(flat, own);
        Ok(())
    }
}

/// Classes that are declared alike are one.
fn classes(scopes: &[Scope<'_>], prefixes: &[String]) -> Vec<Vec<String>> {
    let mut known: FxHashMap<&str, &pcl2_lang::net::Class> = FxHashMap::default();
    let mut names = Vec::new();
    for (scope, prefix) in scopes.iter().zip(prefixes) {
        let name = |class: &'_ pcl2_lang::net::Class| match known.get(class.name.as_str()) {
            Some(other) if *other != class => format!("{prefix}{}", class.name),
            Some(_) | None => class.name.clone(),
        };
        let own: Vec<String> = scope.net.classes.iter().map(name).collect();
        for class in &scope.net.classes {
            known.entry(&class.name).or_insert(class);
        }
        names.push(own);
    }
    names
}
