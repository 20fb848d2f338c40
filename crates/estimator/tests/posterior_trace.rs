//! The planner's objective against the trace of Algorithm 1 as printed.

mod common;

use adslam_estimator::{FeatureMeasurement, PairMeasurement, PosteriorTrace};
use adslam_models::FeatureId;
use common::{NOISE, covariance_matrix};
use nalgebra::Vector3;
use proptest::prelude::*;

const COUNT: usize = 7;

proptest! {
    #[test]
    fn objective_is_the_trace_of_algorithm_1(
        belief in common::belief(COUNT),
        controls in prop::collection::vec((common::control(), common::some_features(COUNT)), 4),
        motion in common::vectors(COUNT, 0.3),
        with_structure in any::<bool>()
    ) {
        let objective = PosteriorTrace::new(&belief, &motion, &NOISE, with_structure)?;
        let pairs: Vec<PairMeasurement> = common::every_pair(COUNT)
            .into_iter()
            .filter(|_| with_structure)
            .map(|(i, j)| PairMeasurement { from: FeatureId(i), to: FeatureId(j), z: Vector3::zeros() })
            .collect();
        for (control, visible) in &controls {
            let p = covariance_matrix(&belief);
            let (state, p) = common::propagate(&belief.state, &p, control, &motion, &NOISE);
            let features: Vec<FeatureMeasurement> = visible
                .iter()
                .map(|&feature| FeatureMeasurement { feature, z: Vector3::zeros() })
                .collect();
            let expected = if features.is_empty() && pairs.is_empty() {
                p.trace()
            } else {
                common::update(&state, &p, &features, &pairs, &NOISE).1.trace()
            };
            let trace = objective.after(control, visible)?;
            prop_assert!((trace - expected).abs() < 1e-9 * expected, "{trace} is not {expected}");
        }
    }
}
