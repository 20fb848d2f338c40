//! `adslam tables`

use adslam_experiment::ExperimentError;
use adslam_experiment::output::{AtomicFile, prepare_folder};
use adslam_experiment::run::Interrupt;
use adslam_experiment::tables::{TablePlan, TablesOptions, markdown, terminal, write_json};

use crate::answer::Answer;
use crate::paths::shown;
use crate::print::tell;
use crate::{TablesArgs, progress};

/// Runs a configuration, prints its tables, and writes tables.md and tables.json, and report.html
/// where it is asked for.
///
/// Interrupted, it still tabulates and writes the runs that have finished.
///
/// # Errors
/// Bad input, runs that failed, files that cannot be written, or an interruption.
pub fn tables(args: &TablesArgs, interrupt: &Interrupt) -> Result<(), ExperimentError> {
    Answer::give(args.json, |answer| run_all(args, interrupt, answer))
}

fn run_all(
    args: &TablesArgs,
    interrupt: &Interrupt,
    answer: &mut Answer,
) -> Result<(), ExperimentError> {
    let options = TablesOptions {
        selection: args.selection.selection(),
        record: args.html,
    };
    let plan = TablePlan::load(&args.config, &options)?;
    prepare_folder(&args.out)?;
    let (md, json) = (args.out.join("tables.md"), args.out.join("tables.json"));
    let mut files = (AtomicFile::create(&md)?, AtomicFile::create(&json)?);
    let bar = progress::bar(plan.total_runs(), "runs");
    let tables = plan.run(interrupt, &|| bar.inc(1));
    bar.finish_and_clear();
    files.0.add(&markdown(&tables))?;
    write_json(&tables, &mut files.1)?;
    AtomicFile::commit_all(vec![files.0, files.1])?;
    answer.warn(&tables.warnings);
    answer.set("title", &tables.title);
    answer.set("complete", tables.is_complete());
    answer.set("failures", &tables.failures);
    answer.set_files(&[&md, &json]);
    answer.say(terminal(&tables));
    answer.say(format_args!(
        "wrote {} and {}",
        md.display(),
        json.display()
    ));
    if args.html {
        let page = adslam_report::write(&tables, &args.out)?;
        answer.set("report", shown(&page));
        answer.say(format_args!(
            "wrote {}; open it in a browser, no network needed",
            page.display()
        ));
    }
    if tables.interrupted && !tables.failures.is_empty() {
        // The interruption is what the command ends with, and tells nothing of these.
        let failures = tables.failures.clone();
        tell(ExperimentError::Runs { failures });
    }
    tables.into_result()
}
