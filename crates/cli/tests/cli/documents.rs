//! Every command of README.md and docs/*.md, pasted into a shell.
//!
//! Each page has a copy of the repository's data to work in, with a home of its own, and its commands are run
//! in the order of the page, so that one may use what another wrote. None may fail.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::support::{Place, repository};

/// What is not run here, and why.
const LEFT_OUT: [(&str, &str); 3] = [
    ("cargo ", "builds this workspace, or is a test of its own"),
    ("pip install ", "needs a network"),
    (
        "evo_ape ",
        "needs evo; the module `evo` runs it where it is installed",
    ),
];

/// What is made smaller, so that a page takes seconds: the first run of each planner, not a hundred of them.
const FEWER_RUNS: [&str; 3] = ["adslam tables ", "adslam sweep ", "adslam consistency "];

/// Folders of the repository that commands read from.
const DATA: [&str; 5] = ["configs", "samples", "scenarios", "schemas", "sweeps"];

/// Steps of the shipped scenarios, and of what they are cut to in the copy.
const FEWER_STEPS: [(&str, &str); 2] = [("steps = 100", "steps = 8"), ("steps = 200", "steps = 6")];

fn pages() -> Vec<PathBuf> {
    let docs = fs::read_dir(repository("docs")).unwrap();
    let mut pages: Vec<PathBuf> = docs
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|end| end == "md"))
        .collect();
    pages.push(repository("README.md"));
    pages.sort();
    pages
}

/// The commands of a page: the lines of its blocks for a shell, those that go on with a backslash as one.
fn commands(page: &str) -> Vec<String> {
    let mut commands = Vec::new();
    let mut lines = page.lines();
    while let Some(line) = lines.next() {
        if !["```sh", "```bash", "```shell", "```console"].contains(&line.trim()) {
            continue;
        }
        let mut command = String::new();
        for line in lines.by_ref().take_while(|line| line.trim() != "```") {
            command += line;
            if command.ends_with('\\') {
                command.pop();
            } else if !command.trim().is_empty() {
                commands.push(std::mem::take(&mut command));
            }
        }
    }
    commands
}

/// The command as it is run here; `None` where it is not.
fn rewritten(command: &str) -> Option<String> {
    if LEFT_OUT.iter().any(|(start, _)| command.starts_with(start)) {
        return None;
    }
    // Not everyone has it.
    if let Some((command, _)) = command.split_once("| jq ")
        && Command::new("jq").arg("--version").output().is_err()
    {
        return Some(command.to_owned());
    }
    if FEWER_RUNS.iter().any(|start| command.starts_with(start)) {
        let command = command.split(" #").next().unwrap_or(command);
        let words: Vec<&str> = command.split_whitespace().collect();
        let runs = words.iter().position(|word| *word == "--runs");
        let (before, after) = words.split_at(runs.unwrap_or(words.len()));
        let after = after.get(2..).unwrap_or(&[]);
        return Some([before, &["--runs", "1"], after].concat().join(" "));
    }
    Some(command.to_owned())
}

/// A copy of what the repository's commands work on, and a folder with the command itself.
fn place() -> Place {
    let place = Place::new(&[]);
    for folder in DATA {
        fs::create_dir(place.path(folder)).unwrap();
        for entry in fs::read_dir(repository(folder)).unwrap() {
            let from = entry.unwrap().path();
            let to = place.path(folder).join(from.file_name().unwrap());
            if folder != "scenarios" {
                fs::copy(&from, &to).unwrap();
                continue;
            }
            let mut text = fs::read_to_string(&from).unwrap();
            for (steps, fewer) in FEWER_STEPS {
                text = text.replacen(steps, fewer, 1);
            }
            fs::write(&to, text).unwrap();
        }
    }
    place
}

fn run(place: &Place, command: &str) -> Result<(), String> {
    let program = Path::new(env!("CARGO_BIN_EXE_adslam"));
    let path = std::env::var("PATH").unwrap();
    let path = format!("{}:{path}", program.parent().unwrap().display());
    let output = Command::new("bash")
        .args(["-o", "pipefail", "-c", command])
        .current_dir(place.path("."))
        .env("PATH", path)
        .env("HOME", place.path("."))
        .env("NO_COLOR", "1")
        .output()
        .map_err(|error| error.to_string())?;
    if output.status.success() {
        return Ok(());
    }
    Err(format!(
        "ends with {:?}\n{}",
        output.status.code(),
        String::from_utf8_lossy(&output.stderr)
    ))
}

/// How many commands of a page were run, and what became of those that failed.
fn try_page(page: &Path) -> (usize, Vec<String>) {
    let name = page.file_name().unwrap().to_string_lossy();
    let (mut count, mut failed) = (0, Vec::new());
    let place = place();
    for command in commands(&fs::read_to_string(page).unwrap()) {
        let Some(rewritten) = rewritten(&command) else {
            continue;
        };
        count += 1;
        if let Err(reason) = run(&place, &rewritten) {
            failed.push(format!("{name}: {command}\n{reason}"));
        }
    }
    (count, failed)
}

#[test]
fn no_command_of_a_page_fails_when_pasted() {
    let pages = pages();
    let ended: Vec<(usize, Vec<String>)> = std::thread::scope(|scope| {
        let tried: Vec<_> = pages
            .iter()
            .map(|page| scope.spawn(|| try_page(page)))
            .collect();
        tried.into_iter().map(|page| page.join().unwrap()).collect()
    });
    let run_here: usize = ended.iter().map(|(count, _)| count).sum();
    let failed: Vec<String> = ended.into_iter().flat_map(|(_, failed)| failed).collect();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
    assert!(run_here > 30, "only {run_here} commands were found");
}

/// Nothing is left out without need.
#[test]
fn what_is_left_out_is_there() {
    let all: Vec<String> = pages()
        .iter()
        .flat_map(|page| commands(&fs::read_to_string(page).unwrap()))
        .collect();
    for (start, reason) in LEFT_OUT {
        assert!(
            all.iter().any(|command| command.starts_with(start)),
            "{start}: {reason}"
        );
    }
}

#[test]
fn pages_are_taken_apart() {
    let page = "text\n```sh\na b   # c\n\nd \\\n  e\n```\n```toml\nf\n```\n```sh\ng\n```\n";
    assert_eq!(commands(page), ["a b   # c", "d   e", "g"]);
    assert_eq!(rewritten("cargo test"), None);
    for (command, expected) in [
        ("adslam mesh a", "adslam mesh a"),
        (
            "adslam tables a --runs 20 --html   # b",
            "adslam tables a --runs 1 --html",
        ),
        ("adslam sweep a", "adslam sweep a --runs 1"),
    ] {
        assert_eq!(rewritten(command).as_deref(), Some(expected));
    }
    let place = place();
    assert!(run(&place, "adslam check scenarios/polygon.toml").is_ok());
    assert!(run(&place, "adslam check scenarios/absent.toml").is_err());
    assert!(run(&place, "false | true").is_err());
}
