//! What all pictures share: text made fit for XML, widths of text, coordinates.

use std::fmt::Write;

/// The font of all pictures. Fixed pitch: a text's width is known without the font.
pub const FONT: &str = "ui-monospace, 'DejaVu Sans Mono', Menlo, Consolas, monospace";

/// The widest pitch of common fixed-pitch fonts, in thousandths of the font size.
const PITCH: i32 = 610;

/// The width of a text in pixels.
pub fn width(text: &str, size: i32) -> i32 {
    let characters = i32::try_from(text.chars().count()).unwrap_or(i32::MAX / 100_000);
    (characters.saturating_mul(size).saturating_mul(PITCH) + 999) / 1000
}

/// A text of at most so many characters; what is cut off is shown as an ellipsis.
pub fn brief(text: &str, limit: usize) -> String {
    if text.chars().count() <= limit {
        return text.to_owned();
    }
    text.chars().take(limit.saturating_sub(1)).chain(['…']).collect()
}

/// The same, cut between two words where there are several.
pub fn brief_words(text: &str, limit: usize) -> String {
    let brief = brief(text, limit);
    match brief.rsplit_once(' ') {
        Some((words, _)) if brief != text => format!("{words} …"),
        Some(_) | None => brief,
    }
}

/// A text as XML content or inside quotes. Characters that XML does not have are replaced.
pub fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            '\n' | '\t' => escaped.push(letter),
            '\u{0}'..='\u{1f}' | '\u{7f}'..='\u{9f}' | '\u{fffe}' | '\u{ffff}' => escaped.push('\u{fffd}'),
            _ => escaped.push(letter),
        }
    }
    escaped
}

/// Opens a picture of a size, with its title for readers that cannot see it, and its style sheet.
pub fn open(width: i32, height: i32, title: &str, style: &str) -> String {
    let mut text = String::new();
    let _ = write!(
        text,
        "<svg xmlns='http://www.w3.org/2000/svg' width='{width}' height='{height}' viewBox='0 0 {width} {height}' \
         role='img' font-family=\"{FONT}\">\n<title>{}</title>\n<style>\n{style}</style>\n\
         <rect class='paper' width='{width}' height='{height}'/>\n",
        escape(title)
    );
    text
}

/// Closes a picture.
pub fn close(text: &mut String) {
    text.push_str("</svg>\n");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_xml_keeps_for_itself_is_escaped() {
        assert_eq!(escape("a<b & 'c' > \"d\"\u{1}"), "a&lt;b &amp; &#39;c&#39; &gt; &quot;d&quot;\u{fffd}");
    }

    #[test]
    fn long_texts_are_cut() {
        assert_eq!(brief("temperature", 6), "tempe…");
        assert_eq!(brief("level", 5), "level");
        assert_eq!(brief_words("the level of a tank", 12), "the level …");
        assert_eq!(brief_words("a level", 7), "a level");
        assert_eq!(brief_words("temperature", 6), "tempe…");
    }
}
