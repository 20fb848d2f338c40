//! The objective with algebra of size 12 for each action; the formulas are in [`super::group`].

use adslam_models::{
    Control, EulerAngles, FeatureId, POSE_DIM, Pose, motion_jacobian, predicted_pose,
};
use nalgebra::{Matrix3, Matrix6, Point3, SMatrix, Vector3};

use super::action::{ACTION_OPERATIONS, ActionTerms};
use super::group::VisibleSet;
use super::pose_factor::semidefinite_root;
use super::prior::DecisionPrior;
use super::shared::SharedBlocks;
use super::workspace::SetWorkspace;
use crate::digits::check_gain;
use crate::input::check_feature;
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
/// those. A set of k features costs about 27k³ + 660k² operations, an action about 9 000,
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
    /// Floating-point operations of this decision, by the formulas, without those of the actions.
    operations: usize,
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
            operations: 0,
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
        let (dim, rows) = (belief.covariance.dim(), 3 * seen.len());
        let contrasts = if with_structure {
            dim.saturating_sub(POSE_DIM + 3)
        } else {
            0
        };
        // The lower triangles of P − VVᵀ and P̂², and P̂ of what is seen.
        self.operations = dim * dim * contrasts + dim * rows * rows + 12 * dim * rows;
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
    /// not positive definite or has fewer than six right digits.
    pub fn add_set(&mut self, visible: &[FeatureId]) -> Result<SetId, EstimatorError> {
        self.prior.noise()?;
        self.sets.push(self.shared.set(visible, &mut self.of_set)?);
        let rows = 3 * visible.len();
        // Factor, inverse and product of inverses; two solves, a product and a sum of products.
        self.operations += rows * rows * rows + (24 + 24 + 24 + 1) * rows * rows;
        Ok(SetId {
            decision: self.decision,
            place: self.sets.len() - 1,
        })
    }

    /// Additions and multiplications of this decision so far if `actions` were asked for, by the leading
    /// terms of what is computed: to compare with what the machine could do in the time.
    #[must_use]
    pub fn operations(&self, actions: usize) -> usize {
        self.operations + actions * ACTION_OPERATIONS
    }

    /// trace(Pₙ₊₁), rad² + cm², if `control` is taken and the features of `set` are measured.
    ///
    /// Measuring more never raises it: over a set that contains what the action really sees this is
    /// a lower bound.
    ///
    /// # Errors
    /// No decision prepared, a set of an earlier decision, a covariance that has broken down, or measurements
    /// so precise that fewer than six digits of the trace are right.
    pub fn after(&self, control: &Control, set: SetId) -> Result<f64, EstimatorError> {
        let noise = self.prior.noise()?;
        let set = self
            .sets
            .get(set.place)
            .filter(|_| set.decision == self.decision)
            .ok_or(EstimatorError::SetOfAnotherDecision)?;
        let pose = self.predicted_pose(control);
        let axes = EulerAngles::rotation_axes(pose.orientation);
        let lever = (pose.position - self.centre).cross_matrix() * axes;
        let action = ActionTerms {
            axes: rows(&axes),
            lever: rows(&lever),
            moved_root: rows(&(motion_jacobian(&self.prior.pose, control) * self.root)),
            noise: noise_root(noise),
        };
        let trace = action.trace(set);
        check_gain(trace.information, 12)?;
        let value = trace.value.ok_or(EstimatorError::NotPositiveDefinite {
            matrix: "information of the planned measurements",
            dim: 12,
        })?;
        let digits = (set.magnitude + trace.magnitude) / value.max(f64::MIN_POSITIVE);
        check_gain(digits, self.prior.covariance.dim())?;
        Ok(value)
    }
}

/// √q, radians and cm.
fn noise_root(noise: &FilterNoise) -> [f64; 6] {
    let (r, t) = (noise.rotation_sigma, noise.translation_sigma);
    [r, r, r, t, t, t]
}

/// A matrix row by row.
fn rows<const R: usize, const C: usize>(m: &SMatrix<f64, R, C>) -> [[f64; C]; R] {
    m.transpose().data.0
}
