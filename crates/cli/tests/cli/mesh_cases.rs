//! Meshes as other programs write them, whose sizes are known: `tests/fixtures/meshes`.

use std::fs;

use serde_json::Value;

use super::support::{Place, heart, repository};

/// What a mesh must be, cm² and cm³ to as many digits as are given.
struct Case {
    file: &'static str,
    vertices: usize,
    triangles: usize,
    parts: usize,
    area: f64,
    volume: f64,
    note: Option<&'static str>,
}

const BALL: Case = Case {
    file: "",
    vertices: 162,
    triangles: 320,
    parts: 1,
    area: 110.97,
    volume: 109.27,
    note: None,
};

const PRISM: Case = Case {
    vertices: 16,
    triangles: 28,
    area: 152.0,
    volume: 84.0,
    ..BALL
};

const CASES: [Case; 11] = [
    Case {
        file: "two_solids.stl",
        vertices: 324,
        triangles: 640,
        parts: 2,
        area: 221.94,
        volume: 218.5,
        note: Some("it has 2 parts"),
    },
    Case {
        file: "upper_case.stl",
        ..BALL
    },
    Case {
        file: "ascii_bom.stl",
        ..BALL
    },
    Case {
        file: "ascii_latin1.stl",
        ..BALL
    },
    Case {
        file: "trailing_bytes.stl",
        note: Some("bytes after the last triangle are left out"),
        ..BALL
    },
    Case {
        file: "bom.obj",
        ..BALL
    },
    Case {
        file: "no_bom.obj",
        ..BALL
    },
    Case {
        file: "concave_u0.obj",
        ..PRISM
    },
    Case {
        file: "concave_u2.obj",
        ..PRISM
    },
    Case {
        file: "concave_u5.obj",
        ..PRISM
    },
    Case {
        file: "tristrips.ply",
        ..BALL
    },
];

/// An empty folder with the meshes in it.
fn place() -> Place {
    let place = Place::new(&[]);
    for entry in fs::read_dir(repository("tests/fixtures/meshes")).unwrap() {
        let entry = entry.unwrap();
        fs::copy(
            entry.path(),
            place.path(entry.file_name().to_str().unwrap()),
        )
        .unwrap();
    }
    place
}

fn report(out: &str) -> Value {
    serde_json::from_str::<Value>(out).unwrap()["mesh"].clone()
}

#[track_caller]
fn check(case: &Case, report: &Value) {
    let Case { file, .. } = case;
    assert_eq!(report["vertices"], case.vertices, "{file}");
    assert_eq!(report["triangles"], case.triangles, "{file}");
    assert_eq!(report["components"], case.parts, "{file}");
    assert_eq!(report["closed"], true, "{file}");
    assert_eq!(report["serves"], true, "{file}");
    let area = report["area_cm2"].as_f64().unwrap();
    assert!((area - case.area).abs() < 0.006, "{file}: {area} cm²");
    let volume = report["volume_cm3"].as_f64().unwrap();
    let half_a_digit = if case.parts > 1 { 0.06 } else { 0.006 };
    assert!(
        (volume - case.volume).abs() < half_a_digit,
        "{file}: {volume} cm³"
    );
    let notes = report["notes"].as_array().unwrap();
    let expected = usize::from(case.note.is_some());
    assert_eq!(notes.len(), expected, "{file}: {notes:?}");
    if let Some(words) = case.note {
        assert!(
            notes[0].as_str().unwrap().contains(words),
            "{file}: {notes:?}"
        );
    }
}

#[test]
fn every_case_has_its_size() {
    let place = place();
    for case in &CASES {
        let file = case.file;
        let said = place.succeeds(&format!("mesh {file} --features 8 --json"));
        check(case, &report(&said.out));
        let said = place.succeeds(&format!("mesh {file} --features 8"));
        if let Some(words) = case.note {
            assert!(said.out.contains(words), "{said:?}");
        }
    }
    // A blank before the first word.
    let bytes = fs::read(place.path("upper_case.stl")).unwrap();
    fs::write(place.path("blank.stl"), [b" ", bytes.as_slice()].concat()).unwrap();
    let said = place.succeeds("mesh blank.stl --json");
    check(&BALL, &report(&said.out));
    // A binary file with bytes after it that begins as text would.
    let mut bytes = fs::read(place.path("trailing_bytes.stl")).unwrap();
    bytes[..11].copy_from_slice(b"solid thing");
    fs::write(place.path("solid.stl"), bytes).unwrap();
    let said = place.succeeds("mesh solid.stl --json");
    let note = Some("bytes after the last triangle are left out");
    check(&Case { note, ..BALL }, &report(&said.out));
}

#[test]
fn nearly_joined_corners_are_joined_where_that_is_asked_for() {
    let place = place();
    let words = [
        "nearly_joined.ply will not serve",
        "the surface is not closed",
        "to join them closes the surface",
        "--join-within 1e-5",
        "join_within_cm = 1e-5",
    ];
    place.refuses("mesh nearly_joined.ply", &words);
    let said = place.refuses("mesh nearly_joined.ply --json", &words);
    let seen = report(&said.out);
    assert_eq!(seen["closes_within_cm"], 1e-5);
    assert_eq!(
        (&seen["components"], &seen["joined_vertices"]),
        (&320.into(), &0.into())
    );

    let said = place.succeeds("mesh nearly_joined.ply --join-within 1e-5 --json");
    let seen = report(&said.out);
    let note = Some("798 vertices are joined to others within 1e-5 cm, the farthest");
    check(&Case { note, ..BALL }, &seen);
    assert_eq!(
        (&seen["join_within_cm"], &seen["joined_vertices"]),
        (&1e-5.into(), &798.into())
    );
    let farthest = seen["farthest_joined_cm"].as_f64().unwrap();
    assert!((1e-7..1e-5).contains(&farthest), "{farthest}");
    place.refuses("mesh nearly_joined.ply --join-within=-1", &["below 0"]);
}

/// The notes on the file of a run's object are warnings of the run, in the terminal and for machines.
#[test]
fn a_run_warns_of_the_file_of_its_object() {
    let place = place();
    let scenario = |file: &str, keys: &str| {
        let own = format!("[object.mesh]\nfile = \"{file}\"\noffset_cm = [9.0, 0.0, 0.0]\n{keys}");
        heart(&[
            ("[object.phantom]", &own),
            ("features = 50", "features = 4"),
        ])
    };
    let warnings = |keys: &str, file: &str, given: &str| -> Vec<String> {
        fs::write(place.path("s.toml"), scenario(file, keys)).unwrap();
        let run = format!("run s.toml --planner predetermined --out run --json{given}");
        let said = place.succeeds(&run);
        let answer: Value = serde_json::from_str(&said.out).unwrap();
        let told = answer["warnings"].as_array().cloned().unwrap_or_default();
        let told: Vec<String> = told
            .iter()
            .map(|w| w.as_str().unwrap().to_owned())
            .collect();
        assert!(
            told.iter().all(|warning| said.err.contains(warning)),
            "{said:?}"
        );
        told.into_iter()
            .filter(|warning| warning.contains("mesh file"))
            .collect()
    };
    let about = |told: &[String], file: &str, words: &str| {
        assert_eq!(told.len(), 1, "{told:?}");
        assert!(
            told[0].contains(file) && told[0].contains(words),
            "{told:?}"
        );
    };
    assert!(warnings("", "bom.obj", "").is_empty());
    let words = "bytes after the last triangle are left out";
    about(
        &warnings("", "trailing_bytes.stl", ""),
        "trailing_bytes.stl",
        words,
    );
    about(
        &warnings("", "bom.obj", " --mesh trailing_bytes.stl"),
        "trailing_bytes.stl",
        words,
    );
    let joined = warnings("join_within_cm = 1e-5", "nearly_joined.ply", "");
    about(&joined, "nearly_joined.ply", "798 vertices are joined");

    fs::write(place.path("s.toml"), scenario("nearly_joined.ply", "")).unwrap();
    let words = ["[s.toml:", "is not closed", "join_within_cm = 1e-5"];
    place.refuses("check s.toml", &words);
}
