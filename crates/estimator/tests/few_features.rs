//! The smallest updates, and numbers that are too large for any.
#![allow(
    clippy::unwrap_used,
    reason = "a helper that fails is a test that fails"
)]

mod common;

use adslam_estimator::{
    Belief, Ekf, Estimator, EstimatorError as E, FeatureMeasurement, Measurements, PairMeasurement,
    StructureMeasurements,
};
use adslam_models::{Control, FeatureId, Pose, State};
use common::{NOISE, assert_close, covariance_matrix};
use nalgebra::{DMatrix, Matrix6, Point3, Vector3};

fn assert_same(belief: &Belief, state: &State, p: &DMatrix<f64>) {
    assert!(belief.state.pose.minus(&state.pose).amax() < 1e-9);
    for (a, b) in belief.state.features.iter().zip(&state.features) {
        assert!((a - b).norm() < 1e-9, "{a} and {b}");
    }
    assert_close(&covariance_matrix(belief), p, 1e-9);
}

#[test]
fn two_features_are_one_pair_and_one_is_none() -> Result<(), E> {
    let features = vec![Point3::new(1.0, 0.0, 0.0), Point3::new(2.0, 1.0, 0.0)];
    let start = Belief::initial(Pose::default(), features, &Matrix6::identity(), 0.4)?;
    let pairs = [PairMeasurement {
        from: FeatureId(0),
        to: FeatureId(1),
        z: Vector3::new(1.1, 0.8, 0.3),
    }];
    let p = covariance_matrix(&start);
    let (state, p) = common::update(&start.state, &p, &[], &pairs, &NOISE);
    let mut belief = start.clone();
    let (structure, features) = (StructureMeasurements::Pairs(&pairs), &[][..]);
    Ekf::new(NOISE)?.update(
        &mut belief,
        &Measurements {
            features,
            structure,
        },
    )?;
    assert_same(&belief, &state, &p);
    let lone = vec![Point3::new(1.0, 0.0, 0.0)];
    let start = Belief::initial(Pose::default(), lone, &Matrix6::identity(), 0.4)?;
    let mut belief = start.clone();
    let structure = StructureMeasurements::AllPairsSummed(&[Vector3::zeros()]);
    let report = Ekf::new(NOISE)?.update(
        &mut belief,
        &Measurements {
            features,
            structure,
        },
    )?;
    assert_eq!(report.structure.dof, 0);
    assert_same(&belief, &start.state, &covariance_matrix(&start));
    Ok(())
}

#[test]
fn numbers_that_are_not_finite_go_into_no_state() {
    let lone = vec![Point3::new(1.0, 0.0, 0.0)];
    let fresh = || Belief::initial(Pose::default(), lone.clone(), &Matrix6::zeros(), 0.1).unwrap();
    let mut ekf = Ekf::new(NOISE).unwrap();
    let nowhere = [Vector3::new(0.0, f64::NAN, 0.0)];
    let error = ekf.predict(&mut fresh(), &Control::default(), &nowhere);
    let what = "motion of the features";
    assert_eq!(error.unwrap_err(), E::NotFinite { what });
    // Finite, but not in sigmas.
    let far = FeatureMeasurement {
        feature: FeatureId(0),
        z: Vector3::repeat(1e308),
    };
    let structure = StructureMeasurements::None;
    let error = ekf.update(
        &mut fresh(),
        &Measurements {
            features: &[far],
            structure,
        },
    );
    let what = "correction of the state";
    assert_eq!(error.unwrap_err(), E::NotFinite { what });
}
