//! The paired test: two planners at the same seeds.

use rand::Rng;
use serde::Serialize;

use super::{Draws, MeanEstimate, generator};

/// Up to this many pairs that differ, all signs are enumerated and the p-value is exact.
pub const MOST_ENUMERATED: usize = 16;
/// Random sign flips for more pairs than that; a p-value of 0.05 then has a standard error of 0.0007.
pub const SIGN_FLIPS: u32 = 99_999;
/// Sums that differ by less than this share of Σ|dᵢ| are equal but for rounding.
const ROUNDING: f64 = 1e-12;

/// What the differences of pairs say of their mean.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PairedComparison {
    /// The mean difference and its bootstrap interval.
    pub difference: MeanEstimate,
    /// The two-sided p-value of the sign-flip randomisation test.
    pub p: f64,
}

impl PairedComparison {
    /// Of differences dᵢ = aᵢ − bᵢ, one for each pair; `None` if there are none.
    ///
    /// Where a and b are exchangeable within each pair, every dᵢ is as likely to have either sign. The
    /// p-value is the share of the 2ⁿ choices of signs for which |Σ ±dᵢ| is at least as large as |Σ dᵢ|
    /// (R. A. Fisher, *The Design of Experiments*, 1935, § 21). For more than [`MOST_ENUMERATED`] pairs
    /// that differ it is (1 + hits) / (1 + [`SIGN_FLIPS`]) over random signs, which keeps the level
    /// (B. Phipson and G. K. Smyth, 2010). With n pairs it is at least 2¹⁻ⁿ: five pairs never reach
    /// 0.05.
    #[must_use]
    pub fn of(differences: &[f64]) -> Option<Self> {
        let difference = MeanEstimate::of(differences)?;
        let p = sign_flip_p(differences);
        Some(Self { difference, p })
    }
}

/// The two-sided p-value of the sign-flip randomisation test, as of [`PairedComparison::of`]; 1 without differences.
#[must_use]
pub fn sign_flip_p(differences: &[f64]) -> f64 {
    // Pairs that do not differ are the same with either sign.
    let differing: Vec<f64> = differences.iter().copied().filter(|d| *d != 0.0).collect();
    if differing.len() <= MOST_ENUMERATED {
        enumerated(&differing)
    } else {
        randomised(&differing)
    }
}

/// The smallest |Σ ±dᵢ| that counts as at least as large as the sum observed.
fn threshold(differences: &[f64]) -> f64 {
    let (sum, size) = differences
        .iter()
        .fold((0.0, 0.0), |(sum, size), d| (sum + d, size + d.abs()));
    f64::abs(sum) - ROUNDING * size
}

fn enumerated(differences: &[f64]) -> f64 {
    let hits = hits_below(differences, 0.0, threshold(differences));
    hits as f64 / 2_f64.powi(i32::try_from(differences.len()).unwrap_or(i32::MAX))
}

/// How many choices of the signs of `rest` bring the sum to the threshold, on either side of zero.
fn hits_below(rest: &[f64], sum: f64, threshold: f64) -> u64 {
    match rest.split_first() {
        None => u64::from(sum.abs() >= threshold),
        Some((d, rest)) => {
            hits_below(rest, sum + d, threshold) + hits_below(rest, sum - d, threshold)
        }
    }
}

fn randomised(differences: &[f64]) -> f64 {
    let threshold = threshold(differences);
    let mut generator = generator(Draws::SignFlips);
    let is_hit = |_: &u32| {
        let flipped = differences.chunks(64).map(|chunk| {
            let signs = generator.next_u64();
            let signed = |(k, d): (usize, &f64)| if signs >> k & 1 == 1 { *d } else { -d };
            chunk.iter().enumerate().map(signed).sum::<f64>()
        });
        flipped.sum::<f64>().abs() >= threshold
    };
    let hits = (0..SIGN_FLIPS).filter(is_hit).count();
    (1 + hits) as f64 / f64::from(1 + SIGN_FLIPS)
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha12Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    /// Darwin's fifteen pairs of maize plants, crossed minus self-fertilised, in eighths of an inch. Fisher
    /// counts 863 of the 32 768 choices of signs on either side.
    const MAIZE: [f64; 15] = [
        49.0, -67.0, 8.0, 16.0, 6.0, 23.0, 28.0, 41.0, 14.0, 29.0, 56.0, 24.0, 75.0, 60.0, -48.0,
    ];

    #[test]
    fn fishers_own_example() {
        let maize = PairedComparison::of(&MAIZE).unwrap();
        assert_eq!(maize.p, 2.0 * 863.0 / 32768.0);
        assert!((maize.difference.mean - 314.0 / 15.0).abs() < 1e-12);
        let error = (randomised(&MAIZE) - maize.p).abs();
        assert!(error < 4.0 * 0.0007, "{error}");
    }

    #[test]
    fn few_pairs_cannot_say_much() {
        let p = |differences: &[f64]| PairedComparison::of(differences).unwrap().p;
        assert_eq!(p(&[3.0]), 1.0);
        assert_eq!(p(&[1.0, 2.0, 3.0, 4.0]), 2.0 / 16.0);
        assert_eq!(p(&[-1.0, -2.0, -3.0, -4.0]), 2.0 / 16.0);
        assert_eq!(p(&[0.0, 0.0]), 1.0);
        // The pair without a difference halves nothing.
        assert_eq!(p(&[0.0, 1.0, 2.0, 3.0, 4.0]), 2.0 / 16.0);
        assert_eq!(PairedComparison::of(&[]), None);
    }

    /// ±(0.1 + 0.2 − 0.3) is nothing, so that ten of the sixteen sums are at least 1; in binary it is not.
    #[test]
    fn rounding_loses_no_tie() {
        let p = PairedComparison::of(&[0.1, 0.2, -0.3, 1.0]).unwrap().p;
        assert_eq!(p, 10.0 / 16.0);
        // 4 − 4 + 2 + 8 + 2 = 12 in units of 100.1: twelve of the 32 sums are as large, in binary ten.
        let p = PairedComparison::of(&[400.4, -400.4, 200.2, 800.8, 200.2])
            .unwrap()
            .p;
        assert_eq!(p, 12.0 / 32.0);
    }

    #[test]
    fn clear_differences_of_many_pairs_are_found() {
        let p = PairedComparison::of(&[1.0; 40]).unwrap().p;
        assert_eq!(p, 1.0 / f64::from(1 + SIGN_FLIPS));
    }

    /// Without a difference, p ≤ 0.05 comes in at most 5 % of the trials: exact below and randomised above
    /// the limit. The bound is four standard errors of the number of trials away.
    #[test]
    fn the_level_holds() {
        let mut noise = ChaCha12Rng::seed_from_u64(9);
        for (pairs, trials) in [(8, 1000), (20, 300)] {
            let found = (0..trials).filter(|_| {
                let draw = |_| Distribution::<f64>::sample(&StandardNormal, &mut noise);
                let differences: Vec<f64> = (0..pairs).map(draw).collect();
                PairedComparison::of(&differences).unwrap().p <= 0.05
            });
            let share = found.count() as f64 / f64::from(trials);
            let tolerance = 4.0 * (0.05 * 0.95 / f64::from(trials)).sqrt();
            assert!((share - 0.05).abs() < tolerance, "{pairs}: {share}");
        }
    }

    #[test]
    fn the_mean_is_that_of_the_differences() {
        let values = [0.5, -0.25, 1.0];
        let compared = PairedComparison::of(&values).unwrap();
        assert_eq!(compared.difference.mean, 1.25 / 3.0);
    }
}
