//! The documentation of a net: what it is, what it does, what is known of it, as a document that can be written in
//! Markdown and in HTML.

mod analysis;
mod document;
mod html;
mod interface;
mod lines;
mod markdown;
mod reference;

pub use document::{Cell, Content, Document, Section, Style, Table};

use crate::flat::Flat;
use crate::structure::names::{counted, size};
use pcl2_lang::manual;
use pcl2_lang::net::written::{Written, WrittenNet};
use pcl2_lang::program::Binding;
use pcl2_lang::source::Sources;

/// What a report is made of.
#[derive(Clone, Copy, Debug)]
pub struct Input<'a> {
    /// The net and those inside it.
    pub written: &'a Written<'a>,
    /// All of it as a place/transition net.
    pub flat: &'a Flat,
    /// The texts.
    pub sources: &'a Sources,
    /// The physical points of inputs and outputs.
    pub bindings: &'a [Binding],
}

/// The report on a net.
pub fn report(input: &Input<'_>) -> Document {
    let Some(net) = input.written.nets.first() else {
        return Document::default();
    };
    let mut document = Document { title: net.decl.name.clone(), sections: vec![head(input, net)] };
    document.sections.push(Section::new(2, "Picture", vec![Content::Picture]));
    parts_of(input, net, 2, &mut document);
    for inner in &input.written.nets[1..] {
        let mut content = opening(inner);
        let words = format!("It stands in {}.net, and in this net as {}.", inner.decl.stem, places(input, inner));
        content.push(Content::Words(words));
        document.sections.push(Section::new(2, &format!("Net {}", inner.decl.name), content));
        parts_of(input, inner, 3, &mut document);
    }
    document.sections.extend(analysis::sections(input.flat));
    document
}

/// What a net is for, and its head.
fn opening(net: &WrittenNet<'_>) -> Vec<Content> {
    let doc = net.decl.doc.split("\n\n").map(|paragraph| paragraph.split_whitespace().collect::<Vec<_>>().join(" "));
    let mut content: Vec<Content> = doc.filter(|paragraph| !paragraph.is_empty()).map(Content::Words).collect();
    let mut head = net.decl.clone();
    head.outputs.retain(|output| !output.by_name);
    content.push(Content::Code(manual::signature(&head).trim().to_owned()));
    content
}

fn head(input: &Input<'_>, net: &WrittenNet<'_>) -> Section {
    let mut content = opening(net);
    let (own, flat) = (net.net, &input.flat.net);
    let mut words = counted(own.boxes.len(), "box", "boxes");
    words.push_str(&format!(", {}", counted(own.gates.len(), "gate", "gates")));
    if !own.parts.is_empty() {
        words.push_str(&format!("; with the nets inside it {}", size(flat.places.len(), flat.transitions.len())));
    }
    content.push(Content::Words(format!("{words}.")));
    Section::new(1, &net.decl.name, content)
}

/// The names of the parts that a net stands for.
fn places(input: &Input<'_>, inner: &WrittenNet<'_>) -> String {
    let mut names = Vec::new();
    for outer in &input.written.nets {
        for (part, index) in outer.net.parts.iter().zip(&outer.parts) {
            if input.written.nets[*index].decl.name == inner.decl.name {
                names.push(format!("{} of {}", part.name, outer.decl.name));
            }
        }
    }
    names.join(", ")
}

/// The tables of one net.
fn parts_of(input: &Input<'_>, net: &WrittenNet<'_>, level: u8, document: &mut Document) {
    let first = document.sections.len();
    // What the outermost net alone has: its inputs and outputs are those of the plant.
    let bindings = if level == 2 { input.bindings } else { &[] };
    document.sections.extend(interface::sections(net, bindings));
    document.sections.extend(lines::sections(input, net));
    document.sections.push(reference::section(input.sources, net));
    document.sections[first..].iter_mut().for_each(|section| section.level = level);
    document.sections.retain(|section| !section.content.is_empty());
}
