//! The function codes that a program can use: the packed catalogue, and the user's own.

use crate::codes;
use crate::decl::Decl;
use crate::declare;
use crate::diagnostic::{self, Diagnostic};
use crate::source::Sources;
use crate::symbol::Symbols;
use rustc_hash::{FxHashMap, FxHashSet};

include!(concat!(env!("OUT_DIR"), "/packed.rs"));

/// The packed declaration files: path below `blocks/` and text.
pub fn files() -> &'static [(&'static str, &'static str)] {
    DECLARATIONS
}

/// The packed error pages: file name (`P0203.md`) and text.
pub fn pages() -> &'static [(&'static str, &'static str)] {
    PAGES
}

/// All known function codes.
#[derive(Clone, Debug, Default)]
pub struct Catalogue {
    decls: Vec<Decl>,
    by_name: FxHashMap<String, usize>,
    /// Names of declarations with mistakes.
    spoiled: FxHashSet<String>,
    /// The codes that a sign or a function name stands for in expressions.
    operators: FxHashMap<String, Vec<usize>>,
}

/// A user's declaration file.
#[derive(Clone, Debug)]
pub struct UserFile {
    /// The name for messages.
    pub name: String,
    /// The file's stem.
    pub stem: String,
    /// Its content.
    pub bytes: Vec<u8>,
}

impl Catalogue {
    /// Reads declaration files given as (path below the folder, text), in order.
    pub fn read(
        files: &[(&str, &str)],
        sources: &mut Sources,
        symbols: &mut Symbols,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Catalogue {
        let mut catalogue = Catalogue::default();
        for (path, text) in files {
            let file = sources.add(format!("blocks/{path}"), text.as_bytes().to_vec());
            let (group, name) = path.rsplit_once('/').unwrap_or(("", path));
            let stem = name.strip_suffix(".fc").unwrap_or(name);
            let declared = declare::read(sources, file, group, stem, symbols, diagnostics);
            catalogue.spoiled.extend(declared.spoiled);
            for decl in declared.decls {
                catalogue.add(decl, diagnostics);
            }
        }
        catalogue
    }

    /// The packed catalogue.
    pub fn packed(sources: &mut Sources, symbols: &mut Symbols, diagnostics: &mut Vec<Diagnostic>) -> Catalogue {
        Catalogue::read(files(), sources, symbols, diagnostics)
    }

    /// Adds the user's own codes; they win over those of the catalogue.
    pub fn add_user(
        &mut self,
        files: &[UserFile],
        sources: &mut Sources,
        symbols: &mut Symbols,
        diagnostics: &mut Vec<Diagnostic>,
    ) {
        for user in files {
            let file = sources.add(user.name.clone(), user.bytes.clone());
            let declared = declare::read(sources, file, "", &user.stem, symbols, diagnostics);
            self.spoiled.extend(declared.spoiled);
            for mut decl in declared.decls {
                decl.user = true;
                self.add(decl, diagnostics);
            }
        }
    }

    /// Adds a net; it wins over a function code of the catalogue.
    pub fn add_net(&mut self, decl: Decl, diagnostics: &mut Vec<Diagnostic>) {
        self.add(decl, diagnostics);
    }

    /// Remembers a name of which nothing is known.
    pub fn spoil(&mut self, name: &str) {
        self.spoiled.insert(name.to_owned());
    }

    fn add(&mut self, decl: Decl, diagnostics: &mut Vec<Diagnostic>) {
        if let Some(known) = self.by_name.get(&decl.name).map(|index| &self.decls[*index]) {
            let (code, message) = if decl.user && !known.user {
                (
                    codes::HIDDEN_CODE,
                    format!("`{}` is also a function code of the catalogue; this one is used", decl.name),
                )
            } else {
                (codes::BAD_DECLARATION, format!("expected one declaration of `{}`, found a second", decl.name))
            };
            let report = Diagnostic::new(code, decl.span, message).label(known.span, "the other one");
            if report.is_error() { diagnostics.push(report) } else { diagnostic::warn(diagnostics, report) }
        }
        self.by_name.insert(decl.name.clone(), self.decls.len());
        self.add_operator(&decl, diagnostics);
        self.decls.push(decl);
    }

    fn add_operator(&mut self, decl: &Decl, diagnostics: &mut Vec<Diagnostic>) {
        let Some(sign) = decl.operator.as_deref() else {
            return;
        };
        let own = Some(sign).filter(|sign| !sign.is_empty() && *sign != decl.name);
        for key in [decl.name.as_str()].into_iter().chain(own) {
            let same = self.operators(key).find(|other| other.port_scalars().eq(decl.port_scalars()));
            if let Some(other) = same.filter(|other| decl.user == other.user) {
                let message = format!("expected one code for `{key}` over operands of the same types, found a second");
                let report = Diagnostic::new(codes::BAD_DECLARATION, decl.span, message);
                diagnostics.push(report.label(other.span, "the other one"));
            }
            let same_ports = |i: &usize| self.decls[*i].port_scalars().eq(decl.port_scalars());
            let known = self.operators.entry(key.to_owned()).or_default();
            // One of the user's own wins.
            known.retain(|i| !same_ports(i));
            known.push(self.decls.len());
        }
    }

    /// The codes that a sign or a function name stands for in expressions, in order of reading.
    pub fn operators(&self, key: &str) -> impl Iterator<Item = &Decl> {
        let indexes = self.operators.get(key).into_iter().flatten().copied();
        indexes.filter_map(|i| self.decls.get(i).filter(|decl| self.by_name.get(&decl.name) == Some(&i)))
    }

    /// The names of all functions that expressions can have, in order.
    pub fn functions(&self) -> Vec<&str> {
        let names = self.operators.keys().map(String::as_str);
        let mut names: Vec<&str> = names.filter(|name| name.starts_with(|c: char| c.is_ascii_alphabetic())).collect();
        names.sort_unstable();
        names
    }

    /// The function code of this name.
    pub fn find(&self, name: &str) -> Option<&Decl> {
        self.by_name.get(name).map(|index| &self.decls[*index])
    }

    /// Whether a declaration of this name has mistakes: it is not unknown, but nothing is known of it.
    pub fn is_spoiled(&self, name: &str) -> bool {
        self.spoiled.contains(name)
    }

    /// All declarations in order of reading; a hidden one is left out.
    pub fn decls(&self) -> impl Iterator<Item = &Decl> {
        self.decls.iter().enumerate().filter(|(i, decl)| self.by_name.get(&decl.name) == Some(i)).map(|(_, decl)| decl)
    }

    /// All codes that are declared in the same file as this one.
    pub fn family(&self, decl: &Decl) -> Vec<&Decl> {
        self.decls.iter().filter(|other| other.span.file == decl.span.file).collect()
    }
}
