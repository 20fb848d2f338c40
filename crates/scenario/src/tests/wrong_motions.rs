//! What is said about motions, and truths that differ from the model, that cannot be.

use super::{polygon_with, refused};

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
