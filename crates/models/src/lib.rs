//! Models of SLAM in an environment that moves and deforms: the state of eq. (1), the process
//! model of eq. (2), the measurements of eqs. (3)–(5) and (10), and the Jacobians of each.
//!
//! Everything is a fixed-size block: one pose, one feature. The joint state of all features, and its
//! covariance, live in the estimator.
//!
//! Units are centimetres and radians. Two frames appear: *world*, fixed, and *body*, the
//! robot's; R(Θ) takes body vectors to the world.
//!
//! ```
//! use adslam_models::{Control, Pose, feature_measurement, predicted_pose};
//! use nalgebra::{Point3, Vector3};
//!
//! let forward = Control { translation: Vector3::x(), ..Control::default() };
//! let pose = predicted_pose(&Pose::default(), &forward);
//! // Eq. (3): the feature in the robot's frame.
//! let z = feature_measurement(&pose, &Point3::new(3.0, 1.0, 0.0));
//! assert!((z - Vector3::new(2.0, 1.0, 0.0)).norm() < 1e-12);
//! ```

mod angles;
mod euler;
pub mod lie;
mod measurement;
mod motion;
mod pose;
mod sensor;
mod state;

pub use angles::wrap_angle;
pub use euler::EulerAngles;
pub use measurement::{
    FeatureMeasurementJacobians, feature_measurement, feature_measurement_jacobians,
    structure_measurement,
};
pub use motion::{Control, MotionJacobian, motion_jacobian, move_pose, predicted_pose};
pub use pose::Pose;
pub use sensor::Sensor;
pub use state::{FeatureId, POSE_DIM, State, feature_offset, state_dim};
