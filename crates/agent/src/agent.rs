//! Predict, update, decide.

use std::sync::Arc;

use adslam_estimator::{Belief, Estimator, EstimatorError, Measurements, UpdateReport};
use adslam_models::{Control, FeatureId};
use adslam_planning::{Decision, Planner, PlanningError, PlanningModel, Score, Situation};
use nalgebra::{Point3, Vector3};

/// All that an agent learns of a step.
#[derive(Clone, Copy, Debug)]
pub struct StepInput<'a> {
    /// u from the step before.
    pub control: &'a Control,
    /// What is known of each feature's motion from the step before, r_t t + r_d d, cm, world.
    pub feature_motion: &'a [Vector3<f64>],
    /// What was measured.
    pub measurements: Measurements<'a>,
}

/// A belief, the estimator that keeps it, and the planner that decides from it, if there is one.
pub struct Agent {
    estimator: Box<dyn Estimator>,
    belief: Belief,
    report: UpdateReport,
    planner: Option<(Box<dyn Planner>, Arc<PlanningModel>)>,
}

impl Agent {
    /// One that does not decide.
    #[must_use]
    pub fn new(estimator: Box<dyn Estimator>, belief: Belief) -> Self {
        Self {
            estimator,
            belief,
            report: UpdateReport::default(),
            planner: None,
        }
    }

    /// Has `planner` decide from now on, which knows of the world what is in `model`.
    pub fn set_planner(&mut self, planner: Box<dyn Planner>, model: Arc<PlanningModel>) {
        self.planner = Some((planner, model));
    }

    /// The control that the planner takes from here, with what is known of each feature's motion to the next step (cm,
    /// world); none without a planner. `time_is_up`, where given, is asked between actions.
    ///
    /// # Errors
    /// Whatever the planner cannot decide from.
    pub fn decide(
        &mut self,
        feature_motion: &[Vector3<f64>],
        time_is_up: Option<&(dyn Fn() -> bool + Sync)>,
    ) -> Result<Option<Decision>, PlanningError> {
        let Some((planner, model)) = &mut self.planner else {
            return Ok(None);
        };
        let situation = Situation {
            belief: &self.belief,
            feature_motion,
            model,
            time_is_up,
        };
        planner.decide(&situation).map(Some)
    }

    /// Algorithm 1: predicts over the control and takes in the measurements.
    ///
    /// # Errors
    /// As [`Estimator::predict`] and [`Estimator::update`]; the belief must then not be used further.
    pub fn step(&mut self, input: &StepInput<'_>) -> Result<&UpdateReport, EstimatorError> {
        let belief = &mut self.belief;
        self.estimator
            .predict(belief, input.control, input.feature_motion)?;
        self.report = self.estimator.update(belief, &input.measurements)?;
        Ok(&self.report)
    }

    /// What it believes.
    #[must_use]
    pub fn belief(&self) -> &Belief {
        &self.belief
    }

    /// What the measurements of the last step said about the filter; zeros before the first.
    #[must_use]
    pub fn report(&self) -> &UpdateReport {
        &self.report
    }

    /// The features whose measurements the gate kept out of the last step.
    #[must_use]
    pub fn rejected(&self) -> &[FeatureId] {
        self.estimator.rejected()
    }

    /// The estimator.
    #[must_use]
    pub fn estimator(&self) -> &dyn Estimator {
        &*self.estimator
    }

    /// The actions that were scored for the last decision; empty for planners that do not score.
    #[must_use]
    pub fn scores(&self) -> &[Score] {
        let planner = self.planner.as_ref();
        planner.map_or(&[], |(planner, _)| planner.scores())
    }

    /// The viewpoints that the planner visits, in order; empty for planners without any.
    #[must_use]
    pub fn viewpoints(&self) -> &[Point3<f64>] {
        let planner = self.planner.as_ref();
        planner.map_or(&[], |(planner, _)| planner.viewpoints())
    }
}
