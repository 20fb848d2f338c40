//! What can go wrong in the filter.

use adslam_models::FeatureId;
use thiserror::Error;

/// An entry of the pose by name.
fn pose_entry(index: &usize) -> &'static str {
    const NAMES: [&str; 6] = ["roll", "pitch", "yaw", "x", "y", "z"];
    NAMES.get(*index).copied().unwrap_or("?")
}

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
    /// Measurements that would leave a covariance of which fewer than six digits are right.
    #[error(
        "the {what} are too precise for what is known before them: they make a standard deviation up to \
         {ratio:.1e} times smaller while others that go with it stay as large, and with numbers of 16 digits \
         more than {largest:.1e} times leaves fewer than 6 right. Make the sigma of the {what} larger, or the \
         sigmas of the first estimate and of the motion smaller"
    )]
    TooPrecise {
        /// Which measurements.
        what: &'static str,
        /// How many times smaller they make a standard deviation.
        ratio: f64,
        /// How many times smaller they may make it.
        largest: f64,
    },
    /// A motion after which the covariance of the pose has fewer than six right digits.
    #[error(
        "the robot moves too far for how little its orientation is known: the variance of state entry {index} \
         becomes {value:.1e}, of which what is known apart from the orientation is lost in rounding. Make \
         shorter steps, or the rotation sigma and the first covariance of the orientation smaller, or the \
         translation sigma larger"
    )]
    LostInMotion {
        /// Which entry of the state.
        index: usize,
        /// Its variance.
        value: f64,
    },
    /// An orientation so near to pitch ±90° that a covariance cannot be taken from angles to rotations and back.
    #[error(
        "the estimated pitch is {pitch_deg:.4}°, too near to 90°: Euler angles cannot follow there, and taking the \
         covariance from one orientation to the next would change it by {loss:.0e} of its value, more than 1e-6. \
         Keep the pitch away from ±90° (limits of the pitch, other axes), or use the Euler-angle estimator, which \
         takes angles as they are"
    )]
    PitchNearRightAngle {
        /// The estimated pitch, degrees.
        pitch_deg: f64,
        /// The part of a covariance that rounding changes.
        loss: f64,
    },
    /// Two entries of a first covariance of the pose that cannot go together.
    #[error(
        "the first covariance of the pose has {covariance} between {} and {} (entries {first} and {second}), more \
         than {largest}, the root of the product of their variances: no two numbers vary together like that. \
         Make it smaller, or the variances larger",
        pose_entry(.first), pose_entry(.second)
    )]
    BadCorrelation {
        /// One entry of the pose.
        first: usize,
        /// Another.
        second: usize,
        /// Their covariance.
        covariance: f64,
        /// The largest that it may be, either way.
        largest: f64,
    },
    /// A first covariance of the pose of which each pair of entries is right by itself, but not all together.
    #[error(
        "the first covariance of the pose is not positive semidefinite: its correlation matrix has the \
         eigenvalue {smallest:.3}. Some sum of entries would have a negative variance; make the covariances \
         between different entries smaller"
    )]
    NotSemidefinite {
        /// The smallest eigenvalue of the correlations.
        smallest: f64,
    },
    /// An input holds NaN or an infinity.
    #[error("the {what} is not finite; the filter needs finite numbers")]
    NotFinite {
        /// Which input.
        what: &'static str,
    },
    /// A slice that the entries do not fit into.
    #[error("a covariance with {entries} entries does not fit into a slice of {found}")]
    SliceLength {
        /// How long the slice is.
        found: usize,
        /// How many entries there are.
        entries: usize,
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
    #[error("the sigma of {what} is {value:?}; it must be {requirement}")]
    BadSigma {
        /// Which noise.
        what: &'static str,
        /// The value given.
        value: f64,
        /// What it must be.
        requirement: &'static str,
    },
}
