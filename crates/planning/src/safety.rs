//! Which actions keep the robot off the object.

use adslam_models::{Control, Pose, predicted_pose};
use adslam_surface::{Clearance, Surface};
use nalgebra::Point3;

use crate::{Decision, PlanningError, Situation};

/// An action and where it would lead.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// Its place in the action set, which breaks ties.
    pub index: usize,
    /// The control.
    pub control: Control,
    /// The predicted pose after it.
    pub pose: Pose,
}

/// The actions of a situation that are safe: they end farther than the clearance from the surface of
/// the estimated features, both as it is and as it will be, on its outside, and the straight
/// way there crosses neither. Where none is, the one that clears the surface by most.
///
/// Keeps its room from decision to decision.
#[derive(Clone, Debug, Default)]
pub struct SafeActions {
    candidates: Vec<Candidate>,
    safe: usize,
    admissible: usize,
    considered: Vec<Candidate>,
    clearance: Clearance,
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
            index,
            control: *control,
            pose: predicted_pose(&pose, control),
        };
        let all = model.actions.controls().iter().enumerate().map(predicted);
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
            let best = self
                .clears_by_most(now, after)
                .ok_or(PlanningError::NoActions)?;
            self.candidates.push(best);
        }
        Ok(())
    }

    /// The first of the actions whose end is farthest from the surfaces.
    fn clears_by_most(&self, now: &Surface, after: &Surface) -> Option<Candidate> {
        let distance = |candidate: &Candidate| {
            let end = &candidate.pose.position;
            after.signed_distance(end).min(now.signed_distance(end))
        };
        self.considered
            .iter()
            .map(|candidate| (distance(candidate), candidate))
            .reduce(|best, other| if other.0 > best.0 { other } else { best })
            .map(|(_, candidate)| candidate.clone())
    }

    /// Keeps the `count` candidates, at least one, that end nearest to `goal` (world, cm), those first
    /// that are nearest, eq. (9); of equals the first in the action set.
    pub fn keep_nearest(&mut self, goal: &Point3<f64>, count: usize) {
        let squared_distance = |c: &Candidate| (c.pose.position - goal).norm_squared();
        self.candidates.sort_unstable_by(|a, b| {
            squared_distance(a)
                .total_cmp(&squared_distance(b))
                .then(a.index.cmp(&b.index))
        });
        self.candidates.truncate(count.max(1));
    }

    /// The actions to choose from, at least one, in the order of the action set until
    /// [`SafeActions::keep_nearest`] sorts them.
    #[must_use]
    pub fn candidates(&self) -> &[Candidate] {
        &self.candidates
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

    /// The record of choosing one of these.
    #[must_use]
    pub fn decision(&self, chosen: Control) -> Decision {
        Decision {
            admissible: self.admissible,
            safe: self.safe,
            compromised: self.compromised(),
            ..Decision::without_choice(chosen)
        }
    }
}
