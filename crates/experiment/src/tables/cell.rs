//! What stands in one place of a table.

use std::fmt;

use adslam_statistics::Interval;

use super::{Agreement, Comparison, Spread};

/// A published value, if there is one, and ours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ResultCell {
    /// The published value; none where nothing was published.
    pub published: Option<CellValue>,
    /// Ours.
    pub ours: CellValue,
    /// How they compare; none where they cannot be compared. The value of a single published run is compared with
    /// all our runs, as theirs had other noise.
    pub comparison: Option<Comparison>,
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
        /// Where the chance of it lies, if that is shown.
        interval: Option<Interval>,
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
    /// The steps at which several runs reached something that others never did.
    Steps {
        /// Mean and range of those that did.
        spread: Spread,
        /// How many never did.
        never: usize,
    },
}

impl fmt::Display for CellValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Absent => f.write_str("-"),
            Self::Count(count) => write!(f, "{count}"),
            Self::Share {
                some,
                all,
                interval,
            } => {
                write!(f, "{some} of {all}")?;
                interval.map_or(Ok(()), |Interval { low, high }| {
                    write!(f, " ({:.0}–{:.0} %)", 100.0 * low, 100.0 * high)
                })
            }
            Self::Number { value, digits } => write!(f, "{value:.digits$}"),
            Self::Spread { spread, digits } => write!(f, "{spread:.digits$}"),
            Self::Steps { spread, never: 0 } => write!(f, "{spread:.0}"),
            Self::Steps { spread, never } => write!(f, "{spread:.0}, {never} never"),
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

    /// Of a step of each run, none of one that never came to it.
    pub(super) fn of_steps(steps: impl Iterator<Item = Option<usize>> + Clone) -> Self {
        let never = steps.clone().filter(Option::is_none).count();
        let reached = Spread::of(steps.flatten().map(|step| step as f64));
        reached.map_or(Self::Absent, |spread| Self::Steps { spread, never })
    }

    /// Mean and range of several.
    #[must_use]
    pub const fn spread(&self) -> Option<Spread> {
        match *self {
            Self::Spread { spread, .. } | Self::Steps { spread, .. } => Some(spread),
            _ => None,
        }
    }

    /// The number, or the mean of several; none for shares and where nothing is.
    #[must_use]
    pub fn mean(&self) -> Option<f64> {
        match *self {
            Self::Absent | Self::Share { .. } => None,
            Self::Count(count) => Some(count as f64),
            Self::Number { value, .. } => Some(value),
            Self::Spread { spread, .. } | Self::Steps { spread, .. } => Some(spread.mean),
        }
    }
}

impl ResultCell {
    /// How well they agree, in a word.
    #[must_use]
    pub fn agreement(&self) -> Option<Agreement> {
        self.comparison?.agreement
    }

    /// Ours over the published value, such as "0.93×".
    #[must_use]
    pub fn ratio(&self) -> Option<String> {
        let ratio = self.comparison?.ratio?;
        let digits = if ratio < 10.0 { 2 } else { 0 };
        Some(format!("{ratio:.digits$}×"))
    }
}
