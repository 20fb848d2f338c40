//! What a schema knows that helps the author of a wrong file.

use schemars::JsonSchema;
use serde_json::Value;

use super::paths::{paths, resolved};
use super::root_schema;

/// The keys of a kind of file.
#[derive(Debug)]
pub struct Advice {
    root: Value,
    paths: Vec<(String, Value)>,
}

impl Advice {
    /// The keys of the files that are read as a `T`.
    pub fn of<T: JsonSchema>() -> Self {
        let root = root_schema::<T>();
        let mut paths = paths(&root);
        // Overrides are paths themselves.
        let is_override = |path: &str| {
            path.starts_with("set.") || path.starts_with("grid.") || path.contains("].set.")
        };
        paths.retain(|(path, _)| !is_override(path));
        Self { root, paths }
    }

    /// The tables that have a key of this name, the root being "": those below `table` or, where
    /// there is none, all.
    pub fn tables_with(&self, key: &str, table: &str) -> Vec<&str> {
        let parents = self.paths.iter().filter_map(|(path, _)| {
            let (parent, last) = path.rsplit_once('.').unwrap_or(("", path));
            (last == key).then_some(parent)
        });
        let all: Vec<&str> = parents.collect();
        let below = |path: &&str| {
            path.strip_prefix(table)
                .is_some_and(|rest| rest.starts_with('.'))
        };
        let near: Vec<&str> = all.iter().copied().filter(below).collect();
        if near.is_empty() { all } else { near }
    }

    /// The tables that may be chosen at a path.
    pub fn choices_at(&self, path: &str) -> Vec<&str> {
        let choice = self.at(path).map(|schema| resolved(&self.root, schema));
        choice
            .filter(|schema| schema["maxProperties"] == 1)
            .and_then(|schema| schema["properties"].as_object())
            .map(|tables| tables.keys().map(String::as_str).collect())
            .unwrap_or_default()
    }

    /// Whether the key at a path is a table.
    pub fn is_table(&self, path: &str) -> bool {
        let schema = self.at(path).map(|schema| resolved(&self.root, schema));
        schema.is_some_and(|schema| schema["type"] == "object")
    }

    /// What the key at a path means.
    pub fn meaning(&self, path: &str) -> Option<&str> {
        self.at(path)?["description"].as_str()
    }

    fn at(&self, path: &str) -> Option<&Value> {
        let mut parts = path.split('[');
        let mut wanted = parts.next().unwrap_or_default().to_owned();
        for part in parts {
            wanted += "[]";
            wanted += part.split_once(']').map_or("", |(_, rest)| rest);
        }
        let found = self.paths.iter().find(|(path, _)| *path == wanted);
        found.map(|(_, schema)| schema)
    }
}
