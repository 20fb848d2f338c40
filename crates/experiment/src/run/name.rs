//! Failures of a run, each with the run and the step.

use adslam_estimator::EstimatorError;
use adslam_planning::PlanningError;

use crate::ExperimentError;

/// What a run is called in errors.
pub(super) struct RunName(pub(super) String);

impl RunName {
    pub(super) fn filter_failed(
        &self,
        step: usize,
    ) -> impl FnOnce(EstimatorError) -> ExperimentError + '_ {
        move |cause| ExperimentError::Filter {
            run: self.0.clone(),
            step,
            cause,
        }
    }

    pub(super) fn planner_failed(
        &self,
        step: usize,
    ) -> impl FnOnce(PlanningError) -> ExperimentError + '_ {
        move |cause| ExperimentError::Planning {
            run: self.0.clone(),
            step,
            cause,
        }
    }

    pub(super) fn not_simulated(&self, step: usize, reason: String) -> ExperimentError {
        ExperimentError::Simulation {
            run: self.0.clone(),
            step,
            reason,
        }
    }
}
