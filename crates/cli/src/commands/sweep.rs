//! `adslam sweep`

use adslam_experiment::ExperimentError;
use adslam_experiment::run::Interrupt;
use adslam_experiment::sweep::{SweepPlan, SweepResults};

use crate::answer::Answer;
use crate::print::tell;
use crate::{SweepArgs, progress};

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
    let (total, there) = (plan.total_runs(), study.done());
    answer.set("title", &plan.sweep().title);
    answer.set("runs", total);
    answer.set("runs_there_already", there);
    if there > 0 {
        answer.say(format_args!("{there} of {total} runs were there already"));
    }
    let bar = progress::bar(total, "runs").with_position(there as u64);
    bar.reset_eta();
    let end = study.finish(interrupt, &|| bar.inc(1), SweepPlan::run);
    bar.finish_and_clear();
    let done = study.done();
    answer.set("runs_done", done);
    if done < total {
        let out = args.out.display();
        tell(format_args!(
            "{done} of {total} runs are kept in {out}; the same command does the others"
        ));
    }
    let end = end?;
    answer.set("complete", done == total);
    answer.set("failures", &end.failures);
    if end.interrupted {
        if !end.failures.is_empty() {
            // The interruption is what the command ends with, and tells nothing of these.
            let failures = end.failures.clone();
            tell(ExperimentError::Runs { failures });
        }
        return end.into_result();
    }
    let results = SweepResults::new(&plan, study.records());
    answer.warn(&results.warnings());
    let files = results.write(&args.out)?;
    answer.set_files(&files);
    let names: Vec<String> = files
        .iter()
        .filter_map(|file| Some(file.file_name()?.to_string_lossy().into_owned()))
        .collect();
    answer.say(format_args!(
        "{done} runs at {} points; wrote {} to {}",
        plan.sweep().points.len(),
        names.join(", "),
        args.out.display()
    ));
    end.into_result()
}
