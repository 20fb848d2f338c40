//! Dense extended Kalman filters, Algorithm 1 in several error coordinates, for a robot and the features of
//! an object that moves and deforms.
//!
//! An [`Estimator`] propagates and updates a [`Belief`]: the estimated state and its joint
//! [`Covariance`]. There is one, [`Ekf`], over the error that an [`ErrorState`] defines: the paper's Euler
//! angles, SO(3), or the right-invariant error of robot and features together.
//! [`PosteriorTrace`] tells a planner what trace an action would leave (eqs. 6, 7).
//!
//! The filter sees controls, the known motion of the features and measurements, never the truth.
//! All units are cm and radians.
//!
//! ```
//! use adslam_estimator::{
//!     Belief, EstimatorKind, FeatureMeasurement, FilterNoise, Measurements, Parallelism, StructureMeasurements,
//! };
//! use adslam_models::{FeatureId, Pose};
//! use nalgebra::{Matrix6, Point3, Vector3};
//!
//! let noise = FilterNoise {
//!     rotation_sigma: 0.02,
//!     translation_sigma: 0.03,
//!     feature_motion_sigma: 0.05,
//!     feature_measurement_sigma: 0.02,
//!     structure_measurement_sigma: 0.5,
//! };
//! let mut filter = EstimatorKind::RightInvariantEkf.build(noise, None, Parallelism::Sequential)?;
//! let features = vec![Point3::new(1.0, 0.0, 0.0), Point3::new(1.0, 1.0, 0.0)];
//! let mut belief = Belief::initial(Pose::default(), features, &(Matrix6::identity() * 0.01), 0.1)?;
//! let before = belief.covariance.trace();
//! let measured = FeatureMeasurement { feature: FeatureId(0), z: Vector3::new(1.0, 0.0, 0.0) };
//! filter.update(&mut belief, &Measurements { features: &[measured], structure: StructureMeasurements::None })?;
//! assert!(belief.covariance.trace() < before);
//! # Ok::<(), adslam_estimator::EstimatorError>(())
//! ```

mod belief;
mod buffer;
mod covariance;
mod digits;
mod ekf;
mod error;
mod error_state;
mod estimator;
mod feature_update;
mod input;
mod linear_algebra;
mod noise;
mod objective;
mod parallel;
mod structure_update;
mod workspace;

pub use belief::Belief;
pub use covariance::Covariance;
pub use ekf::Ekf;
pub use error::EstimatorError;
pub use error_state::{ErrorState, EulerError, RightInvariantError, So3Error};
pub use estimator::{Estimator, EstimatorKind, Nis, UpdateReport};
pub use input::{FeatureMeasurement, Measurements};
pub use noise::FilterNoise;
pub use objective::{DirectTrace, PlannedMeasurement, PosteriorTrace, SetId};
pub use parallel::Parallelism;
pub use structure_update::{PairMeasurement, StructureMeasurements};
