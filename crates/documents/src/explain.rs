//! The words of serde and toml, put so that the author of a file knows what to write.

use adslam_diagnostics::InputError;
use adslam_names::nearest;

use crate::Advice;

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
    /// Path of the value that is to blame, or of the table whose key is.
    pub(super) path: &'a str,
    /// The keys that are there, if it is a table.
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
        let help = place.suggestion(unknown, known, "choices");
        return explanation(not_a_choice(unknown), NO_SUCH_CHOICE, help);
    }
    if text.starts_with("missing field")
        && let Some(missing) = quoted.first()
    {
        let message = format!("the key `{missing}` is missing");
        let at_root = error.span().is_none_or(|span| span == (0..0));
        let label = if at_root {
            "in the file's own keys"
        } else {
            "in this part"
        };
        return explanation(message, label, place.missing(missing));
    }
    if text.starts_with("wanted exactly 1 element") || text == "wanted string or table" {
        let message = "exactly one choice must be made here".to_owned();
        return explanation(message, "in this part", place.choice());
    }
    if text.ends_with("expected newtype variant") {
        let message = "this choice is a table with keys of its own".to_owned();
        return explanation(message, "a word alone", place.choice());
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

const NO_SUCH_CHOICE: &str = "no such choice";

fn not_a_choice(unknown: &str) -> String {
    format!("`{unknown}` is not one of the choices")
}

/// `error`, which points at the word `unknown`, with the words for what is none of the choices that are `known`.
#[must_use]
pub fn unknown_choice(error: InputError, unknown: &str, known: &[&str]) -> InputError {
    error
        .with_message(not_a_choice(unknown))
        .with_label(NO_SUCH_CHOICE)
        .with_help(suggestion(unknown, known, "choices"))
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

impl Explanation {
    /// The error with this message, label and help.
    pub(super) fn applied_to(self, error: InputError) -> InputError {
        let error = error.with_message(self.message).with_label(self.label);
        match self.help {
            Some(help) => error.with_help(help),
            None => error,
        }
    }
}

impl Surroundings<'_> {
    /// Where the unknown word belongs, if it is a key elsewhere; else "did you mean `x`?", where one
    /// of the known words is close; and the list of those.
    fn suggestion(&self, unknown: &str, known: &[&str], kind: &str) -> String {
        let elsewhere = self.advice.tables_with(unknown, self.path);
        if elsewhere.is_empty() {
            return suggestion(unknown, known, kind);
        }
        let places: Vec<String> = elsewhere
            .iter()
            .map(|table| match *table {
                "" => "the file's own keys, above the first [table]".to_owned(),
                table => format!("[{table}]"),
            })
            .collect();
        let (places, list) = (places.join(" or "), in_backticks(known));
        format!("`{unknown}` belongs into {places}; the {kind} here: {list}")
    }

    /// What to add where a key is missing, and what it means.
    fn missing(&self, key: &str) -> String {
        let dot = if self.path.is_empty() { "" } else { "." };
        let path = format!("{}{dot}{key}", self.path);
        let tables = self.tables_at(&path);
        let help = if !tables.is_empty() {
            format!("add one of {}", tables.join(", "))
        } else if self.advice.is_table(&path) {
            format!("add a table [{path}]")
        } else if self.path.is_empty() {
            format!("add `{key} = …` above the first [table]")
        } else {
            format!("add `{key} = …` here")
        };
        match self.advice.meaning(&path) {
            Some(meaning) => format!("{help}. {meaning}"),
            None => help,
        }
    }

    /// Which choice can be made.
    fn choice(&self) -> String {
        let choices = self.advice.choices_at(self.path);
        let mut chosen = self.keys.clone();
        chosen.retain(|key| choices.contains(key));
        if chosen.len() > 1 {
            format!("keep one of {}", in_backticks(&chosen))
        } else {
            format!("write one of {}", self.tables_at(self.path).join(", "))
        }
    }

    /// The heads of the tables that may be chosen at a path.
    fn tables_at(&self, path: &str) -> Vec<String> {
        let choices = self.advice.choices_at(path).into_iter();
        choices.map(|choice| format!("[{path}.{choice}]")).collect()
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
