//! Confidence intervals of means by the bootstrap.

use rand::{Rng, RngExt};
use serde::Serialize;

use super::{Draws, generator, mean};

/// Resamples behind every interval: its ends then wander by about 2 % of its length with the draws.
pub const RESAMPLES: usize = 10_000;
/// Resampled means left out at either end.
const TAIL: usize = RESAMPLES / 40;
/// The confidence of every interval: the part of [`RESAMPLES`] that lies in it.
pub const BOOTSTRAP_CONFIDENCE: f64 = 1.0 - 2.0 * TAIL as f64 / RESAMPLES as f64;

/// An interval of real numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Interval {
    /// Its lower end.
    pub low: f64,
    /// Its upper end.
    pub high: f64,
}

impl Interval {
    /// Whether the value lies in it, its ends included.
    #[must_use]
    pub fn contains(&self, value: f64) -> bool {
        (self.low..=self.high).contains(&value)
    }
}

/// A mean, and how well the values determine it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MeanEstimate {
    /// How many values there are.
    pub count: usize,
    /// Their arithmetic mean.
    pub mean: f64,
    /// The percentile bootstrap interval of the mean at [`BOOTSTRAP_CONFIDENCE`]; none of a single value, which says
    /// nothing of its spread.
    pub interval: Option<Interval>,
}

impl MeanEstimate {
    /// Of independent values; `None` if there are none.
    ///
    /// The interval is Efron's percentile interval (B. Efron and R. Tibshirani, *An Introduction to the
    /// Bootstrap*, 1993, ch. 13): of [`RESAMPLES`] means, each of as many values drawn with replacement,
    /// it leaves out as many of the smallest as of the largest. It is a little narrow for few values: of
    /// normal ones it holds the true mean in about 90 % of cases with 10 of them, 93 % with 20 and 94 %
    /// with 30.
    #[must_use]
    pub fn of(values: &[f64]) -> Option<Self> {
        let interval = || {
            central(&mut resampled_means(
                values,
                &mut generator(Draws::Bootstrap),
            ))
        };
        (!values.is_empty()).then(|| Self {
            count: values.len(),
            mean: mean(values),
            interval: (values.len() > 1).then(interval),
        })
    }
}

fn resampled_means(values: &[f64], generator: &mut impl Rng) -> Vec<f64> {
    let resampled_mean = |_| {
        let draws = values
            .iter()
            .map(|_| values[generator.random_range(0..values.len())]);
        draws.sum::<f64>() / values.len() as f64
    };
    (0..RESAMPLES).map(resampled_mean).collect()
}

/// Where [`BOOTSTRAP_CONFIDENCE`] of [`RESAMPLES`] values lie, as much left out below as above.
pub(super) fn central(values: &mut [f64]) -> Interval {
    Interval {
        low: nth_smallest(values, TAIL),
        high: nth_smallest(values, RESAMPLES - 1 - TAIL),
    }
}

/// The value with `rank` smaller ones.
fn nth_smallest(values: &mut [f64], rank: usize) -> f64 {
    *values.select_nth_unstable_by(rank, f64::total_cmp).1
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha12Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    #[test]
    fn of_nothing_of_one_and_of_equal_values() {
        assert_eq!(MeanEstimate::of(&[]), None);
        let one = MeanEstimate::of(&[3.0]).unwrap();
        assert_eq!((one.count, one.mean, one.interval), (1, 3.0, None));
        let equal = MeanEstimate::of(&[2.0; 5]).unwrap().interval.unwrap();
        assert_eq!((equal.low, equal.high), (2.0, 2.0));
    }

    /// Of n zeros and ones a resampled mean is a binomial count over n, so the ends are its quantiles: for
    /// n = 40 and half of them ones, P(count ≤ 13) = 0.0192 and P(count ≤ 14) = 0.0403.
    #[test]
    fn the_ends_are_the_quantiles_of_the_resampled_mean() {
        let values: Vec<f64> = (0..40).map(|k| f64::from(k % 2)).collect();
        let interval = MeanEstimate::of(&values).unwrap().interval.unwrap();
        assert_eq!((interval.low, interval.high), (14.0 / 40.0, 26.0 / 40.0));
    }

    #[test]
    fn as_much_is_left_out_above_as_below() {
        let mut ranks: Vec<f64> = (0..RESAMPLES).map(|rank| rank as f64).rev().collect();
        let Interval { low, high } = central(&mut ranks);
        assert_eq!((low, high), (250.0, 9999.0 - 250.0));
    }

    #[test]
    fn an_interval_holds_its_ends() {
        let interval = Interval {
            low: -1.0,
            high: 2.0,
        };
        let held = [-1.1, -1.0, 0.0, 2.0, 2.1].map(|value| interval.contains(value));
        assert_eq!(held, [false, true, true, true, false]);
    }

    #[test]
    fn the_confidence_is_what_the_documentation_says() {
        assert_eq!(BOOTSTRAP_CONFIDENCE, 0.95);
    }

    #[test]
    fn the_same_values_give_the_same_interval_and_scale_with_them() {
        let values = [0.3, 0.1, 0.9, 0.4, 0.2];
        let (first, second) = (MeanEstimate::of(&values), MeanEstimate::of(&values));
        assert_eq!(first, second);
        let doubled = MeanEstimate::of(&values.map(|value| 2.0 * value)).unwrap();
        let (interval, twice) = (first.unwrap().interval.unwrap(), doubled.interval.unwrap());
        assert_eq!(
            (2.0 * interval.low, 2.0 * interval.high),
            (twice.low, twice.high)
        );
    }

    /// How often the interval holds the true mean: to first order it is the normal interval with the
    /// divisor n, so Φ-quantiles of a t distribution with n − 1 degrees of freedom say 0.903 for n = 10
    /// and 0.937 for n = 30. The bounds are four standard errors of 1000 trials away.
    #[test]
    fn it_holds_the_true_mean_as_often_as_theory_says() {
        let mut noise = ChaCha12Rng::seed_from_u64(5);
        for (count, expected) in [(10, 0.903), (30, 0.937)] {
            let trials = 1000;
            let held = (0..trials).filter(|_| {
                let draw = |_| 7.0 + Distribution::<f64>::sample(&StandardNormal, &mut noise);
                let values: Vec<f64> = (0..count).map(draw).collect();
                let interval = MeanEstimate::of(&values).unwrap().interval.unwrap();
                interval.contains(7.0)
            });
            let share = held.count() as f64 / f64::from(trials);
            let tolerance = 4.0 * (expected * (1.0 - expected) / f64::from(trials)).sqrt();
            assert!((share - expected).abs() < tolerance, "{count}: {share}");
        }
    }
}
