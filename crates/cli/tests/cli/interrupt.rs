//! Ctrl-C, and the signals by which systems end a program.

use std::fs;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use super::failures::breaking;
use super::support::{Place, lines, log_header, log_step, polygon};
use super::sweep::{records, sweep, wait_for_records};
use super::tables::config;

const INTERRUPTED: i32 = 130;
/// Far more than a step takes, on a busy machine too, far less than the work.
const PATIENCE: Duration = Duration::from_secs(30);

/// Starts the command and waits until it has begun to write into `out`.
fn start(place: &Place, arguments: &str, out: &str) -> Child {
    let child = Command::new(env!("CARGO_BIN_EXE_adslam"))
        .args(arguments.split_whitespace())
        .current_dir(place.path(""))
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    wait_for(place, out);
    child
}

/// Waits until something has been written into `out`.
fn wait_for(place: &Place, out: &str) {
    let begun = || fs::read_dir(place.path(out)).is_ok_and(|mut entries| entries.next().is_some());
    let start = Instant::now();
    while !begun() {
        assert!(
            start.elapsed() < Duration::from_secs(30),
            "{out} is not begun"
        );
        sleep(Duration::from_millis(20));
    }
}

fn send(signal: &str, child: &Child) {
    let sent = Command::new("kill")
        .args([&format!("-{signal}"), &child.id().to_string()])
        .status();
    assert!(sent.unwrap().success());
}

/// Presses Ctrl-C; returns what was said.
fn interrupt(child: Child) -> String {
    stop(child, "INT")
}

/// Sends a signal, on which the command must stop soon; returns what was said.
fn stop(child: Child, signal: &str) -> String {
    send(signal, &child);
    let start = Instant::now();
    let output = child.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(INTERRUPTED), "{signal}: {said}");
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

/// Every command that does long work, by every signal.
#[test]
fn all_signals_end_alike() {
    let long_log = std::iter::once(log_header()).chain((2..=40_000).map(log_step));
    let place = Place::new(&[
        ("polygon.toml", &polygon(&[])),
        ("long.toml", &polygon(&[("steps = 5", "steps = 1000000")])),
        ("config.toml", &config(100_000, &["predetermined"])),
        ("sweep.toml", &sweep(20_000)),
        ("log.jsonl", &lines(&long_log.collect::<Vec<_>>())),
    ]);
    let mut signals = vec!["INT", "TERM"];
    if hangups_are_ignored() {
        eprintln!("this test was started to outlive its terminal, so SIGHUP is not tried");
    } else {
        signals.push("HUP");
    }
    for (number, signal) in signals.into_iter().enumerate() {
        for command in [
            "run long.toml --planner local --out",
            "tables config.toml --out",
            "sweep sweep.toml --out",
            "consistency config.toml --out",
        ] {
            let name = command.split(' ').next().unwrap();
            let out = format!("{name}-{number}");
            let child = start(&place, &format!("{command} {out}"), &out);
            let said = stop(child, signal);
            assert!(said.contains("interrupted"), "{command}, {signal}: {said}");
        }
        let out = format!("filter-{number}");
        let child = start(
            &place,
            &format!("filter log.jsonl --out {out}/estimates.jsonl"),
            &out,
        );
        let said = stop(child, signal);
        assert!(said.contains("interrupted"), "{signal}: {said}");
        assert_eq!(
            fs::read_dir(place.path(&out)).unwrap().count(),
            0,
            "no litter"
        );
    }
}

/// What is ignored here is ignored by every child.
fn hangups_are_ignored() -> bool {
    let survives = Command::new("sh").args(["-c", "kill -HUP $$"]).status();
    survives.unwrap().success()
}

/// The run that was there stays whole, and its folder may be written to again.
#[test]
fn an_old_run_stays_where_a_new_one_is_stopped() {
    let long = polygon(&[("steps = 5", "steps = 1000000")]);
    let place = Place::new(&[("polygon.toml", &polygon(&[])), ("long.toml", &long)]);
    let run = "run polygon.toml --planner predetermined --out run --html";
    place.succeeds(run);
    let files = || {
        let entries = fs::read_dir(place.path("run")).unwrap();
        let file = |path: PathBuf| (fs::read(&path).unwrap(), path);
        let mut files: Vec<_> = entries.map(|entry| file(entry.unwrap().path())).collect();
        files.sort();
        files
    };
    let before = files();
    let child = start(&place, "run long.toml --planner local --out run", "run");
    while !place.path("run/run.lock").exists() {
        sleep(Duration::from_millis(5));
    }
    sleep(Duration::from_millis(200));
    stop(child, "TERM");
    assert!(files() == before, "the old run has changed");
    place.succeeds(run);
}

/// A pipe that nobody writes to: the command waits, and does not come to the next step.
#[test]
fn a_second_signal_ends_at_once() {
    let place = Place::new(&[]);
    let made = Command::new("mkfifo").arg(place.path("pipe")).status();
    assert!(made.unwrap().success());
    let pipe = place.path("pipe");
    // It opens when the command has opened the other end.
    let writer = std::thread::spawn(|| fs::OpenOptions::new().write(true).open(pipe).unwrap());
    let mut child = start(&place, "filter pipe --out out/estimates.jsonl", "out");
    let writer = writer.join().unwrap();
    send("TERM", &child);
    sleep(Duration::from_millis(500));
    assert!(child.try_wait().unwrap().is_none(), "it waits for the log");
    stop(child, "INT");
    drop(writer);
}

/// What was started to outlive its terminal does.
#[test]
fn nohup_is_heeded() {
    let place = Place::new(&[
        ("polygon.toml", &polygon(&[])),
        ("config.toml", &config(100_000, &["predetermined"])),
    ]);
    let mut child = Command::new("nohup")
        .arg(env!("CARGO_BIN_EXE_adslam"))
        .args("tables config.toml --out tables".split(' '))
        .current_dir(place.path(""))
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    wait_for_records(&place, "tables", 10);
    send("HUP", &child);
    // Those at work when it arrives are finished either way.
    let more = records(&place, "tables").len() + 200;
    wait_for_records(&place, "tables", more);
    assert!(child.try_wait().unwrap().is_none(), "it has hung up");
    stop(child, "TERM");
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
