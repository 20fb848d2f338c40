//! Sweep files: what is varied, over which values.

use std::path::{Path, PathBuf};

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::{Map, Value};

use crate::config::{MOST_RUNS_IN_ALL, Runs, each_once, first_seed, reachable};
use crate::diagnostics::{Document, FileKind, InputError, Layer, json_at};
use crate::scenario::values::{List, Name, Seed};
use crate::scenario::{PlannerName, Scenario};

/// A larger grid would not fit into memory, each point with its object.
pub const MOST_POINTS: usize = 10_000;
/// More listed points are better made a grid: each is looked up in the text of the file.
const MOST_LISTED: usize = 1_000;

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
pub(crate) struct SweepFile {
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

/// A point with overrides of its own.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "SweepPoint")]
struct ListedPoint {
    /// What it is called in the tables; no two may share it. Default: no name.
    label: Option<Name>,
    /// Overrides at this point, over those of all: each key is a path into the scenario, in quotes. Default:
    /// none.
    #[serde(default, rename = "set")]
    #[schemars(schema_with = "crate::schema::overrides")]
    _set: toml::Table,
}

/// Where a point's overrides stand.
struct Place {
    label: Option<String>,
    layer: Layer,
}

impl Sweep {
    /// Reads and checks the sweep at `path`, its scenario, and the scenario of every point.
    ///
    /// # Errors
    /// When one of the files cannot be read or holds anything but what belongs there, when nothing is varied, or
    /// when there is too much to run. A scenario's own fault is shown in the scenario's file, that of a point in
    /// the sweep.
    pub fn load(path: &Path) -> Result<Self, InputError> {
        let document = Document::read(path)?;
        FileKind::Sweep.expect(&document)?;
        Self::from_document(&document)
    }

    /// Reads and checks a sweep from `text`, as if it were the content of the file at `path`.
    ///
    /// # Errors
    /// As [`Sweep::load`].
    pub fn parse(text: &str, path: &Path) -> Result<Self, InputError> {
        Self::from_document(&Document::parse(text, path)?)
    }

    pub(crate) fn from_document(document: &Document) -> Result<Self, InputError> {
        let file: SweepFile = document.deserialize()?;
        each_once(document, "planners", &file.planners)?;
        let folder = document.path().parent().unwrap_or(Path::new(""));
        let scenario = reachable(document, "scenario", folder.join(&file.scenario))
            .and_then(|path| Scenario::load(&path))?;
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

    pub(super) fn too_many(&self, runs: usize) -> String {
        format!(
            "{} points with {} planners and {runs} runs of each are more than {MOST_RUNS_IN_ALL} runs",
            self.points.len(),
            self.planners.len()
        )
    }
}

/// What is varied cannot be the same for all.
fn refuse_varied_constants(
    document: &Document,
    grid: &[(String, usize)],
) -> Result<(), InputError> {
    let constants = document.keys("set");
    let Some((both, _)) = grid.iter().find(|(key, _)| constants.contains(key)) else {
        return Ok(());
    };
    let merged = document.with_overrides(document, vec![Layer::of_values("set")]);
    let message = format!("`{both}` is varied in [grid] too");
    Err(merged
        .error_at_override(&(0, both.clone()), message)
        .with_help("keep it in one of the two"))
}

/// The points of the grid, its last key fastest, and then the listed ones.
fn places(
    document: &Document,
    grid: &[(String, usize)],
    listed: &[ListedPoint],
) -> Result<Vec<Place>, InputError> {
    if listed.len() > MOST_LISTED {
        let message = format!("{} points are listed", listed.len());
        return Err(document
            .error_at("points", message)
            .with_help(format!("list up to {MOST_LISTED}; a [grid] may have more")));
    }
    let combinations = grid.iter().try_fold(1_usize, |product, (_, length)| {
        let product = product.checked_mul(*length)?;
        (product <= MOST_POINTS).then_some(product)
    });
    let Some(combinations) = combinations else {
        let lengths: Vec<String> = grid.iter().map(|(_, length)| length.to_string()).collect();
        let message = format!("the grid has {} points", lengths.join(" · "));
        return Err(document
            .error_at("grid", message)
            .with_help(format!("vary less: up to {MOST_POINTS} points")));
    };
    let in_grid = if grid.is_empty() { 0 } else { combinations };
    if in_grid + listed.len() == 0 {
        return Err(document
            .error_at("", "nothing is varied")
            .with_help("add a [grid] with a list for each key that is varied, or [[points]]"));
    }
    let mut places = Vec::with_capacity(in_grid + listed.len());
    for mut number in 0..in_grid {
        let mut elements = Vec::with_capacity(grid.len());
        for (key, length) in grid.iter().rev() {
            elements.push((key.clone(), number % length));
            number /= length;
        }
        places.push(Place {
            label: None,
            layer: Layer::of_elements("grid", elements),
        });
    }
    for (index, point) in listed.iter().enumerate() {
        let label = point.label.as_ref().map(ToString::to_string);
        let same = |other: &Place| label.is_some() && other.label == label;
        if places[in_grid..].iter().any(same) {
            let label = label.unwrap_or_default();
            let message = format!("two points are called {label:?}");
            return Err(document
                .error_at(&format!("points[{index}].label"), message)
                .with_label("the second of them")
                .with_help(format!(
                    "give this one another name, such as {:?}",
                    label + "-2"
                )));
        }
        places.push(Place {
            label,
            layer: Layer::of_values(format!("points[{index}].set")),
        });
    }
    Ok(places)
}

/// Every key that is varied, once, in the order of the file.
fn varied(document: &Document, grid: &[(String, usize)], listed: usize) -> Vec<String> {
    let mut keys: Vec<String> = grid.iter().map(|(key, _)| key.clone()).collect();
    for index in 0..listed {
        for key in document.keys(&format!("points[{index}].set")) {
            if !keys.contains(&key) {
                keys.push(key);
            }
        }
    }
    keys
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
