//! The words for a key's schema: its type, its default, its meaning.

use adslam_scenario::values::{LARGEST, SMALLEST};
use serde_json::Value;

use super::schemas::{Definitions, is_choice_of_tables, word_beside_tables, words};

/// Whole numbers above this are as good as unlimited.
const UNLIMITED: u64 = 1 << 53;

/// The cells of a key's default and meaning. What holds where the key is left out is the schema's
/// default or, before it, the last sentence of the description, "Default: …".
pub(super) fn default_and_meaning(
    schema: &Value,
    required: bool,
    definitions: &Definitions<'_>,
) -> Result<(String, String), String> {
    let description = schema["description"].as_str();
    let description = description.ok_or("there is no description")?;
    let (mut meaning, told) = match description.split_once(" Default: ") {
        Some((meaning, default)) => (meaning.to_owned(), default.strip_suffix('.')),
        None => (description.to_owned(), None),
    };
    let default = match (told, schema.get("default")) {
        (Some(told), _) => told.to_owned(),
        (None, Some(default)) => format!("`{}`", default.to_string().replace(',', ", ")),
        (None, None) if required => String::new(),
        (None, None) => return Err("what holds where it is left out is not said".to_owned()),
    };
    for (word, what) in words(resolved(schema, definitions)).into_iter().flatten() {
        meaning += &format!(" `{word}`: {}", in_sentence(what));
    }
    Ok((default, meaning.replace('|', r"\|")))
}

/// The words for the type of the value of `key`.
pub(super) fn type_words(key: &str, schema: &Value, definitions: &Definitions<'_>) -> String {
    let target = resolved(schema, definitions);
    if let Some(words) = words(target) {
        let words: Vec<String> = words.map(|(word, _)| format!("`\"{word}\"`")).collect();
        return words.join(", ");
    }
    if is_choice_of_tables(target) {
        return match word_beside_tables(target) {
            Some(word) => format!("`\"{word}\"` or one table"),
            None => "one table".to_owned(),
        };
    }
    if let Some(several) = schema["anyOf"].as_array() {
        let words: Vec<String> = several
            .iter()
            .map(|one| type_words(key, one, definitions))
            .collect();
        return words.join(" or ");
    }
    match target["type"].as_str() {
        Some("integer") => whole_number(target),
        Some("number") => number(target),
        Some("array") => list(key, target, definitions),
        Some("string") if target["format"] == "path" => "path".to_owned(),
        Some("string") if target.get("pattern").is_some() => "name".to_owned(),
        Some("string") => "text".to_owned(),
        _ => match target["const"].as_str() {
            Some(word) => format!("`\"{word}\"`"),
            None => "table".to_owned(),
        },
    }
}

/// A description as the part of a sentence that follows a colon.
pub(super) fn in_sentence(text: &str) -> String {
    let mut letters = text.chars();
    match letters.next() {
        // "T(n)" and "STL" keep their capitals.
        Some(first) if letters.clone().next().is_some_and(char::is_lowercase) => {
            first.to_lowercase().chain(letters).collect()
        }
        Some(first) if letters.clone().next() == Some(' ') => {
            first.to_lowercase().chain(letters).collect()
        }
        _ => text.to_owned(),
    }
}

/// The definition that the schema refers to, or the schema itself.
fn resolved<'a>(schema: &'a Value, definitions: &Definitions<'a>) -> &'a Value {
    let reference = schema
        .get("$ref")
        .or_else(|| schema.pointer("/allOf/0/$ref"));
    reference
        .and_then(Value::as_str)
        .and_then(|target| definitions.get(target.strip_prefix("#/definitions/")?))
        .copied()
        .unwrap_or(schema)
}

fn whole_number(schema: &Value) -> String {
    let least = schema["minimum"].as_u64().unwrap_or(0);
    match schema["maximum"].as_u64() {
        Some(most) if most < UNLIMITED => {
            format!("whole number, {} to {}", grouped(least), grouped(most))
        }
        _ => format!("whole number from {least}"),
    }
}

fn number(schema: &Value) -> String {
    let least = schema["minimum"].as_f64().unwrap_or(-LARGEST);
    let most = schema["maximum"].as_f64().unwrap_or(LARGEST);
    if least <= -LARGEST {
        return "number".to_owned();
    }
    match (least <= SMALLEST && least > 0.0, most >= LARGEST) {
        (true, true) => "number above 0".to_owned(),
        (true, false) => format!("number above 0, up to {most}"),
        (false, true) => format!("number from {least}"),
        // As many digits as tell the limit from another.
        (false, false) => format!("number, {least} to {}", (most * 1e4).round() / 1e4),
    }
}

fn list(key: &str, schema: &Value, definitions: &Definitions<'_>) -> String {
    let items = &schema["items"];
    if schema["minItems"] == 3 && schema["maxItems"] == 3 {
        return match items["type"].as_str() {
            Some("number") if key.ends_with("_deg") => "roll, pitch, yaw".to_owned(),
            Some("number") => "vector".to_owned(),
            _ => "three numbers".to_owned(),
        };
    }
    let words = type_words(key, items, definitions);
    match (words.as_str(), items["type"].as_str()) {
        ("vector", _) => "list of vectors".to_owned(),
        ("three numbers", _) => "list of three numbers each".to_owned(),
        ("table", _) => "list of tables".to_owned(),
        (words, _) if words.starts_with('`') => format!("list of some of {words}"),
        (_, Some("integer")) => "list of whole numbers".to_owned(),
        (_, Some("number")) => "list of numbers".to_owned(),
        (words, _) => format!("list of {words}"),
    }
}

/// A whole number with its thousands apart.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) && digits.len() > 4 {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn ranges_are_put_in_words() {
        let words = |schema: Value| type_words("x", &schema, &Definitions::new());
        let number =
            |least: f64, most: f64| json!({ "type": "number", "minimum": least, "maximum": most });
        assert_eq!(words(number(-LARGEST, LARGEST)), "number");
        assert_eq!(words(number(SMALLEST, LARGEST)), "number above 0");
        assert_eq!(words(number(0.0, LARGEST)), "number from 0");
        assert_eq!(words(number(SMALLEST, 1.0)), "number above 0, up to 1");
        assert_eq!(words(number(0.5, 100.0)), "number, 0.5 to 100");
        let whole = |most: u64| json!({ "type": "integer", "minimum": 1, "maximum": most });
        assert_eq!(words(whole(2000)), "whole number, 1 to 2000");
        assert_eq!(words(whole(1_000_000)), "whole number, 1 to 1 000 000");
        assert_eq!(words(whole(u64::MAX)), "whole number from 1");
    }

    #[test]
    fn sentences_start_small_after_a_colon() {
        assert_eq!(in_sentence("Every pair."), "every pair.");
        assert_eq!(in_sentence("A mesh file."), "a mesh file.");
        assert_eq!(in_sentence("T(n) = 1."), "T(n) = 1.");
    }
}
