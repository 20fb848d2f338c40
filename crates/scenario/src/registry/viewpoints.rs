//! The path through viewpoints that the global planner follows, and others may.

use adslam_names::numbers;
use adslam_planning::{
    Goals, PlanningError, ViewpointSampling, can_be_reached, features_never_seen, sample_viewpoints,
};
use adslam_surface::Surface;
use nalgebra::Point3;

use super::PlannerContext;
use crate::Viewpoints;

/// The viewpoints to visit: those of the scenario, or a path drawn by Algorithm 2.
pub(super) fn goals(context: &mut PlannerContext<'_>) -> Result<Goals, PlanningError> {
    let PlannerContext {
        scenario,
        model,
        belief,
        ..
    } = *context;
    let parameters = &scenario.planners.global;
    let surface = Surface::new(&model.topology, &belief.state.features)?;
    let viewpoints: Vec<_> = match &scenario.viewpoints {
        Viewpoints::Fixed(fixed) => fixed.positions_cm.iter().map(|p| p.point()).collect(),
        Viewpoints::Sampled(grid) => {
            let sampling = ViewpointSampling {
                samples: parameters.samples.get(),
                crossing_penalty: *parameters.crossing_penalty_cm,
            };
            let candidates = reachable(context, grid.candidates(), &surface)?;
            let path = sample_viewpoints(
                &candidates,
                &model.sensor,
                &belief.state.pose,
                &surface,
                &sampling,
                context.draw,
            )?;
            path.viewpoints
        }
    };
    let unseen = features_never_seen(&viewpoints, &model.sensor, &belief.state.pose, &surface);
    if !unseen.is_empty() {
        context.warnings.push(format!(
            "{}: no viewpoint sees features {}; the global path does not cover them",
            scenario.name,
            numbers(unseen.iter().map(|feature| feature.0))
        ));
    }
    let goals = Goals::new(viewpoints, *parameters.reached_within_cm)?;
    Ok(goals.giving_up_after(parameters.give_up_after_steps.get()))
}

/// The candidates that a robot that keeps its clearance can reach. Warns of those that are left out for it.
fn reachable(
    context: &mut PlannerContext<'_>,
    candidates: Vec<Point3<f64>>,
    surface: &Surface,
) -> Result<Vec<Point3<f64>>, PlanningError> {
    let clearance = context.model.clearance;
    let reached_within = *context.scenario.planners.global.reached_within_cm;
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
    if left_out > 0 {
        context.warnings.push(format!(
            "{}: viewpoint candidates are left out, as a robot that keeps its clearance of {clearance} cm does not \
             come within {reached_within} cm of them ({left_out} of {count})",
            context.scenario.name
        ));
    }
    Ok(reachable)
}
