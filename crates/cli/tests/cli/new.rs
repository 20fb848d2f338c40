//! `adslam new`

use std::fs;

use serde_json::Value;

use super::support::Place;

/// The lines with all keys behind a `#` put in force, but for the tables that are alternatives.
fn with_optional_keys(template: &str) -> String {
    let mut in_alternative = false;
    let mut text = String::new();
    for line in template.lines() {
        if line.starts_with('[') {
            in_alternative = false;
        }
        in_alternative |= line.starts_with("#[");
        let key = line
            .strip_prefix('#')
            .filter(|rest| !rest.starts_with([' ', '[']));
        let line = match key.filter(|key| !key.is_empty() && !in_alternative) {
            Some(key) => key,
            None => line,
        };
        text += line;
        text.push('\n');
    }
    text
}

#[test]
fn what_is_written_is_valid_as_it_is_and_with_every_optional_key() {
    let place = Place::new(&[]);
    let said = place.succeeds("new scenario");
    assert!(
        said.out.contains("wrote scenario.toml; next: adslam run"),
        "{said:?}"
    );
    place.succeeds("new config");
    place.succeeds("new sweep");
    let said = place.succeeds("check scenario.toml config.toml sweep.toml");
    assert_eq!(said.err, "", "nothing to warn of");
    let template = place.read("scenario.toml");
    let all = with_optional_keys(&template);
    assert!(all.matches("\n#").count() < template.matches("\n#").count() - 20);
    fs::write(place.path("all.toml"), all).unwrap();
    fs::write(
        place.path("all-sweep.toml"),
        with_optional_keys(&place.read("sweep.toml")),
    )
    .unwrap();
    place.succeeds("check all.toml all-sweep.toml");
}

/// A key that is new in the reader has to come into the template.
#[test]
fn the_templates_have_every_key() {
    let place = Place::new(&[]);
    place.succeeds("new scenario");
    place.succeeds("new config");
    place.succeeds("new sweep");
    for (kind, roots) in [
        ("scenario", &["Scenario"][..]),
        ("config", &["Configuration", "Experiment"]),
        ("sweep", &["Sweep", "SweepPoint"]),
    ] {
        let output = place.command(&format!("schema {kind}")).output().unwrap();
        let schema: Value = serde_json::from_slice(&output.stdout).unwrap();
        let template = place.read(&format!("{kind}.toml"));
        let definitions = schema["definitions"].as_object().unwrap();
        let tables = definitions
            .iter()
            .map(|(name, table)| (name.as_str(), table))
            .chain([(schema["title"].as_str().unwrap(), &schema)])
            .filter(|(name, _)| kind == "scenario" || roots.contains(name));
        let mut keys = 0;
        for (table, definition) in tables {
            for key in definition["properties"]
                .as_object()
                .into_iter()
                .flatten()
                .map(|(key, _)| key)
            {
                keys += 1;
                let forms = [
                    format!("\n{key} = "),
                    format!("\n#{key} = "),
                    format!("[{key}]"),
                    format!("[{key}."),
                    format!(".{key}]"),
                    format!(".{key}."),
                    format!("`{key} = "),
                ];
                let known = forms.iter().any(|form| template.contains(form));
                assert!(known, "the template of a {kind} has no {key} of {table}");
            }
        }
        assert!(keys > 5, "{keys}");
    }
}

#[test]
fn a_configuration_finds_its_scenario() {
    let place = Place::new(&[]);
    place.refuses(
        "new config",
        &[
            "there is no scenario scenario.toml",
            "adslam new scenario --out scenario.toml",
        ],
    );
    place.succeeds("new scenario --out worlds/mine.toml");
    place.succeeds("new config --scenario worlds/mine.toml --out plans/all/mine.toml");
    let config = place.read("plans/all/mine.toml");
    assert!(
        config.contains("scenario = \"../../worlds/mine.toml\""),
        "{config}"
    );
    place.succeeds("check plans/all/mine.toml");
    fs::write(place.path("bad.toml"), "steps = 0\n").unwrap();
    place.refuses("new config --scenario bad.toml", &["bad.toml"]);
}

#[test]
fn nothing_is_overwritten_without_being_told() {
    let place = Place::new(&[("mine.toml", "precious")]);
    place.refuses(
        "new scenario --out mine.toml",
        &["mine.toml is there already", "--out", "--force"],
    );
    place.succeeds("new scenario --out mine.toml --force");
    place.succeeds("check mine.toml");
}
