//! Places that cannot be written to: found before the work begins, and nothing is lost.

use std::fs;

use super::support::{FAILURE, Place, lines, log, polygon};
use super::tables::config;

const RUN: &str = "run polygon.toml --planner predetermined --out";

fn place() -> Place {
    Place::new(&[
        ("polygon.toml", &polygon(&[])),
        ("config.toml", &config(1, &["predetermined"])),
        ("log.jsonl", &lines(&log())),
        ("taken", "a file\n"),
    ])
}

#[test]
fn a_file_in_place_of_the_folder() {
    let place = place();
    for command in [RUN, "tables config.toml --out"] {
        let words = ["taken is a file", "give the path of a folder"];
        place.refuses(&format!("{command} taken"), &words);
    }
    for command in [RUN, "tables config.toml --out", "filter log.jsonl --out"] {
        let words = [
            "taken/below",
            "cannot be written to",
            "give a folder that can be written to",
        ];
        place.refuses(&format!("{command} taken/below/x"), &words);
    }
}

/// `/proc` takes no new files, not even root's.
#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_is_not_writable() {
    let place = place();
    for command in [RUN, "tables config.toml --out", "filter log.jsonl --out"] {
        for folder in ["/proc/adslam", "/proc"] {
            let path = if command.starts_with("filter") {
                format!("{folder}/estimates.jsonl")
            } else {
                folder.to_owned()
            };
            let words = [folder, "cannot be written to", "--out"];
            place.refuses(&format!("{command} {path}"), &words);
        }
    }
}

#[test]
fn a_folder_in_place_of_a_file() {
    let place = place();
    fs::create_dir_all(place.path("run/steps.csv")).unwrap();
    fs::create_dir_all(place.path("run/summary.json")).unwrap();
    fs::create_dir_all(place.path("out/tables.json")).unwrap();
    for (arguments, name) in [
        (&*format!("{RUN} run"), "summary.json"),
        ("filter log.jsonl --out out", "out"),
    ] {
        let said = format!("{name} is a folder, and a file goes there");
        place.refuses(arguments, &[&said, "give another path"]);
    }
    let words = ["out holds results of something else: ", "another folder"];
    place.refuses("tables config.toml --out out", &words);
}

/// A rename would put a file in the place of the device.
#[cfg(unix)]
#[test]
fn a_device_in_place_of_a_file() {
    use std::os::unix::fs::FileTypeExt;
    let words = ["/dev/null is a device or a pipe", "give another path"];
    place().refuses("filter log.jsonl --out /dev/null", &words);
    assert!(
        fs::metadata("/dev/null")
            .unwrap()
            .file_type()
            .is_char_device()
    );
}

#[test]
fn the_log_itself() {
    let place = place();
    let words = ["is the log itself", "give another path"];
    place.refuses("filter log.jsonl --out log.jsonl", &words);
    place.refuses("filter log.jsonl --out ./log.jsonl", &words);
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("log.jsonl", place.path("link.jsonl")).unwrap();
        place.refuses("filter log.jsonl --out link.jsonl", &words);
        place.refuses("filter link.jsonl --out log.jsonl", &words);
    }
}

/// A limit on the size of files stands for a full disk: the write fails, what was there stays.
#[cfg(unix)]
#[test]
fn a_full_disk_loses_nothing() {
    let place = place();
    place.succeeds(&format!("{RUN} run"));
    place.succeeds("filter log.jsonl --out estimates.jsonl");
    let before = (place.read("run/steps.csv"), place.read("estimates.jsonl"));
    for arguments in [
        &*format!("{RUN} run --seed 2"),
        "filter log.jsonl --out estimates.jsonl",
    ] {
        let binary = env!("CARGO_BIN_EXE_adslam");
        let script = format!("trap '' XFSZ; ulimit -f 1; exec '{binary}' {arguments}");
        let output = std::process::Command::new("sh")
            .args(["-c", &script])
            .current_dir(place.path(""))
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(FAILURE), "{said}");
        assert!(
            said.contains("cannot write ") && said.contains("disk has room"),
            "{said}"
        );
    }
    assert_eq!(
        (place.read("run/steps.csv"), place.read("estimates.jsonl")),
        before
    );
    assert_eq!(
        place.json("run/summary.json")["seed"],
        1,
        "all files are of one run"
    );
}

/// What is asked for on the standard output, into a file on a full disk: a part of it is no success.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_behind_the_standard_output() {
    let place = place();
    for arguments in [
        "schema scenario",
        "completions bash",
        "check polygon.toml --json",
    ] {
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_adslam"))
            .args(arguments.split(' '))
            .current_dir(place.path(""))
            .stdout(full)
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(FAILURE), "{arguments}: {said}");
        assert!(said.contains("cannot write the standard output"), "{said}");
    }
}

/// `adslam … | head`: the reader goes away, the files are written nevertheless.
#[test]
fn a_reader_that_goes_away_loses_nothing() {
    let place = place();
    for arguments in [
        &*format!("{RUN} run"),
        "tables config.toml --out tables",
        "check polygon.toml",
    ] {
        let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_adslam"))
            .args(arguments.split_whitespace())
            .current_dir(place.path(""))
            .stdout(std::process::Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        assert_eq!(child.wait().unwrap().code(), Some(0), "{arguments}");
    }
    assert!(place.path("run/summary.json").is_file());
    assert!(place.path("tables/tables.md").is_file());
}
