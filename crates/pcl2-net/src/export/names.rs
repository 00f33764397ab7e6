//! Names that a format allows, each once.

use rustc_hash::FxHashSet;

/// Makes names of what may stand in them.
pub(super) struct Namer {
    used: FxHashSet<String>,
    allowed: fn(char) -> bool,
    reserved: fn(&str) -> bool,
}

impl Namer {
    /// Names of these characters, without some words.
    pub(super) fn new(allowed: fn(char) -> bool, reserved: fn(&str) -> bool) -> Namer {
        Namer { used: FxHashSet::default(), allowed, reserved }
    }

    /// The names of a list. Those that may stay as they are do.
    pub(super) fn names<'n>(&mut self, names: impl Iterator<Item = &'n str> + Clone) -> Vec<String> {
        let mut found: Vec<Option<String>> = names.clone().map(|name| self.kept(name)).collect();
        for (known, name) in found.iter_mut().zip(names) {
            if known.is_none() {
                *known = Some(self.made(name));
            }
        }
        found.into_iter().flatten().collect()
    }

    fn kept(&mut self, name: &str) -> Option<String> {
        let begins = name.starts_with(|letter: char| letter.is_ascii_alphabetic());
        let fits = begins && name.chars().all(self.allowed) && !(self.reserved)(name);
        (fits && self.used.insert(name.to_owned())).then(|| name.to_owned())
    }

    fn made(&mut self, name: &str) -> String {
        let mut made: String = name.chars().map(|letter| if (self.allowed)(letter) { letter } else { '_' }).collect();
        if !made.starts_with(|letter: char| letter.is_ascii_alphabetic()) {
            made.insert(0, 'x');
        }
        while (self.reserved)(&made) || !self.used.insert(made.clone()) {
            made.push('_');
        }
        made
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stay_where_they_may_and_no_two_are_one() {
        let mut namer = Namer::new(|letter| letter.is_ascii_alphanumeric() || letter == '_', |name| name == "END");
        let names = ["s[1]", "s_1_", "END", "+a", "", "a"];
        assert_eq!(namer.names(names.into_iter()), ["s_1__", "s_1_", "END_", "x_a", "x", "a"]);
        assert_eq!(namer.names(["a"].into_iter()), ["a_"]);
    }
}
