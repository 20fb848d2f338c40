//! The error that the noise alone must cost.

use crate::{DeformationNoise, WorldNoise};

/// The smallest error of the robot's position in the world that is to be expected once everything
/// moves.
///
/// All measurements are relative: they tell where robot and features are to each other, and the
/// world's origin is only remembered. Robot and features walk at random, and what they have walked
/// together nobody can see. So even an estimator that is told all orientations, every position
/// relative to the robot without error, and all motion but its noise, loses the origin step by step.
/// This is the error that it has left; that of a filter lies above it on average.
///
/// Of M features with equal noise only the mean matters, by symmetry, and each axis for itself. On
/// an axis the mean b̄ of their places without deformation walks with σ_t²/M a step, the robot x with
/// its own σ², and the sensor tells the difference of x and the mean feature, which is b̄ with fresh
/// noise of σ_d²/M. Deformation noise that accumulates is part of the walk, with (σ_t² + σ_d²)/M, and
/// the difference is exact. At the start x is known exactly, and the first estimate tells the features
/// with its own error. What remains is a Kalman filter of two states; where all accumulates and the
/// first estimate is exact it has Var(x) = (n − 1) q at step n, with 1/q = 1/σ² + M/(σ_t² + σ_d²).
///
/// From step 2 on any feature's error has the same floor, as it is told relative to the robot.
/// Where noise is truncated [`DriftFloor::sigma`] is that of the best linear estimator, and one that
/// makes use of the cut could have a smaller one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriftFloor {
    /// What each step adds to the variance of b̄, cm².
    feature_walk: f64,
    /// What each step adds to the variance of x, cm².
    robot_walk: f64,
    /// The variance of the fresh noise of the mean feature, cm².
    fresh: f64,
    /// The variance of b̄, its covariance with x, and the variance of x, cm².
    mean_feature: f64,
    shared: f64,
    robot: f64,
}

/// E|e| of an error with a Gaussian component of sigma 1 on each of three axes: √(8/π).
pub const MEAN_NORM_OF_UNIT_GAUSSIAN: f64 = 1.595_769_121_605_730_7;

impl DriftFloor {
    /// The floor at step 1 in a world with this noise and so many features: nothing.
    #[must_use]
    pub fn at_start(noise: &WorldNoise, features: usize) -> Self {
        let count = features.max(1) as f64;
        let variance = |sigma: f64| sigma.powi(2) * noise.variance_of_standard();
        let translation = variance(noise.feature_translation_sigma) / count;
        let deformation = variance(noise.feature_deformation_sigma) / count;
        let (walk, fresh) = match noise.deformation {
            DeformationNoise::Fresh => (translation, deformation),
            DeformationNoise::Accumulating => (translation + deformation, 0.0),
        };
        Self {
            feature_walk: walk,
            robot_walk: variance(noise.translation_sigma),
            fresh,
            // The first estimate is that of the features as they are shown, fresh noise included.
            mean_feature: variance(noise.initial_feature_sigma) / count + fresh,
            shared: 0.0,
            robot: 0.0,
        }
    }

    /// Goes on to the next step.
    pub fn advance(&mut self) {
        self.mean_feature += self.feature_walk;
        self.robot += self.robot_walk;
        // The mean feature relative to the robot: b̄ − x and fresh noise.
        let seen = self.mean_feature - 2.0 * self.shared + self.robot + self.fresh;
        if seen <= 0.0 {
            // Nothing has moved, or nothing is left to learn.
            return;
        }
        let of_feature = self.mean_feature - self.shared;
        let of_robot = self.shared - self.robot;
        self.mean_feature -= of_feature * of_feature / seen;
        self.shared -= of_feature * of_robot / seen;
        self.robot -= of_robot * of_robot / seen;
    }

    /// The standard deviation of the robot's position on each axis, cm.
    #[must_use]
    pub fn sigma(&self) -> f64 {
        self.robot.max(0.0).sqrt()
    }

    /// The expected distance of the estimated position from the true one, as if the error were
    /// Gaussian: where noise is truncated it is only nearly so. cm.
    #[must_use]
    pub fn expected_error(&self) -> f64 {
        MEAN_NORM_OF_UNIT_GAUSSIAN * self.sigma()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::NOISE;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    fn at_step(noise: &WorldNoise, features: usize, step: usize) -> DriftFloor {
        let mut floor = DriftFloor::at_start(noise, features);
        (1..step).for_each(|_| floor.advance());
        floor
    }

    #[test]
    fn where_all_accumulates_the_variance_grows_evenly() {
        let noise = WorldNoise {
            deformation: DeformationNoise::Accumulating,
            initial_feature_sigma: 0.0,
            ..NOISE
        };
        let q = 1.0 / (1.0 / 0.03f64.powi(2) + 14.0 / (0.03f64.powi(2) + 0.05f64.powi(2)));
        for n in [1, 2, 3, 10, 100, 1000] {
            let variance = at_step(&noise, 14, n).sigma().powi(2);
            assert_relative_eq!(variance, (n as f64 - 1.0) * q, max_relative = 1e-9);
        }
    }

    /// The mean of the Maxwell law of scale σ is 2σ√(2/π).
    #[test]
    fn the_expected_error_is_the_mean_distance_of_three_gaussians() {
        let floor = at_step(&NOISE, 14, 30);
        let mean = 2.0 * floor.sigma() * std::f64::consts::FRAC_2_PI.sqrt();
        assert_relative_eq!(floor.expected_error(), mean, max_relative = 1e-14);
        assert!(floor.sigma() > 0.0);
    }

    #[test]
    fn what_does_not_move_is_not_lost() {
        let still_robot = WorldNoise {
            translation_sigma: 0.0,
            ..NOISE
        };
        assert_eq!(at_step(&still_robot, 14, 50).expected_error(), 0.0);
        // The features hold still: the first estimate's error is weighed against the robot's first
        // step, and there is nothing more to learn.
        let still_features = WorldNoise {
            feature_translation_sigma: 0.0,
            feature_deformation_sigma: 0.0,
            ..NOISE
        };
        for n in [2, 500] {
            let variance = at_step(&still_features, 4, n).sigma().powi(2);
            let expected = 1.0 / (4.0 / 0.02f64.powi(2) + 1.0 / 0.03f64.powi(2));
            assert_relative_eq!(variance, expected, max_relative = 1e-9);
        }
        let nothing = WorldNoise {
            initial_feature_sigma: 0.0,
            ..still_features
        };
        assert_eq!(at_step(&nothing, 4, 50).expected_error(), 0.0);
        let none_at_all = WorldNoise {
            translation_sigma: 0.0,
            ..nothing
        };
        assert_eq!(at_step(&none_at_all, 4, 50).expected_error(), 0.0);
        assert_eq!(at_step(&none_at_all, 4, 50), at_step(&none_at_all, 4, 1));
    }

    #[test]
    fn truncated_noise_costs_less() {
        let truncated = WorldNoise {
            truncate_at_sigmas: Some(1.0),
            ..NOISE
        };
        let part = at_step(&truncated, 14, 30).sigma() / at_step(&NOISE, 14, 30).sigma();
        assert_relative_eq!(
            part.powi(2),
            truncated.variance_of_standard(),
            epsilon = 1e-12
        );
    }

    proptest! {
        /// Against a filter in information form, which shares no formula with the recursion.
        #[test]
        fn is_the_kalman_filter_of_mean_feature_and_robot(
            sigma in 0.01..0.1, sigma_t in 0.01..0.1, sigma_d in 0.01..0.1, first in 0.01..0.1,
            features in 1_usize..60, steps in 1_usize..40,
        ) {
            use nalgebra::{Matrix2, Vector2};
            let noise = WorldNoise {
                translation_sigma: sigma,
                feature_translation_sigma: sigma_t,
                feature_deformation_sigma: sigma_d,
                initial_feature_sigma: first,
                ..NOISE
            };
            let count = features as f64;
            let fresh = sigma_d * sigma_d / count;
            let walk = Matrix2::from_diagonal(&Vector2::new(sigma_t * sigma_t / count, sigma * sigma));
            let h = Vector2::new(1.0, -1.0);
            let mut p = Matrix2::from_diagonal(&Vector2::new(first * first / count + fresh, 0.0));
            for _ in 0..steps {
                let information = (p + walk).try_inverse().unwrap() + h * h.transpose() / fresh;
                p = information.try_inverse().unwrap();
            }
            let floor = at_step(&noise, features, steps + 1);
            prop_assert!((floor.sigma().powi(2) / p[(1, 1)] - 1.0).abs() < 1e-6);
        }

        #[test]
        fn never_shrinks_with_more_noise_and_is_a_number(
            sigma in 0.0..0.1, sigma_t in 0.0..0.1, sigma_d in 0.0..0.1, first in 0.0..0.1,
            more in 1.0..3.0, accumulates in any::<bool>(), steps in 1_usize..60,
        ) {
            let with = |factor: f64| WorldNoise {
                translation_sigma: factor * sigma,
                feature_translation_sigma: factor * sigma_t,
                feature_deformation_sigma: factor * sigma_d,
                initial_feature_sigma: factor * first,
                deformation: if accumulates { DeformationNoise::Accumulating } else { DeformationNoise::Fresh },
                ..NOISE
            };
            let (less, more) = (at_step(&with(1.0), 5, steps), at_step(&with(more), 5, steps));
            prop_assert!(less.expected_error().is_finite());
            prop_assert!(more.sigma() >= less.sigma() * (1.0 - 1e-9) - 1e-12);
        }
    }
}
