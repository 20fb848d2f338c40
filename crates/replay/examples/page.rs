//! Makes a page of runs: `cargo run -p adslam-replay --example page -- OUT RUN…`
//!
//! A RUN is the folder of a run, or SCENARIO.toml:PLANNER, which is run with seed 1 and whose
//! history.json is left in the folder OUT.PLANNER.

use std::error::Error;
use std::path::{Path, PathBuf};

use adslam_diagnostics::Interrupt;
use adslam_experiment::run::simulate;
use adslam_names::PlannerName;
use adslam_record::{HistoryRecorder, RunHistory};
use adslam_scenario::Scenario;
use adslam_setup::Setup;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let out = arguments.next().ok_or("give the page to write, and runs")?;
    let histories = arguments
        .map(|run| history(&out, &run))
        .collect::<Result<Vec<_>, _>>()?;
    let histories: Vec<&RunHistory> = histories.iter().collect();
    let size = adslam_replay::write_html(&histories, Path::new(&out))?;
    println!("wrote {out}, {size} bytes");
    Ok(())
}

fn history(out: &str, run: &str) -> Result<RunHistory, Box<dyn Error>> {
    let Some((scenario, planner)) = run.split_once(':') else {
        return Ok(RunHistory::load(Path::new(run))?);
    };
    let setup = Setup::new(&Scenario::load(Path::new(scenario))?)?;
    let planner = PlannerName::new(planner)?;
    let mut recorder = HistoryRecorder::new(&setup.model, planner, 1);
    simulate(&setup, planner, 1, &Interrupt::new(), &mut recorder)?;
    let folder = PathBuf::from(format!("{out}.{planner}"));
    std::fs::create_dir_all(&folder)?;
    recorder.history().to_file(&folder)?.commit()?;
    Ok(recorder.into_history())
}
