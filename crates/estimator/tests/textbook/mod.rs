//! Each estimator in its own error coordinates τ, as it is derived: F, G and H by τ, every row stacked, S
//! inverted, the state moved by the group's exponential, and no transformation of the covariance.

#![allow(dead_code, reason = "each test file uses a part")]

use adslam_estimator::{ErrorState, EulerError, FeatureMeasurement, FilterNoise, PairMeasurement};
use adslam_models::lie::{LieGroup, SeK3, So3TimesPoints};
use adslam_models::{Control, EulerAngles, Pose, State, motion_jacobian, predicted_pose};
use nalgebra::{DMatrix, DVector, Matrix3, Point3, Rotation3, Vector3};

/// One of the estimators.
#[derive(Clone, Copy, PartialEq)]
pub enum Textbook {
    Euler,
    So3,
    RightInvariant,
}

pub const EULER: Textbook = Textbook::Euler;
pub const SO3: Textbook = Textbook::So3;
pub const RIGHT_INVARIANT: Textbook = Textbook::RightInvariant;

/// χ̂ and P_τ after an update, and yᵀS⁻¹y.
pub struct Updated {
    pub state: State,
    pub p: DMatrix<f64>,
    pub nis: f64,
}

fn put(m: &mut DMatrix<f64>, row: usize, column: usize, block: &Matrix3<f64>) {
    m.view_mut((row, column), (3, 3)).copy_from(block);
}

/// x and the features, and where each begins in the state.
fn positions(state: &State) -> impl Iterator<Item = (usize, Vector3<f64>)> {
    let all = std::iter::once(&state.pose.position).chain(&state.features);
    all.enumerate().map(|(k, p)| (3 + 3 * k, p.coords))
}

impl Textbook {
    /// T(χ̂), τ = T δ.
    pub fn transformation(self, state: &State) -> DMatrix<f64> {
        let mut t = DMatrix::identity(state.dim(), state.dim());
        let axes = state.pose.orientation.rotation_axes();
        if self != EULER {
            put(&mut t, 0, 0, &axes);
        }
        if self == RIGHT_INVARIANT {
            for (row, p) in positions(state) {
                put(&mut t, row, 0, &(p.cross_matrix() * axes));
            }
        }
        t
    }

    pub fn covariance_from_paper(self, state: &State, p: &DMatrix<f64>) -> DMatrix<f64> {
        let t = self.transformation(state);
        &t * p * t.transpose()
    }

    pub fn covariance_to_paper(self, state: &State, p: &DMatrix<f64>) -> DMatrix<f64> {
        let t = self
            .transformation(state)
            .try_inverse()
            .expect("pitch is off ±π/2");
        &t * p * t.transpose()
    }

    pub fn predict(
        self,
        state: &State,
        p: &DMatrix<f64>,
        control: &Control,
        motion: &[Vector3<f64>],
        noise: &FilterNoise,
    ) -> (State, DMatrix<f64>) {
        let n = state.dim();
        let mut predicted = state.clone();
        predicted.pose = predicted_pose(&state.pose, control);
        predicted.move_features(motion);
        let (mut f, mut g) = (DMatrix::identity(n, n), DMatrix::identity(n, n));
        let axes = |state: &State| state.pose.orientation.rotation_axes();
        // θ' = W' W⁻¹ θ + W' w: the angles keep their errors while the axes turn.
        let turn = axes(&predicted) * axes(state).try_inverse().expect("pitch is off ±π/2");
        if self == EULER {
            f.view_mut((0, 0), (6, 6))
                .copy_from(&motion_jacobian(&state.pose, control));
        } else {
            put(&mut f, 0, 0, &turn);
            put(&mut g, 0, 0, &axes(&predicted));
        }
        if self == SO3 {
            let way = state.pose.orientation.rotation() * control.translation;
            put(&mut f, 3, 0, &-way.cross_matrix());
        }
        if self == RIGHT_INVARIANT {
            let none = Vector3::zeros();
            let displacements = std::iter::once(&none).chain(motion);
            for ((row, after), d) in positions(&predicted).zip(displacements) {
                let lever = after.cross_matrix();
                let block = d.cross_matrix() + lever * (turn - Matrix3::identity());
                put(&mut f, row, 0, &block);
                put(&mut g, row, 0, &(lever * axes(&predicted)));
            }
        }
        let q = DVector::from_fn(n, |i, _| match i {
            0..3 => noise.rotation_sigma.powi(2),
            3..6 => noise.translation_sigma.powi(2),
            _ => noise.feature_motion_sigma.powi(2),
        });
        let p = &f * p * f.transpose() + &g * DMatrix::from_diagonal(&q) * g.transpose();
        (predicted, p)
    }

    pub fn update(
        self,
        state: &State,
        p: &DMatrix<f64>,
        features: &[FeatureMeasurement],
        pairs: &[PairMeasurement],
        noise: &FilterNoise,
    ) -> Updated {
        let first = self.update_stacked(state, p, features, &[], noise);
        // Linear in positions: no coordinates are better than the paper's.
        let paper = self.covariance_to_paper(&first.state, &first.p);
        let second = EULER.update_stacked(&first.state, &paper, &[], pairs, noise);
        Updated {
            p: self.covariance_from_paper(&second.state, &second.p),
            state: second.state,
            nis: first.nis + second.nis,
        }
    }

    pub fn update_stacked(
        self,
        state: &State,
        p: &DMatrix<f64>,
        features: &[FeatureMeasurement],
        pairs: &[PairMeasurement],
        noise: &FilterNoise,
    ) -> Updated {
        let (mut h, o, y) = crate::common::stacked(state, features, pairs, noise);
        if self != EULER {
            self.set_rotation_columns(&mut h, state, features);
        }
        let s = &h * p * h.transpose() + DMatrix::from_diagonal(&o);
        let inverse = s.try_inverse().expect("S is invertible");
        let gain = p * h.transpose() * &inverse;
        let tau = &gain * &y;
        let n = p.nrows();
        Updated {
            state: self.moved(state, &tau),
            p: (DMatrix::identity(n, n) - gain * h) * p,
            nis: y.dot(&(inverse * &y)),
        }
    }

    /// H by θ. By positions it is the same in all coordinates.
    fn set_rotation_columns(
        self,
        h: &mut DMatrix<f64>,
        state: &State,
        features: &[FeatureMeasurement],
    ) {
        let body_from_world = state.pose.orientation.rotation().matrix().transpose();
        for (m, measurement) in features.iter().enumerate() {
            let offset = state.features[measurement.feature.0] - state.pose.position;
            let block = match self {
                Self::RightInvariant => Matrix3::zeros(),
                _ => body_from_world * offset.cross_matrix(),
            };
            put(h, 3 * m, 0, &block);
        }
    }

    fn moved(self, state: &State, tau: &DVector<f64>) -> State {
        let of_parts = |rotation: Rotation3<f64>, points: Vec<Vector3<f64>>| {
            let before = state.pose.orientation;
            State {
                pose: Pose::new(
                    EulerAngles::nearest_of_rotation(&rotation, before),
                    Point3::from(points[0]),
                ),
                features: points[1..].iter().copied().map(Point3::from).collect(),
            }
        };
        match self {
            Self::Euler => {
                let mut moved = state.clone();
                EulerError::retract(&mut moved, tau.as_slice());
                moved
            }
            Self::So3 => {
                let x = So3TimesPoints::exp(tau).compose(&So3TimesPoints::from(state));
                of_parts(x.rotation, x.points)
            }
            Self::RightInvariant => {
                let x = SeK3::exp(tau).compose(&SeK3::from(state));
                of_parts(x.rotation, x.points)
            }
        }
    }
}
