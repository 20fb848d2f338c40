//! Which points a sweep has: the combinations of its grid, and those that are listed.

use adslam_diagnostics::InputError;
use adslam_documents::{Document, Layer};
use schemars::JsonSchema;
use serde::Deserialize;

use crate::values::Name;

/// A larger grid would not fit into memory, each point with its object.
pub const MOST_POINTS: usize = 10_000;
/// More listed points are better made a grid: each is looked up in the text of the file.
const MOST_LISTED: usize = 1_000;

/// A point with overrides of its own.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "SweepPoint")]
pub(super) struct ListedPoint {
    /// What it is called in the tables; no two may share it. Default: no name.
    pub(super) label: Option<Name>,
    /// Overrides at this point, over those of all: each key is a path into the scenario, in quotes. Default:
    /// none.
    #[serde(default, rename = "set")]
    #[schemars(schema_with = "crate::schema::overrides")]
    _set: toml::Table,
}

/// Where a point's overrides stand.
pub(super) struct Place {
    pub(super) label: Option<String>,
    pub(super) layer: Layer,
}

/// What is varied cannot be the same for all.
pub(super) fn refuse_varied_constants(
    document: &Document,
    grid: &[(String, usize)],
) -> Result<(), InputError> {
    let constants = document.keys("set");
    let Some((both, _)) = grid.iter().find(|(key, _)| constants.contains(key)) else {
        return Ok(());
    };
    let merged = document.with_overrides(document, vec![Layer::of_values("set")], &[]);
    let message = format!("`{both}` is varied in [grid] too");
    Err(merged
        .error_at_override(&(0, both.clone()), message)
        .with_help("keep it in one of the two"))
}

/// The points of the grid, its last key fastest, and then the listed ones.
pub(super) fn places(
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
pub(super) fn varied(document: &Document, grid: &[(String, usize)], listed: usize) -> Vec<String> {
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
