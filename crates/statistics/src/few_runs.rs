//! What a few runs would have shown, had they been drawn from those that were done.

use rand::RngExt;

use super::bootstrap::central;
use super::{Draws, Interval, RESAMPLES, generator, mean};

/// What is told of a few runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Statistic {
    /// The mean of those that have a finite value; infinite where none has.
    Mean,
    /// The largest of all.
    Largest,
}

impl Statistic {
    /// Of some values.
    #[must_use]
    pub fn of(self, values: &[f64]) -> f64 {
        match self {
            Self::Mean => {
                let finite = values.iter().filter(|value| value.is_finite());
                let (sum, count) =
                    finite.fold((0.0, 0_u32), |(sum, count), v| (sum + v, count + 1));
                if count == 0 {
                    f64::INFINITY
                } else {
                    sum / f64::from(count)
                }
            }
            Self::Largest => values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        }
    }

    /// What is expected of it for `count` runs drawn from `values`, none of which is infinite where the largest is
    /// asked for.
    #[must_use]
    pub fn expected(self, values: &[f64], count: usize) -> f64 {
        match self {
            Self::Mean => self.of(values),
            // The k-th smallest of N is the largest of the draws with a chance of (k/N)ⁿ − ((k − 1)/N)ⁿ.
            Self::Largest => {
                let mut sorted = values.to_vec();
                sorted.sort_unstable_by(f64::total_cmp);
                let at_most = |k: usize| (k as f64 / values.len() as f64).powf(count as f64);
                let ranked = (1..).zip(&sorted);
                ranked.map(|(k, v)| v * (at_most(k) - at_most(k - 1))).sum()
            }
        }
    }
}

/// Where a statistic of `count` runs lies in 95 % of cases, if runs are as likely as in `values`: the bootstrap
/// distribution of that statistic, as much left out below as above. None of fewer than two values, which say nothing
/// of how runs differ, or of no runs.
///
/// The values are first spread about their mean by √(N/(N − 1)), so that their variance is that which N runs
/// estimate without bias: the length of the interval does not depend on how many runs were done. Infinite values,
/// of runs in which something never happens, stay so.
#[must_use]
pub fn interval_of_few(values: &[f64], count: usize, statistic: Statistic) -> Option<Interval> {
    if values.len() < 2 || count == 0 {
        return None;
    }
    let finite: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    let (middle, n) = (mean(&finite), finite.len() as f64);
    let factor = if finite.len() > 1 {
        (n / (n - 1.0)).sqrt()
    } else {
        1.0
    };
    let spread = |v: f64| middle + factor * (v - middle);
    let spread: Vec<f64> = values
        .iter()
        .map(|v| if v.is_finite() { spread(*v) } else { *v })
        .collect();
    let mut generator = generator(Draws::FewRuns);
    let mut drawn = vec![0.0; count];
    let mut statistics: Vec<f64> = (0..RESAMPLES)
        .map(|_| {
            drawn.fill_with(|| spread[generator.random_range(0..spread.len())]);
            statistic.of(&drawn)
        })
        .collect();
    Some(central(&mut statistics))
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha12Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    /// A hundred thousand equal shares of the exponential law: means of five of them are Γ(5)/5, whose quantiles are
    /// χ²₁₀/10, and the largest of five is below x with a chance of (1 − e⁻ˣ)⁵.
    #[test]
    fn the_quantiles_are_those_of_the_law() {
        let n = 100_000;
        let values: Vec<f64> = (0..n)
            .map(|k| -(1.0 - (f64::from(k) + 0.5) / f64::from(n)).ln())
            .collect();
        let near = |interval: Interval, low: f64, high: f64| {
            assert!((interval.low / low - 1.0).abs() < 0.1, "{interval:?}");
            assert!((interval.high / high - 1.0).abs() < 0.1, "{interval:?}");
        };
        let mean = interval_of_few(&values, 5, Statistic::Mean).unwrap();
        near(mean, 0.3247, 2.0483);
        let single = interval_of_few(&values, 1, Statistic::Mean).unwrap();
        near(single, 0.025_32, 3.6889);
        let largest = interval_of_few(&values, 5, Statistic::Largest).unwrap();
        near(largest, 0.6500, 5.2882);
        // H₅, the fifth harmonic number.
        let expected = Statistic::Largest.expected(&values, 5);
        assert!((expected - 137.0 / 60.0).abs() < 1e-3, "{expected}");
    }

    /// Of single runs out of two: their mean less and more the sigma that two runs estimate, √2 for 0 and 2.
    #[test]
    fn few_values_are_spread_to_the_variance_that_they_estimate() {
        let two = interval_of_few(&[2.0, 0.0], 1, Statistic::Mean).unwrap();
        let root = 2f64.sqrt();
        assert!((two.low - (1.0 - root)).abs() < 1e-12, "{two:?}");
        assert!((two.high - (1.0 + root)).abs() < 1e-12, "{two:?}");
        let three = interval_of_few(&[3.0, 0.0, 3.0], 1, Statistic::Mean).unwrap();
        let factor = 1.5f64.sqrt();
        assert!(
            (three.low - (2.0 - 2.0 * factor)).abs() < 1e-12,
            "{three:?}"
        );
        assert!((three.high - (2.0 + factor)).abs() < 1e-12, "{three:?}");
        let one_ends = interval_of_few(&[10.0, f64::INFINITY], 1, Statistic::Mean).unwrap();
        assert_eq!((one_ends.low, one_ends.high), (10.0, f64::INFINITY));
        // Of two draws from two values the smaller is the largest in one case of four.
        assert_eq!(Statistic::Largest.expected(&[2.0, 1.0], 2), 1.75);
        assert_eq!(Statistic::Mean.expected(&[2.0, 1.0], 2), 1.5);
    }

    #[test]
    fn what_never_happens_stays_so() {
        let never = f64::INFINITY;
        let of = |values: &[f64], count| interval_of_few(values, count, Statistic::Mean).unwrap();
        let all = of(&[never; 4], 5);
        assert_eq!((all.low, all.high), (never, never));
        // Of single runs the half never finish; nine runs without one that does are 0.2 % of cases.
        let half = [10.0, never, 10.0, never];
        assert_eq!((of(&half, 1).low, of(&half, 1).high), (10.0, never));
        assert_eq!(of(&half, 9).high, 10.0);
        assert_eq!(Statistic::Mean.of(&[2.0, never, 4.0]), 3.0);
    }

    #[test]
    fn one_run_says_nothing() {
        assert_eq!(interval_of_few(&[1.0], 5, Statistic::Mean), None);
        assert_eq!(interval_of_few(&[1.0, 2.0], 0, Statistic::Mean), None);
    }

    /// How often a value that is none of the law's central 95 % lies in the interval, for more and more runs of
    /// ours: never more often, and in the end never. The range of the runs, however, would come to hold it.
    #[test]
    fn more_runs_make_no_value_fit_better() {
        let mut noise = ChaCha12Rng::seed_from_u64(8);
        let laws: [fn(f64) -> f64; 2] = [|z| z, f64::exp];
        let trials = 30;
        for law in laws {
            let mut draw = || law(Distribution::<f64>::sample(&StandardNormal, &mut noise));
            let many: Vec<f64> = (0..20_000).map(|_| draw()).collect();
            for (count, statistic) in [
                (5, Statistic::Mean),
                (1, Statistic::Mean),
                (5, Statistic::Largest),
            ] {
                let truth = interval_of_few(&many, count, statistic).unwrap();
                let outside = truth.high + 0.4 * (truth.high - truth.low);
                let held = [5, 20, 80, 320].map(|runs| {
                    let fits = |_: &usize| {
                        let ours: Vec<f64> = (0..runs).map(|_| draw()).collect();
                        interval_of_few(&ours, count, statistic)
                            .unwrap()
                            .contains(outside)
                    };
                    (0..trials).filter(fits).count()
                });
                // Two standard errors of a half of the trials.
                let most = held[0] + 6;
                assert!(held.iter().all(|held| *held <= most), "{held:?}");
                assert!(held[3] <= 2, "{statistic:?} of {count}: {held:?}");
            }
        }
    }
}
