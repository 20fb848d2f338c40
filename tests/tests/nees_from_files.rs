//! The files of a run suffice to say how consistent its estimator was: the pose NEES by the formulas of docs/run.md.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a helper that fails is a test that fails"
)]

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::fs;
use std::path::Path;

use adslam_diagnostics::Interrupt;
use adslam_experiment::run::{RunRecorder, RunReport, simulate};
use adslam_names::{EstimatorName, LengthUnit, PlannerName};
use adslam_tests::setup;
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

const COMPONENTS: [&str; 6] = ["roll", "pitch", "yaw", "x", "y", "z"];

/// The rows of a CSV file, by the heads of its columns.
fn rows(path: &Path) -> Vec<BTreeMap<String, String>> {
    let text = fs::read_to_string(path).unwrap();
    let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned));
    let heads: Vec<String> = lines.next().unwrap().collect();
    lines
        .map(|cells| heads.iter().cloned().zip(cells).collect())
        .collect()
}

fn pose(row: &BTreeMap<String, String>, whose: &str) -> Vector6<f64> {
    Vector6::from_fn(|i, _| {
        let unit = if i < 3 { "rad" } else { "cm" };
        row[&format!("{whose}_{}_{unit}", COMPONENTS[i])]
            .parse()
            .unwrap()
    })
}

fn covariance(row: &BTreeMap<String, String>) -> Matrix6<f64> {
    Matrix6::from_fn(|i, j| {
        let (i, j) = (i.min(j), i.max(j));
        let unit = match (i < 3, j < 3) {
            (true, true) => "rad2",
            (true, false) => "rad_times_cm",
            (false, _) => "cm2",
        };
        row[&format!("{}_{}_{unit}", COMPONENTS[i], COMPONENTS[j])]
            .parse()
            .unwrap()
    })
}

/// R = Rz(yaw) Ry(pitch) Rx(roll), written out.
fn rotation(pose: &Vector6<f64>) -> Matrix3<f64> {
    let [(sr, cr), (sp, cp), (sy, cy)] = [0, 1, 2].map(|i| pose[i].sin_cos());
    let rx = Matrix3::new(1.0, 0.0, 0.0, 0.0, cr, -sr, 0.0, sr, cr);
    let ry = Matrix3::new(cp, 0.0, sp, 0.0, 1.0, 0.0, -sp, 0.0, cp);
    let rz = Matrix3::new(cy, -sy, 0.0, sy, cy, 0.0, 0.0, 0.0, 1.0);
    rz * ry * rx
}

/// θ with exp(θ) = R.
fn rotation_vector(r: &Matrix3<f64>) -> Vector3<f64> {
    let sine = Vector3::new(
        r[(2, 1)] - r[(1, 2)],
        r[(0, 2)] - r[(2, 0)],
        r[(1, 0)] - r[(0, 1)],
    ) / 2.0;
    let angle = sine.norm().atan2((r.trace() - 1.0) / 2.0);
    sine * (angle / sine.norm())
}

/// J(θ)⁻¹.
fn inverse_jacobian(theta: &Vector3<f64>) -> Matrix3<f64> {
    let (angle, cross) = (theta.norm(), theta.cross_matrix());
    let of_square = (1.0 - angle / (2.0 * (angle / 2.0).tan())) / (angle * angle);
    Matrix3::identity() - 0.5 * cross + of_square * cross * cross
}

/// W(Θ).
fn axes(pose: &Vector6<f64>) -> Matrix3<f64> {
    let ((sp, cp), (sy, cy)) = (pose[1].sin_cos(), pose[2].sin_cos());
    Matrix3::new(cy * cp, -sy, 0.0, sy * cp, cy, 0.0, -sp, 0.0, 1.0)
}

/// e of docs/run.md.
fn error(estimator: EstimatorName, truth: &Vector6<f64>, estimate: &Vector6<f64>) -> Vector6<f64> {
    let difference = truth - estimate;
    let of_position = difference.fixed_rows::<3>(3).into_owned();
    let theta = rotation_vector(&(rotation(truth) * rotation(estimate).transpose()));
    let turned = axes(estimate).try_inverse().unwrap() * theta;
    let (angles, position) = match estimator {
        EstimatorName::EULER_EKF => {
            let wrapped = |x: f64| x.sin().atan2(x.cos());
            let one = difference.fixed_rows::<3>(0).map(wrapped);
            // The same orientation by other angles.
            let other = Vector3::new(truth[0] + PI, PI - truth[1], truth[2] + PI);
            let other = (other - estimate.fixed_rows::<3>(0)).map(wrapped);
            let angles = if other.norm() < one.norm() {
                other
            } else {
                one
            };
            (angles, of_position)
        }
        EstimatorName::SO3_EKF => (turned, of_position),
        EstimatorName::RIGHT_INVARIANT_EKF => (turned, inverse_jacobian(&theta) * of_position),
        other => unreachable!("{other} is none of ours"),
    };
    let mut error = Vector6::zeros();
    error.fixed_rows_mut::<3>(0).copy_from(&angles);
    error.fixed_rows_mut::<3>(3).copy_from(&position);
    error
}

#[track_caller]
fn assert_near(found: f64, expected: f64) {
    assert!(
        (found - expected).abs() <= 1e-9 * expected.abs(),
        "{found} and {expected}"
    );
}

#[test]
fn pose_nees_of_every_step_and_estimator() {
    let mut means = Vec::new();
    for estimator in EstimatorName::OURS {
        let filter = format!("[filter]\nestimator = \"{estimator}\"\n\n[noise]");
        let noisy = "rotation_sigma_rad = 0.05";
        let setup = setup(
            "polygon.toml",
            &[
                ("steps = 100", "steps = 40"),
                ("[noise]", &filter),
                ("rotation_sigma_rad = 0.02", noisy),
            ],
        );
        let folder = tempfile::tempdir().unwrap();
        let planner = PlannerName::LOCAL;
        let mut recorder =
            RunRecorder::create(folder.path(), &setup, planner, 3, LengthUnit::M).unwrap();
        let outcome = simulate(&setup, planner, 3, &Interrupt::new(), &mut recorder).unwrap();
        let report = RunReport {
            summary: &outcome.summary,
            warnings: &outcome.warnings,
        };
        recorder.commit(&report, Vec::new()).unwrap();

        let steps = rows(&folder.path().join("steps.csv"));
        let covariances = rows(&folder.path().join("pose_covariance.csv"));
        assert_eq!((steps.len(), covariances.len()), (40, 40));
        let mut found = Vec::new();
        for (step, covariance_row) in steps.iter().zip(&covariances) {
            assert_eq!(step["step"], covariance_row["step"]);
            let p = covariance(covariance_row);
            let sigma: f64 = step["sigma_pitch_rad"].parse().unwrap();
            assert_near(p[(1, 1)].sqrt(), sigma);
            let Some(factor) = p.cholesky() else {
                assert_eq!(step["pose_nees"], "", "step {}", step["step"]);
                continue;
            };
            let e = error(estimator, &pose(step, "true"), &pose(step, "estimated"));
            let nees = e.dot(&factor.solve(&e));
            assert_near(nees, step["pose_nees"].parse().unwrap());
            found.push(nees);
        }
        assert!(found.len() > 35, "only the start has none");
        let mean = found.iter().sum::<f64>() / found.len() as f64;
        let summary = fs::read_to_string(folder.path().join("summary.json")).unwrap();
        let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
        assert_near(mean, summary["pose_nees_mean"].as_f64().unwrap());
        means.push(mean);
    }
    // Else a formula for all of them would do.
    let [a, b, c] = means[..] else {
        panic!("{means:?}")
    };
    for (one, other) in [(a, b), (b, c), (a, c)] {
        assert!((one - other).abs() > 1e-4 * one, "{means:?}");
    }
}
