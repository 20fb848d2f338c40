use super::*;
use nalgebra::Rotation3;

fn turned(variances: Vector3<f64>) -> Matrix3<f64> {
    let rotation = Rotation3::from_euler_angles(0.3, -0.7, 1.1);
    rotation.matrix() * Matrix3::from_diagonal(&variances) * rotation.matrix().transpose()
}

fn sighting(feature: usize, noise: Matrix3<f64>) -> Sighting {
    let pose = Pose::from_vector(&Vector6::new(0.1, 0.4, -0.3, 1.0, 2.0, 3.0));
    let point = Point3::new(4.0 + feature as f64, -3.0, 5.0);
    Sighting::new(&pose, FeatureId(feature), &point, noise, None)
}

#[test]
fn the_smallest_noise_is_that_of_the_best_axis_however_it_lies() {
    let variances = Vector3::new(3.0, 0.5, 2.0);
    for noise in [Matrix3::from_diagonal(&variances), turned(variances)] {
        assert!((sighting(0, noise).smallest_noise() - 0.5).abs() < 1e-12);
    }
}

/// maxⱼ (HᵀO⁻¹H)ⱼⱼ Pⱼⱼ, where the pose is what becomes known, and where a feature is.
#[test]
fn the_gain_is_the_largest_information_times_variance() {
    let (count, sigma) = (2, 0.2);
    let noise = Matrix3::identity() * (sigma * sigma);
    let sightings = [sighting(0, noise), sighting(1, noise)];
    for feature_sigma in [0.01, 10.0] {
        for unsure in 0..POSE_DIM {
            let pose = Matrix6::from_fn(|i, j| match (i == j, i == unsure) {
                (true, true) => 4.0,
                (true, false) => 0.01,
                _ => 0.0,
            });
            let covariance = Covariance::initial(&pose, feature_sigma, count);
            let mut expected = 0.0_f64;
            for axis in 0..POSE_DIM {
                let information: f64 = sightings
                    .iter()
                    .map(|s| s.jacobian.pose.column(axis).norm_squared() / (sigma * sigma))
                    .sum();
                expected = expected.max(information * pose[(axis, axis)]);
            }
            expected = expected.max((feature_sigma / sigma).powi(2));
            let found = gain(&covariance, &sightings);
            assert!(
                (found - expected).abs() < 1e-9 * expected,
                "{found} {expected}"
            );
        }
    }
}
