//! The rule that the local planner applies to all safe actions and the combined one to those near the
//! goal.

use crate::{
    ActionScorer, Candidate, Decision, ObjectSurfaces, PlanningError, PlanningNoise, SafeActions,
    Score, Situation, VisibleSets,
};

/// Takes the candidate with the smallest trace; keeps all room between decisions.
#[derive(Clone, Debug, Default)]
pub(crate) struct TraceChoice {
    surfaces: ObjectSurfaces,
    safe: SafeActions,
    sets: VisibleSets,
    scorer: ActionScorer,
}

impl TraceChoice {
    pub(crate) fn new(noise: PlanningNoise) -> Self {
        Self {
            scorer: ActionScorer::new(noise),
            ..Self::default()
        }
    }

    /// The safe action with the smallest trace among those that `narrow` leaves.
    pub(crate) fn decide(
        &mut self,
        situation: &Situation<'_>,
        narrow: impl FnOnce(&mut SafeActions),
    ) -> Result<Decision, PlanningError> {
        let Self {
            surfaces,
            safe,
            sets,
            scorer,
        } = self;
        let [now, after] = surfaces.place(situation)?;
        safe.find(situation, [now, after])?;
        narrow(safe);
        let model = situation.model;
        sets.find(safe.candidates(), &model.actions, &model.sensor, after);
        let best = scorer
            .best(situation, safe.candidates(), sets)?
            .ok_or(PlanningError::NoActions)?;
        let is_best = |candidate: &&Candidate| candidate.index == best.index;
        let chosen = safe.candidates().iter().find(is_best);
        let chosen = chosen.ok_or(PlanningError::NoActions)?;
        Ok(Decision {
            scored: scorer.scores().len(),
            predicted_trace: Some(best.trace),
            ..safe.decision(situation, chosen)
        })
    }

    pub(crate) fn scores(&self) -> &[Score] {
        self.scorer.scores()
    }
}
