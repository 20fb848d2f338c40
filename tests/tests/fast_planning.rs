//! The local planner's decisions on whole runs against the plain way: each action's visible features
//! one by one, and one dense update of the whole covariance for each.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a helper that fails is a test that fails"
)]

use adslam_diagnostics::{Failure, Interrupt};
use adslam_estimator::{Belief, DirectTrace, PlannedMeasurement};
use adslam_experiment::run::simulate;
use adslam_names::PlannerName;
use adslam_planning::{
    ObjectSurfaces, SafeActions, Situation, TRACE_TOLERANCE, features_seen_in_pose,
};
use adslam_record::Observer;
use adslam_setup::Setup;
use adslam_simulation::StepView;
use adslam_tests::setup;

struct Plain<'a> {
    setup: &'a Setup,
    belief: Option<Belief>,
    decisions: usize,
}

impl Plain<'_> {
    /// All safe actions' traces by the plain way, and where in the list the smallest is.
    fn traces(&self, belief: &Belief, step: usize) -> (SafeActions, Vec<f64>) {
        let model = &self.setup.model.planning;
        let feature_motion = self.setup.model.known_feature_motion(step);
        let situation = Situation {
            belief,
            feature_motion: &feature_motion,
            model,
            time_is_up: None,
        };
        let mut surfaces = ObjectSurfaces::default();
        let [now, after] = surfaces.place(&situation).unwrap();
        let mut safe = SafeActions::default();
        safe.find(&situation, [now, after]).unwrap();
        let mut direct = DirectTrace::new(belief, &feature_motion, &model.noise, true).unwrap();
        let sigma = model.noise.feature_measurement_sigma;
        let mut trace = |control, pose| {
            let seen = features_seen_in_pose(&model.sensor, pose, after);
            let seen: Vec<PlannedMeasurement> = seen
                .into_iter()
                .map(|feature| PlannedMeasurement::isotropic(feature, sigma).unwrap())
                .collect();
            direct.after(control, &seen).unwrap()
        };
        let traces = safe
            .candidates()
            .iter()
            .map(|c| trace(&c.control, &c.pose))
            .collect();
        (safe, traces)
    }
}

impl Observer for Plain<'_> {
    fn step(&mut self, view: &StepView<'_>) -> Result<(), Failure> {
        if let (Some(belief), Some((decision, _))) = (self.belief.take(), view.decision) {
            let (safe, traces) = self.traces(&belief, view.step - 1);
            assert_eq!(decision.safe, safe.safe());
            let smallest = traces.iter().copied().fold(f64::INFINITY, f64::min);
            let chosen = decision.predicted_trace.unwrap();
            assert!(
                (chosen / smallest - 1.0).abs() < 1e-9,
                "step {}: {chosen}, {smallest}",
                view.step
            );
            let equal = |trace: &f64| *trace <= smallest * (1.0 + TRACE_TOLERANCE);
            let first = traces.iter().position(equal).unwrap();
            assert_eq!(
                decision.control,
                safe.candidates()[first].control,
                "step {}",
                view.step
            );
            self.decisions += 1;
        }
        self.belief = Some(view.belief.clone());
        Ok(())
    }
}

#[test]
fn the_same_actions_are_chosen_on_whole_runs() {
    for setup in [
        setup("polygon.toml", &[]),
        setup("heart.toml", &[("steps = 200", "steps = 60")]),
    ] {
        let mut plain = Plain {
            setup: &setup,
            belief: None,
            decisions: 0,
        };
        simulate(&setup, PlannerName::LOCAL, 2, &Interrupt::new(), &mut plain).unwrap();
        assert_eq!(plain.decisions, setup.model.steps - 1);
    }
}
