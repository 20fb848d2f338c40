//! A planner of one's own in the whole command `adslam`: it goes to where the feature is of which it knows least.
//!
//!     cargo run --bin own_planner -- run scenarios/polygon.toml --planner curious --out runs/curious --html

use adslam_models::FeatureId;
use adslam_names::PlannerName;
use adslam_planning::{Decision, ObjectSurfaces, Planner, PlanningError, SafeActions, Situation};
use adslam_scenario::registry::{PlannerEntry, Registry};
use nalgebra::Point3;

/// Its keys, `[planners.curious]`.
#[derive(Default, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields, default)]
struct Keys {
    /// How much less a feature is worth the farther away it is (1/cm).
    laziness_per_cm: f64,
}

#[derive(Default)]
struct Curious(Keys, ObjectSurfaces, SafeActions);

impl Planner for Curious {
    fn decide(&mut self, situation: &Situation<'_>) -> Result<Decision, PlanningError> {
        let Self(keys, surfaces, safe) = self;
        let (state, covariance) = (&situation.belief.state, &situation.belief.covariance);
        let worth = |(i, p): &(usize, &Point3<f64>)| {
            let away = (*p - state.pose.position).norm();
            covariance.feature(FeatureId(*i)).trace() / (1.0 + keys.laziness_per_cm * away)
        };
        safe.find(situation, surfaces.place(situation)?)?;
        let features = state.features.iter().enumerate();
        if let Some((_, goal)) = features.max_by(|a, b| worth(a).total_cmp(&worth(b))) {
            safe.keep_nearest(goal, 1);
        }
        let chosen = safe.candidates().first().ok_or(PlanningError::NoActions)?;
        Ok(safe.decision(situation, chosen))
    }
}

fn main() -> Result<std::process::ExitCode, Box<dyn std::error::Error>> {
    let curious = PlannerEntry::with_keys(PlannerName::literal("curious"), |keys: Keys, _| {
        Ok(Box::new(Curious(keys, <_>::default(), <_>::default())))
    });
    let registry = Registry::standard().with_planner(curious.shown_as("Curious", [230, 159, 0]))?;
    Ok(adslam_cli::main_with(&registry))
}
