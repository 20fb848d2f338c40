//! Algorithm 1 as the paper prints it, every row stacked and S inverted: slow, plain, the oracle. And
//! random beliefs to compare on.
#![allow(dead_code, reason = "each test file uses a part")]

use adslam_estimator::{Belief, Covariance, FeatureMeasurement, FilterNoise, PairMeasurement};
use adslam_models::{
    Control, FeatureId, Pose, State, feature_measurement, feature_measurement_jacobians,
    feature_offset, motion_jacobian, predicted_pose,
};
use nalgebra::{DMatrix, DVector, Point3, Vector3, Vector6};
use proptest::prelude::*;

pub fn covariance_matrix(belief: &Belief) -> DMatrix<f64> {
    let n = belief.covariance.dim();
    DMatrix::from_fn(n, n, |i, j| belief.covariance.entry(i, j))
}

/// χ̂ₙ₊₁|ₙ and Pₙ₊₁|ₙ.
pub fn propagate(
    state: &State,
    p: &DMatrix<f64>,
    control: &Control,
    motion: &[Vector3<f64>],
    noise: &FilterNoise,
) -> (State, DMatrix<f64>) {
    let n = p.nrows();
    let mut f = DMatrix::identity(n, n);
    f.view_mut((0, 0), (6, 6))
        .copy_from(&motion_jacobian(&state.pose, control));
    let q = DVector::from_fn(n, |i, _| match i {
        0..3 => noise.rotation_sigma.powi(2),
        3..6 => noise.translation_sigma.powi(2),
        _ => noise.feature_motion_sigma.powi(2),
    });
    let mut predicted = state.clone();
    predicted.pose = predicted_pose(&state.pose, control);
    predicted.move_features(motion);
    (
        predicted,
        &f * p * f.transpose() + DMatrix::from_diagonal(&q),
    )
}

/// The stacked H, O's diagonal and y at the predicted state.
pub fn stacked(
    state: &State,
    features: &[FeatureMeasurement],
    pairs: &[PairMeasurement],
    noise: &FilterNoise,
) -> (DMatrix<f64>, DVector<f64>, DVector<f64>) {
    let rows = 3 * (features.len() + pairs.len());
    let mut h = DMatrix::zeros(rows, state.dim());
    let mut o = DVector::zeros(rows);
    let mut y = DVector::zeros(rows);
    for (m, measurement) in features.iter().enumerate() {
        let p = &state.features[measurement.feature.0];
        let jacobian = feature_measurement_jacobians(&state.pose, p);
        h.view_mut((3 * m, 0), (3, 6)).copy_from(&jacobian.pose);
        let offset = feature_offset(measurement.feature);
        h.view_mut((3 * m, offset), (3, 3))
            .copy_from(&jacobian.feature);
        let innovation = measurement.z - feature_measurement(&state.pose, p);
        y.rows_mut(3 * m, 3).copy_from(&innovation);
        o.rows_mut(3 * m, 3)
            .fill(noise.feature_measurement_sigma.powi(2));
    }
    for (m, pair) in pairs.iter().enumerate() {
        let row = 3 * (features.len() + m);
        for a in 0..3 {
            h[(row + a, feature_offset(pair.to) + a)] = 1.0;
            h[(row + a, feature_offset(pair.from) + a)] = -1.0;
        }
        let expected = state.features[pair.to.0] - state.features[pair.from.0];
        y.rows_mut(row, 3).copy_from(&(pair.z - expected));
        o.rows_mut(row, 3)
            .fill(noise.structure_measurement_sigma.powi(2));
    }
    (h, o, y)
}

/// χ̂ₙ₊₁ and Pₙ₊₁.
pub fn update(
    state: &State,
    p: &DMatrix<f64>,
    features: &[FeatureMeasurement],
    pairs: &[PairMeasurement],
    noise: &FilterNoise,
) -> (State, DMatrix<f64>) {
    let (h, o, y) = stacked(state, features, pairs, noise);
    let s = &h * p * h.transpose() + DMatrix::from_diagonal(&o);
    let gain = p * h.transpose() * s.try_inverse().expect("S is invertible");
    let delta = &gain * y;
    let mut updated = state.clone();
    updated.pose = updated
        .pose
        .plus(&Vector6::from_iterator(delta.rows(0, 6).iter().copied()));
    for (j, point) in updated.features.iter_mut().enumerate() {
        *point += delta.fixed_rows::<3>(6 + 3 * j);
    }
    let n = p.nrows();
    (updated, (DMatrix::identity(n, n) - gain * h) * p)
}

pub fn every_pair(count: usize) -> Vec<(usize, usize)> {
    (0..count)
        .flat_map(|j| (0..j).map(move |i| (i, j)))
        .collect()
}

pub const NOISE: FilterNoise = FilterNoise {
    rotation_sigma: 0.02,
    translation_sigma: 0.03,
    feature_motion_sigma: 0.058,
    feature_measurement_sigma: 0.02,
    structure_measurement_sigma: 0.5,
};

/// A belief with a full, well-conditioned covariance.
pub fn belief(count: usize) -> impl Strategy<Value = Belief> {
    let n = 6 + 3 * count;
    let pose = prop::array::uniform6(-1.2..1.2);
    let features = prop::collection::vec(prop::array::uniform3(-5.0..5.0), count);
    let root = prop::collection::vec(-0.1..0.1, n * n);
    (pose, features, root).prop_map(move |(pose, features, root)| {
        let root = DMatrix::from_vec(n, n, root);
        let p: DMatrix<f64> = &root * root.transpose() + DMatrix::identity(n, n) * 1e-3;
        Belief {
            state: State {
                pose: Pose::from_vector(&Vector6::from(pose)),
                features: features.into_iter().map(Point3::from).collect(),
            },
            covariance: Covariance::from_lower(n, |i, j| p[(i, j)]),
        }
    })
}

pub fn control() -> impl Strategy<Value = Control> {
    prop::array::uniform6(-0.7..0.7).prop_map(|u| Control {
        rotation: Vector3::new(u[0], u[1], u[2]),
        translation: Vector3::new(u[3], u[4], u[5]),
    })
}

pub fn vectors(count: usize, size: f64) -> impl Strategy<Value = Vec<Vector3<f64>>> {
    prop::collection::vec(prop::array::uniform3(-size..size), count)
        .prop_map(|v| v.into_iter().map(Vector3::from).collect())
}

/// Some of the features 0 … count − 1, as ids.
pub fn some_features(count: usize) -> impl Strategy<Value = Vec<FeatureId>> {
    prop::collection::vec(any::<bool>(), count).prop_map(|chosen| {
        chosen
            .iter()
            .enumerate()
            .filter(|(_, c)| **c)
            .map(|(i, _)| FeatureId(i))
            .collect()
    })
}

pub fn assert_close(a: &DMatrix<f64>, b: &DMatrix<f64>, relative: f64) {
    let scale = b.amax();
    assert!(
        (a - b).amax() <= relative * scale,
        "differ by {}",
        (a - b).amax() / scale
    );
}
