//! What every estimator can do, whatever its error coordinates.

use adslam_models::{Control, FeatureId, State};
use nalgebra::Vector3;

use crate::{
    Belief, Ekf, EstimatorError, EulerError, FilterNoise, Measurements, Parallelism,
    RightInvariantError, So3Error,
};

/// A filter that follows robot and features through an environment that moves and deforms.
pub trait Estimator: Send {
    /// Propagation: χ̂ ← f(χ̂, u, 0), P ← F P Fᵀ + G Q Gᵀ.
    ///
    /// `feature_motion` is what the filter knows of each feature's motion, r_t t + r_d d, cm, world.
    ///
    /// # Errors
    /// A covariance that is not of the state's features, a wrong number of displacements, NaN or infinity in an
    /// input, or a result of which fewer than six digits are right.
    fn predict(
        &self,
        belief: &mut Belief,
        control: &Control,
        feature_motion: &[Vector3<f64>],
    ) -> Result<(), EstimatorError>;

    /// Update with everything measured at this step.
    ///
    /// # Errors
    /// A covariance that is not of the state's features or has broken down, measurements of unknown or
    /// repeated features, non-finite numbers, or a result of which fewer than six digits are right; the belief must
    /// then not be used further.
    fn update(
        &mut self,
        belief: &mut Belief,
        measurements: &Measurements<'_>,
    ) -> Result<UpdateReport, EstimatorError>;

    /// The features whose measurements the gate kept out of the last update.
    fn rejected(&self) -> &[FeatureId];

    /// The error of which this estimator's covariance is the covariance, in the order of the state
    /// (radians, cm): for the NEES. The truth is the caller's; no estimate depends on it.
    fn error(&self, estimate: &State, truth: &State) -> Vec<f64>;
}

/// What the measurements of a step had to say about the filter.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct UpdateReport {
    /// Of the feature measurements that were used.
    pub features: Nis,
    /// Of the structure measurements, given the features'.
    pub structure: Nis,
    /// How many feature measurements the gate kept out.
    pub rejected: usize,
}

/// Normalised innovation squared, yᵀS⁻¹y: χ² with `dof` degrees of freedom if the filter is consistent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Nis {
    /// yᵀS⁻¹y.
    pub value: f64,
    /// How many numbers were measured.
    pub dof: usize,
}

/// The estimators there are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum EstimatorKind {
    /// The paper's EKF: [`EulerError`].
    #[default]
    EulerEkf,
    /// The error-state EKF on SO(3): [`So3Error`].
    So3Ekf,
    /// The right-invariant EKF: [`RightInvariantError`].
    RightInvariantEkf,
}

impl EstimatorKind {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::EulerEkf, Self::So3Ekf, Self::RightInvariantEkf];

    /// An estimator that assumes this noise. `gate`: feature measurements farther than this from what is
    /// expected, squared and in units of their covariance (χ² with 3 degrees of freedom), are not used.
    ///
    /// # Errors
    /// A sigma or a gate that cannot be used, see [`FilterNoise::validate`].
    pub fn build(
        self,
        noise: FilterNoise,
        gate: Option<f64>,
        parallelism: Parallelism,
    ) -> Result<Box<dyn Estimator>, EstimatorError> {
        fn boxed<E: crate::ErrorState>(
            ekf: Ekf<E>,
            gate: Option<f64>,
            parallelism: Parallelism,
        ) -> Result<Box<dyn Estimator>, EstimatorError> {
            Ok(Box::new(ekf.with_gate(gate)?.with_parallelism(parallelism)))
        }
        match self {
            Self::EulerEkf => boxed(Ekf::<EulerError>::in_coordinates(noise)?, gate, parallelism),
            Self::So3Ekf => boxed(Ekf::<So3Error>::in_coordinates(noise)?, gate, parallelism),
            Self::RightInvariantEkf => boxed(
                Ekf::<RightInvariantError>::in_coordinates(noise)?,
                gate,
                parallelism,
            ),
        }
    }
}
