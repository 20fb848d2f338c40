//! Means and ranges.

use std::fmt;

/// Mean, smallest and largest of some numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// The arithmetic mean.
    pub mean: f64,
    /// The smallest.
    pub min: f64,
    /// The largest.
    pub max: f64,
}

impl Spread {
    /// Of the numbers given; `None` if there are none.
    #[must_use]
    pub fn of(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut count = 0.0;
        let (mut sum, mut min, mut max) = (0.0, f64::INFINITY, f64::NEG_INFINITY);
        for value in values {
            count += 1.0;
            sum += value;
            min = min.min(value);
            max = max.max(value);
        }
        (count > 0.0).then(|| Self {
            mean: sum / count,
            min,
            max,
        })
    }
}

/// `mean (min–max)`, with the precision of the formatter.
impl fmt::Display for Spread {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let digits = f.precision().unwrap_or(3);
        let Self { mean, min, max } = self;
        write!(f, "{mean:.digits$} ({min:.digits$}–{max:.digits$})")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_and_range() {
        let spread = Spread::of([3.0, 1.0, 5.0]).unwrap();
        assert_eq!(format!("{spread:.1}"), "3.0 (1.0–5.0)");
        assert_eq!(Spread::of([]), None);
    }
}
