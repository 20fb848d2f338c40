//! The trajectories as the evo tools read them, where evo is installed.

use std::process::Command;

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
    place.succeeds("run polygon.toml --planner predetermined --out run");
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
    let theirs: f64 = said
        .lines()
        .find_map(|line| line.trim().strip_prefix("rmse"))
        .and_then(|number| number.trim().parse().ok())
        .unwrap();

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
    let ours = (squares.iter().sum::<f64>() / squares.len() as f64).sqrt();
    assert!(ours > 1e-3, "there is an error to compare: {ours}");
    // evo prints six decimals.
    assert!((ours - theirs).abs() < 1e-6, "ours {ours}, evo's {theirs}");
}
