//! Processes that write into one run's folder at once, or are killed in it.

use std::thread::{sleep, yield_now};
use std::time::Duration;

use super::run_folder::{FILES, RUN, names, place};
use super::support::{BAD_INPUT, Place, polygon};
use super::sweep::start;

#[test]
fn two_processes_do_not_write_into_one_folder() {
    let place = Place::new(&[
        ("polygon.toml", &polygon(&[])),
        ("long.toml", &polygon(&[("steps = 5", "steps = 1000000")])),
    ]);
    place.succeeds(&format!("{RUN} run"));
    let before = place.read("run/run.json");
    let mut first = start(&place, "run long.toml --planner local --out run");
    while !place.path("run/run.lock").exists() {
        assert!(first.try_wait().unwrap().is_none(), "it has ended");
        yield_now();
    }
    sleep(Duration::from_millis(200));
    let said = place.adslam(&format!("{RUN} run --seed 2"));
    assert_eq!(said.code, Some(BAD_INPUT), "{said:?}");
    let at_work = format!("another adslam (process {}) is at work in run", first.id());
    assert!(said.err.contains(&at_work), "{said:?}");
    first.kill().unwrap();
    first.wait().unwrap();
    assert_eq!(place.read("run/run.json"), before, "the old run stays");
    place.succeeds("replay run --out page.html");
    // What was killed leaves nothing in the way, and nothing in the end.
    place.succeeds(&format!("{RUN} run --seed 2"));
    assert_eq!(names(&place, "run"), FILES);
}

/// Killed at any moment, also while files are put in their places: the folder holds one run whole, or says that it
/// does not.
#[test]
fn a_killed_run_leaves_one_run_or_none() {
    let place = place();
    place.succeeds(&format!("{RUN} run"));
    let mut whole = 0;
    for kill in 0..40_u64 {
        let mut child = start(&place, &format!("{RUN} run --html --seed {kill}"));
        // The old page goes when the files are replaced; most kills come soon after that begins.
        let replaced = || !place.path("run/history.json").exists();
        while kill % 4 != 0 && !replaced() && child.try_wait().unwrap().is_none() {
            std::hint::spin_loop();
        }
        sleep(Duration::from_micros(kill * 50));
        child.kill().unwrap();
        child.wait().unwrap();
        let said = place.adslam("replay run --out page.html");
        if said.code == Some(0) {
            assert!(!said.err.contains("warning"), "parts of two runs: {said:?}");
            whole += 1;
        } else {
            assert!(said.err.contains("does not hold a whole run"), "{said:?}");
        }
    }
    assert!(whole > 0, "no kill left a run");
    place.succeeds(&format!("{RUN} run"));
    assert_eq!(names(&place, "run"), FILES);
}
