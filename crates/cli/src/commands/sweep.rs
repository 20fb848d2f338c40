//! `adslam sweep`

use adslam_experiment::ExperimentError;
use adslam_experiment::run::Interrupt;
use adslam_experiment::sweep::{SweepPlan, SweepResults};

use super::study::finish;
use crate::SweepArgs;
use crate::answer::Answer;

/// Does the runs of a sweep that are not there yet, and writes its tables.
///
/// # Errors
/// Bad input, runs that failed, files that cannot be written, or an interruption.
pub fn sweep(args: &SweepArgs, interrupt: &Interrupt) -> Result<(), ExperimentError> {
    Answer::give(args.json, |answer| run_missing(args, interrupt, answer))
}

fn run_missing(
    args: &SweepArgs,
    interrupt: &Interrupt,
    answer: &mut Answer,
) -> Result<(), ExperimentError> {
    let plan = SweepPlan::load(&args.sweep, args.runs)?;
    answer.warn(&plan.warnings());
    let mut study = plan.open(&args.out)?;
    answer.set("title", &plan.sweep().title);
    let end = finish(&mut study, &args.out, answer, interrupt, SweepPlan::run)?;
    let results = SweepResults::new(&plan, study.records());
    answer.warn(&results.warnings());
    let files = results.write(&args.out)?;
    answer.set_files(&files);
    let names: Vec<String> = files
        .iter()
        .filter_map(|file| Some(file.file_name()?.to_string_lossy().into_owned()))
        .collect();
    answer.say(format_args!(
        "{} runs at {} points; wrote {} to {}",
        study.done(),
        plan.sweep().points.len(),
        names.join(", "),
        args.out.display()
    ));
    end.into_result()
}
