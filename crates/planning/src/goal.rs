//! Going from viewpoint to viewpoint.

use nalgebra::Point3;

use crate::PlanningError;

/// The viewpoints in the order in which they are visited, over and over, and the one that is next.
#[derive(Clone, Debug, PartialEq)]
pub struct Goals {
    viewpoints: Vec<Point3<f64>>,
    current: usize,
    reached_within: f64,
}

impl Goals {
    /// Starts with the first viewpoint. One counts as reached when the estimated position is nearer
    /// than `reached_within`, cm.
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
        })
    }

    /// All of them, in order.
    #[must_use]
    pub fn viewpoints(&self) -> &[Point3<f64>] {
        &self.viewpoints
    }

    /// The goal for a robot estimated to be at `position`: the current viewpoint, or the next one if
    /// that has been reached; after the last comes the first.
    pub fn next_from(&mut self, position: &Point3<f64>) -> (usize, Point3<f64>) {
        if (self.viewpoints[self.current] - position).norm() < self.reached_within {
            self.current = (self.current + 1) % self.viewpoints.len();
        }
        (self.current, self.viewpoints[self.current])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn goals_are_visited_in_a_ring() {
        let at = |x: f64| Point3::new(x, 0.0, 0.0);
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
}
