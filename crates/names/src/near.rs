//! Words that were meant for others.

/// The word of `known` that `unknown` may have been meant for: the one with the fewest edits, if
/// those are at most a third of its length.
pub fn nearest<'a>(unknown: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    known
        .into_iter()
        .map(|word| (strsim::levenshtein(unknown, word), word))
        .min()
        .filter(|(edits, word)| *edits <= (word.chars().count() / 3).max(1))
        .map(|(_, word)| word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_near_word_is_suggested() {
        let known = ["range_cm", "min_range_cm"];
        assert_eq!(nearest("rang_cm", known), Some("range_cm"));
        assert_eq!(nearest("colour", known), None);
        assert_eq!(nearest("x", []), None);
        assert_eq!(
            nearest("s_cm", ["σ_cm"]),
            Some("σ_cm"),
            "edits count characters"
        );
    }
}
