//! What runs on the robot: a belief, the estimator that keeps it, and the planner that decides from it.
//!
//! An [`Agent`] is the one place where prediction, update and decision meet. The simulator steps it, `adslam filter`
//! steps it through a log, and a live robot steps it from its own measurements. It has no truth, no files, no random
//! numbers and no clock: measurements, and what is known of the object's motion, are handed in.
//!
//! ```
//! use adslam_agent::{Agent, StepInput};
//! use adslam_estimator::{
//!     Belief, EstimatorKind, FeatureMeasurement, FilterNoise, Measurements, Parallelism, StructureMeasurements,
//! };
//! use adslam_models::{Control, FeatureId, Pose};
//! use nalgebra::{Matrix6, Point3, Vector3};
//!
//! let noise = FilterNoise {
//!     rotation_sigma: 0.02,
//!     translation_sigma: 0.03,
//!     feature_motion_sigma: 0.05,
//!     feature_measurement_sigma: 0.02,
//!     structure_measurement_sigma: 0.5,
//! };
//! let estimator = EstimatorKind::EulerEkf.build(noise, None, Parallelism::Sequential)?;
//! let features = vec![Point3::new(1.0, 0.0, 0.0), Point3::new(1.0, 1.0, 0.0)];
//! let belief = Belief::initial(Pose::default(), features, &Matrix6::zeros(), 0.1)?;
//! let mut agent = Agent::new(estimator, belief);
//! agent.step(&StepInput {
//!     control: &Control { translation: Vector3::x() * 0.1, ..Control::default() },
//!     feature_motion: &[Vector3::zeros(); 2],
//!     measurements: Measurements {
//!         features: &[FeatureMeasurement { feature: FeatureId(0), z: Vector3::new(0.91, 0.0, 0.0) }],
//!         structure: StructureMeasurements::None,
//!     },
//! })?;
//! assert!((agent.belief().state.pose.position.x - 0.1).abs() < 0.02);
//! # Ok::<(), adslam_estimator::EstimatorError>(())
//! ```

mod agent;
mod estimators;

pub use agent::{Agent, StepInput};
pub use estimators::{EstimatorEntry, EstimatorNameTaken, Estimators, GateProbability};
