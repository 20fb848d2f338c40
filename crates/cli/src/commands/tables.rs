//! `adslam tables`

use adslam_experiment::ExperimentError;
use adslam_experiment::output::{AtomicFile, prepare_folder};
use adslam_experiment::run::Interrupt;
use adslam_experiment::tables::{TablePlan, TablesOptions, markdown, terminal, write_json};

use super::warn;
use crate::{TablesArgs, progress};

/// Runs a configuration, prints its tables, and writes tables.md and tables.json.
///
/// Interrupted, it still tabulates and writes the runs that have finished.
///
/// # Errors
/// Bad input, runs that failed, files that cannot be written, or an interruption.
pub fn tables(args: &TablesArgs, interrupt: &Interrupt) -> Result<(), ExperimentError> {
    let options = TablesOptions {
        runs: args.runs,
        only: args.only.clone(),
        mesh: args.mesh.clone(),
    };
    let plan = TablePlan::load(&args.config, &options)?;
    prepare_folder(&args.out)?;
    let bar = progress::bar(plan.total_runs(), "runs");
    let tables = plan.run(interrupt, &|| bar.inc(1));
    bar.finish_and_clear();
    warn(&tables.warnings);
    print!("{}", terminal(&tables));
    let (md, json) = (args.out.join("tables.md"), args.out.join("tables.json"));
    AtomicFile::write_all_to(&md, markdown(&tables).as_bytes())?;
    write_json(&tables, &json)?;
    println!("wrote {} and {}", md.display(), json.display());
    tables.into_result()
}
