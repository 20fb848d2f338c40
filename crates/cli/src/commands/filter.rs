//! `adslam filter`

use std::fs::File;
use std::io::BufReader;

use adslam_experiment::ExperimentError;
use adslam_experiment::diagnostics::InputError;
use adslam_experiment::log::{TailPolicy, filter_log};
use adslam_experiment::output::{AtomicFile, prepare_folder};
use adslam_experiment::run::Interrupt;

use crate::{FilterArgs, progress};

/// Runs the estimator over a log and writes its estimates.
///
/// # Errors
/// Bad input, a covariance that breaks down, a file that cannot be written, or an interruption.
pub fn filter(args: &FilterArgs, interrupt: &Interrupt) -> Result<(), ExperimentError> {
    let log = File::open(&args.log).map_err(|error| InputError::unreadable(&args.log, error))?;
    if let Some(folder) = args
        .out
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty())
    {
        prepare_folder(folder)?;
    }
    let mut out = AtomicFile::create(&args.out)?;
    let policy = if args.keep_complete {
        TailPolicy::KeepComplete
    } else {
        TailPolicy::Refuse
    };
    let counter = progress::counter("steps filtered");
    let reader = BufReader::new(log);
    let result = filter_log(reader, &args.log, &mut out, policy, interrupt, &mut || {
        counter.inc(1);
    });
    counter.finish_and_clear();
    let summary = result?;
    out.commit()?;
    if let Some(reason) = &summary.stopped_by {
        eprintln!("warning: {}; kept the steps before it", reason.message());
    }
    println!(
        "filtered {} steps with {} features; wrote {}",
        summary.steps,
        summary.features,
        args.out.display()
    );
    Ok(())
}
