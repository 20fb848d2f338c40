//! The candidates for viewpoints.

use nalgebra::Point3;

use crate::PlanningError;

/// Points at equal spacing in a box, without those in a block where the object is (its boundary
/// belongs to it): 𝒢_cand of Algorithm 2.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewpointGrid {
    /// Lowest corner, itself a candidate, cm.
    pub min: Point3<f64>,
    /// Highest corner, cm.
    pub max: Point3<f64>,
    /// Distance between neighbours along each axis, cm.
    pub spacing: f64,
    /// Lowest and highest corner of the block left out, cm.
    pub excluded: Option<(Point3<f64>, Point3<f64>)>,
}

impl ViewpointGrid {
    /// The largest number of points that a grid may have.
    pub const LIMIT: usize = 1_000_000;

    /// All candidates, x slowest and z fastest.
    ///
    /// # Errors
    /// [`PlanningError::TooManyViewpoints`] beyond [`Self::LIMIT`].
    pub fn candidates(&self) -> Result<Vec<Point3<f64>>, PlanningError> {
        let axes = [0, 1, 2].map(|k| self.coordinates(k));
        let count = axes.iter().try_fold(1usize, |product, axis| {
            let length = axis.as_ref()?.len();
            product.checked_mul(length).filter(|&n| n <= Self::LIMIT)
        });
        let (Some(_), [Some(xs), Some(ys), Some(zs)]) = (count, axes) else {
            return Err(PlanningError::TooManyViewpoints { limit: Self::LIMIT });
        };
        let mut points = Vec::new();
        for &x in &xs {
            for &y in &ys {
                for &z in &zs {
                    let p = Point3::new(x, y, z);
                    if !self.excludes(&p) {
                        points.push(p);
                    }
                }
            }
        }
        Ok(points)
    }

    /// The coordinates along one axis; nothing if there are too many.
    fn coordinates(&self, axis: usize) -> Option<Vec<f64>> {
        let (low, high) = (self.min[axis], self.max[axis]);
        // A whole number of spacings must not be lost to rounding.
        let steps = ((high - low) / self.spacing + 1e-9).floor();
        let in_bounds = steps >= 0.0 && steps < Self::LIMIT as f64;
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "checked just above"
        )]
        in_bounds.then(|| {
            (0..=steps as usize)
                .map(|i| low + i as f64 * self.spacing)
                .collect()
        })
    }

    fn excludes(&self, p: &Point3<f64>) -> bool {
        self.excluded
            .as_ref()
            .is_some_and(|(low, high)| (0..3).all(|k| low[k] <= p[k] && p[k] <= high[k]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(min: [f64; 3], max: [f64; 3], spacing: f64, block: [[f64; 3]; 2]) -> ViewpointGrid {
        let excluded = Some((block[0].into(), block[1].into()));
        ViewpointGrid {
            min: min.into(),
            max: max.into(),
            spacing,
            excluded,
        }
    }

    #[test]
    fn the_papers_grids() {
        let polygon = grid(
            [-1.5, -3.0, -2.0],
            [4.5, 3.0, 6.0],
            1.0,
            [[0.5, -1.0, 0.0], [2.5, 1.0, 4.0]],
        );
        assert_eq!(polygon.candidates().unwrap().len(), 396);
        let heart = grid(
            [-5.0, -15.0, -5.0],
            [25.0, 15.0, 20.0],
            5.0,
            [[0.0, -6.0, 0.0], [15.0, 6.0, 15.0]],
        );
        assert_eq!(heart.candidates().unwrap().len(), 246);
    }

    #[test]
    fn spacing_that_does_not_divide_and_grids_too_large() {
        let block = [[9.0; 3], [9.0; 3]];
        assert_eq!(
            grid([0.0; 3], [0.3, 0.0, 0.0], 0.1, block)
                .candidates()
                .unwrap()
                .len(),
            4
        );
        assert_eq!(
            grid([0.0; 3], [0.35, 0.0, 0.0], 0.1, block)
                .candidates()
                .unwrap()
                .len(),
            4
        );
        assert!(grid([0.0; 3], [1e9; 3], 1e-9, block).candidates().is_err());
        assert!(grid([0.0; 3], [999.0; 3], 1.0, block).candidates().is_err());
    }
}
