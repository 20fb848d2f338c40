//! A sweep that is killed again and again ends as if nothing had been.

use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::MetadataExt;
use std::thread::{sleep, yield_now};
use std::time::{Duration, SystemTime};

use super::support::{Place, polygon};
use super::sweep::{records, start, sweep, tables, wait_for_records, written};

/// While runs are done.
const KILLS: u64 = 20;
/// While tables are written.
const LATE_KILLS: u64 = 10;
/// Of each of two planners at two points.
const RUNS: usize = 60;
const ALL: usize = 4 * RUNS;

/// Numbers that look random, for moments to kill at (S. Vigna's SplitMix64).
struct Moments(u64);

impl Moments {
    fn below(&mut self, limit: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) % limit
    }
}

/// Which file each finished record is: one that was written twice is another.
fn files(place: &Place) -> BTreeMap<String, (u64, SystemTime)> {
    let file = |name: String| {
        let path = place.path("out/records").join(&name);
        let metadata = fs::metadata(path).unwrap();
        (name, (metadata.ino(), metadata.modified().unwrap()))
    };
    records(place, "out").into_iter().map(file).collect()
}

/// Half-written files in the folder of the tables.
fn unfinished(place: &Place) -> usize {
    let names = fs::read_dir(place.path("out")).unwrap();
    let names = names.map(|entry| entry.unwrap().file_name());
    names
        .filter(|name| name.to_string_lossy().starts_with('.'))
        .count()
}

/// Kills the sweep, all of whose runs are done, while it writes its tables, at any moment; then every table is whole
/// or is not there. Returns whether some were half-written.
fn killed_at_its_tables(place: &Place, moments: &mut Moments, whole: &[Vec<u8>]) -> bool {
    for name in written() {
        let _ = fs::remove_file(place.path("out").join(name));
    }
    let mut child = start(place, "sweep sweep.toml --out out");
    // The folder is probed with one file; the tables are begun in pairs.
    while unfinished(place) < 2 && child.try_wait().unwrap().is_none() {
        yield_now();
    }
    sleep(Duration::from_micros(moments.below(20_000)));
    child.kill().unwrap();
    child.wait().unwrap();
    for (name, whole) in written().iter().zip(whole) {
        if let Ok(bytes) = fs::read(place.path("out").join(name)) {
            assert!(bytes == *whole, "{name} is another");
        }
    }
    unfinished(place) > 0
}

#[test]
fn nothing_is_lost_and_nothing_is_done_twice() {
    let place = Place::new(&[
        ("polygon.toml", &polygon(&[("steps = 5", "steps = 20")])),
        ("sweep.toml", &sweep(RUNS)),
    ]);
    let mut moments = Moments(20);
    let mut finished = BTreeMap::new();
    for kill in 0..KILLS {
        let mut child = start(&place, "sweep sweep.toml --out out");
        // One in four while it starts, the others soon after one of 15 marks on the way, the last 20 runs from
        // the end.
        if kill % 4 == 0 {
            sleep(Duration::from_millis(moments.below(40)));
        } else {
            let mark = (kill - kill / 4) * (ALL as u64 - 20) / (KILLS - KILLS / 4);
            wait_for_records(&place, "out", usize::try_from(mark).unwrap());
            sleep(Duration::from_micros(moments.below(2_000)));
        }
        child.kill().unwrap();
        let output = child.wait_with_output().unwrap();
        assert_eq!(
            output.status.code(),
            None,
            "it had ended before it was killed: {output:?}"
        );
        let now = files(&place);
        for (name, file) in &finished {
            assert_eq!(
                now.get(name),
                Some(file),
                "{name} has changed at kill {kill}"
            );
        }
        finished = now;
    }
    let said = place.succeeds("sweep sweep.toml --out out");
    let there = format!("{} of {ALL} runs were there already", finished.len());
    assert!(said.out.starts_with(&there), "{said:?}");
    let last = files(&place);
    assert_eq!(last.len(), ALL);
    assert!(
        finished
            .iter()
            .all(|(name, file)| last.get(name) == Some(file))
    );
    let litter = fs::read_dir(place.path("out/records")).unwrap().count() - ALL;
    assert_eq!(litter, 0, "half-written records are still there");
    let there = fs::read_dir(place.path("out")).unwrap().count();
    let expected = written().len() + 3;
    assert_eq!(
        there, expected,
        "tables, lock, plan and records, and nothing else"
    );

    place.succeeds("sweep sweep.toml --out undisturbed");
    let undisturbed = tables(&place, "undisturbed");
    assert_eq!(tables(&place, "out"), undisturbed);
    let half_written = (0..LATE_KILLS)
        .filter(|_| killed_at_its_tables(&place, &mut moments, &undisturbed))
        .count();
    assert!(half_written > 0, "no kill fell into the writing of tables");
    place.succeeds("sweep sweep.toml --out out");
    assert_eq!(files(&place), last);
    assert_eq!(tables(&place, "out"), undisturbed);
    assert_eq!(unfinished(&place), 0, "litter");

    let mut alone = place.command("sweep sweep.toml --out alone");
    assert!(
        alone
            .env("RAYON_NUM_THREADS", "1")
            .output()
            .unwrap()
            .status
            .success()
    );
    assert_eq!(tables(&place, "alone"), undisturbed);
}
