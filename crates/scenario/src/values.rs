//! Numbers, vectors, lists and names as they may stand in a file: a value of these types is valid.
//!
//! Their `Deserialize` refuses anything else, so that the error carries the place of the value.
//! Its text reads "what is wrong; what to write instead".

mod count;
mod list;
mod name;
mod real;

pub use count::{Count, FeatureCount, FeatureNumber, Many, Seed, Steps};
pub use list::{LONGEST_LIST, List, Triple, Vec3};
pub use name::Name;
pub use real::{
    AngleSigma, ClockFactor, Finite, Fraction, GateProbability, LARGEST, NonNegative, Positive,
    Probability, SMALLEST, Spacing, Truncation,
};
use thiserror::Error;

/// A value that may not stand where it does.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{problem}; {remedy}")]
pub struct ValueError {
    problem: String,
    remedy: String,
}

impl ValueError {
    fn new(problem: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self {
            problem: problem.into(),
            remedy: remedy.into(),
        }
    }
}
