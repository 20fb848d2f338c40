//! The laws of error coordinates, and each estimator against its textbook form: propagation, Jacobians and
//! update written in its own error, not in the paper's.

mod common;
mod textbook;

use adslam_estimator::{
    Belief, Ekf, ErrorState, Estimator, EstimatorError, EulerError, FeatureMeasurement,
    Measurements, PairMeasurement, RightInvariantError, So3Error, StructureMeasurements,
};
use adslam_models::lie::{LieGroup, SeK3, So3TimesPoints};
use adslam_models::{Control, FeatureId, Pose, State, feature_measurement};
use common::{NOISE, assert_close, control, covariance_matrix, every_pair, vectors};
use nalgebra::{DMatrix, DVector, Matrix3, Point3, Vector3, Vector6};
use proptest::prelude::*;
use proptest::test_runner::TestCaseError;
use textbook::Textbook;

const COUNT: usize = 6;
const STEP: f64 = 1e-6;

/// δ added in the paper's coordinates, whatever the error is.
fn added(state: &State, delta: &[f64]) -> State {
    let mut moved = state.clone();
    EulerError::retract(&mut moved, delta);
    moved
}

fn retracted<E: ErrorState>(state: &State, delta: &[f64]) -> State {
    let mut moved = state.clone();
    E::retract(&mut moved, delta);
    moved
}

fn difference(a: &State, b: &State) -> f64 {
    DVector::from_vec(EulerError::error(a, b)).amax()
}

/// The derivative by δ of what `at` makes of it, at zero, by central differences.
fn derivative(size: usize, at: impl Fn(&[f64]) -> DVector<f64>) -> DMatrix<f64> {
    let columns: Vec<DVector<f64>> = (0..size)
        .map(|k| {
            let mut delta = vec![0.0; size];
            delta[k] = STEP;
            let forward = at(&delta);
            delta[k] = -STEP;
            (forward - at(&delta)) / (2.0 * STEP)
        })
        .collect();
    DMatrix::from_columns(&columns)
}

fn blocks_of_reset<E: ErrorState>(before: &State, after: &State) -> DMatrix<f64> {
    let mut blocks = Vec::new();
    E::reset(before, after, &mut blocks);
    let mut d = DMatrix::identity(before.dim(), before.dim());
    for (k, block) in blocks.iter().enumerate() {
        let mut place = d.fixed_view_mut::<3, 3>(3 * k, 0);
        place += block;
    }
    d
}

/// `tau` is the group's logarithm of the truth against an estimate, `retraction` exp(τ) of a state.
fn laws<E: ErrorState>(
    estimate: &State,
    truth: &State,
    delta: &[f64],
    tau: impl Fn(&State, &State) -> DVector<f64>,
    retraction: impl Fn(&State, &DVector<f64>) -> Placed,
) -> Result<(), TestCaseError> {
    let size = estimate.dim();
    // ⊞ and its inverse.
    let there = retracted::<E>(estimate, delta);
    let back = DVector::from_vec(E::error(estimate, &there));
    prop_assert!((back - DVector::from_column_slice(delta)).amax() < 1e-9);
    let again = retracted::<E>(estimate, &E::error(estimate, truth));
    prop_assert!(difference(&again, truth) < 1e-9);
    // To first order it is the paper's error.
    let first = derivative(size, |delta| {
        DVector::from_vec(E::error(estimate, &added(estimate, delta)))
    });
    assert_close(&first, &DMatrix::identity(size, size), 1e-7);
    // T, by differences of the group's own logarithm: δ = T⁻¹ τ, and D = T(χ̂⁺)⁻¹ T(χ̂).
    let t = |at: &State| derivative(size, |delta| tau(at, &added(at, delta)));
    let (before, after) = (t(estimate), t(truth));
    let error = &before * DVector::from_vec(E::error(estimate, truth));
    prop_assert!((error - tau(estimate, truth)).amax() < 1e-6);
    let d = after.try_inverse().expect("pitch is off ±π/2") * &before;
    assert_close(&blocks_of_reset::<E>(estimate, truth), &d, 1e-6);
    // ⊞ is the group's exponential.
    let (rotation, points) = retraction(estimate, &(before * DVector::from_column_slice(delta)));
    let found = there.pose.orientation.rotation();
    prop_assert!((found.matrix() - rotation).amax() < 1e-6);
    let positions = std::iter::once(&there.pose.position).chain(&there.features);
    for (p, expected) in positions.zip(points) {
        prop_assert!((p.coords - expected).amax() < 1e-5);
    }
    Ok(())
}

/// Orientation and positions.
type Placed = (DMatrix<f64>, Vec<Vector3<f64>>);

trait Parts: LieGroup + for<'a> From<&'a State> {
    fn parts(self) -> Placed;
}

impl Parts for So3TimesPoints {
    fn parts(self) -> Placed {
        (matrix(&self.rotation), self.points)
    }
}

impl Parts for SeK3 {
    fn parts(self) -> Placed {
        (matrix(&self.rotation), self.points)
    }
}

/// log(X X̂⁻¹).
fn tau_between<G: Parts>(estimate: &State, truth: &State) -> DVector<f64> {
    let inverse = G::from(estimate).inverse();
    G::from(truth).compose(&inverse).log()
}

/// exp(τ) X̂.
fn moved_by<G: Parts>(estimate: &State, tau: &DVector<f64>) -> Placed {
    G::exp(tau).compose(&G::from(estimate)).parts()
}

/// Pitch stays off ±π/2, where the paper's coordinates end.
fn state() -> impl Strategy<Value = State> {
    (prop::array::uniform6(-0.9..0.9), vectors(COUNT, 5.0)).prop_map(|(pose, features)| State {
        pose: Pose::from_vector(&Vector6::from(pose)),
        features: features.into_iter().map(Point3::from).collect(),
    })
}

fn matrix(rotation: &nalgebra::Rotation3<f64>) -> DMatrix<f64> {
    DMatrix::from_column_slice(3, 3, rotation.matrix().as_slice())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn error_coordinates_keep_their_laws(
        estimate in state(),
        // Less than a quarter turn away: the paper's angles of a rotation are not the only ones.
        away in prop::collection::vec(-0.5..0.5, 6 + 3 * COUNT),
        delta in prop::collection::vec(-0.6..0.6, 6 + 3 * COUNT)
    ) {
        let truth = added(&estimate, &away);
        laws::<EulerError>(
            &estimate,
            &truth,
            &delta,
            |a, b| DVector::from_vec(EulerError::error(a, b)),
            |state, tau| So3TimesPoints::from(&added(state, tau.as_slice())).parts(),
        )?;
        laws::<So3Error>(
            &estimate,
            &truth,
            &delta,
            tau_between::<So3TimesPoints>,
            moved_by::<So3TimesPoints>,
        )?;
        laws::<RightInvariantError>(
            &estimate, &truth, &delta, tau_between::<SeK3>, moved_by::<SeK3>,
        )?;
    }

    #[test]
    fn estimators_agree_with_their_textbook_form(
        belief in common::belief(COUNT),
        controls in prop::collection::vec(control(), 4),
        motion in vectors(COUNT, 0.4),
        visible in prop::collection::vec(common::some_features(COUNT), 4),
        noise in vectors(4 * 2 * COUNT, 0.05)
    ) {
        let run = Run { belief, controls, motion, visible, noise };
        run.compare(Ekf::new(NOISE)?, textbook::EULER)?;
        run.compare(Ekf::<So3Error>::in_coordinates(NOISE)?, textbook::SO3)?;
        run.compare(Ekf::<RightInvariantError>::in_coordinates(NOISE)?, textbook::RIGHT_INVARIANT)?;
    }
}

#[test]
fn an_estimator_says_the_error_of_its_own_coordinates() -> Result<(), EstimatorError> {
    let at = |pose: [f64; 6], x: f64| State {
        pose: Pose::from_vector(&Vector6::from(pose)),
        features: vec![Point3::new(x, 2.0, 3.0)],
    };
    let (a, b) = (at([0.1; 6], 1.0), at([0.3, -0.2, 0.4, 1.0, 2.0, 3.0], 1.5));
    let euler = Ekf::new(NOISE)?.error(&a, &b);
    assert_eq!(euler, EulerError::error(&a, &b));
    let so3 = Ekf::<So3Error>::in_coordinates(NOISE)?.error(&a, &b);
    assert_eq!(so3, So3Error::error(&a, &b));
    assert_ne!(so3, euler);
    Ok(())
}

#[test]
fn the_papers_errors_stay_as_they_are_whatever_was_reset_before() {
    let mut blocks = vec![Matrix3::identity()];
    EulerError::reset(&State::default(), &State::default(), &mut blocks);
    assert!(blocks.is_empty());
}

/// A few steps of any kind.
struct Run {
    belief: Belief,
    controls: Vec<Control>,
    motion: Vec<Vector3<f64>>,
    visible: Vec<Vec<FeatureId>>,
    noise: Vec<Vector3<f64>>,
}

impl Run {
    fn compare(&self, mut estimator: impl Estimator, form: Textbook) -> Result<(), TestCaseError> {
        let mut belief = self.belief.clone();
        let mut state = belief.state.clone();
        let mut p = form.covariance_from_paper(&state, &covariance_matrix(&belief));
        let mut truth = state.clone();
        for (n, control) in self.controls.iter().enumerate() {
            let noise = &self.noise[2 * COUNT * n..];
            truth.pose = adslam_models::predicted_pose(&truth.pose, control);
            truth.move_features(&self.motion);
            let features: Vec<FeatureMeasurement> = self.visible[n]
                .iter()
                .map(|&feature| FeatureMeasurement {
                    feature,
                    z: feature_measurement(&truth.pose, &truth.features[feature.0])
                        + noise[feature.0],
                })
                .collect();
            // A graph of some pairs, another at each step.
            let pairs: Vec<PairMeasurement> = every_pair(COUNT)
                .into_iter()
                .filter(|(i, j)| (i + j + n) % 3 != 0)
                .map(|(i, j)| PairMeasurement {
                    from: FeatureId(i),
                    to: FeatureId(j),
                    z: truth.features[j] + noise[COUNT + j] - truth.features[i] - noise[COUNT + i],
                })
                .collect();
            estimator.predict(&mut belief, control, &self.motion)?;
            let report = estimator.update(
                &mut belief,
                &Measurements {
                    features: &features,
                    structure: StructureMeasurements::Pairs(&pairs),
                },
            )?;
            (state, p) = form.predict(&state, &p, control, &self.motion, &NOISE);
            let updated = form.update(&state, &p, &features, &pairs, &NOISE);
            (state, p) = (updated.state, updated.p);
            prop_assert!(difference(&state, &belief.state) < 1e-8, "step {n}");
            let paper = form.covariance_to_paper(&state, &p);
            assert_close(&covariance_matrix(&belief), &paper, 1e-7);
            prop_assert_eq!(report.features.dof, 3 * features.len());
            prop_assert_eq!(report.structure.dof, 3 * (COUNT - 1));
            // The pairs do not contradict each other, so fewer rows leave nothing of yᵀS⁻¹y out.
            let nis = report.features.value + report.structure.value;
            prop_assert!(
                (nis - updated.nis).abs() < 1e-6 * (1.0 + nis),
                "{} {}",
                nis,
                updated.nis
            );
        }
        Ok(())
    }
}
