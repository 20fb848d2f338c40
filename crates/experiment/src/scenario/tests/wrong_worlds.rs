//! What is said about values that do not go together, and where the caret points.

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
fn motions() {
    refused(
        "anchor = 0",
        "anchor = 14",
        "there is no feature 14",
        "14",
        "0 to 13",
    );
    refused(
        "[0.0, 0.2, 0.4, 0.6, 0.4, 0.2]",
        "[]",
        "the list is empty",
        "[]",
        "at least one",
    );
    let zero = "[motion.translation_rotation]\naxis = [0, 0, 0]\n[noise]";
    refused(
        "[noise]",
        zero,
        "no direction",
        "[0, 0, 0]",
        "other than zero",
    );
    let known = "[known_motion.deformation.anchored]\nanchor = 99\namounts_cm = [0.1]\n[noise]";
    refused("[noise]", known, "there is no feature 99", "99", "0 to 13");
    let second =
        "[motion.translation.sinusoid]\namplitude_cm = [1, 0, 0]\nperiod_steps = 3\n[noise]";
    refused(
        "[noise]",
        second,
        "exactly one choice",
        "translation",
        "keep one of `back_and_forth`, `sinusoid`",
    );
    refused(
        "translation.back_and_forth",
        "translation.back_and_fort",
        "`back_and_fort` is not one",
        "back_and_fort",
        "did you mean `back_and_forth`?",
    );
    let period = "[motion.deformation.anchored_sinusoid]\namplitude_cm = 1\nperiod_steps = 0";
    let anchored = "[motion.deformation.anchored]\nanchor = 0\ndirection = \"horizontal\"\namounts_cm = [0.0, 0.2, 0.4, 0.6, 0.4, 0.2]";
    refused(anchored, period, "0 is not above 0", "0", "above 0");
}

#[test]
fn mismatches() {
    let with = |keys: &str| format!("[mismatch]\n{keys}\n[noise]");
    for (keys, message, pointed_at, remedy) in [
        (
            "outlier_probability = 1.2",
            "1.2 is no probability",
            "1.2",
            "from 0 to 1",
        ),
        (
            "missed_detection_probability = -0.1",
            "-0.1 is no probability",
            "-0.1",
            "from 0 to 1",
        ),
        (
            "dropped_structure_probability = \"often\"",
            "string \"often\"",
            "\"often\"",
            "a probability from 0 to 1",
        ),
        (
            "outlier_probability = 0.1",
            "no `outlier_sigma_cm` says how gross",
            "0.1",
            "add `outlier_sigma_cm`, such as 1.0",
        ),
        (
            "outlier_probability = 0.1\noutlier_sigma_cm = 0",
            "0 is not above 0",
            "0",
            "above 0",
        ),
        (
            "deformation_factor = -1",
            "-1 is below 0",
            "-1",
            "0 or a number",
        ),
        (
            "measurement_noise_factor = -0.5",
            "-0.5 is below 0",
            "-0.5",
            "0 or a number",
        ),
        (
            "time_factor = -1",
            "-1 is no sensible speed",
            "-1",
            "from 0 to 1000",
        ),
        (
            "time_factor = 1001",
            "1001 is no sensible speed",
            "1001",
            "from 0 to 1000",
        ),
        (
            "delay_steps = inf",
            "not a finite number",
            "inf",
            "write a number",
        ),
        (
            "robot_noise_factor = 200",
            "a sigma of 4 rad",
            "200",
            "smaller factor",
        ),
        (
            "rotation = { axis = [0, 0, 0], rate_deg_per_step = 1 }",
            "no direction",
            "[0, 0, 0]",
            "other than zero",
        ),
        (
            "rotation = { axis = [0, 0, 1] }",
            "the key `rate_deg_per_step` is missing",
            "{ axis = [0, 0, 1] }",
            "The turn of each step (degrees)",
        ),
        (
            "noise_factor = 2",
            "unknown key `noise_factor`",
            "noise_factor",
            "`robot_noise_factor`",
        ),
    ] {
        refused("[noise]", &with(keys), message, pointed_at, remedy);
    }
    // No outliers need no size, and a size does no harm.
    for keys in [
        "outlier_probability = 0",
        "outlier_sigma_cm = 0.3",
        "robot_noise_factor = 157",
    ] {
        polygon_with("[noise]", &with(keys)).unwrap();
    }
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

#[test]
fn viewpoints() {
    refused(
        "min_cm = [-1.5",
        "min_cm = [9.0",
        "x of `min_cm` is above",
        "[9.0, -3.0, -2.0]",
        "smallest",
    );
    refused(
        "excluded_min_cm = [0.5, -1.0, 0.0]\n",
        "",
        "`excluded_max_cm` needs `excluded_min_cm`",
        "[2.5, 1.0, 4.0]",
        "add `excluded_min_cm",
    );
    refused(
        "excluded_max_cm = [2.5, 1.0",
        "excluded_max_cm = [2.5, -2.0",
        "y of `excluded_min_cm`",
        "[0.5, -1.0, 0.0]",
        "smallest",
    );
    refused(
        "spacing_cm = 1.0",
        "spacing_cm = 0.001",
        "candidates",
        "0.001",
        "larger distance",
    );
    let all = "excluded_min_cm = [-1.5, -3, -2]\nexcluded_max_cm = [4.5, 3, 6]";
    refused(
        "excluded_min_cm = [0.5, -1.0, 0.0]\nexcluded_max_cm = [2.5, 1.0, 4.0]",
        all,
        "leaves no candidate",
        "[-1.5, -3, -2]",
        "smaller",
    );
    let both = "[viewpoints.fixed]\npositions_cm = [[0, 0, 0]]\n[planners.global]";
    refused(
        "[planners.global]",
        both,
        "exactly one choice",
        "viewpoints",
        "keep one",
    );
    refused(
        "[robot.actions]",
        "[viewpoints.fixed]\npositions_cm = []\n[robot.actions]",
        "exactly one choice",
        "viewpoints",
        "",
    );
}

#[test]
fn planners() {
    refused(
        "nearest_fraction = 0.1",
        "nearest_fraction = 0.1\nnearest_count = 5",
        "both",
        "5",
        "keep one",
    );
    refused(
        "nearest_fraction = 0.1",
        "",
        "neither",
        "[planners.combined]",
        "nearest_fraction = 0.1",
    );
    refused(
        "nearest_fraction = 0.1",
        "nearest_count = 0",
        "0 is too small",
        "0",
        "from 1",
    );
    refused(
        "[planners.global]",
        "[planners.golbal]",
        "unknown key `golbal`",
        "golbal",
        "did you mean `global`?",
    );
}

#[test]
fn actions() {
    refused(
        "dx_cm = [-0.2, -0.1, 0.0, 0.1, 0.2]",
        "dx_cm = []",
        "the list is empty",
        "[]",
        "at least one",
    );
    let long = format!("dx_cm = [{}]", vec!["0.1"; 1000].join(", "));
    refused(
        "dx_cm = [-0.2, -0.1, 0.0, 0.1, 0.2]",
        &long,
        "135000 actions",
        "[robot.actions]",
        "shorten",
    );
}
