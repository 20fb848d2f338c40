//! The folder of a sweep: who may work in it, and what survives.

use std::fs;

#[cfg(unix)]
use std::process::Command;

use adslam_experiment::provenance::BUILD;

#[cfg(unix)]
use super::support::FAILURE;
use super::support::Place;
use super::sweep::place;
use super::sweep::records;
use super::sweep::start;
use super::sweep::sweep;
use super::sweep::tables;
use super::sweep::wait_for_records;
#[cfg(unix)]
use super::sweep::written;
use super::tables::config;

#[test]
fn another_sweep_is_refused_by_what_differs() {
    let place = place(1);
    place.succeeds("sweep sweep.toml --out out");
    let help = "give another folder with --out";
    let text = sweep(1);
    for (old, new, difference) in [
        (
            "3.0]",
            "4.0]",
            "holds another study: `sensor.range_cm` is 3.0 there and 4.0 here",
        ),
        (
            "\"local\"",
            "\"global\"",
            "planners predetermined, local there and predetermined, global here",
        ),
        (
            "[grid]",
            "first_seed = 2\n[grid]",
            "seeds 1 there and 2 here",
        ),
    ] {
        fs::write(place.path("other.toml"), text.replace(old, new)).unwrap();
        place.refuses("sweep other.toml --out out", &[difference, help]);
    }
    // A title is no other study.
    fs::write(place.path("other.toml"), text.replace("A few", "Some")).unwrap();
    place.succeeds("sweep other.toml --out out");
    assert!(place.read("out/table.md").starts_with("# Some runs"));
}

/// The records and the plan of a folder, as if another build had made them.
pub fn by_another_build(place: &Place, out: &str) {
    let mut files = vec![place.path(out).join("plan.json")];
    let names = records(place, out).into_iter();
    files.extend(names.map(|name| place.path(out).join("records").join(name)));
    for file in files {
        let text = fs::read_to_string(&file).unwrap();
        let other = text.replace(BUILD, "1a2b3c4d");
        assert_ne!(other, text);
        fs::write(&file, other).unwrap();
    }
}

#[test]
fn another_build_goes_on_only_where_the_user_accepts_it() {
    let place = place(1);
    place.succeeds("sweep sweep.toml --out out");
    by_another_build(&place, "out");
    let differs = format!("the build is 1a2b3c4d there and {BUILD} here");
    let words = [&*differs, "--accept-build", "--out"];
    place.refuses("sweep sweep.toml --out out --runs 2", &words);
    let said = place.succeeds("sweep sweep.toml --out out --runs 2 --accept-build");
    assert!(said.out.starts_with("4 of 8 runs were there"), "{said:?}");
    for told in [said.err, place.read("out/table.md")] {
        for part in ["by another build", "4 by adslam", "build 1a2b3c4d", BUILD] {
            assert!(told.contains(part), "no {part:?} in {told}");
        }
    }
    // As it was accepted once.
    place.succeeds("sweep sweep.toml --out out --runs 2");
}

#[test]
fn another_label_is_no_other_study() {
    let place = place(1);
    let point = |label: &str| {
        let set = "\"steps\" = 4";
        format!(
            "{}[[points]]\nlabel = \"{label}\"\nset = {{ {set} }}\n",
            sweep(1)
        )
    };
    let experiment =
        |label: &str| config(1, &["predetermined"]) + &format!("label = \"{label}\"\n");
    for label in ["shorter", "four-steps"] {
        fs::write(place.path("sweep.toml"), point(label)).unwrap();
        fs::write(place.path("config.toml"), experiment(label)).unwrap();
        place.succeeds("sweep sweep.toml --out out");
        place.succeeds("consistency config.toml --estimator so3_ekf --out consistency");
    }
    assert!(place.read("out/table.csv").contains("\n3,four-steps,"));
    assert!(
        place
            .read("consistency/consistency.md")
            .contains("## four-steps")
    );
}

#[test]
fn a_damaged_record_is_named_and_done_anew_when_removed() {
    let place = place(2);
    place.succeeds("sweep sweep.toml --out out");
    let before = tables(&place, "out");
    let record = place.path("out/records/0002-local-seed1.jsonl");
    let text = fs::read_to_string(&record).unwrap();
    fs::write(&record, &text[..text.len() / 2]).unwrap();
    let words = ["out/records/0002-local-seed1.jsonl is damaged", "remove it"];
    place.refuses("sweep sweep.toml --out out", &words);
    fs::remove_file(&record).unwrap();
    let said = place.succeeds("sweep sweep.toml --out out");
    assert!(
        said.out.starts_with("7 of 8 runs were there already"),
        "{said:?}"
    );
    assert_eq!(tables(&place, "out"), before);
}

/// The first of two processes goes on as if the second had never been.
#[test]
fn two_processes_cannot_share_a_folder() {
    let place = place(50_000);
    let mut first = start(&place, "sweep sweep.toml --out out");
    wait_for_records(&place, "out", 3);
    let said = place.adslam("sweep sweep.toml --out out");
    assert_eq!(said.code, Some(2), "{said:?}");
    let process = format!("another adslam (process {}) is at work in out", first.id());
    for word in [&*process, "wait until it has ended", "--out"] {
        assert!(said.err.contains(word), "{said:?}");
    }
    let there = records(&place, "out").len();
    wait_for_records(&place, "out", there + 3);
    assert!(first.try_wait().unwrap().is_none(), "the first has ended");
    first.kill().unwrap();
    first.wait().unwrap();
}

#[cfg(unix)]
#[test]
fn ctrl_c_keeps_what_is_finished() {
    let place = place(50_000);
    let child = start(&place, "sweep sweep.toml --out out");
    wait_for_records(&place, "out", 10);
    let sent = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(sent.unwrap().success());
    let output = child.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(130), "{said}");
    let kept = records(&place, "out").len();
    let words = format!("{kept} of 200000 runs are kept in out; the same command does the others");
    assert!(said.contains(&words), "{said}");
    assert!(said.contains("interrupted"), "{said}");
    assert!(!place.path("out/table.md").exists());
}

/// Limits on the size of files stand for a full disk: first no record fits, and then no table.
#[cfg(unix)]
#[test]
fn a_full_disk_ends_the_work_and_loses_nothing() {
    let place = place(10);
    place.succeeds("sweep sweep.toml --out undisturbed");
    place.succeeds("sweep sweep.toml --out out");
    for name in records(&place, "out").into_iter().skip(20) {
        fs::remove_file(place.path("out/records").join(name)).unwrap();
    }
    for name in written() {
        fs::remove_file(place.path("out").join(name)).unwrap();
    }
    for (blocks, kept) in [(0, 20), (8, 40)] {
        let binary = env!("CARGO_BIN_EXE_adslam");
        let script =
            format!("trap '' XFSZ; ulimit -f {blocks}; exec '{binary}' sweep sweep.toml --out out");
        let output = Command::new("sh")
            .args(["-c", &script])
            .current_dir(place.path(""))
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(FAILURE), "{said}");
        for word in ["cannot write out/", "disk has room"] {
            assert!(said.contains(word), "{said}");
        }
        assert_eq!(records(&place, "out").len(), kept, "{said}");
        assert!(
            written()
                .iter()
                .all(|name| !place.path("out").join(name).exists())
        );
    }
    let said = place.succeeds("sweep sweep.toml --out out");
    assert!(
        said.out.starts_with("40 of 40 runs were there already"),
        "{said:?}"
    );
    assert_eq!(tables(&place, "out"), tables(&place, "undisturbed"));
}
