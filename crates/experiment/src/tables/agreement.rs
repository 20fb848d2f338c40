//! How well our results agree with published ones.

use adslam_statistics::{Interval, Statistic, interval_of_few};

/// Results that differ by up to this share of the published value are near, if they do not agree.
pub const NEAR_WITHIN: f64 = 0.25;

/// Values that differ by less than this share are equal but for rounding.
const ROUNDING: f64 = 1e-9;

/// How our result compares with the published value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Agreement {
    /// The published value lies where as many runs of ours would lie in 95 % of cases.
    Agrees,
    /// It does not, but ours is within [`NEAR_WITHIN`] of it.
    Near,
    /// Ours is smaller.
    Lower,
    /// Ours is larger.
    Higher,
}

impl Agreement {
    /// All of them, from best to worst.
    pub const ALL: [Self; 4] = [Self::Agrees, Self::Near, Self::Lower, Self::Higher];

    /// In a word.
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Agrees => "agrees",
            Self::Near => "near",
            Self::Lower => "lower",
            Self::Higher => "higher",
        }
    }

    /// In a sign.
    #[must_use]
    pub const fn sign(self) -> &'static str {
        match self {
            Self::Agrees => "●",
            Self::Near => "◐",
            Self::Lower => "▼",
            Self::Higher => "▲",
        }
    }
}

/// A published value against our runs. A step that is never reached is infinite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// The published value.
    pub published: f64,
    /// What is expected of as many runs of ours as were published.
    pub ours: f64,
    /// Where as many runs of ours would lie in 95 % of cases; none of a single run, which does not say how runs
    /// differ.
    pub interval: Option<Interval>,
    /// Ours over the published value; none where one of them is none or infinite, and of single runs.
    pub ratio: Option<f64>,
    /// In a word; none without interval.
    pub agreement: Option<Agreement>,
}

/// A published value, of how many runs it tells, and what.
#[derive(Clone, Copy, Debug)]
pub(super) struct Published {
    pub(super) value: f64,
    pub(super) runs: usize,
    pub(super) statistic: Statistic,
    /// Whether it is a share of runs: then its difference to ours counts, not the ratio of the two.
    pub(super) is_share: bool,
}

impl Published {
    /// A mean over so many runs.
    pub(super) const fn mean(value: f64, runs: usize) -> Self {
        Self {
            value,
            runs,
            statistic: Statistic::Mean,
            is_share: false,
        }
    }

    /// Against our runs; none where there are none.
    pub(super) fn against(self, ours: &[f64]) -> Option<Comparison> {
        if ours.is_empty() || self.runs == 0 {
            return None;
        }
        let interval = interval_of_few(ours, self.runs, self.statistic);
        let expected = self.statistic.expected(ours, self.runs);
        let ratio = expected / self.value;
        Some(Comparison {
            published: self.value,
            ours: expected,
            interval,
            ratio: Some(ratio).filter(|ratio| self.runs > 1 && ratio.is_finite() && *ratio > 0.0),
            agreement: interval.map(|interval| self.judged(expected, interval)),
        })
    }

    fn judged(self, ours: f64, interval: Interval) -> Agreement {
        let published = self.value;
        // Never on one side only is no agreement.
        if self.runs > 1 && published.is_finite() != ours.is_finite() {
            return Agreement::of_order(ours, published);
        }
        let slack = ROUNDING * published.abs();
        let within = interval.contains(published)
            || interval.contains(published - slack)
            || interval.contains(published + slack);
        let size = (ours - published).abs() / if self.is_share { 1.0 } else { published };
        if within {
            Agreement::Agrees
        } else if size <= NEAR_WITHIN + ROUNDING {
            Agreement::Near
        } else {
            Agreement::of_order(ours, published)
        }
    }
}

impl Agreement {
    pub(super) fn of_order(ours: f64, published: f64) -> Self {
        if ours < published {
            Self::Lower
        } else {
            Self::Higher
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NEVER: f64 = f64::INFINITY;

    fn agreement(published: Published, ours: &[f64]) -> Agreement {
        published.against(ours).unwrap().agreement.unwrap()
    }

    fn largest(value: f64) -> Published {
        Published {
            statistic: Statistic::Largest,
            ..Published::mean(value, 5)
        }
    }

    /// Runs from 0.8 to 1.2, evenly: means of five lie within 1 ± 0.1.
    #[test]
    fn the_means_of_as_many_runs_count() {
        let ours: Vec<f64> = (0..41).map(|k| 0.8 + 0.01 * f64::from(k)).collect();
        for (published, expected) in [
            (0.92, Agreement::Agrees),
            (1.08, Agreement::Agrees),
            (1.15, Agreement::Near),
            (0.82, Agreement::Near),
            (0.7, Agreement::Higher),
            (1.4, Agreement::Lower),
            (0.0, Agreement::Higher),
        ] {
            let published = Published::mean(published, 5);
            assert_eq!(agreement(published, &ours), expected, "{published:?}");
        }
        // A single published run may lie anywhere among ours.
        assert_eq!(
            agreement(Published::mean(1.18, 1), &ours),
            Agreement::Agrees
        );
        assert_eq!(agreement(Published::mean(1.3, 1), &ours), Agreement::Near);
    }

    /// The published 11.0 on the heart's predetermined path lies within the range of runs around 37.
    #[test]
    fn a_value_in_the_range_of_the_runs_is_no_agreement() {
        let ours: Vec<f64> = (0..50).map(|k| 0.3 + 1.5 * f64::from(k)).collect();
        let compared = largest(11.0).against(&ours).unwrap();
        assert_eq!(compared.agreement, Some(Agreement::Higher));
        assert!(compared.ratio.unwrap() > 5.0, "{compared:?}");
        let compared = Published::mean(11.0, 5).against(&ours).unwrap();
        assert_eq!(compared.agreement, Some(Agreement::Higher));
    }

    /// The published maximum is that of five runs, so it is compared with the largest of five of ours.
    #[test]
    fn the_largest_of_as_many_runs_counts() {
        let ours: Vec<f64> = (0..50).map(|k| 1.0 + 0.02 * f64::from(k)).collect();
        assert_eq!(agreement(largest(1.9), &ours), Agreement::Agrees);
        assert_eq!(agreement(largest(1.2), &ours), Agreement::Higher);
        let compared = largest(1.9).against(&ours).unwrap();
        assert!((compared.ours - 1.83).abs() < 0.02, "{compared:?}");
    }

    #[test]
    fn never_on_one_side_only_is_no_agreement() {
        let never = Published::mean(NEVER, 5);
        assert_eq!(agreement(never, &[NEVER; 9]), Agreement::Agrees);
        assert_eq!(agreement(never, &[20.0, NEVER]), Agreement::Lower);
        assert_eq!(agreement(never, &[20.0, 21.0]), Agreement::Lower);
        let at_20 = Published::mean(20.0, 5);
        assert_eq!(agreement(at_20, &[NEVER; 9]), Agreement::Higher);
        assert_eq!(agreement(at_20, &[NEVER, 20.0, 20.0]), Agreement::Agrees);
    }

    #[test]
    fn shares_are_compared_by_their_difference() {
        let share = |value: f64| Published {
            is_share: true,
            ..Published::mean(value, 5)
        };
        let ours = |some: usize| -> Vec<f64> {
            (0..50).map(|run| f64::from(u8::from(run < some))).collect()
        };
        assert_eq!(agreement(share(1.0), &ours(45)), Agreement::Agrees);
        assert_eq!(agreement(share(0.0), &ours(1)), Agreement::Agrees);
        assert_eq!(agreement(share(0.8), &ours(50)), Agreement::Near);
        assert_eq!(agreement(share(1.0), &ours(0)), Agreement::Lower);
        assert_eq!(agreement(share(0.2), &ours(49)), Agreement::Higher);
    }

    #[test]
    fn one_run_of_ours_has_a_ratio_and_no_mark() {
        let compared = Published::mean(2.0, 5).against(&[3.0]).unwrap();
        assert_eq!((compared.ratio, compared.agreement), (Some(1.5), None));
        assert_eq!(Published::mean(2.0, 5).against(&[]), None);
    }
}
