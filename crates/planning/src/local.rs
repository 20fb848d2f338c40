//! The local planner, Section III-B.

use adslam_surface::Surface;

use crate::scoring::ActionScorer;
use crate::{
    Candidate, Decision, Planner, PlanningError, PlanningNoise, SafeActions, Score, Situation,
};

/// Takes the safe action with the smallest trace of the next covariance, eqs. (6), (7).
#[derive(Clone, Debug, Default)]
pub struct LocalPlanner {
    scorer: ActionScorer,
}

impl LocalPlanner {
    /// A planner that assumes this noise.
    #[must_use]
    pub fn new(noise: PlanningNoise) -> Self {
        Self {
            scorer: ActionScorer::new(noise),
        }
    }
}

impl Planner for LocalPlanner {
    fn decide(&mut self, situation: &Situation<'_>) -> Result<Decision, PlanningError> {
        let (now, after) = situation.surfaces()?;
        let safe = SafeActions::find(situation, &now, &after)?;
        let all: Vec<&Candidate> = safe.candidates().iter().collect();
        decide_by_trace(situation, &after, &safe, &all, &mut self.scorer)
    }

    fn scores(&self) -> &[Score] {
        self.scorer.scores()
    }
}

/// The candidate with the smallest trace, as a decision: the rule that the local planner
/// applies to all safe actions and the combined one to those near the goal.
pub(crate) fn decide_by_trace(
    situation: &Situation<'_>,
    after: &Surface,
    safe: &SafeActions,
    candidates: &[&Candidate],
    scorer: &mut ActionScorer,
) -> Result<Decision, PlanningError> {
    let best = scorer
        .best(situation, after, candidates)?
        .ok_or(PlanningError::NoActions)?;
    let control = situation.model.actions.controls()[best.index];
    Ok(Decision {
        scored: scorer.scores().len(),
        predicted_trace: Some(best.trace),
        ..safe.decision(control)
    })
}
