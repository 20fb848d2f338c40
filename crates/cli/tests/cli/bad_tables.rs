//! Configurations that cannot be used.

use super::support::{Place, polygon};
use super::tables::config;

fn place() -> Place {
    let place = Place::new(&[
        ("polygon.toml", &polygon(&[])),
        ("config.toml", &config(1, &["predetermined"])),
    ]);
    std::fs::create_dir(place.path("tables")).unwrap();
    place
}

#[test]
fn no_runs_and_too_many() {
    let place = place();
    for runs in ["0", "100001", "18446744073709551615"] {
        let said = format!("there are {runs} runs of each planner to do");
        let words = [&*said, "ask for 1 to 100000 with --runs"];
        place.refuses(
            &format!("tables config.toml --runs {runs} --out tables"),
            &words,
        );
    }
}

#[test]
fn an_unknown_experiment() {
    let words = [
        "config.toml has no experiment called \"polygn\"",
        "did you mean polygon?",
    ];
    place().refuses("tables config.toml --only polygn --out tables", &words);
}

#[test]
fn a_scenario_is_not_a_configuration() {
    let words = [
        "polygon.toml is a scenario, and a configuration is needed",
        "`adslam run`",
    ];
    place().refuses("tables polygon.toml --out tables", &words);
}

#[test]
fn an_unknown_planner() {
    let place = place();
    std::fs::write(place.path("config.toml"), config(1, &["locl"])).unwrap();
    let words = ["[config.toml:6:13]", "did you mean", "local"];
    place.refuses("tables config.toml --out tables", &words);
}

#[test]
fn a_wrong_override_is_shown_in_the_configuration() {
    let place = place();
    let wrong = config(1, &["local"]) + "set = { \"sensor.range_cm\" = -3.0 }\n";
    std::fs::write(place.path("config.toml"), wrong).unwrap();
    let words = [
        "-3 is not above 0",
        "[config.toml:7:",
        "write a number above 0",
    ];
    place.refuses("tables config.toml --out tables", &words);
}

#[test]
fn a_missing_mesh() {
    let place = place();
    let heart = super::support::heart(&[]);
    std::fs::write(place.path("polygon.toml"), heart).unwrap();
    let words = ["there is no file absent.stl", "--mesh"];
    place.refuses("tables config.toml --mesh absent.stl --out tables", &words);
}
