//! The filter against Algorithm 1 as printed, on random beliefs and measurements.

mod common;

use adslam_estimator::{
    Belief, Covariance, Ekf, Estimator, FeatureMeasurement, Measurements, PairMeasurement,
    StructureMeasurements,
};
use adslam_models::{Control, FeatureId, Pose, feature_measurement};
use common::{NOISE, assert_close, covariance_matrix};
use nalgebra::{DMatrix, Matrix6, Point3, Vector3};
use proptest::prelude::*;

fn measure_features(
    belief: &Belief,
    visible: &[FeatureId],
    noise: &[Vector3<f64>],
) -> Vec<FeatureMeasurement> {
    let measure = |&feature: &FeatureId| FeatureMeasurement {
        feature,
        z: feature_measurement(&belief.state.pose, &belief.state.features[feature.0])
            + noise[feature.0],
    };
    visible.iter().map(measure).collect()
}

fn measure_pairs(
    belief: &Belief,
    pairs: &[(usize, usize)],
    noise: &[Vector3<f64>],
) -> Vec<PairMeasurement> {
    pairs
        .iter()
        .enumerate()
        .map(|(k, &(i, j))| PairMeasurement {
            from: FeatureId(i),
            to: FeatureId(j),
            z: belief.state.features[j] - belief.state.features[i] + noise[k % noise.len()] * 5.0,
        })
        .collect()
}

fn check_equal(belief: &Belief, state: &adslam_models::State, p: &DMatrix<f64>) {
    let pose_error = belief.state.pose.minus(&state.pose);
    assert!(pose_error.amax() < 1e-9, "pose differs by {pose_error}");
    for (a, b) in belief.state.features.iter().zip(&state.features) {
        assert!((a - b).norm() < 1e-9, "feature {a} is {b} in the oracle");
    }
    assert_close(&covariance_matrix(belief), p, 1e-9);
}

const COUNT: usize = 6;

proptest! {
    #[test]
    fn propagation_is_the_printed_one(
        mut belief in common::belief(COUNT),
        control in common::control(),
        motion in common::vectors(COUNT, 0.3)
    ) {
        let p = covariance_matrix(&belief);
        let (state, p) = common::propagate(&belief.state, &p, &control, &motion, &NOISE);
        Ekf::new(NOISE)?.predict(&mut belief, &control, &motion)?;
        check_equal(&belief, &state, &p);
    }

    #[test]
    fn update_with_any_pairs_is_the_printed_one(
        mut belief in common::belief(COUNT),
        visible in common::some_features(COUNT),
        chosen in prop::collection::vec(0usize..3, COUNT * (COUNT - 1) / 2),
        noise in common::vectors(COUNT, 0.1)
    ) {
        // Each pair not at all, once or twice.
        let pairs: Vec<(usize, usize)> = common::every_pair(COUNT)
            .into_iter()
            .zip(&chosen)
            .flat_map(|(pair, &times)| std::iter::repeat_n(pair, times))
            .collect();
        let features = measure_features(&belief, &visible, &noise);
        let pairs = measure_pairs(&belief, &pairs, &noise);
        let p = covariance_matrix(&belief);
        let (state, p) = common::update(&belief.state, &p, &features, &pairs, &NOISE);
        let structure = StructureMeasurements::Pairs(&pairs);
        Ekf::new(NOISE)?.update(&mut belief, &Measurements { features: &features, structure })?;
        check_equal(&belief, &state, &p);
    }

    #[test]
    fn all_pairs_collapse_to_their_sums(
        mut belief in common::belief(COUNT),
        visible in common::some_features(COUNT),
        noise in common::vectors(COUNT * (COUNT - 1) / 2, 0.1)
    ) {
        let features = measure_features(&belief, &visible, &noise);
        let pairs = measure_pairs(&belief, &common::every_pair(COUNT), &noise);
        let mut sums = vec![Vector3::zeros(); COUNT];
        for pair in &pairs {
            sums[pair.to.0] += pair.z;
            sums[pair.from.0] -= pair.z;
        }
        let p = covariance_matrix(&belief);
        let (state, p) = common::update(&belief.state, &p, &features, &pairs, &NOISE);
        let mut from_list = belief.clone();
        let mut ekf = Ekf::new(NOISE)?;
        let structure = StructureMeasurements::AllPairsSummed(&sums);
        ekf.update(&mut belief, &Measurements { features: &features, structure })?;
        check_equal(&belief, &state, &p);
        let structure = StructureMeasurements::Pairs(&pairs);
        ekf.update(&mut from_list, &Measurements { features: &features, structure })?;
        check_equal(&from_list, &state, &p);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn covariance_stays_symmetric_positive_definite_over_long_runs(
        steps in prop::collection::vec(
            (common::control(), common::some_features(10), common::vectors(10, 0.05)), 300
        ),
        measurement_sigma in prop::sample::select(vec![1e-4, 0.02, 3.0]),
        structure_sigma in prop::sample::select(vec![1e-4, 0.5, 30.0])
    ) {
        let noise = adslam_estimator::FilterNoise {
            feature_measurement_sigma: measurement_sigma,
            structure_measurement_sigma: structure_sigma,
            ..NOISE
        };
        let features: Vec<Point3<f64>> =
            (0..10u8).map(|i| Point3::new(f64::from(i), f64::from(i * i % 7), f64::from(i % 3))).collect();
        let mut belief =
            Belief::initial(Pose::default(), features, &Matrix6::zeros(), 0.02)?;
        let mut ekf = Ekf::new(noise)?;
        for (control, visible, errors) in &steps {
            // A tenth of the motion, so that a run stays near the object.
            let slow = Control { rotation: control.rotation * 0.1, translation: control.translation * 0.1 };
            ekf.predict(&mut belief, &slow, errors)?;
            let features = measure_features(&belief, visible, errors);
            let pairs = measure_pairs(&belief, &common::every_pair(10), errors);
            let before = belief.covariance.trace();
            let structure = StructureMeasurements::Pairs(&pairs);
            ekf.update(&mut belief, &Measurements { features: &features, structure })?;
            prop_assert!(belief.covariance.trace() <= before);
            let p = covariance_matrix(&belief);
            prop_assert_eq!(&p, &p.transpose());
            prop_assert!(belief.covariance.is_positive_definite());
        }
    }
}

#[test]
fn measurements_that_cannot_be_used_are_refused() {
    use adslam_estimator::EstimatorError as E;
    let features = vec![Point3::new(1.0, 0.0, 0.0), Point3::new(2.0, 1.0, 0.0)];
    let fresh =
        || Belief::initial(Pose::default(), features.clone(), &Matrix6::identity(), 0.1).unwrap();
    let mut ekf = Ekf::new(NOISE).unwrap();
    let seen = |id: usize, z: f64| FeatureMeasurement {
        feature: FeatureId(id),
        z: Vector3::repeat(z),
    };
    let mut update = |features: &[FeatureMeasurement], structure| {
        ekf.update(
            &mut fresh(),
            &Measurements {
                features,
                structure,
            },
        )
        .unwrap_err()
    };
    let none = StructureMeasurements::None;
    assert_eq!(
        update(&[seen(2, 0.0)], none),
        E::UnknownFeature {
            feature: FeatureId(2),
            last: 1
        }
    );
    assert_eq!(
        update(&[seen(1, 0.0), seen(1, 0.0)], none),
        E::RepeatedFeature(FeatureId(1))
    );
    assert_eq!(
        update(&[seen(1, f64::NAN)], none),
        E::NotFinite {
            what: "feature measurement"
        }
    );
    let to_itself = [PairMeasurement {
        from: FeatureId(1),
        to: FeatureId(1),
        z: Vector3::zeros(),
    }];
    assert_eq!(
        update(&[], StructureMeasurements::Pairs(&to_itself)),
        E::SelfPair(FeatureId(1))
    );
    let sums = [Vector3::zeros(); 3];
    let wrong = update(&[], StructureMeasurements::AllPairsSummed(&sums));
    assert!(matches!(
        wrong,
        E::WrongCount {
            found: 3,
            expected: 2,
            ..
        }
    ));
    let mut belief = fresh();
    let error = ekf
        .predict(&mut belief, &Control::default(), &[Vector3::zeros()])
        .unwrap_err();
    assert!(matches!(
        error,
        E::WrongCount {
            found: 1,
            expected: 2,
            ..
        }
    ));
    belief.state.features.pop();
    let one_too_many = E::WrongCount {
        what: "the covariance",
        found: 2,
        expected: 1,
    };
    let nothing = Measurements {
        features: &[],
        structure: none,
    };
    let error = ekf.update(&mut belief, &nothing).unwrap_err();
    assert_eq!(error, one_too_many);
    let error = ekf
        .predict(&mut belief, &Control::default(), &[Vector3::zeros()])
        .unwrap_err();
    assert_eq!(error, one_too_many);
    let mut belief = fresh();
    let infinite = Control {
        translation: Vector3::repeat(f64::INFINITY),
        ..Control::default()
    };
    let error = ekf
        .predict(&mut belief, &infinite, &[Vector3::zeros(); 2])
        .unwrap_err();
    assert_eq!(error, E::NotFinite { what: "control" });
    let mut broken = fresh();
    broken.covariance = Covariance::from_lower(12, |i, j| match (i, j) {
        (1, 0) => 50.0,
        _ => f64::from(u8::from(i == j)),
    });
    let measurement = [seen(0, 1.0), seen(1, 1.0)];
    let measurements = Measurements {
        features: &measurement,
        structure: none,
    };
    let error = ekf.update(&mut broken, &measurements).unwrap_err();
    assert!(
        matches!(error, E::NotPositiveDefinite { .. } | E::BadVariance { .. }),
        "{error}"
    );
}
