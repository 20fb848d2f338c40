//! What is said about objects and sensors that do not go together, and where the caret points.

use adslam_surface::{MAX_PHANTOM_SPACING_CM, MIN_PHANTOM_SPACING_CM};

use super::{HEART, POLYGON, assert_error, parsed, polygon_with, refused};

/// The polygon's features as they stand in its file.
fn positions() -> &'static str {
    let start = POLYGON.find("positions_cm").expect("positions");
    let length = POLYGON[start..].find("\n]").expect("their end") + 2;
    &POLYGON[start..start + length]
}

#[test]
fn features() {
    let list = positions();
    refused(
        list,
        "positions_cm = []",
        "the list is empty",
        "[]",
        "at least one",
    );
    let three = "positions_cm = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]";
    refused(
        list,
        three,
        "3 features are too few",
        &three[15..],
        "4 to 2000",
    );
    let flat = "positions_cm = [[0, 0, 1], [1, 0, 2], [0, 1, 3], [1, 1, 4], [0.5, 0.2, 1.9]]";
    refused(
        list,
        flat,
        "all lie in one plane",
        &flat[15..],
        "outside the plane",
    );
    let line = "positions_cm = [[0, 0, 0], [1, 1, 1], [2, 2, 2], [3, 3, 3]]";
    refused(
        list,
        line,
        "all lie in one plane",
        &line[15..],
        "outside the plane",
    );
    refused(
        "[2.0, 0.5, 1.0], # 3",
        "[1.5, -1.0, 1.0],",
        "features 1 and 3 are at the same place",
        "[1.5, -1.0, 1.0]",
        "own place",
    );
    refused(
        "[0, 1, 6]",
        "[0, 1, 14]",
        "no feature 14",
        "14",
        "from 0 to 13",
    );
    refused(
        "[0, 1, 6]",
        "[0, 1, 1]",
        "a corner twice",
        "[0, 1, 1]",
        "three different",
    );
    refused("[0, 1, 6]", "[0, 1]", "", "[0, 1]", "");
    let heart = |from: &str, to: &str| parsed(&HEART.replacen(from, to, 1));
    assert_error(
        heart("features = 50", "features = 0"),
        "0 is too small",
        "0",
        "from 4 to 2000",
    );
    assert_error(
        heart("features = 50", "features = 3"),
        "3 is too small",
        "3",
        "from 4 to 2000",
    );
    for (spacing, problem) in [
        ("1e-5", "0.00001 cm"),
        ("0.199", "0.199 cm"),
        ("0.61", "0.61 cm"),
    ] {
        assert_error(
            heart("features = 50", &format!("spacing_cm = {spacing}")),
            &format!("{problem} is no sensible distance"),
            spacing,
            &format!("between {MIN_PHANTOM_SPACING_CM} and {MAX_PHANTOM_SPACING_CM} cm"),
        );
    }
    for spacing in [MIN_PHANTOM_SPACING_CM, MAX_PHANTOM_SPACING_CM] {
        heart("features = 50", &format!("spacing_cm = {spacing}")).unwrap();
    }
    assert_error(
        heart("anchor = 0", "anchor = 50"),
        "no feature 50",
        "50",
        "0 to 49",
    );
}

#[test]
fn a_list_over_many_lines_has_the_caret_at_its_key() {
    let list = "positions_cm = [\n  [0, 0, 0],\n  [1, 0, 0],\n  [0, 1, 0],\n]";
    refused(
        positions(),
        list,
        "3 features are too few",
        "positions_cm",
        "4 to 2000",
    );
}

#[test]
fn sensor_and_filter() {
    refused(
        "range_cm = 3.0",
        "range_cm = 3.0\nmin_range_cm = 3",
        "sees from 3 cm",
        "3.0",
        "above 3",
    );
    refused(
        "range_cm = 3.0",
        "range_cm = 0.05",
        "sees from 0.1 cm",
        "0.05",
        "smaller `min_range_cm`",
    );
    refused(
        "structure_measurement_sigma_cm = 0.5",
        "structure_measurement_sigma_cm = 0",
        "perfect",
        "0",
        "in [filter]",
    );
    refused(
        "[sensor]",
        "[filter]\nfeature_measurement_sigma_cm = 0\n[sensor]",
        "0 is not above",
        "0",
        "above 0",
    );
    let unused = "structure_measurement_sigma_cm = 0\n[filter]\nstructure = \"none\"\n";
    assert!(polygon_with("structure_measurement_sigma_cm = 0.5", unused).is_ok());
}
