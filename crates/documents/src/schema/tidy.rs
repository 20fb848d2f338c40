//! A generated schema brought into the form from which editors of TOML make the best of errors and
//! completions.

use schemars::Schema;
use serde_json::{Map, Value, json};

/// Takes out what TOML has not, null, and the line breaks that comments have from their source, and
/// writes choices without `oneOf`, of which a checker can only say that nothing fits.
pub(super) fn tidy(schema: &mut Schema) {
    if let Some(Value::String(text)) = schema.get_mut("description") {
        *text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    }
    if let Some(Value::Array(types)) = schema.get_mut("type") {
        types.retain(|kind| kind != "null");
        if let [only] = &types[..] {
            let only = only.clone();
            schema.insert("type".to_owned(), only);
        }
    }
    if let Some(Value::Array(choices)) = schema.get_mut("anyOf") {
        choices.retain(|choice| choice.get("type").is_none_or(|kind| kind != "null"));
        if choices.len() == 1
            && let Some(only) = schema.remove("anyOf")
        {
            schema.insert("allOf".to_owned(), only);
        }
    }
    // Nor is there anything to read from a table of defaults, whose keys say theirs.
    if let Some(Value::Null | Value::Object(_)) = schema.get("default") {
        schema.remove("default");
    }
    let choices = match schema.get("oneOf") {
        Some(Value::Array(choices)) if schema.get("properties").is_none() => Choices::of(choices),
        _ => None,
    };
    if let Some(choices) = choices {
        schema.remove("oneOf");
        choices.write_into(schema);
    }
}

/// The alternatives that an enum of the reader became.
#[derive(Default)]
struct Choices {
    words: Vec<Value>,
    meanings: Vec<Value>,
    tables: Map<String, Value>,
}

impl Choices {
    /// Those that are words and those that are tables under a key; none if any is something else.
    fn of(alternatives: &[Value]) -> Option<Self> {
        let mut choices = Self::default();
        for alternative in alternatives {
            let meaning = alternative.get("description")?;
            if let Some(word) = alternative.get("const") {
                choices.words.push(word.clone());
                choices.meanings.push(meaning.clone());
            } else {
                for (key, table) in alternative.get("properties")?.as_object()? {
                    let table = json!({ "description": meaning, "allOf": [table] });
                    choices.tables.insert(key.clone(), table);
                }
            }
        }
        Some(choices)
    }

    fn write_into(self, schema: &mut Schema) {
        let mut insert = |key: &str, value: Value| schema.insert(key.to_owned(), value);
        if self.tables.is_empty() {
            insert("type", json!("string"));
            insert("enum", json!(self.words));
            // Taplo's own key for what each word means.
            insert(
                "x-taplo",
                json!({ "docs": { "enumValues": self.meanings } }),
            );
            return;
        }
        if self.words.is_empty() {
            insert("type", json!("object"));
        } else {
            // A pattern, unlike an enum, says nothing of the tables.
            let words: Vec<&str> = self.words.iter().filter_map(Value::as_str).collect();
            insert("type", json!(["string", "object"]));
            insert("pattern", json!(format!("^({})$", words.join("|"))));
        }
        insert("properties", Value::Object(self.tables));
        insert("additionalProperties", json!(false));
        insert("minProperties", json!(1));
        insert("maxProperties", json!(1));
    }
}
