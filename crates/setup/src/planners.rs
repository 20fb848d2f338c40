//! The planner of a name, with the parameters that the scenario gives it.

use adslam_estimator::Belief;
use adslam_names::PlannerName;
use adslam_planning::{Planner, PlanningError};
use adslam_scenario::registry::PlannerContext;
use adslam_simulation::{Stream, stream};
use rand::RngExt;

use crate::Setup;

/// A planner ready to decide, and what its user should know about it. The draws that it needs
/// come from the seed's own stream, so the global and the combined planner share one path.
///
/// # Errors
/// A planner that the scenario's registry does not know, no viewpoint outside the object, or a first estimate that makes
/// no surface.
pub fn build_planner(
    setup: &Setup,
    name: PlannerName,
    belief: &Belief,
    seed: u64,
) -> Result<(Box<dyn Planner>, Vec<String>), PlanningError> {
    let scenario = &setup.scenario;
    let entry = scenario
        .registry()
        .planner(name)
        .map_err(|unknown| PlanningError::Other(unknown.into()))?;
    let mut generator = stream(seed, Stream::Planner);
    let mut warnings = Vec::new();
    let planner = entry.build(&mut PlannerContext {
        scenario,
        model: &setup.model.planning,
        belief,
        draw: &mut || generator.random::<f64>(),
        warnings: &mut warnings,
    })?;
    Ok((planner, warnings))
}
