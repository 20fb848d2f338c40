//! The filters that every property must hold for; another one needs a line here.

use adslam_estimator::{Ekf, EstimatorError, FilterNoise};

/// What all of them are.
pub type Filter = Ekf;

/// All of them, by name, each assuming this noise.
pub fn filters(noise: FilterNoise) -> Result<Vec<(&'static str, Filter)>, EstimatorError> {
    Ok(vec![("Euler angles", Ekf::new(noise)?)])
}
