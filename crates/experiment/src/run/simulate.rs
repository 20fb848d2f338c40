//! A run from its start to its end.

use adslam_diagnostics::{Failure, Interrupt};
use adslam_names::PlannerName;
use adslam_record::{Observer, RunHistory};
use adslam_setup::Setup;
use adslam_simulation::{EpisodeError, RunSummary};

/// The result of a run.
#[derive(Clone, Debug)]
pub struct RunOutcome {
    /// Its numbers.
    pub summary: RunSummary,
    /// What its user should know, such as features that no viewpoint sees. What stands in brackets at the end of a
    /// warning may differ from run to run.
    pub warnings: Vec<String>,
    /// Every step of it, where a [`Batch`](super::Batch) was to record it.
    pub history: Option<RunHistory>,
}

/// Runs one planner at one seed.
///
/// # Errors
/// [`Failure::Interrupted`] when asked to stop, or a failure of planner or filter, with
/// its step.
pub fn simulate(
    setup: &Setup,
    planner: PlannerName,
    seed: u64,
    interrupt: &Interrupt,
    observer: &mut dyn Observer,
) -> Result<RunOutcome, Failure> {
    let failed = |error| failure(format!("{}, {planner}, seed {seed}", setup.name()), error);
    let (mut episode, mut warnings) = setup.episode(planner, seed).map_err(failed)?;
    observer.step(&episode.view())?;
    while !episode.is_over() {
        if interrupt.requested() {
            return Err(Failure::Interrupted);
        }
        let decision = episode.decide().map_err(failed)?;
        episode.take(&decision.control).map_err(failed)?;
        observer.step(&episode.view())?;
    }
    let seen = episode.warnings().into_iter();
    warnings.extend(seen.map(|text| format!("{}, {planner}: {text}", setup.name())));
    Ok(RunOutcome {
        summary: episode.summary(),
        warnings,
        history: None,
    })
}

/// The failure of an episode, which is called `run`.
fn failure(run: String, error: EpisodeError) -> Failure {
    match error {
        EpisodeError::Planning { step, cause } => Failure::Planning {
            run,
            step,
            cause: cause.into(),
        },
        EpisodeError::Filter { step, cause } => Failure::Filter {
            run,
            step,
            cause: cause.into(),
        },
        EpisodeError::World { step, cause } => Failure::Simulation { run, step, cause },
        EpisodeError::NoPlanner => Failure::Planning {
            run,
            step: 1,
            cause: error.into(),
        },
    }
}
