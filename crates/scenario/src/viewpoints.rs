//! `[viewpoints]`: the places that the global planner's path may lead through.

use nalgebra::Point3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::values::{List, Positive, Vec3};

/// Where viewpoints come from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Viewpoints {
    /// Chosen in each run from the candidates of a grid, Algorithm 2.
    Sampled(Grid),
    /// These, in this order, in every run.
    Fixed(Fixed),
}

/// Chosen in each run from the candidates of a grid, Algorithm 2; a block may be left out. So are candidates inside the
/// object, and those that a robot that keeps its clearance cannot come as near to as `planners.global.reached_within_cm`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("dependencies" = {
    "excluded_min_cm": ["excluded_max_cm"],
    "excluded_max_cm": ["excluded_min_cm"],
}))]
pub struct Grid {
    /// First candidate of the grid, the corner with the smallest coordinates (world frame, cm).
    pub min_cm: Vec3,
    /// The grid ends here; a candidate itself if it is a whole number of spacings away (world frame,
    /// cm).
    pub max_cm: Vec3,
    /// Distance of neighbouring candidates along each axis; at most 100 000 of them (cm).
    pub spacing_cm: Positive,
    /// Smallest coordinates of a block whose candidates, its faces included, are left out; needs
    /// `excluded_max_cm` (world frame, cm). Default: no block.
    pub excluded_min_cm: Option<Vec3>,
    /// Largest coordinates of that block; needs `excluded_min_cm` (world frame, cm). Default: no
    /// block.
    pub excluded_max_cm: Option<Vec3>,
}

/// The same in every run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fixed {
    /// The viewpoints in the order in which they are visited (world frame, cm). They have to be outside the object; of
    /// those that cannot be reached for the robot's clearance there is a warning.
    pub positions_cm: List<Vec3>,
}

/// Part of a spacing by which a coordinate may miss the grid's end or the block's face: rounding.
const SLACK: f64 = 1e-9;

impl Grid {
    /// Candidates along each axis, block included.
    fn counts(&self) -> [f64; 3] {
        let cells = (*self.max_cm - *self.min_cm) / *self.spacing_cm;
        cells
            .map(|cells| {
                if cells < 0.0 {
                    0.0
                } else {
                    (cells + SLACK).floor() + 1.0
                }
            })
            .into()
    }

    /// How many candidates the grid has, block included.
    pub(super) fn size(&self) -> f64 {
        self.counts().iter().product()
    }

    /// The candidates: the points of the grid outside the block, z running fastest, x slowest.
    pub fn candidates(&self) -> Vec<Point3<f64>> {
        let [nx, ny, nz] = self.counts();
        let axis = |count: f64| (0_u32..).map(f64::from).take_while(move |i| *i < count);
        let mut candidates = Vec::new();
        for x in axis(nx) {
            for y in axis(ny) {
                for z in axis(nz) {
                    let steps = nalgebra::Vector3::new(x, y, z);
                    let point = self.min_cm.point() + steps * *self.spacing_cm;
                    if !self.excludes(&point) {
                        candidates.push(point);
                    }
                }
            }
        }
        candidates
    }

    fn excludes(&self, point: &Point3<f64>) -> bool {
        let (Some(min), Some(max)) = (self.excluded_min_cm, self.excluded_max_cm) else {
            return false;
        };
        let slack = SLACK * *self.spacing_cm;
        (0..3).all(|i| (min[i] - slack..=max[i] + slack).contains(&point[i]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(min: [f64; 3], max: [f64; 3], spacing: f64) -> Grid {
        Grid {
            min_cm: Vec3::new(min).unwrap(),
            max_cm: Vec3::new(max).unwrap(),
            spacing_cm: Positive::new(spacing).unwrap(),
            excluded_min_cm: None,
            excluded_max_cm: None,
        }
    }

    #[test]
    fn both_ends_belong_to_the_grid_whatever_the_rounding() {
        assert_eq!(grid([0.0; 3], [0.3, 0.0, 0.0], 0.1).candidates().len(), 4);
        assert_eq!(grid([0.0; 3], [0.35, 0.0, 0.0], 0.1).candidates().len(), 4);
        assert_eq!(
            grid([0.0; 3], [0.0; 3], 0.1).candidates(),
            [Point3::origin()]
        );
    }

    #[test]
    fn the_block_takes_its_faces_with_it() {
        let mut grid = grid([0.0; 3], [2.0; 3], 1.0);
        grid.excluded_min_cm = Some(Vec3::new([1.0, 0.0, 0.0]).unwrap());
        grid.excluded_max_cm = Some(Vec3::new([2.0, 2.0, 2.0]).unwrap());
        let candidates = grid.candidates();
        assert_eq!(candidates.len(), 9);
        assert!(candidates.iter().all(|point| point.x == 0.0));
    }

    #[test]
    fn no_grid_is_empty_without_a_panic() {
        assert_eq!(grid([1.0; 3], [0.0; 3], 1.0).size(), 0.0);
        assert!(grid([1.0; 3], [0.0; 3], 1.0).candidates().is_empty());
    }
}
