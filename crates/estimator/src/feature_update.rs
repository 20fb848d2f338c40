//! The update with what the robot's sensor saw, eq. (10).

use adslam_models::{POSE_DIM, feature_measurement, feature_measurement_jacobians, feature_offset};
use faer::Mat;
use nalgebra::{Vector3, Vector6};

use crate::ekf::check_feature;
use crate::linear_algebra::{cholesky, solve_lower};
use crate::{Belief, EstimatorError, FeatureMeasurement};

/// Conditions the belief on the measurements, with H at the present state.
pub(crate) fn update_with_features(
    belief: &mut Belief,
    measurements: &[FeatureMeasurement],
    sigma: f64,
) -> Result<(), EstimatorError> {
    if measurements.is_empty() {
        return Ok(());
    }
    check_measurements(belief, measurements)?;
    let rows = 3 * measurements.len();
    let dim = belief.covariance.dim();
    let p = belief.covariance.matrix();
    let pose = belief.state.pose;

    // (HP)ᵀ and, as the column after the last, nothing: the innovation is kept apart.
    let mut ph = Mat::<f64>::zeros(dim, rows);
    let mut innovation = Mat::<f64>::zeros(rows, 1);
    let mut jacobians = Vec::with_capacity(measurements.len());
    for (m, measurement) in measurements.iter().enumerate() {
        let point = &belief.state.features[measurement.feature.0];
        let jacobian = feature_measurement_jacobians(&pose, point);
        let y = measurement.z - feature_measurement(&pose, point);
        let offset = feature_offset(measurement.feature);
        for a in 0..3 {
            innovation[(3 * m + a, 0)] = y[a];
            for i in 0..dim {
                let of_pose: f64 = (0..POSE_DIM)
                    .map(|k| p[(i, k)] * jacobian.pose[(a, k)])
                    .sum();
                let of_feature: f64 = (0..3)
                    .map(|k| p[(i, offset + k)] * jacobian.feature[(a, k)])
                    .sum();
                ph[(i, 3 * m + a)] = of_pose + of_feature;
            }
        }
        jacobians.push((offset, jacobian));
    }

    let mut s = Mat::<f64>::zeros(rows, rows);
    for column in 0..rows {
        let of_pose = Vector6::from_fn(|k, _| ph[(k, column)]);
        for (m, (offset, jacobian)) in jacobians.iter().enumerate() {
            let of_feature = Vector3::from_fn(|k, _| ph[(offset + k, column)]);
            let block = jacobian.pose * of_pose + jacobian.feature * of_feature;
            for a in 0..3 {
                s[(3 * m + a, column)] = block[a];
            }
        }
        s[(column, column)] += sigma * sigma;
    }

    cholesky(
        s.as_mut(),
        "innovation covariance of the feature measurements",
    )?;
    let mut whitened = ph.transpose().to_owned();
    solve_lower(s.as_ref(), whitened.as_mut());
    solve_lower(s.as_ref(), innovation.as_mut());
    let correction = whitened.transpose() * &innovation;
    belief.correct(|i| correction[(i, 0)])?;
    belief.covariance.reduce_by(whitened.as_ref())
}

fn check_measurements(
    belief: &Belief,
    measurements: &[FeatureMeasurement],
) -> Result<(), EstimatorError> {
    let count = belief.state.features.len();
    let mut seen = vec![false; count];
    for measurement in measurements {
        check_feature(measurement.feature, count)?;
        if std::mem::replace(&mut seen[measurement.feature.0], true) {
            return Err(EstimatorError::RepeatedFeature(measurement.feature));
        }
        if !measurement.z.iter().all(|x| x.is_finite()) {
            return Err(EstimatorError::NotFinite {
                what: "feature measurement",
            });
        }
    }
    Ok(())
}
