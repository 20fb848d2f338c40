//! The trait that every planner implements.

use adslam_estimator::Belief;
use adslam_models::{Control, Pose};
use nalgebra::{Point3, Vector3};

use crate::{PlanningError, PlanningModel};

/// What is known when the robot has to choose its next control.
#[derive(Clone, Copy)]
pub struct Situation<'a> {
    /// The belief at step n.
    pub belief: &'a Belief,
    /// What is known of each feature's motion from step n to n + 1, cm, world.
    pub feature_motion: &'a [Vector3<f64>],
    /// The robot, its sensor and the object.
    pub model: &'a PlanningModel,
    /// Whether the time for the decision is up; asked between actions, absent where time does not
    /// matter. Planners have no clock of their own.
    pub time_is_up: Option<&'a (dyn Fn() -> bool + Sync)>,
}

impl Situation<'_> {
    /// Whether the time for the decision is up.
    pub(crate) fn is_late(&self) -> bool {
        self.time_is_up.is_some_and(|time_is_up| time_is_up())
    }
}

/// A chosen control and how it came about.
#[derive(Clone, Debug, PartialEq)]
pub struct Decision {
    /// The control to take.
    pub control: Control,
    /// The viewpoint that the robot is heading for, with its place in the path.
    pub goal: Option<(usize, Point3<f64>)>,
    /// Actions within the limits of roll and pitch; zero where the planner has no choice.
    pub admissible: usize,
    /// Of those, the safe ones.
    pub safe: usize,
    /// Actions for which the objective of eq. (6) was computed.
    pub scored: usize,
    /// trace(Pₙ₊₁) of the chosen action where it was computed, rad² + cm².
    pub predicted_trace: Option<f64>,
    /// Whether no action was safe within the limits of roll and pitch, see [`SafeActions`](crate::SafeActions).
    pub compromised: bool,
    /// Whether the control is predicted to lead beyond the limits of roll and pitch, as no action keeps
    /// them.
    pub limits_waived: bool,
    /// The viewpoint that was given up just before, with its place in the path, as the robot had come no nearer
    /// to it.
    pub abandoned: Option<(usize, Point3<f64>)>,
}

impl Decision {
    /// A control taken without choosing.
    #[must_use]
    pub fn without_choice(control: Control) -> Self {
        Self {
            control,
            goal: None,
            admissible: 0,
            safe: 0,
            scored: 0,
            predicted_trace: None,
            compromised: false,
            limits_waived: false,
            abandoned: None,
        }
    }
}

/// An action for which the objective was computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Score {
    /// Its place in the action set; none for staying, where the set has no such action.
    pub index: Option<usize>,
    /// The pose that it would lead to, without noise.
    pub pose: Pose,
    /// trace(Pₙ₊₁) after it, rad² + cm².
    pub trace: f64,
}

/// Chooses the control at each step. Deterministic: the same situations give the same decisions.
pub trait Planner: Send {
    /// The control to take from here.
    ///
    /// # Errors
    /// A belief that has broken down, or inputs that do not fit each other.
    fn decide(&mut self, situation: &Situation<'_>) -> Result<Decision, PlanningError>;

    /// The actions scored for the last decision, for those who watch; empty for planners that do not
    /// score.
    fn scores(&self) -> &[Score] {
        &[]
    }

    /// The viewpoints that the planner visits, in order; empty for planners without any.
    fn viewpoints(&self) -> &[Point3<f64>] {
        &[]
    }
}
