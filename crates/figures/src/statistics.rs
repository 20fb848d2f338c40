//! Quartiles.

/// What a box plot shows of some values.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Quartiles {
    pub low_whisker: f64,
    pub first: f64,
    pub median: f64,
    pub third: f64,
    pub high_whisker: f64,
}

impl Quartiles {
    /// Of the finite values: quartiles between the nearest two, whiskers at the farthest values
    /// within 1.5 times the distance of the quartiles. Nothing of nothing.
    pub(crate) fn of(values: &[f64]) -> Option<Self> {
        let mut sorted: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
        sorted.sort_by(f64::total_cmp);
        let last = sorted.len().checked_sub(1)?;
        let at = |share: f64| {
            let place = share * last as f64;
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a place in the list"
            )]
            let below = (place.floor() as usize).min(last);
            let above = (below + 1).min(last);
            sorted[below] + (sorted[above] - sorted[below]) * place.fract()
        };
        let (first, median, third) = (at(0.25), at(0.5), at(0.75));
        let reach = 1.5 * (third - first);
        let within = |v: &&f64| (first - reach..=third + reach).contains(*v);
        Some(Self {
            low_whisker: sorted.iter().find(within).map_or(first, |v| v.min(first)),
            first,
            median,
            third,
            high_whisker: sorted.iter().rfind(within).map_or(third, |v| v.max(third)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_by_hand() {
        let box_of = Quartiles::of(&[5.0, 1.0, 3.0, 2.0, 4.0, 50.0, f64::NAN]);
        let expected = Quartiles {
            low_whisker: 1.0,
            first: 2.25,
            median: 3.5,
            third: 4.75,
            high_whisker: 5.0,
        };
        assert_eq!(box_of, Some(expected));
        let few = Quartiles::of(&[0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0]);
        assert_eq!(few.map(|q| (q.third, q.high_whisker)), Some((0.5, 1.0)));
        assert_eq!(Quartiles::of(&[f64::NAN]), None);
        assert_eq!(Quartiles::of(&[7.0]).map(|q| q.high_whisker), Some(7.0));
    }
}
