//! The schema of `[experiments.set]`, whose keys are the paths of a scenario's keys.

use schemars::{Schema, SchemaGenerator, json_schema};
use serde_json::{Map, Value};

use crate::scenario::Scenario;

/// Every path into a scenario, with the schema of what it leads to.
pub(crate) fn overrides(generator: &mut SchemaGenerator) -> Schema {
    let root = generator.root_schema_for::<Scenario>().to_value();
    generator.subschema_for::<Scenario>();
    // The root is not among the paths, and nothing refers to it.
    generator.definitions_mut().remove("Scenario");
    let mut paths = Paths {
        root: &root,
        keys: Map::new(),
        elements: Map::new(),
    };
    paths.walk(&root, "", false);
    json_schema!({
        "type": "object",
        "properties": paths.keys,
        "patternProperties": paths.elements,
        "additionalProperties": false,
    })
}

/// The paths found so far.
struct Paths<'a> {
    root: &'a Value,
    keys: Map<String, Value>,
    /// Patterns of paths that lead through an element of a list.
    elements: Map<String, Value>,
}

impl Paths<'_> {
    /// Notes what lies below the `schema` at `path`, which is a pattern if it leads through an
    /// element of a list.
    fn walk(&mut self, schema: &Value, path: &str, is_pattern: bool) {
        if let Some(target) = schema.get("$ref").and_then(Value::as_str) {
            let target = self.root.pointer(target.trim_start_matches('#'));
            if let Some(target) = target.cloned() {
                self.walk(&target, path, is_pattern);
            }
        }
        for several in ["allOf", "anyOf", "oneOf"] {
            for part in schema
                .get(several)
                .and_then(Value::as_array)
                .into_iter()
                .flatten()
            {
                self.walk(part, path, is_pattern);
            }
        }
        let keys = schema.get("properties").and_then(Value::as_object);
        for (key, value) in keys.into_iter().flatten() {
            let dot = match (path.is_empty(), is_pattern) {
                (true, _) => "",
                (false, true) => r"\.",
                (false, false) => ".",
            };
            self.note(value, &format!("{path}{dot}{key}"), is_pattern);
        }
        if let Some(element) = schema.get("items") {
            let list = if is_pattern {
                path.to_owned()
            } else {
                path.replace('.', r"\.")
            };
            self.note(element, &format!(r"{list}\[\d+\]"), true);
        }
    }

    fn note(&mut self, schema: &Value, path: &str, is_pattern: bool) {
        if is_pattern {
            self.elements.insert(format!("^{path}$"), schema.clone());
        } else {
            self.keys.insert(path.to_owned(), schema.clone());
        }
        self.walk(schema, path, is_pattern);
    }
}
