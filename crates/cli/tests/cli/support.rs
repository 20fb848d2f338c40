//! A folder to work in, the command in it, and small scenarios and logs.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use assert_cmd::Command;
use serde_json::{Value, json};
use tempfile::TempDir;

pub const BAD_INPUT: i32 = 2;
pub const FAILURE: i32 = 1;
pub const PLANNERS: [&str; 4] = ["predetermined", "local", "global", "combined"];

/// The keys of RUN, as tables.json and summary.json must have them.
pub const RUN_KEYS: [&str; 13] = [
    "seed",
    "observed",
    "steps_to_full_coverage",
    "pose_error_mean",
    "pose_error_max",
    "feature_error_mean",
    "feature_error_max",
    "relative_pose_error_mean",
    "relative_feature_error_mean",
    "pose_nees_mean",
    "steps_inside_object",
    "steps_below_clearance",
    "decision_ms",
];

/// Steps of [`polygon`].
pub const STEPS: usize = 5;

/// Where the repository's files are.
pub fn repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .join(path)
}

/// The names, set as code, in the first column of the table below a heading.
pub fn documented(document: &str, heading: &str) -> Vec<String> {
    let (_, section) = document.split_once(&format!("\n{heading}\n")).unwrap();
    let section = section.split("\n## ").next().unwrap();
    let cells = section
        .lines()
        .filter_map(|line| line.strip_prefix("| `")?.split('|').next());
    let names: Vec<String> = cells
        .flat_map(|cell| cell.split('`').step_by(2))
        .map(str::to_owned)
        .collect();
    assert!(names.len() > 4);
    names
}

/// `text` with parts replaced, each of which it must have.
pub fn replaced(text: &str, replacements: &[(&str, &str)]) -> String {
    replacements
        .iter()
        .fold(text.to_owned(), |text, (old, new)| {
            assert!(text.contains(old), "there is no {old:?} to replace");
            text.replacen(old, new, 1)
        })
}

/// The shipped polygon with few steps and few actions, parts replaced.
pub fn polygon(replacements: &[(&str, &str)]) -> String {
    let shipped = fs::read_to_string(repository("scenarios/polygon.toml")).unwrap();
    let short = replaced(
        &shipped,
        &[
            ("steps = 100", &format!("steps = {STEPS}")),
            ("roll_deg = [-30.0, 0.0, 30.0]", "roll_deg = [0.0]"),
            ("pitch_deg = [-30.0, 0.0, 30.0]", "pitch_deg = [0.0]"),
            ("samples = 50", "samples = 5"),
        ],
    );
    replaced(&short, replacements)
}

/// The shipped heart with few steps, parts replaced.
pub fn heart(replacements: &[(&str, &str)]) -> String {
    let shipped = fs::read_to_string(repository("scenarios/heart.toml")).unwrap();
    replaced(
        &replaced(&shipped, &[("steps = 200", "steps = 2")]),
        replacements,
    )
}

/// A header of a log with four features.
pub fn log_header() -> Value {
    let variance =
        |i: usize| -> Vec<f64> { (0..6).map(|j| if i == j { 1e-4 } else { 0.0 }).collect() };
    json!({
        "format": "adslam-log", "version": 1, "length_unit": "cm", "features": 4,
        "initial": {
            "pose": [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            "features": [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 1.0]],
            "pose_covariance": (0..6).map(variance).collect::<Vec<_>>(),
            "feature_sigma": 0.03,
        },
        "noise": {
            "rotation_sigma": 0.02, "translation_sigma": 0.03, "feature_motion_sigma": 0.05,
            "feature_measurement_sigma": 0.02, "structure_measurement_sigma": 0.5,
        },
    })
}

/// A step of that log.
pub fn log_step(n: u64) -> Value {
    json!({
        "step": n,
        "control": {"rotation": [0.0, 0.0, 0.1], "translation": [0.1, 0.0, 0.0]},
        "feature_motion": [[0.1, 0.0, 0.0], [0.1, 0.0, 0.0], [0.1, 0.0, 0.0], [0.1, 0.0, 0.0]],
        "feature_measurements": [{"id": 0, "z": [1.0, -0.1, 0.0]}, {"id": 3, "z": [1.0, 0.0, 1.0]}],
        "structure_measurements": [{"from": 0, "to": 1, "z": [1.0, 0.0, 0.0]}],
    })
}

/// Values as JSON lines.
pub fn lines(values: &[Value]) -> String {
    values.iter().map(|value| format!("{value}\n")).collect()
}

/// The header and steps 2 to 5; the header is line 1, step n line n.
pub fn log() -> Vec<Value> {
    std::iter::once(log_header())
        .chain((2..=5).map(log_step))
        .collect()
}

/// A folder that the command works in.
pub struct Place(TempDir);

/// How a command ended, and what it said with all line breaks and drawing taken out.
#[derive(Debug)]
pub struct Ended {
    pub code: Option<i32>,
    pub out: String,
    pub err: String,
}

impl Place {
    pub fn new(files: &[(&str, &str)]) -> Self {
        let place = Self(tempfile::tempdir().unwrap());
        for (name, content) in files {
            fs::write(place.path(name), content).unwrap();
        }
        place
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    pub fn json(&self, name: &str) -> Value {
        serde_json::from_str(&self.read(name)).unwrap()
    }

    /// The command with arguments parted by blanks.
    pub fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_adslam"));
        command
            .args(arguments.split_whitespace())
            .current_dir(self.0.path())
            .env_remove("NO_GRAPHICS")
            .env("NO_COLOR", "1")
            .env("COLUMNS", "80");
        command
    }

    /// Runs the command.
    pub fn adslam(&self, arguments: &str) -> Ended {
        let output = self.command(arguments).output().unwrap();
        let ended = Ended {
            code: output.status.code(),
            out: plain(&output.stdout),
            err: plain(&output.stderr),
        };
        assert!(!ended.err.contains("panicked"), "{ended:?}");
        ended
    }

    /// Runs the command, which must end well.
    pub fn succeeds(&self, arguments: &str) -> Ended {
        let ended = self.adslam(arguments);
        assert_eq!(ended.code, Some(0), "{ended:?}");
        ended
    }

    /// Runs the command, which must refuse its input, say all of `words` and leave every file as it
    /// is.
    #[track_caller]
    pub fn refuses(&self, arguments: &str, words: &[&str]) -> Ended {
        self.ends_badly(arguments, BAD_INPUT, words)
    }

    /// Runs the command, which must end with `code`, say all of `words` and leave every file as it
    /// is.
    #[track_caller]
    pub fn ends_badly(&self, arguments: &str, code: i32, words: &[&str]) -> Ended {
        let before = self.files();
        let ended = self.adslam(arguments);
        assert_eq!(ended.code, Some(code), "{ended:?}");
        for word in words {
            assert!(ended.err.contains(word), "no {word:?} in {}", ended.err);
        }
        assert_eq!(self.files(), before, "files have changed");
        ended
    }

    /// Every file below the folder with its content; of large ones the size. But for locks, which say who came
    /// last.
    fn files(&self) -> BTreeMap<PathBuf, Vec<u8>> {
        let mut files = BTreeMap::new();
        let mut folders = vec![self.0.path().to_owned()];
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                let size = fs::metadata(&path).unwrap().len();
                if path.is_dir() {
                    folders.push(path);
                } else if path.ends_with("study.lock") {
                    continue;
                } else if size > 1 << 20 {
                    files.insert(path, size.to_le_bytes().to_vec());
                } else {
                    files.insert(path.clone(), fs::read(&path).unwrap());
                }
            }
        }
        files
    }
}

/// What was said, without the line breaks and the drawing, which depend on the width.
fn plain(text: &[u8]) -> String {
    String::from_utf8_lossy(text)
        .split_whitespace()
        .filter(|word| !["│", "×", "╰─▶"].contains(word))
        .collect::<Vec<_>>()
        .join(" ")
}
