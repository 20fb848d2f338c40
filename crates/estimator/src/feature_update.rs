//! The update with what the robot's sensor saw, eq. (10).

#[cfg(test)]
mod tests;

use adslam_models::{
    FeatureId, FeatureMeasurementJacobians, POSE_DIM, Pose, feature_measurement,
    feature_measurement_jacobians, feature_offset,
};
use nalgebra::{Matrix3, Matrix3x6, Matrix6, Point3, Vector3, Vector6};

use crate::digits::{Stages, check_resolved};
use crate::input::check_feature;
use crate::linear_algebra::set_product;
use crate::workspace::{Workspace, add_scaled, block_rows};
use crate::{Belief, Covariance, EstimatorError, FeatureMeasurement, Nis, Parallelism};

/// What is measured here, in errors.
const FEATURES: &str = "feature measurements";

/// What S is called in errors.
const INNOVATION_COVARIANCE: &str = "innovation covariance of the feature measurements";

/// The measurement of one feature, linearised.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sighting {
    feature: FeatureId,
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
            feature,
            jacobian: feature_measurement_jacobians(pose, point),
            noise,
            innovation: z.map_or_else(Vector3::zeros, |z| z - feature_measurement(pose, point)),
        }
    }

    /// Where the feature begins in the state.
    fn offset(&self) -> usize {
        feature_offset(self.feature)
    }

    /// The smallest variance of O on any axis, cm².
    fn smallest_noise(&self) -> f64 {
        let noise = &self.noise;
        if (noise - Matrix3::from_diagonal(&noise.diagonal())).amax() == 0.0 {
            noise.diagonal().min()
        } else {
            noise.symmetric_eigenvalues().min()
        }
    }

    /// yᵀS⁻¹y of this measurement alone, `pose` being the pose's part of the covariance.
    ///
    /// # Errors
    /// [`EstimatorError::TooPrecise`] if S does not have six right digits.
    fn squared_distance(
        &self,
        covariance: &Covariance,
        pose: &Matrix6<f64>,
    ) -> Result<f64, EstimatorError> {
        let FeatureMeasurementJacobians {
            pose: of_pose,
            feature: of_feature,
        } = self.jacobian;
        let offset = self.offset();
        let cross = Matrix3x6::from_fn(|i, k| covariance.entry(offset + i, k));
        let mixed = of_feature * cross * of_pose.transpose();
        let (by_pose, by_feature) = (
            of_pose * pose * of_pose.transpose(),
            of_feature * covariance.feature(self.feature) * of_feature.transpose(),
        );
        let s = by_pose + mixed + mixed.transpose() + by_feature + self.noise;
        // Where pose and feature move together the terms cancel.
        let magnitude = by_pose.trace() + by_feature.trace();
        let smallest = s.symmetric_eigenvalues().min();
        check_resolved(FEATURES, smallest, magnitude, covariance.dim())?;
        let factor = s.cholesky().ok_or(EstimatorError::NotPositiveDefinite {
            matrix: INNOVATION_COVARIANCE,
            dim: 3,
        })?;
        Ok(self.innovation.dot(&factor.solve(&self.innovation)))
    }
}

/// The update with features, in memory that is kept.
#[derive(Clone, Debug, Default)]
pub(crate) struct FeatureUpdate {
    sightings: Vec<Sighting>,
    /// Which features were measured already.
    seen: Vec<bool>,
    /// Whose measurements the gate kept out.
    rejected: Vec<FeatureId>,
}

impl FeatureUpdate {
    /// Conditions the covariance on the measurements, with H at the present state, and leaves the
    /// correction in `delta`. Of the covariance only the lower triangle is brought up to date. `gate` is the largest
    /// squared distance of a measurement from what is expected that is believed.
    pub(crate) fn apply(
        &mut self,
        belief: &mut Belief,
        delta: &mut Vec<f64>,
        measurements: &[FeatureMeasurement],
        (sigma, gate): (f64, Option<f64>),
        workspace: &mut Workspace,
        parallelism: Parallelism,
    ) -> Result<Nis, EstimatorError> {
        self.rejected.clear();
        if measurements.is_empty() {
            return Ok(Nis::default());
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
        if let Some(gate) = gate {
            self.close_gate(&belief.covariance, gate)?;
        }
        condition_on_features(
            &mut belief.covariance,
            &self.sightings,
            workspace,
            parallelism,
        )?;
        workspace.copy_correction(delta);
        Ok(Nis {
            value: workspace.nis(),
            dof: 3 * self.sightings.len(),
        })
    }

    /// Takes out the measurements, each judged by itself, that are farther than the gate from what was
    /// expected.
    fn close_gate(&mut self, covariance: &Covariance, gate: f64) -> Result<(), EstimatorError> {
        let pose = covariance.pose();
        let mut failed = None;
        self.rejected.reserve(self.seen.len());
        self.sightings.retain(|sighting| {
            match sighting.squared_distance(covariance, &pose) {
                Ok(distance) if distance <= gate => return true,
                Ok(_) => {}
                Err(error) => failed = Some(error),
            }
            self.rejected.push(sighting.feature);
            false
        });
        failed.map_or(Ok(()), Err)
    }

    /// The features whose measurements the gate kept out.
    pub(crate) fn rejected(&self) -> &[FeatureId] {
        &self.rejected
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
    let mut stages = Stages::new(FEATURES, dim);
    while let Some(weight) = stages.next(gain(covariance, sightings))? {
        for block in sightings.chunks(block_rows(dim) / 3) {
            workspace.start_block(3 * block.len());
            set_products(covariance, block, workspace);
            set_innovations(block, weight, workspace);
            workspace.condition(covariance, INNOVATION_COVARIANCE, parallelism)?;
        }
    }
    Ok(())
}

/// How many times smaller the sightings can make a variance: all of them that of the pose, each that of its
/// feature.
fn gain(covariance: &Covariance, sightings: &[Sighting]) -> f64 {
    let mut of_pose = Vector6::zeros();
    let mut of_features = 0.0_f64;
    for sighting in sightings {
        let noise = sighting.smallest_noise();
        let squares = sighting.jacobian.pose.map(|entry| entry * entry);
        of_pose += squares.row_sum().transpose() / noise;
        let feature = sighting.feature.0;
        let variance = covariance.largest_feature_variance(feature..feature + 1);
        of_features = of_features.max(variance / noise);
    }
    let pose = covariance.pose().diagonal();
    of_pose.component_mul(&pose).max().max(of_features)
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
        covariance.copy_columns(sighting.offset(), columns, Parallelism::Sequential);
        for a in 0..3 {
            let product = workspace.products.col_as_slice_mut(3 * m + a);
            for k in 0..3 {
                let column = workspace.columns.col_as_slice(k);
                add_scaled(product, sighting.jacobian.feature[(a, k)], column);
            }
        }
    }
}

/// S, with the noise O/`weight`, and the innovations of one block whose P Hᵀ is set.
fn set_innovations(block: &[Sighting], weight: f64, workspace: &mut Workspace) {
    let corrected_pose = Vector6::from_fn(|k, _| workspace.correction(k));
    for (m, sighting) in block.iter().enumerate() {
        let (offset, jacobian) = (sighting.offset(), &sighting.jacobian);
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
                workspace.innovation_covariance[(3 * m + a, 3 * m + b)] +=
                    sighting.noise[(a, b)] / weight;
            }
        }
    }
}
