//! What can go wrong in the filter.

use adslam_models::FeatureId;
use thiserror::Error;

/// A filter step that could not be done. The belief it was asked to change must not be used further.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum EstimatorError {
    /// A matrix that must be positive definite has no Cholesky factor.
    #[error(
        "the {matrix} ({dim} × {dim}) is not positive definite: the covariance has broken down. \
         Check that the noise sigmas are not many orders of magnitude apart and that the first \
         covariance is symmetric positive semidefinite"
    )]
    NotPositiveDefinite {
        /// Which matrix.
        matrix: &'static str,
        /// Its size.
        dim: usize,
    },
    /// A variance turned negative, infinite or NaN.
    #[error(
        "the variance of state entry {index} became {value}: the covariance has broken down. \
         Check the noise sigmas and the measurements for extreme values"
    )]
    BadVariance {
        /// Which entry of the state.
        index: usize,
        /// The variance found there.
        value: f64,
    },
    /// An input holds NaN or an infinity.
    #[error("the {what} is not finite; the filter needs finite numbers")]
    NotFinite {
        /// Which input.
        what: &'static str,
    },
    /// Something was given for the wrong number of features.
    #[error("{what} is given for {found} features, but the state has {expected}")]
    WrongCount {
        /// Which input.
        what: &'static str,
        /// How many were given.
        found: usize,
        /// How many features the state has.
        expected: usize,
    },
    /// A measurement of a feature that the state does not have.
    #[error("{feature} was measured, but the state has features 0 to {last} only")]
    UnknownFeature {
        /// The feature named.
        feature: FeatureId,
        /// The last feature of the state.
        last: usize,
    },
    /// A structure measurement from a feature to itself.
    #[error("a structure measurement goes from {0} to itself; it must join two features")]
    SelfPair(FeatureId),
    /// A feature measured twice at one step.
    #[error("{0} is measured twice in one step; give one measurement of each feature")]
    RepeatedFeature(FeatureId),
    /// A planned measurement of a feature that was not announced as visible.
    #[error("{0} is not among the features that the decision was prepared for")]
    NotPlanned(FeatureId),
    /// The planner's objective was asked before a decision was prepared, or after preparing failed.
    #[error("no decision is prepared; call `prepare` before asking about sets and actions")]
    NotPrepared,
    /// A set of visible features that was added in an earlier decision.
    #[error("the set of visible features is not of this decision; add it anew after `prepare`")]
    SetOfAnotherDecision,
    /// A gate that would let nothing through, or is no number.
    #[error("the gate of the feature measurements is {0}; it must be a number above 0")]
    BadGate(f64),
    /// A noise sigma that cannot be used.
    #[error("the sigma of {what} is {value}; it must be {requirement}")]
    BadSigma {
        /// Which noise.
        what: &'static str,
        /// The value given.
        value: f64,
        /// What it must be.
        requirement: &'static str,
    },
}
