//! A study from code: two planners at the same seeds, and a paired test of their difference.
//!
//!     cargo run --release --bin study_from_code -- scenarios/polygon.toml 20

use std::error::Error;
use std::path::Path;

use adslam_diagnostics::Interrupt;
use adslam_experiment::run::Batch;
use adslam_names::PlannerName;
use adslam_scenario::Scenario;
use adslam_setup::Setup;
use adslam_statistics::PairedComparison;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let scenario = arguments
        .next()
        .ok_or("give a scenario, and how many seeds")?;
    let seeds: u64 = arguments.next().map_or(Ok(10), |seeds| seeds.parse())?;
    let setup = Setup::new(&Scenario::load(Path::new(&scenario))?)?;
    let errors = |planner: PlannerName| -> Result<Vec<f64>, Box<dyn Error>> {
        let run = |seed| Batch {
            setup: &setup,
            planner,
            seed,
            record: false,
        };
        let runs: Vec<Batch<'_>> = (1..=seeds).map(run).collect();
        let results = Batch::run_all(&runs, &Interrupt::new(), &|| ());
        results
            .into_iter()
            .map(|run| Ok(run?.summary.relative_pose_error_mean))
            .collect()
    };
    let (local, global) = (errors(PlannerName::LOCAL)?, errors(PlannerName::GLOBAL)?);
    let differences: Vec<f64> = local
        .iter()
        .zip(&global)
        .map(|(local, global)| local - global)
        .collect();
    let compared = PairedComparison::of(&differences).ok_or("no runs")?;
    let mean = compared.difference;
    let within = mean.interval.map_or(String::new(), |at| {
        format!(" (95 %: {:.4} to {:.4})", at.low, at.high)
    });
    println!(
        "local - global: {:.4}{within}, p = {:.4}",
        mean.mean, compared.p
    );
    Ok(())
}
