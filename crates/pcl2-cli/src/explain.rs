//! `pcl2 explain`

use crate::args::ExplainArgs;
use crate::console;
use crate::outcome::Outcome;
use pcl2_lang::catalogue;
use pcl2_lang::suggest;

/// Prints a diagnostic's page.
pub(crate) fn explain(args: &ExplainArgs) -> Outcome {
    let code = args.code.to_ascii_uppercase();
    let page = |(name, _): &&(&str, &str)| name.strip_suffix(".md") == Some(code.as_str());
    if let Some((_, text)) = catalogue::pages().iter().find(page) {
        return console::answer(text);
    }
    let known = catalogue::pages().iter().filter_map(|(name, _)| name.strip_suffix(".md"));
    let help = suggest::help(&code, known).unwrap_or_else(|| "codes look like P0203".to_owned());
    console::error(&format!("no diagnostic has the code `{}`; {help}", args.code));
    Outcome::Usage
}
