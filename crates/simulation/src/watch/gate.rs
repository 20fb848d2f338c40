//! A gate that has closed for good.

use adslam_estimator::UpdateReport;

use super::lasting::Lasting;

/// Measurements kept out, one after the other up to the last, that are worth a warning. A gate that good
/// measurements pass with a probability of 0.95 keeps out so many of them once in three million times.
const REJECTED: usize = 5;

/// Watches the gate of one filter.
#[derive(Clone, Copy, Debug, Default)]
pub struct GateWatch(Lasting);

impl GateWatch {
    /// Looks at the update at `step`. One without measurements says nothing.
    pub fn add(&mut self, step: u64, report: &UpdateReport) {
        if report.features.dof > 0 {
            self.0.add(step, false);
        } else if report.rejected > 0 {
            self.0.add_times(step, report.rejected);
        }
    }

    /// What there is to say at the end.
    pub fn warning(&self) -> Option<String> {
        let (since, count) = self.0.holds().filter(|(_, count)| *count >= REJECTED)?;
        Some(format!(
            "from some step to the end the gate rejected every feature measurement, so that the estimates follow none; \
             are the noise that the filter assumes and the gate too small? (from step {since} on, {count} measurements)"
        ))
    }
}

#[cfg(test)]
mod tests {
    use adslam_estimator::Nis;

    use super::*;

    fn warning(steps: &[(usize, usize)]) -> Option<String> {
        let mut gate = GateWatch::default();
        for (step, &(used, rejected)) in steps.iter().enumerate() {
            let features = Nis {
                value: 1.0,
                dof: 3 * used,
            };
            let report = UpdateReport {
                features,
                rejected,
                ..UpdateReport::default()
            };
            gate.add(step as u64 + 1, &report);
        }
        gate.warning()
    }

    #[test]
    fn a_gate_that_lets_nothing_pass_any_more_is_found_out() {
        let closed = warning(&[(0, 9), (4, 1), (0, 3), (0, 0), (0, 2)]).unwrap();
        assert!(
            closed.ends_with("(from step 3 on, 5 measurements)"),
            "{closed}"
        );
    }

    #[test]
    fn a_gate_that_lets_something_pass_is_not() {
        assert_eq!(
            warning(&[(0, 9), (0, 9), (1, 8)]),
            None,
            "it has opened again"
        );
        assert_eq!(warning(&[(3, 0), (0, 4)]), None, "so few may be chance");
        assert_eq!(warning(&[(0, 0), (0, 0)]), None, "nothing was measured");
    }
}
