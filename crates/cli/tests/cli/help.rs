//! Help and arguments.

use std::fs;

use adslam_cli::Arguments;
use clap::CommandFactory;

use super::support::{BAD_INPUT, PLANNERS, Place, repository};

/// Every command and subcommand, as it is written.
fn commands() -> Vec<String> {
    let mut commands = Vec::new();
    for command in Arguments::command().get_subcommands() {
        let name = command.get_name();
        commands.push(name.to_owned());
        let below = command.get_subcommands();
        commands.extend(below.map(|below| format!("{name} {}", below.get_name())));
    }
    assert!(commands.iter().any(|command| command == "new config"));
    commands
}

#[test]
fn every_command_explains_itself_with_an_example_in_80_columns() {
    let place = Place::new(&[]);
    for command in commands() {
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
        "schema",
        "new",
        "new scenario --scenario scenario.toml",
        "completions tcsh",
    ] {
        assert_eq!(place.adslam(arguments).code, Some(BAD_INPUT), "{arguments}");
    }
}

#[test]
fn shells_complete_commands_and_planners() {
    let place = Place::new(&[]);
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = place.succeeds(&format!("completions {shell}")).out;
        for word in ["replay", "completions", "planner"] {
            assert!(script.contains(word), "{shell} does not know {word}");
        }
        // The others complete no values.
        if ["bash", "zsh", "fish"].contains(&shell) {
            for planner in PLANNERS {
                assert!(script.contains(planner), "{shell} does not know {planner}");
            }
        }
    }
}

#[test]
fn every_command_is_documented() {
    let read = |path: &str| fs::read_to_string(repository(path)).unwrap();
    let (readme, reference) = (read("README.md"), read("docs/command.md"));
    for command in commands() {
        let name = command.split(' ').next().unwrap();
        assert!(
            readme.contains(&format!("adslam {name} ")),
            "README: {name}"
        );
        let entry = format!("`adslam {command}");
        assert!(reference.contains(&entry), "docs/command.md: {command}");
    }
}
