//! `adslam filter`: where logs come from and where estimates go.

use std::fs;
use std::io::Write;
use std::process::{Command, Stdio};

use serde_json::{Value, json};

use super::support::{BAD_INPUT, Place, lines, log, repository};

/// A log of `tests/fixtures/cases`, with what came of the plain one.
fn case(name: &str) -> (Place, String) {
    let place = Place::new(&[]);
    for name in ["plain.log.jsonl", name] {
        let from = repository("tests/fixtures/cases").join(name);
        fs::copy(from, place.path(name)).unwrap();
    }
    place.succeeds("filter plain.log.jsonl --out plain.jsonl");
    let estimates = place.read("plain.jsonl");
    assert_eq!(estimates.lines().count(), 20);
    (place, estimates)
}

#[test]
fn a_byte_order_mark_is_skipped() {
    let (place, expected) = case("bom.log.jsonl");
    place.succeeds("filter bom.log.jsonl --out estimates.jsonl");
    assert_eq!(place.read("estimates.jsonl"), expected);
    let text = place.read("plain.log.jsonl");
    // On a line of its own, and in the midst of the text, where it is none.
    fs::write(place.path("blank.jsonl"), format!("\u{feff}\n{text}")).unwrap();
    place.succeeds("filter blank.jsonl --out estimates.jsonl");
    fs::write(
        place.path("inside.jsonl"),
        text.replacen('\n', "\n\u{feff}", 1),
    )
    .unwrap();
    place.refuses("filter inside.jsonl --out estimates.jsonl", &["line 2 "]);
}

#[test]
fn text_in_utf_16_is_told() {
    let text: Vec<u8> = lines(&log())
        .encode_utf16()
        .flat_map(u16::to_le_bytes)
        .collect();
    let place = Place::new(&[]);
    fs::write(place.path("log.jsonl"), [&[0xff, 0xfe][..], &text].concat()).unwrap();
    let words = [
        "line 1 is not UTF-8",
        "looks like UTF-16: save the log as UTF-8",
    ];
    place.refuses("filter log.jsonl --out estimates.jsonl", &words);
}

#[test]
fn gzip_is_unpacked_and_its_damage_told() {
    let (place, expected) = case("plain.log.jsonl.gz");
    place.succeeds("filter plain.log.jsonl.gz --out estimates.jsonl");
    assert_eq!(place.read("estimates.jsonl"), expected);

    let packed = fs::read(place.path("plain.log.jsonl.gz")).unwrap();
    // Two files one after the other are one.
    let whole = place.read("plain.log.jsonl");
    let (first, second) = whole.split_at(whole.len() / 2);
    fs::write(place.path("two.gz"), [gzip(first), gzip(second)].concat()).unwrap();
    place.succeeds("filter two.gz --out estimates.jsonl");
    assert_eq!(place.read("estimates.jsonl"), expected);

    // Cut off in the head of the file, in a line, and in the checksum.
    for (bytes, line) in [
        (2, 1),
        (5, 1),
        (20, 1),
        (packed.len() / 2, 0),
        (packed.len() - 4, 22),
    ] {
        fs::write(place.path("cut.gz"), &packed[..bytes]).unwrap();
        let words = [
            "breaks off, as the gzip file ends in the middle",
            "copy the file again",
        ];
        let said = place.refuses("filter cut.gz --out estimates.jsonl", &words);
        let named = format!("cut.gz: line {line} ");
        assert!(line == 0 || said.err.contains(&named), "{}", said.err);
    }
    fs::write(place.path("cut.gz"), &packed[..packed.len() / 2]).unwrap();
    let said = place.succeeds("filter cut.gz --out kept.jsonl --keep-complete");
    let kept = place.read("kept.jsonl");
    assert!(
        kept.lines().count() > 3 && expected.starts_with(&kept),
        "{said:?}"
    );

    let mut damaged = packed.clone();
    damaged[packed.len() / 2] ^= 0xff;
    fs::write(place.path("damaged.gz"), damaged).unwrap();
    place.refuses(
        "filter damaged.gz --out estimates.jsonl",
        &["damaged.gz: line ", "help:"],
    );
    let mut checksum = packed;
    let at = checksum.len() - 8;
    checksum[at] ^= 1;
    fs::write(place.path("checksum.gz"), checksum).unwrap();
    let words = ["cannot be unpacked, as the gzip file is damaged"];
    place.refuses("filter checksum.gz --out estimates.jsonl", &words);
}

fn gzip(text: &str) -> Vec<u8> {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    encoder.write_all(text.as_bytes()).unwrap();
    encoder.finish().unwrap()
}

/// A small file that unpacks to a line without an end is not taken into memory.
#[test]
fn a_line_without_an_end() {
    let place = Place::new(&[]);
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    let blanks = vec![b' '; 1 << 20];
    for _ in 0..300 {
        encoder.write_all(&blanks).unwrap();
    }
    let packed = encoder.finish().unwrap();
    assert!(packed.len() < 2 << 20, "{}", packed.len());
    fs::write(place.path("bomb.gz"), packed).unwrap();
    let words = ["line 1 has more than 268435456 bytes"];
    place.refuses("filter bomb.gz --out estimates.jsonl", &words);
}

#[test]
fn times_are_carried_to_estimates_and_trajectory() {
    let (place, expected) = case("stamp.log.jsonl");
    let said = place.succeeds("filter stamp.log.jsonl --out estimates.jsonl --tum one.tum");
    let words = ["warning: 19 of 20 steps have no time in the log and are left out of one.tum"];
    assert!(said.err.contains(words[0]), "{said:?}");
    let tum = place.read("one.tum");
    let poses: Vec<&str> = tum.lines().skip(1).collect();
    assert!(poses.len() == 1 && poses[0].starts_with("1.5 "), "{tum}");
    for (line, plain) in place.read("estimates.jsonl").lines().zip(expected.lines()) {
        let mut line: Value = serde_json::from_str(line).unwrap();
        let plain: Value = serde_json::from_str(plain).unwrap();
        let time = line.as_object_mut().unwrap().remove("time");
        assert_eq!(time, (plain["step"] == 3).then(|| json!(1.5)));
        assert_eq!(line, plain);
    }

    let mut steps = log();
    steps[0]["time"] = json!(1_700_000_000.25);
    for (step, n) in steps[1..].iter_mut().zip(1..) {
        step["time"] = json!(1_700_000_000.25 + 0.5 * f64::from(n));
    }
    let place = Place::new(&[("log.jsonl", &lines(&steps))]);
    let said = place.succeeds("filter log.jsonl --out e.jsonl --tum new/t.tum --unit cm");
    assert!(said.out.contains("wrote e.jsonl, new/t.tum"), "{said:?}");
    let tum = place.read("new/t.tum");
    assert!(
        tum.starts_with("# timestamp[s] tx[cm] ty[cm] tz[cm] qx "),
        "{tum}"
    );
    let estimates = place.read("e.jsonl");
    assert_eq!(tum.lines().count(), 5);
    for (pose, line) in tum.lines().skip(1).zip(estimates.lines()) {
        let line: Value = serde_json::from_str(line).unwrap();
        let numbers: Vec<f64> = pose.split(' ').map(|n| n.parse().unwrap()).collect();
        assert_eq!(json!(numbers[0]), line["time"]);
        assert_eq!(
            json!(numbers[1..4]),
            json!(line["pose"].as_array().unwrap()[3..])
        );
    }

    steps[2]["time"] = steps[1]["time"].clone();
    let place = Place::new(&[("log.jsonl", &lines(&steps))]);
    let words = ["line 3 (step 3) has the time", "grow from step to step"];
    place.refuses("filter log.jsonl --out e.jsonl", &words);
}

/// The usual unit is evo's, whatever that of the log; without times, steps are the time.
#[test]
fn trajectories_are_in_metres() {
    let mut steps = log();
    let mut x = Vec::new();
    for unit in ["cm", "mm", "m"] {
        steps[0]["length_unit"] = json!(unit);
        let place = Place::new(&[("log.jsonl", &lines(&steps))]);
        place.succeeds("filter log.jsonl --out e.jsonl --tum t.tum");
        let tum = place.read("t.tum");
        assert!(
            tum.starts_with("# timestamp[step] tx[m] ty[m] tz[m] "),
            "{tum}"
        );
        let first = tum.lines().nth(1).unwrap();
        assert!(first.starts_with("2 "), "{first}");
        x.push(first.split(' ').nth(1).unwrap().parse::<f64>().unwrap());
    }
    assert!(
        (x[0] / x[1] - 10.0).abs() < 1e-12 && (x[2] / x[0] - 100.0).abs() < 1e-12,
        "{x:?}"
    );
    let place = Place::new(&[("log.jsonl", &lines(&steps))]);
    place.refuses("filter log.jsonl --out e.jsonl --unit cm", &["--tum"]);
    place.refuses(
        "filter log.jsonl --out e.jsonl --tum t.tum --unit inch",
        &["mm, cm, m"],
    );
}

/// Runs the command with this on its standard input.
fn fed(place: &Place, arguments: &str, input: &[u8]) -> (Option<i32>, String, String) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_adslam"))
        .args(arguments.split_whitespace())
        .current_dir(place.path("."))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(input).unwrap();
    let output = child.wait_with_output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (
        output.status.code(),
        text(output.stdout),
        text(output.stderr),
    )
}

#[test]
fn from_the_standard_input_to_the_standard_output() {
    let text = lines(&log());
    let place = Place::new(&[("log.jsonl", &text)]);
    place.succeeds("filter log.jsonl --out estimates.jsonl");
    let expected = place.read("estimates.jsonl");
    for input in [text.clone().into_bytes(), gzip(&text)] {
        let (code, out, err) = fed(&place, "filter - --out - --tum t.tum", &input);
        assert_eq!((code, &out), (Some(0), &expected), "{err}");
        assert!(err.contains("filtered 4 steps with 4 features"), "{err}");
        assert!(!place.path("-").exists());
        let (code, out, _) = fed(&place, "filter - --out other.jsonl --json", &input);
        assert_eq!((code, out.lines().count()), (Some(0), 1), "{out}");
        assert_eq!(place.read("other.jsonl"), expected);
    }
    // What was made before the error is there, and the error tells where it is.
    let broken = format!("{text}{{\"step\":6");
    let (code, out, err) = fed(&place, "filter - --out -", broken.as_bytes());
    assert_eq!((code, &out), (Some(BAD_INPUT), &expected));
    assert!(err.contains("standard input: line 6"), "{err}");
}

#[test]
fn outputs_that_would_meet_are_refused() {
    let place = Place::new(&[("log.jsonl", &lines(&log()))]);
    let words = ["--json would both go to the standard output"];
    place.refuses("filter log.jsonl --out - --json", &words);
    let cases = [
        ("log.jsonl", "log.jsonl is the log itself"),
        ("./e.jsonl", "is the file of estimates"),
        ("-", "cannot go to the standard output"),
    ];
    fs::write(place.path("e.jsonl"), "").unwrap();
    for (tum, words) in cases {
        place.refuses(
            &format!("filter log.jsonl --out e.jsonl --tum {tum}"),
            &[words],
        );
    }
    place.refuses("filter log.jsonl --out log.jsonl", &["is the log itself"]);
}

/// A reader that has seen enough is no failure.
#[test]
fn a_reader_that_goes_away() {
    let place = Place::new(&[]);
    let mut steps = log();
    let many = (2..2000).map(super::support::log_step);
    steps.truncate(1);
    steps.extend(many);
    fs::write(place.path("log.jsonl"), lines(&steps)).unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_adslam"))
        .args(["filter", "log.jsonl", "--out", "-"])
        .current_dir(place.path("."))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!((output.status.code(), &*said), (Some(0), ""));
}
