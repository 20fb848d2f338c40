//! docs/scenario.md tells every key of every kind of file.

use std::collections::BTreeSet;

use adslam_diagnostics::InputError;

use super::{HEART, POLYGON, parsed};
use crate::config::{Config, Published};

const REFERENCE: &str = include_str!("../../../../docs/scenario.md");

/// A configuration and a file of published results with an entry of every table.
const CONFIG: &str =
    "title = \"t\"\n[[experiments]]\nscenario = \"s.toml\"\nplanners = [\"local\"]\n";
const PUBLISHED: &str = r#"title = "t"
[tables.x]
coverage_table = "I"
error_table = "II"
[tables.x.planners.local]
observed = [1]
steps = ["-"]
pose_error_max = 1
pose_error_mean = 1
feature_error_max_cm = 1
feature_error_mean_cm = 1
"#;

/// The keys that a table knows, from the answer to one that it does not. The error of a choice
/// lists the choices in the same way.
fn known_keys(error: &InputError) -> BTreeSet<String> {
    let help = error.remedy().unwrap_or_default();
    let list = help.rsplit_once(" here: ").map_or("", |(_, list)| list);
    list.split('`')
        .skip(1)
        .step_by(2)
        .map(str::to_owned)
        .collect()
}

#[test]
fn every_key_of_a_scenario_is_explained() {
    let tables = [
        "",
        "object",
        "object.points",
        "object.mesh",
        "object.phantom",
        "mesh_placement",
        "motion",
        "motion.translation",
        "motion.translation.back_and_forth",
        "motion.translation.sinusoid",
        "motion.deformation",
        "motion.deformation.anchored",
        "motion.deformation.anchored_sinusoid",
        "motion.translation_rotation",
        "mismatch",
        "mismatch.rotation",
        "noise",
        "filter",
        "sensor",
        "robot",
        "robot.actions",
        "viewpoints",
        "viewpoints.sampled",
        "viewpoints.fixed",
        "planners",
        "planners.predetermined",
        "planners.local",
        "planners.global",
        "planners.combined",
    ];
    let mut keys = BTreeSet::new();
    for table in tables {
        // Only the table itself, so that the unknown key is the first thing wrong.
        let text = if table.is_empty() {
            "zzz = 1".to_owned()
        } else {
            format!("[{table}]\nzzz = 1")
        };
        let found = known_keys(&parsed(&text).unwrap_err());
        assert!(!found.is_empty(), "{table}");
        keys.extend(found);
    }
    assert!(keys.len() > 80, "{keys:?}");
    assert_explained(&keys);
}

#[test]
fn every_key_of_the_other_files_is_explained() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("file.toml");
    let mut keys = BTreeSet::new();
    for after in ["title = \"t\"\n", "planners = [\"local\"]\n"] {
        std::fs::write(&path, CONFIG.replace(after, &format!("{after}zzz = 1\n"))).unwrap();
        keys.extend(known_keys(&Config::load(&path).unwrap_err()));
    }
    for after in [
        "title = \"t\"\n",
        "error_table = \"II\"\n",
        "steps = [\"-\"]\n",
    ] {
        std::fs::write(
            &path,
            PUBLISHED.replace(after, &format!("{after}zzz = 1\n")),
        )
        .unwrap();
        keys.extend(known_keys(&Published::load(&path).unwrap_err()));
    }
    assert!(keys.len() > 15, "{keys:?}");
    assert_explained(&keys);
}

#[track_caller]
fn assert_explained(keys: &BTreeSet<String>) {
    let missing: Vec<&String> = keys
        .iter()
        .filter(|key| !REFERENCE.contains(&format!("`{key}`")))
        .collect();
    assert!(
        missing.is_empty(),
        "docs/scenario.md does not explain {missing:?}"
    );
}

#[test]
fn the_example_of_a_whole_scenario_is_valid() {
    let example = REFERENCE
        .split("```toml\n")
        .skip(1)
        .filter_map(|rest| rest.split("```").next())
        .find(|example| example.contains("name ="))
        .unwrap();
    parsed(example).unwrap();
}

#[test]
fn the_shipped_files_use_explained_keys_only() {
    for text in [POLYGON, HEART] {
        for line in text.lines() {
            let Some((key, _)) = line.split_once(" = ") else {
                continue;
            };
            if !line.starts_with(['[', '#']) {
                assert!(REFERENCE.contains(&format!("`{key}`")), "{key}");
            }
        }
    }
}
