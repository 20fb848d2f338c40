//! The estimator of a name.

use adslam_estimator::{Estimator, EstimatorError, EstimatorKind, FilterNoise, Parallelism};
use adslam_names::EstimatorName;
use adslam_statistics::chi_squared;

/// The part of good feature measurements that a filter's gate believes, between 0 and 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GateProbability(f64);

impl GateProbability {
    const SMALLEST: f64 = 1e-9;

    /// The probability, if it can be that of a gate; none unless it is above 0 and below 1 by 10⁻⁹ at least.
    #[must_use]
    pub fn new(probability: f64) -> Option<Self> {
        let allowed = Self::SMALLEST..=1.0 - Self::SMALLEST;
        allowed.contains(&probability).then_some(Self(probability))
    }

    /// As a number.
    #[must_use]
    pub const fn get(self) -> f64 {
        self.0
    }

    /// The squared distance, χ² with 3 degrees of freedom, that good measurements of a feature keep with this
    /// probability.
    #[must_use]
    pub fn squared_distance(self) -> f64 {
        chi_squared::quantile(self.0, 3)
    }
}

/// The estimator `name`, which assumes this noise and believes all feature measurements, or those that pass a gate.
///
/// # Errors
/// A sigma that cannot be used, see [`FilterNoise::validate`].
pub fn build_estimator(
    name: EstimatorName,
    noise: FilterNoise,
    gate: Option<GateProbability>,
    parallelism: Parallelism,
) -> Result<Box<dyn Estimator>, EstimatorError> {
    let kind = match name {
        EstimatorName::EulerEkf => EstimatorKind::EulerEkf,
        EstimatorName::So3Ekf => EstimatorKind::So3Ekf,
        EstimatorName::RightInvariantEkf => EstimatorKind::RightInvariantEkf,
    };
    kind.build(
        noise,
        gate.map(GateProbability::squared_distance),
        parallelism,
    )
}
