//! What a point's runs depend on, as keys and values.

use std::collections::BTreeMap;

use crc32fast::Hasher;
use serde_json::{Map, Value};

/// Every key of a scenario that has a value, by its path. Lists are values.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Content(BTreeMap<String, Value>);

impl Content {
    /// Of a scenario as JSON.
    pub(super) fn of(scenario: &Value) -> Self {
        let mut content = Self::default();
        content.add(String::new(), scenario);
        content
    }

    fn add(&mut self, path: String, value: &Value) {
        match value {
            Value::Null => {}
            Value::Object(table) if !table.is_empty() => {
                let dot = if path.is_empty() { "" } else { "." };
                for (key, value) in table {
                    self.add(format!("{path}{dot}{key}"), value);
                }
            }
            value => drop(self.0.insert(path, value.clone())),
        }
    }

    pub(super) fn get(&self, key: &str) -> Option<&Value> {
        self.0.get(key)
    }

    /// What is to be set in `base` for it to become this; null where it has no such key.
    pub(super) fn set_in(&self, base: &Self) -> Map<String, Value> {
        let gone = base.0.keys().filter(|key| !self.0.contains_key(*key));
        let gone = gone.map(|key| (key, Value::Null));
        let other = self
            .0
            .iter()
            .filter(|(key, value)| base.get(key) != Some(value));
        let set: BTreeMap<_, _> = gone
            .chain(other.map(|(key, value)| (key, value.clone())))
            .collect();
        set.into_iter()
            .map(|(key, value)| (key.clone(), value))
            .collect()
    }

    /// A checksum of all of it and of the object, to which planner and seed can be added.
    pub(super) fn hasher(&self, kind: &str, object: &str) -> Hasher {
        let mut hasher = Hasher::new();
        for text in [kind, object] {
            hasher.update(text.as_bytes());
            hasher.update(b"\n");
        }
        for (key, value) in &self.0 {
            hasher.update(format!("{key}={value}\n").as_bytes());
        }
        hasher
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn what_is_set_leads_from_one_to_the_other() {
        let base = Content::of(&json!({"a": 1, "b": {"c": [1, 2], "d": null}, "e": {"f": 2}}));
        let other = Content::of(&json!({"a": 1, "b": {"c": [1, 3], "d": 4}, "g": {}}));
        let set = json!({"b.c": [1, 3], "b.d": 4, "e.f": null, "g": {}});
        assert_eq!(Value::Object(other.set_in(&base)), set);
        assert!(base.set_in(&base).is_empty());
    }

    #[test]
    fn the_checksum_is_of_every_part() {
        let of = |kind: &str, object: &str, value: Value| {
            Content::of(&value).hasher(kind, object).finalize()
        };
        let one = of("sweep", "a", json!({"x": 1.0}));
        for other in [
            of("tables", "a", json!({"x": 1.0})),
            of("sweep", "b", json!({"x": 1.0})),
            of("sweep", "a", json!({"x": 1.5})),
            of("sweep", "a", json!({"y": 1.0})),
        ] {
            assert_ne!(one, other);
        }
    }
}
