//! The filters that every property must hold for; another one needs a line here.

use adslam_estimator::{Estimator, EstimatorError, EstimatorKind, FilterNoise, Parallelism};

/// What all of them are.
pub type Filter = Box<dyn Estimator>;

/// All of them, by name, each assuming this noise.
pub fn filters(noise: FilterNoise) -> Result<Vec<(&'static str, Filter)>, EstimatorError> {
    [
        ("Euler angles", EstimatorKind::EulerEkf),
        ("SO(3)", EstimatorKind::So3Ekf),
        ("right-invariant", EstimatorKind::RightInvariantEkf),
    ]
    .into_iter()
    .map(|(name, kind)| Ok((name, kind.build(noise, None, Parallelism::Sequential)?)))
    .collect()
}
