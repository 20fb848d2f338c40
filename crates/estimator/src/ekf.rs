//! Algorithm 1: propagation and update.

use adslam_models::{Control, FeatureId, motion_jacobian, predicted_pose};
use nalgebra::Vector3;

use crate::feature_update::FeatureUpdate;
use crate::structure_update::StructureUpdate;
use crate::workspace::Workspace;
use crate::{Belief, EstimatorError, FilterNoise, Parallelism, StructureMeasurements};

/// One feature as the robot's sensor measured it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeatureMeasurement {
    /// Which feature.
    pub feature: FeatureId,
    /// z = Rᵀ(p − x) + ε, cm, body frame.
    pub z: Vector3<f64>,
}

/// All that was measured at one step, eq. (3).
#[derive(Clone, Copy, Debug)]
pub struct Measurements<'a> {
    /// zᶠ: the features that the sensor saw, each at most once.
    pub features: &'a [FeatureMeasurement],
    /// zᶜ: relative positions between features.
    pub structure: StructureMeasurements<'a>,
}

/// The extended Kalman filter of Algorithm 1.
///
/// It keeps the memory that its steps need: from the second step on, states of the same size and
/// structure measurements of the same pairs, on one thread, allocate nothing. For a state of n
/// entries that is room for about 200 n numbers, less than a tenth of a covariance for 1000
/// features, and for a graph of some of the pairs three M × M matrices more.
#[derive(Clone, Debug)]
pub struct Ekf {
    noise: FilterNoise,
    parallelism: Parallelism,
    workspace: Workspace,
    features: FeatureUpdate,
    structure: StructureUpdate,
}

impl Ekf {
    /// A filter that assumes this noise.
    ///
    /// # Errors
    /// A sigma that cannot be used, see [`FilterNoise::validate`].
    pub fn new(noise: FilterNoise) -> Result<Self, EstimatorError> {
        noise.validate()?;
        Ok(Self {
            noise,
            parallelism: Parallelism::default(),
            workspace: Workspace::default(),
            features: FeatureUpdate::default(),
            structure: StructureUpdate::default(),
        })
    }

    /// The same filter on other threads; its results stay the same to the last bit.
    #[must_use]
    pub fn with_parallelism(self, parallelism: Parallelism) -> Self {
        Self {
            parallelism,
            ..self
        }
    }

    /// The noise that the filter assumes.
    #[must_use]
    pub fn noise(&self) -> &FilterNoise {
        &self.noise
    }

    /// Propagation: χ̂ ← f(χ̂, u, 0), P ← F P Fᵀ + G Q Gᵀ.
    ///
    /// `feature_motion` is what the filter knows of each feature's motion, r_t t + r_d d, cm, world.
    ///
    /// # Errors
    /// A covariance that is not of the state's features, a wrong number of displacements, or NaN or
    /// infinity in an input.
    pub fn predict(
        &self,
        belief: &mut Belief,
        control: &Control,
        feature_motion: &[Vector3<f64>],
    ) -> Result<(), EstimatorError> {
        check_motion(belief, control, feature_motion)?;
        let jacobian = motion_jacobian(&belief.state.pose, control);
        belief.state.pose = predicted_pose(&belief.state.pose, control);
        belief.state.move_features(feature_motion);
        belief.covariance.propagate(&jacobian, &self.noise);
        Ok(())
    }

    /// Update with everything measured at this step.
    ///
    /// Equal to Algorithm 1 with all rows stacked: the feature measurements are linearised at the
    /// predicted state, and the structure measurements, being linear, may follow.
    ///
    /// # Errors
    /// A covariance that is not of the state's features or has broken down, measurements of unknown or
    /// repeated features, or non-finite numbers; the belief must then not be used further.
    pub fn update(
        &mut self,
        belief: &mut Belief,
        measurements: &Measurements<'_>,
    ) -> Result<(), EstimatorError> {
        belief.check_sizes()?;
        let parallelism = self.parallelism.for_dim(belief.covariance.dim());
        self.features.apply(
            belief,
            measurements.features,
            self.noise.feature_measurement_sigma,
            &mut self.workspace,
            parallelism,
        )?;
        self.structure.apply(
            belief,
            &measurements.structure,
            self.noise.structure_measurement_sigma,
            &mut self.workspace,
            parallelism,
        )?;
        belief.covariance.complete(parallelism)
    }
}

/// The inputs of a propagation must be finite and as many as the state has features.
pub(crate) fn check_motion(
    belief: &Belief,
    control: &Control,
    feature_motion: &[Vector3<f64>],
) -> Result<(), EstimatorError> {
    belief.check_sizes()?;
    let expected = belief.state.features.len();
    if feature_motion.len() != expected {
        return Err(EstimatorError::WrongCount {
            what: "the motion of the features",
            found: feature_motion.len(),
            expected,
        });
    }
    let finite = |v: &Vector3<f64>| v.iter().all(|x| x.is_finite());
    if !(finite(&control.rotation) && finite(&control.translation)) {
        return Err(EstimatorError::NotFinite { what: "control" });
    }
    if !feature_motion.iter().all(finite) {
        return Err(EstimatorError::NotFinite {
            what: "motion of the features",
        });
    }
    Ok(())
}

/// A feature must be part of the state.
pub(crate) fn check_feature(feature: FeatureId, count: usize) -> Result<(), EstimatorError> {
    if feature.0 < count {
        return Ok(());
    }
    Err(EstimatorError::UnknownFeature {
        feature,
        last: count.saturating_sub(1),
    })
}
