//! How well our results agree with published ones.

use super::Spread;

/// Means that differ by up to this share of the published value agree.
pub const AGREES_WITHIN: f64 = 0.10;
/// Means that differ by up to this share of the published value are near.
pub const NEAR_WITHIN: f64 = 0.25;

/// How our result compares with the published value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Agreement {
    /// The published value lies within the range of our runs, or our mean is within
    /// [`AGREES_WITHIN`] of it.
    Agrees,
    /// Our mean is within [`NEAR_WITHIN`] of it.
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

    /// Of a published value with our runs.
    pub(super) fn of_spread(published: f64, ours: Spread) -> Self {
        if (ours.min..=ours.max).contains(&published) {
            return Self::Agrees;
        }
        Self::of_difference(
            ours.mean - published,
            (ours.mean - published).abs() / published,
        )
    }

    /// Of two shares of runs, each from 0 to 1: their difference counts, not its ratio to either.
    pub(super) fn of_shares(published: f64, ours: f64) -> Self {
        Self::of_difference(ours - published, (ours - published).abs())
    }

    fn of_difference(difference: f64, size: f64) -> Self {
        // So that 5 of 5 and 45 of 50, which differ by a tenth, are not parted by rounding.
        const ROUNDING: f64 = 1e-9;
        if size <= AGREES_WITHIN + ROUNDING {
            Self::Agrees
        } else if size <= NEAR_WITHIN + ROUNDING {
            Self::Near
        } else if difference < 0.0 {
            Self::Lower
        } else {
            Self::Higher
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_range_counts_first_and_then_the_mean() {
        let ours = Spread::of([0.8, 1.0, 1.2]).unwrap();
        for (published, expected) in [
            (0.8, Agreement::Agrees),
            (1.1, Agreement::Agrees),
            (1.25, Agreement::Near),
            (0.7, Agreement::Higher),
            (1.4, Agreement::Lower),
            (0.0, Agreement::Higher),
        ] {
            assert_eq!(
                Agreement::of_spread(published, ours),
                expected,
                "{published}"
            );
        }
        let one = Spread::of([0.0]).unwrap();
        assert_eq!(Agreement::of_spread(0.0, one), Agreement::Agrees);
        assert_eq!(Agreement::of_spread(1.0, one), Agreement::Lower);
    }

    #[test]
    fn shares_are_compared_by_their_difference() {
        assert_eq!(Agreement::of_shares(1.0, 0.9), Agreement::Agrees);
        assert_eq!(Agreement::of_shares(0.0, 0.02), Agreement::Agrees);
        assert_eq!(Agreement::of_shares(1.0, 0.76), Agreement::Near);
        assert_eq!(Agreement::of_shares(1.0, 0.0), Agreement::Lower);
        assert_eq!(Agreement::of_shares(0.2, 0.8), Agreement::Higher);
    }
}
