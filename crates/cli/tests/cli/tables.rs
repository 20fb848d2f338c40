//! `adslam tables`

use std::fs;

use super::support::{PLANNERS, Place, RUN_KEYS, polygon, repository};

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

#[test]
fn runs_and_experiments_can_be_chosen() {
    let two = config(9, &["predetermined"])
        + "\n[[experiments]]\nlabel = \"other\"\nscenario = \"polygon.toml\"\nplanners = [\"local\"]\n";
    let place = Place::new(&[("polygon.toml", &polygon(&[])), ("config.toml", &two)]);
    place.succeeds("tables config.toml --runs 1 --only other --out tables");
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
