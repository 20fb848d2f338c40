//! The page in a real browser, driven by browser.mjs.
//!
//! Needs node and Chromium; where one is missing the test says so, and fails in CI. `ADSLAM_NODE` and
//! `ADSLAM_CHROMIUM` name programs that are not on the path.

mod common;

use std::fs;
use std::path::Path;
use std::process::Command;

use adslam_names::PlannerName;
use adslam_record::RunHistory;
use adslam_replay::write_html;
use adslam_test_programs::Program;
use common::{history, history_with};

const NODE: Program = Program {
    what: "browser",
    variable: "ADSLAM_NODE",
    names: &["node"],
    remedy: "Debian: apt-get install nodejs",
};
const CHROMIUM: Program = Program {
    what: "browser",
    variable: "ADSLAM_CHROMIUM",
    names: &[
        "chromium",
        "chromium-browser",
        "google-chrome",
        "google-chrome-stable",
    ],
    remedy: "Debian: apt-get install chromium",
};

/// What has to be drawn at step 9.
fn step_9(history: &RunHistory) -> serde_json::Value {
    let vertices = history.drawn_vertices(8);
    let vertices: Vec<f64> = vertices.iter().flat_map(|p| [p.x, p.y, p.z]).collect();
    // The decision of step 9 leads to step 10.
    let candidates: Vec<[f64; 6]> = history
        .candidates(9)
        .iter()
        .map(|candidate| {
            let p = candidate.pose.position;
            let ahead = candidate.pose.orientation.rotation() * nalgebra::Vector3::x();
            [p.x, p.y, p.z, ahead.x, ahead.y, ahead.z]
        })
        .collect();
    serde_json::json!({
        "robot": history.steps[8].pose[3..],
        "vertices": vertices,
        "covariances": history.steps[8].feature_covariances,
        "candidates": candidates,
    })
}

#[test]
fn pages_of_one_and_two_runs_work_in_a_browser() {
    let (Some(node), Some(chromium)) = (NODE.find(), CHROMIUM.find()) else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let mut combined = history("polygon", PlannerName::COMBINED, 40);
    combined.scenario = "</script><b>polygon".to_owned();
    // An object that turns as a whole, and breathes deeper than believed.
    let departed = "[mismatch]\ndeformation_factor = 1.5\n\n\
        [mismatch.rotation]\naxis = [1, 2, 3]\nrate_deg_per_step = 4";
    let heart = history_with("heart", departed, PlannerName::GLOBAL, 12);
    let one = folder.path().join("one.html");
    let two = folder.path().join("two.html");
    write_html(&[&combined], &one).unwrap();
    write_html(&[&heart, &combined], &two).unwrap();
    let expected = folder.path().join("expected.json");
    let numbers = serde_json::json!({ "one": step_9(&combined), "two": step_9(&heart) });
    fs::write(&expected, numbers.to_string()).unwrap();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/browser.mjs");
    let output = Command::new(node)
        .args([&script, &chromium, &one, &two, &expected])
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    let complained = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}\n{complained}");
}
