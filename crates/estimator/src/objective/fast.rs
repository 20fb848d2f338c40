//! The objective with algebra of size 12 for each action; the formulas are in [`super::group`].

use adslam_models::{Control, EulerAngles, FeatureId, Pose, motion_jacobian, predicted_pose};
use nalgebra::{Matrix3, Matrix6, Point3, SMatrix, Vector3, Vector6};

use super::group::{Matrix12, SharedBlocks, VisibleSet};
use super::pose_factor::semidefinite_root;
use super::prior::DecisionPrior;
use super::workspace::SetWorkspace;
use crate::ekf::check_feature;
use crate::workspace::Workspace;
use crate::{Belief, EstimatorError, FilterNoise};

/// A set of visible features that was added to a [`PosteriorTrace`] in its present decision.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SetId {
    decision: u64,
    place: usize,
}

/// trace(Pₙ₊₁) for hundreds of actions from one belief, exactly as Algorithm 1 gives it with zero
/// innovation, eq. (7).
///
/// [`PosteriorTrace::prepare`] a decision with the features that any action may see, add a set of
/// visible features with [`PosteriorTrace::add_set`], then ask for each action that sees just
/// those. A set of k features costs about 27k³ + 400k² multiplications, an action about 5 000,
/// whatever the number of features. Memory is kept from decision to decision: the second of the
/// same size allocates nothing.
#[derive(Clone, Debug)]
pub struct PosteriorTrace {
    prior: DecisionPrior,
    /// c of the formulas: any point near the features keeps the numbers small.
    centre: Point3<f64>,
    /// L, the factor of `P_rr`.
    root: Matrix6<f64>,
    shared: SharedBlocks,
    /// How many decisions were prepared.
    decision: u64,
    sets: Vec<VisibleSet>,
    of_set: SetWorkspace,
    workspace: Workspace,
}

/// With no decision prepared.
impl Default for PosteriorTrace {
    fn default() -> Self {
        Self {
            prior: DecisionPrior::default(),
            centre: Point3::origin(),
            root: Matrix6::zeros(),
            shared: SharedBlocks::default(),
            decision: 0,
            sets: Vec::new(),
            of_set: SetWorkspace::default(),
            workspace: Workspace::default(),
        }
    }
}

impl PosteriorTrace {
    /// The objective of one decision, see [`Self::prepare`].
    ///
    /// # Errors
    /// Those of [`Self::prepare`].
    pub fn new(
        belief: &Belief,
        feature_motion: &[Vector3<f64>],
        noise: &FilterNoise,
        with_structure: bool,
        seen: &[FeatureId],
    ) -> Result<Self, EstimatorError> {
        let mut objective = Self::default();
        objective.prepare(belief, feature_motion, noise, with_structure, seen)?;
        Ok(objective)
    }

    /// Starts a decision: the belief at step n, what is known of the features' motion to step n + 1
    /// (cm, world), the noise to assume, whether all pairs of features will be measured, and the
    /// features that any of the actions may see, each once. All sets are forgotten, memory is kept.
    ///
    /// # Errors
    /// Inputs that do not fit the belief, or a covariance that has broken down; nothing is prepared then.
    pub fn prepare(
        &mut self,
        belief: &Belief,
        feature_motion: &[Vector3<f64>],
        noise: &FilterNoise,
        with_structure: bool,
        seen: &[FeatureId],
    ) -> Result<(), EstimatorError> {
        self.sets.clear();
        self.decision += 1;
        self.prior.forget();
        for &feature in seen {
            check_feature(feature, belief.state.features.len())?;
        }
        let workspace = &mut self.workspace;
        self.prior
            .prepare(belief, feature_motion, noise, with_structure, workspace)?;
        let features = &self.prior.features;
        let sum: Vector3<f64> = features.iter().map(|p| p.coords).sum();
        let centre = Point3::from(sum / features.len().max(1) as f64);
        let jacobian = |feature: FeatureId| {
            let mut a = SMatrix::<f64, 3, 6>::zeros();
            a.fixed_view_mut::<3, 3>(0, 0)
                .copy_from(&(features[feature.0] - centre).cross_matrix());
            a.fixed_view_mut::<3, 3>(0, 3)
                .copy_from(&-Matrix3::identity());
            a
        };
        self.centre = centre;
        self.root = semidefinite_root(&self.prior.covariance.pose());
        let variance = noise.feature_measurement_sigma.powi(2);
        let covariance = &self.prior.covariance;
        self.shared
            .prepare(covariance, &self.root, seen, jacobian, variance);
        Ok(())
    }

    /// The predicted pose after `control`.
    #[must_use]
    pub fn predicted_pose(&self, control: &Control) -> Pose {
        predicted_pose(&self.prior.pose, control)
    }

    /// Adds a set of visible features, each once.
    ///
    /// # Errors
    /// No decision prepared, a feature that was not announced, or an innovation covariance that is
    /// not positive definite.
    pub fn add_set(&mut self, visible: &[FeatureId]) -> Result<SetId, EstimatorError> {
        self.prior.noise()?;
        self.sets.push(self.shared.set(visible, &mut self.of_set)?);
        Ok(SetId {
            decision: self.decision,
            place: self.sets.len() - 1,
        })
    }

    /// trace(Pₙ₊₁), rad² + cm², if `control` is taken and the features of `set` are measured.
    ///
    /// Measuring more never raises it: over a set that contains what the action really sees this is
    /// a lower bound.
    ///
    /// # Errors
    /// No decision prepared, a set of an earlier decision, or a covariance that has broken down.
    pub fn after(&self, control: &Control, set: SetId) -> Result<f64, EstimatorError> {
        let noise = noise_root(self.prior.noise()?);
        let set = self
            .sets
            .get(set.place)
            .filter(|_| set.decision == self.decision)
            .ok_or(EstimatorError::SetOfAnotherDecision)?;
        let root = &self.root;
        let moved_root = motion_jacobian(&self.prior.pose, control) * root;
        let gamma = centred(&self.predicted_pose(control), &self.centre);
        // T = [[Γ√q, ΓFL], [0, I]].
        let of_noise = Matrix6::from_fn(|i, k| gamma[(i, k)] * noise[k]);
        let of_root = gamma * moved_root;
        let mut information = congruence(&set.k, &of_noise, &of_root);
        for i in 0..12 {
            information[(i, i)] += 1.0;
        }
        let mut weight = congruence(&set.n, &of_noise, &of_root);
        // RᵀR, R = [√q, FL].
        for i in 0..6 {
            weight[(i, i)] += noise[i] * noise[i];
            for k in 0..6 {
                weight[(i, 6 + k)] += noise[i] * moved_root[(i, k)];
            }
        }
        let corner = moved_root.transpose() * moved_root;
        for k in 0..6 {
            for i in 0..6 {
                weight[(6 + i, 6 + k)] += corner[(i, k)];
            }
        }
        trace_of_quotient(&information, &weight)
            .map(|trace| set.constant + trace)
            .ok_or(EstimatorError::NotPositiveDefinite {
                matrix: "information of the planned measurements",
                dim: 12,
            })
    }
}

/// √q, radians and cm.
fn noise_root(noise: &FilterNoise) -> Vector6<f64> {
    let (r, t) = (noise.rotation_sigma, noise.translation_sigma);
    Vector6::new(r, r, r, t, t, t)
}

/// Γ: the error of a pose as the motion of the body about `centre`, world axes.
fn centred(pose: &Pose, centre: &Point3<f64>) -> Matrix6<f64> {
    let axes = EulerAngles::rotation_axes(pose.orientation);
    let mut gamma = Matrix6::identity();
    gamma.fixed_view_mut::<3, 3>(0, 0).copy_from(&axes);
    let lever = (pose.position - centre).cross_matrix() * axes;
    gamma.fixed_view_mut::<3, 3>(3, 0).copy_from(&lever);
    gamma
}

/// TᵀMT with M symmetric and T = [[a, b], [0, I]]; of the result only the upper triangle is right.
fn congruence(m: &Matrix12, a: &Matrix6<f64>, b: &Matrix6<f64>) -> Matrix12 {
    let m11: Matrix6<f64> = m.fixed_view::<6, 6>(0, 0).into_owned();
    let m12: Matrix6<f64> = m.fixed_view::<6, 6>(0, 6).into_owned();
    let m22: Matrix6<f64> = m.fixed_view::<6, 6>(6, 6).into_owned();
    let right = m11 * b + m12;
    let mut out = Matrix12::zeros();
    out.fixed_view_mut::<6, 6>(0, 0)
        .copy_from(&(a.tr_mul(&(m11 * a))));
    out.fixed_view_mut::<6, 6>(0, 6)
        .copy_from(&a.tr_mul(&right));
    out.fixed_view_mut::<6, 6>(6, 6)
        .copy_from(&(b.tr_mul(&right) + m12.tr_mul(b) + m22));
    out
}

/// tr(A⁻¹ Z) of symmetric matrices given by their upper triangles; nothing if A is not positive
/// definite.
fn trace_of_quotient(a: &Matrix12, z: &Matrix12) -> Option<f64> {
    // A = RᵀR with R upper triangular, row by row; then tr(R⁻ᵀ Z R⁻¹) column by column.
    let mut r = *a;
    for i in 0..12 {
        let pivot = r[(i, i)];
        if !(pivot.is_finite() && pivot > 0.0) {
            return None;
        }
        let scale = 1.0 / pivot.sqrt();
        for k in i..12 {
            r[(i, k)] *= scale;
        }
        for j in i + 1..12 {
            let factor = r[(i, j)];
            for k in j..12 {
                r[(j, k)] -= factor * r[(i, k)];
            }
        }
    }
    let mut full = *z;
    full.fill_lower_triangle_with_upper_triangle();
    // Y = R⁻ᵀ Z, then the diagonal of Y R⁻¹ by the same substitution on its rows.
    let solve_transposed = |mut m: Matrix12| {
        for i in 0..12 {
            let inverse = 1.0 / r[(i, i)];
            for c in 0..12 {
                m[(i, c)] *= inverse;
            }
            for j in i + 1..12 {
                let factor = r[(i, j)];
                for c in 0..12 {
                    m[(j, c)] -= factor * m[(i, c)];
                }
            }
        }
        m
    };
    let half = solve_transposed(full);
    Some(solve_transposed(half.transpose()).trace())
}
