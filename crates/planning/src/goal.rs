//! Going from viewpoint to viewpoint.

use nalgebra::Point3;

use crate::PlanningError;

/// The part of `reached_within` by which a robot has to come nearer than ever before for that to count.
const PROGRESS: f64 = 0.01;

/// The viewpoints in the order in which they are visited, over and over, and the one that is next.
#[derive(Clone, Debug, PartialEq)]
pub struct Goals {
    viewpoints: Vec<Point3<f64>>,
    current: usize,
    reached_within: f64,
    approach: Approach,
    /// Decisions without progress after which a viewpoint is given up.
    patience: usize,
    abandoned: Option<usize>,
}

/// How a robot comes nearer to a goal, seen once a decision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Approach {
    nearest: f64,
    tolerance: f64,
    stalled: usize,
}

impl Approach {
    /// Of a goal that counts as reached within `reached_within`, cm; nothing seen yet.
    #[must_use]
    pub fn new(reached_within: f64) -> Self {
        Self {
            nearest: f64::INFINITY,
            tolerance: PROGRESS * reached_within,
            stalled: 0,
        }
    }

    /// Sees the robot at this distance from the goal, cm, and says in how many decisions in a row it has not come
    /// nearer than it was before, by more than a hundredth of what counts as reached.
    pub fn see(&mut self, distance: f64) -> usize {
        if distance < self.nearest - self.tolerance {
            self.nearest = distance;
            self.stalled = 0;
        } else {
            self.stalled += 1;
        }
        self.stalled
    }
}

impl Goals {
    /// Starts with the first viewpoint. One counts as reached when the estimated position is nearer
    /// than `reached_within`, cm. None is given up, unless [`Goals::giving_up_after`] says so.
    ///
    /// # Errors
    /// [`PlanningError::NoViewpoints`] if there are none.
    pub fn new(viewpoints: Vec<Point3<f64>>, reached_within: f64) -> Result<Self, PlanningError> {
        if viewpoints.is_empty() {
            return Err(PlanningError::NoViewpoints { candidates: 0 });
        }
        Ok(Self {
            viewpoints,
            current: 0,
            reached_within,
            approach: Approach::new(reached_within),
            patience: usize::MAX,
            abandoned: None,
        })
    }

    /// The same, but a viewpoint is given up for the next one after so many `steps`, at least one, in which the
    /// robot has come no nearer to it, see [`Approach::see`].
    #[must_use]
    pub fn giving_up_after(self, steps: usize) -> Self {
        Self {
            patience: steps.max(1),
            ..self
        }
    }

    /// All of them, in order.
    #[must_use]
    pub fn viewpoints(&self) -> &[Point3<f64>] {
        &self.viewpoints
    }

    /// The goal for a robot estimated to be at `position`: the current viewpoint, or the next one if
    /// that has been reached or is given up; after the last comes the first.
    pub fn next_from(&mut self, position: &Point3<f64>) -> (usize, Point3<f64>) {
        self.abandoned = None;
        let distance = self.distance(position);
        let is_reached = distance < self.reached_within;
        if !is_reached && self.approach.see(distance) >= self.patience {
            self.abandoned = Some(self.current);
        }
        if is_reached || self.abandoned.is_some() {
            self.current = (self.current + 1) % self.viewpoints.len();
            self.approach = Approach::new(self.reached_within);
            self.approach.see(self.distance(position));
        }
        (self.current, self.viewpoints[self.current])
    }

    /// The viewpoint that was given up at the latest [`Goals::next_from`], with its place in the path.
    #[must_use]
    pub fn abandoned(&self) -> Option<(usize, Point3<f64>)> {
        self.abandoned.map(|place| (place, self.viewpoints[place]))
    }

    fn distance(&self, position: &Point3<f64>) -> f64 {
        (self.viewpoints[self.current] - position).norm()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64) -> Point3<f64> {
        Point3::new(x, 0.0, 0.0)
    }

    #[test]
    fn goals_are_visited_in_a_ring() {
        let mut goals = Goals::new(vec![at(0.0), at(1.0)], 0.3).unwrap();
        assert_eq!(goals.next_from(&at(0.5)), (0, at(0.0)));
        assert_eq!(
            goals.next_from(&at(0.3)),
            (0, at(0.0)),
            "within, not at, the radius"
        );
        assert_eq!(goals.next_from(&at(0.29)), (1, at(1.0)));
        assert_eq!(goals.next_from(&at(0.0)), (1, at(1.0)));
        assert_eq!(goals.next_from(&at(1.1)), (0, at(0.0)));
        assert!(Goals::new(vec![], 0.3).is_err());
    }

    #[test]
    fn a_goal_that_is_not_come_nearer_to_is_given_up_for_the_next() {
        let goals = Goals::new(vec![at(0.0), at(10.0)], 0.1).unwrap();
        let mut goals = goals.giving_up_after(3);
        let mut go = |x: f64| {
            let (place, _) = goals.next_from(&at(x));
            (place, goals.abandoned())
        };
        for x in [5.0, 4.0, 4.5] {
            assert_eq!(go(x), (0, None));
        }
        // Nearer, but by less than a hundredth of 0.1.
        assert_eq!(go(3.9995), (0, None));
        // Nearer at last, so the count starts anew.
        for x in [3.9, 4.0, 3.9] {
            assert_eq!(go(x), (0, None));
        }
        assert_eq!(
            go(3.9),
            (1, Some((0, at(0.0)))),
            "the third without progress"
        );
        for x in [3.9, 3.9] {
            assert_eq!(go(x), (1, None), "the next one has its own three");
        }
        assert_eq!(go(3.9), (0, Some((1, at(10.0)))));
        assert_eq!(go(0.05), (1, None), "reached is not given up");
    }

    #[test]
    fn what_comes_nearer_by_just_a_hundredth_stalls() {
        let mut approach = Approach::new(100.0);
        assert_eq!(
            [5.0, 4.0, 3.75].map(|distance| approach.see(distance)),
            [0, 1, 0]
        );
    }

    #[test]
    fn no_goal_is_given_up_unless_asked_for() {
        let mut goals = Goals::new(vec![at(0.0), at(1.0)], 0.1).unwrap();
        assert!((0..1000).all(|_| goals.next_from(&at(0.5)).0 == 0 && goals.abandoned().is_none()));
    }
}
