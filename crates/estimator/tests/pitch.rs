//! Near pitch ±90° the estimators that turn their orientation convert covariances that angles can hardly hold. They
//! are right to six digits there or refuse, held against their textbook form, which has no angles in its
//! covariance.
#![allow(
    clippy::unwrap_used,
    reason = "a helper that fails is a test that fails"
)]

mod common;
mod exact;
mod textbook;

use adslam_estimator::{
    Belief, Ekf, Estimator, EstimatorError, FeatureMeasurement, Measurements, RightInvariantError,
    So3Error, StructureMeasurements,
};
use adslam_models::{Control, FeatureId, Pose, feature_measurement};
use common::NOISE;
use nalgebra::{DMatrix, Matrix6, Point3, Vector3, Vector6};
use textbook::{RIGHT_INVARIANT, SO3, Textbook};

/// Where the pitch is before the motion, degrees.
const START_DEG: f64 = 60.0;

fn start() -> Belief {
    let pose = Pose::from_vector(&Vector6::new(
        0.2,
        START_DEG.to_radians(),
        -0.4,
        1.0,
        0.5,
        0.0,
    ));
    let features = [[4.0, 1.0, 0.0], [1.0, -3.0, 2.0], [-2.0, 2.0, -3.0]];
    let covariance = Matrix6::identity() * 1e-3;
    Belief::initial(pose, features.map(Point3::from).to_vec(), &covariance, 0.1).unwrap()
}

/// A motion that ends this many degrees from pitch 90°, and an update that turns the estimate by about `correction`
/// radians: the largest part of a variance, in any direction, by which the result differs from the textbook's.
fn error(
    estimator: &mut dyn Estimator,
    form: Textbook,
    from_right_angle_deg: f64,
    correction: f64,
) -> Result<f64, EstimatorError> {
    let mut belief = start();
    let control = Control {
        rotation: Vector3::new(
            0.0,
            (90.0 - START_DEG - from_right_angle_deg).to_radians(),
            0.1,
        ),
        translation: Vector3::new(0.3, 0.0, 0.1),
    };
    let motion = [Vector3::new(0.1, 0.0, -0.1); 3];
    let p = form.covariance_from_paper(&belief.state, &common::covariance_matrix(&belief));
    let (state, p) = form.predict(&belief.state, &p, &control, &motion, &NOISE);
    estimator.predict(&mut belief, &control, &motion)?;
    let turned = Vector6::new(0.3, 0.8, -0.5, 0.1, 0.1, 0.1) * correction;
    let truth = state.pose.plus(&turned);
    let features: Vec<FeatureMeasurement> = state
        .features
        .iter()
        .enumerate()
        .map(|(i, p)| FeatureMeasurement {
            feature: FeatureId(i),
            z: feature_measurement(&truth, p),
        })
        .collect();
    let right = form.update_stacked(&state, &p, &features, &[], &NOISE);
    let measurements = Measurements {
        features: &features,
        structure: StructureMeasurements::None,
    };
    estimator.update(&mut belief, &measurements)?;
    // In rotations, without rounding what is to be judged.
    let found = exact::between(&form.transformation(&belief.state), &belief);
    let root = right.p.cholesky().unwrap().l();
    let scaled = root.solve_lower_triangular(&found).unwrap();
    let whole = root.solve_lower_triangular(&scaled.transpose()).unwrap();
    Ok((whole - DMatrix::identity(15, 15)).norm())
}

type Made = (Box<dyn Estimator>, Textbook);

fn estimators() -> [Made; 2] {
    [
        (
            Box::new(Ekf::<So3Error>::in_coordinates(NOISE).unwrap()),
            SO3,
        ),
        (
            Box::new(Ekf::<RightInvariantError>::in_coordinates(NOISE).unwrap()),
            RIGHT_INVARIANT,
        ),
    ]
}

#[test]
fn six_digits_are_right_wherever_the_pitch_is_or_it_is_refused() {
    for (mut estimator, form) in estimators() {
        let (mut right, mut refused, mut largest) = (0, 0, 0.0_f64);
        for exponent in -8..=1 {
            for leading in [1.0, 2.0, 5.0] {
                for correction in [0.0, 1e-6, 1e-4, 1e-2, 0.1] {
                    for side in [1.0, -1.0] {
                        let away = side * leading * 10_f64.powi(exponent);
                        match error(&mut *estimator, form, away, correction) {
                            Ok(error) => {
                                assert!(error < 1e-6, "{away}°, {correction}: {error:e}");
                                largest = largest.max(error);
                                right += 1;
                            }
                            Err(EstimatorError::PitchNearRightAngle { .. }) => refused += 1,
                            Err(error) => panic!("{away}°, {correction}: {error}"),
                        }
                    }
                }
            }
        }
        println!("{right} right to {largest:e}, {refused} refused");
        assert!(
            right > 60 && refused > 50,
            "{right} right, {refused} refused"
        );
    }
}

/// Where docs/consistency.md says that it happens.
#[test]
fn the_threshold_is_where_the_page_says() {
    for (mut estimator, form) in estimators() {
        let mut at = |away, correction| error(&mut *estimator, form, away, correction);
        for side in [1.0, -1.0] {
            assert!(at(side * 0.004, 0.0).is_ok(), "nothing to correct");
            assert!(at(side * 0.5, 0.1).is_ok(), "a correction of degrees");
            for away in [0.0, 0.001, 0.003] {
                let error = at(side * away, 0.0).unwrap_err();
                let said = error.to_string();
                assert!(said.contains("too near to 90°"), "{said}");
            }
        }
    }
}
