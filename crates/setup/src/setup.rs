//! A scenario made ready to run: read once, shared by all its runs.

use std::sync::Arc;

use adslam_agent::GateProbability;
use adslam_diagnostics::InputError;
use adslam_estimator::FilterNoise;
use adslam_models::{EulerAngles, Pose, Sensor};
use adslam_names::{EstimatorName, PlannerName, UnknownName};
use adslam_planning::{ActionSet, PlanningModel};
use adslam_scenario as scenario;
use adslam_scenario::{Scenario, Structure, values};
use adslam_simulation::{
    DeformationNoise, Episode, EpisodeError, EpisodeModel, Faults, WorldModel, WorldNoise,
};
use adslam_surface::{Mesh, Topology};
use nalgebra::Point3;

use crate::build_planner;
use crate::rest_object::RestObject;

/// What the runs of one scenario have in common, and what their user should know.
#[derive(Clone, Debug)]
pub struct Setup {
    /// The truth, what the agent is told of it, and how long a run is.
    pub model: EpisodeModel,
    /// What is to be known of the file that the object was read from; part of the warnings.
    pub object_notes: Vec<String>,
    /// What the user should know before running.
    pub warnings: Vec<String>,
    /// The scenario itself, for the planners' parameters.
    pub scenario: Scenario,
}

impl Setup {
    /// Builds the object, its surface and all models.
    ///
    /// # Errors
    /// A mesh that cannot be used, features that make no solid, or a robot that starts inside the
    /// object; each points at the place in the scenario.
    pub fn new(scenario: &Scenario) -> Result<Self, InputError> {
        let object = RestObject::build(scenario)?;
        let (topology, drawn) = (Arc::new(object.topology), Arc::new(object.drawn));
        Self::around(object.features, topology, drawn, object.notes, scenario)
    }

    /// The setup of another scenario. Its object, where it is the same, is shared and not built again.
    ///
    /// # Errors
    /// As [`Setup::new`].
    pub fn varied(&self, scenario: &Scenario) -> Result<Self, InputError> {
        let mesh_is_given = (self.scenario.mesh_is_given, scenario.mesh_is_given);
        if self.scenario.object != scenario.object || mesh_is_given != (false, false) {
            return Self::new(scenario);
        }
        let model = &self.model;
        let topology = Arc::clone(&model.planning.topology);
        let features = model.world.rest.clone();
        let notes = self.object_notes.clone();
        Self::around(
            features,
            topology,
            Arc::clone(&model.drawn),
            notes,
            scenario,
        )
    }

    fn around(
        features: Vec<Point3<f64>>,
        topology: Arc<Topology>,
        drawn: Arc<Mesh>,
        object_notes: Vec<String>,
        scenario: &Scenario,
    ) -> Result<Self, InputError> {
        let noise = scenario.filter_noise();
        let (robot, sensor) = (&scenario.robot, &scenario.sensor);
        let start = Pose::new(
            EulerAngles::from_vector(&robot.start_deg.map(f64::to_radians)),
            robot.start_cm.point(),
        );
        let planning = PlanningModel {
            noise: FilterNoise {
                rotation_sigma: noise.rotation_sigma_rad,
                translation_sigma: noise.translation_sigma_cm,
                feature_motion_sigma: noise.feature_motion_sigma_cm(),
                feature_measurement_sigma: noise.feature_measurement_sigma_cm,
                structure_measurement_sigma: noise.structure_measurement_sigma_cm,
            },
            measures_structure: scenario.filter.structure == Structure::AllPairs,
            sensor: Sensor {
                min_range: *sensor.min_range_cm,
                max_range: *sensor.range_cm,
            },
            topology,
            actions: action_set(&robot.actions),
            clearance: *robot.clearance_cm,
        };
        let estimator = scenario.registry().estimators();
        let estimator = estimator.get(scenario.filter.estimator.as_str());
        let estimator =
            estimator.map_err(|unknown| scenario.error_at("filter.estimator", unknown))?;
        let model = EpisodeModel {
            name: scenario.name.to_string(),
            steps: scenario.steps.get(),
            known_motion: scenario.believed_motion(&features)?,
            world: Arc::new(WorldModel {
                start,
                motion: scenario.true_motion(&features)?,
                rest: features,
                noise: world_noise(scenario, noise.initial_feature_sigma_cm),
                faults: faults(&scenario.mismatch),
            }),
            planning: Arc::new(planning),
            estimator: estimator.clone(),
            gate_probability: scenario
                .filter
                .gate_probability
                .and_then(|probability| GateProbability::new(*probability)),
            initial_feature_sigma: noise.initial_feature_sigma_cm,
            viewpoint_reached_within: *scenario.planners.global.reached_within_cm,
            drawn,
        };
        let setup = Self {
            model,
            warnings: object_notes
                .iter()
                .map(|note| format!("{}: {note}", scenario.name))
                .collect(),
            object_notes,
            scenario: scenario.clone(),
        };
        setup.checked()
    }

    /// The same with another estimator of the registry.
    ///
    /// # Errors
    /// Where it has none of that name.
    pub fn with_estimator(&self, estimator: EstimatorName) -> Result<Self, UnknownName> {
        let entry = self.scenario.registry().estimators();
        let entry = entry.get(estimator.as_str())?.clone();
        let mut setup = self.clone();
        setup.model.estimator = entry;
        setup.scenario.filter.estimator = estimator;
        Ok(setup)
    }

    /// The scenario's name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.model.name
    }

    /// A run of `planner` with the noise of `seed`, at its start, and what its user should know of that.
    ///
    /// # Errors
    /// What [`Episode::start`] and [`build_planner`](crate::build_planner) cannot begin with.
    pub fn episode(
        &self,
        planner: PlannerName,
        seed: u64,
    ) -> Result<(Episode, Vec<String>), EpisodeError> {
        let mut episode = Episode::start(&self.model, seed)?;
        let (built, warnings) = build_planner(self, planner, episode.belief(), seed)
            .map_err(|cause| EpisodeError::Planning { step: 1, cause })?;
        episode.set_planner(built, self.scenario.deadline_ms(planner));
        Ok((episode, warnings))
    }

    /// What a user should know of runs of this planner that are to be repeatable; `None` where they are.
    #[must_use]
    pub fn deadline_warning(&self, planner: PlannerName) -> Option<String> {
        self.scenario.deadline_ms(planner)?;
        Some(format!(
            "{}: the {planner} planner has a deadline, so that its runs depend on the machine and cannot be \
             repeated",
            self.model.name
        ))
    }
}

fn world_noise(scenario: &Scenario, initial_feature_sigma: f64) -> WorldNoise {
    let (noise, mismatch) = (&scenario.noise, &scenario.mismatch);
    let of_robot = *mismatch.robot_noise_factor;
    let of_features = *mismatch.feature_noise_factor;
    WorldNoise {
        rotation_sigma: of_robot * *noise.rotation_sigma_rad,
        translation_sigma: of_robot * *noise.translation_sigma_cm,
        feature_translation_sigma: of_features * *noise.feature_translation_sigma_cm,
        feature_deformation_sigma: of_features * *noise.feature_deformation_sigma_cm,
        feature_measurement_sigma: *mismatch.measurement_noise_factor
            * *noise.feature_measurement_sigma_cm,
        structure_measurement_sigma: *mismatch.structure_noise_factor
            * *noise.structure_measurement_sigma_cm,
        initial_feature_sigma,
        deformation: match noise.deformation_noise {
            scenario::DeformationNoise::Fresh => DeformationNoise::Fresh,
            scenario::DeformationNoise::Accumulating => DeformationNoise::Accumulating,
        },
        truncate_at_sigmas: noise.truncate_at_sigmas.map(|limit| *limit),
    }
}

fn faults(mismatch: &scenario::Mismatch) -> Faults {
    Faults {
        outlier_probability: *mismatch.outlier_probability,
        outlier_sigma: mismatch.outlier_sigma_cm.map_or(0.0, |sigma| *sigma),
        missed_detection_probability: *mismatch.missed_detection_probability,
        dropped_structure_probability: *mismatch.dropped_structure_probability,
    }
}

fn action_set(actions: &scenario::Actions) -> ActionSet {
    let cm =
        |list: &values::List<values::Finite>| -> Vec<f64> { list.iter().map(|v| **v).collect() };
    let rad = |list: &values::List<values::Finite>| -> Vec<f64> {
        list.iter().map(|v| v.to_radians()).collect()
    };
    let (roll, pitch, yaw) = (
        rad(&actions.roll_deg),
        rad(&actions.pitch_deg),
        rad(&actions.yaw_deg),
    );
    let (dx, dz) = (cm(&actions.dx_cm), cm(&actions.dz_cm));
    ActionSet::grid(
        [&roll, &pitch, &yaw],
        [&dx, &dz],
        actions.max_roll_deg.to_radians(),
        actions.max_pitch_deg.to_radians(),
    )
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use adslam_agent::EstimatorEntry;
    use adslam_estimator::EstimatorKind;
    use adslam_scenario::registry::Registry;

    use super::*;

    const POLYGON: &str = include_str!("../../../scenarios/polygon.toml");

    /// One that is the paper's under another name gives the paper's run.
    #[test]
    fn an_estimator_of_ones_own_follows_the_robot() {
        let mine = EstimatorName::literal("mine");
        let entry = EstimatorEntry::new(mine, |noise, _, parallelism| {
            EstimatorKind::EulerEkf.build(noise, None, parallelism)
        });
        let registry = Registry::standard().with_estimator(entry.clone()).unwrap();
        assert!(
            registry.clone().with_estimator(entry).is_err(),
            "its name is taken"
        );
        let text = format!("{POLYGON}\n[filter]\nestimator = \"mine\"\n");
        let path = Path::new("polygon.toml");
        let scenario = Scenario::parse_with(&text, path, &registry).unwrap();
        let setup = Setup::new(&scenario).unwrap();
        assert_eq!(setup.model.estimator.name, mine);
        let error = |setup: &Setup| {
            let (mut episode, _) = setup.episode(PlannerName::LOCAL, 1).unwrap();
            let decision = episode.decide().unwrap();
            episode.take(&decision.control).unwrap();
            episode.summary().pose_error_mean
        };
        let papers = Setup::new(&Scenario::parse(POLYGON, path).unwrap()).unwrap();
        assert_eq!(error(&setup).to_bits(), error(&papers).to_bits());
        let other = setup.with_estimator(EstimatorName::SO3_EKF).unwrap();
        assert_ne!(error(&other).to_bits(), error(&papers).to_bits());
        assert!(
            papers.with_estimator(mine).is_err(),
            "it is not in that registry"
        );

        let refused = Scenario::parse(&text, path).unwrap_err();
        assert_eq!(refused.pointed_at(), Some("\"mine\""));
        assert!(
            refused
                .message()
                .contains("`mine` is not one of the choices")
        );
    }
}
