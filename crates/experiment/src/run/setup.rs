//! A scenario made ready to run: read once, shared by all its runs.

use std::sync::Arc;

use adslam_deformation::ObjectMotion;
use adslam_estimator::{Estimator, EstimatorError, EstimatorKind, FilterNoise, Parallelism};
use adslam_models::{Control, EulerAngles, Pose, Sensor};
use adslam_planning::{ActionSet, PlanningModel};
use adslam_surface::{Mesh, Topology};
use nalgebra::{Point3, Vector3};

use super::rest_object::RestObject;
use crate::diagnostics::InputError;
use crate::scenario::{self, PlannerName, Scenario, Structure, values};
use crate::statistics::chi_squared;
use crate::world::{DeformationNoise, Faults, WorldModel, WorldNoise};

/// Everything that the runs of one scenario have in common.
#[derive(Clone, Debug)]
pub struct Setup {
    /// The scenario's name.
    pub name: String,
    /// Steps of a run, the start included.
    pub steps: usize,
    /// The truth before any noise.
    pub world: WorldModel,
    /// How the filter and the planners believe the object to move.
    pub known_motion: ObjectMotion,
    /// What the planners know; its noise is the filter's.
    pub planning: PlanningModel,
    /// What follows robot and object.
    pub estimator: EstimatorKind,
    /// The largest squared distance, χ² with 3 degrees of freedom, at which the filter believes a feature
    /// measurement; absent where it believes all.
    pub gate: Option<f64>,
    /// The filter's sigma of the first feature positions, cm.
    pub initial_feature_sigma: f64,
    /// The control of the predetermined path.
    pub predetermined: Control,
    /// The surface that is drawn: the mesh's or phantom's, or the features' own.
    pub drawn: Arc<Mesh>,
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
        let topology = Arc::clone(&self.planning.topology);
        let features = self.world.rest.clone();
        let notes = self.object_notes.clone();
        Self::around(features, topology, Arc::clone(&self.drawn), notes, scenario)
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
        let path = &scenario.planners.predetermined;
        let setup = Self {
            name: scenario.name.to_string(),
            steps: scenario.steps.get(),
            known_motion: scenario.believed_motion(&features)?,
            world: WorldModel {
                start,
                motion: scenario.true_motion(&features)?,
                rest: features,
                noise: world_noise(scenario, noise.initial_feature_sigma_cm),
                faults: faults(&scenario.mismatch),
            },
            planning,
            estimator: scenario.filter.estimator.into(),
            gate: scenario.filter.gate_probability.map(gate),
            initial_feature_sigma: noise.initial_feature_sigma_cm,
            predetermined: Control {
                rotation: path.rotation_deg.map(f64::to_radians),
                translation: *path.translation_cm,
            },
            drawn,
            warnings: object_notes
                .iter()
                .map(|note| format!("{}: {note}", scenario.name))
                .collect(),
            object_notes,
            scenario: scenario.clone(),
        };
        setup.checked()
    }

    /// The filter, at the start of a run.
    ///
    /// # Errors
    /// Sigmas that cannot be used, which no scenario lets through.
    pub fn build_estimator(&self) -> Result<Box<dyn Estimator>, EstimatorError> {
        let noise = self.planning.noise;
        self.estimator
            .build(noise, self.gate, Parallelism::Sequential)
    }

    /// What a user should know of runs of this planner that are to be repeatable; nothing where they are.
    #[must_use]
    pub fn deadline_warning(&self, planner: PlannerName) -> Option<String> {
        self.scenario.deadline_ms(planner)?;
        Some(format!(
            "{}: the {planner} planner has a deadline, so that its runs depend on the machine and cannot be \
             repeated",
            self.name
        ))
    }

    /// r_t t + r_d d for each feature from step `n` to `n + 1`, as filter and planners know it, cm.
    #[must_use]
    pub fn known_feature_motion(&self, n: usize) -> Vec<Vector3<f64>> {
        self.world
            .rest
            .iter()
            .map(|rest| self.known_motion.feature_motion(rest, n))
            .collect()
    }
}

/// The squared distance that good measurements of a feature keep with this probability.
pub(crate) fn gate(probability: values::GateProbability) -> f64 {
    chi_squared::quantile(*probability, 3)
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
