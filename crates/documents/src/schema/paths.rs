//! The paths of a file's keys.

use serde_json::Value;

/// Every path into the file that a root schema describes, such as `sensor.range_cm`, with the schema
/// of what it leads to. An element of a list is `[]`, whichever it is.
#[must_use]
pub fn paths(root: &Value) -> Vec<(String, Value)> {
    let mut paths = Vec::new();
    walk(root, root, "", &mut paths);
    paths
}

/// The definition that the schema refers to, or else the schema itself.
pub(super) fn resolved<'a>(root: &'a Value, schema: &'a Value) -> &'a Value {
    let reference = schema
        .get("$ref")
        .or_else(|| schema.pointer("/allOf/0/$ref"))
        .or_else(|| schema.pointer("/anyOf/0/$ref"))
        .and_then(Value::as_str);
    reference
        .and_then(|target| root.pointer(target.trim_start_matches('#')))
        .unwrap_or(schema)
}

/// Notes what lies below the `schema` at `path`.
fn walk(root: &Value, schema: &Value, path: &str, paths: &mut Vec<(String, Value)>) {
    let schema = resolved(root, schema);
    let alternatives = schema.get("oneOf").and_then(Value::as_array);
    for alternative in alternatives.into_iter().flatten() {
        walk(root, alternative, path, paths);
    }
    let mut note = |path: String, schema: &Value| {
        paths.push((path.clone(), schema.clone()));
        walk(root, schema, &path, paths);
    };
    let keys = schema.get("properties").and_then(Value::as_object);
    for (key, value) in keys.into_iter().flatten() {
        let dot = if path.is_empty() { "" } else { "." };
        note(format!("{path}{dot}{key}"), value);
    }
    if let Some(element) = schema.get("items") {
        note(format!("{path}[]"), element);
    }
}
