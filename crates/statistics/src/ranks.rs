//! The paired test on ranks, where some runs never get there.

use serde::Serialize;

use super::sign_flip_p;

/// Two planners at the same seeds, by who is first: what never comes is last of all.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RankComparison {
    /// Pairs in which the first is smaller, and so sooner.
    pub smaller: usize,
    /// Pairs in which the first is larger.
    pub larger: usize,
    /// Pairs in which both are equal, or neither comes.
    pub equal: usize,
    /// The two-sided p-value of the sign-flip randomisation test on the differences of ranks.
    pub p: f64,
}

impl RankComparison {
    /// Of pairs, each value none where it never comes; `None` if there are none.
    ///
    /// All 2n values are ranked together: the smallest first, equal ones sharing the mean of their ranks, and all
    /// that never come last and equal. Where both of a pair are exchangeable, to exchange them changes the sign of
    /// the difference of their ranks and no rank of another pair, so that the test is as exact as that of
    /// [`PairedComparison`](super::PairedComparison). As in the signed-rank test of Wilcoxon, how much later
    /// counts by ranks only.
    #[must_use]
    pub fn of(pairs: &[(Option<f64>, Option<f64>)]) -> Option<Self> {
        if pairs.is_empty() {
            return None;
        }
        let values: Vec<f64> = pairs
            .iter()
            .flat_map(|(a, b)| [a, b])
            .map(|value| value.unwrap_or(f64::INFINITY))
            .collect();
        let ranks = doubled_ranks(&values);
        let differences: Vec<f64> = ranks.chunks(2).map(|pair| pair[0] - pair[1]).collect();
        let count = |is: fn(f64) -> bool| differences.iter().filter(|d| is(**d)).count();
        Some(Self {
            smaller: count(|d| d < 0.0),
            larger: count(|d| d > 0.0),
            equal: count(|d| d == 0.0),
            p: sign_flip_p(&differences),
        })
    }
}

/// Twice the rank of each value, from 2: whole numbers, though equal ones share a mean.
fn doubled_ranks(values: &[f64]) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let rank = |value: &f64| {
        let below = sorted.partition_point(|other| other < value);
        let not_above = sorted.partition_point(|other| other <= value);
        (below + not_above + 1) as f64
    };
    values.iter().map(rank).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_values_share_their_ranks() {
        let never = f64::INFINITY;
        let ranks = doubled_ranks(&[5.0, 3.0, never, 3.0, never]);
        assert_eq!(ranks, [6.0, 3.0, 9.0, 3.0, 9.0]);
    }

    /// Where both finish, the first is later by one step; but the second never finishes in most pairs.
    #[test]
    fn what_never_comes_is_last() {
        let mut pairs = vec![(Some(21.0), Some(20.0)), (Some(31.0), Some(30.0))];
        pairs.extend((0..10).map(|k| (Some(40.0 + f64::from(k)), None)));
        let compared = RankComparison::of(&pairs).unwrap();
        assert_eq!(
            (compared.smaller, compared.larger, compared.equal),
            (10, 2, 0)
        );
        assert!(compared.p < 0.01, "{compared:?}");
        let finished = RankComparison::of(&pairs[..2]).unwrap();
        assert_eq!((finished.larger, finished.p), (2, 0.5));
    }

    #[test]
    fn neither_of_a_pair_says_nothing() {
        let compared = RankComparison::of(&[(None, None), (Some(1.0), None)]).unwrap();
        assert_eq!((compared.equal, compared.p), (1, 1.0));
        assert_eq!((compared.smaller, compared.larger), (1, 0));
        assert_eq!(RankComparison::of(&[]), None);
    }

    /// Three differences of one sign: two of the eight choices of signs are as large.
    #[test]
    fn the_p_value_is_that_of_all_signs() {
        let pairs = [(2.0, 1.0), (3.0, 1.5), (9.0, 4.0)].map(|(a, b)| (Some(a), Some(b)));
        assert_eq!(RankComparison::of(&pairs).unwrap().p, 0.25);
    }
}
