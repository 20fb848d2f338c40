//! Beliefs and measurements to time things on, the same every time: features spread over a sphere, a
//! robot in front of them, and a covariance that some steps of the filter have made dense.
#![allow(dead_code, reason = "each bench uses a part")]

use adslam_estimator::{
    Belief, Ekf, Estimator, EstimatorError, FeatureMeasurement, FilterNoise, Measurements,
    StructureMeasurements, UpdateReport,
};
use adslam_models::{Control, FeatureId, Pose, feature_measurement, state_dim};
use nalgebra::{Matrix6, Point3, Vector3, Vector6};

/// The noise of the paper's environments, cm and radians.
pub const NOISE: FilterNoise = FilterNoise {
    rotation_sigma: 0.02,
    translation_sigma: 0.03,
    feature_motion_sigma: 0.058,
    feature_measurement_sigma: 0.02,
    structure_measurement_sigma: 0.5,
};

/// One size of the problem.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// What it is called in the ids.
    pub name: &'static str,
    /// M.
    pub features: usize,
    /// k, how many of them the sensor sees at a step.
    pub seen: usize,
}

impl Case {
    /// n = 6 + 3M.
    pub fn dim(self) -> usize {
        state_dim(self.features)
    }
}

const fn case(name: &'static str, features: usize, seen: usize) -> Case {
    Case {
        name,
        features,
        seen,
    }
}

/// All sizes, from the polygon's on.
pub const CASES: [Case; 5] = [
    case("polygon", 14, 5),
    case("heart50", 50, 10),
    case("heart200", 200, 16),
    case("heart500", 500, 16),
    case("heart1000", 1000, 16),
];

/// Steps that a belief has behind it; each sees other features.
const STEPS: usize = 4;

/// A belief after some steps around the object.
///
/// # Errors
/// None are expected: the numbers are fixed.
pub fn belief(case: Case) -> Result<Belief, EstimatorError> {
    let pose = Pose::from_vector(&Vector6::new(0.1, 0.2, 3.0, 8.0, 1.0, 0.5));
    let mut belief = Belief::initial(pose, sphere(case.features), &Matrix6::zeros(), 0.02)?;
    let mut ekf = Ekf::new(NOISE)?;
    for step in 0..STEPS {
        let step = Step::new(&belief, case, step);
        step.run(&mut ekf, &mut belief)?;
    }
    Ok(belief)
}

/// Points spread evenly over a sphere of 5 cm around the origin, along a spiral.
pub fn sphere(count: usize) -> Vec<Point3<f64>> {
    let golden_angle = std::f64::consts::PI * (3.0 - 5f64.sqrt());
    let point = |i: usize| {
        let z = 1.0 - (2.0 * i as f64 + 1.0) / count as f64;
        let (sin, cos) = (golden_angle * i as f64).sin_cos();
        let radius = (1.0 - z * z).sqrt();
        Point3::from(Vector3::new(radius * cos, radius * sin, z) * 5.0)
    };
    (0..count).map(point).collect()
}

/// What the filter is given at one step: the robot and the object stand still, and every measurement is
/// what the estimate predicts, so that a step may be repeated for as long as a bench likes.
#[derive(Clone, Debug)]
pub struct Step {
    pub control: Control,
    pub motion: Vec<Vector3<f64>>,
    pub features: Vec<FeatureMeasurement>,
    pub sums: Vec<Vector3<f64>>,
}

impl Step {
    /// Sees `case.seen` features, others for each `turn`, and all pairs.
    pub fn new(belief: &Belief, case: Case, turn: usize) -> Self {
        let points = &belief.state.features;
        let seen = |k: usize| {
            let feature = FeatureId((turn * case.seen + k) % points.len());
            FeatureMeasurement {
                feature,
                z: feature_measurement(&belief.state.pose, &points[feature.0]),
            }
        };
        let total: Vector3<f64> = points.iter().map(|p| p.coords).sum();
        let sum = |p: &Point3<f64>| p.coords * points.len() as f64 - total;
        Self {
            control: Control::default(),
            motion: vec![Vector3::zeros(); points.len()],
            features: (0..case.seen).map(seen).collect(),
            sums: points.iter().map(sum).collect(),
        }
    }

    /// Algorithm 1 for this step.
    ///
    /// # Errors
    /// Those of the filter.
    pub fn run(
        &self,
        ekf: &mut dyn Estimator,
        belief: &mut Belief,
    ) -> Result<UpdateReport, EstimatorError> {
        ekf.predict(belief, &self.control, &self.motion)?;
        self.update(ekf, belief, &self.features)
    }

    /// The update with some features and all pairs.
    ///
    /// # Errors
    /// Those of the filter.
    pub fn update(
        &self,
        ekf: &mut dyn Estimator,
        belief: &mut Belief,
        features: &[FeatureMeasurement],
    ) -> Result<UpdateReport, EstimatorError> {
        let measurements = Measurements {
            features,
            structure: StructureMeasurements::AllPairsSummed(&self.sums),
        };
        ekf.update(belief, &measurements)
    }
}
