//! Sweep files: what is varied, over which values.

use std::path::{Path, PathBuf};

use adslam_diagnostics::InputError;
use adslam_documents::{Document, Layer, json_at};
use adslam_names::PlannerName;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::{Map, Value};

use super::places::{ListedPoint, Place, places, refuse_varied_constants, varied};
use crate::config::{MOST_RUNS_IN_ALL, Runs, each_once, first_seed, reachable};
use crate::registry::Registry;
use crate::values::{List, Seed};
use crate::{FileKind, Scenario};

/// Points that are read before it is looked whether one of them is wrong.
const POINTS_AT_A_TIME: usize = 64;

/// A sweep with its scenario read, and overridden and checked at each point.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// The file it came from.
    pub path: PathBuf,
    /// What it shows, for the head of its tables.
    pub title: String,
    /// Runs of each planner at each point.
    pub runs: usize,
    /// The seed of the first run; the others count up from it.
    pub first_seed: u64,
    /// The planners, each once, in the order of the file.
    pub planners: Vec<PlannerName>,
    /// The scenario without any override.
    pub scenario: Scenario,
    /// The keys that are varied: those of the grid and then those of the listed points, in the order of the file.
    pub varied: Vec<String>,
    /// The points: those of the grid, its last key fastest, and then the listed ones.
    pub points: Vec<SweepPoint>,
}

/// A scenario of a sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepPoint {
    /// What it is called, if anything.
    pub label: Option<String>,
    /// The scenario with all overrides of this point.
    pub scenario: Scenario,
    /// The value of each key that the sweep varies; none where the scenario does not give it.
    pub values: Vec<Option<Value>>,
    /// Every override, by key.
    pub overrides: Map<String, Value>,
}

/// A scenario with some of its keys varied, the planners that run at each point, and how often. Unknown keys are
/// errors.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Sweep")]
pub struct SweepFile {
    /// Head of the tables.
    title: String,
    /// Runs of each planner at each point.
    #[serde(default = "runs")]
    runs: Runs,
    /// Seed of the first run; the others count up from it. Every planner meets the same noise at the
    /// same seed, and so does every point.
    #[serde(default = "first_seed")]
    first_seed: Seed,
    /// The scenario; its path counts from this file's folder.
    #[schemars(extend("format" = "path"))]
    scenario: PathBuf,
    /// The planners that run, each once.
    planners: List<PlannerName>,
    /// Overrides of the scenario's keys at all points: each key is a path into the scenario, in quotes. Default:
    /// none.
    // Only their being tables is looked at here: `Document` reads them in place.
    #[serde(default, rename = "set")]
    #[schemars(schema_with = "crate::schema::overrides")]
    _set: toml::Table,
    /// Keys that are varied, each with the list of its values: every combination is a point, the last key varied
    /// fastest. Default: none.
    #[serde(default, rename = "grid")]
    #[schemars(schema_with = "crate::schema::lists_of_overrides")]
    _grid: toml::Table,
    /// Points beside those of the grid: a `[[points]]` for each. Default: none.
    #[serde(default)]
    points: Vec<ListedPoint>,
}

impl Sweep {
    /// Reads and checks the sweep at `path`, its scenario, and the scenario of every point.
    ///
    /// # Errors
    /// When one of the files cannot be read or holds anything but what belongs there, when nothing is varied, or
    /// when there is too much to run. A scenario's own fault is shown in the scenario's file, that of a point in
    /// the sweep.
    pub fn load(path: &Path) -> Result<Self, InputError> {
        Self::load_with(path, &Registry::standard())
    }

    /// The same for a program with planners of its own.
    ///
    /// # Errors
    /// As [`Sweep::load`].
    pub fn load_with(path: &Path, registry: &Registry) -> Result<Self, InputError> {
        let document = Document::read(path)?;
        FileKind::Sweep.expect(&document)?;
        Self::from_document(&document, registry)
    }

    /// Reads and checks a sweep from `text`, as if it were the content of the file at `path`.
    ///
    /// # Errors
    /// As [`Sweep::load`].
    pub fn parse(text: &str, path: &Path) -> Result<Self, InputError> {
        Self::from_document(&Document::parse(text, path)?, &Registry::standard())
    }

    fn from_document(document: &Document, registry: &Registry) -> Result<Self, InputError> {
        let file: SweepFile = document.deserialize()?;
        each_once(document, "planners", &file.planners, registry)?;
        let folder = document.path().parent().unwrap_or(Path::new(""));
        let scenario = reachable(document, "scenario", folder.join(&file.scenario))
            .and_then(|path| Scenario::load_with(&path, registry))?;
        let grid = document.lists("grid")?;
        refuse_varied_constants(document, &grid)?;
        let places = places(document, &grid, &file.points)?;
        let varied = varied(document, &grid, file.points.len());
        let mut points = Vec::new();
        // A mistake of all points is told after the first few.
        for some in places.chunks(POINTS_AT_A_TIME) {
            let some: Vec<Result<SweepPoint, InputError>> = some
                .par_iter()
                .map(|place| point(document, &scenario, place, &varied))
                .collect();
            points.extend(some.into_iter().collect::<Result<Vec<_>, _>>()?);
        }
        let sweep = Self {
            path: document.path().to_owned(),
            title: file.title,
            runs: file.runs.get(),
            first_seed: file.first_seed.as_u64(),
            planners: file.planners.to_vec(),
            scenario,
            varied,
            points,
        };
        if sweep.runs_in_all(sweep.runs).is_none() {
            let message = sweep.too_many(sweep.runs);
            return Err(document
                .error_at("runs", message)
                .with_help("vary less, or lower `runs`"));
        }
        Ok(sweep)
    }

    /// How many runs there are with so many of each planner at each point; none if that is too many.
    #[must_use]
    pub fn runs_in_all(&self, runs: usize) -> Option<usize> {
        self.points
            .len()
            .checked_mul(self.planners.len())?
            .checked_mul(runs)
            .filter(|all| *all <= MOST_RUNS_IN_ALL)
    }

    /// What is wrong with that.
    #[must_use]
    pub fn too_many(&self, runs: usize) -> String {
        format!(
            "{} points with {} planners and {runs} runs of each are more than {MOST_RUNS_IN_ALL} runs",
            self.points.len(),
            self.planners.len()
        )
    }
}

fn point(
    document: &Document,
    scenario: &Scenario,
    place: &Place,
    varied: &[String],
) -> Result<SweepPoint, InputError> {
    let layers = vec![Layer::of_values("set"), place.layer.clone()];
    let scenario = scenario.overridden(document, layers)?;
    let keys = scenario.keys();
    let overrides = scenario.document().overrides().into_iter();
    let overrides = overrides
        .filter_map(|(_, key)| json_at(&keys, &key).cloned().map(|value| (key, value)))
        .collect();
    Ok(SweepPoint {
        label: place.label.clone(),
        values: varied
            .iter()
            .map(|key| json_at(&keys, key).cloned())
            .collect(),
        scenario,
        overrides,
    })
}

fn runs() -> Runs {
    Runs::default_of(20)
}
