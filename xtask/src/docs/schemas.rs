//! What the reference asks of schemas.

use std::collections::BTreeMap;

use serde_json::Value;

/// The definitions of all schemas by name.
pub(super) type Definitions<'a> = BTreeMap<&'a str, &'a Value>;

/// The words of a choice of words, which the key that has it explains, and what each means.
pub(super) fn words(schema: &Value) -> Option<impl Iterator<Item = (&str, &str)>> {
    let words = schema.get("enum")?.as_array()?;
    let meanings = schema.pointer("/x-taplo/docs/enumValues")?.as_array()?;
    let pairs = words.iter().zip(meanings);
    Some(pairs.filter_map(|(word, meaning)| Some((word.as_str()?, meaning.as_str()?))))
}

/// The word that a choice of tables has beside them.
pub(super) fn word_beside_tables(schema: &Value) -> Option<&str> {
    let pattern = schema["pattern"].as_str()?;
    pattern.strip_prefix("^(")?.strip_suffix(")$")
}

/// Whether the definition is a choice of tables.
pub(super) fn is_choice_of_tables(schema: &Value) -> bool {
    schema["maxProperties"] == 1
}
