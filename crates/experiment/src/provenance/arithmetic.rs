//! A checksum of what this machine computes.

use std::path::Path;
use std::sync::OnceLock;

use adslam_diagnostics::{Failure, Interrupt};
use adslam_names::{EstimatorName, PlannerName};
use adslam_record::Observer;
use adslam_scenario::Scenario;
use adslam_setup::Setup;
use adslam_simulation::StepView;
use crc32fast::Hasher;

use crate::run::simulate;

const CANONICAL: &str = include_str!("canonical.toml");

/// The checksum of every bit of the canonical runs but their times, computed once in a process.
pub(super) fn checksum() -> &'static str {
    static CHECKSUM: OnceLock<String> = OnceLock::new();
    CHECKSUM.get_or_init(|| match computed() {
        Ok(checksum) => format!("{checksum:08x}"),
        // Where the arithmetic is so different that the runs fail, that is what distinguishes it.
        Err(error) => format!("none ({error})"),
    })
}

/// Every planner with the paper's estimator, and every estimator with a planner that uses its covariance.
fn computed() -> Result<u32, Failure> {
    let scenario = Scenario::parse(CANONICAL, Path::new("canonical.toml"))?;
    let setup = Setup::new(&scenario)?;
    let mut digest = Digest(Hasher::new());
    for estimator in EstimatorName::OURS {
        let setup = setup.with_estimator(estimator);
        let setup = setup.map_err(|unknown| scenario.error_at("filter.estimator", unknown))?;
        for planner in PlannerName::PAPER {
            if estimator == EstimatorName::default() || planner == PlannerName::LOCAL {
                simulate(&setup, planner, 1, &Interrupt::new(), &mut digest)?;
            }
        }
    }
    Ok(digest.0.finalize())
}

/// Takes in all numbers of a step.
struct Digest(Hasher);

impl Digest {
    fn add<'a>(&mut self, numbers: impl IntoIterator<Item = &'a f64>) {
        for number in numbers {
            self.0.update(&number.to_bits().to_le_bytes());
        }
    }
}

impl Observer for Digest {
    fn step(&mut self, view: &StepView<'_>) -> Result<(), Failure> {
        let belief = view.belief;
        for pose in [view.pose, &belief.state.pose] {
            self.add(&pose.orientation.to_vector());
            self.add(&pose.position.coords);
        }
        for point in view.features.iter().chain(&belief.state.features) {
            self.add(&point.coords);
        }
        let n = belief.state.dim();
        for i in 0..n {
            for j in 0..=i {
                self.add([&belief.covariance.entry(i, j)]);
            }
        }
        self.add(&view.metrics.pose_nees);
        if let Some((decision, _)) = view.decision {
            self.add(&decision.control.rotation);
            self.add(&decision.control.translation);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_canonical_runs_succeed_and_give_the_same_bits_again() {
        let first = computed().unwrap();
        assert_eq!(computed().unwrap(), first);
        assert_eq!(checksum(), format!("{first:08x}"));
    }

    /// One bit of one number is enough.
    #[test]
    fn the_smallest_difference_shows() {
        let of = |number: f64| {
            let mut digest = Digest(Hasher::new());
            digest.add([&number, &2.0]);
            digest.0.finalize()
        };
        assert_ne!(of(1.0), of(1.0_f64.next_up()));
    }
}
