//! Generated programs: N control loops of one lag, one controller and two arithmetic lines.

use super::tools;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// How the loops are written.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Style {
    /// Four lines each.
    Straight,
    /// One line each, a composite.
    Composite,
}

/// The composite of one loop.
const COMPOSITE: &str = "\
! One control loop: a lag as plant, the controller, the feed-forward, the valve's signal.
real y, real u = loop ( real w : real a, real b, real K, real Ti )
BODY
1 y = first ( u : a, b, )
2 v = pid ( y, w : K = K, Ti = Ti )
3 f = 0.1*(w - y)
4 u = v + f
END
";

/// Writes `loops.cfg` with N loops at one set-point, and the composite, into a folder. The text is not kept: the peak
/// memory of this process would count as that of the programs it starts.
pub(crate) fn write_loops(folder: &Path, count: usize, style: Style) -> Result<PathBuf, String> {
    let source = folder.join("loops.cfg");
    write_source(&source, count, style).map_err(|error| format!("{}: {error}", source.display()))?;
    tools::write(&folder.join("loop.fc"), COMPOSITE)?;
    Ok(source)
}

fn write_source(source: &Path, count: usize, style: Style) -> std::io::Result<()> {
    let mut out = BufWriter::new(File::create(source)?);
    out.write_all(b"CONTROL\n1 w = msc ( : 50. )\n")?;
    for i in 0..count {
        let a = 10 + i % 10;
        match style {
            Style::Straight => straight(&mut out, i, a),
            Style::Composite => writeln!(out, "{} y{i}, u{i} = loop ( w : 0.{a}, 0.2, 0.8, 20. )", 2 * i + 2),
        }?;
    }
    out.write_all(b"END\n")?;
    out.flush()
}

fn straight(out: &mut impl Write, i: usize, a: usize) -> std::io::Result<()> {
    let n = 4 * i + 2;
    writeln!(out, "{n} y{i} = first ( u{i} : 0.{a}, 0.2, )")?;
    writeln!(out, "{} v{i} = pid ( y{i}, w : K = 0.8, Ti = 20. )", n + 1)?;
    writeln!(out, "{} f{i} = 0.1*(w - y{i})", n + 2)?;
    writeln!(out, "{} u{i} = v{i} + f{i}", n + 3)
}
