//! Inline functions that nobody calls, taken out of a C file: in one file with their callers, compilers warn of them.

use rustc_hash::{FxHashMap, FxHashSet};
use std::ops::Range;

/// The text without the `static inline` functions of ours that nothing in it calls, their prototypes and their comments.
/// `ours` tells of each line that no user wrote it: how a user's code is laid out is not known, and whatever word stands
/// in it may be a call.
pub(crate) fn without_unused(text: &str, ours: &[bool]) -> String {
    let lines: Vec<&str> = text.lines().collect();
    let is_ours = |line: usize| ours.get(line).copied().unwrap_or(false);
    let (prototypes, mut functions): (Vec<Function>, Vec<Function>) = functions(&lines)
        .into_iter()
        .filter(|function| function.lines.clone().all(is_ours))
        .partition(|function| lines[function.code.end - 1].ends_with(';'));
    let pasted = (0..lines.len()).any(|line| !is_ours(line) && lines[line].contains("##"));
    if pasted {
        // A name may be put together that stands nowhere.
        return text.to_owned();
    }
    let mut uses = uses(&lines, is_ours);
    prototypes.iter().for_each(|prototype| forget(&mut uses, &lines[prototype.code.clone()]));
    let mut keep = vec![true; lines.len()];
    let mut unused = FxHashSet::default();
    // Without one, those that only it called are unused, too.
    while let Some(at) = functions.iter().rposition(|function| uses.get(function.name) == Some(&1)) {
        let function = functions.remove(at);
        forget(&mut uses, &lines[function.code.clone()]);
        unused.insert(function.name);
        keep[function.lines].fill(false);
    }
    for prototype in prototypes.into_iter().filter(|prototype| unused.contains(prototype.name)) {
        keep[prototype.lines].fill(false);
    }
    let kept = lines.iter().zip(keep).filter(|(_, keep)| *keep).map(|(line, _)| *line);
    kept.flat_map(|line| [line, "\n"]).collect()
}

/// How often each word is used: of a user's lines those in comments and strings, too.
fn uses<'a>(lines: &[&'a str], is_ours: impl Fn(usize) -> bool) -> FxHashMap<&'a str, usize> {
    let mut uses: FxHashMap<&str, usize> = FxHashMap::default();
    let mut count = |word| *uses.entry(word).or_default() += 1;
    let mut in_comment = false;
    for (at, line) in lines.iter().enumerate() {
        if is_ours(at) {
            words(line, &mut in_comment).into_iter().for_each(&mut count);
        } else {
            line.split(|letter| !is_word(letter)).for_each(&mut count);
        }
    }
    uses
}

/// These lines use nothing any more.
fn forget(uses: &mut FxHashMap<&str, usize>, lines: &[&str]) {
    let mut in_comment = false;
    for word in lines.iter().flat_map(|line| words(line, &mut in_comment)) {
        if let Some(uses) = uses.get_mut(word) {
            *uses -= 1;
        }
    }
}

/// A function, or its prototype.
struct Function<'a> {
    name: &'a str,
    code: Range<usize>,
    /// The code with its comment and the empty line below it.
    lines: Range<usize>,
}

fn functions<'a>(lines: &[&'a str]) -> Vec<Function<'a>> {
    let begins = |line: &str| ["static inline ", "PCL2_INLINE "].iter().any(|linkage| line.starts_with(linkage));
    let starts = (0..lines.len()).filter(|i| begins(lines[*i]));
    starts.filter_map(|start| function(lines, start)).collect()
}

fn function<'a>(lines: &[&'a str], start: usize) -> Option<Function<'a>> {
    let name = words(lines[start].split('(').next()?, &mut false).pop().filter(|name| name.starts_with("pcl2_"))?;
    let head = start + lines[start..].iter().position(|line| line.ends_with([';', '{', '}']))?;
    let opens = lines[head].ends_with('{');
    let end = 1 + if opens { head + lines[head..].iter().position(|line| *line == "}")? } else { head };
    let below = if lines.get(end).is_some_and(|line| line.is_empty()) { end + 1 } else { end };
    Some(Function { name, code: start..end, lines: comment(lines, start)..below })
}

/// The first line of the comment that ends just above a line; the line itself, where there is none.
fn comment(lines: &[&str], line: usize) -> usize {
    if !line.checked_sub(1).is_some_and(|above| lines[above].ends_with("*/")) {
        return line;
    }
    (0..line).rev().find(|above| lines[*above].starts_with("/*")).unwrap_or(line)
}

/// The identifiers in a line of C, without those in comments and strings; a comment may go on from line to line.
fn words<'a>(line: &'a str, in_comment: &mut bool) -> Vec<&'a str> {
    let mut words = Vec::new();
    let mut rest = line;
    while let Some(letter) = rest.chars().next() {
        let length = match letter {
            _ if *in_comment => rest.find("*/").map_or(rest.len(), |end| end + 2),
            '/' if rest.starts_with("/*") => 2,
            '"' | '\'' => quoted(rest, letter),
            _ if is_word(letter) => rest.find(|letter| !is_word(letter)).unwrap_or(rest.len()),
            _ => letter.len_utf8(),
        };
        let (word, behind) = rest.split_at(length);
        match *in_comment {
            true => *in_comment = !word.ends_with("*/"),
            false if word == "/*" => *in_comment = true,
            false if is_word(letter) => words.push(word),
            false => {}
        }
        rest = behind;
    }
    words
}

fn is_word(letter: char) -> bool {
    letter.is_ascii_alphanumeric() || letter == '_'
}

/// The length of the string or character that a text begins with.
fn quoted(text: &str, mark: char) -> usize {
    let mut escaped = false;
    for (i, letter) in text.char_indices().skip(1) {
        if letter == mark && !escaped {
            return i + 1;
        }
        escaped = letter == '\\' && !escaped;
    }
    text.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unused_functions_go_with_what_only_they_call() {
        let text = "\
/* What nobody calls. */
static inline int pcl2_four(int x,
                       int y);

/* Doubles. It is called once. */
static inline int pcl2_twice(int x)
{
    return 2 * x;
}

/* Nobody calls pcl2_four,
   whatever a comment or \"pcl2_four\" says. */
static inline int pcl2_four(int x,
                       int y)
{
    /* Two lines
       of one. */
    return pcl2_twice(x) + pcl2_twice(y);
}

/* Called. */
static inline int pcl2_zero(void) { return 0; }
static inline int pcl2_one(void)
{
    return pcl2_zero() + 1;
}

static inline int users(void)
{
    return 2;
}

const char mark = '\"';
const char *text = \"a \\\" /* four\";
int main(void)
{
    return pcl2_one();
}
";
        let (head, tail) = text.split_at(text.find("/* Called. */").unwrap_or_default());
        assert!(head.contains("twice"));
        assert_eq!(without_unused(text, &vec![true; text.lines().count()]), tail);
        assert_eq!(without_unused(text, &[]), text, "a user's");
        let user = format!("{text}// It isn't /* pcl2_four */\n");
        let mut ours = vec![true; text.lines().count()];
        ours.push(false);
        assert_eq!(without_unused(&user, &ours), user);
        let pasted = format!("{text}#define CALL(name) pcl2_##name()\n");
        assert_eq!(without_unused(&pasted, &ours), pasted);
    }
}
