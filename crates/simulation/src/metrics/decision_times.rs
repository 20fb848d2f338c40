//! How long decisions take.

use serde::{Deserialize, Serialize};

/// Times of the decisions of a run, in milliseconds. The only numbers that differ between two runs of
/// the same seed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DecisionTimes {
    /// Half of them took less.
    pub median: f64,
    /// 95 % of them took less.
    pub p95: f64,
    /// The longest.
    pub max: f64,
}

impl DecisionTimes {
    /// Of durations in any order; none if there are no durations.
    #[must_use]
    pub fn of(mut milliseconds: Vec<f64>) -> Option<Self> {
        milliseconds.sort_by(f64::total_cmp);
        let at = |quantile: f64| {
            // The nearest rank.
            let rank = (quantile * milliseconds.len() as f64).ceil();
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a rank within the list"
            )]
            let index = (rank as usize).saturating_sub(1);
            milliseconds.get(index).copied()
        };
        Some(Self {
            median: at(0.5)?,
            p95: at(0.95)?,
            max: at(1.0)?,
        })
    }
}
