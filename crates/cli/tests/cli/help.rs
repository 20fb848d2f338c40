//! Help and arguments.

use super::support::{BAD_INPUT, PLANNERS, Place};

#[test]
fn every_command_explains_itself_with_an_example_in_80_columns() {
    let place = Place::new(&[]);
    for command in [
        "run", "replay", "export", "filter", "tables", "mesh", "check",
    ] {
        let output = place
            .command(&format!("{command} --help"))
            .output()
            .unwrap();
        assert!(output.status.success());
        let help = String::from_utf8(output.stdout).unwrap();
        for part in ["Usage:", "Example:", &format!("  adslam {command} ")] {
            assert!(help.contains(part), "{command}: {help}");
        }
        let longest = help.lines().map(|line| line.chars().count()).max();
        assert!(longest <= Some(80), "{command} has a line of {longest:?}");
    }
    let help = place.succeeds("--help").out;
    assert!(help.contains("Exit codes: 0"), "{help}");
}

#[test]
fn an_unknown_planner_is_answered_with_the_known_ones() {
    let place = Place::new(&[]);
    let words = [&["lokal", "did you mean local?"], &PLANNERS[..]].concat();
    place.refuses("run scenario.toml --planner lokal --out run", &words);
}

#[test]
fn wrong_arguments_are_bad_input() {
    let place = Place::new(&[]);
    for arguments in [
        "",
        "fly",
        "run",
        "run scenario.toml --planner local",
        "run scenario.toml --planner local --out run --seed -1",
        "run scenario.toml --planner local --out run --seed 1.5",
        "tables config.toml --runs some",
        "filter log.jsonl",
        "check",
    ] {
        assert_eq!(place.adslam(arguments).code, Some(BAD_INPUT), "{arguments}");
    }
}
