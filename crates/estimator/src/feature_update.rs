//! The update with what the robot's sensor saw, eq. (10).

use adslam_models::{
    FeatureId, FeatureMeasurementJacobians, POSE_DIM, Pose, feature_measurement,
    feature_measurement_jacobians, feature_offset,
};
use nalgebra::{Matrix3, Point3, Vector3, Vector6};

use crate::ekf::check_feature;
use crate::linear_algebra::set_product;
use crate::workspace::{Workspace, add_scaled, block_rows};
use crate::{Belief, Covariance, EstimatorError, FeatureMeasurement, Parallelism};

/// The measurement of one feature, linearised.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sighting {
    /// Where the feature begins in the state.
    offset: usize,
    /// H, body frame.
    jacobian: FeatureMeasurementJacobians,
    /// O, cm², body frame.
    noise: Matrix3<f64>,
    /// z − h(χ̂), cm, body frame.
    innovation: Vector3<f64>,
}

impl Sighting {
    /// Of a feature at `point` from `pose`; `noise` is O, cm², and `z` the measured value, cm, both in
    /// the body frame. Without a value it is what was expected.
    pub(crate) fn new(
        pose: &Pose,
        feature: FeatureId,
        point: &Point3<f64>,
        noise: Matrix3<f64>,
        z: Option<Vector3<f64>>,
    ) -> Self {
        Self {
            offset: feature_offset(feature),
            jacobian: feature_measurement_jacobians(pose, point),
            noise,
            innovation: z.map_or_else(Vector3::zeros, |z| z - feature_measurement(pose, point)),
        }
    }
}

/// The update with features, in memory that is kept.
#[derive(Clone, Debug, Default)]
pub(crate) struct FeatureUpdate {
    sightings: Vec<Sighting>,
    /// Which features were measured already.
    seen: Vec<bool>,
}

impl FeatureUpdate {
    /// Conditions the belief on the measurements, with H at the present state. Of the covariance only
    /// the lower triangle is brought up to date.
    pub(crate) fn apply(
        &mut self,
        belief: &mut Belief,
        measurements: &[FeatureMeasurement],
        sigma: f64,
        workspace: &mut Workspace,
        parallelism: Parallelism,
    ) -> Result<(), EstimatorError> {
        if measurements.is_empty() {
            return Ok(());
        }
        self.check(belief, measurements)?;
        let noise = Matrix3::identity() * (sigma * sigma);
        let (pose, features) = (&belief.state.pose, &belief.state.features);
        self.sightings.clear();
        self.sightings.reserve(belief.state.features.len());
        self.sightings.extend(
            measurements
                .iter()
                .map(|m| Sighting::new(pose, m.feature, &features[m.feature.0], noise, Some(m.z))),
        );
        condition_on_features(
            &mut belief.covariance,
            &self.sightings,
            workspace,
            parallelism,
        )?;
        belief.correct(|i| workspace.correction(i))
    }

    fn check(
        &mut self,
        belief: &Belief,
        measurements: &[FeatureMeasurement],
    ) -> Result<(), EstimatorError> {
        let count = belief.state.features.len();
        self.seen.clear();
        self.seen.resize(count, false);
        for measurement in measurements {
            check_feature(measurement.feature, count)?;
            if std::mem::replace(&mut self.seen[measurement.feature.0], true) {
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
}

/// Conditions the lower triangle of the covariance; the correction of the state is left in the
/// workspace.
///
/// A block of features at a time: the measurements are linearised at one state and their noise is
/// independent, so this is the update with all of them.
pub(crate) fn condition_on_features(
    covariance: &mut Covariance,
    sightings: &[Sighting],
    workspace: &mut Workspace,
    parallelism: Parallelism,
) -> Result<(), EstimatorError> {
    let dim = covariance.dim();
    workspace.prepare(dim, 1);
    for block in sightings.chunks(block_rows(dim) / 3) {
        workspace.start_block(3 * block.len());
        set_products(covariance, block, workspace);
        set_innovations(block, workspace);
        workspace.condition(
            covariance,
            "innovation covariance of the feature measurements",
            parallelism,
        )?;
    }
    Ok(())
}

/// P Hᵀ of one block: for all rows the pose's part, then each feature's.
fn set_products(covariance: &Covariance, block: &[Sighting], workspace: &mut Workspace) {
    let dim = covariance.dim();
    workspace.columns.reshape(dim, POSE_DIM);
    workspace.of_pose.reshape(POSE_DIM, 3 * block.len());
    covariance.copy_columns(0, workspace.columns.as_mut(), Parallelism::Sequential);
    for (m, sighting) in block.iter().enumerate() {
        for a in 0..3 {
            for k in 0..POSE_DIM {
                workspace.of_pose[(k, 3 * m + a)] = sighting.jacobian.pose[(a, k)];
            }
        }
    }
    set_product(
        workspace.products.as_mut(),
        workspace.columns.as_ref(),
        workspace.of_pose.as_ref(),
    );
    workspace.columns.reshape(dim, 3);
    for (m, sighting) in block.iter().enumerate() {
        let columns = workspace.columns.as_mut();
        covariance.copy_columns(sighting.offset, columns, Parallelism::Sequential);
        for a in 0..3 {
            let product = workspace.products.col_as_slice_mut(3 * m + a);
            for k in 0..3 {
                let column = workspace.columns.col_as_slice(k);
                add_scaled(product, sighting.jacobian.feature[(a, k)], column);
            }
        }
    }
}

/// S and the innovations of one block whose P Hᵀ is set.
fn set_innovations(block: &[Sighting], workspace: &mut Workspace) {
    let corrected_pose = Vector6::from_fn(|k, _| workspace.correction(k));
    for (m, sighting) in block.iter().enumerate() {
        let Sighting {
            offset, jacobian, ..
        } = *sighting;
        let corrected = Vector3::from_fn(|k, _| workspace.correction(offset + k));
        let innovation =
            sighting.innovation - jacobian.pose * corrected_pose - jacobian.feature * corrected;
        for a in 0..3 {
            workspace.growth[(3 * m + a, 0)] = innovation[a];
        }
        for column in 0..3 * (m + 1) {
            let of_pose = Vector6::from_fn(|k, _| workspace.products[(k, column)]);
            let of_feature = Vector3::from_fn(|k, _| workspace.products[(offset + k, column)]);
            let rows = jacobian.pose * of_pose + jacobian.feature * of_feature;
            for a in 0..3 {
                workspace.innovation_covariance[(3 * m + a, column)] = rows[a];
            }
        }
        for b in 0..3 {
            for a in 0..3 {
                workspace.innovation_covariance[(3 * m + a, 3 * m + b)] += sighting.noise[(a, b)];
            }
        }
    }
}
