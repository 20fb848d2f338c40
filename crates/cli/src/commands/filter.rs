//! `adslam filter`

use std::fs::{self, File};
use std::io::BufReader;
use std::path::Path;

use adslam_experiment::ExperimentError;
use adslam_experiment::diagnostics::InputError;
use adslam_experiment::log::{FilterChoice, TailPolicy, filter_log};
use adslam_experiment::output::{AtomicFile, prepare_folder};
use adslam_experiment::run::Interrupt;

use crate::answer::Answer;
use crate::paths::folder_of;
use crate::{FilterArgs, progress};

/// Runs the estimator over a log and writes its estimates.
///
/// # Errors
/// Bad input, a covariance that breaks down, a file that cannot be written, or an interruption.
pub fn filter(args: &FilterArgs, interrupt: &Interrupt) -> Result<(), ExperimentError> {
    Answer::give(args.json, |answer| filter_all(args, interrupt, answer))
}

fn filter_all(
    args: &FilterArgs,
    interrupt: &Interrupt,
    answer: &mut Answer,
) -> Result<(), ExperimentError> {
    let log = File::open(&args.log).map_err(|error| InputError::unreadable(&args.log, error))?;
    if same_file(&args.log, &args.out) {
        let message = format!("{} is the log itself", args.out.display());
        return Err(InputError::about_file(&args.out, message)
            .with_help("give another path with --out, so that the log is not lost")
            .into());
    }
    prepare_folder(folder_of(&args.out))?;
    let mut out = AtomicFile::create(&args.out)?;
    let policy = if args.keep_complete {
        TailPolicy::KeepComplete
    } else {
        TailPolicy::Refuse
    };
    let bar = progress::reading(&log);
    let reader = BufReader::new(bar.wrap_read(log));
    let mut steps = 0;
    let choice = FilterChoice {
        estimator: args.estimator,
        gate_probability: args.gate,
    };
    let mut progress = || {
        steps += 1;
        bar.set_message(format!("{steps} steps filtered"));
    };
    let result = filter_log(
        reader,
        &args.log,
        choice,
        &mut out,
        policy,
        interrupt,
        &mut progress,
    );
    bar.finish_and_clear();
    let summary = result?;
    out.commit()?;
    if let Some(reason) = &summary.stopped_by {
        let kept = summary.steps;
        answer.warn(&[format!(
            "{}; kept the {kept} steps before it",
            reason.message()
        )]);
    }
    answer.warn(&summary.warnings);
    answer.set("steps", summary.steps);
    answer.set("features", summary.features);
    answer.set("rejected_measurements", summary.rejected);
    answer.set_files(&[&args.out]);
    let rejected = match summary.rejected {
        0 => String::new(),
        some => format!("the gate kept out {some} feature measurements; "),
    };
    answer.say(format_args!(
        "filtered {} steps with {} features; {rejected}wrote {}",
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
