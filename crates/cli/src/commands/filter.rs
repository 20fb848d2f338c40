//! `adslam filter`

use std::fmt::Display;
use std::fs::{self, File};
use std::io::{self, BufRead, BufReader};
use std::path::{Path, PathBuf};

use adslam_agent::GateProbability;
use adslam_diagnostics::{Failure, InputError, Interrupt};
use adslam_experiment::run::refuse_part_of_run;
use adslam_record::log::{FilterChoice, ReplaySummary, TailPolicy, Trajectory, filter_log};
use adslam_record::{AtomicFile, prepare_folder};
use adslam_scenario::registry::Registry;
use indicatif::ProgressBar;

use crate::answer::Answer;
use crate::estimates::{Estimates, is_standard};
use crate::paths::folder_of;
use crate::print::tell;
use crate::{FilterArgs, progress};

/// Runs the estimator over a log and writes its estimates.
///
/// # Errors
/// Bad input, a covariance that breaks down, a file that cannot be written, or an interruption.
pub fn filter(
    args: &FilterArgs,
    registry: &Registry,
    interrupt: &Interrupt,
) -> Result<(), Failure> {
    Answer::give(args.json, |answer| {
        filter_all(args, registry, interrupt, answer)
    })
}

fn filter_all(
    args: &FilterArgs,
    registry: &Registry,
    interrupt: &Interrupt,
    answer: &mut Answer,
) -> Result<(), Failure> {
    check_outputs(args)?;
    let (reader, path, bar) = open(&args.log)?;
    let mut out = Estimates::create(&args.out)?;
    let mut trajectory = Trajectory::default();
    let policy = if args.keep_complete {
        TailPolicy::KeepComplete
    } else {
        TailPolicy::Refuse
    };
    let choice = FilterChoice {
        estimator: args.estimator,
        gate: args.gate.unwrap_or_default(),
    };
    let mut steps = 0;
    let mut each = |line: &_| {
        out.add(line)?;
        if args.tum.is_some() {
            trajectory.add(line);
        }
        steps += 1;
        bar.set_message(format!("{steps} steps filtered"));
        Ok(())
    };
    let result = filter_log(
        reader,
        &path,
        choice,
        registry.estimators(),
        policy,
        interrupt,
        &mut each,
    );
    bar.finish_and_clear();
    let summary = match result {
        // Whoever reads the estimates has seen enough, as in `adslam filter … --out - | head`.
        Err(Failure::Output { cause, .. })
            if is_standard(&args.out) && cause.kind() == io::ErrorKind::BrokenPipe =>
        {
            return Ok(());
        }
        result => result?,
    };
    let mut files: Vec<AtomicFile> = out.finish().into_iter().collect();
    if let Some(path) = &args.tum {
        prepare_folder(folder_of(path))?;
        let (file, warning) = trajectory.write(path, summary.length_unit, args.unit)?;
        files.push(file);
        answer.warn(warning.as_slice());
    }
    let written: Vec<PathBuf> = files.iter().map(|file| file.path().to_owned()).collect();
    AtomicFile::commit_all(files)?;
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
    answer.set("estimator", summary.estimator);
    let gate = summary.gate_probability.map(GateProbability::get);
    answer.set("gate_probability", gate);
    answer.set(
        "rejected_measurements",
        summary.numbers.rejected_measurements,
    );
    answer.set("summary", &summary.numbers);
    answer.set_files(&written);
    let say = |line: &dyn Display| {
        if is_standard(&args.out) {
            tell(line);
        } else {
            answer.say(line);
        }
    };
    say_for_people(&summary, &written, &say);
    Ok(())
}

fn say_for_people(summary: &ReplaySummary, written: &[PathBuf], say: &dyn Fn(&dyn Display)) {
    let gate = summary
        .gate_probability
        .map_or(String::new(), |probability| {
            format!(", gate {}", probability.get())
        });
    let rejected = match summary.numbers.rejected_measurements {
        0 => String::new(),
        some => format!("; the gate kept out {some} feature measurements"),
    };
    let written: Vec<String> = written
        .iter()
        .map(|path| path.display().to_string())
        .collect();
    let written = if written.is_empty() {
        String::new()
    } else {
        format!("; wrote {}", written.join(", "))
    };
    say(&format_args!(
        "filtered {} steps with {} features ({}{gate}){rejected}{written}",
        summary.steps, summary.features, summary.estimator,
    ));
    let Some(errors) = &summary.numbers.errors else {
        return;
    };
    let unit = summary.length_unit;
    say(&format_args!(
        "against the truth: mean pose error {:.3} (rad and {unit}), mean feature error {:.3} {unit} at \
         the end",
        errors.pose_error_mean, errors.feature_error_mean,
    ));
    let nees = |mean: Option<f64>| mean.map_or("none".to_owned(), |mean| format!("{mean:.2}"));
    say(&format_args!(
        "mean NEES: pose {} (6 is consistent), feature {} (3), whole state {} for each degree of \
         freedom (1)",
        nees(errors.pose_nees_mean),
        nees(errors.feature_nees_mean),
        nees(errors.joint_nees_per_dof_mean),
    ));
}

/// The log, its path for messages, and a bar that shows how much of it has been read.
fn open(log: &Path) -> Result<(Box<dyn BufRead>, PathBuf, ProgressBar), InputError> {
    if is_standard(log) {
        let bar = progress::reading(None);
        let reader = BufReader::new(bar.wrap_read(io::stdin()));
        return Ok((Box::new(reader), PathBuf::from("standard input"), bar));
    }
    let file = File::open(log).map_err(|error| InputError::unreadable(log, error))?;
    let bar = progress::reading(Some(&file));
    let reader = BufReader::new(bar.wrap_read(file));
    Ok((Box::new(reader), log.to_owned(), bar))
}

/// Whether what is written goes to places of its own.
fn check_outputs(args: &FilterArgs) -> Result<(), InputError> {
    let wrong = |path: &Path, message: String, help: &str| {
        Err(InputError::about_file(path, message).with_help(help))
    };
    let (log, out) = (&args.log, &args.out);
    if is_standard(out) && args.json {
        let message = "the estimates and the answer of --json would both go to the standard output";
        let help = "give --out a file, or leave --json out";
        return wrong(out, message.to_owned(), help);
    }
    for path in std::iter::once(out).chain(&args.tum) {
        refuse_part_of_run(path)?;
    }
    if is_same(log, out) {
        let message = format!("{} is the log itself", out.display());
        let help = "give another path with --out, so that the log is not lost";
        return wrong(out, message, help);
    }
    let Some(tum) = &args.tum else { return Ok(()) };
    if is_standard(tum) {
        let message = "the trajectory cannot go to the standard output".to_owned();
        return wrong(tum, message, "give --tum a file");
    }
    for (other, what) in [(log, "the log itself"), (out, "the file of estimates")] {
        if is_same(tum, other) {
            let message = format!("{} is {what}", tum.display());
            return wrong(tum, message, "give another path with --tum");
        }
    }
    Ok(())
}

/// Whether both paths lead to one file, be it through links or `..`.
fn is_same(a: &Path, b: &Path) -> bool {
    if is_standard(a) || is_standard(b) {
        return false;
    }
    match (fs::canonicalize(a), fs::canonicalize(b)) {
        (Ok(a), Ok(b)) => a == b,
        _ => a == b,
    }
}
