//! Nets as C: what an instance keeps, its statements, and the scan.

mod choice;
pub(crate) mod classes;
mod commands;
mod ends;
pub(crate) mod facts;
mod fast;
mod firing;
mod gates;
mod inputs;
pub(crate) mod layout;
mod modes;
mod moves;
mod statements;
mod table;
mod tokens;
mod waits;

use crate::NetForm;
use crate::bodies::Body;
use crate::expr::{self, Scope};
use crate::layout::UnitLayout;
use crate::statics::Statics;
pub(crate) use inputs::{is_top, net_scans, top};
use layout::NetLayout;
use pcl2_lang::net::{BoxId, Net, NetBox};
use pcl2_lang::program::{SignalId, UnitId};
use pcl2_lang::types::{Scalar, Value};
use std::fmt::Write;

const INDENT: &str = "    ";

/// A net in the making.
pub(crate) struct NetBody<'b, 'c, 'a> {
    /// Its unit.
    pub(crate) body: &'b Body<'c, 'a>,
    /// The net.
    pub(crate) net: &'a Net,
    /// What it keeps.
    pub(crate) layout: &'c NetLayout,
}

impl<'b, 'c, 'a> NetBody<'b, 'c, 'a> {
    /// The net of a body, if it has one.
    pub(crate) fn of(body: &'b Body<'c, 'a>) -> Option<Self> {
        Some(NetBody { body, net: body.decl.net.as_deref()?, layout: body.layout.net.as_ref()? })
    }

    fn form(&self) -> NetForm {
        self.body.cx.layout.net_form
    }

    fn tag(&self) -> &'c str {
        &self.body.layout.tag
    }

    fn scope(&self) -> Scope<'static> {
        Scope::of(self.body.id)
    }

    /// The signal of a word, and behind words and tokens that of an attribute in hand.
    fn held(&self, index: usize) -> SignalId {
        SignalId((self.layout.held + index) as u32)
    }

    /// The member that keeps a word.
    fn word(&self, index: usize, scope: Scope<'_>) -> String {
        let mut text = String::new();
        expr::signal_value(&mut text, self.body.cx, scope, self.held(index), 0);
        text
    }

    /// The enumerator of a box.
    fn place(&self, id: BoxId) -> &'c str {
        &self.layout.boxes[id.0 as usize]
    }

    /// A box of the net.
    fn id(&self, place: &NetBox) -> BoxId {
        let index = self.net.boxes.iter().position(|known| known.name == place.name);
        BoxId(index.unwrap_or(0) as u32)
    }

    /// The members with the cause and the answer of a process box.
    fn answers(&self, place: &NetBox) -> [String; 2] {
        let before = self.net.boxes.iter().take_while(|other| other.name != place.name);
        let hands = |other: &NetBox| self.net.attributes(other).len() + if other.asks() { 2 } else { 0 };
        let first = before.map(hands).sum::<usize>() + self.net.attributes(place).len() + self.net.words.len() + 1;
        [first, first + 1].map(|index| self.word(index, self.scope()))
    }

    /// The layouts and units of the nets inside, in order.
    fn parts(&self) -> impl Iterator<Item = (usize, UnitId, &'c UnitLayout<'a>)> + use<'_, 'b, 'c, 'a> {
        let unit = |index: usize| {
            let inner = layout::part_unit(self.body.unit, self.net, pcl2_lang::net::PartId(index as u32))?;
            Some((index, inner, self.body.cx.unit_layout(inner)))
        };
        (0..self.net.parts.len()).filter_map(unit)
    }
}

/// Writes the enumerators of a net's boxes.
pub(crate) fn enumerators(out: &mut String, net: &NetBody<'_, '_, '_>) {
    if net.net.boxes.is_empty() {
        return;
    }
    let _ = writeln!(out, "/* The boxes of {}. */\nenum {{", net.body.decl.name);
    for (place, name) in net.net.boxes.iter().zip(&net.layout.boxes) {
        let _ = write!(out, "    {name}, ");
        crate::text::comment(out, "", net.body.cx.sources.text(place.span));
    }
    out.push_str("};\n\n");
}

/// What a net's init does beside that of its blocks: first values of words, the tokens at the start.
pub(crate) fn start(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let width = net.body.cx.program.width;
    for (i, word) in net.net.words.iter().enumerate() {
        if !crate::text::number(&word.initial, 0).is_zero() {
            let mut value = String::new();
            crate::text::element(&mut value, &word.initial, 0, word.scalar, width);
            let _ = writeln!(out, "    {} = {value};", net.word(i, net.scope()));
        }
    }
    for (place, name) in net.net.boxes.iter().zip(&net.layout.boxes).filter(|(place, _)| place.initial != 0) {
        let tokens = i32::try_from(place.initial).unwrap_or(i32::MAX);
        let _ = writeln!(out, "    self->box[{name}] = {tokens};");
    }
    if net.form() == NetForm::Fast {
        fast::start(out, net);
        modes::start(out, net);
        classes::start(out, net.body.cx.program, net.net, &net.layout.names);
        return;
    }
    let table = &net.layout.table;
    let ints = table.ints.iter().map(|value| (Value::Int(*value), Scalar::Int)).enumerate();
    let reals = table.reals.iter().map(|value| (Value::Real(*value), Scalar::Real)).enumerate();
    for (list, values) in [("ints", ints.collect::<Vec<_>>()), ("reals", reals.collect())] {
        for (i, (value, scalar)) in
            values.into_iter().filter(|(_, (value, _))| !crate::text::number(value, 0).is_zero())
        {
            let mut text = String::new();
            crate::text::element(&mut text, &value, 0, scalar, width);
            let _ = writeln!(out, "    self->net.{list}[{i}] = {text};");
        }
    }
}

/// What a net's tune does beside: it keeps the period of its scans.
pub(crate) fn tune(out: &mut String, net: &NetBody<'_, '_, '_>) {
    if net.layout.timed {
        out.push_str("    self->net.period = T;\n");
    }
    if net.layout.keeps("restless") {
        out.push_str("    self->net.restless |= 1;\n");
    }
}

/// Writes the functions of a net that make its scan. Its own inputs are arguments of the last of them.
pub(crate) fn scan(out: &mut String, statics: &mut Statics, net: &NetBody<'_, '_, '_>, head: &str) {
    match net.form() {
        NetForm::Table => table::functions(out, statics, net),
        NetForm::Fast => fast::functions(out, statics, net),
    }
    let (table, layout) = (net.form() == NetForm::Table, net.layout);
    if !table && (layout.called || layout.top) {
        fast::scan(out, net);
    }
    if layout.called || (table && layout.top) {
        let _ = writeln!(out, "{head}{{");
        if table {
            inputs::take_arguments(out, net);
            table::scan(out, net);
        } else {
            inputs::take_and_scan(out, net);
        }
        out.push_str("}\n\n");
    }
}
