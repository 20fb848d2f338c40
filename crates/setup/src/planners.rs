//! The planner of a name, with the parameters that the scenario gives it.

use adslam_estimator::Belief;
use adslam_models::Control;
use adslam_names::{PlannerName, numbers};
use adslam_planning::{
    CombinedPlanner, GlobalPlanner, Goals, LocalPlanner, Planner, PlanningError, PlanningNoise,
    PredeterminedPlanner, ViewpointSampling, can_be_reached, features_never_seen,
    sample_viewpoints,
};
use adslam_scenario::Viewpoints;
use adslam_simulation::{Stream, stream};
use adslam_surface::Surface;
use nalgebra::Point3;
use rand::RngExt;

use super::Setup;

/// A planner ready to decide, and what its user should know about it. The draws that it needs
/// come from the seed's own stream, so the global and the combined planner share one path.
///
/// # Errors
/// No viewpoint outside the object, or a first estimate that makes no surface.
pub fn build_planner(
    setup: &Setup,
    name: PlannerName,
    belief: &Belief,
    seed: u64,
) -> Result<(Box<dyn Planner>, Vec<String>), PlanningError> {
    let planners = &setup.scenario.planners;
    let sigma = |cm: f64| PlanningNoise {
        feature_measurement_sigma: Some(cm),
    };
    Ok(match name {
        PlannerName::Predetermined => (
            Box::new(PredeterminedPlanner::new(Control {
                rotation: planners.predetermined.rotation_deg.map(f64::to_radians),
                translation: *planners.predetermined.translation_cm,
            })),
            Vec::new(),
        ),
        PlannerName::Local => {
            let noise = sigma(setup.scenario.local_planning_sigma_cm());
            (Box::new(LocalPlanner::new(noise)), Vec::new())
        }
        PlannerName::Global => {
            let (goals, warnings) = goals(setup, belief, seed)?;
            (Box::new(GlobalPlanner::new(goals)), warnings)
        }
        PlannerName::Combined => {
            let (goals, warnings) = goals(setup, belief, seed)?;
            let nearest = planners.combined.nearest();
            let noise = sigma(setup.scenario.combined_planning_sigma_cm());
            (
                Box::new(CombinedPlanner::new(goals, nearest, noise)),
                warnings,
            )
        }
    })
}

/// The viewpoints to visit: those of the scenario, or a path drawn by Algorithm 2.
fn goals(setup: &Setup, belief: &Belief, seed: u64) -> Result<(Goals, Vec<String>), PlanningError> {
    let parameters = &setup.scenario.planners.global;
    let model = &setup.model.planning;
    let surface = Surface::new(&model.topology, &belief.state.features)?;
    let mut warnings = Vec::new();
    let viewpoints: Vec<_> = match &setup.scenario.viewpoints {
        Viewpoints::Fixed(fixed) => fixed.positions_cm.iter().map(|p| p.point()).collect(),
        Viewpoints::Sampled(grid) => {
            let sampling = ViewpointSampling {
                samples: parameters.samples.get(),
                crossing_penalty: *parameters.crossing_penalty_cm,
            };
            let (candidates, left_out) = reachable(setup, grid.candidates(), &surface)?;
            warnings.extend(left_out);
            let mut generator = stream(seed, Stream::Planner);
            let path = sample_viewpoints(
                &candidates,
                &model.sensor,
                &belief.state.pose,
                &surface,
                &sampling,
                &mut || generator.random::<f64>(),
            )?;
            path.viewpoints
        }
    };
    let unseen = features_never_seen(&viewpoints, &model.sensor, &belief.state.pose, &surface);
    if !unseen.is_empty() {
        warnings.push(format!(
            "{}: no viewpoint sees features {}; the global path does not cover them",
            setup.name(),
            numbers(unseen.iter().map(|feature| feature.0))
        ));
    }
    let goals = Goals::new(viewpoints, *parameters.reached_within_cm)?
        .giving_up_after(parameters.give_up_after_steps.get());
    Ok((goals, warnings))
}

/// The candidates that a robot that keeps its clearance can reach, and how many are left out for it.
fn reachable(
    setup: &Setup,
    candidates: Vec<Point3<f64>>,
    surface: &Surface,
) -> Result<(Vec<Point3<f64>>, Option<String>), PlanningError> {
    let clearance = setup.model.planning.clearance;
    let reached_within = *setup.scenario.planners.global.reached_within_cm;
    let count = candidates.len();
    let (reachable, others): (Vec<_>, Vec<_>) = candidates
        .into_iter()
        .partition(|p| can_be_reached(p, surface, clearance, reached_within));
    let too_near = |p: &&Point3<f64>| surface.signed_distance(p) > 0.0;
    let left_out = others.iter().filter(too_near).count();
    if reachable.is_empty() && left_out > 0 {
        return Err(PlanningError::NoReachableViewpoints {
            candidates: count,
            clearance,
            reached_within,
        });
    }
    let warning = (left_out > 0).then(|| {
        format!(
            "{}: viewpoint candidates are left out, as a robot that keeps its clearance of {clearance} cm does not \
             come within {reached_within} cm of them ({left_out} of {count})",
            setup.name()
        )
    });
    Ok((reachable, warning))
}
