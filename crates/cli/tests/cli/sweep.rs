//! `adslam sweep`

use std::fs;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use super::failures::breaking;
use super::support::{FAILURE, Place, polygon, repository};

/// The files of tables, which must be the same however a sweep came to its end.
pub fn written() -> Vec<String> {
    let mut names = vec!["table.md".to_owned()];
    for table in ["runs", "table", "comparisons"] {
        names.extend(["csv", "jsonl"].map(|format| format!("{table}.{format}")));
        if cfg!(feature = "parquet") {
            names.push(format!("{table}.parquet"));
        }
    }
    names
}

/// A sweep of two points and two planners over the polygon in `polygon.toml`.
pub fn sweep(runs: usize) -> String {
    format!(
        "title = \"A few runs\"\nruns = {runs}\nscenario = \"polygon.toml\"\n\
         planners = [\"predetermined\", \"local\"]\n\n[grid]\n\"sensor.range_cm\" = [2.0, 3.0]\n"
    )
}

/// A folder with the polygon and a sweep of this many runs of each planner at each point.
pub fn place(runs: usize) -> Place {
    Place::new(&[
        ("polygon.toml", &polygon(&[])),
        ("sweep.toml", &sweep(runs)),
    ])
}

/// Starts the command without waiting for its end.
pub fn start(place: &Place, arguments: &str) -> Child {
    Command::new(env!("CARGO_BIN_EXE_adslam"))
        .args(arguments.split_whitespace())
        .current_dir(place.path(""))
        .env("RAYON_NUM_THREADS", "2")
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

/// The names of the records that are there.
pub fn records(place: &Place, out: &str) -> Vec<String> {
    let Ok(entries) = fs::read_dir(place.path(out).join("records")) else {
        return Vec::new();
    };
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    names.filter(|name| !name.starts_with('.')).collect()
}

/// Waits until there are this many records.
pub fn wait_for_records(place: &Place, out: &str, count: usize) {
    let start = Instant::now();
    while records(place, out).len() < count {
        assert!(
            start.elapsed() < Duration::from_secs(30),
            "no {count} records"
        );
        sleep(Duration::from_millis(1));
    }
}

/// The bytes of all tables.
pub fn tables(place: &Place, out: &str) -> Vec<Vec<u8>> {
    let table = |name| fs::read(place.path(out).join(name)).unwrap();
    written().into_iter().map(table).collect()
}

/// The command's one object of JSON.
fn answered(place: &Place, arguments: &str) -> Value {
    let output = place
        .command(&format!("{arguments} --json"))
        .output()
        .unwrap();
    assert!(output.status.success(), "{output:?}");
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn tables_of_every_point_and_planner() {
    let place = place(3);
    let said = place.succeeds("sweep sweep.toml --out new/out");
    assert!(
        said.out
            .starts_with("12 runs at 2 points; wrote runs.csv, "),
        "{said:?}"
    );
    assert_eq!(said.err, "");
    let runs = place.read("new/out/runs.csv");
    assert_eq!(runs.lines().count(), 13);
    let head = "point,label,sensor.range_cm,planner,seed,observed,steps_to_full_coverage,";
    assert!(runs.starts_with(head), "{runs}");
    assert!(runs.contains("\n2,,3.0,local,3,"), "{runs}");
    assert_eq!(place.read("new/out/table.csv").lines().count(), 5);
    let markdown = place.read("new/out/table.md");
    for part in [
        "# A few runs",
        "with the seeds 1 to 3",
        "| point | `range_cm` |",
        "too few",
    ] {
        assert!(markdown.contains(part), "no {part:?} in {markdown}");
    }

    // A run of the same seed elsewhere is the same.
    place.succeeds("run polygon.toml --planner local --seed 3 --out run");
    let summary = place.json("run/summary.json");
    let lines = place.read("new/out/runs.jsonl");
    let row: Value = serde_json::from_str(lines.lines().last().unwrap()).unwrap();
    for key in [
        "seed",
        "observed",
        "pose_error_mean",
        "relative_pose_error_mean",
        "pose_nees_mean",
    ] {
        assert_eq!(row[key], summary[key], "{key}");
    }
}

#[test]
fn a_finished_sweep_only_writes_its_tables_anew() {
    let place = place(2);
    let answer = answered(&place, "sweep sweep.toml --out out --runs 3");
    assert_eq!(
        (&answer["runs"], &answer["runs_there_already"]),
        (&json!(12), &json!(0))
    );
    assert_eq!(answer["files"].as_array().unwrap().len(), written().len());
    let before = tables(&place, "out");
    fs::remove_file(place.path("out/table.md")).unwrap();
    let said = place.succeeds("sweep sweep.toml --out out --runs 3");
    assert!(
        said.out.starts_with("12 of 12 runs were there already"),
        "{said:?}"
    );
    assert_eq!(tables(&place, "out"), before);
    let answer = answered(&place, "sweep sweep.toml --out out --runs 3");
    assert_eq!(
        (&answer["runs_there_already"], &answer["complete"]),
        (&json!(12), &json!(true))
    );
}

#[test]
fn runs_that_fail_are_told_and_tried_again() {
    let text = sweep(2).replace("polygon.toml", "breaking.toml");
    let place = Place::new(&[("breaking.toml", &breaking()), ("sweep.toml", &text)]);
    for _ in 0..2 {
        let said = place.adslam("sweep sweep.toml --out out");
        assert_eq!(said.code, Some(FAILURE), "{said:?}");
        for word in [
            "0 of 8 runs are kept in out; the same command does the others",
            "8 of the runs failed",
            "[0001-local-seed1] polygon, local, seed 1: the planner failed at step 1",
        ] {
            assert!(said.err.contains(word), "{said:?}");
        }
    }
    assert!(
        place
            .read("out/partial/table.md")
            .contains("**Incomplete: 8 runs failed.**")
    );
    assert!(
        place
            .read("out/partial/table.csv")
            .contains("\n1,,2.0,local,0,2")
    );
}

/// More runs, points and planners: only what is missing is done, and the tables are those of the whole.
#[test]
fn a_sweep_grows() {
    let place = place(2);
    place.succeeds("sweep sweep.toml --out out");
    let grown = sweep(3)
        .replace("[2.0, 3.0]", "[2.0, 2.5, 3.0]")
        .replace("\"local\"]", "\"local\", \"global\"]");
    fs::write(place.path("grown.toml"), grown).unwrap();
    let said = place.succeeds("sweep grown.toml --out out");
    assert!(
        said.out.starts_with("8 of 27 runs were there already"),
        "{said:?}"
    );
    place.succeeds("sweep grown.toml --out whole");
    assert_eq!(tables(&place, "out"), tables(&place, "whole"));
    let said = place.refuses(
        "sweep sweep.toml --out out",
        &["seeds 1–3 there and 1–2 here"],
    );
    assert!(
        said.err
            .contains("planners predetermined, local, global there")
    );
    assert!(said.err.contains("the point with `sensor.range_cm` = 2.5"));
}

/// Tables of a part of the runs lie apart, and go when the whole is there.
#[test]
fn tables_that_lack_runs_replace_none_that_do_not() {
    let place = place(2);
    place.succeeds("sweep sweep.toml --out out");
    let before = tables(&place, "out");
    let worse = "[[points]]\nset = { \"filter.rotation_sigma_rad\" = 3.0, \
        \"filter.translation_sigma_cm\" = 1e6, \"filter.feature_measurement_sigma_cm\" = 1e-9, \
        \"filter.structure_measurement_sigma_cm\" = 1e-9 }\n";
    fs::write(place.path("worse.toml"), sweep(2) + worse).unwrap();
    let said = place.adslam("sweep worse.toml --out out");
    assert_eq!(said.code, Some(FAILURE), "{said:?}");
    assert!(said.out.contains("so they lie apart"), "{said:?}");
    assert_eq!(tables(&place, "out"), before);
    let partial = place.read("out/partial/table.md");
    assert!(partial.contains("**Incomplete: "), "{partial}");
}

#[test]
fn a_wrong_value_in_the_grid_is_shown_there() {
    let text = sweep(1).replace("[2.0, 3.0]", "[2.0, -3.0]");
    let place = Place::new(&[("polygon.toml", &polygon(&[])), ("sweep.toml", &text)]);
    for command in ["check sweep.toml", "sweep sweep.toml --out out"] {
        place.refuses(
            command,
            &[
                "-3 is not above 0",
                "sweep.toml:7:",
                "write a number above 0",
            ],
        );
    }
    assert!(!place.path("out").exists());
}

#[test]
fn the_shipped_sweeps_are_valid() {
    let place = Place::new(&[]);
    for entry in fs::read_dir(repository("sweeps")).unwrap() {
        let path = entry.unwrap().path();
        let said = place.succeeds(&format!("check {}", path.display()));
        assert!(said.out.contains(": valid sweep"), "{said:?}");
    }
}
