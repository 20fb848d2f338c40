//! The set U of candidate actions.

use std::collections::HashMap;

use adslam_models::{Control, EulerAngles};
use nalgebra::Vector3;

/// The control that changes nothing.
const STAYING: Control = Control {
    rotation: Vector3::new(0.0, 0.0, 0.0),
    translation: Vector3::new(0.0, 0.0, 0.0),
};

/// The controls that the robot may choose from, and the attitudes that it must keep.
#[derive(Clone, Debug, PartialEq)]
pub struct ActionSet {
    controls: Vec<Control>,
    max_roll: f64,
    max_pitch: f64,
    /// For each action which of the distinct translations it has.
    positions: Vec<usize>,
    position_count: usize,
    /// The action that changes nothing, where there is one.
    staying: Option<usize>,
}

impl ActionSet {
    /// Every combination of the increments `roll`, `pitch` and `yaw`, radians, with the
    /// translations v = R(Ω) (dx, 0, dz), cm: the robot moves in the plane that it will face.
    ///
    /// The order, which breaks ties, is that of nested loops with roll outermost and dz innermost. An
    /// action is admissible while the predicted |roll| ≤ `max_roll` and |pitch| ≤ `max_pitch`, radians.
    #[must_use]
    pub fn grid(
        [roll, pitch, yaw]: [&[f64]; 3],
        [dx, dz]: [&[f64]; 2],
        max_roll: f64,
        max_pitch: f64,
    ) -> Self {
        let mut controls = Vec::new();
        for &roll in roll {
            for &pitch in pitch {
                for &yaw in yaw {
                    let angles = EulerAngles::new(roll, pitch, yaw);
                    let rotation = angles.rotation();
                    for &dx in dx {
                        for &dz in dz {
                            controls.push(Control {
                                rotation: angles.to_vector(),
                                translation: rotation * Vector3::new(dx, 0.0, dz),
                            });
                        }
                    }
                }
            }
        }
        let (positions, position_count) = distinct_translations(&controls);
        let staying = controls.iter().position(|control| *control == STAYING);
        Self {
            controls,
            max_roll,
            max_pitch,
            positions,
            position_count,
            staying,
        }
    }

    /// Staying where one is, which a robot always can, and its place in the set if it is there.
    #[must_use]
    pub fn staying(&self) -> (Option<usize>, Control) {
        (self.staying, STAYING)
    }

    /// How many distinct positions the actions lead to.
    #[must_use]
    pub fn position_count(&self) -> usize {
        self.position_count
    }

    /// Which of them an action leads to: the same number for the same translation.
    ///
    /// # Panics
    /// If there is no such action.
    #[must_use]
    pub fn position_of(&self, action: usize) -> usize {
        self.positions[action]
    }

    /// All actions, in order.
    #[must_use]
    pub fn controls(&self) -> &[Control] {
        &self.controls
    }

    /// Whether an orientation is within the limits of roll and pitch.
    #[must_use]
    pub fn admits(&self, orientation: EulerAngles) -> bool {
        orientation.roll.abs() <= self.max_roll && orientation.pitch.abs() <= self.max_pitch
    }
}

/// Numbers the translations, the same number for the same vector, in the order of the actions; and how
/// many there are.
fn distinct_translations(controls: &[Control]) -> (Vec<usize>, usize) {
    let mut numbers = HashMap::new();
    let positions = controls
        .iter()
        .map(|control| {
            // Adding zero makes −0 and 0 the same.
            let key = control.translation.map(|x| (x + 0.0).to_bits());
            let next = numbers.len();
            *numbers.entry([key.x, key.y, key.z]).or_insert(next)
        })
        .collect();
    (positions, numbers.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn staying_is_found_where_the_set_has_it() {
        let (still, turned) = ([0.0], [0.0, 0.5]);
        let with = ActionSet::grid([&still, &still, &turned], [&[-0.1, 0.0], &still], 1.0, 1.0);
        assert_eq!(with.staying(), (Some(1), with.controls()[1]));
        let without = ActionSet::grid([&still, &still, &still], [&[-0.1, 0.1], &still], 1.0, 1.0);
        assert_eq!(without.staying(), (None, STAYING));
    }

    #[test]
    fn the_papers_set_has_675_actions() {
        let third = [-30f64, 0.0, 30.0].map(f64::to_radians);
        let yaw = [-45f64, -22.5, 0.0, 22.5, 45.0].map(f64::to_radians);
        let (dx, dz) = ([-0.2, -0.1, 0.0, 0.1, 0.2], [-0.5, 0.0, 0.5]);
        let limit = 30f64.to_radians();
        let actions = ActionSet::grid([&third, &third, &yaw], [&dx, &dz], limit, limit);
        assert_eq!(actions.controls().len(), 675);
        // The first as the public code computes it.
        let v = actions.controls()[0].translation;
        let expected = Vector3::new(-0.146_158_073_511_847_15, -0.207_395_317_081_426_58, -0.475);
        assert!((v - expected).norm() < 1e-15);
        assert!(actions.admits(EulerAngles::new(limit, -limit, 3.0)));
        assert!(!actions.admits(EulerAngles::new(limit + 1e-9, 0.0, 0.0)));
        assert!(!actions.admits(EulerAngles::new(0.0, -limit - 1e-9, 0.0)));
    }

    #[test]
    fn actions_that_lead_to_the_same_place_share_its_number() {
        let turn = [-0.5, 0.0, 0.5];
        // Without dz a roll changes nothing, and without dx nor dz nothing does.
        let actions = ActionSet::grid([&turn, &[0.0], &turn], [&[0.0, 0.4], &[0.0]], 1.0, 1.0);
        let numbers: Vec<usize> = (0..18).map(|action| actions.position_of(action)).collect();
        assert_eq!(numbers[..6], [0, 1, 0, 2, 0, 3]);
        assert_eq!(numbers[..6], numbers[6..12]);
        assert_eq!(numbers[..6], numbers[12..]);
        assert_eq!(actions.position_count(), 4);
    }

    #[test]
    fn zeros_of_either_sign_are_the_same_place() {
        let to = |x, y, z| Control {
            rotation: Vector3::zeros(),
            translation: Vector3::new(x, y, z),
        };
        let controls = [
            to(0.0, -0.0, 1.0),
            to(-0.0, 0.0, 1.0),
            to(0.0, 0.0, -1.0),
            to(0.0, 0.0, 1.0),
        ];
        assert_eq!(distinct_translations(&controls), (vec![0, 0, 1, 0], 2));
    }
}
