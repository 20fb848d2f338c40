//! The χ² distribution, for gates and for intervals of consistency.

use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::Interval;

/// The x below which χ² with `dof` degrees of freedom lies with this probability; NaN where `dof` is 0 or the
/// probability is none.
#[must_use]
pub fn quantile(probability: f64, dof: usize) -> f64 {
    if !(0.0..=1.0).contains(&probability) {
        return f64::NAN;
    }
    ChiSquared::new(dof as f64).map_or(f64::NAN, |chi| chi.inverse_cdf(probability))
}

/// Where χ² with `dof` degrees of freedom, divided by them, lies with this probability: as much is left
/// below as above. The sum of independent draws is χ² with all their degrees of freedom.
#[must_use]
pub fn interval_per_dof(probability: f64, dof: usize) -> Interval {
    let tail = (1.0 - probability) / 2.0;
    let end = |p| quantile(p, dof) / dof as f64;
    Interval {
        low: end(tail),
        high: end(1.0 - tail),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn quantiles_are_those_of_the_tables() {
        for (probability, dof, expected) in [
            (0.95, 1, 3.841_458_821),
            (0.999, 3, 16.266_236_2),
            (0.005, 6, 0.675_726_777),
            (0.995, 600, 692.981_629_3),
        ] {
            assert_relative_eq!(quantile(probability, dof), expected, max_relative = 1e-6);
        }
        assert!(quantile(0.5, 0).is_nan());
        assert!(quantile(1.5, 3).is_nan());
    }

    #[test]
    fn intervals_narrow_with_the_degrees_of_freedom() {
        let Interval { low, high } = interval_per_dof(0.99, 6);
        assert_relative_eq!(low, quantile(0.005, 6) / 6.0);
        assert_relative_eq!(high, quantile(0.995, 6) / 6.0);
        let Interval { low, high } = interval_per_dof(0.99, 600);
        // The normal law with variance 2/600.
        let half = 2.576 * (2.0f64 / 600.0).sqrt();
        assert_relative_eq!(low, 1.0 - half, epsilon = 0.02);
        assert_relative_eq!(high, 1.0 + half, epsilon = 0.02);
    }
}
