//! The χ² gate on feature measurements.

#![allow(clippy::panic, reason = "a helper that fails is a test that fails")]

mod common;

use adslam_estimator::{
    Belief, Covariance, EstimatorError, EstimatorKind, FeatureMeasurement, FilterNoise,
    Measurements, Parallelism, StructureMeasurements, UpdateReport,
};
use adslam_models::{FeatureId, Pose, feature_measurement};
use common::{NOISE, covariance_matrix};
use nalgebra::{Matrix6, Point3, Vector3};
use proptest::prelude::*;

const COUNT: usize = 12;
/// 0.999 of χ² with 3 degrees of freedom.
const GATE: f64 = 16.266;

/// The belief after the measurements, what was said of them, and who was kept out.
fn updated(
    kind: EstimatorKind,
    gate: Option<f64>,
    belief: &Belief,
    features: &[FeatureMeasurement],
) -> Result<(Belief, UpdateReport, Vec<FeatureId>), EstimatorError> {
    let mut belief = belief.clone();
    let mut estimator = kind.build(NOISE, gate, Parallelism::Sequential)?;
    let structure = StructureMeasurements::None;
    let report = estimator.update(
        &mut belief,
        &Measurements {
            features,
            structure,
        },
    )?;
    Ok((belief, report, estimator.rejected().to_vec()))
}

/// Measurements just where they are expected, but for the `wrong` ones.
fn measured(belief: &Belief, wrong: &[FeatureId]) -> Vec<FeatureMeasurement> {
    (0..COUNT)
        .map(FeatureId)
        .map(|feature| {
            let z = feature_measurement(&belief.state.pose, &belief.state.features[feature.0]);
            let error = if wrong.contains(&feature) { 50.0 } else { 0.0 };
            FeatureMeasurement {
                feature,
                z: z + Vector3::repeat(error),
            }
        })
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn outliers_are_kept_out_as_if_they_had_not_been_measured(
        belief in common::belief(COUNT), wrong in common::some_features(COUNT)
    ) {
        let all = measured(&belief, &wrong);
        let right: Vec<FeatureMeasurement> =
            all.iter().copied().filter(|m| !wrong.contains(&m.feature)).collect();
        for kind in EstimatorKind::ALL {
            let (gated, report, rejected) = updated(kind, Some(GATE), &belief, &all)?;
            let (clean, without, _) = updated(kind, None, &belief, &right)?;
            prop_assert_eq!(&rejected, &wrong);
            prop_assert_eq!(report.rejected, wrong.len());
            prop_assert_eq!(report.features, without.features);
            prop_assert_eq!(&gated.state, &clean.state);
            prop_assert_eq!(covariance_matrix(&gated), covariance_matrix(&clean));
        }
    }

    /// The distance is yᵀS⁻¹y with S of the one feature: the NIS of an update with it alone.
    #[test]
    fn the_gate_is_at_the_normalised_innovation(
        belief in common::belief(COUNT), feature in 0..COUNT, error in prop::array::uniform3(-0.5..0.5)
    ) {
        let mut measurement = measured(&belief, &[])[feature];
        measurement.z += Vector3::from(error);
        let (_, report, _) = updated(EstimatorKind::EulerEkf, None, &belief, &[measurement])?;
        let distance = report.features.value;
        let rejected = |gate| -> Result<usize, EstimatorError> {
            Ok(updated(EstimatorKind::EulerEkf, Some(gate), &belief, &[measurement])?.1.rejected)
        };
        prop_assert_eq!(rejected(distance * 0.999_999)?, 1);
        prop_assert_eq!(rejected(distance * 1.000_001)?, 0);
    }
}

#[test]
fn a_gate_must_be_a_number_above_zero() {
    for gate in [0.0, -1.0, f64::NAN] {
        let built = EstimatorKind::So3Ekf.build(NOISE, Some(gate), Parallelism::Sequential);
        let error = built.err().expect("it is refused").to_string();
        assert!(error.contains("gate"), "{error}");
    }
    assert!(
        EstimatorKind::So3Ekf
            .build(NOISE, Some(f64::INFINITY), Parallelism::Sequential)
            .is_ok()
    );
}

/// Robot and feature known together to 1e-5 cm, and not at all where: S is what their variances leave of each other.
#[test]
fn a_gate_that_lost_its_digits_says_that_the_sigmas_are_too_far_apart() -> Result<(), EstimatorError>
{
    const FAR: f64 = 1e4;
    let features = vec![Point3::new(1.0, 2.0, 3.0)];
    let start = Belief::initial(Pose::default(), features, &Matrix6::zeros(), 0.0)?;
    // All positions are off by the same, and each by a little of its own.
    let covariance = Covariance::from_lower(9, |i, j| match (i, j) {
        (0..3, _) | (_, 0..3) => f64::from(u8::from(i == j)) * 1e-12,
        _ if i == j => FAR * FAR,
        _ if i % 3 == j % 3 => FAR * FAR - 1e-10,
        _ => 0.0,
    });
    let belief = Belief {
        covariance,
        ..start
    };
    let measurement = FeatureMeasurement {
        feature: FeatureId(0),
        z: belief.state.features[0].coords,
    };
    let noise = FilterNoise {
        feature_measurement_sigma: 1e-5,
        ..NOISE
    };
    let mut estimator =
        EstimatorKind::EulerEkf.build(noise, Some(GATE), Parallelism::Sequential)?;
    let error = estimator.update(
        &mut belief.clone(),
        &Measurements {
            features: &[measurement],
            structure: StructureMeasurements::None,
        },
    );
    match error {
        Err(EstimatorError::TooPrecise { ratio, largest, .. }) => {
            assert!(
                largest < ratio && ratio < 1e8,
                "{ratio:e} against {largest:e}"
            );
        }
        other => panic!("{other:?}"),
    }
    Ok(())
}

/// The same where all variances are small, and the measurement so far off that the gate would keep it out.
#[test]
fn a_gate_judges_its_digits_by_the_size_of_the_terms() -> Result<(), EstimatorError> {
    let features = vec![Point3::new(1.0, 2.0, 3.0)];
    let start = Belief::initial(Pose::default(), features, &Matrix6::zeros(), 0.0)?;
    let covariance = Covariance::from_lower(9, |i, j| match (i, j) {
        (0..3, _) | (_, 0..3) => f64::from(u8::from(i == j)) * 1e-24,
        _ if i == j => 1e-3,
        _ if i % 3 == j % 3 => 1e-3 - 5e-15,
        _ => 0.0,
    });
    let mut belief = Belief {
        covariance,
        ..start
    };
    let measurement = FeatureMeasurement {
        feature: FeatureId(0),
        z: Vector3::zeros(),
    };
    let noise = FilterNoise {
        feature_measurement_sigma: 1e-7,
        ..NOISE
    };
    let mut estimator =
        EstimatorKind::EulerEkf.build(noise, Some(GATE), Parallelism::Sequential)?;
    let refused = estimator.update(
        &mut belief,
        &Measurements {
            features: &[measurement],
            structure: StructureMeasurements::None,
        },
    );
    assert!(
        matches!(refused, Err(EstimatorError::TooPrecise { .. })),
        "{refused:?}"
    );
    Ok(())
}
