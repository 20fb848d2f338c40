//! What is said about viewpoints, planners and actions that do not go together.

use super::refused;

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
