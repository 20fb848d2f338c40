//! An episode by hand: the controls come from here, the world, the filter and the numbers from adslam.
//!
//!     cargo run --bin episode -- scenarios/polygon.toml

use std::error::Error;
use std::path::Path;

use adslam_scenario::Scenario;
use adslam_setup::Setup;
use adslam_simulation::Episode;

fn main() -> Result<(), Box<dyn Error>> {
    let scenario = std::env::args()
        .nth(1)
        .ok_or("give the path of a scenario")?;
    let setup = Setup::new(&Scenario::load(Path::new(&scenario))?)?;
    let mut episode = Episode::start(&setup.model, 1)?;
    let actions = setup.model.planning.actions.controls();
    while !episode.is_over() {
        // A walk through the action set; a policy that learns would look at `episode.view()` first.
        let step = episode.view().step;
        episode.take(&actions[step * 7919 % actions.len()])?;
    }
    let summary = episode.summary();
    println!(
        "observed {} feature times, mean pose error {:.3}",
        summary.observed, summary.pose_error_mean
    );
    Ok(())
}
