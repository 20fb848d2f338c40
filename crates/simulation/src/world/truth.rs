//! The true robot and the true object.

#[cfg(test)]
mod tests;

use std::sync::Arc;

use adslam_deformation::ObjectMotion;
use adslam_models::{Control, FeatureId, Pose, feature_measurement, move_pose};
use nalgebra::{Point3, Vector3, Vector6};
use rand_chacha::ChaCha12Rng;

use super::faults::StepFaults;
use super::{DeformationNoise, FaultCounts, Faults, Stream, WorldNoise, stream};

/// What is true before any noise is drawn.
#[derive(Clone, Debug)]
pub struct WorldModel {
    /// The robot's pose at step 1.
    pub start: Pose,
    /// The features' rest positions, cm, world.
    pub rest: Vec<Point3<f64>>,
    /// How the object moves.
    pub motion: ObjectMotion,
    /// How far from the plan everything is.
    pub noise: WorldNoise,
    /// What goes wrong with measurements beside that.
    pub faults: Faults,
}

/// What the robot measures at one step.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulatedMeasurements {
    /// The features measured and their measurements, cm, body frame.
    pub features: Vec<(FeatureId, Vector3<f64>)>,
    /// For each feature i the sum over all j of the measured p_i − p_j, cm: as good as all pairs.
    /// None where they did not arrive.
    pub structure_sums: Option<Vec<Vector3<f64>>>,
    /// What went wrong.
    pub faults: FaultCounts,
}

/// The truth of one run, moving from step to step.
#[derive(Clone, Debug)]
pub struct World {
    model: Arc<WorldModel>,
    step: usize,
    pose: Pose,
    /// Where each feature is without its deformation.
    base: Vec<Point3<f64>>,
    features: Vec<Point3<f64>>,
    motion_stream: ChaCha12Rng,
    deformation_stream: ChaCha12Rng,
    sensor_stream: ChaCha12Rng,
    fault_stream: ChaCha12Rng,
    /// What goes wrong with the measurements of the present step.
    faults: StepFaults,
}

impl World {
    /// The world at step 1, its noise drawn from the streams of `seed`.
    #[must_use]
    pub fn new(model: impl Into<Arc<WorldModel>>, seed: u64) -> Self {
        let model = model.into();
        let mut world = Self {
            step: 1,
            pose: model.start,
            base: model.rest.clone(),
            model,
            features: Vec::new(),
            motion_stream: stream(seed, Stream::Motion),
            deformation_stream: stream(seed, Stream::Deformation),
            sensor_stream: stream(seed, Stream::Sensor),
            fault_stream: stream(seed, Stream::Faults),
            faults: StepFaults::default(),
        };
        world.show_features();
        world
    }

    /// n, from 1.
    #[must_use]
    pub fn step(&self) -> usize {
        self.step
    }

    /// The true pose.
    #[must_use]
    pub fn pose(&self) -> &Pose {
        &self.pose
    }

    /// The true features, cm, world.
    #[must_use]
    pub fn features(&self) -> &[Point3<f64>] {
        &self.features
    }

    /// The features as they are known at the start: each off by the first estimate's error.
    pub fn first_estimate(&mut self) -> Vec<Point3<f64>> {
        let noise = &self.model.noise;
        let stream = &mut self.sensor_stream;
        self.features
            .iter()
            .map(|p| p + noise.standard_vector(stream) * noise.initial_feature_sigma)
            .collect()
    }

    /// Moves robot and object to the next step, eq. (2).
    pub fn advance(&mut self, control: &Control) {
        let noise = &self.model.noise;
        let w = Vector6::from_fn(|k, _| {
            let sigma = if k < 3 {
                noise.rotation_sigma
            } else {
                noise.translation_sigma
            };
            sigma * noise.standard(&mut self.motion_stream)
        });
        self.pose = move_pose(&self.pose, control, &w);

        let translation = self.model.motion.translation_step(self.step);
        for base in &mut self.base {
            let w_t = noise.standard_vector(&mut self.deformation_stream);
            *base += translation + w_t * noise.feature_translation_sigma;
        }
        self.step += 1;
        self.show_features();
        let faults = &self.model.faults;
        self.faults = faults.draw(self.features.len(), &mut self.fault_stream);
    }

    /// p = b + r_d D(n) + w_d. Where the noise accumulates it moves the base as well; the start
    /// then has none.
    fn show_features(&mut self) {
        let WorldModel {
            motion,
            noise,
            rest,
            ..
        } = &*self.model;
        let shown = self.base.iter_mut().zip(rest).map(|(base, rest)| {
            let w_d = noise.standard_vector(&mut self.deformation_stream)
                * noise.feature_deformation_sigma;
            match noise.deformation {
                DeformationNoise::Fresh => *base + motion.offset(rest, self.step) + w_d,
                DeformationNoise::Accumulating => {
                    if self.step > 1 {
                        *base += w_d;
                    }
                    *base + motion.offset(rest, self.step)
                }
            }
        });
        self.features = shown.collect();
    }

    /// Measures the features in sight and the structure, as far as faults let it. Noise and faults are
    /// drawn for every feature, seen or not, so that what one planner sees does not change what
    /// another one meets.
    pub fn measure(&mut self, in_sight: &[FeatureId]) -> SimulatedMeasurements {
        let noise = &self.model.noise;
        let stream = &mut self.sensor_stream;
        let errors: Vec<Vector3<f64>> = self
            .features
            .iter()
            .map(|_| noise.standard_vector(stream))
            .collect();
        let of_structure: Vec<Vector3<f64>> = self
            .features
            .iter()
            .map(|_| noise.standard_vector(stream))
            .collect();
        let mut faults = FaultCounts {
            dropped_structures: usize::from(self.faults.drops_structure),
            ..FaultCounts::default()
        };
        let mut features = Vec::with_capacity(in_sight.len());
        for &id in in_sight {
            let fault = self.faults.of_feature(id.0);
            if fault.is_missed {
                faults.missed_detections += 1;
                continue;
            }
            let mut z = feature_measurement(&self.pose, &self.features[id.0])
                + errors[id.0] * noise.feature_measurement_sigma;
            if let Some(gross) = fault.outlier {
                faults.outliers += 1;
                z += gross;
            }
            features.push((id, z));
        }
        let structure_sums = (!self.faults.drops_structure).then(|| {
            let sigma = noise.structure_measurement_sigma;
            summed_structure(&self.features, &of_structure, sigma)
        });
        SimulatedMeasurements {
            features,
            structure_sums,
            faults,
        }
    }
}

/// The sums over all pairs: Σⱼ (p_i − p_j) + √M σ (ξ_i − mean ξ). The noise has the covariance
/// σ² (M I − 11ᵀ) that the sum of M(M−1)/2 independent measurements has.
fn summed_structure(
    features: &[Point3<f64>],
    xi: &[Vector3<f64>],
    sigma: f64,
) -> Vec<Vector3<f64>> {
    let count = features.len() as f64;
    let total: Vector3<f64> = features.iter().map(|p| p.coords).sum();
    let mean_xi = xi.iter().sum::<Vector3<f64>>() / count;
    let scale = sigma * count.sqrt();
    features
        .iter()
        .zip(xi)
        .map(|(p, xi)| p.coords * count - total + (xi - mean_xi) * scale)
        .collect()
}
