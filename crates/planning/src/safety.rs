//! Which actions keep the robot off the object.

use adslam_models::{Control, Pose, predicted_pose};
use adslam_surface::Surface;

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
#[derive(Clone, Debug)]
pub struct SafeActions {
    candidates: Vec<Candidate>,
    admissible: usize,
    compromised: bool,
}

impl SafeActions {
    /// Tests every action. `now` and `after` are the surface of the estimated features before and
    /// after their known motion.
    ///
    /// Where the attitude is so far off that no action keeps the limits of roll and pitch, the
    /// limits are waived.
    ///
    /// # Errors
    /// [`PlanningError::NoActions`] if the set is empty.
    pub fn find(
        situation: &Situation<'_>,
        now: &Surface,
        after: &Surface,
    ) -> Result<Self, PlanningError> {
        let model = situation.model;
        let pose = situation.belief.state.pose;
        let all: Vec<Candidate> = model
            .actions
            .controls()
            .iter()
            .enumerate()
            .map(|(index, control)| Candidate {
                index,
                control: *control,
                pose: predicted_pose(&pose, control),
            })
            .collect();
        let within_limits: Vec<Candidate> = all
            .iter()
            .filter(|candidate| model.actions.admits(candidate.pose.orientation))
            .cloned()
            .collect();
        let admissible = within_limits.len();
        let considered = if admissible == 0 { all } else { within_limits };
        let is_safe = |candidate: &Candidate| {
            let end = &candidate.pose.position;
            after.signed_distance(end) > model.clearance
                && now.signed_distance(end) > model.clearance
                && !after.crosses(&pose.position, end)
                && !now.crosses(&pose.position, end)
        };
        let safe: Vec<Candidate> = considered
            .iter()
            .filter(|candidate| is_safe(candidate))
            .cloned()
            .collect();
        if !safe.is_empty() {
            return Ok(Self {
                candidates: safe,
                admissible,
                compromised: admissible == 0,
            });
        }
        let distance = |candidate: &Candidate| {
            let end = &candidate.pose.position;
            after.signed_distance(end).min(now.signed_distance(end))
        };
        // The first of equals, as everywhere.
        let best = considered
            .into_iter()
            .map(|candidate| (distance(&candidate), candidate))
            .reduce(|best, other| if other.0 > best.0 { other } else { best })
            .ok_or(PlanningError::NoActions)?;
        Ok(Self {
            candidates: vec![best.1],
            admissible,
            compromised: true,
        })
    }

    /// The actions to choose from, at least one, in the order of the action set.
    #[must_use]
    pub fn candidates(&self) -> &[Candidate] {
        &self.candidates
    }

    /// Whether the one candidate left is not safe.
    #[must_use]
    pub fn compromised(&self) -> bool {
        self.compromised
    }

    /// The record of choosing one of these.
    #[must_use]
    pub fn decision(&self, chosen: Control) -> Decision {
        Decision {
            admissible: self.admissible,
            safe: if self.compromised {
                0
            } else {
                self.candidates.len()
            },
            compromised: self.compromised,
            ..Decision::without_choice(chosen)
        }
    }
}
