//! What no single value shows: checks across the keys of a scenario.

use adslam_diagnostics::InputError;
use adslam_documents::Document;
use nalgebra::{Matrix3, Point3, Vector3};

use super::values::{FeatureCount, SMALLEST, Vec3};
use super::{Grid, Motion, Object, Points, Scenario, Structure, Viewpoints};

/// Features nearer than this (cm) are the same.
const SAME_PLACE_CM: f64 = 1e-9;
/// An object is flat where its extent in one direction is less than this part of the largest.
const FLAT: f64 = 1e-6;
/// More candidates are a mistake: each is tested against every feature.
const MOST_CANDIDATES: f64 = 100_000.0;
/// More actions are a mistake: each is tested at every step.
const MOST_ACTIONS: usize = 100_000;

/// Checks everything; `at` makes an error about a key.
pub(super) fn check(scenario: &Scenario, document: &Document) -> Result<(), InputError> {
    if let Object::Points(points) = &scenario.object {
        check_points(points, document)?;
    }
    check_motion(&scenario.motion, "motion", &scenario.object, document)?;
    if let Some(known) = &scenario.known_motion {
        check_motion(known, "known_motion", &scenario.object, document)?;
    }
    scenario.mismatch.check(&scenario.noise, document)?;
    check_filter(scenario, document)?;
    check_robot(scenario, document)?;
    if let Viewpoints::Sampled(grid) = &scenario.viewpoints {
        check_grid(grid, document)?;
    }
    check_combined(scenario, document)
}

fn check_points(points: &Points, document: &Document) -> Result<(), InputError> {
    let positions: Vec<Point3<f64>> = points.positions_cm.iter().map(|p| p.point()).collect();
    let count = positions.len();
    let key = "object.points.positions_cm";
    if FeatureCount::new(count as u64).is_err() {
        let message = format!(
            "{count} features are too {}",
            if count < 4 { "few" } else { "many" }
        );
        return Err(document
            .error_at(key, message)
            .with_help("give from 4 to 2000 features"));
    }
    for (second, b) in positions.iter().enumerate() {
        let twin = positions[..second]
            .iter()
            .position(|a| (a - b).norm() < SAME_PLACE_CM);
        if let Some(first) = twin {
            let message = format!("features {first} and {second} are at the same place");
            return Err(document
                .error_at(&format!("{key}[{second}]"), message)
                .with_label(format!("the same as feature {first}"))
                .with_help("every feature needs its own place; features are numbered from 0"));
        }
    }
    if is_flat(&positions) {
        return Err(document
            .error_at(key, "the features all lie in one plane")
            .with_label("these enclose no volume")
            .with_help("the features are the corners of a body; add one outside the plane"));
    }
    for (number, face) in points
        .faces
        .iter()
        .flat_map(|faces| faces.iter())
        .enumerate()
    {
        let corners = face.map(|corner| corner.get());
        if let Some(place) = corners.iter().position(|corner| *corner >= count) {
            let message = format!("there is no feature {}", corners[place]);
            return Err(document
                .error_at(&format!("object.points.faces[{number}][{place}]"), message)
                .with_help(format!("features are numbered from 0 to {}", count - 1)));
        }
        let [a, b, c] = corners;
        if a == b || b == c || c == a {
            return Err(document
                .error_at(
                    &format!("object.points.faces[{number}]"),
                    "this face has a corner twice",
                )
                .with_help("give the numbers of three different features"));
        }
    }
    Ok(())
}

/// Whether the points lie in a plane, on a line or at one place, to rounding.
fn is_flat(points: &[Point3<f64>]) -> bool {
    let vectors = || points.iter().map(|point| point.coords);
    let mean = vectors().sum::<Vector3<f64>>() / points.len() as f64;
    let scatter: Matrix3<f64> = vectors().map(|v| (v - mean) * (v - mean).transpose()).sum();
    let variances = scatter.symmetric_eigenvalues();
    variances.min().max(0.0).sqrt() <= FLAT * variances.max().max(0.0).sqrt()
}

fn check_motion(
    motion: &Motion,
    table: &str,
    object: &Object,
    document: &Document,
) -> Result<(), InputError> {
    let features = object.feature_count();
    if let Some((anchor, key)) = motion.anchor()
        && anchor >= features
    {
        return Err(document
            .error_at(
                &format!("{table}.{key}"),
                format!("there is no feature {anchor}"),
            )
            .with_help(format!("features are numbered from 0 to {}", features - 1)));
    }
    let rotations = [
        ("translation_rotation", &motion.translation_rotation),
        ("deformation_rotation", &motion.deformation_rotation),
    ];
    for (key, rotation) in rotations {
        if let Some(rotation) = rotation {
            check_axis(rotation.axis, &format!("{table}.{key}.axis"), document)?;
        }
    }
    Ok(())
}

/// An axis has to have a direction.
pub(super) fn check_axis(axis: Vec3, key: &str, document: &Document) -> Result<(), InputError> {
    if axis.norm() < SMALLEST {
        return Err(document
            .error_at(key, "the axis has no direction")
            .with_help("write a vector other than zero, such as [0.0, 0.0, 1.0]"));
    }
    Ok(())
}

fn check_filter(scenario: &Scenario, document: &Document) -> Result<(), InputError> {
    let assumed = scenario.filter_noise();
    let structure = scenario.filter.structure == Structure::AllPairs;
    let sigmas = [
        (
            "feature_measurement_sigma_cm",
            assumed.feature_measurement_sigma_cm,
            true,
        ),
        (
            "structure_measurement_sigma_cm",
            assumed.structure_measurement_sigma_cm,
            structure,
        ),
    ];
    for (key, sigma, used) in sigmas {
        if used && sigma < SMALLEST {
            return Err(document
                .error_at(
                    &format!("noise.{key}"),
                    "the filter cannot assume perfect measurements",
                )
                .with_help(format!(
                    "write a number above 0 here, or give `{key}` in [filter]"
                )));
        }
    }
    Ok(())
}

fn check_robot(scenario: &Scenario, document: &Document) -> Result<(), InputError> {
    let sensor = &scenario.sensor;
    if *sensor.min_range_cm >= *sensor.range_cm {
        let (nearest, farthest) = (*sensor.min_range_cm, *sensor.range_cm);
        let message =
            format!("the sensor sees from {nearest} cm (`min_range_cm`) to {farthest} cm: nothing");
        return Err(document
            .error_at("sensor.range_cm", message)
            .with_help(format!(
                "write a range above {nearest}, or a smaller `min_range_cm`"
            )));
    }
    let actions = scenario.robot.actions.count();
    if actions > MOST_ACTIONS {
        return Err(document
            .error_at(
                "robot.actions",
                format!("the lists combine to {actions} actions"),
            )
            .with_help(format!(
                "shorten them to {MOST_ACTIONS} combinations or fewer"
            )));
    }
    Ok(())
}

fn check_grid(grid: &Grid, document: &Document) -> Result<(), InputError> {
    let key = |name: &str| format!("viewpoints.sampled.{name}");
    let blocks = [
        (Some(grid.min_cm), Some(grid.max_cm), "min_cm", "max_cm"),
        (
            grid.excluded_min_cm,
            grid.excluded_max_cm,
            "excluded_min_cm",
            "excluded_max_cm",
        ),
    ];
    for (min, max, min_key, max_key) in blocks {
        let (min, max) = match (min, max) {
            (Some(min), Some(max)) => (min, max),
            (None, None) => continue,
            (one, _) => {
                let (given, missing) = if one.is_some() {
                    (min_key, max_key)
                } else {
                    (max_key, min_key)
                };
                return Err(document
                    .error_at(
                        &key(given),
                        format!("`{given}` needs `{missing}` beside it"),
                    )
                    .with_help(format!("add `{missing} = […]`, or take this out")));
            }
        };
        if let Some(axis) = (0..3).find(|&axis| min[axis] > max[axis]) {
            let message = format!(
                "{} of `{min_key}` is above that of `{max_key}`",
                "xyz".get(axis..=axis).unwrap_or("one")
            );
            return Err(document.error_at(&key(min_key), message).with_help(format!(
                "give the smallest coordinates here, the largest in `{max_key}`"
            )));
        }
    }
    let size = grid.size();
    if size > MOST_CANDIDATES {
        return Err(document
            .error_at(
                &key("spacing_cm"),
                format!("the grid has {size} candidates"),
            )
            .with_help(format!(
                "write a larger distance, for at most {MOST_CANDIDATES}"
            )));
    }
    if grid.candidates().is_empty() {
        return Err(document
            .error_at(
                &key("excluded_min_cm"),
                "the excluded block leaves no candidate",
            )
            .with_help("make the block smaller, or the grid larger"));
    }
    Ok(())
}

fn check_combined(scenario: &Scenario, document: &Document) -> Result<(), InputError> {
    let combined = &scenario.planners.combined;
    let key = "planners.combined";
    match (&combined.nearest_fraction, &combined.nearest_count) {
        (Some(_), Some(_)) => Err(document
            .error_at(
                &format!("{key}.nearest_count"),
                "both `nearest_fraction` and `nearest_count` are given",
            )
            .with_help(
                "keep one of them; to override one by the other, set the whole table: \
                 \"planners.combined\" = { nearest_count = 1 }",
            )),
        (None, None) => Err(document
            .error_at(
                key,
                "neither `nearest_fraction` nor `nearest_count` is given",
            )
            .with_label("in this table")
            .with_help("add one of them, such as `nearest_fraction = 0.1`")),
        _ => Ok(()),
    }
}
