//! The schema of `[experiments.set]`, whose keys are the paths of a scenario's keys.

use schemars::{Schema, SchemaGenerator, json_schema};
use serde_json::{Map, Value};

use super::paths::paths;
use crate::scenario::Scenario;

/// Every path into a scenario, with the schema of what it leads to.
pub(crate) fn overrides(generator: &mut SchemaGenerator) -> Schema {
    let root = generator.root_schema_for::<Scenario>().to_value();
    generator.subschema_for::<Scenario>();
    // The root is not among the paths, and nothing refers to it.
    generator.definitions_mut().remove("Scenario");
    let (mut keys, mut elements) = (Map::new(), Map::<String, Value>::new());
    for (path, schema) in paths(&root) {
        if path.contains("[]") {
            let pattern = path.replace('.', r"\.").replace("[]", r"\[\d+\]");
            elements.insert(format!("^{pattern}$"), schema);
        } else {
            keys.insert(path, schema);
        }
    }
    json_schema!({
        "type": "object",
        "properties": keys,
        "patternProperties": elements,
        "additionalProperties": false,
    })
}
