//! How well a number of runs determines a share.

use statrs::distribution::{Beta, ContinuousCDF};

use super::{BOOTSTRAP_CONFIDENCE, Interval};

/// The interval of Clopper and Pearson for the chance of something that came about in `some` of `all` runs, at
/// [`BOOTSTRAP_CONFIDENCE`]: exact, it holds the true chance at least as often. None where there are no runs.
#[must_use]
pub fn interval_of_share(some: usize, all: usize) -> Option<Interval> {
    if all == 0 || some > all {
        return None;
    }
    let tail = (1.0 - BOOTSTRAP_CONFIDENCE) / 2.0;
    let quantile = |p: f64, a: usize, b: usize| {
        Beta::new(a as f64, b as f64).map_or(f64::NAN, |beta| beta.inverse_cdf(p))
    };
    Some(Interval {
        low: match some {
            0 => 0.0,
            _ => quantile(tail, some, all - some + 1),
        },
        high: match all - some {
            0 => 1.0,
            never => quantile(1.0 - tail, some + 1, never),
        },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The ends are where the binomial tails are 2.5 %: (α/2)^(1/n) for all of n, and tables for the others.
    #[test]
    fn the_ends_are_those_of_the_tables() {
        for (some, all, low, high) in [
            (5, 5, 0.025_f64.powf(0.2), 1.0),
            (0, 5, 0.0, 1.0 - 0.025_f64.powf(0.2)),
            (5, 10, 0.187_086, 0.812_914),
            (1, 50, 0.000_506, 0.106_470),
        ] {
            let interval = interval_of_share(some, all).unwrap();
            assert!((interval.low - low).abs() < 1e-6, "{some}: {interval:?}");
            assert!((interval.high - high).abs() < 1e-6, "{some}: {interval:?}");
        }
        assert_eq!(interval_of_share(0, 0), None);
    }
}
