//! What the compiler has to say, and where.

use crate::codes::Code;
use crate::source::{Sources, Span};

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The program has no meaning.
    Error,
    /// The program runs; something in it is probably not what was meant.
    Warning,
}

impl Severity {
    /// `error` or `warning`.
    pub fn word(self) -> &'static str {
        match self {
            Severity::Error => "error",
            Severity::Warning => "warning",
        }
    }
}

/// Another place that belongs to a diagnostic.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The place.
    pub span: Span,
    /// What is there.
    pub message: String,
}

/// One message: code, place, what was expected and found, other places, what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Its row in the table.
    pub code: Code,
    /// The code's own severity, or an error with `--strict`.
    pub severity: Severity,
    /// The offending token, not the statement.
    pub span: Span,
    /// Lower case; what was expected first, then what was found.
    pub message: String,
    /// Other places.
    pub labels: Vec<Label>,
    /// What to do.
    pub help: Option<String>,
}

impl Diagnostic {
    /// A diagnostic with the code's own severity.
    pub fn new(code: Code, span: Span, message: impl Into<String>) -> Diagnostic {
        let message = shorten(message.into());
        Diagnostic { code, severity: code.severity(), span, message, labels: Vec::new(), help: None }
    }

    /// Adds another place.
    #[must_use]
    pub fn label(mut self, span: Span, message: impl Into<String>) -> Diagnostic {
        self.labels.push(Label { span, message: message.into() });
        self
    }

    /// Says what to do.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Diagnostic {
        self.help = Some(help.into());
        self
    }

    /// Whether it is an error.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}

/// A message may quote what was written, which may be a million characters.
fn shorten(mut message: String) -> String {
    let longest = 400;
    if let Some((end, _)) = message.char_indices().nth(longest) {
        message.truncate(end);
        message.push_str(" ..");
    }
    message
}

/// The most errors that one run reports.
pub const MAX_ERRORS: usize = 100;

/// Warnings beyond this many messages are dropped: they would not be shown.
const MAX_WARNINGS: usize = 1000;

/// Reports a warning, unless there is more to say already than anybody reads.
pub fn warn(diagnostics: &mut Vec<Diagnostic>, warning: Diagnostic) {
    if diagnostics.len() < MAX_WARNINGS {
        diagnostics.push(warning);
    }
}

/// Whether there are so many errors that looking for more is of no use. Warnings never get there.
pub fn enough(diagnostics: &[Diagnostic]) -> bool {
    diagnostics.len() > 2 * MAX_WARNINGS
}

/// Sorts by file, line and column, drops repetitions, and cuts the list after [`MAX_ERRORS`] errors.
/// Returns how many errors were cut.
pub fn finish(diagnostics: &mut Vec<Diagnostic>, strict: bool) -> usize {
    diagnostics.sort_by(|a, b| (a.span, a.code, &a.message).cmp(&(b.span, b.code, &b.message)));
    diagnostics.dedup();
    if strict {
        for diagnostic in diagnostics.iter_mut() {
            diagnostic.severity = Severity::Error;
        }
    }
    let mut errors = 0;
    let mut warnings = 0;
    diagnostics.retain(|diagnostic| {
        let count = if diagnostic.is_error() { &mut errors } else { &mut warnings };
        *count += 1;
        *count <= MAX_ERRORS
    });
    errors.saturating_sub(MAX_ERRORS)
}

/// One diagnostic as one line of JSON (`check --format json`).
pub fn to_json(diagnostic: &Diagnostic, sources: &Sources) -> String {
    let mut object = place_json(diagnostic.span, sources);
    object.insert("severity".into(), diagnostic.severity.word().into());
    object.insert("code".into(), diagnostic.code.name().into());
    object.insert("message".into(), diagnostic.message.clone().into());
    let labels: Vec<serde_json::Value> = diagnostic
        .labels
        .iter()
        .map(|label| {
            let mut place = place_json(label.span, sources);
            place.insert("message".into(), label.message.clone().into());
            place.into()
        })
        .collect();
    object.insert("labels".into(), labels.into());
    object.insert("help".into(), diagnostic.help.clone().into());
    serde_json::Value::from(object).to_string()
}

fn place_json(span: Span, sources: &Sources) -> serde_json::Map<String, serde_json::Value> {
    let (start, end) = sources.positions(span);
    let mut object = serde_json::Map::new();
    object.insert("file".into(), sources.file(span.file).name.clone().into());
    object.insert("line".into(), start.line.into());
    object.insert("column".into(), start.column.into());
    object.insert("end_line".into(), end.line.into());
    object.insert("end_column".into(), end.column.into());
    object
}
