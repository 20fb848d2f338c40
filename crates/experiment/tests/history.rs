//! What is recorded against the run itself, and files that cannot be used.

#![allow(clippy::unwrap_used, reason = "tests")]

use std::path::Path;
use std::sync::Arc;

use adslam_diagnostics::{Failure, Interrupt};
use adslam_experiment::run::simulate;
use adslam_names::PlannerName;
use adslam_record::{DrawnSurface, HistoryRecorder, Observer, RunHistory};
use adslam_scenario::Scenario;
use adslam_setup::Setup;
use adslam_simulation::StepView;
use nalgebra::{Point3, Vector3};
use proptest::prelude::*;

fn setup(name: &str, steps: usize) -> Setup {
    setup_with(name, steps, "")
}

/// A shipped scenario with further tables.
fn setup_with(name: &str, steps: usize, tables: &str) -> Setup {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../scenarios/{name}.toml"));
    let text = std::fs::read_to_string(&file).unwrap() + tables;
    let mut setup = Setup::new(&Scenario::parse(&text, &file).unwrap()).unwrap();
    setup.model.steps = steps;
    setup
}

fn record(setup: &Setup, planner: PlannerName) -> RunHistory {
    let mut recorder = HistoryRecorder::new(&setup.model, planner, 1);
    simulate(setup, planner, 1, &Interrupt::new(), &mut recorder).unwrap();
    recorder.into_history()
}

/// Compares the history with what the run shows, step by step.
struct Compare(HistoryRecorder);

impl Observer for Compare {
    fn step(&mut self, view: &StepView<'_>) -> Result<(), Failure> {
        self.0.step(view)?;
        let history = self.0.history();
        let index = view.step - 1;
        let step = &history.steps[index];
        assert!((step.true_pose().minus(view.pose)).amax() < 1e-5);
        assert!((step.estimate().minus(&view.belief.state.pose)).amax() < 1e-5);
        for (a, b) in step.true_features().iter().zip(view.features) {
            assert!((a - b).amax() < 1e-5);
        }
        for i in 0..history.feature_count() {
            let exact = view.belief.covariance.feature(adslam_models::FeatureId(i));
            let stored = step.feature_covariance(i).unwrap();
            assert!((stored - exact).amax() <= exact.amax() * 1e-3);
        }
        let candidates = history.candidates(index);
        assert_eq!(candidates.len(), view.scores.len());
        for score in view.scores {
            let stored = candidates
                .iter()
                .find(|c| Some(c.action) == score.index)
                .unwrap();
            assert!(stored.pose.minus(&score.pose).amax() < 1e-4);
            assert!((stored.trace - score.trace).abs() <= 1e-6 * score.trace);
        }
        if let (Some((decision, _)), Some(stored)) = (view.decision, &step.decision) {
            assert_eq!(stored.goal, decision.goal.map(|(place, _)| place));
            assert_eq!(
                stored.predicted_trace.is_some(),
                decision.predicted_trace.is_some()
            );
            assert_eq!(
                stored.action.is_some(),
                decision.scored > 0 || stored.goal.is_some()
            );
        }
        Ok(())
    }
}

#[test]
fn every_planner_is_recorded_as_it_ran_and_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let setup = setup("polygon", 6);
    for planner in PlannerName::PAPER {
        let mut compare = Compare(HistoryRecorder::new(&setup.model, planner, 3));
        let outcome = simulate(&setup, planner, 3, &Interrupt::new(), &mut compare).unwrap();
        let history = compare.0.into_history();
        assert_eq!(history.steps.len(), 6);
        assert_eq!(history.drawn, DrawnSurface::Features);
        assert_eq!(history.drawn_vertices(3), history.steps[3].true_features());
        let mean = history
            .steps
            .iter()
            .map(|s| s.metrics.pose_error)
            .sum::<f64>()
            / 6.0;
        assert!((mean - outcome.summary.pose_error_mean).abs() < 1e-5);
        history.to_file(folder.path()).unwrap().commit().unwrap();
        assert_eq!(RunHistory::load(folder.path()).unwrap(), history);
    }
}

#[test]
fn the_drawn_mesh_moves_as_the_scenario_says() {
    let departed = "[mismatch]\ndeformation_factor = 1.4\ntime_factor = 1.7\ndelay_steps = 0.3\n\
        [mismatch.rotation]\naxis = [1, 2, 0.5]\nrate_deg_per_step = 4";
    for (name, tables) in [
        ("heart", ""),
        ("heart", departed),
        ("rotating", ""),
        ("rotating", departed),
    ] {
        let mut setup = setup_with(name, 9, tables);
        if name == "rotating" {
            // Any mesh but the features' own surface.
            let drawn = Arc::make_mut(&mut setup.model.drawn);
            drawn.vertices.push(Point3::new(0.3, -0.4, 0.5));
        }
        let history = record(&setup, PlannerName::PREDETERMINED);
        let motion = &setup.model.world.motion;
        let mut base = Vector3::zeros();
        for n in 1..=9 {
            let drawn = history.drawn_vertices(n - 1);
            assert_eq!(drawn.len(), setup.model.drawn.vertices.len());
            for (p, rest) in drawn.iter().zip(&setup.model.drawn.vertices) {
                let expected = rest + base + motion.offset(rest, n);
                assert!(
                    (p - expected).amax() < 5e-4,
                    "{name}, step {n}: {p} {expected}"
                );
            }
            base += motion.translation_step(n);
        }
        let turns = history.steps.iter().any(|step| step.object.turn.is_some());
        assert_eq!(turns, !tables.is_empty());
        assert!(history.drawn_vertices(9).is_empty() && history.candidates(9).is_empty());
    }
}

#[test]
fn files_that_cannot_be_used_say_why() {
    let good = serde_json::to_value(record(&setup("polygon", 3), PlannerName::GLOBAL)).unwrap();
    let path = Path::new("run/history.json");
    let reason = |text: &str| {
        let error = RunHistory::parse(path, text).unwrap_err();
        assert!(error.remedy().is_some());
        error.to_string()
    };
    let text = good.to_string();
    assert!(RunHistory::parse(path, &text).is_ok());
    assert!(reason(&text[..text.len() / 2]).contains("ends in the middle"));
    assert!(reason("{}").contains("is not the history of a run"));
    assert!(reason("[1, 2]").contains("cannot be read"));
    let changed = |pointer: &str, value: serde_json::Value| {
        let mut json = good.clone();
        *json.pointer_mut(pointer).unwrap() = value;
        reason(&json.to_string())
    };
    use serde_json::json;
    assert!(changed("/version", json!(3)).contains("version 3; this adslam reads versions 1 to 2"));
    assert!(changed("/planner", json!("psy chic")).contains("cannot be read"));
    let mut of_another_program = good.clone();
    of_another_program["planner"] = json!("psychic");
    of_another_program["planner_look"] = json!({ "label": "Psychic", "colour": [1, 2, 3] });
    let read = RunHistory::parse(path, &of_another_program.to_string()).unwrap();
    assert_eq!(read.planner_look.unwrap().label, "Psychic");
    assert!(changed("/steps", json!([])).contains("no steps"));
    assert!(changed("/steps/1/features", json!([])).contains("step 2: 0 features"));
    assert!(changed("/steps/2/visible", json!([14])).contains("number 14, beyond 14"));
    assert!(changed("/steps/1/decision", json!(null)).contains("step 2: every step"));
    assert!(changed("/steps/1/decision/goal", json!(999)).contains("the goal has number 999"));
    assert!(changed("/steps/1/decision/scored", json!([1])).contains("make no list"));
    assert!(changed("/steps/1/decision/scored", json!([1, 1])).contains("0 traces"));
    let endless = json!([0, u64::MAX]);
    assert!(changed("/steps/1/decision/scored", endless).contains("traces, expected"));
    let beyond = json!([2, u64::MAX]);
    assert!(changed("/steps/1/decision/scored", beyond).contains("make no list"));
    assert!(changed("/topology/0/0", json!(77)).contains("a face has number 77"));
    let mut first_version = good.clone();
    first_version["version"] = json!(1);
    for step in first_version["steps"].as_array_mut().unwrap() {
        step["metrics"]
            .as_object_mut()
            .unwrap()
            .remove("drift_floor_cm");
    }
    let read = RunHistory::parse(path, &first_version.to_string()).unwrap();
    assert_eq!(read.steps[1].metrics.drift_floor_cm, None);
    let missing = RunHistory::load(Path::new("/nowhere/at/all")).unwrap_err();
    assert!(missing.message().contains("cannot read"), "{missing}");
}

proptest! {
    #[test]
    fn no_text_panics(cut in 0usize..4000, byte in any::<u8>()) {
        let mut text = r#"{"format":"adslam-history","version":1,"scenario":"x","planner":"local",
            "seed":1,"steps":[{"pose":[0,0,0,0,0,0]}],"drawn":"features"}"#.to_owned().into_bytes();
        let at = cut % text.len();
        text[at] = byte;
        let _ = RunHistory::parse(Path::new("x"), &String::from_utf8_lossy(&text));
    }
}
