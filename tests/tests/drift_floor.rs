//! The drift floor against estimators that are told everything but where the world's origin is.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a helper that fails is a test that fails"
)]

use std::sync::Arc;

use adslam_deformation::{BackAndForth, ObjectMotion};
use adslam_diagnostics::Interrupt;
use adslam_estimator::{
    Belief, Ekf, Estimator, FeatureMeasurement, FilterNoise, Measurements, StructureMeasurements,
};
use adslam_experiment::run::Batch;
use adslam_models::{Control, FeatureId, Pose};
use adslam_names::PlannerName;
use adslam_record::HistoryMetrics;
use adslam_simulation::{DeformationNoise, DriftFloor, Faults, World, WorldModel, WorldNoise};
use adslam_tests::setup;
use nalgebra::{DMatrix, DVector, Matrix6, Point3, Vector3};

const FEATURES: usize = 6;
const STEPS: usize = 40;
const RUNS: u64 = 1000;

/// As good as exact.
const TINY: f64 = 1e-5;

fn model(deformation: DeformationNoise, truncate_at_sigmas: Option<f64>) -> WorldModel {
    let place = |i: usize| {
        let (i, angle) = (i as f64, i as f64 * 1.3);
        Point3::new(3.0 + angle.cos(), angle.sin(), 0.4 * i)
    };
    WorldModel {
        start: Pose::default(),
        rest: (0..FEATURES).map(place).collect(),
        motion: ObjectMotion {
            translation: Arc::new(BackAndForth::new(Vector3::x() * 0.1)),
            ..ObjectMotion::default()
        },
        noise: WorldNoise {
            rotation_sigma: 0.0,
            translation_sigma: 0.03,
            feature_translation_sigma: 0.03,
            feature_deformation_sigma: 0.05,
            feature_measurement_sigma: TINY,
            structure_measurement_sigma: 0.5,
            initial_feature_sigma: 0.02,
            deformation,
            truncate_at_sigmas,
        },
        faults: Faults::default(),
    }
}

/// The control of step `n`: a turn and a way forward.
fn control(n: usize) -> Control {
    Control {
        rotation: Vector3::new(0.0, 0.02, 0.1),
        translation: Vector3::new(0.05, if n.is_multiple_of(2) { 0.1 } else { -0.05 }, 0.0),
    }
}

/// What has led to a step, noise apart.
struct Told<'a> {
    control: &'a Control,
    /// R(Θ) v with the true orientation, cm, world.
    way: Vector3<f64>,
    /// The motion of each feature, cm, world.
    moved: &'a [Vector3<f64>],
}

/// An estimator that is told everything but where the world's origin is.
trait Oracle {
    fn start(model: &WorldModel, features: Vec<Point3<f64>>) -> Self;
    fn step(&mut self, world: &mut World, told: &Told<'_>);
    fn position(&self) -> Point3<f64>;
}

/// The filter of this project, with every feature measured at every step as good as exactly. Its
/// model is that of deformation noise that accumulates.
struct AllTold(Ekf, Belief);

impl Oracle for AllTold {
    fn start(model: &WorldModel, features: Vec<Point3<f64>>) -> Self {
        let noise = &model.noise;
        let ekf = Ekf::new(FilterNoise {
            rotation_sigma: 0.0,
            translation_sigma: noise.translation_sigma,
            feature_motion_sigma: noise
                .feature_translation_sigma
                .hypot(noise.feature_deformation_sigma),
            feature_measurement_sigma: TINY,
            structure_measurement_sigma: 0.5,
        });
        let sigma = noise.initial_feature_sigma;
        let belief = Belief::initial(model.start, features, &Matrix6::zeros(), sigma);
        Self(ekf.unwrap(), belief.unwrap())
    }

    fn step(&mut self, world: &mut World, told: &Told<'_>) {
        let all: Vec<FeatureId> = (0..FEATURES).map(FeatureId).collect();
        let measured = world.measure(&all).features;
        let features: Vec<FeatureMeasurement> = measured
            .into_iter()
            .map(|(feature, z)| FeatureMeasurement { feature, z })
            .collect();
        let Self(ekf, belief) = self;
        ekf.predict(belief, told.control, told.moved).unwrap();
        let measurements = Measurements {
            features: &features,
            structure: StructureMeasurements::None,
        };
        ekf.update(belief, &measurements).unwrap();
    }

    fn position(&self) -> Point3<f64> {
        self.1.state.pose.position
    }
}

/// A linear Kalman filter over the robot's position and the place of each feature without its fresh
/// noise. Its measurements are the true positions of all features relative to the robot.
struct Linear {
    /// A row for x and one for each feature, a column for each axis.
    state: DMatrix<f64>,
    covariance: DMatrix<f64>,
    walk: DVector<f64>,
    fresh: f64,
}

impl Oracle for Linear {
    fn start(model: &WorldModel, features: Vec<Point3<f64>>) -> Self {
        let (noise, count) = (&model.noise, model.rest.len());
        let variance = |sigma: f64| sigma * sigma * noise.variance_of_standard();
        let deformation = variance(noise.feature_deformation_sigma);
        let (adds_up, fresh) = match noise.deformation {
            DeformationNoise::Fresh => (0.0, deformation),
            DeformationNoise::Accumulating => (deformation, 0.0),
        };
        let all = |of_robot: f64, of_feature: f64| {
            let mut all = DVector::from_element(count + 1, of_feature);
            all[0] = of_robot;
            all
        };
        let first = variance(noise.initial_feature_sigma) + fresh;
        Self {
            state: DMatrix::from_fn(count + 1, 3, |i, axis| match i {
                0 => model.start.position[axis],
                i => features[i - 1][axis],
            }),
            covariance: DMatrix::from_diagonal(&all(0.0, first)),
            walk: all(
                variance(noise.translation_sigma),
                variance(noise.feature_translation_sigma) + adds_up,
            ),
            fresh,
        }
    }

    fn step(&mut self, world: &mut World, told: &Told<'_>) {
        for axis in 0..3 {
            self.state[(0, axis)] += told.way[axis];
            for (i, d) in told.moved.iter().enumerate() {
                self.state[(i + 1, axis)] += d[axis];
            }
        }
        self.covariance += DMatrix::from_diagonal(&self.walk);
        let count = world.features().len();
        let h = DMatrix::from_fn(count, count + 1, |row, column| {
            f64::from(u8::from(column == row + 1)) - f64::from(u8::from(column == 0))
        });
        let r = DMatrix::identity(count, count) * self.fresh;
        let s = &h * &self.covariance * h.transpose() + r;
        let gain = (s.cholesky().unwrap().solve(&(&h * &self.covariance))).transpose();
        let z = DMatrix::from_fn(count, 3, |i, axis| {
            world.features()[i][axis] - world.pose().position[axis]
        });
        self.state += &gain * (z - &h * &self.state);
        self.covariance -= &gain * &h * &self.covariance;
        self.covariance = (&self.covariance + self.covariance.transpose()) / 2.0;
    }

    fn position(&self) -> Point3<f64> {
        Point3::new(self.state[(0, 0)], self.state[(0, 1)], self.state[(0, 2)])
    }
}

/// The errors of the position after each step but the first, cm.
fn errors<O: Oracle>(model: &WorldModel, seed: u64, steps: usize) -> Vec<f64> {
    let mut world = World::new(model.clone(), seed);
    let mut oracle = O::start(model, world.first_estimate());
    let error = |n: usize| {
        let control = control(n);
        let rest = model.rest.iter();
        let moved: Vec<Vector3<f64>> = rest
            .map(|rest| model.motion.feature_motion(rest, n))
            .collect();
        let told = Told {
            control: &control,
            way: world.pose().orientation.rotation() * control.translation,
            moved: &moved,
        };
        world.advance(&control);
        oracle.step(&mut world, &told);
        (oracle.position() - world.pose().position).norm()
    };
    (1..steps).map(error).collect()
}

/// The error of an estimator that is told everything is the floor, within the standard error.
fn assert_reaches_the_floor<O: Oracle>(model: &WorldModel) {
    let mut floor = DriftFloor::at_start(&model.noise, model.rest.len());
    assert_eq!(floor.expected_error(), 0.0);
    let mut next = || {
        floor.advance();
        floor.expected_error()
    };
    let expected: Vec<f64> = (1..STEPS).map(|_| next()).collect();
    // For each run the mean over the steps of how much the error is off, as a part of the floor.
    let of_run = |seed| {
        let errors = errors::<O>(model, seed, STEPS);
        let parts = errors
            .iter()
            .zip(&expected)
            .map(|(e, floor)| e / floor - 1.0);
        parts.sum::<f64>() / expected.len() as f64
    };
    let runs: Vec<f64> = (1..=RUNS).map(of_run).collect();
    let count = runs.len() as f64;
    let mean = runs.iter().sum::<f64>() / count;
    let variance = runs.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (count - 1.0);
    let standard_error = (variance / count).sqrt();
    assert!(
        standard_error < 0.015,
        "{standard_error}: too few runs to tell"
    );
    assert!(
        mean.abs() < 3.0 * standard_error,
        "{mean} ± {standard_error}"
    );
}

#[test]
fn the_filter_told_everything_reaches_it() {
    assert_reaches_the_floor::<AllTold>(&model(DeformationNoise::Accumulating, None));
}

#[test]
fn a_linear_filter_told_everything_reaches_it() {
    assert_reaches_the_floor::<Linear>(&model(DeformationNoise::Accumulating, None));
    assert_reaches_the_floor::<Linear>(&model(DeformationNoise::Fresh, None));
    assert_reaches_the_floor::<Linear>(&model(DeformationNoise::Fresh, Some(2.0)));
}

/// The real filter sees a part of the object, with noise, and has to find the orientation as well. In
/// the same world, with the same noise, its error is above that of the one that is told everything,
/// whatever the planner.
#[test]
fn every_planner_stays_above_it() {
    let short = ("steps = 100", "steps = 60");
    let accumulating = (
        "[sensor]",
        "deformation_noise = \"accumulating\"\n\n[sensor]",
    );
    for replacements in [&[short] as &[_], &[short, accumulating]] {
        let setup = setup("polygon.toml", replacements);
        let seeds = 1..=16;
        let of_oracle = |seed| errors::<Linear>(&setup.model.world, seed, setup.model.steps);
        let least: f64 = seeds.clone().flat_map(of_oracle).sum();
        for planner in PlannerName::PAPER {
            let of_seed = |seed| Batch {
                setup: &setup,
                planner,
                seed,
                record: true,
            };
            let batch: Vec<Batch<'_>> = seeds.clone().map(of_seed).collect();
            let mut sum = 0.0;
            for result in Batch::run_all(&batch, &Interrupt::new(), &|| ()) {
                let outcome = result.unwrap();
                let steps = outcome.history.unwrap().steps;
                let of_steps = |value: fn(&HistoryMetrics) -> f64| -> f64 {
                    steps.iter().map(|step| value(&step.metrics)).sum()
                };
                let floor = of_steps(|m| m.drift_floor_cm.unwrap()) / steps.len() as f64;
                assert!((floor - outcome.summary.drift_floor_mean).abs() < 1e-6);
                sum += of_steps(|m| m.position_error_cm);
            }
            assert!(sum > least, "{planner}: {sum} below {least}");
        }
    }
}
