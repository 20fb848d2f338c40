//! The χ² distribution, for gates and for intervals of consistency.

use statrs::distribution::{ChiSquared, ContinuousCDF};

/// The x below which χ² with `dof` degrees of freedom lies with this probability; NaN where `dof` is 0 or the
/// probability is none.
#[must_use]
pub fn quantile(probability: f64, dof: usize) -> f64 {
    if !(0.0..=1.0).contains(&probability) {
        return f64::NAN;
    }
    ChiSquared::new(dof as f64).map_or(f64::NAN, |chi| chi.inverse_cdf(probability))
}

/// Where the mean of `count` independent draws from χ² with `dof` degrees of freedom lies with this
/// probability: as much is left below as above. Their sum has `count` times the degrees of freedom.
#[must_use]
pub fn interval_of_mean(probability: f64, dof: usize, count: usize) -> [f64; 2] {
    let tail = (1.0 - probability) / 2.0;
    [tail, 1.0 - tail].map(|p| quantile(p, dof * count) / count as f64)
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
    fn intervals_of_a_mean_narrow_with_the_count() {
        let [low, high] = interval_of_mean(0.99, 6, 1);
        assert_relative_eq!(low, quantile(0.005, 6));
        assert_relative_eq!(high, quantile(0.995, 6));
        let [low, high] = interval_of_mean(0.99, 6, 100);
        // The normal law with variance 2 · 6/100.
        let half = 2.576 * (12.0f64 / 100.0).sqrt();
        assert_relative_eq!(low, 6.0 - half, epsilon = 0.1);
        assert_relative_eq!(high, 6.0 + half, epsilon = 0.1);
    }
}
