//! What holds from some step to the end.

/// Whether something holds from some step on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Lasting {
    since: Option<u64>,
    count: usize,
}

impl Lasting {
    /// Whether it holds at `step`.
    pub(super) fn add(&mut self, step: u64, holds: bool) {
        self.add_times(step, usize::from(holds));
    }

    /// How often it holds at `step`; no time means that it does not.
    pub(super) fn add_times(&mut self, step: u64, times: usize) {
        if times == 0 {
            *self = Self::default();
        } else {
            self.since.get_or_insert(step);
            self.count += times;
        }
    }

    /// Since which step it holds, and how often it has done so since then.
    pub(super) fn holds(&self) -> Option<(u64, usize)> {
        self.since.map(|step| (step, self.count))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_holds_to_the_end_lasts() {
        let mut lasting = Lasting::default();
        assert_eq!(lasting.holds(), None);
        for (step, holds) in [(1, true), (2, true), (3, false), (4, true), (5, true)] {
            lasting.add(step, holds);
        }
        assert_eq!(lasting.holds(), Some((4, 2)));
        lasting.add_times(6, 3);
        assert_eq!(lasting.holds(), Some((4, 5)));
        lasting.add(7, false);
        assert_eq!(lasting.holds(), None);
    }
}
