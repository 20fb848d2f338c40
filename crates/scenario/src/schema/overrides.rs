//! The schemas of tables whose keys are the paths of a scenario's keys, such as `[experiments.set]`.

use adslam_documents::paths;
use schemars::{Schema, SchemaGenerator, json_schema};
use serde_json::{Map, Value, json};

use crate::Scenario;
use crate::values::LONGEST_LIST;

/// Every path into a scenario, with the schema of what it leads to.
pub(crate) fn overrides(generator: &mut SchemaGenerator) -> Schema {
    table_of_paths(generator, |schema| schema)
}

/// Every path into a scenario, with the schema of a list of what may stand there.
pub(crate) fn lists_of_overrides(generator: &mut SchemaGenerator) -> Schema {
    table_of_paths(generator, |schema| {
        json!({
            "type": "array",
            "items": schema,
            "minItems": 1,
            "maxItems": LONGEST_LIST,
            "uniqueItems": true,
        })
    })
}

fn table_of_paths(generator: &mut SchemaGenerator, value: fn(Value) -> Value) -> Schema {
    let root = generator.root_schema_for::<Scenario>().to_value();
    generator.subschema_for::<Scenario>();
    // The root is not among the paths, and nothing refers to it.
    generator.definitions_mut().remove("Scenario");
    let (mut keys, mut elements) = (Map::new(), Map::<String, Value>::new());
    for (path, schema) in paths(&root) {
        let schema = value(schema);
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
