//! What a filter is given, and whether it can be used.

use adslam_models::{Control, FeatureId};
use nalgebra::Vector3;

use crate::{Belief, EstimatorError, StructureMeasurements};

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
