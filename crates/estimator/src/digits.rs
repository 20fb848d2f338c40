//! How many digits a covariance keeps.
//!
//! P is held in double precision, so each entry carries an error of about ε √(P_ii P_jj), ε = 2⁻⁵², and so does
//! all that is computed from it. A measurement with information I = HᵀO⁻¹H leaves variances of the order of
//! O along what it measures. What is left there of the error before it, relative to that, is about
//! ε · maxⱼ `I_jj` `P_jj`: the *gain* of the measurement, how many times smaller it makes a variance, times ε. Where that
//! is no longer small, the posterior has few right digits or none: variances come out zero or negative.
//!
//! An update whose gain is too large is made in stages. Information adds up, so a measurement with noise O says
//! the same as two of the same value with noise O/w and O/(1 − w). The first, with a small weight w, brings
//! the variances down without losing digits, and the second begins from there; rounding of earlier stages is
//! divided by the gain of later ones, as everything that was known before is. Where a stage does not bring the
//! variances down, because entries stay unknown of which differences or sums become known, no order of
//! operations helps: such a P does not fit into its numbers, and the update is refused.

use nalgebra::Matrix6;

use crate::EstimatorError;

/// What rounding may change, relative to the covariance in any direction: six digits are right.
const TOLERANCE: f64 = 1e-6;

/// A stage that brings the gain down by less leads nowhere.
const LEAST_PROGRESS: f64 = 10.0;

/// The largest gain of an update of a covariance with `dim` rows that keeps six digits. Rounding errors of
/// different entries are as good as independent, so that along any direction about the root of their number adds up.
fn largest_gain(dim: usize) -> f64 {
    TOLERANCE / rounding(dim)
}

/// The error along any direction of a sum of products as large as 1.
fn rounding(dim: usize) -> f64 {
    f64::EPSILON * (4.0 + (dim as f64).sqrt())
}

/// Refuses a planned measurement that leaves fewer than six right digits.
pub(crate) fn check_gain(gain: f64, dim: usize) -> Result<(), EstimatorError> {
    let largest = largest_gain(dim);
    if gain <= largest {
        return Ok(());
    }
    Err(too_precise("planned measurements", gain, largest))
}

fn too_precise(what: &'static str, gain: f64, largest: f64) -> EstimatorError {
    EstimatorError::TooPrecise {
        what,
        ratio: gain.sqrt(),
        largest: largest.sqrt(),
    }
}

/// The stages of one update.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stages {
    /// What is measured, for errors.
    what: &'static str,
    largest_gain: f64,
    /// The part of the information that is still to come.
    remaining: f64,
    last_gain: f64,
}

impl Stages {
    /// Of an update of a covariance with `dim` rows.
    pub(crate) fn new(what: &'static str, dim: usize) -> Self {
        Self {
            what,
            largest_gain: largest_gain(dim),
            remaining: 1.0,
            last_gain: f64::INFINITY,
        }
    }

    /// The weight w of the next stage, whose noise is O/w; nothing when all is done. `gain` is that of the whole
    /// measurement on the covariance as it is now. An ordinary update has one stage of weight 1.
    ///
    /// # Errors
    /// [`EstimatorError::TooPrecise`] where no number of stages keeps the digits.
    pub(crate) fn next(&mut self, gain: f64) -> Result<Option<f64>, EstimatorError> {
        if self.remaining == 0.0 {
            return Ok(None);
        }
        if gain * self.remaining <= self.largest_gain {
            return Ok(Some(std::mem::replace(&mut self.remaining, 0.0)));
        }
        // NaN and infinity as well.
        if !(gain * LEAST_PROGRESS <= self.last_gain && gain.is_finite()) {
            return Err(too_precise(self.what, gain, self.largest_gain));
        }
        let weight = self.largest_gain / gain;
        self.last_gain = gain;
        self.remaining -= weight;
        Ok(Some(weight))
    }
}

/// Whether a number that was computed from terms as large as `magnitude` has six right digits.
fn is_resolved(value: f64, magnitude: f64, dim: usize) -> bool {
    value >= magnitude * (rounding(dim) / TOLERANCE)
}

/// Refuses a variance of what `what` measure that has fewer than six right digits, where the terms that it was
/// computed from are as large as `magnitude`.
pub(crate) fn check_resolved(
    what: &'static str,
    variance: f64,
    magnitude: f64,
    dim: usize,
) -> Result<(), EstimatorError> {
    if is_resolved(variance, magnitude, dim) {
        return Ok(());
    }
    // Rounding leaves no less of the terms, whatever its sign.
    let left = variance.max(magnitude * f64::EPSILON);
    Err(too_precise(what, magnitude / left, largest_gain(dim)))
}

/// What was known of the position apart from the orientation, or is added to it by noise, must still be there after
/// a motion: a long way multiplies the uncertainty of the orientation into the position's. `before` and `after` are
/// the covariances of the pose.
pub(crate) fn check_motion_resolved(
    before: &Matrix6<f64>,
    after: &Matrix6<f64>,
    translation_sigma: f64,
) -> Result<(), EstimatorError> {
    let (was, is) = (
        resolved_given_earlier(before),
        resolved_given_earlier(after),
    );
    for index in 3..6 {
        if (was[index] || translation_sigma > 0.0) && !is[index] {
            let value = after[(index, index)];
            return Err(EstimatorError::LostInMotion { index, value });
        }
    }
    Ok(())
}

/// For each entry of the pose, whether its variance given the entries before it has six right digits.
fn resolved_given_earlier(p: &Matrix6<f64>) -> [bool; 6] {
    let mut rest = *p;
    let mut resolved = [false; 6];
    for k in 0..6 {
        let pivot = rest[(k, k)];
        resolved[k] = pivot > 0.0 && is_resolved(pivot, p[(k, k)], 6);
        if !resolved[k] {
            continue;
        }
        let column = rest.column(k).into_owned();
        for j in k + 1..6 {
            for i in k + 1..6 {
                rest[(i, j)] -= column[i] * column[j] / pivot;
            }
        }
    }
    resolved
}
