//! The words of serde and toml, put so that the author of a file knows what to write.

use super::InputError;
use crate::schema::Advice;

/// An error message in three parts.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Explanation {
    pub(super) message: String,
    pub(super) label: String,
    pub(super) help: Option<String>,
}

/// What is around the place that an error points at.
#[derive(Debug)]
pub(super) struct Surroundings<'a> {
    /// Path of the table that is to blame, or whose key is.
    pub(super) table: &'a str,
    /// The keys that the table has.
    pub(super) keys: Vec<&'a str>,
    /// What belongs into such a file.
    pub(super) advice: &'a Advice,
}

/// Puts an error of the toml parser or of a `Deserialize` in better words.
///
/// Errors of our own number types read "what is wrong; what to write"; the two parts become message
/// and help.
pub(super) fn explain(error: &toml::de::Error, place: &Surroundings<'_>) -> Explanation {
    let text = error.message();
    let quoted: Vec<&str> = text.split('`').skip(1).step_by(2).collect();
    let explanation = |message: String, label: &str, help: String| Explanation {
        message,
        label: label.to_owned(),
        help: Some(help),
    };
    if text.starts_with("unknown field")
        && let Some((unknown, known)) = quoted.split_first()
    {
        let message = format!("unknown key `{unknown}`");
        return explanation(
            message,
            "no such key here",
            place.suggestion(unknown, known, "keys"),
        );
    }
    if text.starts_with("unknown variant")
        && let Some((unknown, known)) = quoted.split_first()
    {
        let message = format!("`{unknown}` is not one of the choices");
        return explanation(
            message,
            "no such choice",
            place.suggestion(unknown, known, "choices"),
        );
    }
    if text.starts_with("missing field")
        && let Some(missing) = quoted.first()
    {
        let message = format!("the key `{missing}` is missing");
        let at_root = error.span().is_none_or(|span| span == (0..0));
        let (label, where_to) = if at_root {
            (
                "in the file's own keys",
                "above the first [table], or as a [table] of its own",
            )
        } else {
            ("in this part", "here")
        };
        let help = format!("add `{missing} = …` {where_to}");
        return explanation(message, label, place.with_meaning(help, missing));
    }
    if text.starts_with("wanted exactly 1 element") || text == "wanted string or table" {
        let message = "exactly one choice must be made here".to_owned();
        return explanation(message, "in this part", place.choice());
    }
    if let Some((wrong, expected)) = text
        .strip_prefix("invalid type: ")
        .or_else(|| text.strip_prefix("invalid value: "))
        .and_then(|rest| rest.rsplit_once(", expected "))
    {
        let help = format!("write {expected}");
        return explanation(
            format!("{wrong} cannot stand here"),
            "wrong kind of value",
            help,
        );
    }
    match text.split_once("; ") {
        Some((message, help)) => explanation(message.to_owned(), "here", help.to_owned()),
        None => Explanation {
            message: text.to_owned(),
            label: "here".to_owned(),
            help: None,
        },
    }
}

/// Puts an error of what is not even TOML in better words.
pub(super) fn explain_syntax(error: &toml::de::Error) -> Explanation {
    let text = error.message();
    let (message, help) = if text.starts_with("string values must be quoted")
        // What begins like `true` or `false` is taken for it.
        || text.starts_with("invalid boolean")
    {
        (
            "this is neither a number nor a text in quotes",
            "write numbers like 3.0 without a unit, lists like [1.0, 2.0] with commas, and texts \
             like \"text\"",
        )
    } else if text.starts_with("duplicate key") {
        (text, "keep one of the two")
    } else {
        (
            text,
            "this is not TOML; https://toml.io shows how it is written",
        )
    };
    Explanation {
        message: message.to_owned(),
        label: "here".to_owned(),
        help: Some(help.to_owned()),
    }
}

impl InputError {
    /// The error with message, label and help of an explanation, at a place.
    pub(super) fn explained(mut self, explanation: Explanation) -> Self {
        self.0.message = explanation.message;
        self.0.label = explanation.label;
        self.0.help = explanation.help;
        self
    }
}

impl Surroundings<'_> {
    /// Where the unknown word belongs, if it is a key elsewhere; else "did you mean `x`?", where one
    /// of the known words is close; and the list of those.
    fn suggestion(&self, unknown: &str, known: &[&str], kind: &str) -> String {
        let elsewhere = self.advice.tables_with(unknown, self.table);
        if elsewhere.is_empty() {
            return suggestion(unknown, known, kind);
        }
        let tables: Vec<String> = elsewhere.iter().map(|table| format!("[{table}]")).collect();
        let (tables, list) = (tables.join(" or "), in_backticks(known));
        format!("`{unknown}` belongs into {tables}; the {kind} here: {list}")
    }

    /// The help, and what the key that it speaks of means.
    fn with_meaning(&self, help: String, key: &str) -> String {
        let dot = if self.table.is_empty() { "" } else { "." };
        match self.advice.meaning(&format!("{}{dot}{key}", self.table)) {
            Some(meaning) => format!("{help}. {meaning}"),
            None => help,
        }
    }

    /// Which choice can be made.
    fn choice(&self) -> String {
        let table = self.table;
        let tables = self.advice.choices_at(table);
        let chosen: Vec<&str> = self
            .keys
            .iter()
            .copied()
            .filter(|key| tables.contains(key))
            .collect();
        if chosen.len() > 1 {
            return format!("keep one of {}", in_backticks(&chosen));
        }
        let tables: Vec<String> = tables
            .iter()
            .map(|choice| format!("[{table}.{choice}]"))
            .collect();
        format!("write one of {}", tables.join(", "))
    }
}

/// "did you mean `x`?", where one of the known words is close, and the list of them.
fn suggestion(unknown: &str, known: &[&str], kind: &str) -> String {
    let list = in_backticks(known);
    match nearest(unknown, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`? The {kind} here: {list}"),
        None if known.is_empty() => "nothing is expected here; take it out".to_owned(),
        None => format!("the {kind} here: {list}"),
    }
}

fn in_backticks(words: &[&str]) -> String {
    words
        .iter()
        .map(|word| format!("`{word}`"))
        .collect::<Vec<_>>()
        .join(", ")
}

/// The word of `known` that `unknown` may have been meant for: the one with the fewest edits, if
/// those are at most a third of its length.
pub fn nearest<'a>(unknown: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    known
        .into_iter()
        .map(|word| (edits(unknown, word), word))
        .min()
        .filter(|(edits, word)| *edits <= (word.chars().count() / 3).max(1))
        .map(|(_, word)| word)
}

/// Levenshtein's distance in characters, by rows.
fn edits(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(x != *y);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edits_are_counted() {
        assert_eq!(edits("kitten", "sitting"), 3);
        assert_eq!(edits("", "abc"), 3);
        assert_eq!(edits("abc", ""), 3);
        assert_eq!(edits("σ_cm", "s_cm"), 1);
    }

    #[test]
    fn only_a_near_word_is_suggested() {
        let known = ["range_cm", "min_range_cm"];
        assert_eq!(nearest("rang_cm", known), Some("range_cm"));
        assert_eq!(nearest("colour", known), None);
        assert_eq!(nearest("x", []), None);
    }
}
