//! Short runs of the shipped scenarios.

use std::path::Path;

use adslam_diagnostics::Interrupt;
use adslam_experiment::run::simulate;
use adslam_names::PlannerName;
use adslam_record::{HistoryRecorder, RunHistory};
use adslam_scenario::Scenario;
use adslam_setup::Setup;

/// A run of a shipped scenario with seed 1, cut to `steps`.
pub fn history(scenario: &str, planner: PlannerName, steps: usize) -> RunHistory {
    history_with(scenario, "", planner, steps)
}

/// The same with further tables in the scenario.
pub fn history_with(
    scenario: &str,
    tables: &str,
    planner: PlannerName,
    steps: usize,
) -> RunHistory {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let path = folder.join(format!("{scenario}.toml"));
    let text = std::fs::read_to_string(&path).expect("a shipped scenario") + tables;
    let scenario = Scenario::parse(&text, &path).expect("a valid scenario");
    let mut setup = Setup::new(&scenario).expect("an object that serves");
    setup.model.steps = steps;
    let mut recorder = HistoryRecorder::new(&setup.model, planner, 1);
    simulate(&setup, planner, 1, &Interrupt::new(), &mut recorder).expect("a run");
    recorder.into_history()
}
