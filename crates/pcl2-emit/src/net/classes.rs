//! Tokens with attributes in the fast form: a struct for each class; of each box its tokens, and the one in hand.

use crate::names::Namer;
use crate::shape::{Extent, element_extent};
use pcl2_lang::kernel::c_scalar;
use pcl2_lang::net::{BoxId, Class, Net, NetBox, Order};
use pcl2_lang::program::Program;
use pcl2_lang::types::{Value, Width};
use std::fmt::Write;

/// The members of an instance: the token in hand of each box, and all its tokens.
pub(crate) const HAND: &str = "hand";
/// See [`HAND`].
pub(crate) const TOKENS: &str = "tokens";

/// The names of what tokens with attributes need in C.
#[derive(Clone, Debug, Default)]
pub(crate) struct ClassNames {
    /// By class.
    pub(crate) classes: Vec<ClassName>,
    /// By box: its member of `hand` and of `tokens`.
    pub(crate) boxes: Vec<String>,
    /// By box: the function that finds its next token, if that needs one.
    pub(crate) next: Vec<Option<String>>,
}

/// The names of a class.
#[derive(Clone, Debug, Default)]
pub(crate) struct ClassName {
    /// The tag of its struct.
    pub(crate) tag: String,
    /// The constant that is a new token.
    pub(crate) fresh: String,
    /// By attribute: the member.
    pub(crate) members: Vec<String>,
}

/// Whether tokens of a box carry anything.
pub(crate) fn carries(net: &Net, place: &NetBox) -> bool {
    !net.attributes(place).is_empty()
}

/// The structs of a program: a class and its tag. Classes that are alike share one.
pub(crate) type Structs = Vec<(Class, String)>;

/// The tag of a class's struct.
fn struct_tag(class: &Class, program: &str, structs: &mut Structs, file: &mut Namer<'static>) -> String {
    let alike = |(known, _): &&(Class, String)| {
        let mut pairs = known.attributes.iter().zip(&class.attributes);
        known.name == class.name
            && known.attributes.len() == class.attributes.len()
            && pairs.all(|(a, b)| (&a.name, a.scalar) == (&b.name, b.scalar))
    };
    if let Some((_, tag)) = structs.iter().find(alike) {
        return tag.clone();
    }
    let tag = file.made(&format!("{program}_{}", class.name));
    structs.push((class.clone(), tag.clone()));
    tag
}

/// Names what the tokens of a net need.
pub(crate) fn names(
    net: &Net,
    (program, tag): (&str, &str),
    structs: &mut Structs,
    file: &mut Namer<'static>,
) -> ClassNames {
    let mut class = |class: &Class, file: &mut Namer<'static>| {
        let mut members = Namer::default();
        ClassName {
            tag: struct_tag(class, program, structs, file),
            fresh: file.made(&format!("{tag}_new_{}", class.name)),
            members: class.attributes.iter().map(|attribute| members.made(&attribute.name)).collect(),
        }
    };
    let mut members = Namer::default();
    let next = |place: &NetBox, file: &mut Namer<'static>| match place.order {
        Order::Least(_) | Order::Most(_) if carries(net, place) => {
            Some(file.made(&format!("{tag}_{}_next", place.name)))
        }
        Order::Fifo | Order::Lifo | Order::Least(_) | Order::Most(_) => None,
    };
    ClassNames {
        classes: net.classes.iter().map(|item| class(item, file)).collect(),
        boxes: net.boxes.iter().map(|place| members.made(&place.name)).collect(),
        next: net.boxes.iter().map(|place| next(place, file)).collect(),
    }
}

/// By signal behind those of words and boxes: the member of a token in hand that it is; `None`: it belongs to no token.
pub(crate) fn hands(net: &Net, names: &ClassNames) -> Vec<Option<String>> {
    let mut hands = Vec::new();
    for (place, member) in net.boxes.iter().zip(&names.boxes) {
        if let Some(class) = place.class {
            let attributes = &names.classes[class.0 as usize].members;
            hands.extend(attributes.iter().map(|attribute| Some(format!("{HAND}.{member}.{attribute}"))));
        }
        if place.asks() {
            hands.extend([None, None]);
        }
    }
    hands
}

/// The boxes whose tokens carry attributes.
fn carriers(net: &Net) -> impl Iterator<Item = (usize, &NetBox)> {
    net.boxes.iter().enumerate().filter(|(_, place)| carries(net, place))
}

/// Whether any token carries attributes.
pub(crate) fn any(net: &Net) -> bool {
    carriers(net).next().is_some()
}

/// Writes the structs of classes that are not `declared` yet.
pub(crate) fn structs<'n>(out: &mut String, net: &Net, names: &'n ClassNames, declared: &mut Vec<&'n str>) {
    for (index, (class, name)) in net.classes.iter().zip(&names.classes).enumerate() {
        let used = carriers(net).any(|(_, place)| place.class.is_some_and(|class| class.0 as usize == index));
        if !used || declared.contains(&name.tag.as_str()) {
            continue;
        }
        declared.push(&name.tag);
        let _ = writeln!(out, "/* A token of the class {}. */\nstruct {} {{", class.name, name.tag);
        for (attribute, member) in class.attributes.iter().zip(&name.members) {
            let _ = writeln!(out, "    {} {member};", c_scalar(attribute.scalar));
        }
        out.push_str("};\n\n");
    }
}

/// Writes the members of an instance for tokens.
pub(crate) fn members(out: &mut String, net: &Net, names: &ClassNames) {
    if !any(net) {
        return;
    }
    let tag = |place: &NetBox| place.class.map_or("", |class| names.classes[class.0 as usize].tag.as_str());
    out.push_str("    struct {\n");
    for (i, place) in carriers(net) {
        let _ = writeln!(out, "        struct {} {};", tag(place), names.boxes[i]);
    }
    let _ = writeln!(out, "    }} {HAND}; /* of each box the token that a statement sees */\n    struct {{");
    for (i, place) in carriers(net) {
        let _ = writeln!(out, "        struct {} {}[{}];", tag(place), names.boxes[i], place.capacity.unwrap_or(1));
    }
    let _ = writeln!(out, "    }} {TOKENS};");
}

/// Adds what tokens take: one in each hand, and those in boxes.
pub(crate) fn extent(extent: &mut Extent, net: &Net, width: Width) {
    let (mut hands, mut tokens) = (Extent::default(), Extent::default());
    for (_, place) in carriers(net) {
        let mut token = Extent::default();
        for attribute in net.attributes(place) {
            token.add(element_extent(c_scalar(attribute.scalar), width), 1);
        }
        hands.add(token, 1);
        tokens.add(token, u64::from(place.capacity.unwrap_or(1)));
    }
    extent.add(hands, 1);
    extent.add(tokens, 1);
}

/// Writes the new tokens of classes that are used in `text`.
pub(crate) fn fresh(out: &mut String, program: &Program, net: &Net, names: &ClassNames, text: &str) {
    for (class, name) in
        net.classes.iter().zip(&names.classes).filter(|(_, name)| text.contains(&format!("{};", name.fresh)))
    {
        let mut values = Vec::new();
        for attribute in &class.attributes {
            let mut value = String::new();
            crate::text::element(&mut value, &attribute.initial, 0, attribute.scalar, program.width);
            values.push(value);
        }
        let _ = writeln!(out, "static const struct {} {} = {{{}}};\n", name.tag, name.fresh, values.join(", "));
    }
}

/// Writes what tokens at the start carry.
pub(crate) fn start(out: &mut String, program: &Program, net: &Net, names: &ClassNames) {
    for (i, place) in carriers(net) {
        let Some(class) = place.class.map(|class| &names.classes[class.0 as usize]) else {
            continue;
        };
        for token in 0..place.initial {
            let attributes = net.attributes(place).iter().zip(&place.presets).zip(&class.members);
            for ((attribute, preset), member) in attributes.filter(|((_, preset), _)| !is_zero(preset)) {
                let mut value = String::new();
                crate::text::element(&mut value, preset, 0, attribute.scalar, program.width);
                let _ = writeln!(out, "    self->{TOKENS}.{}[{token}].{member} = {value};", names.boxes[i]);
            }
        }
    }
}

fn is_zero(value: &Value) -> bool {
    crate::text::number(value, 0).is_zero()
}

/// Whether a box gives its last token first.
pub(crate) fn is_lifo(net: &Net, id: BoxId) -> bool {
    matches!(net.place(id).order, Order::Lifo)
}
