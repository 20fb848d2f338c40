//! Ctrl-C.

use std::fs;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use super::failures::breaking;
use super::support::{Place, polygon};
use super::sweep::{records, wait_for_records};
use super::tables::config;

const INTERRUPTED: i32 = 130;
/// Far more than a step takes, far less than the work.
const PATIENCE: Duration = Duration::from_secs(5);

/// Starts the command and waits until it has begun to write into `out`.
fn start(place: &Place, arguments: &str, out: &str) -> Child {
    let child = Command::new(env!("CARGO_BIN_EXE_adslam"))
        .args(arguments.split_whitespace())
        .current_dir(place.path(""))
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let begun = || fs::read_dir(place.path(out)).is_ok_and(|mut entries| entries.next().is_some());
    let start = Instant::now();
    while !begun() {
        assert!(
            start.elapsed() < Duration::from_secs(30),
            "{arguments} does not begin"
        );
        sleep(Duration::from_millis(20));
    }
    child
}

/// Presses Ctrl-C; returns what was said.
fn interrupt(child: Child) -> String {
    let sent = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(sent.unwrap().success());
    let start = Instant::now();
    let output = child.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(INTERRUPTED), "{said}");
    assert!(start.elapsed() < PATIENCE, "{:?}", start.elapsed());
    said
}

/// What is finished is kept and shown; complete tables that were there stay.
#[test]
fn tables_keep_the_finished_runs() {
    let place = Place::new(&[
        ("polygon.toml", &polygon(&[])),
        ("config.toml", &config(2, &["predetermined"])),
    ]);
    place.succeeds("tables config.toml --out tables");
    let before = ["tables.md", "tables.json"].map(|name| place.read(&format!("tables/{name}")));
    let many = "tables config.toml --runs 100000 --out tables";
    let child = start(&place, many, "tables");
    wait_for_records(&place, "tables", 10);
    let said = interrupt(child);
    assert!(said.contains("interrupted"), "{said}");
    let kept = records(&place, "tables").len();
    assert!((10..100_000).contains(&kept), "{kept}");
    let words = format!("{kept} of 100000 runs are kept in tables");
    assert!(said.contains(&words), "{said}");
    let after = ["tables.md", "tables.json"].map(|name| place.read(&format!("tables/{name}")));
    assert_eq!(after, before);
    let there = fs::read_dir(place.path("tables")).unwrap().count();
    assert_eq!(there, 5, "tables, plan, records and lock, no litter");
    let some = format!("tables config.toml --runs {} --out tables", kept + 1);
    place.refuses(&some, &["seeds 1–100000 there"]);
}

/// Whatever failed before: the user's wish is what the command ends with.
#[test]
fn an_interruption_is_one_though_runs_have_failed() {
    let both = "title = \"t\"\nruns = 100000\n\
        [[experiments]]\nlabel = \"breaking\"\nscenario = \"breaking.toml\"\nplanners = [\"local\"]\n\
        [[experiments]]\nscenario = \"polygon.toml\"\nplanners = [\"predetermined\"]\n";
    let place = Place::new(&[
        ("polygon.toml", &polygon(&[])),
        ("breaking.toml", &breaking()),
        ("config.toml", both),
    ]);
    let child = start(&place, "tables config.toml --out tables", "tables");
    wait_for_records(&place, "tables", 10);
    let said = interrupt(child);
    for word in ["of the runs failed", "[breaking]", "interrupted"] {
        assert!(said.contains(word), "{said}");
    }
    assert!(said.lines().count() < 40, "{said}");
    assert!(!place.path("tables/tables.json").exists());
}

#[test]
fn an_unfinished_run_writes_nothing() {
    let long = polygon(&[("steps = 5", "steps = 1000000")]);
    let place = Place::new(&[("polygon.toml", &long)]);
    let child = start(
        &place,
        "run polygon.toml --planner combined --out run",
        "run",
    );
    let said = interrupt(child);
    assert!(said.contains("interrupted"), "{said}");
    assert_eq!(
        fs::read_dir(place.path("run")).unwrap().count(),
        0,
        "no litter"
    );
}
