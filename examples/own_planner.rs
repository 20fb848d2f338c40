//! A planner of one's own in the whole command `adslam`: it goes to where the feature is of which it knows least.
//!
//!     cargo run --bin own_planner -- run scenarios/polygon.toml --planner curious --out runs/curious --html

use adslam_names::PlannerName;
use adslam_planning::{Decision, ObjectSurfaces, Planner, PlanningError, SafeActions, Situation};
use adslam_scenario::registry::{PlannerEntry, Registry};

/// Its keys, `[planners.curious]`.
#[derive(Default, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields, default)]
struct Keys {
    /// Another weight for features that are far away (1/cm): their variance is divided by 1 + it times their distance.
    laziness_per_cm: f64,
}

#[derive(Default)]
struct Curious(Keys, ObjectSurfaces, SafeActions);

impl Planner for Curious {
    fn decide(&mut self, situation: &Situation<'_>) -> Result<Decision, PlanningError> {
        let Self(keys, surfaces, safe) = self;
        let (state, covariance) = (&situation.belief.state, &situation.belief.covariance);
        let worth = |i: usize, distance_cm: f64| {
            let variance = covariance.feature(adslam_models::FeatureId(i)).trace();
            variance / (1.0 + keys.laziness_per_cm * distance_cm)
        };
        let features = state.features.iter().enumerate();
        let worths = features.map(|(i, p)| (worth(i, (p - state.pose.position).norm()), p));
        let (_, goal) = worths
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .ok_or("there are no features")
            .map_err(Box::from)?;
        safe.find(situation, surfaces.place(situation)?)?;
        safe.keep_nearest(goal, 1);
        let chosen = safe.candidates().first().ok_or(PlanningError::NoActions)?;
        Ok(safe.decision(situation, chosen))
    }
}

fn main() -> Result<std::process::ExitCode, Box<dyn std::error::Error>> {
    let entry = PlannerEntry::with_keys(PlannerName::literal("curious"), |keys: Keys, _| {
        Ok(Box::new(Curious(
            keys,
            ObjectSurfaces::default(),
            SafeActions::default(),
        )))
    });
    let entry = entry
        .shown_as("Curious", [0xe6, 0x9f, 0x00])
        .that("Goes to where the feature is of which it knows least.");
    Ok(adslam_cli::main_with(
        &Registry::standard().with_planner(entry)?,
    ))
}
