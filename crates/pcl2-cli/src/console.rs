//! The terminal. A closed pipe is no error: whoever reads has seen enough.

use crate::outcome::Outcome;
use pcl2_lang::diagnostic::Diagnostic;
use pcl2_lang::render;
use pcl2_lang::source::Sources;
use std::io::{ErrorKind, IsTerminal, Write};

/// Writes a command's answer to standard output: one that is lost is a failure.
#[must_use]
pub(crate) fn answer(text: &str) -> Outcome {
    let mut stdout = std::io::stdout().lock();
    arrived(stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()))
}

/// How writing to standard output ended.
pub(crate) fn arrived(written: std::io::Result<()>) -> Outcome {
    match written {
        Err(why) if why.kind() != ErrorKind::BrokenPipe => {
            error(&format!("cannot write to standard output: {why}"));
            Outcome::Failed
        }
        Ok(()) | Err(_) => Outcome::Done,
    }
}

/// Writes one line to standard error.
pub(crate) fn err(line: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}

/// `error: ..` on standard error, for what has no place in a source.
pub(crate) fn error(message: &str) {
    err(&format!("error: {message}"));
}

/// Whether standard error is a terminal that may get colours and progress bars.
pub(crate) fn interactive() -> bool {
    std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none()
}

/// Prints diagnostics for people.
pub(crate) fn diagnostics(list: &[Diagnostic], sources: &Sources, left_out: usize) {
    let color = interactive();
    let mut text = String::new();
    for diagnostic in list {
        text.push_str(&render::render(diagnostic, sources, color));
        text.push('\n');
    }
    if left_out > 0 {
        text.push_str(&format!("{left_out} more errors are not shown\n"));
    }
    let _ = std::io::stderr().lock().write_all(text.as_bytes());
}
