//! The local planner, Section III-B.

use adslam_surface::Surface;

use crate::{
    ActionScorer, Candidate, Decision, Planner, PlanningError, PlanningNoise, SafeActions, Score,
    Situation,
};

/// Takes the safe action with the smallest trace of the next covariance, eqs. (6), (7).
#[derive(Clone, Debug, Default)]
pub struct LocalPlanner {
    noise: PlanningNoise,
    scores: Vec<Score>,
}

impl LocalPlanner {
    /// A planner that assumes this noise.
    #[must_use]
    pub const fn new(noise: PlanningNoise) -> Self {
        Self {
            noise,
            scores: Vec::new(),
        }
    }
}

impl Planner for LocalPlanner {
    fn decide(&mut self, situation: &Situation<'_>) -> Result<Decision, PlanningError> {
        let (now, after) = situation.surfaces()?;
        let safe = SafeActions::find(situation, &now, &after)?;
        let all = safe.candidates();
        decide_by_trace(situation, &self.noise, &after, &safe, all, &mut self.scores)
    }

    fn scores(&self) -> &[Score] {
        &self.scores
    }
}

/// The candidate with the smallest trace, as a decision: the rule that the local planner
/// applies to all safe actions and the combined one to those near the goal.
pub(crate) fn decide_by_trace<'c>(
    situation: &Situation<'_>,
    noise: &PlanningNoise,
    after: &Surface,
    safe: &SafeActions,
    candidates: impl IntoIterator<Item = &'c Candidate>,
    scores: &mut Vec<Score>,
) -> Result<Decision, PlanningError> {
    let scorer = ActionScorer::new(situation, noise, after)?;
    scores.clear();
    let mut best: Option<(&Candidate, f64)> = None;
    for candidate in candidates {
        let Candidate { index, pose, .. } = *candidate;
        let trace = scorer.score(candidate)?;
        scores.push(Score { index, pose, trace });
        let better = best.is_none_or(|(leader, smallest)| {
            // The first in the action set among equals.
            (trace, index) < (smallest, leader.index)
        });
        if better {
            best = Some((candidate, trace));
        }
    }
    let (chosen, trace) = best.ok_or(PlanningError::NoActions)?;
    Ok(Decision {
        scored: scores.len(),
        predicted_trace: Some(trace),
        ..safe.decision(chosen)
    })
}
