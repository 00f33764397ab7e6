//! `NAME_tune`: hands the sets to the table.

use crate::context::Context;
use crate::rows::Rows;
use std::fmt::Write;

/// Writes `NAME_tune`.
pub(crate) fn function(out: &mut String, cx: &Context<'_>, rows: &Rows) {
    let name = &cx.name;
    let _ = writeln!(out, "int {name}_tune({name} *self, struct pcl2_set *sets, int32_t n)\n{{");
    let _ = if rows.any() {
        writeln!(out, "    return pcl2_tune(self, &{name}_table, &self->health, sets, n);\n}}")
    } else {
        writeln!(out, "    (void)self;\n    (void)sets;\n    return n > 0 ? -1 : 0;\n}}")
    };
}
