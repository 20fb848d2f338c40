//! docs/scenario.md, from its template and the schemas.
//!
//! A line `{{Name}}` of the template stands for the definition of that name: what it is, and a table
//! of its keys, or a list of its choices.

use std::fmt::Write;

use serde_json::Value;

use super::schemas::{Definitions, is_choice_of_tables, word_beside_tables, words};
use super::words::{default_and_meaning, in_sentence, type_words};

/// Fills the template in.
///
/// # Errors
/// When a line names no definition, when a table or a choice stands nowhere, or when a key that may
/// be left out does not say what holds then.
pub(super) fn render(template: &str, schemas: &[Value]) -> Result<String, String> {
    let definitions = definitions(schemas);
    let mut missing = definitions.clone();
    missing.retain(|_, schema| words(schema).is_none());
    let mut page = String::new();
    for line in template.lines() {
        let name = line
            .strip_prefix("{{")
            .and_then(|rest| rest.strip_suffix("}}"));
        if let Some(name) = name {
            let schema = definitions
                .get(name)
                .ok_or_else(|| format!("the template names {name}, which no schema defines"))?;
            missing.remove(name);
            page += &section(name, schema, &definitions)?;
        } else {
            page += line;
            page.push('\n');
        }
    }
    if missing.is_empty() {
        Ok(page)
    } else {
        let names: Vec<&&str> = missing.keys().collect();
        Err(format!("the template has no place for {names:?}"))
    }
}

fn definitions(schemas: &[Value]) -> Definitions<'_> {
    let mut definitions = Definitions::new();
    for schema in schemas {
        if let Some(title) = schema["title"].as_str() {
            definitions.insert(title, schema);
        }
        for (name, definition) in schema["definitions"].as_object().into_iter().flatten() {
            definitions.insert(name, definition);
        }
    }
    definitions
}

/// What a definition is, and its keys or its choices.
fn section(name: &str, schema: &Value, definitions: &Definitions<'_>) -> Result<String, String> {
    let mut text = format!("{}\n\n", schema["description"].as_str().unwrap_or_default());
    if is_choice_of_tables(schema) {
        if let Some(word) = word_beside_tables(schema) {
            let _ = writeln!(text, "- `\"{word}\"`, or one of");
        }
        for (table, choice) in schema["properties"].as_object().into_iter().flatten() {
            let meaning = in_sentence(choice["description"].as_str().unwrap_or_default());
            let _ = writeln!(text, "- `{table}`: {meaning}");
        }
        return Ok(text);
    }
    text += "| key | type | default | meaning |\n| --- | --- | --- | --- |\n";
    let required = schema["required"].as_array();
    for (key, value) in schema["properties"].as_object().into_iter().flatten() {
        let required = required.is_some_and(|keys| keys.iter().any(|name| name == key));
        let (default, meaning) = default_and_meaning(value, required, definitions)
            .map_err(|error| format!("{name}.{key}: {error}"))?;
        let kind = type_words(key, value, definitions);
        let default = if default.is_empty() {
            default
        } else {
            format!(" {default}")
        };
        let _ = writeln!(text, "| `{key}` | {kind} |{default} | {meaning} |");
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn schema() -> Value {
        json!({
            "title": "Box",
            "description": "A box.",
            "properties": {
                "size_cm": { "type": "number", "minimum": 0.0, "maximum": 1e6, "description": "Its size (cm)." },
                "lid": { "$ref": "#/definitions/Lid", "description": "Its lid. Default: no lid." },
            },
            "required": ["size_cm"],
            "definitions": { "Lid": { "description": "A lid.", "properties": {} } },
        })
    }

    #[test]
    fn a_template_is_filled_in() {
        let page = render("# Box\n{{Box}}\nand\n{{Lid}}\n", &[schema()]).unwrap();
        assert!(page.starts_with("# Box\nA box.\n\n| key |"), "{page}");
        let row = "| `size_cm` | number from 0 | | Its size (cm). |\n";
        assert!(page.contains(row), "{page}");
        let row = "| `lid` | table | no lid | Its lid. |\n";
        assert!(page.contains(row), "{page}");
    }

    #[test]
    fn nothing_is_forgotten() {
        let error = render("{{Box}}\n", &[schema()]).unwrap_err();
        assert!(error.contains("no place for [\"Lid\"]"), "{error}");
        let error = render("{{Bag}}\n", &[schema()]).unwrap_err();
        assert!(error.contains("names Bag"), "{error}");
        let mut silent = schema();
        silent["properties"]["lid"]["description"] = json!("Its lid.");
        let error = render("{{Box}}\n{{Lid}}\n", &[silent]).unwrap_err();
        assert!(error.contains("Box.lid"), "{error}");
    }
}
