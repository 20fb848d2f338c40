//! The paper's planners.

use adslam_models::Control;
use adslam_names::PlannerName;
use adslam_planning::{
    CombinedPlanner, GlobalPlanner, LocalPlanner, PlanningNoise, PredeterminedPlanner,
};

use super::PlannerEntry;

/// In the order of the paper's tables. Their keys are [`Planners`](crate::Planners) itself, as they are in every scenario.
pub(super) fn planners() -> Vec<PlannerEntry> {
    let assumed = |feature_measurement_sigma_cm: f64| PlanningNoise {
        feature_measurement_sigma: Some(feature_measurement_sigma_cm),
    };
    vec![
        PlannerEntry::new(PlannerName::PREDETERMINED, |context| {
            let path = &context.scenario.planners.predetermined;
            Ok(Box::new(PredeterminedPlanner::new(Control {
                rotation: path.rotation_deg.map(f64::to_radians),
                translation: *path.translation_cm,
            })))
        })
        .described_as("The same control at every step."),
        PlannerEntry::new(PlannerName::LOCAL, move |context| {
            let noise = assumed(context.scenario.local_planning_sigma_cm());
            Ok(Box::new(LocalPlanner::new(noise)))
        })
        .described_as("Greedy: the smallest trace of the covariance, section III-B."),
        PlannerEntry::new(PlannerName::GLOBAL, |context| {
            Ok(Box::new(GlobalPlanner::new(context.goals()?)))
        })
        .described_as("Through viewpoints that see everything, section III-C."),
        PlannerEntry::new(PlannerName::COMBINED, move |context| {
            let goals = context.goals()?;
            let nearest = context.scenario.planners.combined.nearest();
            let noise = assumed(context.scenario.combined_planning_sigma_cm());
            Ok(Box::new(CombinedPlanner::new(goals, nearest, noise)))
        })
        .described_as("Both, section III-D."),
    ]
}
