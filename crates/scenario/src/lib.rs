//! Scenario files: what the world is, and what the planners' parameters are in it.
//!
//! The types here are the file: a table is a struct, a key is a field, and the number types of
//! [`values`] let no wrong value in. What several keys must agree on is checked after reading.
//! `docs/scenario.md` is the reference for users.
//!
//! ```
//! use std::path::Path;
//!
//! use adslam_scenario::Scenario;
//!
//! let scenario = Scenario::load(Path::new("../../scenarios/polygon.toml"))?;
//! assert_eq!(scenario.object.feature_count(), 14);
//! let wrong = scenario.text().replace("steps = 100", "step = 100");
//! let error = Scenario::parse(&wrong, Path::new("wrong.toml")).unwrap_err();
//! assert!(error.remedy().unwrap().contains("did you mean `steps`?"));
//! # Ok::<(), adslam_diagnostics::InputError>(())
//! ```

mod checks;
pub mod config;
mod kind;
mod mismatch;
mod motion;
mod noise;
mod object;
mod overridden;
mod planners;
pub mod registry;
mod robot;
pub mod schema;
pub mod sweep;
#[cfg(test)]
pub(crate) mod tests;
pub mod values;
mod viewpoints;
mod written;

use std::path::{Path, PathBuf};

use adslam_deformation::ObjectMotion;
use adslam_diagnostics::InputError;
use adslam_documents::Document;
use adslam_names::PlannerName;
use nalgebra::Point3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use kind::FileKind;
pub use mismatch::{Mismatch, UnmodelledRotation};
pub use motion::{
    Anchored, AnchoredSinusoid, BackAndForthStep, Deformation, Direction, Motion, MotionBuildError,
    Rotation, Swing, Translation,
};
pub use noise::{DeformationNoise, Filter, FilterNoise, Noise, Structure};
pub use object::{Mesh, MeshPlacement, Object, Phantom, Points};
pub use planners::{Combined, Global, Local, Planners, Predetermined};
use registry::Registry;
pub use robot::{Actions, Robot, Sensor};
use values::{Name, Steps};
pub use viewpoints::{Fixed, Grid, Viewpoints};

/// What the world is: the object, its motion, the noise, the sensor, the robot, and the planners'
/// parameters in it. Unknown keys are errors.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scenario {
    /// What it is called in tables and file names: up to 64 letters, digits, `-`, `_` and `.`.
    pub name: Name,
    /// What it is, for readers. Default: none.
    #[serde(default)]
    pub description: String,
    /// Steps of a run, the start included.
    pub steps: Steps,
    /// The object that is mapped: exactly one of three tables.
    pub object: Object,
    /// Where a mesh given with `--mesh` belongs. Default: none.
    pub mesh_placement: Option<MeshPlacement>,
    /// How the object moves. Default: at rest.
    #[serde(default)]
    pub motion: Motion,
    /// What filter and planners believe of that; an empty table believes the object to be at rest.
    /// Default: `motion`.
    pub known_motion: Option<Motion>,
    /// Where the truth departs from all that filter and planners are told. Default: nowhere.
    #[serde(default)]
    pub mismatch: Mismatch,
    /// The noise of the world.
    pub noise: Noise,
    /// Where the filter assumes another noise. Default: `noise`.
    #[serde(default)]
    pub filter: Filter,
    /// What the robot sees.
    pub sensor: Sensor,
    /// The robot, its start and its actions.
    pub robot: Robot,
    /// Where the global planner's path may lead: exactly one of two tables.
    pub viewpoints: Viewpoints,
    /// The parameters of each planner.
    pub planners: Planners,
    /// Whether the object is a mesh that was given beside the file, with [`Scenario::with_mesh`].
    #[serde(skip)]
    pub mesh_is_given: bool,
    /// The text all this came from, to point at when something turns out wrong later.
    #[serde(skip)]
    document: Document,
    /// What its planners' names stand for.
    #[serde(skip)]
    registry: Registry,
}

impl Scenario {
    /// Reads and checks the scenario file at `path`.
    ///
    /// # Errors
    /// When the file cannot be read or holds anything but a valid scenario; the error points at the
    /// place. A mesh file is not opened.
    pub fn load(path: &Path) -> Result<Self, InputError> {
        Self::load_with(path, &Registry::standard())
    }

    /// The same for a program with planners of its own, whose keys it may have.
    ///
    /// # Errors
    /// As [`Scenario::load`].
    pub fn load_with(path: &Path, registry: &Registry) -> Result<Self, InputError> {
        let document = Document::read(path)?;
        FileKind::Scenario.expect(&document)?;
        Self::from_document(document, registry)
    }

    /// Reads and checks a scenario from `text`, as if it were the content of the file at `path`.
    ///
    /// # Errors
    /// As [`Scenario::load`].
    pub fn parse(text: &str, path: &Path) -> Result<Self, InputError> {
        Self::parse_with(text, path, &Registry::standard())
    }

    /// The same for a program with planners of its own.
    ///
    /// # Errors
    /// As [`Scenario::load`].
    pub fn parse_with(text: &str, path: &Path, registry: &Registry) -> Result<Self, InputError> {
        Self::from_document(Document::parse(text, path)?, registry)
    }

    fn from_document(document: Document, registry: &Registry) -> Result<Self, InputError> {
        let mut scenario: Self = document.deserialize_without(&registry.own_tables())?;
        scenario.planners.own = registry.own_keys(&document)?.into_iter().collect();
        scenario.registry = registry.clone();
        registry.check_estimator(scenario.filter.estimator, || {
            document.error_at("filter.estimator", "")
        })?;
        checks::check(&scenario, &document)?;
        if let Object::Mesh(mesh) = &mut scenario.object {
            let folder = document.path().parent().unwrap_or(Path::new(""));
            mesh.file = folder.join(&mesh.file);
        }
        scenario.document = document;
        Ok(scenario)
    }

    /// The same scenario with the mesh in `file` (from the current folder, as on a command line)
    /// for its object.
    ///
    /// The mesh is placed by `[mesh_placement]`; without it, as the mesh of `[object.mesh]`; without
    /// that too, its coordinates are millimetres and stay where they are. As many features are
    /// picked from it, with the same seed, as from the scenario's own mesh or phantom; if its object
    /// is points, 50 with seed 1.
    #[must_use]
    pub fn with_mesh(mut self, file: impl Into<PathBuf>) -> Self {
        let placement = self.mesh_placement.as_ref();
        self.object = self.object.replaced_by_mesh(file.into(), placement);
        self.mesh_is_given = true;
        self
    }

    /// What its planners' names stand for.
    #[must_use]
    pub fn registry(&self) -> &Registry {
        &self.registry
    }

    /// The file this scenario came from.
    pub fn path(&self) -> &Path {
        self.document.path()
    }

    /// What that file says; overrides are not in it.
    pub fn text(&self) -> &str {
        self.document.text()
    }

    /// Every key that is written, overrides in place of what they override, as JSON: what tells two scenarios
    /// apart, whatever their descriptions, their comments and their place.
    pub fn keys(&self) -> serde_json::Value {
        let mut keys = self.document.to_json();
        if let Some(keys) = keys.as_object_mut() {
            keys.remove("description");
        }
        keys
    }

    /// Every key with the value that holds, defaults included, as JSON: all that its runs depend on, but for the
    /// content of a mesh file, of which only the name is there, without its folder. Descriptions are left out.
    #[must_use]
    pub fn effective(&self) -> serde_json::Value {
        let mut keys = serde_json::to_value(self).unwrap_or_default();
        if let Some(keys) = keys.as_object_mut() {
            keys.remove("description");
        }
        if let (Object::Mesh(mesh), Some(file)) =
            (&self.object, keys.pointer_mut("/object/mesh/file"))
        {
            let name = mesh.file.file_name().unwrap_or_default();
            *file = name.to_string_lossy().into();
        }
        keys
    }

    /// The scenario as text, overrides apart.
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// An error that points at the value of `key`, such as `robot.start_cm`, in this scenario's
    /// file (or in the configuration that set it): for what shows only when the world is built.
    /// If the key is not in the file, it points at the table that would hold it.
    pub fn error_at(&self, key: &str, message: impl std::fmt::Display) -> InputError {
        self.document.error_at(key, message)
    }

    /// The noise that the filter assumes, defaults resolved.
    pub fn filter_noise(&self) -> FilterNoise {
        self.filter.resolved(&self.noise)
    }

    /// The feature measurement's sigma that the local planner assumes (cm).
    pub fn local_planning_sigma_cm(&self) -> f64 {
        let own = self.planners.local.feature_measurement_sigma_cm;
        own.map_or(self.filter_noise().feature_measurement_sigma_cm, |sigma| {
            *sigma
        })
    }

    /// The feature measurement's sigma that the combined planner assumes (cm).
    pub fn combined_planning_sigma_cm(&self) -> f64 {
        let own = self.planners.combined.feature_measurement_sigma_cm;
        own.map_or(self.filter_noise().feature_measurement_sigma_cm, |sigma| {
            *sigma
        })
    }

    /// The time that a planner has for a decision, ms; absent where it takes as long as it takes.
    pub fn deadline_ms(&self, planner: PlannerName) -> Option<f64> {
        match planner {
            PlannerName::LOCAL => self.planners.local.deadline_ms.map(|ms| *ms),
            PlannerName::COMBINED => self.planners.combined.deadline_ms.map(|ms| *ms),
            other => self.planners.own.get(&other)?["deadline_ms"].as_f64(),
        }
    }

    /// How the object whose features rest at `rest` (world frame, cm) truly moves: `[motion]`, from
    /// which `[mismatch]` departs.
    ///
    /// # Errors
    /// When fewer features were found than the anchor's number needs.
    pub fn true_motion(&self, rest: &[Point3<f64>]) -> Result<ObjectMotion, InputError> {
        let motion = self.built("motion", &self.motion, rest)?;
        self.mismatch
            .departed(motion, rest)
            .map_err(|error| self.error_at("mismatch", error))
    }

    /// How the filter and the planners believe it to move: `[known_motion]`, or else `[motion]`.
    ///
    /// # Errors
    /// As [`Scenario::true_motion`].
    pub fn believed_motion(&self, rest: &[Point3<f64>]) -> Result<ObjectMotion, InputError> {
        match &self.known_motion {
            Some(known) => self.built("known_motion", known, rest),
            None => self.built("motion", &self.motion, rest),
        }
    }

    fn built(
        &self,
        table: &str,
        motion: &Motion,
        rest: &[Point3<f64>],
    ) -> Result<ObjectMotion, InputError> {
        motion.object_motion(rest).map_err(|error| {
            let key = motion.anchor().map_or("", |(_, key)| key);
            self.error_at(&format!("{table}.{key}"), error)
                .with_help("anchor the deformation at a feature that the object has")
        })
    }
}
