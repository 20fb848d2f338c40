//! What goes wrong with measurements, apart from noise.

use std::ops::AddAssign;

use nalgebra::Vector3;
use rand::{Rng, RngExt};
use rand_distr::{Distribution, StandardNormal};
use serde::{Deserialize, Serialize};

/// How often measurements go wrong. The default is never.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Faults {
    /// How likely a measured feature has a gross error.
    pub outlier_probability: f64,
    /// Of each coordinate of a gross error, cm.
    pub outlier_sigma: f64,
    /// How likely a feature in sight is not measured.
    pub missed_detection_probability: f64,
    /// How likely no structure measurement arrives at a step.
    pub dropped_structure_probability: f64,
}

/// What went wrong, at a step or in a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct FaultCounts {
    /// Feature measurements with a gross error.
    pub outliers: usize,
    /// Features in sight that were not measured.
    pub missed_detections: usize,
    /// Steps whose structure measurements did not arrive.
    pub dropped_structures: usize,
}

impl AddAssign for FaultCounts {
    fn add_assign(&mut self, other: Self) {
        self.outliers += other.outliers;
        self.missed_detections += other.missed_detections;
        self.dropped_structures += other.dropped_structures;
    }
}

/// The faults of one step, whatever the robot sees then.
#[derive(Clone, Debug, Default)]
pub(super) struct StepFaults {
    features: Vec<FeatureFaults>,
    /// Whether no structure measurement arrives.
    pub(super) drops_structure: bool,
}

/// What befalls the measurement of a feature.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FeatureFaults {
    /// Whether there is none, though the feature is in sight.
    pub(super) is_missed: bool,
    /// Its gross error, cm, body frame.
    pub(super) outlier: Option<Vector3<f64>>,
}

impl Faults {
    /// Whether anything can go wrong at all.
    #[must_use]
    pub fn can_happen(&self) -> bool {
        self.outlier_probability > 0.0
            || self.missed_detection_probability > 0.0
            || self.dropped_structure_probability > 0.0
    }

    /// Draws the faults of a step for so many features. As many numbers are drawn whatever the
    /// probabilities, so that a higher one adds faults to those that were there before.
    pub(super) fn draw(&self, features: usize, generator: &mut impl Rng) -> StepFaults {
        if !self.can_happen() {
            return StepFaults::default();
        }
        let drops_structure = generator.random::<f64>() < self.dropped_structure_probability;
        let features = (0..features).map(|_| {
            let is_missed = generator.random::<f64>() < self.missed_detection_probability;
            let is_outlier = generator.random::<f64>() < self.outlier_probability;
            let error = Vector3::from_fn(|_, _| StandardNormal.sample(generator));
            FeatureFaults {
                is_missed,
                outlier: is_outlier.then_some(error * self.outlier_sigma),
            }
        });
        StepFaults {
            features: features.collect(),
            drops_structure,
        }
    }
}

impl StepFaults {
    /// Those of feature `i`.
    pub(super) fn of_feature(&self, i: usize) -> FeatureFaults {
        self.features.get(i).copied().unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Stream;
    use crate::stream;

    const FAULTS: Faults = Faults {
        outlier_probability: 0.1,
        outlier_sigma: 0.5,
        missed_detection_probability: 0.3,
        dropped_structure_probability: 0.2,
    };

    const FEATURES: usize = 10;
    const STEPS: usize = 4000;

    fn draws(faults: &Faults, seed: u64) -> Vec<StepFaults> {
        let mut generator = stream(seed, Stream::Faults);
        (0..STEPS)
            .map(|_| faults.draw(FEATURES, &mut generator))
            .collect()
    }

    /// The rate of something is its probability, within four standard errors.
    #[track_caller]
    fn assert_rate(count: usize, of: usize, probability: f64) {
        let error = (probability * (1.0 - probability) / of as f64).sqrt();
        let rate = count as f64 / of as f64;
        assert!(
            (rate - probability).abs() < 4.0 * error,
            "{rate} is not {probability}"
        );
    }

    #[test]
    fn each_fault_is_as_frequent_and_as_gross_as_it_should_be() {
        let steps = draws(&FAULTS, 1);
        let each = || steps.iter().flat_map(|step| &step.features);
        let errors: Vec<f64> = each().filter_map(|f| f.outlier).map(|e| e.y).collect();
        assert_rate(errors.len(), STEPS * FEATURES, 0.1);
        assert_rate(
            each().filter(|f| f.is_missed).count(),
            STEPS * FEATURES,
            0.3,
        );
        let both = each().filter(|f| f.is_missed && f.outlier.is_some());
        assert_rate(both.count(), STEPS * FEATURES, 0.03);
        assert_rate(
            steps.iter().filter(|step| step.drops_structure).count(),
            STEPS,
            0.2,
        );
        let variance = errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64;
        // The relative standard error of a variance from n draws is √(2/n).
        let allowed = 4.0 * (2.0 / errors.len() as f64).sqrt();
        assert!((variance / 0.25 - 1.0).abs() < allowed, "{variance}");
    }

    #[test]
    fn a_higher_probability_adds_to_the_faults_of_a_lower_one() {
        let rare = Faults {
            outlier_probability: 0.02,
            missed_detection_probability: 0.0,
            ..FAULTS
        };
        for (few, many) in draws(&rare, 7).iter().zip(&draws(&FAULTS, 7)) {
            assert_eq!(few.drops_structure, many.drops_structure);
            for (few, many) in few.features.iter().zip(&many.features) {
                assert!(few.outlier.is_none() || few.outlier == many.outlier);
                assert!(!few.is_missed);
            }
        }
    }

    #[test]
    fn each_alone_can_happen() {
        let never = Faults::default();
        for alone in [
            Faults {
                outlier_probability: 0.1,
                ..never
            },
            Faults {
                missed_detection_probability: 0.1,
                ..never
            },
            Faults {
                dropped_structure_probability: 0.1,
                ..never
            },
        ] {
            assert!(alone.can_happen(), "{alone:?}");
        }
    }

    #[test]
    fn nothing_happens_where_nothing_can() {
        assert!(!Faults::default().can_happen());
        for step in draws(&Faults::default(), 1).iter().take(3) {
            assert!(!step.drops_structure && step.of_feature(2).outlier.is_none());
        }
    }
}
