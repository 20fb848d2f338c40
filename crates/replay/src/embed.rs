//! Runs inside a page: JSON in script elements that no browser runs.

use std::path::Path;

use adslam_record::RunHistory;
use thiserror::Error;

use crate::MOST_RUNS;

/// Why runs cannot be put into a page, or be read from one.
#[derive(Debug, Error)]
pub enum EmbedError {
    /// A page has place for one run or two.
    #[error("{0} runs, and a page shows one or two")]
    Count(usize),
    /// The parts of a history disagree.
    #[error("the history does not fit together: {0}")]
    DoesNotFit(String),
    /// A history cannot be written as JSON.
    #[error("the history cannot be written as JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// What lies in the page is no history.
    #[error("the page holds no run that can be read: {0}")]
    NotAHistory(String),
}

const END: &str = "</script>";

fn start(index: usize) -> String {
    format!("<script type=\"application/json\" id=\"run-{index}\">")
}

/// The element that holds the run number `index`.
pub(crate) fn element(index: usize, history: &RunHistory) -> Result<String, EmbedError> {
    let json = escape(&serde_json::to_string(history)?);
    Ok(format!("{}{json}{END}\n", start(index)))
}

/// JSON that cannot end its element, open a comment or be taken for markup: outside of strings
/// there is none of these characters, and inside a `\u` escape means the same.
fn escape(json: &str) -> String {
    let mut escaped = String::with_capacity(json.len());
    for c in json.chars() {
        match c {
            '<' => escaped.push_str("\\u003c"),
            '>' => escaped.push_str("\\u003e"),
            '&' => escaped.push_str("\\u0026"),
            '\u{2028}' => escaped.push_str("\\u2028"),
            '\u{2029}' => escaped.push_str("\\u2029"),
            _ => escaped.push(c),
        }
    }
    escaped
}

/// The runs that a page holds.
///
/// # Errors
/// [`EmbedError::NotAHistory`], or none at all.
pub fn embedded_histories(page: &str) -> Result<Vec<RunHistory>, EmbedError> {
    let mut histories = Vec::new();
    for index in 0..MOST_RUNS {
        let Some((_, rest)) = page.split_once(&start(index)) else {
            break;
        };
        let json = rest.split(END).next().unwrap_or(rest);
        let history = RunHistory::parse(Path::new("the page"), json)
            .map_err(|error| EmbedError::NotAHistory(error.to_string()))?;
        histories.push(history);
    }
    if histories.is_empty() {
        return Err(EmbedError::Count(0));
    }
    Ok(histories)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_in_a_string_can_end_the_element() {
        let nasty = "</script><!-- <script> ]]> & \u{2028}\u{2029} \\ \" é 心";
        let json = serde_json::to_string(nasty).unwrap();
        let escaped = escape(&json);
        for mark in ["<", ">", "&", "\u{2028}", "\u{2029}"] {
            assert!(!escaped.contains(mark));
        }
        let back: String = serde_json::from_str(&escaped).unwrap();
        assert_eq!(back, nasty);
    }
}
