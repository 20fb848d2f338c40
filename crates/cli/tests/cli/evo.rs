//! The trajectories as the evo tools read them, where evo is installed.

use std::io;
use std::process::{Command, Output};

use adslam_test_programs::Program;

use super::support::{Place, polygon};

const EVO_APE: Program = Program {
    what: "evo",
    variable: "ADSLAM_EVO_APE",
    names: &["evo_ape"],
    remedy: "pip install evo",
};

#[test]
fn evo_finds_the_position_error_that_we_do() {
    let Some(evo_ape) = EVO_APE.find() else {
        return;
    };
    let place = Place::new(&[("polygon.toml", &polygon(&[]))]);
    // evo keeps its settings in the home folder.
    let evo = |arguments: &[&str]| {
        let mut command = Command::new(&evo_ape);
        let command = command.args(arguments).env("HOME", place.path("."));
        command.current_dir(place.path(".")).output()
    };
    // evo prints six decimals.
    for (unit, centimetres) in [("m", 100.0), ("cm", 1.0)] {
        let unit_asked_for = if unit == "m" { "" } else { "--unit cm" };
        let run = "run polygon.toml --planner predetermined --out run";
        place.succeeds(&format!("{run} {unit_asked_for}"));
        let (ours, theirs) = (root_mean_square(&place), of_evo(&evo));
        assert!(ours > 1e-3, "there is an error to compare: {ours}");
        let off = (ours / centimetres - theirs).abs();
        assert!(off < 1e-6, "ours {ours} cm, evo's {theirs} {unit}");
    }
}

/// What evo says of both trajectories.
fn of_evo(evo: &impl Fn(&[&str]) -> io::Result<Output>) -> f64 {
    let output = evo(&[
        "tum",
        "run/truth.tum",
        "run/estimate.tum",
        "-r",
        "trans_part",
    ])
    .unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{output:?}");
    said.lines()
        .find_map(|line| line.trim().strip_prefix("rmse"))
        .and_then(|number| number.trim().parse().ok())
        .unwrap()
}

/// Of the position errors in steps.csv, cm.
fn root_mean_square(place: &Place) -> f64 {
    let steps = place.read("run/steps.csv");
    let mut lines = steps.lines();
    let column = lines
        .next()
        .unwrap()
        .split(',')
        .position(|name| name == "position_error_cm")
        .unwrap();
    let squares: Vec<f64> = lines
        .map(|row| {
            row.split(',')
                .nth(column)
                .unwrap()
                .parse::<f64>()
                .unwrap()
                .powi(2)
        })
        .collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}
