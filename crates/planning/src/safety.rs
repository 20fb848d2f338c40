//! Which actions keep the robot off the object.

use adslam_models::{Control, Pose, predicted_pose};
use adslam_surface::{Clearance, Surface};
use nalgebra::Point3;

use crate::fallback::Fallback;
use crate::{Decision, PlanningError, Situation, ties};

/// An action and where it would lead.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// Its place in the action set, which breaks ties; none for staying, where the set has no such action.
    pub index: Option<usize>,
    /// The control.
    pub control: Control,
    /// The predicted pose after it.
    pub pose: Pose,
}

/// The actions of a situation that are safe: they end farther than the clearance from the surface of
/// the estimated features, both as it is and as it will be, on its outside, and the straight
/// way there crosses neither.
///
/// Where none is, there is one candidate, a compromise: of the actions whose way crosses neither surface
/// the one that ends farthest from them. Staying counts among these always, also where the set has no such action and
/// whatever the attitude, which it makes no worse; so a robot outside the surface never goes through
/// it. Of a surface that the robot is inside of or on, before or after the motion, the way out may be crossed: then those
/// actions come first that end outside and, once outside, stay there; where there are none, the
/// one that ends least deep.
///
/// Keeps its room from decision to decision.
#[derive(Clone, Debug, Default)]
pub struct SafeActions {
    candidates: Vec<Candidate>,
    safe: usize,
    admissible: usize,
    considered: Vec<Candidate>,
    clearance: Clearance,
    fallback: Fallback,
}

impl SafeActions {
    /// Tests every action. `now` and `after` are the surface of the estimated features before and
    /// after their known motion.
    ///
    /// Where the attitude is so far off that no action keeps the limits of roll and pitch, the
    /// limits are waived, and all that is left counts as a compromise.
    ///
    /// # Errors
    /// [`PlanningError::NoActions`] if the set is empty.
    pub fn find(
        &mut self,
        situation: &Situation<'_>,
        [now, after]: [&Surface; 2],
    ) -> Result<(), PlanningError> {
        let model = situation.model;
        let pose = situation.belief.state.pose;
        let predicted = |(index, control): (usize, &Control)| Candidate {
            index: Some(index),
            control: *control,
            pose: predicted_pose(&pose, control),
        };
        let all = model.actions.controls().iter().enumerate().map(predicted);
        if model.actions.controls().is_empty() {
            return Err(PlanningError::NoActions);
        }
        let admitted = |candidate: &Candidate| model.actions.admits(candidate.pose.orientation);
        self.considered.clear();
        self.considered.extend(all.clone().filter(admitted));
        self.admissible = self.considered.len();
        if self.considered.is_empty() {
            self.considered.extend(all);
        }

        self.candidates.clear();
        self.candidates.extend_from_slice(&self.considered);
        for surface in [after, now] {
            let ends = self
                .candidates
                .iter()
                .map(|candidate| candidate.pose.position);
            let clear = self
                .clearance
                .clear_ways(surface, &pose.position, ends, model.clearance);
            for (to, &from) in clear.iter().enumerate() {
                self.candidates.swap(to, from);
            }
            self.candidates.truncate(clear.len());
        }
        let kept_limits = self.admissible > 0;
        self.safe = if kept_limits {
            self.candidates.len()
        } else {
            0
        };
        if self.candidates.is_empty() {
            let (index, control) = model.actions.staying();
            let staying = Candidate {
                index,
                control,
                pose,
            };
            let start = &pose.position;
            let best = self
                .fallback
                .choose(start, &self.considered, &staying, [now, after]);
            self.candidates.push(best.clone());
        }
        Ok(())
    }

    /// Keeps the `count` candidates, at least one, that end nearest to `goal` (world, cm), those first
    /// that are nearest, eq. (9); of equals, but for rounding, the first in the action set.
    pub fn keep_nearest(&mut self, goal: &Point3<f64>, count: usize) {
        let distance = |c: &Candidate| (c.pose.position - goal).norm();
        let order = |c: &Candidate| ties::order(c.index);
        ties::sort(&mut self.candidates, goal.coords.norm(), distance, order);
        self.candidates.truncate(count.max(1));
    }

    /// The actions to choose from, at least one, in the order of the action set until
    /// [`SafeActions::keep_nearest`] sorts them.
    #[must_use]
    pub fn candidates(&self) -> &[Candidate] {
        &self.candidates
    }

    /// Says of each action of the set, by its place there, whether it is safe; of none where all that is left is a
    /// compromise. As long as [`SafeActions::keep_nearest`] has left none out.
    pub fn mask(&self, safe: &mut [bool]) {
        safe.fill(false);
        let candidates = self.candidates.iter().take(self.safe);
        for place in candidates.filter_map(|candidate| candidate.index) {
            if let Some(safe) = safe.get_mut(place) {
                *safe = true;
            }
        }
    }

    /// How many actions are safe.
    #[must_use]
    pub fn safe(&self) -> usize {
        self.safe
    }

    /// Whether no action is safe within the limits of roll and pitch.
    #[must_use]
    pub fn compromised(&self) -> bool {
        self.safe == 0
    }

    /// The record of choosing one of these in the situation that they were found for.
    #[must_use]
    pub fn decision(&self, situation: &Situation<'_>, chosen: &Candidate) -> Decision {
        let actions = &situation.model.actions;
        Decision {
            admissible: self.admissible,
            safe: self.safe,
            compromised: self.compromised(),
            limits_waived: !actions.admits(chosen.pose.orientation),
            ..Decision::without_choice(chosen.control)
        }
    }
}
