//! Every figure, drawn from short real runs.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

use std::path::Path;

use adslam_diagnostics::Interrupt;
use adslam_experiment::run::simulate;
use adslam_experiment::tables::{ExperimentTables, PlannerRuns, TablePlan};
use adslam_figures::{
    BandedMean, ConsistencyCurve, ConsistencyCurves, Figure, Method, RunsOfMethod, boxes,
    comparison, consistency, coverage, environments, estimates, nees, pose_error,
};
use adslam_names::{EstimatorName, Look, PlannerName};
use adslam_record::{HistoryRecorder, RunHistory};
use adslam_scenario::Scenario;
use adslam_scenario::config::{Config, Selection};
use adslam_setup::Setup;

fn file(name: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .join(name)
}

fn record(scenario: &str, steps: usize) -> Vec<RunHistory> {
    let scenario = Scenario::load(&file(&format!("scenarios/{scenario}.toml"))).unwrap();
    let mut setup = Setup::new(&scenario).unwrap();
    setup.model.steps = steps;
    let run = |planner| {
        let mut recorder = HistoryRecorder::new(&setup.model, planner, 1);
        simulate(&setup, planner, 1, &Interrupt::new(), &mut recorder).unwrap();
        recorder.into_history()
    };
    PlannerName::PAPER.into_iter().map(run).collect()
}

fn tables(runs: usize) -> ExperimentTables {
    let config = Config::load(&file("configs/paper.toml")).unwrap();
    let selection = Selection {
        runs: Some(runs),
        only: vec!["polygon".to_owned()],
        mesh: None,
    };
    let mut config = config;
    for plan in &mut config.experiments {
        plan.planners
            .retain(|planner| *planner != PlannerName::LOCAL);
    }
    let plan = TablePlan::new(config, &selection).unwrap();
    plan.run(&Interrupt::new(), &|| ()).experiments.remove(0)
}

/// All figures of some histories, with the texts that each must have.
fn all(histories: &[RunHistory]) -> Vec<(Figure, &'static [&'static str])> {
    let runs: Vec<&RunHistory> = histories.iter().collect();
    let space: &[&str] = &["x (cm)", "y (cm)", "z (cm)"];
    vec![
        (environments("environments", &runs).unwrap(), space),
        (estimates("estimates", &runs).unwrap(), space),
        (
            comparison("comparison", &runs).unwrap(),
            &["Step", "Pose error (cm, rad)", "Decision time (ms)"],
        ),
        (
            coverage("coverage", &runs).unwrap(),
            &[
                "Step",
                "Features seen (%)",
                "Observed feature times (count)",
            ],
        ),
        (
            nees("nees", &runs).unwrap(),
            &["Step", "Pose NEES (dimensionless)"],
        ),
        (
            pose_error("pose-error", &runs).unwrap(),
            &["Step", "yaw (rad)", "z (cm)"],
        ),
    ]
}

fn check(figure: &Figure, texts: &[&str]) {
    let name = figure.name();
    let document = roxmltree::Document::parse(figure.svg())
        .unwrap_or_else(|error| panic!("{name} is not well-formed: {error}"));
    let is_text = |node: &roxmltree::Node<'_, '_>| node.has_tag_name("text");
    let found: Vec<&str> = document
        .descendants()
        .filter(is_text)
        .filter_map(|node| node.text())
        .collect();
    for text in texts {
        assert!(found.contains(text), "{name} lacks {text:?}: {found:?}");
    }
    assert!(!figure.svg().contains("NaN") && !figure.svg().contains("inf"));
}

#[test]
fn every_figure_is_well_formed_and_labelled_with_units() {
    for (scenario, steps) in [("polygon", 12), ("heart", 4)] {
        let histories = record(scenario, steps);
        for (figure, texts) in all(&histories) {
            check(&figure, texts);
            for method in ["Predetermined", "Local", "Global", "Combined"] {
                let is_named = figure.svg().contains(method);
                assert!(is_named || figure.name() == "environments");
            }
            let has_floor = matches!(figure.name(), "comparison" | "pose-error");
            assert_eq!(figure.svg().contains("drift floor"), has_floor);
            let png = figure.png_scaled(0.5).unwrap();
            assert!(png.starts_with(b"\x89PNG") && png.len() > 2000);
        }
    }
}

#[test]
fn the_same_runs_in_any_order_give_the_same_bytes() {
    let mut histories = record("polygon", 6);
    let first = all(&histories);
    histories.reverse();
    for ((a, _), (b, _)) in first.iter().zip(all(&histories)) {
        assert!(
            a.name() == "environments" || a.svg() == b.svg(),
            "{}",
            a.name()
        );
    }
    let again = record("polygon", 6);
    let runs: Vec<&RunHistory> = again.iter().collect();
    assert_eq!(estimates("estimates", &runs).unwrap(), first[1].0);
}

#[test]
fn runs_that_hardly_began_are_drawn() {
    let mut histories = record("polygon", 1);
    for (figure, texts) in all(&histories) {
        check(&figure, texts);
    }
    for history in &mut histories {
        history.steps.clear();
        history.scenario = "<a & b>\u{1}".to_owned();
    }
    for (figure, _) in all(&histories) {
        check(&figure, &[]);
        assert!(figure.png_scaled(0.3).is_ok());
    }
    for (figure, _) in all(&[]) {
        check(&figure, &[]);
    }
    for method in record("polygon", 3) {
        for (figure, texts) in all(&[method]) {
            check(&figure, texts);
        }
    }
}

fn of_methods(tables: &ExperimentTables) -> Vec<RunsOfMethod<'_>> {
    let of = |p: &PlannerRuns| Method::new(p.planner, p.look.clone());
    let planners = tables.planners.iter();
    planners
        .map(|p| RunsOfMethod {
            method: of(p),
            runs: &p.runs,
        })
        .collect()
}

#[test]
fn box_plots_have_a_panel_for_each_number() {
    let mut tables = tables(3);
    let figure = boxes("boxes", "hill", &of_methods(&tables)).unwrap();
    check(&figure, &["count", "steps", "cm, rad", "cm", "ms", "Comb."]);
    assert!(figure.svg().contains("Pose NEES, mean"));
    for planner in &mut tables.planners {
        for run in &mut planner.runs {
            run.steps_to_full_coverage = None;
            run.pose_error_mean = f64::NAN;
        }
    }
    check(
        &boxes("boxes", "hill", &of_methods(&tables)).unwrap(),
        &["0 of 3"],
    );
    tables.planners.iter_mut().for_each(|p| p.runs.clear());
    check(&boxes("boxes", "hill", &of_methods(&tables)).unwrap(), &[]);
    tables.planners.clear();
    check(&boxes("boxes", "hill", &of_methods(&tables)).unwrap(), &[]);
}

#[test]
fn both_files_are_written() {
    let folder = tempfile::tempdir().unwrap();
    let histories = record("polygon", 3);
    let runs: Vec<&RunHistory> = histories.iter().collect();
    let figure = coverage("coverage", &runs).unwrap();
    let [svg, png] = figure.write(folder.path()).unwrap();
    assert_eq!(std::fs::read_to_string(svg).unwrap(), figure.svg());
    assert_eq!(std::fs::read(png).unwrap(), figure.png().unwrap());
    let error = figure.write(&folder.path().join("absent")).unwrap_err();
    assert!(error.to_string().contains("coverage.svg"), "{error}");
}

/// Two planners, one of them with two estimators; the other measure was never taken.
#[test]
fn consistency_has_a_panel_for_each_planner_and_a_line_for_each_estimator() {
    let curve = |estimator, planner, nees| ConsistencyCurve {
        method: Method::new(planner, None),
        estimator,
        estimator_look: Look::of_estimator(estimator),
        steps: (2..4)
            .map(|step| BandedMean {
                step,
                mean: nees / 6.0,
                low: 0.5,
                high: 1.5,
            })
            .collect(),
    };
    let mut curves = ConsistencyCurves {
        measure: "Pose NEES",
        label: "hill",
        runs: 2,
        confidence: 0.99,
        curves: vec![
            curve(EstimatorName::EULER_EKF, PlannerName::LOCAL, 4.0),
            curve(EstimatorName::RIGHT_INVARIANT_EKF, PlannerName::LOCAL, 7.0),
            curve(EstimatorName::EULER_EKF, PlannerName::GLOBAL, 900.0),
        ],
    };
    let figure = consistency(&curves).unwrap();
    assert_eq!(figure.name(), "hill-pose-nees");
    let texts = [
        "Euler EKF",
        "Right-invariant EKF",
        "(a) Local",
        "(b) Global",
        "Pose NEES / dof",
        "Step",
    ];
    check(&figure, &texts);
    assert!(!figure.svg().contains("SO(3) EKF"), "no such line is there");
    // Nothing to draw is an empty figure, not a failure.
    curves.curves.clear();
    check(&consistency(&curves).unwrap(), &[]);
}
