//! Which actions were scored, in the little room that a history has for them.

use std::ops::Range;

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Places in an action set as runs of neighbours, also in files: first, length, first, length, …
///
/// A run takes the same room however long it is, so that no file can claim more than it pays for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ActionRuns {
    runs: Vec<Range<usize>>,
    len: usize,
}

impl ActionRuns {
    /// How many places there are.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.len
    }

    /// Whether there is none.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The places, in the order in which they were put in.
    pub fn iter(&self) -> impl Iterator<Item = usize> {
        self.runs.iter().cloned().flatten()
    }

    /// The greatest of them.
    #[must_use]
    pub fn greatest(&self) -> Option<usize> {
        self.runs.iter().filter_map(|run| run.clone().last()).max()
    }

    /// One place more at the end; none where there would be more than can be counted.
    fn push_run(&mut self, first: usize, length: usize) -> Option<()> {
        let end = first.checked_add(length)?;
        self.len = self.len.checked_add(length)?;
        match self.runs.last_mut() {
            Some(last) if last.end == first => last.end = end,
            _ => self.runs.push(first..end),
        }
        Some(())
    }
}

impl FromIterator<usize> for ActionRuns {
    fn from_iter<I: IntoIterator<Item = usize>>(places: I) -> Self {
        let mut runs = Self::default();
        // The last number that there is has no end; no action set is so large.
        places
            .into_iter()
            .map_while(|place| runs.push_run(place, 1))
            .for_each(drop);
        runs
    }
}

impl Serialize for ActionRuns {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_seq(self.runs.iter().flat_map(|run| [run.start, run.len()]))
    }
}

impl<'de> Deserialize<'de> for ActionRuns {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let numbers = Vec::<usize>::deserialize(from)?;
        let (pairs, rest) = numbers.as_chunks::<2>();
        let mut runs = Self::default();
        let whole = pairs
            .iter()
            .try_for_each(|&[first, length]| runs.push_run(first, length));
        match whole {
            Some(()) if rest.is_empty() => Ok(runs),
            _ => Err(D::Error::custom("runs of scored actions that make no list")),
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn neighbours_make_one_run() {
        let runs: ActionRuns = [3, 4, 5, 9, 0].into_iter().collect();
        assert_eq!(serde_json::to_string(&runs).unwrap(), "[3,3,9,1,0,1]");
        assert_eq!((runs.len(), runs.greatest()), (5, Some(9)));
        assert_eq!(runs.iter().collect::<Vec<_>>(), [3, 4, 5, 9, 0]);
        let none = ActionRuns::default();
        assert!(none.is_empty() && none.greatest().is_none());
    }

    #[test]
    fn a_claim_takes_no_memory() {
        let memory = allocation_counter::measure(|| {
            let runs: ActionRuns = serde_json::from_str("[0,1000000000000]").unwrap();
            assert_eq!(runs.len(), 1_000_000_000_000);
            assert_eq!(runs.greatest(), Some(999_999_999_999));
        });
        assert!(memory.bytes_max < 1000, "{memory:?}");
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..Default::default() })]

        #[test]
        fn the_list_comes_back(list in prop::collection::vec(0_usize..200, 0..150)) {
            let json = serde_json::to_string(&list.iter().copied().collect::<ActionRuns>()).unwrap();
            let runs: ActionRuns = serde_json::from_str(&json).unwrap();
            prop_assert_eq!(runs.iter().collect::<Vec<_>>(), list);
        }
    }
}
