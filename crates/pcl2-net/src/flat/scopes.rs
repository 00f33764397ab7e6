//! The net and the nets inside it, each with the places of its boxes.

use super::MAX_PLACES;
use crate::pt::{Place, PlaceId};
use pcl2_lang::ast::Statement;
use pcl2_lang::catalogue::Catalogue;
use pcl2_lang::decl::Decl;
use pcl2_lang::net::{BoxId, Kind, Net, PartId, StatementId};
use pcl2_lang::symbol::Symbols;
use rustc_hash::FxHashMap;

/// A net, at the place where it stands.
pub(super) struct Scope<'a> {
    pub(super) net: &'a Net,
    body: &'a [Statement],
    /// `D.V.`; empty outermost.
    pub(super) prefix: String,
    pub(super) is_macro: bool,
    /// The scope that it stands in.
    pub(super) outer: usize,
    /// The scopes of its parts.
    pub(super) parts: Vec<usize>,
    /// The place of its first box.
    first: usize,
    boxes: FxHashMap<&'a str, BoxId>,
}

/// The net and those inside it, outer ones first.
pub(super) fn scopes<'a>(
    decl: &'a Decl,
    catalogue: &'a Catalogue,
    symbols: &Symbols,
) -> Result<Vec<Scope<'a>>, String> {
    let mut scopes = Vec::new();
    let mut places = 0;
    add(decl, catalogue, symbols, (String::new(), false, 0), (&mut scopes, &mut places))?;
    Ok(scopes)
}

/// Adds a net and those inside it. Nets stand in one another at most as deep as they were read.
fn add<'a>(
    decl: &'a Decl,
    catalogue: &'a Catalogue,
    symbols: &Symbols,
    (prefix, is_macro, outer): (String, bool, usize),
    (scopes, places): (&mut Vec<Scope<'a>>, &mut usize),
) -> Result<usize, String> {
    let missing = || format!("expected a net, found `{}`", decl.name);
    let net = decl.net.as_deref().ok_or_else(missing)?;
    let body = decl.body.as_deref().ok_or_else(missing)?;
    let boxes = net.boxes.iter().enumerate().map(|(i, place)| (place.name.as_str(), BoxId(i as u32))).collect();
    let index = scopes.len();
    let first = *places;
    *places += net.boxes.len();
    if *places > MAX_PLACES || index > MAX_PLACES {
        return Err(format!("expected at most {MAX_PLACES} boxes with those of the nets inside, found more"));
    }
    scopes.push(Scope { net, body, prefix: prefix.clone(), is_macro, outer, parts: Vec::new(), first, boxes });
    for part in &net.parts {
        let code = symbols.text(body[part.statement.0 as usize].code.symbol);
        let inner = catalogue.find(code).ok_or_else(|| format!("expected a net, found `{code}`"))?;
        let inside = (format!("{prefix}{}.", part.name), part.place.is_some(), index);
        let part = add(inner, catalogue, symbols, inside, (&mut *scopes, &mut *places))?;
        scopes[index].parts.push(part);
    }
    Ok(index)
}

/// The places of all scopes.
pub(super) fn places(scopes: &[Scope<'_>]) -> Vec<Place> {
    let of_scope = |scope: &Scope<'_>| {
        let place = |place: &pcl2_lang::net::NetBox| Place {
            name: format!("{}{}", scope.prefix, place.name),
            initial: u64::from(place.initial),
            capacity: place.capacity.map(u64::from),
        };
        scope.net.boxes.iter().map(place).collect::<Vec<_>>()
    };
    scopes.iter().flat_map(of_scope).collect()
}

impl<'a> Scope<'a> {
    /// Where it stands, unless it is the outermost.
    pub(super) fn path(&self) -> Option<&str> {
        self.prefix.strip_suffix('.')
    }

    /// The place of a box.
    pub(super) fn place(&self, id: BoxId) -> PlaceId {
        PlaceId(self.first as u32 + id.0)
    }

    /// The places of all its boxes.
    pub(super) fn place_ids(&self) -> impl Iterator<Item = PlaceId> + use<> {
        (self.first as u32..(self.first + self.net.boxes.len()) as u32).map(PlaceId)
    }

    /// The places of the boxes that make tokens.
    pub(super) fn generations(&self) -> Vec<PlaceId> {
        let makes = |id: &PlaceId| matches!(self.net.boxes[id.0 as usize - self.first].kind, Kind::Generation(_));
        self.place_ids().filter(makes).collect()
    }

    /// The box of a name.
    pub(super) fn find(&self, name: &str) -> Option<BoxId> {
        self.boxes.get(name).copied()
    }

    /// The part of a name.
    pub(super) fn part(&self, name: &str) -> Option<PartId> {
        self.net.parts.iter().position(|part| part.name == name).map(|i| PartId(i as u32))
    }

    /// A statement.
    pub(super) fn statement(&self, id: StatementId) -> &'a Statement {
        &self.body[id.0 as usize]
    }
}
