//! A document as one HTML file that needs no other.

use super::document::{Cell, Content, Document, Style, Table};
use std::fmt::Write;

/// Elements are styled by their names: the picture's style sheet has the classes.
const STYLE: &str = "\
body{margin:0;font:15px/1.45 system-ui,'DejaVu Sans',Arial,sans-serif;color:#1d2939;background:#fff}
main{max-width:1180px;margin:0 auto;padding:24px}
nav{columns:3;font-size:13px;border-top:1px solid #d0d5dd;border-bottom:1px solid #d0d5dd;padding:10px 0}
nav a{display:block}
a{color:#175cd3;text-decoration:none}
h1{font-size:28px;margin:8px 0}
h2{font-size:20px;margin:36px 0 8px;border-bottom:1px solid #d0d5dd}
h3{font-size:16px;margin:24px 0 6px}
pre,code{font-family:ui-monospace,'DejaVu Sans Mono',Menlo,Consolas,monospace;font-size:12.5px}
pre{background:#f6f7f9;border:1px solid #e4e7ec;padding:10px;overflow:auto;line-height:1.35}
figure{margin:12px 0;overflow:auto;border:1px solid #e4e7ec}
table{border-collapse:collapse;margin:8px 0;font-size:13px}
th,td{border:1px solid #d0d5dd;padding:3px 8px;text-align:left;vertical-align:top}
th{background:#f2f4f7}
tr{break-inside:avoid}
h2,h3{break-after:avoid}
@media print{nav{display:none}pre{font-size:8px;overflow:visible}figure{border:0;overflow:visible}
figure svg{max-width:100%;height:auto}}
";

/// Writes a document.
pub(super) fn write(document: &Document, picture: &str) -> String {
    let mut text = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width\"/>\n<title>{}</title>\n<style>\n{STYLE}</style>\n\
         </head>\n<body>\n<main>\n",
        escape(&document.title)
    );
    for (i, section) in document.sections.iter().enumerate() {
        let level = section.level.clamp(1, 6);
        let _ = writeln!(text, "<h{level} id=\"s{i}\">{}</h{level}>", escape(&section.title));
        section.content.iter().for_each(|content| put(&mut text, content, picture));
        if i == 0 {
            put_contents(&mut text, document);
        }
    }
    text.push_str("</main>\n</body>\n</html>\n");
    text
}

/// Links to the chapters.
fn put_contents(text: &mut String, document: &Document) {
    text.push_str("<nav>\n");
    for (i, section) in document.sections.iter().enumerate().filter(|(_, section)| section.level == 2) {
        let _ = writeln!(text, "<a href=\"#s{i}\">{}</a>", escape(&section.title));
    }
    text.push_str("</nav>\n");
}

fn put(text: &mut String, content: &Content, picture: &str) {
    let _ = match content {
        Content::Words(words) => writeln!(text, "<p>{}</p>", escape(words)),
        Content::Code(lines) => writeln!(text, "<pre>{}</pre>", escape(lines.trim_end())),
        Content::Picture => writeln!(text, "<figure>\n{}</figure>", picture),
        Content::Table(table) => put_table(text, table),
    };
}

fn put_table(text: &mut String, table: &Table) -> std::fmt::Result {
    text.push_str("<table>\n<thead><tr>");
    for (head, _) in &table.columns {
        write!(text, "<th>{}</th>", escape(head))?;
    }
    text.push_str("</tr></thead>\n<tbody>\n");
    for row in &table.rows {
        text.push_str("<tr>");
        for (cell, (_, style)) in row.iter().zip(&table.columns) {
            put_cell(text, cell, *style)?;
        }
        text.push_str("</tr>\n");
    }
    writeln!(text, "</tbody>\n</table>")
}

fn put_cell(text: &mut String, cell: &Cell, style: Style) -> std::fmt::Result {
    let lines: Vec<String> = cell.iter().map(|line| escape(line)).collect();
    let lines = lines.join("<br/>");
    match style {
        Style::Words => write!(text, "<td>{lines}</td>"),
        Style::Number => write!(text, "<td style=\"text-align:right\">{lines}</td>"),
        Style::Code if lines.is_empty() => write!(text, "<td></td>"),
        Style::Code => write!(text, "<td><code>{lines}</code></td>"),
    }
}

/// A text as content. Characters that HTML does not have are replaced.
fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\n' | '\t' => escaped.push(letter),
            _ if letter.is_control() => escaped.push('\u{fffd}'),
            _ => escaped.push(letter),
        }
    }
    escaped
}
