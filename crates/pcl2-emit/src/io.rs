//! `NAME_io.c`: the physical points of the program's words.

use crate::context::Context;
use crate::layout::Crossing;
use crate::text;
use pcl2_lang::program::Binding;
use pcl2_lang::types::{Real, Scalar};
use std::fmt::Write;

/// Writes the table of points; `None` when nothing of this part is bound.
pub(crate) fn io(cx: &Context<'_>) -> Option<String> {
    let bound = bound(cx);
    if bound.is_empty() {
        return None;
    }
    let name = &cx.name;
    let mut out = format!(
        "/* The physical points of {name}: for pcl2_latch and pcl2_deliver. Leave this file out for I/O of your own. */\n\
         #include \"{name}.h\"\n\n#include \"pcl2_io.h\"\n\n#include <stddef.h>\n\n\
         const struct pcl2_io_point {name}_io[{count}] = {{\n",
        count = bound.len()
    );
    for (binding, word) in bound {
        row(&mut out, cx, binding, &word);
    }
    out.push_str("};\n");
    Some(out)
}

/// How many points of this part are bound.
pub(crate) fn points(cx: &Context<'_>) -> usize {
    bound(cx).len()
}

fn bound<'c>(cx: &'c Context<'_>) -> Vec<(&'c Binding, Word)> {
    let bindings = cx.program.bindings.iter();
    bindings.filter_map(|binding| word(cx, &binding.name).map(|word| (binding, word))).collect()
}

/// A word of the instance.
struct Word {
    place: String,
    to_plant: bool,
    scalar: Scalar,
}

fn word(cx: &Context<'_>, name: &str) -> Option<Word> {
    let border = &cx.layout.border;
    let find = |list: &[(std::borrow::Cow<'_, str>, Crossing)], member: &str, to_plant: bool| {
        list.iter().find_map(|(field, crossing)| {
            let (known, scalar) = match crossing {
                Crossing::Signal(id) => {
                    let signal = cx.program.main().signal(*id);
                    (&signal.name, signal.ty.scalar)
                }
                Crossing::Image(id) => {
                    let image = &cx.program.images[id.0 as usize];
                    (&image.name, image.scalar)
                }
            };
            (known == name).then(|| Word { place: format!("{member}.{field}"), to_plant, scalar })
        })
    };
    find(&border.inputs, "in", false).or_else(|| find(&border.outputs, "out", true))
}

fn row(out: &mut String, cx: &Context<'_>, binding: &Binding, word: &Word) {
    let real = |out: &mut String, value: Real| text::real(out, value, cx.program.width);
    out.push_str("    {");
    text::string(out, &binding.point);
    out.push_str(", ");
    text::string(out, &binding.name);
    let flag = i32::from;
    let _ = write!(
        out,
        ", offsetof({}, {}), {}, {}, {}, {}, ",
        cx.name,
        word.place,
        flag(word.to_plant),
        flag(word.scalar == Scalar::Int),
        flag(binding.hold),
        flag(binding.fail.is_some())
    );
    real(out, binding.gain);
    out.push_str(", ");
    real(out, binding.bias);
    out.push_str(", ");
    real(out, binding.fail.unwrap_or(Real::ZERO));
    out.push_str("},\n");
}
