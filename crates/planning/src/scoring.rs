//! The objective of eqs. (6), (7) over candidates: what would be seen, and what it would leave.

use adslam_estimator::{FilterNoise, PosteriorTrace};
use adslam_models::FeatureId;
use adslam_surface::Surface;

use crate::viewpoint::features_seen_in_pose;
use crate::{Candidate, PlanningError, Situation};

/// What a planner assumes otherwise than the filter does.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlanningNoise {
    /// Sigma of a feature measurement, cm; the filter's where absent.
    pub feature_measurement_sigma: Option<f64>,
}

impl PlanningNoise {
    /// The filter's noise with what is set here in its place.
    #[must_use]
    pub fn over(&self, filter: &FilterNoise) -> FilterNoise {
        let sigma = self
            .feature_measurement_sigma
            .unwrap_or(filter.feature_measurement_sigma);
        FilterNoise {
            feature_measurement_sigma: sigma,
            ..*filter
        }
    }
}

/// Scores the candidates of one decision.
#[derive(Debug)]
pub struct ActionScorer<'a> {
    situation: &'a Situation<'a>,
    after: &'a Surface,
    objective: PosteriorTrace,
}

impl<'a> ActionScorer<'a> {
    /// Prepares the decision; `after` is the surface of the estimated features after their known
    /// motion.
    ///
    /// # Errors
    /// A belief that has broken down.
    pub fn new(
        situation: &'a Situation<'a>,
        noise: &PlanningNoise,
        after: &'a Surface,
    ) -> Result<Self, PlanningError> {
        let model = situation.model;
        let objective = PosteriorTrace::new(
            situation.belief,
            situation.feature_motion,
            &noise.over(&model.noise),
            model.measures_structure,
        )?;
        Ok(Self {
            situation,
            after,
            objective,
        })
    }

    /// The features that the robot expects to measure after the candidate.
    #[must_use]
    pub fn visible(&self, candidate: &Candidate) -> Vec<FeatureId> {
        features_seen_in_pose(&self.situation.model.sensor, &candidate.pose, self.after)
    }

    /// trace(Pₙ₊₁) after the candidate, rad² + cm².
    ///
    /// # Errors
    /// A belief that has broken down.
    pub fn score(&self, candidate: &Candidate) -> Result<f64, PlanningError> {
        Ok(self
            .objective
            .after(&candidate.control, &self.visible(candidate))?)
    }
}
