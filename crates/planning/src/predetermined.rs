//! The predetermined path: the comparison of Section IV that does not plan.

use adslam_models::Control;

use crate::{Decision, Planner, PlanningError, Situation};

/// Takes the same control at every step, whatever is there.
#[derive(Clone, Copy, Debug)]
pub struct PredeterminedPlanner {
    control: Control,
}

impl PredeterminedPlanner {
    /// A path of this control at every step.
    #[must_use]
    pub const fn new(control: Control) -> Self {
        Self { control }
    }
}

impl Planner for PredeterminedPlanner {
    fn decide(&mut self, _: &Situation<'_>) -> Result<Decision, PlanningError> {
        Ok(Decision::without_choice(self.control))
    }
}
