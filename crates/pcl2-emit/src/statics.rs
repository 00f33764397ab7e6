//! Names at file scope, and constant arrays, each once.

use crate::names::Namer;
use crate::text;
use pcl2_lang::types::{Scalar, Value, Width};
use rustc_hash::FxHashMap;
use std::fmt::Write;

/// What functions of the generated file refer to at file scope.
#[derive(Debug)]
pub(crate) struct Statics {
    program: String,
    names: Namer<'static>,
    known: FxHashMap<String, String>,
    arrays: usize,
    text: String,
}

impl Statics {
    /// Begins with the names that are taken.
    pub(crate) fn new(program: &str, names: &Namer<'static>) -> Statics {
        Statics {
            program: program.to_owned(),
            names: names.clone(),
            known: FxHashMap::default(),
            arrays: 0,
            text: String::new(),
        }
    }

    /// A name at file scope: the program's, and this behind it.
    pub(crate) fn name(&mut self, suffix: &str) -> String {
        self.names.made(&format!("{}_{suffix}", self.program))
    }

    /// The name of the array with these elements.
    pub(crate) fn array(&mut self, value: &Value, count: usize, scalar: Scalar, width: Width) -> String {
        let mut key = format!("{} ", pcl2_lang::kernel::c_scalar(scalar));
        let element = key.len() - 1;
        text::elements(&mut key, value, count, scalar, width);
        if let Some(name) = self.known.get(&key) {
            return name.clone();
        }
        self.arrays += 1;
        let name = self.name(&format!("k{}", self.arrays));
        let (element, elements) = (&key[..element], &key[element + 1..]);
        let _ = writeln!(self.text, "static const {element} {name}[{count}] = {{\n    {elements},\n}};\n");
        self.known.insert(key, name.clone());
        name
    }

    /// Appends a definition, given what stands before and behind its name, and returns the name; an equal one is used
    /// again.
    pub(crate) fn define(&mut self, out: &mut String, before: &str, suffix: &str, behind: &str) -> String {
        let key = format!("{before}{suffix}{behind}");
        if let Some(name) = self.known.get(&key) {
            return name.clone();
        }
        let name = self.name(suffix);
        out.push_str(before);
        out.push_str(&name);
        out.push_str(behind);
        self.known.insert(key, name.clone());
        name
    }

    /// The definitions of the arrays.
    pub(crate) fn text(&self) -> &str {
        &self.text
    }
}
