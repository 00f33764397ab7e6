//! Generated programs: N control loops of one lag, one controller and two arithmetic lines.

use super::tools;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// How the loops are written.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Style {
    /// Four lines each.
    Straight,
    /// One line each, a composite.
    Composite,
}

/// The composite of one loop; see [`loops`].
const COMPOSITE: &str = "\
! One control loop: a lag as plant, the error, a lag as the controller's memory, the controller's output.
real y, real u = loop ( real w : real a, real b, real c, real d )
BODY
1 y = first ( u : a, b, )
2 e = sumII ( 1, w, y, 2 : 1., -1. )
3 i = first ( e : c, d, )
4 u = sumII ( 1, e, i, 2 : 0.8, 1. )
END
";

/// The text of N loops at one set-point.
pub(crate) fn loops(count: usize, style: Style) -> String {
    let mut text = String::from("CONTROL\n1 w = msc ( : 50. )\n");
    for i in 0..count {
        let a = 10 + i % 10;
        let _ = match style {
            Style::Straight => straight(&mut text, i, a),
            Style::Composite => writeln!(text, "{} y{i}, u{i} = loop ( w : 0.{a}, 0.2, 0.5, 0.05 )", 2 * i + 2),
        };
    }
    text + "END\n"
}

fn straight(text: &mut String, i: usize, a: usize) -> std::fmt::Result {
    let n = 4 * i + 2;
    writeln!(text, "{n} y{i} = first ( u{i} : 0.{a}, 0.2, )")?;
    writeln!(text, "{} e{i} = sumII ( 1, w, y{i}, 2 : 1., -1. )", n + 1)?;
    writeln!(text, "{} i{i} = first ( e{i} : 0.5, 0.05, )", n + 2)?;
    writeln!(text, "{} u{i} = sumII ( 1, e{i}, i{i}, 2 : 0.8, 1. )", n + 3)
}

/// Writes `loops.cfg` and the composite into a folder.
pub(crate) fn write_loops(folder: &Path, count: usize, style: Style) -> Result<PathBuf, String> {
    let source = folder.join("loops.cfg");
    tools::write(&source, &loops(count, style))?;
    tools::write(&folder.join("loop.fc"), COMPOSITE)?;
    Ok(source)
}
