//! A run written down as a log: the filter over it gives the run again, to the last bit.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

use std::fs;
use std::path::Path;

use adslam_agent::Estimators;
use adslam_diagnostics::{Failure, Interrupt};
use adslam_experiment::run::simulate;
use adslam_names::{EstimatorName, LengthUnit, PlannerName};
use adslam_record::Observer;
use adslam_record::log::{
    EstimateErrors, EstimateLine, FilterChoice, GateChoice, LogReader, LogRecorder, TailPolicy,
    filter_log,
};
use adslam_scenario::Scenario;
use adslam_setup::Setup;
use adslam_simulation::{RunSummary, StepView};

/// Everything that can go wrong with a measurement does, and a gate keeps some of it out.
const FAULTS: &str = "[mismatch]
outlier_probability = 0.2
outlier_sigma_cm = 1.0
missed_detection_probability = 0.2
dropped_structure_probability = 0.3
";

fn scenario(name: &str, estimator: EstimatorName, replace: [&str; 2], more: &str) -> Scenario {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../scenarios")
        .join(name);
    let text = fs::read_to_string(&path).unwrap();
    let [old, new] = replace;
    assert!(text.contains(old), "{name} has no {old:?}");
    let filter = format!("[filter]\nestimator = \"{estimator}\"\n");
    let text = format!("{}\n{filter}{more}", text.replacen(old, new, 1));
    Scenario::parse(&text, &path).unwrap()
}

/// Writes down the log, and the estimates as the filter of a log tells them.
struct Watch {
    log: LogRecorder,
    estimates: Vec<EstimateLine>,
}

impl Observer for Watch {
    fn step(&mut self, view: &StepView<'_>) -> Result<(), Failure> {
        if let Some(update) = view.update {
            self.estimates.push(EstimateLine {
                errors: Some(EstimateErrors::from(view.metrics)),
                ..EstimateLine::of(view.step as u64, view.belief, update, &[])
            });
        }
        self.log.step(view)
    }
}

/// As text, in which numbers with other bits differ.
fn text(line: &EstimateLine) -> String {
    let line = EstimateLine {
        rejected_features: Vec::new(),
        ..line.clone()
    };
    serde_json::to_string(&line).unwrap()
}

/// Runs the scenario over a few steps and filters its log; the two must agree in everything. Returns the run, and
/// the log.
fn the_same_bits(scenario: &Scenario, planner: PlannerName) -> (RunSummary, String) {
    let folder = tempfile::tempdir().unwrap();
    let mut setup = Setup::new(scenario).unwrap();
    setup.model.steps = 8;
    let mut watch = Watch {
        log: LogRecorder::create(folder.path(), &setup.model, planner, 3).unwrap(),
        estimates: Vec::new(),
    };
    let interrupt = Interrupt::new();
    let run = simulate(&setup, planner, 3, &interrupt, &mut watch)
        .unwrap()
        .summary;
    let file = watch.log.finish();
    let path = file.path().to_owned();
    file.commit().unwrap();
    let log = fs::read_to_string(&path).unwrap();

    let mut again = Vec::new();
    let replayed = filter_log(
        log.as_bytes(),
        &path,
        FilterChoice::default(),
        &Estimators::standard(),
        TailPolicy::Refuse,
        &interrupt,
        &mut |line| {
            again.push(line.clone());
            Ok(())
        },
    )
    .unwrap();
    assert_eq!(again.len(), 7);
    for (line, run) in again.iter().zip(&watch.estimates) {
        assert_eq!(text(line), text(run), "step {}", run.step);
    }
    let rejected: usize = again.iter().map(|line| line.rejected_features.len()).sum();
    assert_eq!(rejected, run.rejected_measurements);
    assert_eq!(replayed.length_unit, LengthUnit::Cm);

    // The numbers are those of the run's summary, under the same names.
    let summary = serde_json::to_value(&run).unwrap();
    let numbers = serde_json::to_value(&replayed.numbers).unwrap();
    let numbers = numbers.as_object().unwrap();
    assert!(numbers.contains_key("joint_nees_per_dof_mean"));
    for (name, number) in numbers {
        assert_eq!(number, &summary[name], "{name}");
    }
    (run, log)
}

#[test]
fn every_estimator_in_both_environments() {
    for estimator in EstimatorName::OURS {
        for name in ["polygon.toml", "heart.toml"] {
            for kind in ["fresh", "accumulating"] {
                let noise = format!("[noise]\ndeformation_noise = \"{kind}\"");
                let scenario = scenario(name, estimator, ["[noise]", &noise], "");
                the_same_bits(&scenario, PlannerName::PREDETERMINED);
            }
        }
    }
}

#[test]
fn with_a_gate_and_faults() {
    let more = format!("gate_probability = 0.99\n{FAULTS}");
    let mut rejected = 0;
    for estimator in EstimatorName::OURS {
        let scenario = scenario("polygon.toml", estimator, ["", ""], &more);
        let (run, log) = the_same_bits(&scenario, PlannerName::PREDETERMINED);
        rejected += run.rejected_measurements;
        let with = log.matches("structure_sums").count();
        assert!(
            (1..7).contains(&with),
            "some did not arrive, some did: {with}"
        );
        assert!(log.contains("\"gate_probability\":0.99"));
    }
    assert!(rejected > 0, "the gate kept something out");
}

#[test]
fn without_structure() {
    let more = "structure = \"none\"\n";
    let scenario = scenario("polygon.toml", EstimatorName::EULER_EKF, ["", ""], more);
    let (_, log) = the_same_bits(&scenario, PlannerName::LOCAL);
    assert!(!log.contains("structure_sums"));
}

/// What is asked for goes before what the log says.
#[test]
fn another_filter_than_the_log_says() {
    let more = "gate_probability = 0.01\n";
    let scenario = scenario("polygon.toml", EstimatorName::SO3_EKF, ["", ""], more);
    let (_, log) = the_same_bits(&scenario, PlannerName::LOCAL);
    let filtered = |choice| {
        let mut lines = Vec::new();
        let summary = filter_log(
            log.as_bytes(),
            Path::new("log"),
            choice,
            &Estimators::standard(),
            TailPolicy::Refuse,
            &Interrupt::new(),
            &mut |line| {
                lines.push(text(line));
                Ok(())
            },
        );
        (summary.unwrap(), lines)
    };
    let (recorded, lines) = filtered(FilterChoice::default());
    assert_eq!(recorded.estimator, EstimatorName::SO3_EKF);
    assert_eq!(recorded.gate_probability.map(|p| p.get()), Some(0.01));
    assert!(recorded.numbers.rejected_measurements > 0);
    let (other, others) = filtered(FilterChoice {
        estimator: Some(EstimatorName::EULER_EKF),
        gate: GateChoice::All,
    });
    assert_eq!(other.estimator, EstimatorName::EULER_EKF);
    assert_eq!(other.gate_probability, None);
    assert_eq!(other.numbers.rejected_measurements, 0);
    assert_ne!(lines, others);
}

/// All that a log's header holds is read back.
#[test]
fn the_header_says_where_it_comes_from() {
    let scenario = scenario("polygon.toml", EstimatorName::SO3_EKF, ["", ""], "");
    let (_, log) = the_same_bits(&scenario, PlannerName::GLOBAL);
    let reader = LogReader::new(log.as_bytes(), Path::new("log")).unwrap();
    let source = reader.header().source.clone().unwrap();
    assert!(source.contains("global planner, seed 3"), "{source}");
}
