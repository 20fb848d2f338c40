//! What every update must keep to, whatever is measured.

mod common;

use adslam_estimator::{
    Ekf, Estimator, FeatureMeasurement, Measurements, PairMeasurement, StructureMeasurements,
};
use adslam_models::FeatureId;
use common::{NOISE, assert_close, covariance_matrix};
use nalgebra::Vector3;
use proptest::prelude::*;

/// More than the filter takes in one block of measurements.
const COUNT: usize = 20;

fn measured(visible: &[FeatureId], z: &[Vector3<f64>]) -> Vec<FeatureMeasurement> {
    let measure = |&feature: &FeatureId| FeatureMeasurement {
        feature,
        z: z[feature.0],
    };
    visible.iter().map(measure).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn the_order_of_measurements_does_not_matter(
        belief in common::belief(COUNT),
        order in Just((0..COUNT).map(FeatureId).collect::<Vec<_>>()).prop_shuffle(),
        kept in 1..=COUNT,
        z in common::vectors(COUNT, 3.0)
    ) {
        let mut sorted = order[..kept].to_vec();
        sorted.sort();
        let update = |visible: &[FeatureId]| {
            let mut belief = belief.clone();
            let features = measured(visible, &z);
            let structure = StructureMeasurements::None;
            Ekf::new(NOISE)?.update(&mut belief, &Measurements { features: &features, structure })?;
            Ok::<_, adslam_estimator::EstimatorError>(belief)
        };
        let (a, b) = (update(&order[..kept])?, update(&sorted)?);
        assert_close(&covariance_matrix(&a), &covariance_matrix(&b), 1e-9);
        prop_assert!(a.state.pose.minus(&b.state.pose).amax() < 1e-8);
        for (a, b) in a.state.features.iter().zip(&b.state.features) {
            prop_assert!((a - b).norm() < 1e-8);
        }
    }

    #[test]
    fn a_measurement_more_never_raises_the_trace(
        belief in common::belief(COUNT),
        visible in common::some_features(COUNT),
        from in 0..COUNT,
        step in 1..COUNT
    ) {
        let z = [Vector3::zeros(); COUNT];
        let pair = [PairMeasurement {
            from: FeatureId(from),
            to: FeatureId((from + step) % COUNT),
            z: Vector3::zeros(),
        }];
        let sums = [Vector3::zeros(); COUNT];
        let trace = |visible: &[FeatureId], structure| {
            let mut belief = belief.clone();
            let features = measured(visible, &z);
            Ekf::new(NOISE)?.update(&mut belief, &Measurements { features: &features, structure })?;
            Ok::<_, adslam_estimator::EstimatorError>(belief.covariance.trace())
        };
        let none = StructureMeasurements::None;
        let mut before = belief.covariance.trace();
        for seen in 1..=visible.len() {
            let after = trace(&visible[..seen], none)?;
            prop_assert!(after <= before, "{after} after {before}");
            before = after;
        }
        let with_pair = trace(&visible, StructureMeasurements::Pairs(&pair))?;
        prop_assert!(with_pair <= before);
        let with_all = trace(&visible, StructureMeasurements::AllPairsSummed(&sums))?;
        prop_assert!(with_all <= with_pair);
    }
}
