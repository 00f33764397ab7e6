//! `NAME_example.c` and the Makefile.

use crate::context::Context;
use std::fmt::Write;

/// A main of fifteen lines.
pub(crate) fn example(cx: &Context<'_>) -> String {
    let name = &cx.name;
    let border = &cx.layout.border;
    let inputs = border.inputs.first().map_or_else(
        || "there are no inputs".to_owned(),
        |(input, _)| format!("write controller.in.{input} and the other inputs here"),
    );
    let outputs = border.outputs.first().map_or_else(
        || "there are no outputs".to_owned(),
        |(output, _)| format!("read controller.out.{output} and the other outputs here"),
    );
    format!(
        "/* Ten scans of {name}. On a target, a timer of the scan period calls the inside of the loop. */
#include \"{name}.h\"

static {name} controller;

int main(void)
{{
    {name}_init(&controller);
    for (int scan = 0; scan < 10; scan++) {{
        /* {inputs} */
        {name}_step(&controller);
        /* {outputs} */
    }}
    return controller.scan == 10 ? 0 : 1;
}}
"
    )
}

/// Builds the library and the example with plain make.
pub(crate) fn makefile(name: &str, folders: &[String], sources: &[String]) -> String {
    let mut out =
        format!("# Builds lib{name}.a and {name}_example. CC, AR and CFLAGS can be given on the command line.\n");
    let _ = write!(out, "CFLAGS ?= -O2\nPCL2_FLAGS = -std=c99 -ffp-contract=off -I.");
    for folder in folders {
        let _ = write!(out, " -I{folder}");
    }
    let _ = write!(out, "\nOBJECTS =");
    for source in sources {
        let _ = write!(out, " \\\n  {}.o", source.strip_suffix(".c").unwrap_or(source));
    }
    let _ = write!(
        out,
        "

all: lib{name}.a {name}_example

lib{name}.a: $(OBJECTS)
\trm -f $@
\t$(AR) rc $@ $(OBJECTS)

{name}_example: {name}_example.o lib{name}.a
\t$(CC) $(CFLAGS) $(LDFLAGS) -o $@ {name}_example.o lib{name}.a -lm

.c.o:
\t$(CC) $(PCL2_FLAGS) $(CFLAGS) -c -o $@ $<

clean:
\trm -f $(OBJECTS) {name}_example.o lib{name}.a {name}_example

.PHONY: all clean
"
    );
    out
}
