//! The local planner, Section III-B.

use adslam_surface::Surface;

use crate::{
    ActionScorer, Decision, Planner, PlanningError, PlanningNoise, SafeActions, Situation,
};

/// Takes the safe action with the smallest trace of the next covariance, eqs. (6), (7).
#[derive(Clone, Copy, Debug, Default)]
pub struct LocalPlanner {
    noise: PlanningNoise,
}

impl LocalPlanner {
    /// A planner that assumes this noise.
    #[must_use]
    pub const fn new(noise: PlanningNoise) -> Self {
        Self { noise }
    }
}

impl Planner for LocalPlanner {
    fn decide(&mut self, situation: &Situation<'_>) -> Result<Decision, PlanningError> {
        let (now, after) = situation.surfaces()?;
        let safe = SafeActions::find(situation, &now, &after)?;
        decide_by_trace(situation, &self.noise, &after, &safe, safe.candidates())
    }
}

/// The candidate with the smallest trace, as a decision: the rule that the local planner
/// applies to all safe actions and the combined one to those near the goal.
pub(crate) fn decide_by_trace<'c>(
    situation: &Situation<'_>,
    noise: &PlanningNoise,
    after: &Surface,
    safe: &SafeActions,
    candidates: impl IntoIterator<Item = &'c crate::Candidate, IntoIter: ExactSizeIterator>,
) -> Result<Decision, PlanningError> {
    let candidates = candidates.into_iter();
    let scored = candidates.len();
    let scorer = ActionScorer::new(situation, noise, after)?;
    let (chosen, trace) = scorer.best(candidates)?.ok_or(PlanningError::NoActions)?;
    Ok(Decision {
        scored,
        predicted_trace: Some(trace),
        ..safe.decision(chosen)
    })
}
