//! Viewpoints that a robot heads for in vain.

use adslam_names::numbers;
use adslam_planning::{Approach, Decision};
use nalgebra::Point3;

/// Decisions for the same viewpoint, one after the other up to the last, without coming nearer to it, that are worth a
/// warning.
const STALLED: usize = 20;

/// Watches how a robot comes nearer to its viewpoints.
#[derive(Clone, Debug, Default)]
pub(super) struct GoalWatch {
    reached_within: f64,
    /// The viewpoint that it is heading for, how it comes nearer, and in how many decisions it has not.
    heading: Option<(usize, Approach, usize)>,
    /// Places of those given up, the first time of each, and how often one was.
    abandoned: Vec<usize>,
    times: usize,
    first_step: usize,
}

impl GoalWatch {
    /// For a robot for which viewpoints count as reached within this distance, cm.
    pub(super) fn new(reached_within: f64) -> Self {
        Self {
            reached_within,
            heading: None,
            abandoned: Vec::new(),
            times: 0,
            first_step: 0,
        }
    }

    /// Looks at the decision at `step`, after which the robot is estimated to be at `position`.
    pub(super) fn decide(&mut self, step: usize, decision: &Decision, position: &Point3<f64>) {
        if let Some((place, _)) = decision.abandoned {
            self.heading = None;
            if self.times == 0 {
                self.first_step = step;
            }
            self.times += 1;
            if !self.abandoned.contains(&place) {
                self.abandoned.push(place);
            }
        }
        let Some((place, goal)) = decision.goal else {
            return;
        };
        let mut approach = match self.heading {
            Some((same, approach, _)) if same == place => approach,
            _ => Approach::new(self.reached_within),
        };
        let stalled = approach.see((goal - position).norm());
        self.heading = Some((place, approach, stalled));
    }

    /// What there is to say at the end.
    pub(super) fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        if self.times > 0 {
            warnings.push(format!(
                "viewpoints were given up, as the robot came no nearer to them ({} in all, the first at step {}; \
                 numbers {} of the path)",
                self.times,
                self.first_step,
                numbers(self.abandoned.iter().copied())
            ));
        }
        if let Some((place, _, stalled)) = self.heading.filter(|(.., stalled)| *stalled >= STALLED)
        {
            warnings.push(format!(
                "to the end the robot headed for a viewpoint without coming nearer to it (number {place} of the path, \
                 the last {stalled} decisions)"
            ));
        }
        warnings
    }
}

#[cfg(test)]
mod tests {
    use adslam_models::Control;

    use super::*;

    fn at(x: f64) -> Point3<f64> {
        Point3::new(x, 0.0, 0.0)
    }

    /// Decisions for viewpoint `place`, which lies at 0, at the given distances.
    fn head(watch: &mut GoalWatch, place: usize, abandoned: Option<usize>, distances: &[f64]) {
        for (step, &distance) in distances.iter().enumerate() {
            let decision = Decision {
                goal: Some((place, at(0.0))),
                abandoned: abandoned
                    .filter(|_| step == 0)
                    .map(|place| (place, at(1.0))),
                ..Decision::without_choice(Control::default())
            };
            watch.decide(step + 10, &decision, &at(distance));
        }
    }

    #[test]
    fn a_viewpoint_headed_for_in_vain_to_the_end_is_found_out() {
        let mut watch = GoalWatch::new(0.1);
        head(&mut watch, 3, None, &[2.0, 1.0]);
        head(&mut watch, 3, None, &[1.0; STALLED - 1]);
        assert!(watch.warnings().is_empty());
        head(&mut watch, 3, None, &[1.5]);
        let [warning] = &watch.warnings()[..] else {
            unreachable!("one warning")
        };
        assert!(
            warning.ends_with("(number 3 of the path, the last 20 decisions)"),
            "{warning}"
        );
        head(&mut watch, 3, None, &[0.5]);
        assert!(watch.warnings().is_empty(), "it has come nearer after all");
        head(&mut watch, 3, None, &[0.5; STALLED]);
        head(&mut watch, 4, None, &[1.0]);
        assert!(watch.warnings().is_empty(), "it has gone on to the next");
    }

    #[test]
    fn viewpoints_given_up_are_counted_and_each_named_once() {
        let mut watch = GoalWatch::new(0.1);
        for given_up in [None, Some(3), Some(4), Some(3)] {
            head(&mut watch, 7, given_up, &[1.0; 15]);
        }
        let warnings = watch.warnings();
        assert_eq!(
            warnings.len(),
            1,
            "giving up starts the count anew: {warnings:?}"
        );
        let end = "(3 in all, the first at step 10; numbers 3, 4 of the path)";
        assert!(warnings[0].ends_with(end), "{warnings:?}");
    }
}
