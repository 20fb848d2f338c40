//! `adslam filter`

use std::fs::{self, File};
use std::io::BufReader;
use std::path::Path;

use adslam_experiment::ExperimentError;
use adslam_experiment::diagnostics::InputError;
use adslam_experiment::log::{TailPolicy, filter_log};
use adslam_experiment::output::{AtomicFile, prepare_folder};
use adslam_experiment::run::Interrupt;

use crate::print::{say, tell};
use crate::{FilterArgs, progress};

/// Runs the estimator over a log and writes its estimates.
///
/// # Errors
/// Bad input, a covariance that breaks down, a file that cannot be written, or an interruption.
pub fn filter(args: &FilterArgs, interrupt: &Interrupt) -> Result<(), ExperimentError> {
    let log = File::open(&args.log).map_err(|error| InputError::unreadable(&args.log, error))?;
    if same_file(&args.log, &args.out) {
        let message = format!("{} is the log itself", args.out.display());
        return Err(InputError::about_file(&args.out, message)
            .with_help("give another path with --out, so that the log is not lost")
            .into());
    }
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
        tell(format_args!(
            "warning: {}; kept the {} steps before it",
            reason.message(),
            summary.steps
        ));
    }
    say(format_args!(
        "filtered {} steps with {} features; wrote {}",
        summary.steps,
        summary.features,
        args.out.display()
    ));
    Ok(())
}

/// Whether both paths lead to one file, be it through links or `..`.
fn same_file(a: &Path, b: &Path) -> bool {
    match (fs::canonicalize(a), fs::canonicalize(b)) {
        (Ok(a), Ok(b)) => a == b,
        _ => false,
    }
}
