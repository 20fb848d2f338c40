//! `adslam sweep`

use adslam_diagnostics::{Failure, Interrupt};
use adslam_experiment::study::SummaryRecord;
use adslam_experiment::sweep::{SweepPlan, SweepResults};
use adslam_scenario::registry::Registry;

use super::study::{finish, other_builds, tell_if_partial};
use crate::SweepArgs;
use crate::answer::Answer;
use crate::paths::folder_of;

/// Does the runs of a sweep that are not there yet, and writes its tables.
///
/// # Errors
/// Bad input, runs that failed, files that cannot be written, or an interruption.
pub fn sweep(args: &SweepArgs, registry: &Registry, interrupt: &Interrupt) -> Result<(), Failure> {
    Answer::give(args.json, |answer| {
        run_missing(args, registry, interrupt, answer)
    })
}

fn run_missing(
    args: &SweepArgs,
    registry: &Registry,
    interrupt: &Interrupt,
    answer: &mut Answer,
) -> Result<(), Failure> {
    let plan = SweepPlan::load_with(&args.sweep, args.runs, registry)?;
    answer.warn(&plan.warnings());
    let mut study = plan.open(&args.out, other_builds(args.accept_build))?;
    answer.set("title", &plan.sweep().title);
    let end = finish(
        &mut study,
        &args.out,
        answer,
        interrupt,
        SummaryRecord::of_unit,
    )?;
    if end.interrupted {
        return end.into_result();
    }
    let results = SweepResults::new(&plan, study.records(), study.builds());
    answer.warn(&results.warnings());
    let files = study.write_results(|folder| results.write(folder))?;
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
        folder_of(&files[0]).display()
    ));
    tell_if_partial(&study, answer);
    end.into_result()
}
