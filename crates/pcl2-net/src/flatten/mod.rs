//! A net with the nets inside it written out, as the text of one net without macros and modules.
//!
//! A box `come` of the part `D` is `D_come`, and so are gates and values. A macro is a STATE that holds a token as long as
//! its net works: a gate that puts a token into it marks the entry too, one that takes from it empties the exit. What
//! would not do the same scan by scan is refused.

mod gates;
mod lines;
mod names;
mod statements;
mod words;

use crate::flat::scopes::{Scope, scopes};
use crate::flat::{Flat, flat};
use crate::pt::{Arc, PlaceId, PtNet};
use names::Names;
use pcl2_lang::catalogue::Catalogue;
use pcl2_lang::decl::Decl;
use pcl2_lang::lexer::{Lexer, NET_WORDS, Token};
use pcl2_lang::source::Sources;
use pcl2_lang::symbol::Symbols;
use std::fmt::Write;

/// The text of the flat net, not yet laid out; it is called `name`. An error where a flat net could not do the same.
pub fn flat_text(
    decl: &Decl,
    name: &str,
    catalogue: &Catalogue,
    symbols: &Symbols,
    sources: &Sources,
) -> Result<String, String> {
    let scopes = scopes(decl, catalogue, symbols)?;
    let flat = flat(decl, catalogue, symbols)?;
    let names = Names::new(&scopes)?;
    let mut writer = Flattener { scopes, names, flat, symbols, sources, words: Vec::new(), text: String::new() };
    writer.words = writer.words()?;
    let _ = writeln!(writer.text, "! `{}` with the nets inside it written out.", decl.name);
    let head = writer.head(decl, name);
    let _ = writeln!(writer.text, "{head}");
    writer.values();
    for scope in 0..writer.scopes.len() {
        writer.boxes(scope)?;
    }
    writer.actives();
    writer.gates()?;
    writer.text.push_str("END\n");
    Ok(writer.text)
}

struct Flattener<'a> {
    scopes: Vec<Scope<'a>>,
    names: Names,
    flat: Flat,
    symbols: &'a Symbols,
    sources: &'a Sources,
    /// By scope and word.
    words: Vec<Vec<words::Word>>,
    text: String,
}

impl Flattener<'_> {
    /// The head as it is written, with the name of the flat net.
    fn head(&self, decl: &Decl, name: &str) -> String {
        let source = self.sources.file(decl.span.file);
        let mut head = String::new();
        let mut depth = 0_u32;
        for lexeme in Lexer::new(&source.text, &NET_WORDS) {
            match lexeme.token {
                // A line ends behind no comma.
                Token::Newline if depth == 0 && !head.is_empty() && !head.ends_with(", ") => break,
                Token::Newline => continue,
                Token::LeftParen => depth += 1,
                Token::RightParen => depth = depth.saturating_sub(1),
                _ => {}
            }
            let own = lexeme.start == decl.span.start;
            let text = &source.text[lexeme.start as usize..lexeme.end as usize];
            head.extend([if own { name } else { text }, " "]);
        }
        head
    }

    /// Where a part stands, for messages.
    fn path(&self, scope: usize) -> String {
        self.scopes[scope].path().unwrap_or(&self.scopes[scope].decl.name).to_owned()
    }

    /// Whether a macro's net holds one token while the macro does, and none else: then it is empty when the macro is.
    fn is_balanced(&self, scope: usize, place: PlaceId) -> bool {
        let inside = &self.flat.parts[scope].places;
        let starts_empty = inside.iter().all(|place| self.flat.net.places[place.0 as usize].initial == 0);
        starts_empty && keeps_balance(&self.flat.net, place, inside)
    }
}

/// Whether every transition changes the tokens of a place as it changes those of some others together.
fn keeps_balance(net: &PtNet, place: PlaceId, others: &[PlaceId]) -> bool {
    let sum = |arcs: &[Arc]| -> (i128, i128) {
        let of = |wanted: &dyn Fn(&PlaceId) -> bool| {
            arcs.iter().filter(|arc| wanted(&arc.place)).map(|arc| i128::from(arc.weight)).sum::<i128>()
        };
        (of(&|other| *other == place), of(&|other| others.contains(other)))
    };
    net.transitions.iter().all(|transition| {
        let (takes, puts) = (sum(&transition.takes), sum(&transition.puts));
        puts.0 - takes.0 == puts.1 - takes.1
    })
}
