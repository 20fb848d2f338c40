//! The folder of a run holds one run, whole, and nothing else.

use std::collections::BTreeMap;
use std::fs;

use serde_json::{Value, json};

use super::support::{PLANNERS, Place, heart, polygon};
use super::sweep::sweep;
use super::tables::config;

/// What `adslam run` leaves, pages and logs apart.
pub const FILES: [&str; 9] = [
    "estimate.tum",
    "features.csv",
    "history.json",
    "pose_covariance.csv",
    "run.json",
    "scenario.toml",
    "steps.csv",
    "summary.json",
    "truth.tum",
];

pub const RUN: &str = "run polygon.toml --planner predetermined --out";

pub fn place() -> Place {
    Place::new(&[("polygon.toml", &polygon(&[]))])
}

pub fn names(place: &Place, folder: &str) -> Vec<String> {
    let entries = fs::read_dir(place.path(folder)).unwrap();
    let mut names: Vec<String> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

fn write_json(place: &Place, name: &str, value: &Value) {
    fs::write(place.path(name), value.to_string()).unwrap();
}

/// The files of a run, times and what depends on them taken out.
fn without_times(place: &Place, folder: &str) -> BTreeMap<String, String> {
    let mut files = BTreeMap::new();
    for name in names(place, folder) {
        let path = format!("{folder}/{name}");
        let text = match &*name {
            "summary.json" => {
                let mut json = place.json(&path);
                json["decision_ms"].take();
                json.to_string()
            }
            "run.json" => {
                let mut json = place.json(&path);
                for of_times in ["summary.json", "steps.csv", "history.json"] {
                    json["files"][of_times].take();
                }
                json.to_string()
            }
            "history.json" => {
                let mut json = place.json(&path);
                for step in json["steps"].as_array_mut().unwrap() {
                    step["decision"]["milliseconds"].take();
                }
                json.to_string()
            }
            "steps.csv" => {
                let text = place.read(&path);
                let time = |line: &str| line.rsplit_once(',').unwrap().0.to_owned();
                assert!(text.lines().next().unwrap().ends_with(",decision_time_ms"));
                text.lines().map(time).collect::<Vec<_>>().join("\n")
            }
            _ => place.read(&path),
        };
        files.insert(name, text);
    }
    files
}

#[test]
fn a_run_says_what_it_is() {
    let place = place();
    place.succeeds("run polygon.toml --planner local --seed 7 --out run");
    assert_eq!(names(&place, "run"), FILES);
    let run = place.json("run/run.json");
    assert_eq!(
        (&run["format"], &run["version"]),
        (&json!("adslam-run"), &json!(1))
    );
    assert_eq!(run["complete"], true);
    assert_eq!(
        (&run["scenario"], &run["planner"]),
        (&json!("polygon"), &json!("local"))
    );
    assert_eq!(run["seed"], 7);
    assert_eq!(run["object_checksum"].as_str().unwrap().len(), 8);
    let version = env!("CARGO_PKG_VERSION");
    assert_eq!(run["made_by"]["program"], format!("adslam {version}"));
    assert!(run["made_by"]["results_version"].is_number());
    let files: Vec<&String> = run["files"].as_object().unwrap().keys().collect();
    let parts: Vec<&str> = FILES
        .into_iter()
        .filter(|name| *name != "run.json")
        .collect();
    assert_eq!(files, parts);
}

/// Every planner, and a mesh given beside the scenario.
#[test]
fn the_scenario_of_a_run_gives_the_run_again() {
    let place = place();
    let placed = [
        ("features = 50", "features = 12"),
        ("unit = \"mm\"", "unit = \"cm\""),
        (
            "offset_cm = [5.0, 18.0, 110.0]",
            "rotation_deg = [0.0, 0.0, 5.0]",
        ),
    ];
    fs::write(place.path("heart.toml"), heart(&placed)).unwrap();
    place.succeeds("run heart.toml --planner predetermined --out heart");
    place.succeeds("export heart --format ply --out ply");
    let mut runs: Vec<String> = PLANNERS
        .map(|planner| format!("run polygon.toml --planner {planner}"))
        .into();
    runs.push("run heart.toml --planner local --mesh ply/surface-0001.ply".to_owned());
    for (number, run) in runs.iter().enumerate() {
        let planner = run.split(' ').nth(3).unwrap();
        let (first, again) = (format!("first-{number}"), format!("deeper/again-{number}"));
        place.succeeds(&format!("{run} --seed 5 --out {first}"));
        place.succeeds(&format!(
            "run {first}/scenario.toml --planner {planner} --seed 5 --out {again}"
        ));
        let (first, again) = (without_times(&place, &first), without_times(&place, &again));
        for (name, text) in &first {
            assert_eq!(again.get(name), Some(text), "{run}: {name}");
        }
    }
    let meshed = place.read("first-4/scenario.toml");
    assert!(
        meshed.contains("[object.mesh]") && !meshed.contains("[object.phantom]"),
        "{meshed}"
    );
    let object =
        |folder: &str| place.json(&format!("{folder}/run.json"))["object_checksum"].clone();
    assert_ne!(object("first-4"), object("heart"));
}

/// Defaults are written too: a later version may have others.
#[test]
fn the_scenario_of_a_run_has_every_key_that_has_a_value() {
    let place = place();
    place.succeeds(&format!("{RUN} run"));
    let text = place.read("run/scenario.toml");
    assert!(
        !polygon(&[]).contains("min_range_cm") && text.contains("min_range_cm = 0.1"),
        "{text}"
    );
    for key in [
        "estimator = \"euler_ekf\"",
        "outlier_probability = 0.0",
        "deformation_noise = \"fresh\"",
    ] {
        assert!(text.contains(key), "no {key} in {text}");
    }
}

#[test]
fn a_run_made_anew_replaces_the_old_one_as_a_whole() {
    let place = place();
    place.succeeds(&format!("{RUN} run --html"));
    fs::write(place.path("run/log.jsonl"), "old").unwrap();
    place.succeeds(&format!("{RUN} run --seed 2"));
    assert_eq!(
        names(&place, "run"),
        FILES,
        "an old page or log beside a new run"
    );
    assert_eq!(place.json("run/run.json")["seed"], 2);
    place.succeeds(&format!("{RUN} run --seed 3 --html"));
    let said = place.succeeds("replay run --out page.html");
    assert!(!said.err.contains("warning"), "{said:?}");
    assert_eq!(place.read("page.html"), place.read("run/replay.html"));
}

/// Folders from before there was a run.json.
#[test]
fn runs_of_older_versions_are_read_and_replaced() {
    let place = place();
    place.succeeds(&format!("{RUN} run"));
    for new in ["run.json", "scenario.toml", "pose_covariance.csv"] {
        fs::remove_file(place.path("run").join(new)).unwrap();
    }
    let said = place.succeeds("replay run --out page.html");
    assert!(
        said.err.contains("warning: run has no run.json"),
        "{said:?}"
    );
    place.succeeds(&format!("{RUN} run"));
    assert_eq!(names(&place, "run"), FILES);
}

#[test]
fn a_folder_with_anything_else_is_refused() {
    let place = Place::new(&[
        ("polygon.toml", &polygon(&[])),
        ("sweep.toml", &sweep(1)),
        ("config.toml", &config(1, &["predetermined"])),
    ]);
    place.succeeds("sweep sweep.toml --out sweep");
    place.succeeds("tables config.toml --out tables");
    place.succeeds(&format!("{RUN} run"));
    place.succeeds("replay run --out pages/replay.html");
    place.succeeds("new scenario --out scenarios/scenario.toml");
    fs::copy(place.path("run/steps.csv"), place.path("pages/steps.csv")).unwrap();
    fs::write(place.path("run/notes.md"), "mine").unwrap();
    let otherwise = "give another folder with --out, or move away what is there";
    for (folder, found) in [
        ("sweep", "sweep holds "),
        ("tables", "tables holds "),
        (
            "pages",
            "pages holds replay.html and 1 more, which is no part of a run",
        ),
        (
            "scenarios",
            "scenarios holds scenario.toml, which is no part of a run",
        ),
        ("run", "run holds notes.md, which is no part of a run"),
        (".", ". holds config.toml and "),
    ] {
        place.refuses(&format!("{RUN} {folder}"), &[found, otherwise]);
    }
    // What a system puts into every folder is nobody's.
    fs::remove_file(place.path("run/notes.md")).unwrap();
    fs::write(place.path("run/.DS_Store"), "").unwrap();
    place.succeeds(&format!("{RUN} run"));
    let holds = [
        "run holds results of something else: run.json",
        "give another folder with --out",
    ];
    place.refuses("sweep sweep.toml --out run", &holds);
}

/// An output must not fall among the files of a run.
#[test]
fn the_files_of_a_run_are_overwritten_by_no_other_command() {
    let place = place();
    place.succeeds(&format!("{RUN} run --log"));
    let words = [
        "is a part of the run in its folder",
        "give another path with --out",
    ];
    for command in [
        "replay run --out run/history.json",
        "export run --format csv --out run/steps.csv",
        "export run --format mcap --out run/run.json",
        "filter run/log.jsonl --out run/steps.csv",
        "filter run/log.jsonl --out estimates.jsonl --tum run/truth.tum",
        "new scenario --out run/scenario.toml --force",
    ] {
        place.refuses(command, &words);
    }
    place.succeeds("replay run --out run/replay.html");
}

#[test]
fn parts_of_two_runs_are_told_apart() {
    let place = place();
    place.succeeds(&format!("{RUN} run"));
    place.succeeds(&format!("{RUN} other --seed 2"));
    fs::copy(place.path("other/steps.csv"), place.path("run/steps.csv")).unwrap();
    let said = place.succeeds("export run --format csv --out state.csv");
    let told = "run/steps.csv is not the file that run.json beside it names";
    assert!(said.err.contains(&format!("warning: {told}")), "{said:?}");
    let output = place
        .command("replay run --out page.html --json")
        .output()
        .unwrap();
    let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(
        answer["warnings"][0].as_str().unwrap().contains(told),
        "{answer}"
    );

    fs::copy(
        place.path("other/history.json"),
        place.path("run/history.json"),
    )
    .unwrap();
    for command in [
        "replay run --out new.html",
        "replay other run --out new.html",
        "export run --format ply --out ply",
    ] {
        let words = [
            "run/history.json is not the file that run.json",
            "make the run again",
        ];
        place.refuses(command, &words);
    }
}

/// As a run that was killed while its files were put in their places.
#[test]
fn half_a_run_is_none() {
    let place = place();
    place.succeeds(&format!("{RUN} run"));
    let mut run = place.json("run/run.json");
    run["complete"] = json!(false);
    write_json(&place, "run/run.json", &run);
    place.refuses(
        "replay run --out page.html",
        &["run does not hold a whole run", "make the run again"],
    );
    run["complete"] = json!(true);
    run["version"] = json!(2);
    write_json(&place, "run/run.json", &run);
    place.refuses(
        "replay run --out page.html",
        &["has version 2", "reads version 1"],
    );
    fs::remove_file(place.path("run/steps.csv")).unwrap();
    place.succeeds(&format!("{RUN} run"));
    assert_eq!(names(&place, "run"), FILES);
}
