//! The words of serde_json, put so that the author of a log knows what to write.

use adslam_names::nearest;

/// What is wrong with a line, and what to write instead.
pub(super) struct Explanation {
    pub(super) what: String,
    pub(super) help: String,
}

/// Puts an error in `line`, which should have been a `kind` (header or step), in better words.
pub(super) fn explain(error: &serde_json::Error, line: &str, kind: &str) -> Explanation {
    if error.is_eof() {
        return cut_off(kind);
    }
    // serde_json counts lines within the line.
    let text = error.to_string();
    let text = text.split(" at line ").next().unwrap_or(&text);
    let (what, help) = reason(text, &token_at(line, error.column()), kind);
    let (column, near) = (error.column(), near(line, error.column()));
    Explanation {
        what: format!("is no valid {kind}: {what} (column {column}, near `{near}`)"),
        help,
    }
}

fn cut_off(kind: &str) -> Explanation {
    let help = if kind == "header" {
        "each line of a log is a whole JSON object, the header on the first; write it without line \
         breaks"
    } else {
        "was the log cut off? Remove the broken line, or keep what is before it with --keep-complete"
    };
    Explanation {
        what: format!("ends in the middle of the {kind}"),
        help: help.to_owned(),
    }
}

fn reason(text: &str, token: &str, kind: &str) -> (String, String) {
    let quoted: Vec<&str> = text.split('`').skip(1).step_by(2).collect();
    let (first, others) = quoted.split_first().unwrap_or((&"", &[]));
    let shape = || "docs/log.md shows the shape of each key".to_owned();
    let unsigned = token.trim_start_matches(['-', '+']).to_ascii_lowercase();
    if ["nan", "inf", "infinity"].contains(&unsigned.as_str()) {
        let what = format!("{token} is not a number in JSON");
        return (what, finite_only());
    }
    if text.starts_with("number out of range") {
        let what = format!("{token} is too large for a 64-bit number");
        return (what, finite_only());
    }
    let place = if kind == "header" {
        "; the first line of a log is its header"
    } else {
        ""
    };
    if text.starts_with("missing field") {
        let help = format!("add it{place}; docs/log.md lists the keys");
        return (format!("the key `{first}` is missing"), help);
    }
    if text.starts_with("unknown field") {
        let help = match nearest(first, others.iter().copied()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("the keys here are {}{place}", others.join(", ")),
        };
        return (format!("unknown key `{first}`"), help);
    }
    if text.starts_with("duplicate field") {
        let what = format!("the key `{first}` is given twice");
        return (what, "keep one of the two".to_owned());
    }
    if let Some((wrong, expected)) = text
        .strip_prefix("invalid type: ")
        .or_else(|| text.strip_prefix("invalid value: "))
        .and_then(|rest| rest.rsplit_once(", expected "))
    {
        let help = match expected {
            "f64" => "write a finite number, and leave out what was not measured".to_owned(),
            "usize" | "u64" => "write a whole number from 0".to_owned(),
            _ => shape(),
        };
        return (format!("{wrong} cannot stand here"), help);
    }
    if let Some((found, wanted)) = text
        .strip_prefix("invalid length ")
        .and_then(|rest| rest.split_once(", expected an array of length "))
    {
        let what = format!("a list has {found} elements, and {wanted} belong into it");
        return (what, shape());
    }
    // serde_json's words for a list with too many elements, too.
    if text == "trailing characters" {
        return ("there is more than belongs here".to_owned(), shape());
    }
    let help = "each line of a log is a JSON object; docs/log.md shows them";
    (format!("this is not JSON ({text})"), help.to_owned())
}

fn finite_only() -> String {
    "all numbers of a log are finite; leave out what was not measured".to_owned()
}

/// What stands around a column (a byte, from 1), fit for a message.
fn near(line: &str, column: usize) -> String {
    const BEFORE: usize = 16;
    const AFTER: usize = 14;
    let end = line.trim_end().len();
    line.char_indices()
        .filter(|&(i, _)| i + BEFORE >= column && i < (column + AFTER).min(end))
        .map(|(_, c)| if c.is_control() { '\u{fffd}' } else { c })
        .collect()
}

/// The number or word at a column.
fn token_at(line: &str, column: usize) -> String {
    let ends = |c: char| c.is_whitespace() || "[]{},:\"".contains(c);
    let at = column.saturating_sub(1).min(line.len());
    // A column may lie within a character of binary garbage.
    let (Some(before), Some(after)) = (line.get(..at), line.get(at..)) else {
        return String::new();
    };
    let start = before.rfind(ends).map_or(0, |i| i + 1);
    let length = after.find(ends).unwrap_or(after.len());
    line[start..at + length].chars().take(24).collect()
}

#[cfg(test)]
mod tests {
    use super::super::format::LogStep;
    use super::*;

    fn explained(line: &str) -> Explanation {
        explain(
            &serde_json::from_str::<LogStep>(line).unwrap_err(),
            line,
            "step",
        )
    }

    #[test]
    fn numbers_that_are_none() {
        for wrong in [
            "NaN",
            "nan",
            "Infinity",
            "-Infinity",
            "-inf",
            "1e999",
            "-1e999",
        ] {
            let line = format!(
                r#"{{"step":2,"control":{{"rotation":[{wrong}, 0, 0],"translation":[0,0,0]}}}}"#
            );
            let Explanation { what, help } = explained(&line);
            assert!(what.contains(&format!(": {wrong} is ")), "{what}");
            assert!(help.contains("finite"), "{help}");
        }
    }

    /// Whatever the bytes, there is an explanation.
    #[test]
    fn garbage() {
        for line in [
            "",
            "\u{0}\u{1}",
            "σσσσ",
            "{\"σ\": é}",
            "]",
            "5",
            "\"",
            "{\"step\":2} x",
            "[2]",
        ] {
            assert!(!explained(line).help.is_empty(), "{line}");
        }
    }
}
