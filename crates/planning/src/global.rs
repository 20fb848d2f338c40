//! The global planner, Section III-C.

use nalgebra::Point3;

use crate::{Decision, Goals, ObjectSurfaces, Planner, PlanningError, SafeActions, Situation};

/// Takes the safe action that ends nearest to the current viewpoint, eq. (9).
#[derive(Clone, Debug)]
pub struct GlobalPlanner {
    goals: Goals,
    surfaces: ObjectSurfaces,
    safe: SafeActions,
}

impl GlobalPlanner {
    /// A planner that visits these viewpoints.
    #[must_use]
    pub fn new(goals: Goals) -> Self {
        Self {
            goals,
            surfaces: ObjectSurfaces::default(),
            safe: SafeActions::default(),
        }
    }
}

impl Planner for GlobalPlanner {
    fn decide(&mut self, situation: &Situation<'_>) -> Result<Decision, PlanningError> {
        let goal = self.goals.next_from(&situation.belief.state.pose.position);
        self.safe.find(situation, self.surfaces.place(situation)?)?;
        self.safe.keep_nearest(&goal.1, 1);
        let chosen = self.safe.candidates().first();
        let chosen = chosen.ok_or(PlanningError::NoActions)?;
        Ok(Decision {
            goal: Some(goal),
            abandoned: self.goals.abandoned(),
            ..self.safe.decision(situation, chosen)
        })
    }

    fn viewpoints(&self) -> &[Point3<f64>] {
        self.goals.viewpoints()
    }
}
