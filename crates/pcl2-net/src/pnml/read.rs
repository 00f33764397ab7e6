//! PNML text to net.

use super::bounds;
use super::error::{PnmlError, quoted};
use crate::pt::{Arc, MOST, Place, PlaceId, PtNet, Transition, TransitionId};
use roxmltree::{Document, Node, ParsingOptions};
use rustc_hash::FxHashMap;

/// Reads a file's text: one place/transition net, on any number of pages. Names are the ids.
pub fn read(text: &str) -> Result<PtNet, PnmlError> {
    bounds::check(text)?;
    let options = ParsingOptions { allow_dtd: false, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|error| not_xml(text, &error))?;
    let net = only_net(document.root_element())?;
    let mut reader = Reader::new(net)?;
    let arcs = reader.nodes(net)?;
    for arc in arcs {
        reader.arc(arc)?;
    }
    Ok(reader.net)
}

fn not_xml(text: &str, error: &roxmltree::Error) -> PnmlError {
    let blank = text.trim_start_matches('\u{feff}').trim().is_empty();
    let found = if blank { "nothing".to_owned() } else { error.to_string() };
    let help = match error {
        roxmltree::Error::DtdDetected => "remove the document type declaration: PNML needs none",
        _ => "check that the file is complete, and that it is PNML",
    };
    PnmlError::new(error.pos(), format!("expected PNML, found {found}"), help)
}

/// The one net of a file, if it is of the right kind.
fn only_net<'a, 'input>(root: Node<'a, 'input>) -> Result<Node<'a, 'input>, PnmlError> {
    if root.tag_name().name() != "pnml" {
        let message = format!("expected the element `pnml`, found {}", quoted(root.tag_name().name()));
        return Err(PnmlError::at(root, message, "give a PNML file"));
    }
    let mut nets = root.children().filter(|child| child.tag_name().name() == "net");
    let Some(net) = nets.next() else {
        return Err(PnmlError::at(root, "expected a net, found none", "give a file with one net"));
    };
    if let Some(second) = nets.next() {
        let message = "expected one net in the file, found another one";
        return Err(PnmlError::at(second, message, "write each net to a file of its own"));
    }
    let kind = net.attribute("type").unwrap_or("");
    if !is_place_transition(kind) {
        let message = format!("expected the net's type to be `{PTNET}`, found {}", quoted(kind));
        return Err(PnmlError::at(net, message, "unfold the net to a place/transition net first"));
    }
    Ok(net)
}

/// The type of a place/transition net.
pub(crate) const PTNET: &str = "http://www.pnml.org/version-2009/grammar/ptnet";

/// Older drafts and tools had other names for it.
fn is_place_transition(kind: &str) -> bool {
    let last = kind.rsplit('/').next().unwrap_or(kind).to_ascii_lowercase();
    kind == PTNET || last == "ptnet" || last == "ptnetb" || kind == "P/T net"
}

/// What an id names.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Named<'a, 'input> {
    Place(PlaceId),
    Transition(TransitionId),
    /// Stands for a place on another page.
    PlaceReference(Node<'a, 'input>),
    /// Stands for a transition on another page.
    TransitionReference(Node<'a, 'input>),
    Other,
}

struct Reader<'a, 'input> {
    net: PtNet,
    ids: FxHashMap<&'a str, Named<'a, 'input>>,
    /// Where the arc of a transition to a place stands in its list.
    takes: FxHashMap<(TransitionId, PlaceId), usize>,
    puts: FxHashMap<(TransitionId, PlaceId), usize>,
}

impl<'a, 'input> Reader<'a, 'input> {
    fn new(net: Node<'a, 'input>) -> Result<Reader<'a, 'input>, PnmlError> {
        let name = label(net, "name").map(|(text, _)| text).filter(|text| !text.is_empty());
        let name = name.or_else(|| net.attribute("id").map(str::to_owned)).unwrap_or_default();
        let mut reader = Reader {
            net: PtNet { name, ..PtNet::default() },
            ids: FxHashMap::default(),
            takes: FxHashMap::default(),
            puts: FxHashMap::default(),
        };
        reader.name(net, Named::Other)?;
        Ok(reader)
    }

    /// Reads places, transitions and references of all pages; the arcs.
    fn nodes(&mut self, net: Node<'a, 'input>) -> Result<Vec<Node<'a, 'input>>, PnmlError> {
        let mut arcs = Vec::new();
        let mut pages = vec![net.children()];
        while let Some(page) = pages.last_mut() {
            let Some(child) = page.next() else {
                pages.pop();
                continue;
            };
            match child.tag_name().name() {
                "page" => {
                    self.name(child, Named::Other)?;
                    pages.push(child.children());
                }
                "place" => self.place(child)?,
                "transition" => self.transition(child)?,
                "referencePlace" => self.name(child, Named::PlaceReference(child))?,
                "referenceTransition" => self.name(child, Named::TransitionReference(child))?,
                "arc" => {
                    self.name(child, Named::Other)?;
                    arcs.push(child);
                }
                _ => {}
            }
        }
        Ok(arcs)
    }

    fn place(&mut self, node: Node<'a, 'input>) -> Result<(), PnmlError> {
        let place = PlaceId(index(node, self.net.places.len())?);
        let initial = number(node, "initialMarking", 0, 0)?;
        self.name(node, Named::Place(place))?;
        self.net.places.push(Place { name: id(node)?, initial, capacity: None });
        Ok(())
    }

    fn transition(&mut self, node: Node<'a, 'input>) -> Result<(), PnmlError> {
        let gate = index(node, self.net.transitions.len())?;
        self.name(node, Named::Transition(TransitionId(gate)))?;
        self.net.transitions.push(Transition { name: id(node)?, gate, ..Transition::default() });
        Ok(())
    }

    /// Notes an id. Nets, pages and arcs may be without.
    fn name(&mut self, node: Node<'a, 'input>, named: Named<'a, 'input>) -> Result<(), PnmlError> {
        let Some(id) = node.attribute("id").map(str::trim).filter(|id| !id.is_empty()) else {
            return if named == Named::Other { Ok(()) } else { Err(no_id(node)) };
        };
        match self.ids.insert(id, named) {
            None => Ok(()),
            Some(_) => {
                let message = format!("expected an id of its own, found {} a second time", quoted(id));
                Err(PnmlError::at(node, message, "ids are unique in a file: rename one of the two"))
            }
        }
    }

    fn arc(&mut self, node: Node<'a, 'input>) -> Result<(), PnmlError> {
        plain(node)?;
        let weight = number(node, "inscription", 1, 1)?;
        let (source, target) = (self.end(node, "source")?, self.end(node, "target")?);
        let (transition, place, side) = match (source, target) {
            (Named::Place(place), Named::Transition(transition)) => (transition, place, &mut self.takes),
            (Named::Transition(transition), Named::Place(place)) => (transition, place, &mut self.puts),
            (Named::Place(_), _) => return Err(same_kind(node, "place")),
            _ => return Err(same_kind(node, "transition")),
        };
        let known = side.get(&(transition, place)).copied();
        let is_take = matches!(source, Named::Place(_));
        let owner = &mut self.net.transitions[transition.0 as usize];
        let arcs = if is_take { &mut owner.takes } else { &mut owner.puts };
        match known {
            None => {
                side.insert((transition, place), arcs.len());
                arcs.push(Arc { place, weight });
            }
            // Several arcs between the same two add up.
            Some(at) => arcs[at].weight = sum(node, arcs[at].weight, weight)?,
        }
        Ok(())
    }

    /// The place or transition at an arc's end, behind all references.
    fn end(&self, arc: Node<'a, 'input>, end: &str) -> Result<Named<'a, 'input>, PnmlError> {
        let mut named = self.find(arc, end)?;
        // A chain of references longer than the ids that there are goes in a circle.
        for _ in 0..=self.ids.len() {
            named = match named {
                Named::PlaceReference(node) => self.referenced(node)?,
                Named::TransitionReference(node) => self.referenced(node)?,
                Named::Place(_) | Named::Transition(_) => return Ok(named),
                Named::Other => {
                    let message = format!("expected a place or a transition as {end}, found another element's id");
                    return Err(PnmlError::at(arc, message, "an arc joins a place and a transition"));
                }
            };
        }
        let message = format!("expected a reference to end at a place or transition, the arc's {end} goes in a circle");
        Err(PnmlError::at(arc, message, "let one of the references name a place or transition"))
    }

    fn referenced(&self, reference: Node<'a, 'input>) -> Result<Named<'a, 'input>, PnmlError> {
        let found = self.find(reference, "ref")?;
        let is_place = reference.tag_name().name() == "referencePlace";
        match found {
            Named::Place(_) | Named::PlaceReference(_) if is_place => Ok(found),
            Named::Transition(_) | Named::TransitionReference(_) if !is_place => Ok(found),
            _ => {
                let kind = if is_place { "place" } else { "transition" };
                let message = format!("expected a {kind} in `ref`, found the id of something else");
                Err(PnmlError::at(reference, message, format!("name a {kind} or a reference to one")))
            }
        }
    }

    /// What an attribute's id names.
    fn find(&self, node: Node<'a, 'input>, attribute: &str) -> Result<Named<'a, 'input>, PnmlError> {
        let element = node.tag_name().name();
        let Some(id) = node.attribute(attribute) else {
            let message = format!("expected the attribute `{attribute}` of `{element}`, found none");
            return Err(PnmlError::at(node, message, "check that the file is complete"));
        };
        self.ids.get(id.trim()).copied().ok_or_else(|| {
            let message = format!("expected an id of this file in `{attribute}`, found {}", quoted(id));
            PnmlError::at(node, message, "check how it is spelt, in upper and lower case too")
        })
    }
}

/// Refuses arcs that mean something else than an ordinary arc.
fn plain(arc: Node<'_, '_>) -> Result<(), PnmlError> {
    let kind = arc.children().find(|child| child.tag_name().name() == "type");
    let element = kind.and_then(|node| node.attribute("value").or(node.text()));
    let Some(value) = element.or(arc.attribute("type")).map(str::trim) else {
        return Ok(());
    };
    if ["normal", "ptArc", "presetPTArc", "postsetPTArc"].contains(&value) {
        return Ok(());
    }
    let message = format!("expected an ordinary arc, found one of the type {}", quoted(value));
    Err(PnmlError::at(arc, message, "place/transition nets in PNML have ordinary arcs only: express it by a place"))
}

fn same_kind(arc: Node<'_, '_>, kind: &str) -> PnmlError {
    let message = format!("expected an arc between a place and a transition, found one between two {kind}s");
    let help = "put a transition between two places, or a place between two transitions";
    PnmlError::at(arc, message, help)
}

fn no_id(node: Node<'_, '_>) -> PnmlError {
    let message = format!("expected an id of `{}`, found none", node.tag_name().name());
    PnmlError::at(node, message, "give every place and transition an id")
}

fn id(node: Node<'_, '_>) -> Result<String, PnmlError> {
    node.attribute("id").map(|id| id.trim().to_owned()).ok_or_else(|| no_id(node))
}

fn index(node: Node<'_, '_>, length: usize) -> Result<u32, PnmlError> {
    u32::try_from(length).map_err(|_| PnmlError::at(node, "expected fewer places and transitions", "divide the net"))
}

/// The text of a label, and where it stands.
fn label<'a, 'input>(node: Node<'a, 'input>, name: &str) -> Option<(String, Node<'a, 'input>)> {
    let label = node.children().find(|child| child.tag_name().name() == name)?;
    let text = label.children().find(|child| child.tag_name().name() == "text")?;
    let words: String = text.children().filter_map(|child| child.text()).collect();
    Some((words.trim().to_owned(), text))
}

/// The number in a label.
fn number(node: Node<'_, '_>, name: &str, absent: u64, least: u64) -> Result<u64, PnmlError> {
    let Some((text, at)) = label(node, name).filter(|(text, _)| !text.is_empty()) else {
        return Ok(absent);
    };
    let number = text.parse::<u64>().ok().filter(|number| (least..=MOST).contains(number));
    number.ok_or_else(|| {
        let message = format!("expected a whole number from {least} to {MOST} in `{name}`, found {}", quoted(&text));
        PnmlError::at(at, message, "tokens and weights of place/transition nets are counted")
    })
}

fn sum(arc: Node<'_, '_>, one: u64, other: u64) -> Result<u64, PnmlError> {
    one.checked_add(other).filter(|sum| *sum <= MOST).ok_or_else(|| {
        let message = format!("expected weights between the same two to add up to at most {MOST}, found more");
        PnmlError::at(arc, message, "check the inscriptions")
    })
}
