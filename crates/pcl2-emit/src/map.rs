//! `NAME_map.c`: every point with its place.

use crate::context::Context;
use crate::points::Points;
use std::fmt::Write;

/// Writes the map; uses the rows up.
pub(crate) fn map(cx: &Context<'_>, points: &mut Points) -> String {
    let name = &cx.name;
    let mut out = String::new();
    let _ = writeln!(out, "/* Names, places, types and ranges of everything in an instance of {name}. */");
    let _ = writeln!(out, "#include \"{name}.h\"\n\n#include <stddef.h>\n");
    if points.count == 0 {
        let _ = writeln!(out, "const struct pcl2_map {name}_map = {{\n{}    0, NULL, NULL,\n}};", facts(cx));
        return out;
    }
    let _ = writeln!(out, "/* Unit, range, rows, columns, type, access, retained. */");
    let _ = writeln!(out, "static const struct pcl2_kind {name}_kinds[{}] = {{", points.kinds.len());
    for kind in &points.kinds {
        let _ = writeln!(out, "    {},", kind.c);
    }
    let _ = writeln!(out, "}};\n\nstatic const struct pcl2_point {name}_points[{}] = {{", points.count);
    let mut rows = std::mem::take(&mut points.rows);
    rows.insert_str(0, &out);
    let _ = writeln!(
        rows,
        "}};\n\nconst struct pcl2_map {name}_map = {{\n{}    {}, {name}_points, {name}_kinds,\n}};",
        facts(cx),
        points.count
    );
    rows
}

/// Name, layout, period and size.
fn facts(cx: &Context<'_>) -> String {
    let (name, period) = (&cx.name, cx.program.period.unwrap_or(0));
    format!("    \"{name}\", {name}_LAYOUT, INT64_C({period}), sizeof({name}),\n")
}
