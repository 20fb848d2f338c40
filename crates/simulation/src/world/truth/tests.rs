//! The statistics of the world's noise, and what faults change.

use std::sync::Arc;

use adslam_deformation::{BackAndForth, Deformation};
use adslam_models::predicted_pose;

use super::*;
use crate::NOISE;

/// Of a world in which everything goes as planned.
const SILENCE: WorldNoise = WorldNoise {
    rotation_sigma: 0.0,
    translation_sigma: 0.0,
    feature_translation_sigma: 0.0,
    feature_deformation_sigma: 0.0,
    feature_measurement_sigma: 0.0,
    structure_measurement_sigma: 0.0,
    initial_feature_sigma: 0.0,
    ..NOISE
};

fn model(noise: WorldNoise) -> WorldModel {
    let rest = (0..5)
        .map(|i| Point3::new(f64::from(i), 1.0, f64::from(i * i)))
        .collect();
    WorldModel {
        start: Pose::default(),
        rest,
        motion: ObjectMotion::default(),
        noise,
        faults: Faults::default(),
    }
}

#[test]
fn noise_does_not_depend_on_what_is_seen_or_done() {
    let model = model(NOISE);
    let (mut a, mut b) = (World::new(model.clone(), 7), World::new(model.clone(), 7));
    let turn = Control {
        rotation: Vector3::z(),
        ..Control::default()
    };
    for _ in 0..3 {
        a.advance(&Control::default());
        b.advance(&turn);
        let all: Vec<FeatureId> = (0..5).map(FeatureId).collect();
        assert_eq!(
            a.measure(&[]).structure_sums,
            b.measure(&all).structure_sums
        );
    }
    assert_eq!(a.features(), b.features());
    assert_ne!(
        World::new(model.clone(), 8).features(),
        World::new(model.clone(), 7).features()
    );
}

/// What is measured is what it would have been, but for the features that are missed, those with
/// a gross error, and the structure that is dropped.
#[test]
fn faults_change_what_they_strike_and_nothing_else() {
    let faults = Faults {
        outlier_probability: 0.3,
        outlier_sigma: 10.0,
        missed_detection_probability: 0.3,
        dropped_structure_probability: 0.5,
    };
    let sound = model(NOISE);
    let faulty = WorldModel {
        faults,
        ..sound.clone()
    };
    let (mut a, mut b) = (World::new(sound.clone(), 7), World::new(faulty.clone(), 7));
    assert_eq!(a.first_estimate(), b.first_estimate());
    let all: Vec<FeatureId> = (0..5).map(FeatureId).collect();
    let mut counts = FaultCounts::default();
    for _ in 0..40 {
        a.advance(&Control::default());
        b.advance(&Control::default());
        let (expected, found) = (a.measure(&all), b.measure(&all));
        let exact = found
            .features
            .iter()
            .filter(|z| expected.features.contains(z));
        assert_eq!(exact.count() + found.faults.outliers, found.features.len());
        assert_eq!(5 - found.features.len(), found.faults.missed_detections);
        match found.structure_sums {
            Some(sums) => assert_eq!(Some(sums), expected.structure_sums),
            None => assert_eq!(found.faults.dropped_structures, 1),
        }
        assert_eq!(expected.faults, FaultCounts::default());
        counts += found.faults;
    }
    let FaultCounts {
        outliers,
        missed_detections,
        dropped_structures,
    } = counts;
    assert!((20..70).contains(&outliers), "{outliers}");
    assert!((35..85).contains(&missed_detections), "{missed_detections}");
    assert!(
        (8..32).contains(&dropped_structures),
        "{dropped_structures}"
    );
}

/// Variance over many runs of one coordinate after some steps: σ_t² per step, and σ_d² once
/// (fresh) or per step (accumulating).
#[test]
fn deformation_noise_is_fresh_or_accumulates() {
    for (deformation, expected) in [
        (
            DeformationNoise::Fresh,
            16.0 * 0.03f64.powi(2) + 0.05f64.powi(2),
        ),
        (
            DeformationNoise::Accumulating,
            16.0 * (0.03f64.powi(2) + 0.05f64.powi(2)),
        ),
    ] {
        let model = model(WorldNoise {
            deformation,
            ..NOISE
        });
        let mut squares = 0.0;
        let runs = 1500;
        for seed in 0..runs {
            let mut world = World::new(model.clone(), seed);
            for _ in 0..16 {
                world.advance(&Control::default());
            }
            let errors = world
                .features()
                .iter()
                .zip(&model.rest)
                .map(|(p, r)| (p - r).x);
            squares += errors.map(|e| e * e).sum::<f64>() / 5.0;
        }
        let variance = squares / runs as f64;
        // The standard error of a variance from 7500 draws is 1.6 %.
        assert!(
            (variance / expected - 1.0).abs() < 0.08,
            "{variance} is not {expected}"
        );
    }
}

/// The sums must have the mean and covariance of summed independent pairs.
#[test]
fn structure_sums_are_distributed_as_summed_pairs() {
    let model = model(NOISE);
    let (count, runs) = (5.0, 4000);
    let mut world = World::new(model.clone(), 3);
    let features = world.features().to_vec();
    let total: Vector3<f64> = features.iter().map(|p| p.coords).sum();
    let (mut own, mut cross, mut sum) = (0.0, 0.0, 0.0);
    for _ in 0..runs {
        let sums = world.measure(&[]).structure_sums.unwrap();
        let noise = |i: usize| (sums[i] - (features[i].coords * count - total)).x;
        own += noise(0) * noise(0);
        cross += noise(1) * noise(3);
        sum += (0..5).map(noise).sum::<f64>().abs();
    }
    let variance = 0.25;
    assert!((own / f64::from(runs) / (variance * 4.0) - 1.0).abs() < 0.1);
    assert!((cross / f64::from(runs) / -variance - 1.0).abs() < 0.3);
    assert!(
        sum < 1e-6,
        "the noise of all pairs cancels in the sum over features"
    );
}

#[test]
fn truncation_cuts_the_tails() {
    for limit in [0.5, 1.0, 2.0, 6.0] {
        let noise = WorldNoise {
            truncate_at_sigmas: Some(limit),
            ..NOISE
        };
        let mut generator = stream(1, Stream::Sensor);
        let draws: Vec<f64> = (0..40_000)
            .map(|_| noise.standard(&mut generator))
            .collect();
        let largest = draws.iter().map(|x| x.abs()).fold(0.0, f64::max);
        assert!(largest <= limit && largest > 0.6 * limit, "{largest}");
        let variance = draws.iter().map(|x| x * x).sum::<f64>() / draws.len() as f64;
        // The relative standard error is that of a Gaussian at most, √(2/40 000) = 0.7 %.
        let ratio = variance / noise.variance_of_standard();
        assert!((ratio - 1.0).abs() < 0.022, "{limit}: {ratio}");
    }
    assert_eq!(NOISE.variance_of_standard(), 1.0);
}

/// Ten centimetres along z for each step.
#[derive(Debug)]
struct Rise;

impl Deformation for Rise {
    fn mode_count(&self) -> usize {
        1
    }

    fn mode(&self, _: usize, _: &Point3<f64>) -> Vector3<f64> {
        Vector3::z()
    }

    fn amount(&self, _: usize, time: f64) -> f64 {
        10.0 * time
    }
}

#[test]
fn without_noise_everything_is_where_it_is_planned_to_be() {
    for deformation in [DeformationNoise::Fresh, DeformationNoise::Accumulating] {
        let mut model = model(WorldNoise {
            deformation,
            ..SILENCE
        });
        model.motion.translation = Arc::new(BackAndForth::new(Vector3::x()));
        model.motion.deformation = Arc::new(Rise);
        model.start = Pose::from_vector(&Vector6::new(0.1, 0.2, 0.3, 4.0, 5.0, 6.0));
        let control = Control {
            rotation: Vector3::new(0.01, -0.02, 0.3),
            translation: Vector3::new(0.5, 0.0, -0.25),
        };
        let mut world = World::new(model.clone(), 1);
        let mut pose = model.start;
        for (step, forth) in [(1, 0.0), (2, 1.0), (3, 0.0), (4, 1.0)] {
            assert_eq!((world.step(), *world.pose()), (step, pose));
            let shift = Vector3::new(forth, 0.0, 10.0 * step as f64);
            for (p, rest) in world.features().iter().zip(&model.rest) {
                assert!((p - (rest + shift)).norm() < 1e-12, "{p}");
            }
            assert_eq!(world.first_estimate(), world.features());
            let measured = world.measure(&[FeatureId(3)]);
            let place =
                pose.orientation.rotation().inverse() * (world.features()[3] - pose.position);
            assert_eq!(measured.features.len(), 1);
            assert!((measured.features[0].1 - place).norm() < 1e-12);
            pose = predicted_pose(&pose, &control);
            world.advance(&control);
        }
    }
}

#[test]
fn noise_that_accumulates_has_not_begun_at_the_start() {
    let noise = WorldNoise {
        deformation: DeformationNoise::Accumulating,
        ..NOISE
    };
    let model = model(noise);
    assert_eq!(World::new(model.clone(), 1).features(), model.rest);
}

/// The variances of robot, measurement and first estimate over many runs, each within four standard errors.
#[test]
fn each_noise_has_its_own_sigma() {
    let noise = WorldNoise {
        feature_measurement_sigma: 0.7,
        initial_feature_sigma: 0.4,
        ..NOISE
    };
    let model = model(noise);
    let runs = 1500;
    let (mut motion, mut measured, mut first) = (Vector6::zeros(), 0.0, 0.0);
    for seed in 0..runs {
        let mut world = World::new(model.clone(), seed);
        let error = world.first_estimate()[1] - world.features()[1];
        first += error.norm_squared() / 3.0;
        world.advance(&Control::default());
        let moved = world.pose().to_vector();
        motion += moved.component_mul(&moved);
        let z = world.measure(&[FeatureId(2)]).features[0].1;
        let error = z - feature_measurement(world.pose(), &world.features()[2]);
        measured += error.norm_squared() / 3.0;
    }
    let check = |sum: f64, sigma: f64, draws: f64| {
        let ratio = sum / runs as f64 / (sigma * sigma);
        assert!(
            (ratio - 1.0).abs() < 4.0 * (2.0 / draws).sqrt(),
            "{sigma}: {ratio}"
        );
    };
    for k in 0..6 {
        check(motion[k], if k < 3 { 0.02 } else { 0.03 }, runs as f64);
    }
    check(measured, 0.7, 3.0 * runs as f64);
    check(first, 0.4, 3.0 * runs as f64);
}
