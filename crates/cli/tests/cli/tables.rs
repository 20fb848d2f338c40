//! `adslam tables`

use std::fs;

use serde_json::Value;

use super::support::{PLANNERS, Place, RUN_KEYS, polygon, repository};
use super::sweep_folder::by_another_build;

/// A configuration of the polygon in `polygon.toml`.
pub fn config(runs: usize, planners: &[&str]) -> String {
    format!(
        "title = \"A few runs\"\nruns = {runs}\n\n[[experiments]]\nscenario = \"polygon.toml\"\n\
         planners = {planners:?}\n"
    )
}

#[test]
fn tables_and_every_run() {
    let published = fs::read_to_string(repository("configs/published.toml")).unwrap();
    let config = config(2, &PLANNERS)
        .replace("runs = 2", "runs = 2\npublished = \"published.toml\"")
        + "published = \"polygon\"\n";
    let place = Place::new(&[
        ("polygon.toml", &polygon(&[])),
        ("published.toml", &published),
        ("config.toml", &config),
    ]);
    let said = place.succeeds("tables config.toml --out new/tables");

    let json = place.json("new/tables/tables.json");
    assert_eq!(json["runs"], 2);
    assert_eq!(json["complete"], true);
    let planners = json["scenarios"]["polygon"]["planners"]
        .as_object()
        .unwrap();
    assert_eq!(planners.len(), PLANNERS.len());
    for planner in PLANNERS {
        let runs = planners[planner].as_array().unwrap();
        assert_eq!(runs.len(), 2);
        for (run, seed) in runs.iter().zip(1..) {
            assert_eq!(run["seed"], seed);
            for key in RUN_KEYS {
                assert!(run.get(key).is_some(), "{key} in {run}");
            }
        }
        let published = &json["published"]["polygon"]["planners"][planner];
        assert_eq!(
            published["observed"].as_array().unwrap().len(),
            5,
            "{published}"
        );
    }

    let markdown = place.read("new/tables/tables.md");
    for (name, text) in [("terminal", &said.out), ("tables.md", &markdown)] {
        for part in [
            "Table I: Coverage, polygon",
            "Table II: Estimation error, polygon",
            "combined",
        ] {
            assert!(text.contains(part), "no {part:?} in {name}: {text}");
        }
    }
    assert!(markdown.starts_with("# A few runs\n"), "{markdown}");
    // The published mean of the predetermined planner beside ours.
    let row = markdown
        .lines()
        .find(|line| line.contains("feature times, mean"))
        .unwrap();
    assert!(row.contains("347 (292–393) / "), "{row}");
}

#[test]
fn a_report_with_replays_where_asked_for() {
    let place = Place::new(&[
        ("polygon.toml", &polygon(&[])),
        ("config.toml", &config(1, &["predetermined", "global"])),
    ]);
    let said = place.succeeds("tables config.toml --out plain");
    assert!(!said.out.contains("report.html"), "{said:?}");
    assert!(
        !place.path("plain/report.html").exists(),
        "only if asked for"
    );

    let said = place.succeeds("tables config.toml --out full --html");
    assert!(said.out.contains("report.html"), "{said:?}");
    let page = place.read("full/report.html");
    for planner in ["predetermined", "global"] {
        let replay = format!("replays/polygon-{planner}.html");
        assert!(page.contains(&format!("href=\"{replay}\"")), "{replay}");
        assert!(place.path("full").join(&replay).exists(), "{replay}");
    }
    let times = |markdown: String| -> Vec<String> {
        let lines = markdown.lines().filter(|line| !line.contains("time"));
        lines.map(str::to_owned).collect()
    };
    assert_eq!(
        times(place.read("plain/tables.md")),
        times(place.read("full/tables.md")),
        "recording changes nothing"
    );
}

/// Two planners in an experiment of a configuration.
fn place() -> Place {
    Place::new(&[
        ("polygon.toml", &polygon(&[])),
        ("config.toml", &config(2, &["predetermined", "global"])),
    ])
}

fn both(place: &Place, folder: &str) -> [String; 2] {
    ["tables.md", "tables.json"].map(|name| place.read(&format!("{folder}/{name}")))
}

#[test]
fn tables_go_on_where_they_were_stopped_and_are_made_again_byte_for_byte() {
    let place = place();
    place.succeeds("tables config.toml --out tables");
    let before = both(&place, "tables");
    let said = place.succeeds("tables config.toml --out tables");
    assert!(
        said.out.starts_with("4 of 4 runs were there already"),
        "{said:?}"
    );
    assert_eq!(both(&place, "tables"), before);
    fs::remove_file(place.path("tables/records/0001-global-seed2.jsonl")).unwrap();
    let said = place.succeeds("tables config.toml --out tables");
    assert!(said.out.starts_with("3 of 4 runs"), "{said:?}");
}

/// Each configuration has a folder of its own, and none takes that of another.
#[test]
fn no_tables_replace_those_of_another_configuration() {
    let place = place();
    place.succeeds("tables config.toml");
    let before = both(&place, "results/config");
    let other = config(2, &["predetermined", "global"]).replace("A few runs", "Others")
        + "set = { \"sensor.range_cm\" = 4.0 }\n";
    fs::write(place.path("other.toml"), other).unwrap();
    place.succeeds("tables other.toml");
    assert_eq!(both(&place, "results/config"), before);
    assert!(
        place
            .read("results/other/tables.md")
            .starts_with("# Others")
    );
    let words = [
        "results/config holds another study",
        "`sensor.range_cm` is 3.0 there and 4.0 here",
    ];
    place.refuses("tables other.toml --out results/config", &words);
}

/// A report shows the runs of the tables beside it, or is not there.
#[test]
fn no_report_stays_beside_tables_of_other_runs() {
    let place = place();
    place.succeeds("tables config.toml --out tables --html");
    assert!(place.path("tables/replays/polygon-global.html").exists());
    place.succeeds("tables config.toml --out tables");
    assert!(place.path("tables/report.html").exists(), "the same runs");
    place.succeeds("tables config.toml --out tables --runs 3");
    for name in ["report.html", "replays/polygon-global.html"] {
        assert!(!place.path("tables").join(name).exists(), "{name}");
    }
    place.succeeds("tables config.toml --out tables --runs 3 --html");
    let page = place.read("tables/report.html");
    assert!(page.contains("seeds 1 to 3"), "{page:.400}");
}

#[test]
fn runs_of_another_build_are_told_of_in_the_tables() {
    let place = place();
    place.succeeds("tables config.toml --out tables");
    by_another_build(&place, "tables");
    place.refuses("tables config.toml --out tables", &["--accept-build"]);
    place.succeeds("tables config.toml --out tables --accept-build --html");
    let json = place.json("tables/tables.json");
    assert_eq!(json["builds"][0]["build"], "1a2b3c4d");
    assert_eq!(json["builds"][0]["runs"], 4);
    for name in ["tables.md", "report.html"] {
        let text = place.read(&format!("tables/{name}"));
        assert!(text.contains("4 by adslam"), "{name}");
    }
}

#[test]
fn published_values_are_compared_with_as_many_runs() {
    let published = fs::read_to_string(repository("configs/published.toml")).unwrap();
    let config = config(6, &["predetermined"])
        .replace("runs = 6", "runs = 6\npublished = \"published.toml\"")
        + "published = \"polygon\"\n";
    let place = Place::new(&[
        ("polygon.toml", &polygon(&[])),
        ("published.toml", &published),
        ("config.toml", &config),
    ]);
    place.succeeds("tables config.toml --out tables");
    let json = place.json("tables/tables.json");
    let compared = json["comparisons"].as_array().unwrap();
    let of = |row: &str| {
        let mut rows = compared.iter();
        rows.find(|compared| compared["row"] == row).unwrap()
    };
    // Five steps see far less than a hundred.
    let observed = of("Observed feature times, mean (range)");
    assert_eq!(observed["agreement"], "lower");
    assert!(observed["ratio"].as_f64().unwrap() < 0.5, "{observed}");
    let steps = of("Steps to see all, mean of the runs that do (range)");
    assert_eq!(steps["ours"], Value::Null, "never");
    assert_eq!(steps["agreement"], "higher");
    assert_eq!(of("Steps to see all, 1")["agreement"], "higher");
    let markdown = place.read("tables/tables.md");
    assert!(markdown.contains("× ▼"), "{markdown}");
    assert!(markdown.contains("0 of 6 (0–46 %)"), "{markdown}");
}

#[test]
fn runs_and_experiments_can_be_chosen() {
    let two = config(9, &["predetermined"])
        + "\n[[experiments]]\nlabel = \"other\"\nscenario = \"polygon.toml\"\nplanners = [\"local\"]\n";
    let place = Place::new(&[("polygon.toml", &polygon(&[])), ("config.toml", &two)]);
    place.succeeds("tables config.toml --runs 1 --only other --out tables");
    let said = place.refuses(
        "tables config.toml --runs 1 --only polygon --out tables",
        &["holds another study"],
    );
    assert!(
        said.err
            .contains("planners local there and predetermined here")
    );
    let json = place.json("tables/tables.json");
    let scenarios = json["scenarios"].as_object().unwrap();
    assert_eq!(scenarios.keys().collect::<Vec<_>>(), ["other"]);
    assert_eq!(
        json["scenarios"]["other"]["planners"]["local"]
            .as_array()
            .unwrap()
            .len(),
        1
    );
}
