//! Beginnings of new blocks and cases: what they cannot do without, to be filled in.

use crate::shell::{root, say};
use std::fs;
use std::path::Path;

/// Begins a function code.
pub(crate) fn new_block(group: &str, code: &str) -> Result<(), String> {
    check_name(group)?;
    check_name(code)?;
    let declaration = root().join("blocks").join(group).join(format!("{code}.fc"));
    let kernel = root().join("runtime-c/src").join(group).join(format!("{code}.c"));
    create(&declaration, &declaration_text(code))?;
    create(&kernel, &kernel_text(code))?;
    say("fill in equation, source, ranges and example; `cargo xtask test` checks them");
    Ok(())
}

/// Begins a golden case.
pub(crate) fn new_case(name: &str) -> Result<(), String> {
    check_name(name)?;
    let folder = root().join("tests/cases").join(name);
    create(&folder.join("main.cfg"), "CONTROL\n1 y = msc ( : 1. )\nEND\n")?;
    create(
        &folder.join("pcl2.toml"),
        &format!("[controller]\nname = \"{name}\"\nsource = \"main.cfg\"\nperiod = 0.1\n"),
    )?;
    create(&folder.join("case.toml"), "steps = 10\n")?;
    say("put beside main.cfg what is expected of it: trace.csv, or `! error: P0203` at the end of a line");
    Ok(())
}

fn check_name(name: &str) -> Result<(), String> {
    let legal = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_';
    let starts = name.bytes().next().is_some_and(|byte| byte.is_ascii_alphabetic());
    if starts && name.bytes().all(legal) {
        Ok(())
    } else {
        Err(format!("`{name}` is no name: letters, digits and `_`"))
    }
}

fn create(path: &Path, text: &str) -> Result<(), String> {
    let shown = path.display();
    if path.exists() {
        return Err(format!("{shown} exists"));
    }
    let folder = path.parent().ok_or_else(|| format!("{shown} has no folder"))?;
    fs::create_dir_all(folder).and_then(|()| fs::write(path, text)).map_err(|error| format!("{shown}: {error}"))?;
    say(&format!("created {shown}"));
    Ok(())
}

fn declaration_text(code: &str) -> String {
    format!(
        "! The output is the input times K: y = K x.\n\
         ! Source: the textbook or standard that defines it.\n\
         real y = {code} ( real x : real K = 1. )\n\
         MEMORY real before\n\
         BAD H\n\
         EXAMPLE y = 6.\n\
         1 x = msc ( : 3. )\n\
         2 y = {code} ( x : 2. )\n\
         END\n"
    )
}

fn kernel_text(code: &str) -> String {
    format!(
        "#include \"pcl2_{code}.h\"\n\n\
         PCL2_KERNEL void pcl2_{code}_init(struct pcl2_{code} *self, pcl2_real K)\n\
         {{\n    (void)K;\n    self->before = PCL2_R(0.0);\n}}\n\n\
         PCL2_KERNEL void pcl2_{code}(struct pcl2_{code} *self, pcl2_real x, pcl2_real K)\n\
         {{\n    if (!pcl2_is_bad(x)) {{\n        self->before = K * x;\n    }}\n    self->y = self->before;\n}}\n"
    )
}
