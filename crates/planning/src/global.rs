//! The global planner, Section III-C.

use nalgebra::Point3;

use crate::goal::nearest_first;
use crate::{Decision, Goals, Planner, PlanningError, SafeActions, Situation};

/// Takes the safe action that ends nearest to the current viewpoint, eq. (9).
#[derive(Clone, Debug)]
pub struct GlobalPlanner {
    goals: Goals,
}

impl GlobalPlanner {
    /// A planner that visits these viewpoints.
    #[must_use]
    pub const fn new(goals: Goals) -> Self {
        Self { goals }
    }
}

impl Planner for GlobalPlanner {
    fn decide(&mut self, situation: &Situation<'_>) -> Result<Decision, PlanningError> {
        let goal = self.goals.next_from(&situation.belief.state.pose.position);
        let (now, after) = situation.surfaces()?;
        let safe = SafeActions::find(situation, &now, &after)?;
        let nearest = nearest_first(safe.candidates(), &goal.1);
        let chosen = nearest.first().ok_or(PlanningError::NoActions)?;
        Ok(Decision {
            goal: Some(goal),
            ..safe.decision(chosen.control)
        })
    }

    fn viewpoints(&self) -> &[Point3<f64>] {
        self.goals.viewpoints()
    }
}
