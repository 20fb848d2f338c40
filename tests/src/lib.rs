//! Helpers of the tests that span the crates; the tests themselves are in `tests/`.

pub mod golden_runs;
pub mod readers;

use std::fs;
use std::path::{Path, PathBuf};

use adslam_diagnostics::Interrupt;
use adslam_experiment::run::Batch;
use adslam_names::PlannerName;
use adslam_scenario::Scenario;
use adslam_setup::Setup;
use adslam_simulation::RunSummary;

/// A file of the repository, by its path from the root.
#[must_use]
pub fn repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}

/// A file of `tests/fixtures`.
#[must_use]
pub fn fixture(path: &str) -> PathBuf {
    repository("tests/fixtures").join(path)
}

/// A shipped scenario made ready to run, with parts of its text replaced.
///
/// # Panics
/// If the scenario is not valid or does not hold a text that is to be replaced.
#[must_use]
pub fn setup(name: &str, replacements: &[(&str, &str)]) -> Setup {
    let path = repository("scenarios").join(name);
    let mut text = fs::read_to_string(&path).expect("a shipped scenario");
    for (old, new) in replacements {
        assert!(text.contains(old), "{name} does not contain {old:?}");
        text = text.replace(old, new);
    }
    let scenario = Scenario::parse(&text, &path).expect("a valid scenario");
    Setup::new(&scenario).expect("a world that can be built")
}

/// The summaries of a planner at the seeds 1 to `runs`, in order.
///
/// # Panics
/// If a run fails.
#[must_use]
pub fn summaries(setup: &Setup, planner: PlannerName, runs: u64) -> Vec<RunSummary> {
    let batch: Vec<Batch<'_>> = (1..=runs)
        .map(|seed| Batch {
            setup,
            planner,
            seed,
            record: false,
        })
        .collect();
    let results = Batch::run_all(&batch, &Interrupt::new(), &|| ());
    results
        .into_iter()
        .map(|result| result.expect("a run that ends well").summary)
        .collect()
}

/// The mean over runs.
#[must_use]
pub fn mean(runs: &[RunSummary], of_run: impl Fn(&RunSummary) -> f64) -> f64 {
    runs.iter().map(of_run).sum::<f64>() / runs.len() as f64
}
