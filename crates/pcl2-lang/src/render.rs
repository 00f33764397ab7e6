//! Diagnostics as text for people.

use crate::diagnostic::{Diagnostic, Severity};
use crate::source::{FileId, Sources};
use codespan_reporting::diagnostic as cr;
use codespan_reporting::files::{Error, Files};
use codespan_reporting::term;

/// Lines longer than this are cut to the part around the message.
const LONG_LINE: u32 = 400;

struct View<'a>(&'a Sources);

impl<'a> Files<'a> for View<'a> {
    type FileId = FileId;
    type Name = &'a str;
    type Source = &'a str;

    fn name(&'a self, id: FileId) -> Result<&'a str, Error> {
        Ok(&self.0.file(id).name)
    }

    fn source(&'a self, id: FileId) -> Result<&'a str, Error> {
        Ok(self.0.file(id).shown())
    }

    fn line_index(&'a self, id: FileId, byte: usize) -> Result<usize, Error> {
        Ok(self.0.file(id).position(byte as u32).line as usize - 1)
    }

    fn line_range(&'a self, id: FileId, index: usize) -> Result<std::ops::Range<usize>, Error> {
        let (start, end) = self.0.file(id).line_range(index as u32 + 1);
        Ok(start as usize..end as usize)
    }
}

/// Renders one diagnostic; with `color` for a terminal.
pub fn render(diagnostic: &Diagnostic, sources: &Sources, color: bool) -> String {
    if on_a_long_line(diagnostic, sources) {
        return short(diagnostic, sources);
    }
    let severity = match diagnostic.severity {
        Severity::Error => cr::Severity::Error,
        Severity::Warning => cr::Severity::Warning,
    };
    let mut labels = vec![cr::Label::primary(diagnostic.span.file, range(diagnostic.span, sources))];
    labels.extend(
        diagnostic.labels.iter().map(|label| {
            cr::Label::secondary(label.span.file, range(label.span, sources)).with_message(&label.message)
        }),
    );
    let report = cr::Diagnostic::new(severity)
        .with_code(diagnostic.code.name())
        .with_message(&diagnostic.message)
        .with_labels(labels)
        .with_notes(diagnostic.help.iter().map(|help| format!("help: {help}")).collect());
    let mut bytes = Vec::new();
    match write(&mut bytes, sources, &report, color) {
        Ok(()) => String::from_utf8_lossy(&bytes).into_owned(),
        Err(_) => short(diagnostic, sources),
    }
}

fn write(bytes: &mut Vec<u8>, sources: &Sources, report: &cr::Diagnostic<FileId>, color: bool) -> Result<(), Error> {
    let config = term::Config::default();
    if color {
        let styles = term::Styles::default();
        let mut ansi = term::termcolor::Ansi::new(bytes);
        let mut writer = term::StylesWriter::new(&mut ansi, &styles);
        term::emit_to_write_style(&mut writer, &config, &View(sources), report)
    } else {
        term::emit_to_io_write(bytes, &config, &View(sources), report)
    }
}

/// The span's bytes, kept on its first line and inside the file.
fn range(span: crate::source::Span, sources: &Sources) -> std::ops::Range<usize> {
    let file = sources.file(span.file);
    let length = file.text.len() as u32;
    let start = span.start.min(length);
    let (_, line_end) = file.line_range(file.position(start).line);
    let end = span.end.min(line_end).max(start);
    start as usize..end as usize
}

fn on_a_long_line(diagnostic: &Diagnostic, sources: &Sources) -> bool {
    let spans = std::iter::once(diagnostic.span).chain(diagnostic.labels.iter().map(|label| label.span));
    let mut lengths = spans.map(|span| {
        let file = sources.file(span.file);
        let (start, end) = file.line_range(file.position(span.start).line);
        end - start
    });
    lengths.any(|length| length > LONG_LINE)
}

/// Without the source line.
fn short(diagnostic: &Diagnostic, sources: &Sources) -> String {
    let place = |span| {
        let (start, _) = sources.positions(span);
        format!("{}:{}:{}", sources.file(span.file).name, start.line, start.column)
    };
    let (word, code) = (diagnostic.severity.word(), diagnostic.code.name());
    let mut text = format!("{word}[{code}]: {}\n  at {}\n", diagnostic.message, place(diagnostic.span));
    for label in &diagnostic.labels {
        text.push_str(&format!("  {}: {}\n", place(label.span), label.message));
    }
    if let Some(help) = &diagnostic.help {
        text.push_str(&format!("  = help: {help}\n"));
    }
    text
}
