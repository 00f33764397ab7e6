//! "Did you mean": the known name that is closest to a misspelt one.

/// More candidates than this are not compared: a wrong name must not cost seconds.
const MAX_CANDIDATES: usize = 20_000;

/// The closest known name: the same in another case, or one that a few slips away.
pub fn closest<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let slips = (name.len() / 3).clamp(1, 3);
    let mut best: Option<(usize, &str)> = None;
    for candidate in known.take(MAX_CANDIDATES) {
        if candidate.eq_ignore_ascii_case(name) {
            return Some(candidate);
        }
        if candidate.len().abs_diff(name.len()) > slips {
            continue;
        }
        let distance = strsim::damerau_levenshtein(name, candidate);
        let better = best.is_none_or(|(least, text)| (distance, candidate) < (least, text));
        if distance <= slips && distance < name.len() && better {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// `did you mean X?`, if something is close.
pub fn help<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<String> {
    closest(name, known).map(|candidate| format!("did you mean `{candidate}`?"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_and_case_are_found_and_strangers_are_not() {
        let known = ["setvec", "addvec", "first", "y1"];
        assert_eq!(closest("setvce", known.into_iter()), Some("setvec"));
        assert_eq!(closest("FIRST", known.into_iter()), Some("first"));
        assert_eq!(closest("pidcontroller", known.into_iter()), None);
        assert_eq!(closest("q", known.into_iter()), None);
    }
}
