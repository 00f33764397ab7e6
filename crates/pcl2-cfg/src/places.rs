//! Where a parameter's value stands in its statement.

use pcl2_lang::ast::{Item as Place, Operand, Statement};
use pcl2_lang::decl::{Decl, TypeExpr};
use pcl2_lang::kernel;
use pcl2_lang::source::Span;
use pcl2_lang::symbol::Symbols;
use pcl2_lang::types::Type;

/// Where one element of a parameter stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Written {
    /// In a place of its own.
    Here(Span),
    /// Its place is empty; its value would stand before this.
    Empty(Span),
    /// In a place that stands for all elements.
    ForAll(Span),
    /// In a parameter file that is named here.
    File(Span),
    /// Nowhere: it is a default without a place.
    Nowhere,
}

/// Finds one element of a parameter.
pub fn written(statement: &Statement, symbols: &Symbols, decl: &Decl, sizes: &[i32], at: (usize, usize)) -> Written {
    let (param, element) = at;
    let places = statement.params();
    if let Some(place) = named(places, symbols, &decl.params[param].name) {
        return match place.value {
            Operand::Text(_) => Written::File(place.span),
            _ if decl.params[param].ty.is_scalar() => Written::Here(place.span),
            _ => Written::ForAll(place.span),
        };
    }
    let place = |index: usize| places.get(index).filter(|place| place.label().is_none());
    let is_list = |place: &&Place| matches!(place.value, Operand::Text(_));
    let whole = places.len() == 1 && decl.params.iter().all(|param| param.ty != TypeExpr::Text);
    if let Some(file) = place(0).filter(|place| whole && is_list(place)) {
        return Written::File(file.span);
    }
    if is_empty(statement) {
        return Written::Nowhere;
    }
    let mut first = 0;
    for earlier in &decl.params[..param] {
        let one = place(first).is_some_and(|place| is_list(&place));
        first += if one { 1 } else { kernel::resolve(&earlier.ty, sizes).map_or(1, Type::elements) };
    }
    match place(first) {
        Some(file) if is_list(&file) => Written::File(file.span),
        Some(_) => place(first + element).map_or(Written::Nowhere, |place| match place.value {
            Operand::Empty => Written::Empty(place.span),
            _ => Written::Here(place.span),
        }),
        None => Written::Nowhere,
    }
}

/// Whether the parameter list has nothing in it.
pub fn is_empty(statement: &Statement) -> bool {
    matches!(statement.params(), [only] if only.label().is_none() && only.value == Operand::Empty)
}

fn named<'s>(places: &'s [Place], symbols: &Symbols, name: &str) -> Option<&'s Place> {
    places.iter().find(|place| place.label().is_some_and(|label| symbols.text(label.symbol) == name))
}
