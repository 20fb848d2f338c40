//! Holm's correction for several tests at once.

/// The p-values of a family of tests, corrected so that rejecting those at or below α makes a false
/// rejection anywhere in the family at most with probability α, however the tests depend on each other.
/// In the order of the list.
///
/// S. Holm, *A simple sequentially rejective multiple test procedure*, Scand. J. Statist. 6 (1979): the k-th
/// smallest of m, from 0, is multiplied by m − k, and none becomes smaller than one before it.
#[must_use]
pub fn holm(p_values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..p_values.len()).collect();
    order.sort_by(|&a, &b| p_values[a].total_cmp(&p_values[b]));
    let mut corrected = vec![0.0; p_values.len()];
    let mut largest = 0.0_f64;
    for (rank, &index) in order.iter().enumerate() {
        let remaining = (p_values.len() - rank) as f64;
        largest = largest.max((remaining * p_values[index]).min(1.0));
        corrected[index] = largest;
    }
    corrected
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_known_family() {
        assert_eq!(holm(&[0.01, 0.04, 0.03, 0.005]), [0.03, 0.06, 0.06, 0.02]);
        assert_eq!(holm(&[0.5, 0.9]), [1.0, 1.0]);
        assert_eq!(holm(&[0.2]), [0.2]);
        assert!(holm(&[]).is_empty());
    }
}
