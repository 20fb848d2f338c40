//! `adslam schema`, and the schemas that the shipped files name.

use std::fs;

use serde_json::Value;

use super::support::{BAD_INPUT, Place, repository};

#[test]
fn the_printed_schemas_are_those_that_are_shipped() {
    let place = Place::new(&[]);
    for kind in ["scenario", "config", "published", "sweep"] {
        let output = place.command(&format!("schema {kind}")).output().unwrap();
        assert!(output.status.success() && output.stderr.is_empty());
        let printed = String::from_utf8(output.stdout).unwrap();
        let file = format!("schemas/{kind}.schema.json");
        assert!(
            fs::read_to_string(repository(&file)).unwrap() == printed,
            "{file} is stale; `cargo xtask docs` renews it"
        );
        let schema: Value = serde_json::from_str(&printed).unwrap();
        assert_eq!(schema["type"], "object");
        assert_eq!(schema["additionalProperties"], false);
    }
}

#[test]
fn every_shipped_file_names_its_schema_first() {
    for folder in ["scenarios", "configs", "sweeps"] {
        for entry in fs::read_dir(repository(folder)).unwrap() {
            let path = entry.unwrap().path();
            let text = fs::read_to_string(&path).unwrap();
            let kind = match (folder, path.file_name().unwrap().to_str().unwrap()) {
                ("scenarios", _) => "scenario",
                ("sweeps", _) => "sweep",
                (_, "published.toml") => "published",
                _ => "config",
            };
            let directive = format!("#:schema ../schemas/{kind}.schema.json\n");
            assert!(text.starts_with(&directive), "{}", path.display());
        }
    }
}

#[test]
fn an_unknown_kind_is_answered_with_the_known_ones() {
    let said = Place::new(&[]).adslam("schema scenarios");
    assert_eq!(said.code, Some(BAD_INPUT));
    assert!(
        said.err.contains("scenario, config, published, sweep"),
        "{said:?}"
    );
}
