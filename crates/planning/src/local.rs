//! The local planner, Section III-B.

use crate::trace_choice::TraceChoice;
use crate::{Decision, Planner, PlanningError, PlanningNoise, Score, Situation};

/// Takes the safe action with the smallest trace of the next covariance, eqs. (6), (7).
#[derive(Clone, Debug, Default)]
pub struct LocalPlanner {
    choice: TraceChoice,
}

impl LocalPlanner {
    /// A planner that assumes this noise.
    #[must_use]
    pub fn new(noise: PlanningNoise) -> Self {
        Self {
            choice: TraceChoice::new(noise),
        }
    }
}

impl Planner for LocalPlanner {
    fn decide(&mut self, situation: &Situation<'_>) -> Result<Decision, PlanningError> {
        self.choice.decide(situation, |_| ())
    }

    fn scores(&self) -> &[Score] {
        self.choice.scores()
    }
}
