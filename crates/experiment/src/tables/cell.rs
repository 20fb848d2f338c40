//! What stands in one place of a table.

use std::fmt;

use super::{Agreement, Spread};

/// A published value, if there is one, and ours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ResultCell {
    /// The published value; none where nothing was published.
    pub published: Option<CellValue>,
    /// Ours.
    pub ours: CellValue,
    /// How well they agree; none where they cannot be compared. The value of a single published
    /// run is compared with all our runs, as theirs had other noise.
    pub agreement: Option<Agreement>,
}

/// What stands in a cell. It is displayed as in the tables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CellValue {
    /// No run has such a value.
    Absent,
    /// A count or a step of one run.
    Count(usize),
    /// So many runs of all.
    Share {
        /// How many.
        some: usize,
        /// Of how many.
        all: usize,
    },
    /// A number with its decimals.
    Number {
        /// The number.
        value: f64,
        /// Decimals shown.
        digits: usize,
    },
    /// Several runs.
    Spread {
        /// Their mean and range.
        spread: Spread,
        /// Decimals shown.
        digits: usize,
    },
}

impl fmt::Display for CellValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Absent => f.write_str("-"),
            Self::Count(count) => write!(f, "{count}"),
            Self::Share { some, all } => write!(f, "{some} of {all}"),
            Self::Number { value, digits } => write!(f, "{value:.digits$}"),
            Self::Spread { spread, digits } => write!(f, "{spread:.digits$}"),
        }
    }
}

impl CellValue {
    pub(super) fn of_count(count: Option<usize>) -> Self {
        count.map_or(Self::Absent, Self::Count)
    }

    pub(super) fn of_runs(values: impl IntoIterator<Item = f64>, digits: usize) -> Self {
        Spread::of(values).map_or(Self::Absent, |spread| Self::Spread { spread, digits })
    }

    /// The number, or the mean of several; none for shares and where nothing is.
    #[must_use]
    pub fn mean(&self) -> Option<f64> {
        match *self {
            Self::Absent | Self::Share { .. } => None,
            Self::Count(count) => Some(count as f64),
            Self::Number { value, .. } => Some(value),
            Self::Spread { spread, .. } => Some(spread.mean),
        }
    }
}

impl ResultCell {
    /// Compared as what they are.
    pub(super) fn new(published: Option<CellValue>, ours: CellValue) -> Self {
        Self::judged(published, ours, ours)
    }

    /// Compared with `judge` in place of ours.
    pub(super) fn judged(published: Option<CellValue>, ours: CellValue, judge: CellValue) -> Self {
        let share = |some: usize, all: usize| some as f64 / all.max(1) as f64;
        let agreement = published.and_then(|published| match (published, judge) {
            (CellValue::Absent, CellValue::Absent) => Some(Agreement::Agrees),
            (CellValue::Share { some, all }, CellValue::Share { some: s, all: a }) => {
                Some(Agreement::of_shares(share(some, all), share(s, a)))
            }
            (published, CellValue::Spread { spread, .. }) => published
                .mean()
                .map(|value| Agreement::of_spread(value, spread)),
            _ => None,
        });
        Self {
            published,
            ours,
            agreement,
        }
    }
}
