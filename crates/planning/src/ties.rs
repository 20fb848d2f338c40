//! What counts as equal, so that rounding decides nothing.

/// Values nearer to each other than this, relatively, count as equal: mirror images of an action are
/// exactly as good, and rounding must not decide between them.
pub(crate) const TOLERANCE: f64 = 1e-12;

/// What decides between equals: the place in the action set, and staying last where the set has no such
/// action.
pub(crate) fn order(index: Option<usize>) -> usize {
    index.unwrap_or(usize::MAX)
}

/// Sorts by `value`, of equal values those first whose `order` is least. `scale` is the size of the numbers
/// that the values are differences of, and so of their rounding.
///
/// Equal are all within the tolerance of the smallest, then all within that of the smallest of the rest, and so
/// on: a partition that depends on nothing but the values.
pub(crate) fn sort<T>(
    mut items: &mut [T],
    scale: f64,
    value: impl Fn(&T) -> f64,
    order: impl Fn(&T) -> usize,
) {
    items.sort_unstable_by(|a, b| value(a).total_cmp(&value(b)));
    while let Some(smallest) = items.first().map(&value) {
        let limit = smallest + TOLERANCE * (smallest.abs() + scale);
        let equal = items.partition_point(|item| value(item) <= limit).max(1);
        let (group, rest) = items.split_at_mut(equal);
        group.sort_unstable_by_key(&order);
        items = rest;
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn sorted(mut items: Vec<(f64, usize)>) -> Vec<usize> {
        sort(&mut items, 0.0, |item| item.0, |item| item.1);
        items.into_iter().map(|item| item.1).collect()
    }

    #[test]
    fn equals_follow_their_order_and_chains_do_not_grow() {
        let near = 1.0 + 0.9 * TOLERANCE;
        assert_eq!(sorted(vec![(1.0, 2), (near, 1), (2.0, 0)]), [1, 2, 0]);
        // The third is equal to the second, but not to the first, and starts a group of its own.
        let far = 1.0 + 1.8 * TOLERANCE;
        assert_eq!(sorted(vec![(far, 0), (near, 1), (1.0, 2)]), [1, 2, 0]);
        // The tolerance is a share of the smallest and of the scale.
        assert_eq!(sorted(vec![(1e3, 1), (1e3 * near, 0)]), [0, 1]);
        for (scale, expected) in [(0.0, [1, 0]), (1e6, [0, 1])] {
            let mut items = [(2.0, 0), (2.0 + 1e-7, 0), (1.0, 1), (1.0 + 1e-7, 0)];
            sort(&mut items, scale, |item| item.0, |item| item.1);
            assert_eq!([items[0].1, items[1].1], expected, "{scale}");
        }
        assert_eq!(sorted(vec![(f64::NAN, 0), (f64::NAN, 1), (1.0, 2)])[0], 2);
    }

    proptest! {
        #[test]
        fn the_order_of_the_list_changes_nothing(
            values in prop::collection::vec((0_u8..3, 0_u8..5), 1..30),
            turn in 0_usize..30,
        ) {
            let items: Vec<(f64, usize)> = values
                .iter()
                .enumerate()
                .map(|(i, &(whole, part))| {
                    (f64::from(whole + 1) * (1.0 + 0.4 * TOLERANCE * f64::from(part)), i)
                })
                .collect();
            let mut turned = items.clone();
            turned.rotate_left(turn % items.len());
            turned.reverse();
            prop_assert_eq!(sorted(items), sorted(turned));
        }
    }
}
