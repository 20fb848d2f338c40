//! The files of `adslam run` are those of docs/run.md, column by column and key by key.

use std::collections::BTreeSet;
use std::fs;

use serde_json::Value;

use super::support::{PLANNERS, Place, documented, polygon, repository};

/// Everything that can go wrong with a measurement does, and a gate keeps some of it out.
const FAULTS: &str = "[mismatch]
outlier_probability = 0.3
outlier_sigma_cm = 1.0
missed_detection_probability = 0.3
dropped_structure_probability = 0.5

[filter]
gate_probability = 0.99

[noise]";

fn documentation() -> String {
    fs::read_to_string(repository("docs/run.md")).unwrap()
}

/// The keys of an object, those of objects in it after a point.
fn keys(value: &Value) -> BTreeSet<String> {
    let mut all = BTreeSet::new();
    for (key, value) in value.as_object().unwrap() {
        all.insert(key.clone());
        if value.is_object() {
            all.extend(keys(value).iter().map(|inner| format!("{key}.{inner}")));
        }
    }
    all
}

#[test]
fn every_file_column_and_key_is_documented() {
    let document = documentation();
    let place = Place::new(&[
        ("good.toml", &polygon(&[])),
        ("faulty.toml", &polygon(&[("[noise]", FAULTS)])),
    ]);
    let set =
        |heading| -> BTreeSet<String> { documented(&document, heading).into_iter().collect() };
    let of_faulty = set("## summary.json");
    let mut of_good = of_faulty.clone();
    of_good.retain(|key| !key.starts_with("faults"));

    for planner in PLANNERS {
        for (world, expected) in [("good", &of_good), ("faulty", &of_faulty)] {
            let out = format!("{world}/{planner}");
            place.succeeds(&format!(
                "run {world}.toml --planner {planner} --seed 2 --out {out} --html --log"
            ));
            assert_eq!(keys(&place.json(&format!("{out}/summary.json"))), *expected);
            for table in ["steps.csv", "pose_covariance.csv", "features.csv"] {
                let text = place.read(&format!("{out}/{table}"));
                let columns: Vec<&str> = text.lines().next().unwrap().split(',').collect();
                assert_eq!(columns, documented(&document, &format!("## {table}")));
            }
            let mut run = keys(&place.json(&format!("{out}/run.json")));
            run.retain(|key| !key.starts_with("files."));
            assert_eq!(run, set("## run.json"));
            let written: BTreeSet<String> = fs::read_dir(place.path(&out))
                .unwrap()
                .map(|entry| entry.unwrap().file_name().into_string().unwrap())
                .collect();
            assert_eq!(written, set("## Files"));
        }
    }
}

/// Every name has a meaning, and the unit that it ends with.
#[test]
fn units_are_those_of_the_columns() {
    let units = [
        ("_rad2_cm2", "rad² and cm²"),
        ("_rad2", "rad²"),
        ("_cm2", "cm²"),
        ("_rad_times_cm", "rad · cm"),
        ("_rad_cm", "rad and cm"),
        ("_rad", "rad"),
        ("_cm", "cm"),
        ("_time_ms", "ms"),
    ];
    let document = documentation();
    let rows = document.lines().filter(|line| line.starts_with("| `"));
    let mut with_unit = 0;
    for row in rows {
        let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
        let [names, unit, meaning] = cells[..] else {
            continue;
        };
        assert!(!meaning.is_empty(), "{names}");
        for name in names.split('`').skip(1).step_by(2) {
            let of_name = units.iter().find(|(end, _)| name.ends_with(end));
            if let Some((_, expected)) = of_name {
                assert_eq!(unit, *expected, "{name}");
                with_unit += 1;
            }
        }
    }
    assert!(with_unit > 40, "{with_unit}");
}
